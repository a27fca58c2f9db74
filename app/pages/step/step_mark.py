"""What the step just done was about, marked on the pixel grid: pixels and their order, an edge, a corner, a box."""

import numpy as np

from app.session.moment import Step
from core.records.arrays import Floats, Integers
from core.records.steps import Level
from core.trace import StageTrace, Trace
from core.trace.geometry_progress import WINDOW, spaces_reached
from widgets.grid.marks import StepMark

HIGHLIGHT_LIMIT = 4096
"""Pixels of a step that are outlined."""
NEAREST_W = 1e-3
"""An edge is marked up to this part of the largest w of its triangle: behind the eye it has no place."""
TRAIL = 8
"""Pixels looked at last that the trail goes through."""


def step_mark(step: Step) -> StepMark:
    """Return the mark of the step just done, in the grid's columns and rows."""
    run, trace, cursor, triangle = step.trace, step.stage_trace, step.cursor, step.triangle
    row, operation = step.row_and_operation
    if row < 0:
        return StepMark()
    origin = np.array(step.origin)
    if cursor.level <= Level.TRIANGLE and triangle >= 0:
        return StepMark(lines=_edges(run, triangle) - origin)
    first = trace.steps.rows_done(trace.steps.back(cursor.position, cursor.level))
    pixels = trace.pixel[first : row + 1]
    pixels = pixels[pixels[:, 0] >= 0]
    if len(pixels) > HIGHLIGHT_LIMIT or (len(pixels) and cursor.level <= Level.TRIANGLE):
        low, high = pixels.min(axis=0) - origin, pixels.max(axis=0) + 1 - origin
        return StepMark(lines=_box(*low, *high))
    if len(pixels):
        return StepMark(pixels - origin, trail=_trail(trace, row) - origin)
    lines, points = _geometry_mark(run, trace, row, operation, cursor.position)
    return StepMark(lines=lines - origin, points=points - origin)


def _trail(trace: StageTrace, row: int) -> Integers:
    """Return (K, 2) the pixels that were looked at last, the one of ``row`` at the end; a pixel counts once."""
    earlier = trace.pixel[max(row + 1 - 8 * TRAIL, 0) : row + 1]
    earlier = earlier[earlier[:, 0] >= 0]
    is_new = np.append(True, (earlier[1:] != earlier[:-1]).any(axis=1))[: len(earlier)]
    found: Integers = earlier[is_new][-TRAIL:]
    return found


def _geometry_mark(
    trace: Trace, stage: StageTrace, row: int, operation: int, position: int
) -> tuple[Floats, Floats]:
    """Return lines (L, 2, 2) and points (P, 2) in the window of a step that is about no pixel."""
    no_lines, no_points = np.empty((0, 2, 2)), np.empty((0, 2))
    columns, kind, triangle = stage.columns, stage.kind_of(row), int(stage.triangle[row])
    if stage.stage == "transform":
        reached = spaces_reached(trace, stage.stage, position).ravel()
        rows = len(stage.triangle) // max(len(reached), 1)
        is_placed = reached[row // rows] == WINDOW
        return no_lines, _corners(trace, triangle)[[int(columns["corner"][row])]] if is_placed else no_points
    if "edge_start" in columns:
        return _filled_part(stage, row), no_points
    if "region_edge" in columns:
        return _clipped_edge(trace, stage, row)
    if stage.stage == "bin" and kind != "behind":
        left, low, right, high = (
            float(columns[name][row]) for name in ("column", "row", "column_end", "row_end")
        )
        box = _box(left, low, right, high)
        # After the first half of a box only its lower left corner is known.
        is_half = stage.steps.operations[kind][operation].name == "low" and kind != "block"
        return box[[0, 3]] if is_half else box, no_points
    if triangle < 0:
        return no_lines, no_points
    edges = _edges(trace, triangle)
    if stage.stage == "edges" and kind in ("snapped", "homogeneous", "rounded"):
        k = int(columns["corner"][row])
        corner = _corners(trace, triangle)[[k]]
        # A corner behind the eye has no place: the edges that end there have.
        is_placed = np.isfinite(corner).all()
        return (no_lines, corner) if is_placed else (edges[[(k + 1) % 3, (k + 2) % 3]], no_points)
    if stage.stage == "edges" and kind.endswith("edge"):
        edge = edges[[int(columns["edge"][row])]]
        return edge if np.isfinite(edge).all() else edges, no_points
    return edges, no_points


def _filled_part(stage: StageTrace, row: int) -> Floats:
    """Return (1, 2, 2) the edge, or the interval between two edges, that a step of a polygon's fill is about."""
    columns = stage.columns
    if not np.isfinite(columns["interval_left"][row]):
        return np.stack([columns["lower"][row], columns["upper"][row]])[None]
    y = float(columns["row"][row]) + float(np.asarray(stage.constants["center"]))
    return np.array([[[columns["interval_left"][row], y], [columns["interval_right"][row], y]]])


def _clipped_edge(trace: Trace, stage: StageTrace, row: int) -> tuple[Floats, Floats]:
    """Return what a step of polygon clipping is about: the ring, or the edges and the place that it has found."""
    columns, clip = stage.columns, trace.source.geometry.polygon_clip
    assert clip is not None
    if stage.kind_of(row) in ("wa-ring", "wa-whole"):
        polygon = int(np.flatnonzero(trace.source.geometry.primitives.triangle == stage.triangle[row])[0])
        rings = clip.region if columns["of_region"][row] else clip.whole.rings_of(polygon)
        corners = rings[int(columns["ring"][row])]
        return np.stack([corners, np.roll(corners, -1, axis=0)], axis=1), np.empty((0, 2))
    ends = [
        np.stack([columns[f"{which}start"][row], columns[f"{which}end"][row]]) for which in ("", "region_")
    ]
    points = columns["point"][row][None]
    lines = np.stack(ends)
    return lines[np.isfinite(lines).all(axis=(1, 2))], points[np.isfinite(points).all(axis=1)]


def _box(left: float, low: float, right: float, high: float) -> Floats:
    """Return (4, 2, 2) the sides of a box: bottom, right, top, left."""
    corners = np.array([[left, low], [right, low], [right, high], [left, high]], float)
    return np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)


def _corners(trace: Trace, triangle: int) -> Floats:
    """Return (C, 2) window positions of a primitive's corners, NaN where w <= 0."""
    vertices = trace.source.geometry.vertices
    corners = vertices.corners_of(triangle)
    return np.where(vertices.clip[corners, 3:] > 0, vertices.window[corners, :2], np.nan)


def _edges(trace: Trace, triangle: int) -> Floats:
    """Return (S, 2, 2) the sides of a primitive in the window, see ``VertexStage.sides``, cut off before the eye."""
    vertices = trace.source.geometry.vertices
    ends = vertices.clip[vertices.corners_of(triangle)][vertices.sides]
    w = ends[..., 3]
    least = NEAREST_W * np.abs(w).max()
    with np.errstate(divide="ignore", invalid="ignore"):
        along = np.where(w < least, (least - w) / (w[:, ::-1] - w), 0.0)[..., None]
        seen = ends + along * (ends[:, ::-1] - ends)
        window = (seen[..., :2] / seen[..., 3:] + 1) * (np.array(trace.source.scene.size) / 2)
    return np.where((w.max(axis=1) > least)[:, None, None], window, np.nan)
