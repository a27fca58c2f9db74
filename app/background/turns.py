"""One piece of long work at a time, whatever page asked for it: at once each would falsify the times of the other."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Lock

from app.background.workers import Progress

LOOK_SECONDS = 0.05
"""How often work that waits looks whether it is still wanted."""


class CancelledWaitError(Exception):
    """The work was cancelled before its turn came."""


class Turns:
    """Lets work begin when the work before it has ended; meanwhile it names the page that it waits for."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._page = ""

    @contextmanager
    def take(self, page: str, progress: Progress, is_cancelled: Callable[[], bool]) -> Iterator[None]:
        """Wait for the turn of ``page``, then hold it; raises CancelledWaitError if it is not wanted any more."""
        while not self._lock.acquire(timeout=LOOK_SECONDS):
            if is_cancelled():
                raise CancelledWaitError(f"The {page} page does not wait any more.")
            # Cancelled work of the same page may be in its last run.
            waits = "Preparing" if self._page == page else f"Waiting until the {self._page} page is done"
            progress(None, waits)
        self._page = page
        try:
            yield
        finally:
            self._lock.release()


turns = Turns()
"""Of the whole program."""
