"""The referee of coverage: which pixels a triangle covers in rational arithmetic, and what a method makes of them.

Two questions are asked apart. ``snapped=False``: which pixels does the triangle cover as it was given?
``snapped=True``: which ones on the lattice of 1/256 pixel, where GPUs decide? Snapping itself moves edges by up to
2^-9 pixels.
"""

from dataclasses import dataclass

import numpy as np

from core.methods import table
from core.raster.binning import bound
from core.raster.coverage import cover
from core.raster.edges.edge_functions import EdgeFunctions, set_up_edges
from core.raster.edges.snapping import place_corners
from core.raster.fills.tested import effective_fill
from core.raster.number_formats.exact import EXACT_SNAPPED
from core.raster.pixel_runs import Raster, Runs, make_raster
from core.records.arrays import Flags, Floats, Integers


@dataclass(frozen=True, eq=False)
class Misclassified:
    """Pixels of T triangles that a method decides otherwise than rational arithmetic."""

    missing: Integers
    """(T,) int64, covered and not drawn."""
    extra: Integers
    """(T,) int64, drawn and not covered, or drawn again."""
    covered: Integers
    """(T,) int64, covered in rational arithmetic."""
    tested: int
    """Pixels that the method looked at."""
    first: tuple[int, int, int] | None
    """Triangle, column and row of the first of them in drawing order, rows upwards; ``None``: there is none."""

    @property
    def count(self) -> int:
        """Misclassified pixels of all triangles."""
        return int(self.missing.sum() + self.extra.sum())

    @property
    def per_million(self) -> float:
        """Misclassified pixels for every million that are covered; 0 where none is covered and none drawn."""
        return 1e6 * self.count / max(int(self.covered.sum()), 1) if self.count else 0.0


def exact_coverage(
    clip: Floats,
    size: tuple[int, int],
    fill_rule: str = "shared-edge",
    pixel_center: str = "half",
    *,
    snapped: bool = False,
    region: tuple[int, int, int, int] | None = None,
) -> Flags:
    """Return which pixels each triangle covers, each for itself, decided in whole numbers of any length.

    Parameters
    ----------
    clip : (T, 3, 4) float64
        Corners in clip space, any signs of w.
    size : (width, height)
        Of the image in pixels.
    fill_rule, pixel_center : str
        Methods of these families.
    snapped : bool
        Corners that have a place on the lattice of 1/256 pixel are moved there first.
    region : (column, row, columns, rows), optional
        Pixels that are wanted; the whole image by default.

    Returns
    -------
    (T, H, W) bool
        Row 0 at the bottom.

    References
    ----------
    J. R. Shewchuk, *Adaptive precision floating-point arithmetic and fast robust geometric predicates*, 1997.
    """
    raster = make_raster(size, pixel_center, region)
    edges = _exact_edges(clip, size, fill_rule, snapped)
    fill = table.get("fill", "bounding-box").function
    runs = fill(edges, bound(edges, raster), raster, 1)
    return _cover_count(edges, runs, raster)[0] > 0


def misclassified(
    clip: Floats,
    size: tuple[int, int],
    coverage: str,
    fill: str = "bounding-box",
    fill_rule: str = "shared-edge",
    pixel_center: str = "half",
    *,
    snapped: bool = False,
    block_size: int = 8,
) -> Misclassified:
    """Compare the pixels that a coverage method and a fill draw of triangles with those of `exact_coverage`.

    Parameters
    ----------
    clip : (T, 3, 4) float64
        Nothing is clipped: whole numbers (``fixed-24.8``, ``int64``) draw nothing of a triangle that reaches behind the
        eye.
    size : (width, height)
    coverage, fill, fill_rule, pixel_center : str
        Methods of these families; spans are replaced where they do not suit the numbers, as in every picture.
    snapped : bool
        See `exact_coverage`.
    block_size : int
    """
    raster = make_raster(size, pixel_center)
    edges = set_up_edges(place_corners(clip, size, coverage), fill_rule)
    function = table.get("fill", effective_fill(fill, coverage)).function
    drawn, tested = _cover_count(edges, function(edges, bound(edges, raster), raster, block_size), raster)
    wanted = exact_coverage(clip, size, fill_rule, pixel_center, snapped=snapped).astype(np.int64)
    missing, extra = np.maximum(wanted - drawn, 0), np.maximum(drawn - wanted, 0)
    places = np.flatnonzero(drawn != wanted)
    first = None
    if len(places):
        triangle, row, column = np.unravel_index(places[0], drawn.shape)
        first = int(triangle), int(column), int(row)
    by_triangle = (missing.sum(axis=(1, 2)), extra.sum(axis=(1, 2)), wanted.sum(axis=(1, 2)))
    return Misclassified(*by_triangle, tested, first)


def _exact_edges(clip: Floats, size: tuple[int, int], fill_rule: str, snapped: bool) -> EdgeFunctions:
    if not snapped:
        return set_up_edges(place_corners(clip, size, "exact"), fill_rule)
    corners = place_corners(clip, size, "snapped")
    numbers, a, b, c, doubled_area = EXACT_SNAPPED.set_up(corners)
    owns_tie = table.get("fill_rule", fill_rule).function(a, b)
    return EdgeFunctions(a, b, c, owns_tie, corners, doubled_area, numbers)


def _cover_count(edges: EdgeFunctions, runs: Runs, raster: Raster) -> tuple[Integers, int]:
    """Return how often each triangle draws each pixel of the raster, (T, H, W), and how many pixels were tested."""
    count, tested = np.zeros((len(edges), raster.shape[0] * raster.shape[1]), np.int64), 0
    for fragments, batch in cover(edges, runs, raster):
        np.add.at(count, (fragments.primitive, raster.index(fragments.column, fragments.row)), 1)
        tested += batch
    return count.reshape(len(edges), *raster.shape), tested
