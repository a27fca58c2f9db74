"""What the grid shows of exact areas: the polygon that the square of a pixel is cut to, and the edge that cuts it."""

import numpy as np

from core.raster.pixel_runs import Raster
from core.records.arrays import Floats
from core.trace import StageTrace
from widgets.grid.overlay import Overlay, SegmentOverlay


def area_overlays(stage: StageTrace, raster: Raster, position: int) -> list[Overlay]:
    """Return the polygon of the step at a position, and the edge that cuts it; nothing where nothing is cut."""
    row, operation = stage.steps.row_at(position)
    if row < 0 or stage.kind_of(row) not in ("cut", "piece") or "polygon" not in stage.columns:
        return []
    columns, (column, line) = stage.columns, stage.pixel[row]
    first_column, first_row, _, _ = raster.bounds
    center = np.array([column - first_column, line - first_row]) + raster.center
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
