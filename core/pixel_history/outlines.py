"""The links of a wireframe: on which edge of its triangle a fragment lies, or how far the nearest edge is."""

from typing import Any

import numpy as np

from core.pixel_history.candidates import PixelCandidates
from core.pixel_history.records import Link
from core.raster.lines.wireframe import LineFragments
from core.records.arrays import Floats


def outline_link(candidates: PixelCandidates, place: int) -> Link:
    """Return which edge the fragment ``place`` lies on, and how far its centre is from the exact line."""
    fragments, outlines = candidates.fragments, candidates.geometry.outlines
    assert isinstance(fragments, LineFragments)
    assert outlines is not None
    segment = int(fragments.segment[place])
    away = float(distance_to_segments(outlines.window[segment : segment + 1], *candidates.center)[0])
    return Link(
        "raster", "on-outline", {"edge": int(outlines.edge[segment]), "distance": away, "segment": segment}
    )


def missed_outline(candidates: PixelCandidates, k: int, values: dict[str, Any]) -> Link:
    """Return the nearest edge of candidate ``k``, which is not drawn at this pixel."""
    outlines = candidates.geometry.outlines
    assert outlines is not None
    segments = np.flatnonzero(outlines.primitive == candidates.primitive[k])
    if not len(segments):
        return Link("raster", "no-outline", values)
    away = distance_to_segments(outlines.window[segments], *candidates.center)
    nearest = int(np.argmin(away))
    edge = int(outlines.edge[segments[nearest]])
    return Link("raster", "off-outline", values | {"edge": edge, "distance": -float(away[nearest])})


def distance_to_segments(window: Floats, x: float, y: float) -> Floats:
    """Return the distance (L,) of a point from segments (L, 2, 2), in pixels."""
    start, along = window[:, 0], window[:, 1] - window[:, 0]
    offset = np.array([x, y]) - start
    squared = along[:, 0] * along[:, 0] + along[:, 1] * along[:, 1]
    product = offset[:, 0] * along[:, 0] + offset[:, 1] * along[:, 1]
    t = np.clip(product / np.where(squared > 0, squared, 1.0), 0.0, 1.0)
    rest = offset - t[:, None] * along
    return np.asarray(np.hypot(rest[:, 0], rest[:, 1]))
