"""Sending scenes again and again: what was sent before is named by a number.

Meshes, textures, materials, lights and settings never change once they are made, so an object that the other side has
is still right. An orbit makes a new scene for every picture, of the same meshes and another camera: only the camera
goes through the pipe.
"""

import io
import pickle
from collections import deque
from functools import partial
from typing import Any, NamedTuple
from weakref import ReferenceType, ref

import numpy as np

from core.scene import ClipScene, DirectionalLight, Material, Mesh, PointLight, Texture
from core.settings import Settings

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
