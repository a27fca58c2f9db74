"""Edge functions in rounded numbers: floats of four kinds, the inverse of the 3x3 matrix, int32 and int64.

The snapped ones are exact (see ``edge_functions``). The others are set up from the homogeneous corners as they are,
which are rounded to the format first; then every product and every sum is rounded again.

The inverse of the matrix with rows (x, y, w) has the edge functions as columns, divided by the determinant, which also
turns them inward. It is the weak way: every coefficient is rounded by a division that the triangle across the edge
does not make, so the two decide a shared edge apart; and near a singular matrix (a triangle seen edge-on, a sliver)
elimination loses what the adjugate keeps. A matrix whose pivot is 0 has no inverse, and nothing is drawn.

References
----------
M. Olano, T. Greer, *Triangle scan conversion using 2D homogeneous coordinates*, 1997 (which takes the adjugate).
G. Golub, C. Van Loan, *Matrix computations*, 3.4: elimination with partial pivoting.

Corners are 24.8 (or 56.8) fixed-point numbers, and so are a and b; products, c and the value have 16 fractional bits.
Two's complement arithmetic wraps modulo 2^n and forgets nothing else, so a value is right as long as it fits in the
end, whatever its terms did: below 2^15 square pixels in 32 bits, below 2^47 in 64. With all corners and pixels of a
triangle less than D pixels from each other along each axis, a value is below 2 D^2: right for D = 128 in 32 bits, and
for D = 8,388,608 in 64.

There is no w in these numbers: corners must lie in front of the eye (the pipeline clips for it), and a triangle with a
corner too far away for the format is not drawn.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from core.coverage.edges import set_up_per_edge
from core.coverage.number_formats import Coefficients, CornerPositions, FormatValue, NumberFormat
from core.coverage.snapping import SUBPIXELS, snap
from core.methods import method
from core.records.arrays import Flags, Floats

# Floating-point edge functions: float64 on snapped corners or not, float32, float16.


@dataclass(frozen=True)
class Float64Format(NumberFormat):
    """float64; each edge by its ends: both snapped, one (see `core.coverage.snapping`), or none."""

    def place(self, window: Floats) -> tuple[Floats, Flags]:
        """Return positions (P, 3, 2) on the 1/256-pixel grid, if the format snaps, and where (P, 3) bool."""
        return snap(window) if self.corner_kind == "snapped" else super().place(window)

    def set_up(self, corners: CornerPositions) -> Coefficients:
        """Return the edge functions of P triangles, (P, 3) each."""
        return Coefficients(self, *set_up_per_edge(corners))


@dataclass(frozen=True)
class RoundedFormat(NumberFormat):
    """float32 or float16, not snapped."""

    def shown_ends(self, corners: CornerPositions) -> Floats:
        """Return (P, 3, 3) float64 the homogeneous corners, rounded to the format."""
        with np.errstate(over="ignore"):
            rounded: FormatValue = corners.homogeneous.astype(self.held_as)
        shown: Floats = rounded.astype(np.float64)
        return shown

    def spacing(self, size: Floats) -> Floats:
        """Return the units in the last place of numbers of this size, any shape."""
        with np.errstate(over="ignore", invalid="ignore"):
            spacing: FormatValue = np.spacing(size.astype(self.held_as))
        shown: Floats = spacing.astype(np.float64)
        return shown


def rounded_corner(x: float, y: float, w: float, number: type[np.floating[Any]]) -> tuple[Any, Any, Any]:
    """Listing of one corner as a format has it: every component rounded to the nearest ``number``, as numpy.float16."""
    return number(x), number(y), number(w)  #: round


SNAPPED = Float64Format("snapped", np.float64, "snapped", "exact", "float64", suits_spans=True)
FLOAT64 = Float64Format(
    "float64", np.float64, "homogeneous", "exact", "float64", suits_spans=True, bounds_outward=True
)
FLOAT32 = RoundedFormat("float32", np.float32, "rounded", "rounded", "float32", bounds_outward=True)
FLOAT16 = RoundedFormat("float16", np.float16, "rounded", "rounded", "float16", bounds_outward=True)


@method(
    "coverage",
    "snapped",
    "Snapped to 1/256 pixel",
    source="OpenGL 4.6, 14.6.1 and GPU practice; F. Giesen, Triangle rasterization in practice, 2013",
    exact_for="corners within 65,536 pixels, and every shared edge. An edge to a corner behind the eye or farther "
    "away is moved with its snapped end, by at most sqrt(2)/512 pixel, and not turned",
)
def snapped() -> NumberFormat:
    """Return float64 on corners snapped to 1/256 pixel, which holds every number exactly."""
    return SNAPPED


@method(
    "coverage",
    "float64",
    "Not snapped, float64",
    source="M. Olano, T. Greer, Triangle scan conversion using 2D homogeneous coordinates, 1997",
    exact_for="no guaranteed case: each edge is rounded separately",
    breaks_where="pixel centres within rounding of an edge",
)
def float64() -> NumberFormat:
    """Return float64 on the corners as they are."""
    return FLOAT64


@method(
    "coverage",
    "float32",
    "Not snapped, float32",
    source="IEEE 754-2019, binary32; Goldberg 1991",
    exact_for="no guaranteed case: every product and sum has 24 bits",
    breaks_where="pixel centres near a long or distant edge: holes and double hits on shared edges",
)
def float32() -> NumberFormat:
    """Return float32 on the corners as they are."""
    return FLOAT32


@method(
    "coverage",
    "float16",
    "Not snapped, float16",
    source="IEEE 754-2019, binary16; Goldberg 1991",
    exact_for="small whole numbers: products up to 2,048",
    breaks_where="pictures of more than a few dozen pixels. Products above 65,504 become infinite",
)
def float16() -> NumberFormat:
    """Return float16 on the corners as they are."""
    return FLOAT16


# Edge functions from the inverse of the 3x3 matrix of corners, as many programs take them: float64, by
# elimination.


@dataclass(frozen=True)
class InverseFormat(NumberFormat):
    """float64, set up by inverting the matrix of corners."""

    def set_up(self, corners: CornerPositions) -> Coefficients:
        """Return the edge functions of P triangles, (P, 3) each: the columns of the inverse."""
        inverse, determinant = invert(corners.homogeneous)
        return Coefficients(self, inverse[:, 0], inverse[:, 1], inverse[:, 2], determinant)


def invert(matrix: Floats) -> tuple[Floats, Floats]:
    """Invert matrices by elimination with partial pivoting.

    Parameters
    ----------
    matrix : (P, 3, 3) float64

    Returns
    -------
    inverse : (P, 3, 3) float64
        Zero where a pivot is 0; infinite or NaN where a number overflows.
    determinant : (P,) float64
        The product of the pivots, with the sign of the exchanges.
    """
    count = len(matrix)
    rows = np.concatenate([matrix, np.broadcast_to(np.eye(3), (count, 3, 3))], axis=2)
    determinant, is_singular, every = np.ones(count), np.zeros(count, bool), np.arange(count)
    with np.errstate(all="ignore"):
        for step in range(3):
            chosen = step + np.argmax(np.abs(rows[:, step:, step]), axis=1)
            taken = rows[every, chosen]
            rows[every, chosen] = rows[:, step]
            pivot = taken[:, step].copy()
            is_singular |= pivot == 0
            determinant *= np.where(chosen != step, -pivot, pivot)
            rows[:, step] = taken / pivot[:, None]
            for other in range(3):
                if other != step:
                    rows[:, other] -= rows[:, other, step, None] * rows[:, step]
    inverse = np.where(is_singular[:, None, None], 0.0, rows[:, :, 3:])
    return inverse, np.where(is_singular, 0.0, determinant)


def inverse_coefficients(matrix: list[list[float]]) -> tuple[list[list[float]], float]:
    """Listing of the inverse of a matrix (3, 3) of corners (x, y, w), a column an edge, and of its determinant."""
    rows = [list(row) + [float(i == k) for k in range(3)] for i, row in enumerate(matrix)]
    determinant = 1.0
    for step in range(3):
        chosen = max(range(step, 3), key=lambda i: abs(rows[i][step]))
        pivot = rows[chosen][step]
        sign = -1 if chosen != step else 1
        determinant *= sign * pivot  #: determinant
        if pivot == 0:
            return [[0.0] * 3] * 3, 0.0  #: singular
        row = [v / pivot for v in rows[chosen]]
        rows[chosen] = rows[step]
        rows[step] = row
        for other in range(3):
            if other != step:
                factor = rows[other][step]
                rows[other] = [v - factor * u for v, u in zip(rows[other], row, strict=True)]
    return [row[3:] for row in rows], determinant  #: inverse


INVERSE = InverseFormat(
    "inverse", np.float64, "homogeneous", "exact", "float64", bounds_outward=True, divides=True
)


@method(
    "coverage",
    "inverse",
    "3x3 inverse, float64",
    source="Olano and Greer 1997, as often programmed: with the inverse in place of the adjugate",
    exact_for="no guaranteed case: each triangle divides its edges by its own determinant",
    breaks_where="shared edges (holes and double hits), slivers and triangles seen edge-on",
)
def inverse() -> NumberFormat:
    """Return float64 by elimination on the corners as they are."""
    return INVERSE


# Edge functions in whole numbers of 1/256 pixel: int32, which wraps around soon, and int64, which does
# late.


@dataclass(frozen=True)
class FixedFormat(NumberFormat):
    """Whole numbers of 1/256 pixel in two's complement."""

    limit: float = 0.0
    """Pixels that a coordinate may be away from the origin."""

    def place(self, window: Floats) -> tuple[Floats, Flags]:
        """Return positions (P, 3, 2) on the 1/256-pixel grid, and where (P, 3) bool the format has them."""
        return snap(window, self.limit)

    def held_corners(self, corners: CornerPositions) -> tuple[FormatValue, FormatValue, FormatValue]:
        """Return x, y, w (3, P) in 1/256 pixel; w is 1, and all are 0 where a triangle cannot be drawn."""
        is_drawn = corners.is_projected.all(axis=1)
        held = np.where(is_drawn, corners.decided.transpose(2, 1, 0) * SUBPIXELS, 0).astype(self.held_as)
        w = np.broadcast_to(is_drawn, held.shape[1:]).astype(self.held_as)
        return held[0], held[1], w

    def of_pixels(self, position: Floats) -> FormatValue:
        """Return x or y of pixel centres, any shape, in 1/256 pixel."""
        return np.asarray(position * SUBPIXELS).astype(self.held_as)


FIXED_24_8 = FixedFormat(
    "fixed-24.8", np.int32, "snapped", "wrapped", "fixed-16.16", is_whole=True, limit=2.0**23 - 1
).scaled(-8, -16, -16)
INT64 = FixedFormat(
    "int64", np.int64, "snapped", "wrapped", "fixed-48.16", is_whole=True, limit=2.0**55
).scaled(-8, -16, -16)


@method(
    "coverage",
    "fixed-24.8",
    "Fixed point 24.8, int32",
    source="F. Giesen, Triangle rasterization in practice, 2013; fixed-point rasterizers of the 1990s",
    exact_for="triangles and pixels less than 128 pixels apart",
    breaks_where="values of 32,768 square pixels or more: they wrap around, so pixels are lost and others are "
    "drawn outside",
    needs=("projected",),
)
def fixed_24_8() -> NumberFormat:
    """Return whole numbers of 1/256 pixel in 32 bits."""
    return FIXED_24_8


@method(
    "coverage",
    "int64",
    "Whole 1/256 pixels, int64",
    source="F. Giesen, Triangle rasterization in practice, 2013; softpipe and llvmpipe",
    exact_for="triangles and pixels less than 8,388,608 pixels apart",
    breaks_where="values of 2^47 square pixels or more: they wrap around",
    needs=("projected",),
)
def int64() -> NumberFormat:
    """Return whole numbers of 1/256 pixel in 64 bits."""
    return INT64
