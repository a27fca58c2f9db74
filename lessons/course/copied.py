"""What is open as the state of a lesson, in TOML: what a lecturer pastes into a step."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import degrees
from typing import Any

import numpy as np

from core import Settings, Trace
from core.edits.edit import Edit
from core.records.arrays import Floats
from core.scene import AnyScene, ClipScene, PointLight, Scene
from core.setting_texts import settings_from_texts, settings_record
from core.trace.run_to import END
from core.trace.stage_trace import StageTrace
from lessons.course.quoted import flags_of
from lessons.course.state import changes_of_edits, shaders_of
from lessons.exercises.record import PRIMITIVE_LIMIT
from lessons.lectures.scenes import ALL_SCENES
from lessons.scene_edits import WINDOW_NAMES, window_of_clip

MOVED = 1e-9
"""Pixels, or units, by which numbers may differ that count as the same."""
DIGITS = 12
_NAMED = "only a built-in scene, or up to 64 triangles or segments in the window, can stand in a lesson"


def state_text(
    run: Trace,
    settings: Settings,
    title: str,
    stage: str,
    position: int,
    *,
    pixel: tuple[int, int] | None = None,
    triangle: int | None = None,
    buffer: str = "",
    view: str = "pixels",
    other: Mapping[str, object] | None = None,
    printed: str = "",
    edits: Sequence[Edit] = (),
) -> str:
    """Return the line ``state = {...}`` of a step.

    Parameters
    ----------
    run : Trace
        Of the scene that is open under the ``title``, with the ``settings``.
    other : mapping, optional
        What B does otherwise, by family, where A | B is shown.
    edits : sequence of Edit
        Listings that are edited.

    Raises
    ------
    ValueError
        If a lesson cannot name the scene, or the settings; the message is one sentence.
    """
    scene = run.source.scene
    state, own = _scene_table(scene, title)
    chosen = _differences(settings, own)
    if chosen:
        state["settings"] = chosen
    state["stage"] = stage
    state |= _place(run.stage(stage), position)
    if pixel is not None:
        state["pixel"] = list(pixel)
    if triangle is not None:
        state["triangle"] = triangle
    if buffer:
        state["buffer"] = buffer
    if view not in ("pixels", "compare"):
        state["view"] = view
    if changes := changes_of_edits(edits):
        state["edit"] = [*state.get("edit", ()), *changes]
    elif printed:
        state["printed"] = printed
    elif other:
        state["other"] = {family: str(method) for family, method in other.items()}
    return f"state = {_toml(state)}"


def _differences(settings: Settings, own: Mapping[str, str]) -> dict[str, str]:
    base = settings_record(settings_from_texts(own))
    return {name: str(value) for name, value in settings_record(settings).items() if value != base[name]}


def _place(found: StageTrace, position: int) -> dict[str, str]:
    """Return ``at`` and ``operation``: what has just happened, with its number if it is not the first."""
    row, done = found.steps.row_at(position)
    if row < 0 or position == found.steps.count:
        return {} if row < 0 else {"at": END}
    names = [(name, flags) for name, flags in found.marks.items() if flags[row]]
    column, line = found.pixel[row].tolist()
    if column >= 0 and {"column", "row"} <= found.columns.keys():
        is_here = (found.columns["column"] == column) & (found.columns["row"] == line)
        names.append((f"column == {column} and row == {line}", is_here))
    kind = found.kind_of(row)
    names.append((f'kind == "{kind}"', flags_of(f'kind == "{kind}"', found)))
    name, flags = min(names, key=lambda one: np.count_nonzero(one[1][: row + 1]))
    number = int(np.count_nonzero(flags[: row + 1]))
    place = {"at": name if number == 1 else f"{number}: {name}"}
    operations = found.steps.operations[kind]
    if position != int(found.steps.starts[row + 1]):
        place["operation"] = operations[done].name
    return place


def _scene_table(scene: AnyScene, title: str) -> tuple[dict[str, Any], Mapping[str, str]]:
    """Return what a state says of a scene, and the settings that come with it."""
    known = next((each for each in ALL_SCENES.values() if each.title == title), None)
    if known is not None:
        base = known.make()
        changes = _changes(scene, base)
        if changes is not None:
            size = {} if scene.size == base.size else {"size": list(scene.size)}
            preset, edit = shaders_of(scene, base)
            changes |= ({"shaders": preset} if preset else {}) | ({"edit": edit} if edit else {})
            return {"scene": known.name, **size, **changes}, known.settings
    return {"scene": _typed(scene)}, {}


def _changes(scene: AnyScene, base: AnyScene) -> dict[str, Any] | None:
    """Return what is changed of a built-in scene; ``None``: too much for a state."""
    if isinstance(scene, ClipScene) and isinstance(base, ClipScene):
        return _moved_corners(scene, base)
    if isinstance(scene, Scene) and isinstance(base, Scene):
        return _moved_camera(scene, base)
    return None


def _moved_corners(scene: ClipScene, base: ClipScene) -> dict[str, Any] | None:
    is_same = (
        scene.kind == base.kind
        and scene.clip.shape == base.clip.shape
        and _is_same(scene.attributes, base.attributes)
        and _is_same(scene.clip_region, base.clip_region)
        and _is_same(
            None if scene.table is None else scene.table.depths,
            None if base.table is None else base.table.depths,
        )
    )
    if not is_same:
        return None
    # A raster of another size shows the same corners, so places are those in the window of this size.
    mine, its = (window_of_clip(each.clip, scene.size) for each in (scene, base))
    if not (np.isfinite(mine).all() and np.isfinite(its).all()):
        return {} if np.array_equal(scene.clip, base.clip) else None
    moved: dict[str, list[list[Any]]] = {"corners": [], "depth": [], "w": []}
    for primitive, corner in np.argwhere(np.abs(mine - its).max(axis=-1) > MOVED).tolist():
        new, old = mine[primitive, corner], its[primitive, corner]
        if np.abs(new[:2] - old[:2]).max() > MOVED:
            moved["corners"].append([primitive, corner, *new[:2].tolist()])
        for name in ("depth", "w"):
            axis = WINDOW_NAMES.index(name)
            if abs(new[axis] - old[axis]) > MOVED:
                moved[name].append([primitive, corner, float(new[axis])])
    return {name: rows for name, rows in moved.items() if rows}


def _moved_camera(scene: Scene, base: Scene) -> dict[str, Any] | None:
    is_same = len(scene.meshes) == len(base.meshes) and len(scene.lights) == len(base.lights)
    if not is_same or not all(
        _is_same(mine.positions, its.positions) and vars(mine.material) == vars(its.material)
        for mine, its in zip(scene.meshes, base.meshes, strict=True)
    ):
        return None
    found: dict[str, Any] = {}
    camera = {
        name: _plain(name, value)
        for name, value in vars(scene.camera).items()
        if not np.array_equal(value, getattr(base.camera, name))
    }
    if camera:
        found["camera"] = camera
    lights = []
    for number, (mine, its) in enumerate(zip(scene.lights, base.lights, strict=True)):
        place, its_place = (
            each.position if isinstance(each, PointLight) else each.direction for each in (mine, its)
        )
        if type(mine) is not type(its) or not np.array_equal(mine.color, its.color):
            return None
        if not np.array_equal(place, its_place):
            lights.append([number, *place.tolist()])
    return found | ({"light": lights} if lights else {})


def _plain(name: str, value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return value.tolist()
    return degrees(value) if name == "field_of_view" else value


def _is_same(one: Floats | None, other: Floats | None) -> bool:
    if one is None or other is None:
        return one is other
    return one.shape == other.shape and np.array_equal(one, other, equal_nan=True)


def _typed(scene: AnyScene) -> dict[str, Any]:
    """Return triangles or segments of the window as a table; ValueError where they are more than that."""
    if (
        not isinstance(scene, ClipScene)
        or scene.kind not in ("triangles", "segments")
        or scene.table is not None
    ):
        raise ValueError(_NAMED)
    window = window_of_clip(scene.clip, scene.size)
    is_whole = np.isfinite(window).all() and len(window) <= PRIMITIVE_LIMIT
    if not is_whole or scene.texture is not None or scene.clip_region is not None:
        raise ValueError(_NAMED)
    is_flat = bool(np.allclose(window[..., 2:], (0.5, 1)))
    if scene.kind == "segments" and not is_flat:
        raise ValueError(_NAMED)
    table = {"size": list(scene.size), scene.kind: window[..., : 2 if is_flat else 4].tolist()}
    plain = replace(scene, attributes=None).attributes  # What corners have of which nothing is said.
    if scene.kind == "triangles" and not _is_same(scene.attributes, plain):
        table["values"] = np.asarray(scene.attributes).tolist()
    if scene.background.any():
        table["background"] = scene.background.tolist()
    return table


def _toml(value: Any) -> str:
    """Return a value as TOML on one line."""
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{name} = {_toml(one)}' for name, one in value.items())} }}"
    if isinstance(value, Sequence) and not isinstance(value, str):
        return f"[{', '.join(map(_toml, value))}]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    return f"{value:.{DIGITS}g}" if isinstance(value, float) else str(value)
