"""Edge functions from the inverse of the 3x3 matrix of corners, as many programs take them: float64, by elimination.

The inverse of the matrix with rows (x, y, w) has the edge functions as columns, divided by the determinant, which also
turns them inward. It is the weak way: every coefficient is rounded by a division that the triangle across the edge
does not make, so the two decide a shared edge apart; and near a singular matrix (a triangle seen edge-on, a sliver)
elimination loses what the adjugate keeps. A matrix whose pivot is 0 has no inverse, and nothing is drawn.

References
----------
M. Olano, T. Greer, *Triangle scan conversion using 2D homogeneous coordinates*, 1997 (which takes the adjugate).
G. Golub, C. Van Loan, *Matrix computations*, 3.4: elimination with partial pivoting.
"""

from dataclasses import dataclass

import numpy as np

from core.methods import method
from core.raster.number_formats.number_format import Coefficients, CornerPositions, NumberFormat
from core.records.arrays import Floats


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
