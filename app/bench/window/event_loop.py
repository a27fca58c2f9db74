"""The event loop of a window, run by hand: how long it takes from an input until nothing is left to do or to paint."""

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter, sleep, thread_time

from PySide6.QtCore import QAbstractEventDispatcher, QCoreApplication, QEvent, QEventLoop

PAUSE = 0.06
"""Seconds between two inputs, as of a key that is held down: then the program works ahead."""
LONGEST_WAIT = 20.0
"""Seconds after which an answer is no longer waited for."""
WAIT_STEP = 0.001
"""Seconds between two looks whether something has come from the background."""
FIXED_ROUNDS = 100_000


@dataclass(frozen=True)
class Answer:
    """How long the window took over one input; all in seconds."""

    wall: float
    """From the input until nothing was left to do or to paint."""
    processor: float
    """What the window's thread worked in that time."""
    stall: float
    """The longest time in which no other input would have been taken, until the next input."""
    fixed: float
    """A fixed piece of work, timed just before: on a busy machine it takes longer."""


class TimedLoop:
    """Gives inputs to a window and times its answers."""

    def __init__(self, is_waiting: Callable[[], bool]) -> None:
        """Take what says whether something that was asked for still comes from another thread."""
        self._is_waiting = is_waiting
        self._stall = 0.0

    def time(self, give_input: Callable[[], object], pause: float = PAUSE) -> Answer:
        """Give an input, wait until it is answered, then pause."""
        fixed = fixed_work()
        self._stall = 0.0
        start, worked = perf_counter(), thread_time()
        give_input()
        self._stall = perf_counter() - start
        end, processor = self._settle(), thread_time() - worked
        self.pause(pause)
        return Answer(end - start, processor, self._stall, fixed)

    def pause(self, seconds: float) -> None:
        """Let the window do what it does while nobody acts."""
        end = perf_counter() + seconds
        while perf_counter() < end:
            self._settle()
            sleep(WAIT_STEP)

    def _settle(self) -> float:
        """Run the loop until it has nothing to do; return when it had done the last thing."""
        start = last = perf_counter()
        while True:
            turned = perf_counter()
            has_worked = self._turn()
            now = perf_counter()
            self._stall = max(self._stall, now - turned)
            if has_worked:
                last = now
            if now - start > LONGEST_WAIT:
                return now
            if not has_worked:
                if not self._is_waiting():
                    return last
                sleep(WAIT_STEP)

    def _turn(self) -> bool:
        """Do what is there to be done; return whether there was anything."""
        dispatcher = QAbstractEventDispatcher.instance()
        has_worked = dispatcher.processEvents(QEventLoop.ProcessEventsFlag.AllEvents)
        # These wait for the loop of the application itself, which does not run here.
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete.value)
        return has_worked


def fixed_work() -> float:
    """Return the seconds that a fixed piece of work takes."""
    start, total = perf_counter(), 0
    for number in range(FIXED_ROUNDS):
        total += number * number
    return perf_counter() - start
