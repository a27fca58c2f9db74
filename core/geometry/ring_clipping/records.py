"""What methods that clip polygons share: what is left of a polygon, the steps that made it, and no clipping at all."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from core.methods import method
from core.records.arrays import Floats

Row = dict[str, Any]
"""``kind``, and the numbers of a step by their names in `COLUMNS`."""

COLUMNS: Mapping[str, Any] = {
    "of_region": False,
    "ring": -1,
    "edge": -1,
    "region_ring": -1,
    "region_edge": -1,
    "is_hole": False,
    "is_turned": False,
    "t": float("nan"),
    "region_t": float("nan"),
    "point": (float("nan"), float("nan")),
    "start": (float("nan"), float("nan")),
    "end": (float("nan"), float("nan")),
    "region_start": (float("nan"), float("nan")),
    "region_end": (float("nan"), float("nan")),
    "start_side": float("nan"),
    "end_side": float("nan"),
    "is_entering": False,
    "is_kept": False,
    "node": -1,
    "next_node": -1,
    "crossing": -1,
    "on_region": False,
    "result_ring": -1,
    "corner_count": -1,
}
"""The numbers of a row, and what stands where it has none."""


@dataclass(frozen=True)
class RingClipTraits:
    """What else is known of a method."""

    listings: Mapping[str, Callable[..., Any]]
    """Kinds of rows with a listing of their own."""


@dataclass(frozen=True, eq=False)
class ClippedPolygon:
    """What is left of one polygon."""

    rings: Sequence[Floats]
    """Rings (K, 2) float64, in pixels."""
    rows: Sequence[Row]
    """Every step, in order."""


@method(
    "polygon_clipping",
    "none",
    "None (scissoring)",
    source="Pellacini, polygon clipping: only clip when necessary",
    exact_for="every polygon in the raster; it ignores the clip window of the scene",
)
def no_polygon_clipping(rings: Sequence[Floats], region: Sequence[Floats]) -> ClippedPolygon:
    """Leave the rings (K, 2) of a polygon as they are."""
    return ClippedPolygon(rings, ())
