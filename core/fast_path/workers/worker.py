"""A worker process as the program sees it: started, asked, listened to, ended."""

import os
import shutil
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from multiprocessing import get_context, resource_tracker
from multiprocessing.shared_memory import SharedMemory
from pathlib import Path
from pickle import PicklingError
from secrets import token_hex
from threading import Lock, Timer
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.fast_path.workers.serving import READY, BandDone, BandFailed, BandOrder, Sender, serve
from core.fast_path.workers.sharing import band_pixels, byte_count
from core.records.arrays import Integers
from core.scene import AnyScene
from core.settings import Settings

VARIABLES = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "PYTHONSAFEPATH")
"""Set to 1 while a worker starts. A band is one thread's work; threads of the linear algebra would only spin beside it.
A safe path: no file of the current folder is taken for a module."""
SECONDS_TO_END = 0.5
"""A worker that has not ended by itself after this is killed."""
SECONDS_TO_TAKE = 3.0
"""A worker takes a message within this, and some more for a large one; else it is killed."""
BYTES_PER_SECOND = 50e6
"""How fast a large message goes through the pipe at least."""
LARGE_MESSAGE = 4096
"""Bytes that a pipe takes, or gives, whether or not the other side is there."""
SHARED_FOLDER = Path("/dev/shm")
"""Where Linux keeps shared memory; elsewhere the system says itself when there is no more."""

_starting = Lock()


def memory_prefix(pid: int) -> str:
    """Return what the names of shared memory begin with that a process makes (macOS wants them short)."""
    return f"raster{pid}-"


class WorkerFailedError(Exception):
    """A worker cannot do its part; the message says why."""


class Worker:
    """One process that draws bands.

    Notes
    -----
    Nothing is left behind however this program ends: the worker ends when its pipe does, and the name of the shared
    memory is taken away as soon as both processes have it open.
    """

    def __init__(self) -> None:
        context = get_context("spawn")
        self._connection, other_end = context.Pipe()
        self._process = context.Process(target=serve, args=(other_end,), name="rasterscope band", daemon=True)
        try:
            with _start_of_a_worker():
                self._process.start()
        except (OSError, RuntimeError) as problem:
            self._connection.close()
            raise WorkerFailedError(f"no worker process could be started: {problem}") from problem
        finally:
            other_end.close()
        self._sender = Sender()
        self._memory: SharedMemory | None = None
        self._has_name = self._is_ready = self._gives_much = False
        self.is_asked = False
        """An answer is still to come."""
        self.picture_count = 0
        """Bands drawn since it was started."""

    @property
    def pid(self) -> int | None:
        """Number of the process."""
        return self._process.pid

    def is_ready(self, seconds: float = 0.0) -> bool:
        """Return whether it can be asked, waiting for at most ``seconds``."""
        if not self._is_ready and self._connection.poll(seconds):
            self._is_ready = self._receive() == READY
        return self._is_ready

    def ask(
        self,
        scene: AnyScene,
        settings: Settings,
        encoding: str,
        depth_at: Integers | None,
        plain_colors: bool,
        region: tuple[int, int, int, int],
    ) -> None:
        """Ask for a band and for its depth at places (N,); see `draw_picture`."""
        width, height = scene.size
        self.is_asked = True
        try:
            # Room for the whole picture, since the next band may be higher.
            memory = self._memory_of(byte_count(height, width))
            order = BandOrder(scene, settings, encoding, depth_at, plain_colors, region, memory.name)
            message = self._sender.message(order)
            size = len(message.content) + sum(len(written) for _, written in message.new)
            self._gives_much = depth_at is not None and depth_at.nbytes > LARGE_MESSAGE
            with self._killed_after(SECONDS_TO_TAKE + size / BYTES_PER_SECOND, size > LARGE_MESSAGE):
                self._connection.send(message)
        except OSError as problem:
            raise WorkerFailedError(self._why_it_ended(problem)) from problem
        except (PicklingError, AttributeError, TypeError) as problem:
            raise WorkerFailedError(f"the scene cannot be sent to a worker: {problem}") from problem

    def answer(self, seconds: float) -> BandDone:
        """Wait at most ``seconds`` for the band that was asked for; see `copy_band`."""
        if not self._connection.poll(seconds):
            raise WorkerFailedError(f"a worker process gave no answer for {seconds:.0f} s")
        with self._killed_after(SECONDS_TO_TAKE, self._gives_much):
            done: BandDone | BandFailed = self._receive()
        self.is_asked = False
        self._has_name = False
        if isinstance(done, BandFailed):
            raise WorkerFailedError(done.problem)
        self.picture_count += 1
        return done

    def copy_band(self, pixels: NDArray[np.uint8]) -> None:
        """Copy the band that was answered last from the shared memory to ``pixels`` (H, W, 4) uint8."""
        assert self._memory is not None
        rows, columns, _ = pixels.shape
        np.copyto(pixels, band_pixels(self._memory, rows, columns))

    def kill(self) -> None:
        """End the process at once, from any thread: whoever waits for it gets an error."""
        with suppress(ValueError):  # closed meanwhile
            self._process.kill()

    @contextmanager
    def _killed_after(self, seconds: float, is_needed: bool) -> Iterator[None]:
        """Kill the process if the block takes longer: no pipe waits for a process that has ended."""
        if not is_needed:
            yield
            return
        timer = Timer(seconds, self.kill)
        timer.daemon = True
        timer.start()
        try:
            yield
        finally:
            timer.cancel()

    def close(self) -> None:
        """End the process, and wait until it has ended. A second time does nothing."""
        if self._connection.closed:
            return
        self._connection.close()
        self._process.join(SECONDS_TO_END)
        if self._process.exitcode is None:
            self._process.kill()
            self._process.join()
        self._process.close()
        self._release_memory()

    def _receive(self) -> Any:
        try:
            return self._connection.recv()
        except (EOFError, OSError) as problem:
            raise WorkerFailedError(self._why_it_ended(problem)) from problem

    def _why_it_ended(self, problem: Exception) -> str:
        self._process.join(SECONDS_TO_END)
        code = self._process.exitcode
        return f"a worker process ended with code {code}" if code is not None else f"a worker: {problem}"

    def _memory_of(self, byte_count: int) -> SharedMemory:
        if self._memory is None or self._memory.size < byte_count:
            self._release_memory()
            _check_room(byte_count)
            name = f"{memory_prefix(os.getpid())}{token_hex(4)}"
            self._memory = SharedMemory(name, create=True, size=byte_count)
            self._has_name = True
        return self._memory

    def _release_memory(self) -> None:
        if self._memory is None:
            return
        if self._has_name:
            # The worker may have ended before it took the name away, or after.
            with suppress(FileNotFoundError):
                self._memory.unlink()
        self._memory.close()
        self._memory = None


@contextmanager
def _start_of_a_worker() -> Iterator[None]:
    """Start a process that has one thread, hears no Ctrl+C, and does not run the program's main module again.

    A spawned process imports the main module of the one that starts it, for functions that are defined there. Ours is
    not: without this a script that draws, and does not guard its main part, would run twice.
    """
    if sys.flags.ignore_environment and not sys.flags.safe_path:
        raise RuntimeError("with -E, Python would import from the current folder")
    with _starting:
        main = sys.modules["__main__"]
        missing = {name: value for name in VARIABLES if not (value := os.environ.get(name))}
        sys.modules["__main__"] = ModuleType("__main__")
        os.environ.update(dict.fromkeys(missing, "1"))
        try:
            with _without_interrupts():
                yield
        finally:
            sys.modules["__main__"] = main
            for name, value in missing.items():
                del os.environ[name]
                if value is not None:
                    os.environ[name] = value


@contextmanager
def _without_interrupts() -> Iterator[None]:
    """Start a process in which Ctrl+C waits, until it says itself that it does not want to hear of it."""
    if sys.platform != "win32":
        # Started by the first process that is spawned otherwise, and then it lets the signal through again.
        resource_tracker.ensure_running()
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        if sys.platform != "win32":
            signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _check_room(byte_count: int) -> None:
    """Raise where shared memory is too small: Linux promises what it has not, and kills whoever writes there."""
    if SHARED_FOLDER.is_dir():
        free = shutil.disk_usage(SHARED_FOLDER).free
        if free < 2 * byte_count:
            raise OSError(f"{SHARED_FOLDER} has {free >> 20} MB free, a picture needs {byte_count >> 20}")
