"""What runs in a worker process: draw the bands that are asked for until the other end of the pipe is gone."""

import signal
import traceback
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection
from multiprocessing.shared_memory import SharedMemory
from time import perf_counter
from typing import Any

from numpy.typing import NDArray

from core.fast_path.draw import draw_picture
from core.fast_path.record import Picture, Route
from core.fast_path.workers.balance import band_pixels
from core.fast_path.workers.messages import Message, Receiver
from core.records.arrays import Integers
from core.records.frame import StageCount
from core.scene import AnyScene
from core.settings import Settings

READY = "ready"
"""First word of a worker: everything is imported."""


@dataclass(frozen=True, eq=False)
class BandOrder:
    """What a worker is asked to draw."""

    scene: AnyScene
    settings: Settings
    encoding: str
    depth_at: Integers | None
    """(N,) int64, places in the band whose depth is asked for."""
    plain_colors: bool
    region: tuple[int, int, int, int]
    """First column, first row, columns, rows."""
    memory: str
    """Name of the shared memory that the band is written to."""


@dataclass(frozen=True, eq=False)
class BandDone:
    """What a worker answers; the pixels are in the shared memory."""

    depth: NDArray[Any] | None
    """(N,) where depth was asked for."""
    route: Route
    statistics: dict[str, StageCount]
    seconds: float


@dataclass(frozen=True)
class BandFailed:
    """What a worker answers when drawing raised."""

    problem: str
    """The traceback."""


class SharedBand:
    """The shared memory as the worker sees it: opened when its name changes."""

    def __init__(self) -> None:
        self._memory: SharedMemory | None = None

    def open(self, name: str) -> SharedMemory:
        """Open the memory called ``name``, and take the name away: from now on it ends with its processes."""
        if self._memory is None or self._memory.name != name:
            self.close()
            self._memory = SharedMemory(name)
            self._memory.unlink()
        return self._memory

    def close(self) -> None:
        """Let go of the memory."""
        if self._memory is not None:
            self._memory.close()
            self._memory = None


def serve(connection: Connection) -> None:
    """Answer every order until the pipe ends, which it does when the other process ends, however it ends."""
    # Ctrl+C reaches all processes of a terminal; the one that asks decides what comes of it.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    receiver, memory = Receiver(), SharedBand()
    try:
        with suppress(EOFError, OSError):
            connection.send(READY)
            while True:
                connection.send(_answer(connection.recv(), receiver, memory))
    finally:
        memory.close()


def _answer(message: Message, receiver: Receiver, memory: SharedBand) -> BandDone | BandFailed:
    start = perf_counter()
    try:
        order: BandOrder = receiver.content(message)
        picture = _draw_band(order, memory.open(order.memory))
    except Exception:
        return BandFailed(traceback.format_exc())
    return BandDone(picture.depth, picture.route, picture.statistics, perf_counter() - start)


def _draw_band(order: BandOrder, memory: SharedMemory) -> Picture:
    """Draw a band; pixels go straight to the memory."""
    _, _, columns, rows = order.region
    return draw_picture(
        order.scene,
        order.settings,
        encoding=order.encoding,
        depth_at=order.depth_at,
        plain_colors=order.plain_colors,
        region=order.region,
        out=band_pixels(memory, rows, columns),
    )
