"""Who owns a pixel centre that lies exactly on an edge.

For an inward edge function ``a x + b y + c`` the shared-edge rule moves the point an infinitesimal step right,
then up. Of the two triangles of an edge exactly one contains the moved point, so exactly one draws the pixel. On
array rows that run downwards this very formula is called the top-left rule.

References
----------
M. Zwicker, *Computergrafik*, lecture "Shared edges": "fill pixel only if triangle extends to the right".
"""

import numpy as np

from core.methods import method
from core.records.arrays import Flags, Floats


def owns(a: float, b: float) -> bool:
    """Listing of the shared-edge rule for one edge."""
    if a != 0:
        return a > 0  #: right
    return b > 0  #: up


def owns_always(a: float, b: float) -> bool:
    """Listing of the inclusive rule for one edge."""
    return True  #: always


def owns_never(a: float, b: float) -> bool:
    """Listing of the exclusive rule for one edge."""
    return False  #: never


@method(
    "fill_rule",
    "shared-edge",
    "Left and bottom edges (top-left rule, y up)",
    source="Zwicker 2016, Shared edges; OpenGL 4.6, 14.6.1",
    exact_for="meshes: every pixel on a shared edge is drawn once",
    listing=owns,
)
def shared_edge(a: Floats, b: Floats) -> Flags:
    """Own the left edges and the level bottom edges. (P, 3) coefficients to (P, 3) bool."""
    return np.asarray((a > 0) | ((a == 0) & (b > 0)))


@method(
    "fill_rule",
    "inclusive",
    "Inclusive (>= 0)",
    source="Jubair, Triangle Rasterization 3/7: weights in [0, 1]",
    exact_for="triangles that share no edge",
    breaks_where="pixel centres on a shared edge: they are drawn twice",
    listing=owns_always,
)
def inclusive(a: Floats, b: Floats) -> Flags:
    """Own every edge."""
    return np.ones(np.shape(a), bool)


@method(
    "fill_rule",
    "exclusive",
    "Exclusive (> 0)",
    source="Jubair, Triangle Rasterization 4/7: weights above 0",
    exact_for="triangles without a pixel centre on an edge",
    breaks_where="pixel centres on a shared edge: they are holes",
    listing=owns_never,
)
def exclusive(a: Floats, b: Floats) -> Flags:
    """Own no edge."""
    return np.zeros(np.shape(a), bool)
