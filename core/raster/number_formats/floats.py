"""Floating-point edge functions: float64 on snapped corners or not, float32, float16.

The snapped ones are exact (see ``edge_functions``). The others are set up from the homogeneous corners as they are,
which are rounded to the format first; then every product and every sum is rounded again.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from core.methods import method
from core.raster.edges.edge_functions import set_up_per_edge
from core.raster.edges.snapping import snap
from core.raster.number_formats.number_format import Coefficients, CornerPositions, FormatValue, NumberFormat
from core.records.arrays import Flags, Floats


@dataclass(frozen=True)
class Float64Format(NumberFormat):
    """float64; each edge by its ends: both snapped, one (see `core.raster.edges.one_ended`), or none."""

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
