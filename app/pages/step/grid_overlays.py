"""What lies over the pixel grid: the step just done, cuts and polygons, and what a student holds for covered."""

from collections.abc import Collection
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from app.session.moment import Step
from core import STAGES
from core.coverage.snapping import window_position
from core.lines.line_clipping import polygon_window, rectangle_window
from core.records.arrays import Flags, Floats, Integers
from core.records.clip_region import region_in_window
from core.records.primitives import Rings, join_rings
from core.records.steps import Level
from core.stages.primitives import OutlineClip, region_in_pixels
from core.tessellation.scheme import scheme_of
from core.trace import Trace
from core.trace.stage_trace import StageTrace
from core.transform.traced import WINDOW, spaces_reached
from widgets.grid.layers import CellMark, GridBuffer, MaskOverlay, Overlay, SegmentOverlay
from widgets.grid.marks import StepMark, box_lines

if TYPE_CHECKING:
    from lessons.exercises.answers.marked import Pixel, PixelAnswer, Pixels


# What the step just done was about, marked on the pixel grid: pixels and their order, an edge, a corner, a
# box.


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
    if cursor.level <= Level.TRIANGLE and triangle >= 0 and trace.order is None:
        return StepMark(lines=_edges(run, triangle) - origin)
    first = trace.steps.rows_done(trace.steps.back(cursor.position, cursor.level))
    pixels = trace.pixel[first : row + 1]
    pixels = pixels[pixels[:, 0] >= 0]
    if len(pixels) > HIGHLIGHT_LIMIT or (len(pixels) and cursor.level <= Level.TRIANGLE):
        low, high = pixels.min(axis=0) - origin, pixels.max(axis=0) + 1 - origin
        return StepMark(lines=box_lines(*low, *high))
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
        scheme = scheme_of(trace, stage, row)
        if scheme is not None:
            lines, points = (window_position(places, trace.source.scene.size) for places in scheme)
            return lines[np.isfinite(lines).all(axis=(1, 2))], points[np.isfinite(points).all(axis=1)]
        if kind == "cut-halve":
            ends = [columns[name][row] for name in ("chord_start", "chord_end", "control_point")]
            return np.array([ends[:2]]), np.array(ends[2:])
        k, assembled = int(columns["corner"][row]), trace.source.geometry.assembled.triangle
        reached = spaces_reached(trace, stage.stage, position)[assembled == triangle]
        is_placed = k >= 0 and reached[0, k] == WINDOW
        return no_lines, _corners(trace, triangle)[[k]] if is_placed else no_points
    if kind in ("written", "flushed"):
        height, width = trace.source.raster.shape
        first, origin = trace.source.raster.bounds[:2]
        line = int(columns["line"][row])
        top = origin + (height if kind == "flushed" else height - line)
        return box_lines(first, origin + height - 1 - line, first + width, top), no_points
    if "edge_start" in columns:
        return _filled_part(stage, row), no_points
    if "region_edge" in columns:
        return _clipped_edge(trace, stage, row)
    if stage.stage == "bin" and kind != "behind":
        left, low, right, high = (
            float(columns[name][row]) for name in ("column", "row", "column_end", "row_end")
        )
        box = box_lines(left, low, right, high)
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


# What the grid shows of cuts: the polygon that is being clipped, and the square of a pixel that edges cut.


TICK = 0.3
"""Half the size of the cross on a new end, in pixels."""
KEPT_KINDS = ("clip-kept", "outcodes-accept")


def clip_overlays(step: Step) -> list[Overlay]:
    """Return what is known of line clipping after a step, and the clip window of the scene if no lines are clipped."""
    stage, source = step.stage_trace, step.trace.source
    clip: OutlineClip | None = stage.extra.get("outline_clip")
    vertices = source.geometry.vertices
    origin = np.array(step.origin, float)
    if clip is not None:
        corners = clip.lines.window.corners
    elif vertices.clip_region is not None and vertices.rings is None and stage.stage == "raster":
        region = region_in_window(vertices.clip_region, vertices.size)
        corners = (rectangle_window(*region) if region.ndim == 1 else polygon_window(region)).corners
    else:
        return []
    borders = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1) - origin
    regions = SegmentOverlay(
        "clip window", borders, extended=clip is not None, title="clip window", tag="window"
    )
    if clip is None:
        return [regions]
    done = step.rows_done
    columns = stage.columns
    kinds = np.array([kind in KEPT_KINDS for kind in stage.steps.kinds])
    kept = np.flatnonzero(kinds[stage.steps.kind[:done]])
    segments = np.stack([columns["kept_start"][kept], columns["kept_end"][kept]], axis=1)
    crosses = cross_segments(crossing_points(stage, done))
    edges = (*columns["edge"][kept].tolist(), *[-1] * len(crosses))
    lines = np.concatenate([segments, crosses]) - origin
    return [regions, SegmentOverlay("clipped lines", lines, edges, title="clipped lines")]


def crossing_points(stage: StageTrace, done: int) -> Floats:
    """Return where the edge that is clipped at the moment crosses borders, (C, 2), after ``done`` rows."""
    columns = stage.columns
    if not done or stage.pixel[done - 1, 0] >= 0:
        return np.empty((0, 2))
    own = np.flatnonzero(columns["segment"][:done] == columns["segment"][done - 1])
    if "moved_to" in columns:
        points = columns["moved_to"][own]
    else:
        start, end = columns["window_start"][own], columns["window_end"][own]
        points = start + columns["crossing_t"][own, None] * (end - start)
    return np.asarray(points[np.isfinite(points).all(axis=1)])


def cross_segments(points: Floats) -> Floats:
    """Return two short segments for every point (C, 2), as (2 C, 2, 2)."""
    arms = np.array([[[-TICK, -TICK], [TICK, TICK]], [[-TICK, TICK], [TICK, -TICK]]])
    return np.asarray(points[:, None, None] + arms).reshape(-1, 2, 2)


def area_overlays(step: Step) -> list[Overlay]:
    """Return the polygon of a step, and the edge that cuts it; nothing where nothing is cut."""
    stage, (row, operation) = step.stage_trace, step.row_and_operation
    if row < 0 or stage.kind_of(row) not in ("cut", "piece") or "polygon" not in stage.columns:
        return []
    columns = stage.columns
    center = stage.pixel[row] - np.array(step.origin) + step.trace.source.raster.center
    found: list[Overlay] = []
    is_cut = stage.kind_of(row) == "cut"
    if is_cut:
        ends = _on_edge(*(float(columns[name][row]) for name in ("a", "b", "value")))
        edge = (int(columns["edge"][row]),)
        found.append(
            SegmentOverlay("cutting edge", ends[None] + center, edge, extended=True, title="cutting edge")
        )
    # Before the cut is done the polygon is still the one that it is made to.
    polygon = columns["before" if is_cut and operation == 0 else "polygon"][row]
    corners = polygon[np.isfinite(polygon[:, 0])] + center
    sides = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
    found.append(SegmentOverlay("cut polygon", sides, title="cut polygon", is_polygon=True))
    return found


def _on_edge(a: float, b: float, value: float) -> Floats:
    """Return two points (2, 2) of the line a x + b y + value = 0, a pixel from each other."""
    length = np.hypot(a, b)
    foot = -value * np.array([a, b]) / length**2
    along = np.array([b, -a]) / length
    return np.stack([foot - along / 2, foot + along / 2])


# What the grid shows of polygons: the clip window, crossings and walks of clipping, and what is left to be
# filled.


def polygon_overlays(step: Step) -> list[Overlay]:
    """Return what is known of polygon clipping after a step; nothing where there are no polygons."""
    stage, source, geometry = step.stage_trace, step.trace.source, step.trace.source.geometry
    vertices, place = geometry.vertices, STAGES.index(stage.stage)
    if vertices.rings is None or place < STAGES.index("clip"):
        return []
    clip = geometry.polygon_clip
    origin = np.array(step.origin, float)
    found: list[Overlay] = []
    if place <= STAGES.index("raster") and (clip is not None or vertices.clip_region is not None):
        lines = ring_sides(join_rings([region_in_pixels(vertices, source.raster.center)])) - origin
        found.append(SegmentOverlay("clip window", lines, title="clip window", tag="window"))
    if clip is None:
        return found
    lines = clipped_lines(stage, step.rows_done) if stage.stage == "clip" else ring_sides(clip.rings)
    if len(lines):
        # Some of its sides lie on the window's.
        found.append(SegmentOverlay("clipped polygon", lines - origin, title="clipped polygon", width=4.0))
    return found


def ring_sides(rings: Rings) -> Floats:
    """Return (S, 2, 2) the sides of rings."""
    return np.stack([rings.corners, rings.corners[rings.following]], axis=1)


def clipped_lines(stage: StageTrace, done: int) -> Floats:
    """Return (L, 2, 2): what the method has kept after ``done`` rows, and crosses where edges cross."""
    columns = stage.columns
    if not done:
        return np.empty((0, 2, 2))
    points, starts, ends = (columns[name][:done] for name in ("point", "start", "end"))
    if "wa-ring" in stage.steps.kinds:
        # The walks, and crosses on the crossings that lie on none yet.
        walked = columns["result_ring"][:done] >= 0
        is_crossing = np.isfinite(columns["t"][:done])
        crosses = cross_segments(points[is_crossing])
        steps = np.flatnonzero(walked & np.isfinite(starts[:, 0]))
        return np.concatenate([np.stack([starts[steps], ends[steps]], axis=1), crosses])
    # Of Sutherland-Hodgman the ring as this side of the window leaves it.
    same = (columns["ring"][:done] == columns["ring"][done - 1]) & (
        columns["region_edge"][:done] == columns["region_edge"][done - 1]
    )
    # Rows of one side stand together; an earlier polygon may have the same numbers.
    first = int(np.flatnonzero(~same)[-1]) + 1 if not same.all() else 0
    own = slice(first, done)
    is_first_in, is_last_in = columns["start_side"][own] >= 0, columns["end_side"][own] >= 0
    kept = np.flatnonzero(is_first_in | is_last_in)
    start = np.where(is_first_in[:, None], starts[own], points[own])[kept]
    end = np.where(is_last_in[:, None], ends[own], points[own])[kept]
    made = points[own][np.isfinite(points[own, 0])]
    return np.concatenate([np.stack([start, end], axis=1), cross_segments(made)])


# What a student holds for covered, and how the grid shows it: nothing of the answer but what was asked for.


@dataclass(frozen=True, eq=False)
class Guesses:
    """Pixels that are held for covered, and those that are."""

    clicked: "Pixels"
    """Pixels that were clicked."""
    answer: "PixelAnswer"
    """Which pixels are covered."""
    is_revealed: bool = False
    """Whether the pixels that were not clicked are shown too."""

    def _mask(self, pixels: Collection["Pixel"]) -> Flags:
        columns, rows = self.answer.size
        mask = np.zeros((rows, columns), bool)
        if pixels:
            column, row = np.array(sorted(pixels)).T
            mask[row, column] = True
        return mask

    @property
    def hidden(self) -> Flags | None:
        """(H, W) bool, the pixels that are not judged yet; ``None``: all are."""
        return None if self.is_revealed else ~self._mask(self.clicked)

    def buffer(self, coverage: GridBuffer) -> GridBuffer:
        """Return the coverage buffer with what is judged, and nothing else, in its values."""
        covered, hidden = self._mask(self.answer.reference), self.hidden
        judged = np.ones_like(covered) if hidden is None else ~hidden
        return replace(coverage, kind="bool", range=None, values=covered & judged, known=judged)

    def overlays(self) -> list[Overlay]:
        """Return a mark for each outcome; what is missing shows when the answer is revealed."""
        marks = self.answer.check(self.clicked).marks
        missing = marks["missing"] if self.is_revealed else frozenset()
        return [
            MaskOverlay("right", CellMark.RIGHT, self._mask(marks["right"])),
            MaskOverlay("extra", CellMark.EXTRA, self._mask(marks["extra"])),
            MaskOverlay("missing", CellMark.MISSING, self._mask(missing)),
        ]
