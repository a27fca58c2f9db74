"""Where the arrays of a mesh come from: fingerprints tell whether a file or built-in scene still has them."""

from dataclasses import dataclass
from functools import lru_cache, partial
from hashlib import sha256
from pathlib import Path
from typing import Any
from weakref import ReferenceType, ref

import numpy as np
from numpy.typing import NDArray

from core.scene import Mesh, Scene
from lessons.scenes import make_scene, scene_names

ARRAYS = ("positions", "triangles", "normals", "uvs", "colors", "faces", "texture")
"""Arrays of a mesh; the texture's are its pixels."""

Fingerprints = tuple[dict[str, str], ...]
"""For every mesh, fingerprint by name of the array; a missing array has none."""


@dataclass(frozen=True)
class _Remembered:
    """A file at the time it was opened."""

    stamp: tuple[int, int]
    fingerprints: Fingerprints
    allows_outside: bool


LARGE = 1 << 16
"""Bytes of an array whose fingerprint is worth remembering."""
_fingerprints: dict[int, tuple[ReferenceType[NDArray[Any]], str]] = {}
"""By identity of the array."""
_remembered: dict[Path, _Remembered] = {}
"""What the opened files hold, so that saving need not read them again."""


def array_of(mesh: Mesh, name: str) -> NDArray[Any] | None:
    """Return one of ``ARRAYS`` of a mesh."""
    if name == "texture":
        return None if mesh.texture is None else mesh.texture.pixels
    value: NDArray[Any] | None = getattr(mesh, name)
    return value


def fingerprint(array: NDArray[Any]) -> str:
    """Return a text that is the same for arrays of the same type, shape and bits, and for no others.

    That of a large array that cannot change is computed once.
    """
    known = _fingerprints.get(id(array))
    if known is not None and known[0]() is array:
        return known[1]
    digest = sha256(f"{array.dtype.str} {array.shape} ".encode())
    digest.update(np.ascontiguousarray(array).data)
    text = digest.hexdigest()[:32]
    if array.nbytes >= LARGE and not array.flags.writeable:
        _fingerprints[id(array)] = ref(array, partial(_forget, id(array))), text
    return text


def _forget(identity: int, gone: ReferenceType[NDArray[Any]]) -> None:
    # Another array may have the same identity by now.
    if identity in _fingerprints and _fingerprints[identity][0] is gone:
        del _fingerprints[identity]


def fingerprints_of(meshes: tuple[Mesh, ...]) -> Fingerprints:
    """Return the fingerprints of all arrays of meshes."""
    found = [{name: array_of(mesh, name) for name in ARRAYS} for mesh in meshes]
    return tuple({name: fingerprint(a) for name, a in of.items() if a is not None} for of in found)


def remember_file(path: str | Path, meshes: tuple[Mesh, ...], allows_outside: bool = False) -> None:
    """Remember which meshes ``path`` holds at present, and whether it may name files outside its folder."""
    key = Path(path).resolve()
    _remembered[key] = _Remembered(_stamp(key), fingerprints_of(meshes), allows_outside)


def may_name_outside(path: str | Path) -> bool:
    """Return whether ``path`` was opened so that it may name files outside its folder."""
    known = _remembered.get(Path(path).resolve())
    return known is not None and known.allows_outside


def remembered_fingerprints(path: str | Path) -> Fingerprints:
    """Return what a file holds that was opened and has not changed since; of others nothing is known."""
    key = Path(path).resolve()
    known = _remembered.get(key)
    try:
        return known.fingerprints if known is not None and known.stamp == _stamp(key) else ()
    except OSError:
        return ()


@lru_cache(maxsize=1)
def built_in_fingerprints() -> dict[str, Fingerprints]:
    """Return the fingerprints of every built-in scene that is made of meshes."""
    scenes = {name: make_scene(name) for name in scene_names()}
    return {name: fingerprints_of(s.meshes) for name, s in scenes.items() if isinstance(s, Scene)}


def _stamp(path: Path) -> tuple[int, int]:
    found = path.stat()
    return found.st_mtime_ns, found.st_size
