"""Drawing with worker processes: what is to be drawn, with whom, and what if one of them fails."""

import os
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing import current_process
from threading import Lock
from time import perf_counter
from typing import Any
from weakref import finalize

import numpy as np
from numpy.typing import NDArray

from core.fast_path.draw import draw_picture
from core.fast_path.draw_context import Picture
from core.fast_path.workers.sharing import (
    BandTime,
    Load,
    Pace,
    Sharing,
    even_cuts,
    have_colors_of_whole,
    joined_counts,
    joined_route,
    load_of,
    moved_cuts,
    rows_of,
)
from core.fast_path.workers.worker import Worker, WorkerFailedError
from core.records.arrays import Flags, Integers, read_only
from core.records.frame import StageCount
from core.scene import AnyScene
from core.settings import Settings
from core.stages.declared import UNSAMPLED_STAGES

# What is to be drawn, by one process as a whole or by several in bands of rows.


@dataclass(frozen=True, eq=False)
class Order:
    """What is to be drawn, by however many processes."""

    scene: AnyScene
    settings: Settings
    encoding: str
    depth_at: Integers | None
    out: NDArray[np.uint8] | None

    def draw(
        self, out: NDArray[np.uint8] | None, rows: tuple[int, int] | None = None, plain_colors: bool = False
    ) -> Picture:
        """Draw rows from first to end, or all, in this process; pixels go to ``out`` (H, W, 4)."""
        return draw_picture(
            self.scene,
            self.settings,
            encoding=self.encoding,
            depth_at=self.depth_at if rows is None else self.depth_in(*rows),
            region=None if rows is None else self.region(*rows),
            out=out,
            plain_colors=plain_colors,
        )

    def region(self, first: int, end: int) -> tuple[int, int, int, int]:
        """Return the region of rows ``first`` to ``end``."""
        return 0, first, self.scene.size[0], end - first

    def depth_in(self, first: int, end: int) -> Integers | None:
        """Return the places in the band of rows ``first`` to ``end`` whose depth is asked for."""
        return (
            None if self.depth_at is None else self.depth_at[self.is_in(first, end)] - first * self.shape[1]
        )

    def is_in(self, first: int, end: int) -> Flags:
        """Return which pixels whose depth is asked for (N,) are in rows ``first`` to ``end``."""
        assert self.depth_at is not None
        columns = self.shape[1]
        return (self.depth_at >= first * columns) & (self.depth_at < end * columns)

    def joined_depth(
        self, rows: Sequence[tuple[int, int]], of_bands: Sequence[NDArray[Any] | None]
    ) -> NDArray[Any] | None:
        """Return the depth (N,) that is asked for, from that of the bands of ``rows``."""
        if self.depth_at is None or of_bands[0] is None:
            return None
        depth = np.empty(len(self.depth_at), of_bands[0].dtype)
        for band, found in zip(rows, of_bands, strict=True):
            depth[self.is_in(*band)] = found
        return read_only(depth)

    @property
    def shape(self) -> tuple[int, int, int]:
        """Of the pixels: rows, columns, 4."""
        width, height = self.scene.size
        return height, width, 4


# Drawing with worker processes: when, with whom, and what if one of them fails.


DEFAULT_PROCESSES = 2
"""Every process does the vertices and the culling of all triangles again, so each one more gains less."""
START_LIMIT = 2
"""Workers are started, and once more after a failure."""
SECONDS_TO_START = 30.0
SECONDS_TO_ANSWER = 3.0
"""More than ten times what the band of this process took; then the worker is given up, and this process draws."""
SECONDS_TO_CLOSE = 0.3
"""For the end of the picture that is being drawn; then its workers are killed."""


class BandWorkers:
    """Draws pictures with worker processes where that is faster, and in this process where it is not.

    Parameters
    ----------
    processes : int, optional
        Processes that draw, this one among them; by default two where there are two cores.
    always : bool
        Share every picture, whatever it holds.

    Notes
    -----
    The first picture that is worth it starts the workers, and is drawn without them, as are those after it until they
    are ready: no picture waits for a process to start. What sharing is estimated to gain decides that it is tried, what
    it turns out to gain decides that it goes on. Close it, or use it in a ``with`` statement; it also ends with
    the program. Pictures may be drawn from any thread; while one is being drawn, others are drawn without workers.

    The main module of the program is not run again in the workers: a script needs no guard around its main part.

    Examples
    --------
    >>> from core.scene import ClipScene
    >>> with BandWorkers() as workers:
    ...     picture = workers.draw(ClipScene([[[-1, -1, 0, 1], [1, -1, 0, 1], [0, 1, 0, 1]]], size=(8, 8)))
    >>> picture.pixels.shape, workers.sharing.process_count
    ((8, 8, 4), 1)
    """

    def __init__(self, processes: int | None = None, *, always: bool = False) -> None:
        if processes is not None and processes < 1:
            raise ValueError(f"processes must be 1 or more, got {processes}")
        self.processes = min(DEFAULT_PROCESSES, usable_cores()) if processes is None else processes
        self._always = always
        self._workers: list[Worker] = []
        self._cuts = even_cuts(self.processes)
        self._start_count = 0
        self._failure = ""
        self._plain_colors = self._is_closed = False
        self._load: Load | None = None
        self._pace = Pace()
        self._sharing = Sharing(reason="no picture yet")
        self._lock = Lock()
        self._end = finalize(self, _close_all, self._workers)

    @property
    def sharing(self) -> Sharing:
        """How the work on the last picture was shared."""
        return self._sharing

    @property
    def failure(self) -> str:
        """What went wrong in a worker last, else empty."""
        return self._failure

    @property
    def pids(self) -> tuple[int, ...]:
        """Numbers of the worker processes."""
        return tuple(worker.pid for worker in self._workers if worker.pid is not None)

    def draw(
        self,
        scene: AnyScene,
        settings: Settings | None = None,
        encoding: str = "srgb",
        *,
        depth_at: Integers | None = None,
        out: NDArray[np.uint8] | None = None,
    ) -> Picture:
        """Draw a scene as `draw_picture` does, to the byte.

        Parameters
        ----------
        encoding : str
            ``"srgb"`` or ``"linear"``.
        depth_at : (N,) int64, optional
            Pixels whose depth is kept.
        out : (H, W, 4) uint8, C-contiguous, optional
            Memory for the pixels; it need not be shared.

        Raises
        ------
        ValueError
            As `draw_picture`. A worker that fails raises nothing: this process draws the picture, see `failure`.
        """
        order = Order(scene, settings or Settings(), encoding, depth_at, out)
        if not self._lock.acquire(blocking=False):
            return order.draw(out)
        try:
            return self._draw(order)
        finally:
            self._lock.release()

    def start(self) -> bool:
        """Start the workers now, and wait until they are ready; return whether they are.

        `draw` starts them by itself: this is for whoever knows that many pictures will come.
        """
        with self._lock:
            return not self._why_alone() and self._has_workers(SECONDS_TO_START)

    def close(self) -> None:
        """End the workers; later pictures are drawn without them.

        A picture that another thread draws with them is waited for only for a moment: then that thread draws it alone.
        """
        self._is_closed = True
        is_free = self._lock.acquire(timeout=SECONDS_TO_CLOSE)
        if not is_free:
            for worker in list(self._workers):
                worker.kill()
            is_free = self._lock.acquire(timeout=SECONDS_TO_CLOSE)
        if is_free:
            self._end()
            self._lock.release()

    def __enter__(self) -> "BandWorkers":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _draw(self, order: Order) -> Picture:
        gain = self._load.gain(self.processes) if self._load else 0.0
        reason = self._why_alone() or _why_not_divided(order) or self._why_not_worth(order.shape[0])
        if not reason and not self._has_workers(0.0):
            reason = self._failure or "the worker processes are being started"
        reason = reason or ("" if self._always or self._pace.may_share else self._pace.reason)
        is_cold = not all(worker.picture_count for worker in self._workers)
        start, is_tried = perf_counter(), not reason
        if is_tried:
            try:
                picture, bands = self._draw_in_one_way(order)
                reason = "" if bands else "colours of the bands were worked out in different ways"
            except WorkerFailedError as problem:
                self._give_up(problem)
                reason = self._failure
            except BaseException:
                # Ctrl+C in the middle of a conversation: nobody would know any more what an answer belongs to.
                if any(worker.is_asked for worker in self._workers):
                    _close_all(self._workers)
                raise
        if reason:
            picture, bands = order.draw(order.out), ()
        self._load = load_of(picture)
        if is_tried and not is_cold and not self._always:
            self._pace.shared(perf_counter() - start, self._load)
        elif not is_tried:
            self._pace.alone(perf_counter() - start, self._load)
        self._sharing = Sharing(bands, reason, gain)
        return picture

    def _why_alone(self) -> str:
        """Return why there can be no workers, else an empty text."""
        if self._is_closed:
            return "the workers are closed"
        if self.processes < 2:
            return "only one process is allowed"
        if current_process().daemon:
            return "this is a worker process itself"
        if not self._workers and self._start_count >= START_LIMIT:
            return self._failure
        return ""

    def _why_not_worth(self, height: int) -> str:
        """Return why a picture of so many rows is not shared, else an empty text."""
        if height < self.processes:
            return f"{height} rows are too few"
        if self._always:
            return ""
        if self._load is None:
            return "the first picture has not been timed"
        return "" if self._load.is_worth(self.processes) else "a picture like the last one is not worth it"

    def _has_workers(self, seconds: float) -> bool:
        """Start the workers where there are none; return whether they are ready after at most ``seconds``."""
        try:
            if not self._workers:
                self._start_count += 1
                while len(self._workers) < self.processes - 1:
                    self._workers.append(Worker())
            return all(worker.is_ready(seconds) for worker in self._workers)
        except WorkerFailedError as problem:
            self._give_up(problem)
            return False

    def _give_up(self, problem: WorkerFailedError) -> None:
        self._failure = str(problem)
        _close_all(self._workers)

    def _draw_in_one_way(self, order: Order) -> tuple[Picture, tuple[BandTime, ...]]:
        """Draw with all workers, all bands with the colours of the whole picture; no bands: the colours are unknown.

        What all of them must draw alike is learned from the bands, and stays so for the pictures to come: an orbit
        draws a band twice only where it changes.
        """
        picture, bands = self._draw_bands(order)
        if not bands:
            self._plain_colors = not self._plain_colors
            picture, bands = self._draw_bands(order)
        return picture, bands

    def _draw_bands(self, order: Order) -> tuple[Picture, tuple[BandTime, ...]]:
        """Draw with all workers; no bands: their colours are not those of the whole picture."""
        start = perf_counter()
        rows = rows_of(self._cuts, order.shape[0])
        for worker, band in zip(self._workers, rows[1:], strict=True):
            worker.ask(
                order.scene,
                order.settings,
                order.encoding,
                order.depth_in(*band),
                self._plain_colors,
                order.region(*band),
            )
        asking = perf_counter() - start
        pixels = np.empty(order.shape, np.uint8) if order.out is None else order.out
        try:
            own = order.draw(pixels[: rows[0][1]], rows[0], self._plain_colors)
        except Exception:
            # The scene is to blame: they say the same, and stay.
            for worker in self._workers:
                with suppress(WorkerFailedError):
                    worker.answer(SECONDS_TO_ANSWER)
            raise
        seconds = perf_counter() - start
        done = [worker.answer(SECONDS_TO_ANSWER + 10 * seconds) for worker in self._workers]
        routes = [own.route, *(band.route for band in done)]
        if not have_colors_of_whole(routes, self._plain_colors):
            return own, ()
        statistics = joined_counts([own.statistics, *(band.statistics for band in done)])
        with statistics["resolve"]:
            for worker, (first, end) in zip(self._workers, rows[1:], strict=True):
                worker.copy_band(pixels[first:end])
            depth = order.joined_depth(rows, [own.depth, *(band.depth for band in done)])
        times = [seconds, *(band.seconds for band in done)]
        if all(worker.picture_count > 1 for worker in self._workers):
            self._move_cuts(times, asking, [own.statistics, *(band.statistics for band in done)])
        route = joined_route(routes)
        picture = Picture(read_only(pixels), depth, statistics, route)
        return picture, tuple(BandTime(*band, time) for band, time in zip(rows, times, strict=True))

    def _move_cuts(self, times: list[float], asking: float, statistics: list[dict[str, StageCount]]) -> None:
        fixed = [sum(part[stage].seconds for stage in UNSAMPLED_STAGES) for part in statistics]
        fixed[0] += asking
        self._cuts = moved_cuts(self._cuts, np.array(times), np.array(fixed))


def _why_not_divided(order: Order) -> str:
    """Return why bands get no part of it, else an empty text: what does not fit is refused for the whole picture."""
    out, depth_at = order.out, order.depth_at
    if order.settings.replacements:
        return "a replaced function stays in this process"
    if out is not None and not (
        out.shape == order.shape and out.dtype == np.uint8 and out.flags.c_contiguous
    ):
        return "the memory does not fit the picture"
    if depth_at is not None and not order.is_in(0, order.shape[0]).all():
        return "depth is requested outside the picture"
    return ""


def _close_all(workers: list[Worker]) -> None:
    while workers:
        workers.pop().close()


def usable_cores() -> int:
    """Return how many cores this process may use, or, where the system does not say, how many there are."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
