"""What the grid shows of cuts: the polygon that is being clipped, and the square of a pixel that edges cut."""

import numpy as np

from app.session.moment import Step
from core.geometry.line_clipping.records import polygon_window, rectangle_window
from core.records.arrays import Floats
from core.records.clip_region import region_in_window
from core.stages.clipped_outlines import OutlineClip
from core.trace import StageTrace
from widgets.grid.overlay import Overlay, SegmentOverlay

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
