"""What the grid shows of polygons: the clip window, crossings and walks of clipping, and what is left to be filled."""

import numpy as np

from app.pages.step.cut_overlays import cross_segments
from app.session.moment import Step
from core import STAGES
from core.records.arrays import Floats
from core.records.rings import Rings, join_rings
from core.stages.clipped_polygons import region_in_pixels
from core.trace import StageTrace
from widgets.grid.overlay import Overlay, SegmentOverlay


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
        found.append(SegmentOverlay("clipped polygon", lines - origin, title="clipped polygon"))
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
