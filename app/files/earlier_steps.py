"""Positions in state files of earlier versions: rows of traces had fewer operations then."""

import numpy as np

from core.raster.lines.traits import line_of_kind
from core.trace import StageTrace

FEWER = {
    **dict.fromkeys(("clip.sh-in-out", "clip.wa-crossing", "depth.ray-first"), 2),
    **dict.fromkeys(("clip.wa-ring", "clip.wa-close", "raster.table-level"), 1),
    **dict.fromkeys(("clip.sh-out-in", "depth.ray", "raster.table-edge", "raster.outcodes-cut"), 3),
    **dict.fromkeys((f"raster.{part}" for part in ("top", "top-first", "bottom", "bottom-first")), 2),
    **{"cull.back-stored-normal": 5, "depth.ray-exact": 4, "raster.lane": 2, "raster.active-inside": 2},
    **dict.fromkeys((f"raster.bresenham{name}" for name in ("", "-float", "-lecture")), 3),
    **dict.fromkeys(("raster.dda", "raster.dda-float32", "raster.midpoint", "raster.rectangle"), 3),
    **{"raster.diamond-exit": 3, "raster.wu": 4, "raster.gupta-sproull": 5},
    **dict.fromkeys((f"raster.{name}-start" for name in ("dda", "dda-float32", "midpoint", "rectangle")), 5),
    **{"raster.diamond-exit-start": 4, "raster.wu-start": 6, "raster.gupta-sproull-start": 8},
}
"""Kind of row to its operations in version 2, where they were others; those of a line stand for its other kinds."""
ADDED = {
    "interpolate": frozenset({"factor", "grid"}),
    "shade": frozenset({"lengths", "level", "fraction", "fractions", "power", "specular"}),
}
"""Stage to operations that version 2 did not have in any kind of row."""


def position_now(stage: StageTrace, position: int) -> int:
    """Return the position of a stage's trace that a position of version 2 is: in the same row, or at its end."""
    steps, added = stage.steps, ADDED.get(stage.stage, frozenset())
    counts = np.array([len(steps.operations[kind]) for kind in steps.kinds])
    for number, kind in enumerate(steps.kinds):
        names = [operation.name for operation in steps.operations[kind]]
        counts[number] -= sum(name in added for name in names)
        line = line_of_kind(kind)
        known = (f"{stage.stage}.{name}" for name in (kind, line))
        counts[number] = next((FEWER[name] for name in known if name in FEWER), counts[number])
    starts = np.concatenate([[0], np.cumsum(counts[steps.kind])])
    row = int(np.searchsorted(starts, position, "right")) - 1
    if row >= steps.row_count:
        return steps.count
    first, end = (int(start) for start in steps.starts[row : row + 2])
    return min(first + position - int(starts[row]), end)
