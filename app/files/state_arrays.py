"""Arrays in state files: as numbers that can be read, as compressed bytes, or in files that still have them.

A window saves its state after every edit. The large arrays of its meshes stand in a folder beside the state, each in a
file that is named by its fingerprint: what did not change is not written again.
"""

import binascii
import math
import sys
import zlib
from base64 import b64decode, b64encode
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache, partial
from hashlib import sha256
from pathlib import Path
from typing import Any
from weakref import ReferenceType, ref

import numpy as np
from numpy.typing import NDArray

from app.files.file_access import make_folder, read_input, write_file
from app.files.state_models import ArrayRecord
from app.session.memory import Need, check_free
from core.records.curves import Curves
from core.records.deformations import Blend, Skin
from core.scene import ClipScene, Mesh, Scene
from lessons.os_errors import os_error_reason
from lessons.scenes import make_scene, scene_names

# Where the arrays of a mesh come from: fingerprints tell whether a file or built-in scene still has them.


OWN_ARRAYS = ("positions", "triangles", "normals", "uvs", "colors", "faces", "texture", "patches")
"""Arrays of a mesh; the texture's are its pixels."""
SKIN_ARRAYS = ("weights", "heads", "tails", "parents", "axes", "angles")
BLEND_ARRAYS = ("targets", "weights")
DEFORMATION_ARRAYS = (*(f"skin_{name}" for name in SKIN_ARRAYS), *(f"blend_{name}" for name in BLEND_ARRAYS))
"""Arrays of `core.records.deformations.Skin` and ``Blend``."""
ARRAYS = (*OWN_ARRAYS, *DEFORMATION_ARRAYS)
"""Arrays that a mesh is kept by."""

EARLIER = frozenset(
    {
        "ddf2ae320e28e376a0cbe09cda708c66",
        "6ee7ae35a713af91e93f19957f17d66e",
        "f854a0f80c8b6a0df092db10e4277c6b",
    }
)
"""Fingerprints of arrays that a built-in scene had in earlier versions, the same up to the last bits of rounding.

The teapot's positions, normals and texture coordinates before its patches were cut by de Casteljau's scheme.
"""

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
    kind, _, part = name.partition("_")
    if name in DEFORMATION_ARRAYS:
        held = mesh.deformation
        has = isinstance(held, Skin if kind == "skin" else Blend)
        return np.asarray(getattr(held, part)) if has else None
    value: NDArray[Any] | None = getattr(mesh, name)
    return value


def with_deformation(arrays: dict[str, Any]) -> dict[str, Any]:
    """Return the arrays of a mesh with those of a deformation made into one; ValueError where they do not fit."""
    found = {name: values for name, values in arrays.items() if name in DEFORMATION_ARRAYS}
    own = {name: values for name, values in arrays.items() if name not in found}
    if not found:
        return own
    kind = "skin" if "skin_weights" in found else "blend"
    names = SKIN_ARRAYS if kind == "skin" else BLEND_ARRAYS
    if found.keys() != {f"{kind}_{name}" for name in names}:
        raise ValueError(f"a {kind} needs all and only the arrays {', '.join(names)}, got {', '.join(found)}")
    make: Any = Skin if kind == "skin" else Blend
    return own | {"deformation": make(**{name: found[f"{kind}_{name}"] for name in names})}


CLIP_ARRAYS = (
    *("clip", "attributes", "shared", "clip_region", "rings", "region_rings", "texture"),
    *("curves", "curve_colors"),
)
"""Arrays of a scene in clip space; the last two are its `core.records.curves.Curves`."""


def clip_arrays(scene: ClipScene) -> dict[str, Any]:
    """Return the records of the arrays of a scene in clip space, by their names in `CLIP_ARRAYS`; ``None``: none."""
    curves, texture = scene.curves, scene.texture
    arrays: dict[str, NDArray[Any] | None] = {name: getattr(scene, name) for name in CLIP_ARRAYS[:6]}
    arrays["texture"] = None if texture is None else texture.pixels
    if curves is not None:
        arrays |= {"curves": curves.control, "curve_colors": curves.colors}
    return {name: None if array is None else array_record(array) for name, array in arrays.items()}


def curves_of(arrays: dict[str, Any]) -> Curves | None:
    """Take the arrays of curves out of those of a scene; ValueError where one is missing or does not fit."""
    control, colors = arrays.pop("curves"), arrays.pop("curve_colors")
    if (control is None) != (colors is None):
        raise ValueError("curves need curve_colors, and these need curves")
    return None if control is None else Curves(control, colors)


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


# Arrays in state files: as numbers that can be read, as compressed bytes, or in files of their own.


READABLE_COUNT = 1200
"""Arrays of no more numbers are written so that they can be read."""
ARRAY_LIMIT = 4 << 30
"""Largest array in bytes."""
DEFLATE = 1032
"""Most bytes that zlib makes of one."""
UNFOLDED = 50
"""Bytes that all arrays of a state may unfold to for each compressed one, beside what any file may take.

Whole meshes unfold to 3 to 10 times their compressed bytes.
"""
ENDING = ".array"
"""Of the files with the bytes of one array."""


def array_record(array: NDArray[Any]) -> ArrayRecord:
    """Return the record of a float64, float32 or int64 array; it gives back the same bits."""
    dtype: Any = array.dtype.name
    shape = list(array.shape)
    if array.size <= READABLE_COUNT:
        rows = array.reshape(-1, array.shape[-1]) if array.size else array.reshape(0, 1)
        return ArrayRecord(dtype=dtype, shape=shape, rows=rows.tolist())
    return ArrayRecord(dtype=dtype, shape=shape, zlib=b64encode(zlib.compress(_bytes_of(array), 6)).decode())


def array_from(record: ArrayRecord) -> NDArray[Any]:
    """Return the array of a record, or raise ValueError."""
    dtype = np.dtype(record.dtype)
    size = math.prod(record.shape) * dtype.itemsize
    if size > ARRAY_LIMIT:
        raise ValueError(
            f"an array must not be larger than {ARRAY_LIMIT >> 30} GiB, got shape {record.shape}"
        )
    if record.rows is not None:
        numbers = [number for row in record.rows for number in row]
        if dtype.kind == "i" and not all(isinstance(number, int) for number in numbers):
            raise ValueError(f"numbers of {record.dtype} must be whole")
        try:
            return np.array(numbers, dtype).reshape(record.shape)
        except OverflowError:
            raise ValueError(f"a number is too large for {record.dtype}") from None
    if record.zlib is None:
        raise ValueError("only arrays of meshes have a file of their own")
    try:
        packed = b64decode(record.zlib.encode(), validate=True)
        if size > DEFLATE * len(packed):
            raise ValueError(
                f"shape {record.shape} wants {size} bytes, more than {len(packed)} compressed ones hold"
            )
        check_free(2 * size, f"an array of shape {record.shape}")
        content = zlib.decompressobj().decompress(packed, size + 1)
    except (binascii.Error, zlib.error) as problem:
        raise ValueError("the compressed bytes are damaged") from problem
    if len(content) != size:
        raise ValueError(f"shape {record.shape} wants {size} bytes, got {len(content)}")
    return _array_of(content, record)


def check_unfolded(records: Iterable[ArrayRecord | None]) -> None:
    """Raise MemoryBoundError, before any is unfolded, if compressed arrays unfold to more than such a file may hold."""
    packed = [record for record in records if record is not None and record.zlib is not None]
    size = sum(math.prod(record.shape) * np.dtype(record.dtype).itemsize for record in packed)
    Need(factor=UNFOLDED).ask(size, sum(len(record.zlib or "") * 3 // 4 for record in packed), "its arrays")


def array_folder(state: Path) -> Path:
    """Return the folder with the arrays that have files of their own, of the state file ``state``."""
    return state.with_suffix(".arrays")


class ArrayFolder:
    """Keeps large arrays in files of their own, each written once."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._used: set[str] = set()

    def keep(self, array: NDArray[Any]) -> ArrayRecord:
        """Return the record of an array; a large one stands in the folder.

        Raises FileWriteError if it cannot be written.
        """
        if array.size <= READABLE_COUNT:
            return array_record(array)
        name = fingerprint(array)
        path = self._folder / f"{name}{ENDING}"
        self._used.add(path.name)
        if not (path.is_file() and path.stat().st_size == array.nbytes):
            make_folder(self._folder)
            write_file(path, _bytes_of(array))
        return ArrayRecord(dtype=array.dtype.name, shape=list(array.shape), file=name)  # type: ignore[arg-type]

    def remove_unused(self) -> None:
        """Remove the files of arrays that were not kept by this object."""
        if self._folder.is_dir():
            for path in self._folder.iterdir():
                if path.name not in self._used:
                    path.unlink(missing_ok=True)


def array_of_record(record: ArrayRecord, folder: Path) -> NDArray[Any]:
    """Return the array of a record, which may stand in a file of the ``folder``, or raise ValueError."""
    if record.file is None:
        return array_from(record)
    path = folder / f"{record.file}{ENDING}"
    size = math.prod(record.shape) * np.dtype(record.dtype).itemsize
    try:
        if path.stat().st_size != size:
            raise ValueError(f"{path.name} must have {size} bytes, got {path.stat().st_size}")
        check_free(2 * size, path.name)
        found = _array_of(read_input(path, size), record)
    except OSError as problem:
        raise ValueError(f"{path.name} cannot be read: {os_error_reason(problem)}") from problem
    if fingerprint(found) != record.file:
        raise ValueError(f"{path.name} is damaged")
    return found


def _bytes_of(array: NDArray[Any]) -> bytes:
    return array.astype(array.dtype.newbyteorder("<")).tobytes()


def _array_of(content: bytes, record: ArrayRecord) -> NDArray[Any]:
    dtype = np.dtype(record.dtype)
    found = np.frombuffer(content, dtype.newbyteorder("<")).reshape(record.shape)
    return found if sys.byteorder == "little" else found.astype(dtype)
