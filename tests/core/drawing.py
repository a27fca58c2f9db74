"""Triangles drawn one by one through the stages of coverage, and small pictures as text (top row first)."""

import numpy as np

from core.coverage.binning import bound
from core.coverage.edges import EdgeFunctions, orient, set_up_edges
from core.coverage.fills import cover
from core.coverage.pixel_runs import Raster, Runs, make_raster
from core.coverage.snapping import place_corners
from core.methods import table

TESTING_FILLS = [name for name in table.names("fill") if "projected" not in table.get("fill", name).needs]
"""Fills that draw any triangle; the others are wrong by design or clip first."""


def edges_of(clip, size, coverage: str = "snapped", fill_rule: str = "shared-edge") -> EdgeFunctions:
    return set_up_edges(place_corners(np.asarray(clip, float), size, coverage), fill_rule)


def runs_of(edges: EdgeFunctions, raster: Raster, fill: str, block_size: int = 8) -> Runs:
    return table.get("fill", fill).function(edges, bound(edges, raster), raster, block_size)


def cover_each(
    clip,
    size,
    fill: str = "hierarchy",
    *,
    block_size: int = 8,
    coverage: str = "snapped",
    fill_rule: str = "shared-edge",
    pixel_center: str = "half",
    region: tuple[int, int, int, int] | None = None,
) -> np.ndarray:
    """Return (T, H, W) int: how often each triangle draws each pixel of the image."""
    edges = edges_of(clip, size, coverage, fill_rule)
    raster = make_raster(size, pixel_center, region)
    count = np.zeros((len(edges), size[1], size[0]), int)
    for fragments, _ in cover(edges, runs_of(edges, raster, fill, block_size), raster):
        np.add.at(count, (fragments.primitive, fragments.row, fragments.column), 1)
    return count


def facing_of(clip, size) -> np.ndarray:
    """Return (T,) 1 front, -1 back, 0 neither, as coverage sees them."""
    return np.sign(orient(place_corners(np.asarray(clip, float), size, "snapped")))


def signed_cover(clip, size, fill: str = "hierarchy") -> np.ndarray:
    """Return (H, W): fronts minus backs over every pixel."""
    return np.einsum("t,trc->rc", facing_of(clip, size), cover_each(clip, size, fill)).astype(int)


def text(values) -> list[str]:
    """Return the rows from the top: ``.`` for 0 or False, ``#`` for True, ``-`` for -1, else the digit."""
    symbols = np.asarray(values)
    if symbols.dtype == bool:
        return ["".join(".#"[int(v)] for v in row) for row in symbols[::-1]]
    return ["".join("-" if v == -1 else "." if v == 0 else str(int(v)) for v in row) for row in symbols[::-1]]


def pixels(drawing: list[str]) -> np.ndarray:
    """Return (H, W) bool of a drawing, row 0 at the bottom."""
    return np.array([[symbol == "#" for symbol in row] for row in reversed(drawing)])
