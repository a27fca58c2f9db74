"""The family ``coverage``: the default, the other floats, the inverse, whole numbers, and the referee."""

from core.methods import method
from core.raster.exact_format import EXACT
from core.raster.float_formats import FLOAT16, FLOAT32, FLOAT64, SNAPPED
from core.raster.integer_formats import FIXED_24_8, INT64
from core.raster.inverse_format import INVERSE
from core.raster.number_format import NumberFormat


@method(
    "coverage",
    "snapped",
    "Snapped to 1/256 pixel",
    source="OpenGL 4.6, 14.6.1 and GPU practice; F. Giesen, Triangle rasterization in practice, 2013",
    exact_for="corners within 65,536 pixels; every shared edge",
)
def snapped() -> NumberFormat:
    """Return float64 on corners snapped to 1/256 pixel, which holds every number exactly."""
    return SNAPPED


@method(
    "coverage",
    "float64",
    "Not snapped, float64",
    source="M. Olano, T. Greer, Triangle scan conversion using 2D homogeneous coordinates, 1997",
    exact_for="no promise: each edge is rounded by itself",
    breaks_where="a pixel centre within rounding of an edge",
)
def float64() -> NumberFormat:
    """Return float64 on the corners as they are."""
    return FLOAT64


@method(
    "coverage",
    "float32",
    "Not snapped, float32",
    source="IEEE 754-2019, binary32; Goldberg 1991",
    exact_for="no promise: 24 bits for every product and sum",
    breaks_where="a pixel centre near an edge that is long or far away: holes and double hits on shared edges",
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
    breaks_where="images of more than a few dozen pixels; products above 65,504 are infinite",
)
def float16() -> NumberFormat:
    """Return float16 on the corners as they are."""
    return FLOAT16


@method(
    "coverage",
    "inverse",
    "3x3 inverse, float64",
    source="Olano and Greer 1997, as often programmed: with the inverse in place of the adjugate",
    exact_for="no promise: each triangle divides its edges by a determinant of its own",
    breaks_where="shared edges (holes and double hits), slivers and triangles seen edge-on",
)
def inverse() -> NumberFormat:
    """Return float64 by elimination on the corners as they are."""
    return INVERSE


@method(
    "coverage",
    "fixed-24.8",
    "Fixed point 24.8, int32",
    source="F. Giesen, Triangle rasterization in practice, 2013; fixed-point rasterizers of the 1990s",
    exact_for="triangles and pixels less than 128 pixels from each other",
    breaks_where="a value of 32,768 square pixels or more wraps around: pixels are lost, others drawn outside",
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
    exact_for="triangles and pixels less than 8,388,608 pixels from each other",
    breaks_where="a value of 2^47 square pixels or more wraps around",
    needs=("projected",),
)
def int64() -> NumberFormat:
    """Return whole numbers of 1/256 pixel in 64 bits."""
    return INT64


@method(
    "coverage",
    "exact",
    "Not snapped, exact",
    source="J. R. Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates, 1997",
    exact_for="every triangle in clip space; every shared edge",
)
def exact() -> NumberFormat:
    """Return whole numbers of any length on the corners as they are."""
    return EXACT
