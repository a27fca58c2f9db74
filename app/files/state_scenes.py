"""Scenes in state files: what stands in the file, and what is taken from a mesh file or built-in scene."""

import hmac
import os
import secrets
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import asdict
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from app.files.file_access import (
    FileWriteError,
    NamedFileError,
    NamedFiles,
    OutsideError,
    is_text,
    make_folder,
    read_input,
    shown_name,
    write_file,
)
from app.files.mesh_files import load_meshes
from app.files.mesh_formats.reading import MeshFileError, OutsideMeshError, Report
from app.files.state_arrays import (
    ARRAYS,
    CLIP_ARRAYS,
    EARLIER,
    Fingerprints,
    array_folder,
    array_from,
    array_of,
    array_of_record,
    array_record,
    built_in_fingerprints,
    check_unfolded,
    clip_arrays,
    curves_of,
    fingerprint,
    fingerprints_of,
    may_name_outside,
    remember_file,
    remembered_fingerprints,
    with_deformation,
)
from app.files.state_models import (
    ArrayRecord,
    CameraRecord,
    ClipSceneRecord,
    LightRecord,
    MaterialRecord,
    MeshRecord,
    MeshSceneRecord,
    ProgramRecord,
    SourceRecord,
    TableSceneRecord,
)
from app.files.state_motion import motion_of, motion_record
from core.depth.whole_depths import table_scene
from core.records.depth_table import DepthTable, depths_of_text, text_of_depths
from core.scene import (
    AnyScene,
    Camera,
    ClipScene,
    DirectionalLight,
    Light,
    Material,
    Mesh,
    PointLight,
    Scene,
    Texture,
)
from core.shaders.record import ShaderProgram
from lessons.scenes import make_scene

# Which state files this program wrote on this machine: they carry a mark that nobody else can make.


KEY_NAME = "state.key"
KEY_BYTES = 32


def mark_of(path: Path, allows_outside: bool) -> str:
    """Return the mark of a state that names the mesh file ``path``, absolute; empty where no key can be kept.

    ``allows_outside``: the user has allowed that the mesh file reads files outside its folder.
    """
    key = _key()
    return (
        hmac.digest(key, f"{allows_outside} {path}".encode(errors="surrogateescape"), "sha256").hex()
        if key
        else ""
    )


def is_marked(mark: str, path: Path, allows_outside: bool) -> bool:
    """Return whether a mark is that of `mark_of`, made by this program on this machine."""
    return bool(mark) and hmac.compare_digest(mark.encode(), mark_of(path, allows_outside).encode())


def is_in_own_folder(path: Path) -> bool:
    """Return whether a file lies where the program keeps what was open last."""
    try:
        return path.resolve().is_relative_to(_folder().resolve())
    except FileWriteError:
        return False


def _folder() -> Path:
    from app.files.user_folders import preferences_folder  # Qt takes a moment: not before a mark is needed.

    return preferences_folder()


def _key() -> bytes:
    """Return the secret number of this user, which is made at its first use; empty where it cannot be kept."""
    with suppress(OSError):
        path = _folder() / KEY_NAME
        if not os.path.lexists(path):
            make_folder(path.parent)
            write_file(path, secrets.token_bytes(KEY_BYTES))
            path.chmod(0o600)
        key = read_input(path, KEY_BYTES)
        if len(key) == KEY_BYTES:
            return key
    return b""


Keep = Callable[[NDArray[Any]], ArrayRecord]
"""Returns the record of an array of a mesh, and keeps its bytes elsewhere if it is to be."""


class StateFileError(ValueError):
    """A state file cannot be opened; the message is one sentence."""


class OutsideSourceError(StateFileError):
    """A state file cannot be opened unless a file is read that lies outside its folder."""


@contextmanager
def in_field(name: str) -> Iterator[None]:
    """Turn what a check of the core says into a sentence about a field."""
    try:
        with np.errstate(all="ignore"):
            yield
    except StateFileError:
        raise
    except (ValueError, OverflowError, TypeError) as problem:
        raise StateFileError(f"{name}: {problem}") from problem


# To a record.


def scene_record(
    scene: AnyScene, path: str, folder: Path, keep: Keep = array_record
) -> MeshSceneRecord | ClipSceneRecord | TableSceneRecord:
    """Return the record of a scene.

    Parameters
    ----------
    path : str
        The mesh file that it came from, or empty.
    folder : Path
        Where the state file will stand.
    keep : callable, optional
        Makes the record of an array that has no source.
    """
    if isinstance(scene, ClipScene):
        return _clip_record(scene) if scene.table is None else _table_record(scene.table)
    own = fingerprints_of(scene.meshes)
    source, theirs = _source_of(own, path, folder)
    return MeshSceneRecord(
        kind="meshes",
        source=source,
        meshes=[_mesh_record(mesh, k, own[k], theirs, keep) for k, mesh in enumerate(scene.meshes)],
        camera=CameraRecord(**{name: _plain(value) for name, value in vars(scene.camera).items()}),
        lights=[_light_record(light) for light in scene.lights],
        size=scene.size,
        background=_numbers(scene.background),
        program=None if scene.program is None else _program_record(scene.program),
        motion=motion_record(scene.motion),
    )


def _program_record(program: ShaderProgram) -> ProgramRecord:
    return ProgramRecord(
        vertex=program.vertex,
        fragment=program.fragment,
        uniforms={name: list(values) for name, values in program.values.items()},
        dialect=program.dialect,  # type: ignore[arg-type]
        title=program.name,
    )


def _source_of(own: Fingerprints, path: str, folder: Path) -> tuple[SourceRecord | None, Fingerprints]:
    """Return the source that has most of the arrays of these meshes, and what it has: the file, or else a scene."""
    if path:
        found, source = remembered_fingerprints(path), _file_source(Path(path).resolve(), folder)
        if _shared_count(own, found) and is_text(source.file or ""):
            return source, found
    scenes = built_in_fingerprints()
    name = max(scenes, key=lambda name: _shared_count(own, scenes[name]))
    if _shared_count(own, scenes[name]):
        return SourceRecord(built_in=name), scenes[name]
    return None, ()


def _file_source(path: Path, folder: Path) -> SourceRecord:
    """Return the record of a mesh file, with a mark if opening the state must read outside its folder for it."""
    outside = may_name_outside(path)
    is_marked = outside or not path.is_relative_to(folder)
    return SourceRecord(
        file=_relative(path, folder), allows_outside=outside, mark=mark_of(path, outside) if is_marked else ""
    )


def _shared_count(own: Fingerprints, theirs: Fingerprints) -> int:
    return sum(len(set(a.items()) & set(b.items())) for a, b in zip(own, theirs, strict=False))


def _relative(path: Path, folder: Path) -> str:
    try:
        return Path(os.path.relpath(path, folder)).as_posix()
    except ValueError:  # another drive
        return path.as_posix()


def _mesh_record(mesh: Mesh, index: int, own: dict[str, str], theirs: Fingerprints, keep: Keep) -> MeshRecord:
    there = theirs[index] if index < len(theirs) else {}
    taken = {name: text for name, text in own.items() if there.get(name) == text}
    arrays = {name: array_of(mesh, name) for name in own if name not in taken}
    rows = [_numbers(row) for row in mesh.transform]
    return MeshRecord(
        name=shown_name(mesh.name),
        transform=(rows[0], rows[1], rows[2], rows[3]),
        material=MaterialRecord(**{name: float(value) for name, value in asdict(mesh.material).items()}),
        source_mesh=index if taken else None,
        from_source=taken,
        arrays={name: keep(array) for name, array in arrays.items() if array is not None},
        texture_name=shown_name(mesh.texture.name) if mesh.texture is not None else "texture",
    )


def _light_record(light: Light) -> LightRecord:
    kind: Literal["directional", "point"] = "point"
    vector = light.direction if isinstance(light, DirectionalLight) else light.position
    casts = True
    if isinstance(light, DirectionalLight):
        kind, casts = "directional", light.casts_shadow
    return LightRecord(kind=kind, vector=_numbers(vector), color=_numbers(light.color), casts_shadow=casts)


def _table_record(table: DepthTable) -> TableSceneRecord:
    return TableSceneRecord(
        kind="table",
        patches=[text_of_depths(cells) for cells in table.depths],
        colors=array_record(table.colors),
        test=table.test,  # type: ignore[arg-type]
    )


def _clip_record(scene: ClipScene) -> ClipSceneRecord:
    return ClipSceneRecord(
        kind="clip",
        primitives=scene.kind,  # type: ignore[arg-type]
        **clip_arrays(scene),
        texture_name=shown_name(scene.texture.name) if scene.texture is not None else "texture",
        size=scene.size,
        background=_numbers(scene.background),
        motion=motion_record(scene.motion),
    )


def _numbers(values: NDArray[Any]) -> Any:
    return tuple(float(value) for value in values)


def _plain(value: Any) -> Any:
    """Return a value of a camera as a file keeps it: three numbers, a name, or one number."""
    if isinstance(value, np.ndarray):
        return _numbers(value)
    return value if isinstance(value, str) else float(value)


# From a record.


def scene_from_record(
    record: MeshSceneRecord | ClipSceneRecord | TableSceneRecord,
    state: Path,
    progress: Report | None,
    is_cancelled: Callable[[], bool] | None,
    allows_outside: bool,
) -> tuple[AnyScene, str, tuple[str, ...]]:
    """Return the scene of the file ``state``, the mesh file that it is from (or empty), and warnings of that file.

    Raises StateFileError if a field does not fit, or the source is gone or has changed.
    """
    if isinstance(record, ClipSceneRecord):
        with in_field("scene"):
            check_unfolded(getattr(record, name) for name in CLIP_ARRAYS)
        return _clip_scene(record), "", ()
    if isinstance(record, TableSceneRecord):
        return _table_scene(record), "", ()
    sources, path, warnings = _open_source(record.source, state, progress, is_cancelled, allows_outside)
    with in_field("scene.meshes"):
        check_unfolded(array for mesh in record.meshes for array in mesh.arrays.values())
    meshes = tuple(_mesh(k, mesh, sources, record.source, state) for k, mesh in enumerate(record.meshes))
    with in_field("scene.camera"):
        camera_values: dict[str, Any] = {
            name: np.array(value) if isinstance(value, tuple) else value for name, value in record.camera
        }
        camera = Camera(**camera_values)
    lights = tuple(_light(k, light) for k, light in enumerate(record.lights))
    with in_field("scene.program"):
        program = None if record.program is None else _program(record.program)
    with in_field("scene"):
        background, motion = np.array(record.background), motion_of(record.motion)
        scene = Scene(meshes, camera, lights, record.size, background, program, motion)
    return scene, path, warnings


def _program(record: ProgramRecord) -> ShaderProgram:
    uniforms = tuple((name, tuple(values)) for name, values in record.uniforms.items())
    return ShaderProgram(record.vertex, record.fragment, uniforms, record.dialect, record.title)


def _clip_scene(record: ClipSceneRecord) -> ClipScene:
    arrays: dict[str, Any] = {}
    for name in CLIP_ARRAYS:
        found: ArrayRecord | None = getattr(record, name)
        with in_field(f"scene.{name}"):
            arrays[name] = None if found is None else array_from(found)
    with in_field("scene"):
        pixels = arrays.pop("texture")
        texture = None if pixels is None else Texture(pixels, record.texture_name)
        kept: Any = {"background": np.array(record.background), "motion": motion_of(record.motion)}
        kept["curves"] = curves_of(arrays)
        return ClipScene(kind=record.primitives, size=record.size, texture=texture, **kept, **arrays)


def _table_scene(record: TableSceneRecord) -> ClipScene:
    patches = []
    for number, text in enumerate(record.patches):
        with in_field(f"scene.patches.{number}"):
            patches.append(depths_of_text(text))
            if patches[-1].shape != patches[0].shape:
                raise ValueError("all patches must have as many rows and columns as the first")
    with in_field("scene.colors"):
        colors = array_from(record.colors)
    with in_field("scene"):
        return table_scene(DepthTable(np.array(patches), colors, record.test))


def _open_source(
    source: SourceRecord | None,
    state: Path,
    progress: Report | None,
    is_cancelled: Callable[[], bool] | None,
    allows_outside: bool,
) -> tuple[tuple[Mesh, ...], str, tuple[str, ...]]:
    """Return the meshes of the source, its path if it is a file, and warnings."""
    if source is None:
        return (), "", ()
    if source.built_in is not None:
        with in_field("scene.source.built_in"):
            scene = make_scene(source.built_in)
        if isinstance(scene, ClipScene):
            raise StateFileError(f"scene.source.built_in: {source.built_in} has no meshes")
        return scene.meshes, "", ()
    assert source.file is not None
    path, outside = _find_source(source.file, source, state, allows_outside)
    try:
        loaded = load_meshes(path, progress, is_cancelled, outside)
    except OutsideMeshError as problem:
        raise OutsideSourceError(f"its mesh file cannot be opened: {problem}") from problem
    except MeshFileError as problem:
        raise StateFileError(f"its mesh file is missing or broken: {problem}") from problem
    remember_file(path, loaded.meshes, outside)
    return loaded.meshes, str(path), loaded.warnings


def _find_source(name: str, source: SourceRecord, state: Path, allows_outside: bool) -> tuple[Path, bool]:
    """Return the mesh file ``name`` of a state file, and whether it may itself name files outside its folder.

    What this program has written on this machine names what its user has opened. A state of another program or machine
    names a file in its own folder, or the user has to allow it.
    """
    path = Path(os.path.normpath(state.parent / name))
    if is_marked(source.mark, path, source.allows_outside):
        return path, allows_outside or source.allows_outside
    if not source.mark and is_in_own_folder(state):
        return path, True  # of an earlier version of the program, which wrote no marks
    try:
        return NamedFiles(state, allows_outside).find(name), allows_outside
    except OutsideError as problem:
        raise OutsideSourceError(f"its mesh file {name} {problem}") from problem
    except NamedFileError as problem:
        raise StateFileError(f"its mesh file is missing or broken: {name} {problem}") from problem


def _mesh(
    index: int, record: MeshRecord, sources: tuple[Mesh, ...], source: SourceRecord | None, state: Path
) -> Mesh:
    field = f"scene.meshes.{index}"
    arrays: dict[str, Any] = {}
    for name, expected in record.from_source.items():
        _check_name(field, name)
        theirs = None
        if record.source_mesh is not None and record.source_mesh < len(sources):
            theirs = array_of(sources[record.source_mesh], name)
        is_known = source is not None and source.built_in is not None and expected in EARLIER
        if theirs is None or not (fingerprint(theirs) == expected or is_known):
            place = "its source" if source is None else source.built_in or source.file
            raise StateFileError(
                f"{place} has changed since the state was saved: the {name} of mesh {index} are not the same"
            )
        arrays[name] = theirs
    for name, array in record.arrays.items():
        _check_name(field, name)
        with in_field(f"{field}.arrays.{name}"):
            arrays[name] = array_of_record(array, array_folder(state))
    for name in ("positions", "triangles"):
        if name not in arrays:
            raise StateFileError(f"{field}.arrays.{name} is missing")
    with in_field(field):
        if "texture" in arrays:
            arrays["texture"] = Texture(arrays["texture"], record.texture_name)
        material, arrays = Material(**record.material.model_dump()), with_deformation(arrays)
        return Mesh(transform=np.array(record.transform), material=material, name=record.name, **arrays)


def _check_name(field: str, name: str) -> None:
    if name not in ARRAYS:
        raise StateFileError(f"{field} has an array {name}; those of a mesh are {', '.join(ARRAYS)}")


def _light(index: int, record: LightRecord) -> Light:
    vector, color = np.array(record.vector), np.array(record.color)
    with in_field(f"scene.lights.{index}"):
        if record.kind == "point":
            return PointLight(vector, color)
        return DirectionalLight(vector, color, record.casts_shadow)
