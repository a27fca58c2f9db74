"""What the step just done was about, marked in the 3D view: corners as they move on, triangles and how they face."""

from dataclasses import dataclass, field

import numpy as np

from app.session.moment import Moment
from app.views.view_space import ViewSpace
from core.geometry.culling import KEPT, REASONS
from core.records.arrays import Floats, Integers
from core.records.nouns import nouns
from core.stages.declared import GEOMETRY_STAGES, STAGES
from core.trace.geometry_progress import SPACES, is_dropped, spaces_reached

MOST_MARKS = 200
"""Corners or arrows that are marked: of more, a part would look like a shape of its own."""
ARROW = 0.16
"""Length of an arrow, as a part of the view's radius."""


@dataclass(frozen=True, eq=False)
class SpaceMark:
    """A line through points of the space that is shown, with a mark and a name at its last point."""

    points: Floats = field(repr=False)
    """(N, 3) float64."""
    ink: str
    label: str = ""
    shape: str = "none"
    """As of ``widgets.space.scene_view.SceneMark``."""


def step_marks(moment: Moment, space: ViewSpace) -> list[SpaceMark]:
    """Return the marks of the step just done, the present item last and in the accent."""
    stage, position = moment.cursor.stage, moment.cursor.position
    if stage == "transform":
        return _corner_marks(moment, space, position)
    marks = _point_marks(moment, space)
    if stage == "cull":
        return marks + _facing_marks(moment, space, position)
    if moment.row < 0 or (stage not in GEOMETRY_STAGES and stage != "bin"):
        return marks
    return marks + _outlines(space, moment.triangle)


def is_scene_lit(moment: Moment) -> bool:
    """Return whether every fragment has its colour, so that the scene's lights are no longer future."""
    stage = moment.cursor.stage
    if stage != "shade":
        return STAGES.index(stage) > STAGES.index("shade")
    return moment.is_stage_done


def is_scene_asked(moment: Moment) -> bool:
    """Return whether an exercise asks for what the lights, the nearest surfaces or the blending make of the scene."""
    return moment.is_asked_about and STAGES.index(moment.cursor.stage) >= STAGES.index("shade")


def _point_marks(moment: Moment, space: ViewSpace) -> list[SpaceMark]:
    """Return a disc on every point that has not been dropped: the picture has a single pixel of it."""
    assembled, cursor = moment.trace.source.geometry.assembled.triangle, moment.cursor
    if moment.document.scene.corner_count != 1 or len(assembled) > MOST_MARKS:
        return []
    left = assembled[~is_dropped(moment.trace, cursor.stage, cursor.position)]
    return [SpaceMark(space.corners(number)[:1], "text", shape="disc") for number in left.tolist()]


def _corner_marks(moment: Moment, space: ViewSpace, position: int) -> list[SpaceMark]:
    """Return a dot on every corner that has left its first space, and a ring on the one of the step."""
    source, trace = moment.trace.source, moment.stage_trace
    triangles = source.geometry.assembled.triangle
    reached = spaces_reached(moment.trace, "transform", position)
    started = reached > spaces_reached(moment.trace, "transform", 0)
    marks = []
    numbers, corners = np.nonzero(started)
    vertices = source.geometry.vertices.corners_of(triangles[numbers])[np.arange(len(numbers)), corners]
    _, once = np.unique(vertices, return_index=True)
    for place in once.tolist() if len(once) <= MOST_MARKS else []:
        point = space.corners(int(triangles[numbers[place]]))[corners[place]]
        marks.append(SpaceMark(point[None], "text", shape="disc"))
    row, _ = trace.steps.row_at(position)
    if row >= 0:
        triangle, corner = int(trace.triangle[row]), int(trace.columns["corner"][row])
        number = int(np.flatnonzero(triangles == triangle)[0])
        label = f"vertex {corner}: {SPACES[reached[number, corner]]} space"
        marks.append(SpaceMark(space.corners(triangle)[corner][None], "accent", label, "ring"))
    return marks


def _facing_marks(moment: Moment, space: ViewSpace, position: int) -> list[SpaceMark]:
    """Return an arrow on every kept triangle, and outline and verdict of the one of the step.

    An arrow stands on the front of a triangle. Its end is a disc where the camera sees the front, else a cross.
    """
    source, trace = moment.trace.source, moment.stage_trace
    culled, triangles = source.geometry.culled, source.geometry.assembled.triangle
    row, done = trace.steps.row_at(position)
    tested = int(np.searchsorted(trace.steps.triangle_ends, trace.steps.rows_done(position), "right"))
    current = -1 if row < 0 else int(np.flatnonzero(triangles == trace.triangle[row])[0])
    kept = np.flatnonzero(culled.verdict[: min(tested, len(triangles))] == KEPT)
    has_arrows = len(kept) <= MOST_MARKS and source.scene.corner_count == 3
    kept = kept[kept != current]
    marks = _arrows(space, triangles[kept], culled.side[kept], "text") if has_arrows else []
    if current < 0:
        return marks
    triangle, kind = int(triangles[current]), trace.kind_of(row)
    name = f"{nouns(source.scene.corner_count).one} {triangle}"
    marks += _outlines(space, triangle)
    facing = float(culled.side[current])
    what = f"area {facing / 2:+.4g}" if culled.sight is None else f"N · V {-facing:+.4g}"
    operations = [operation.name for operation in trace.steps.operations.get(kind, ())]
    is_known = culled.sight is None or kind == "kept" or "product" in operations[: done + 1]
    side = f"front, {what}" if facing > 0 else f"back, {what}"
    if is_dropped(moment.trace, "cull", position)[current]:
        label = f"{name}: dropped, {REASONS[int(culled.verdict[current])].replace('-', ' ')}"
        marks.append(SpaceMark(space.corners(triangle).mean(axis=0)[None], "accent", label, "cross"))
    elif not is_known:
        marks.append(SpaceMark(space.corners(triangle).mean(axis=0)[None], "accent", name))
    elif kind not in ("behind", "plane") and source.scene.corner_count == 3:
        at = slice(current, current + 1)
        marks += _arrows(space, triangles[at], culled.side[at], "accent", f"{name}: {side}")
    else:
        place = "behind the eye" if kind == "behind" else f"outside the {trace.columns['plane'][row]} plane"
        what = "kept" if kind == "kept" else f"not {place}"
        label, shape = f"{name}: {what}", "ring" if source.scene.corner_count == 1 else "none"
        marks.append(SpaceMark(space.corners(triangle).mean(axis=0)[None], "accent", label, shape))
    return marks


def _outlines(space: ViewSpace, triangle: int) -> list[SpaceMark]:
    rings = [space.corners(triangle)[ring] for ring in space.vertices.ring_slices]
    return [SpaceMark(np.concatenate([ring, ring[:1]]), "accent") for ring in rings]


def _arrows(
    space: ViewSpace, triangles: Integers, facing: Floats, ink: str, label: str = ""
) -> list[SpaceMark]:
    if not len(triangles):
        return []
    corners = np.stack([space.corners(triangle) for triangle in triangles.tolist()])
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    foot = corners.mean(axis=1)
    tip = foot + normal * (ARROW * space.radius / np.where(length > 0, length, np.inf))
    shapes = ["disc" if side > 0 else "cross" for side in facing.tolist()]
    return [
        SpaceMark(ends, ink, label, shape)
        for ends, shape in zip(np.stack([foot, tip], axis=1), shapes, strict=True)
    ]
