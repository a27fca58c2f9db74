"""What runs in a worker process, and how scenes are sent again and again: what was sent before is a number.

Meshes, textures, materials, lights and settings never change once they are made, so an object that the other side has
is still right. An orbit makes a new scene for every picture, of the same meshes and another camera: only the camera
goes through the pipe.
"""

import io
import pickle
import signal
import traceback
from collections import deque
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from multiprocessing.connection import Connection
from multiprocessing.shared_memory import SharedMemory
from time import perf_counter
from typing import Any, NamedTuple
from weakref import ReferenceType, ref

import numpy as np
from numpy.typing import NDArray

from core.fast_path.draw import draw_picture
from core.fast_path.draw_context import Picture, Route
from core.fast_path.workers.sharing import band_pixels
from core.records.arrays import Integers
from core.records.frame import StageCount
from core.scene import AnyScene, ClipScene, DirectionalLight, Material, Mesh, PointLight, Texture
from core.settings import Settings

# Sending scenes again and again: what was sent before is named by a number.


SENT_ONCE = (Mesh, Texture, Material, ClipScene, DirectionalLight, PointLight, Settings)
LARGE = 1 << 10
"""Bytes of a read-only array from which it is worth a number of its own: a mesh that is moved keeps its vertices."""


class Message(NamedTuple):
    """What goes through the pipe."""

    new: list[tuple[int, bytes]]
    """Number and content of the objects that the other side does not have, in an order that it can read them in."""
    forgotten: list[int]
    """Numbers of objects that are gone on this side."""
    content: bytes


class Sender:
    """The side that sends: remembers what was sent, for as long as it lives."""

    def __init__(self) -> None:
        self._sent: dict[int, tuple[int, ReferenceType[Any]]] = {}
        """By identity: number, and a reference that tells when the object is gone."""
        self._forgotten: deque[int] = deque()
        self._new: list[tuple[int, bytes]] = []
        self._count = 0

    def message(self, content: object) -> Message:
        """Return the message that tells ``content``."""
        self._new = []
        written = self._write(content)
        forgotten = [self._forgotten.popleft() for _ in range(len(self._forgotten))]
        return Message(self._new, forgotten, written)

    def number_of(self, value: object) -> int:
        """Return the number of an object that is sent once; the first time, its content goes with this message."""
        known = self._sent.get(id(value))
        if known is not None:
            return known[0]
        number = self._count
        self._count += 1
        gone = partial(_forget, self._sent, self._forgotten, id(value), number)
        self._sent[id(value)] = number, ref(value, gone)
        written = self._write(value)  # what is inside it comes first
        self._new.append((number, written))
        return number

    def _write(self, content: object) -> bytes:
        file = io.BytesIO()
        _Pickler(file, self, content).dump(content)
        return file.getvalue()


def _forget(
    sent: dict[int, tuple[int, ReferenceType[Any]]],
    forgotten: deque[int],
    identity: int,
    number: int,
    _: ReferenceType[Any],
) -> None:
    # Before another object can have the same identity.
    del sent[identity]
    forgotten.append(number)


def is_sent_once(value: object) -> bool:
    """Return whether an object cannot change, and is large enough or kept long enough to be named by a number."""
    if isinstance(value, np.ndarray):
        return not value.flags.writeable and value.nbytes >= LARGE
    return isinstance(value, SENT_ONCE)


class _Pickler(pickle.Pickler):
    def __init__(self, file: io.BytesIO, sender: Sender, root: object) -> None:
        super().__init__(file, protocol=pickle.HIGHEST_PROTOCOL)
        self._sender, self._root = sender, root

    def persistent_id(self, value: object) -> int | None:
        if value is self._root or not is_sent_once(value):
            return None
        return self._sender.number_of(value)


class Receiver:
    """The side that reads: keeps what was sent."""

    def __init__(self) -> None:
        self._kept: dict[int, Any] = {}

    def __len__(self) -> int:
        return len(self._kept)

    def content(self, message: Message) -> Any:
        """Return what a message tells."""
        for number in message.forgotten:
            del self._kept[number]
        for number, written in message.new:
            value = self._read(written)
            if isinstance(value, np.ndarray):
                value.flags.writeable = False
            self._kept[number] = value
        return self._read(message.content)

    def _read(self, written: bytes) -> Any:
        return _Unpickler(io.BytesIO(written), self._kept).load()


class _Unpickler(pickle.Unpickler):
    def __init__(self, file: io.BytesIO, kept: dict[int, Any]) -> None:
        super().__init__(file)
        self._kept = kept

    def persistent_load(self, number: int) -> Any:
        return self._kept[number]


# What runs in a worker process: draw the bands that are asked for until the other end of the pipe is gone.


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
