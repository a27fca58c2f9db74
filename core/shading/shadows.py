"""Shadow maps: what the light sees, drawn first; what lies farther from the light than that is in the shadow.

The map stores one depth for a whole texel, that at its middle. A texel of width s on a plane, over which the light
stands at the elevation e, sees depths that differ from it by up to (s / 2) cot e along an axis of the map, and by up to
(s / sqrt 2) cot e towards a corner. So half of a plane that is lit lies behind what the map stores, and is drawn dark
(acne), unless a point may lie behind it by this much: the bias. Of the mean of four texels it is twice as much.

References
----------
L. Williams, *Casting curved shadows on curved surfaces*, SIGGRAPH 1978.
W. Reeves, D. Salesin, R. Cook, *Rendering antialiased shadows with depth maps*, SIGGRAPH 1987: comparisons are
averaged, never depths.
F. Pellacini, *Computer Graphics*, lecture "Graphics pipeline": shadow maps as an approximation.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import floor

import numpy as np

from core.methods import method
from core.records.arrays import Flags, Floats, Integers
from core.records.listing import RETURN, Operation

BIAS_STEPS = 16
"""Steps of the setting ``shadow_bias`` in the width of a texel."""


@dataclass(frozen=True, eq=False)
class Lamp:
    """The light that casts shadows, and what it sees."""

    number: int
    """Which of the scene's lights it is."""
    to_map: Floats
    """(3, 4) float64: from world space, with w = 1, to column and row of the map in texels, and its depth in [0, 1]."""
    depth: Floats | None
    """(M, M) float64 that the map stores, row 0 at the bottom; ``None``: the method looks into no map."""
    bias: float
    """How far behind the stored depth a point may lie and still be lit, in the depth of the map."""
    triangles: Floats | None
    """(T, 3, 3) float64 corners in the space of the map; ``None``: the method casts no rays."""


@dataclass(frozen=True, eq=False)
class MapTests:
    """F points against K texels each of a shadow map."""

    place: Floats
    """(F, 3) float64: column and row in texels, and depth from the light."""
    texels: Integers
    """(F, K, 2) int64 columns and rows; some may lie outside of the map."""
    stored: Floats
    """(F, K) float64 depth that the map has there; infinite outside of it, where nothing is known to stand before."""
    is_lit: Flags
    """(F, K) bool: the point is no farther than what the map stores, and the bias."""
    share: Floats
    """(F,) float64, the mean of these."""


def in_light_space(position: Floats, to_map: Floats) -> tuple[Floats, Floats, Floats]:
    """Return column, row and depth (F,) in the map of points (F, 3) in world space."""
    x, y, z = position.T
    column, row, depth = (a * x + b * y + c * z + d for a, b, c, d in to_map.tolist())
    return column, row, depth


def compare_texels(
    position: Floats, lamp: Lamp, offsets: Sequence[tuple[int, int]], middle: float
) -> MapTests:
    """Compare points (F, 3) in world space with the texels at ``offsets`` from the one at place minus ``middle``."""
    assert lamp.depth is not None
    size = len(lamp.depth)
    u, v, depth = in_light_space(position, lamp.to_map)
    with np.errstate(invalid="ignore"):
        first = np.floor(np.clip(np.stack([u, v], axis=1) - middle, -(2.0**53), 2.0**53)).astype(np.int64)
    texels = first[:, None] + np.array(offsets)
    column, row = texels[..., 0], texels[..., 1]
    is_inside = (column >= 0) & (column < size) & (row >= 0) & (row < size)
    stored = np.full(is_inside.shape, np.inf)
    stored[is_inside] = lamp.depth[row[is_inside], column[is_inside]]
    is_lit = depth[:, None] <= stored + lamp.bias
    share = is_lit.sum(axis=1) / len(offsets)
    return MapTests(np.stack([u, v, depth], axis=1), texels, stored, is_lit, share)


def map_share(
    position: Sequence[float],
    to_map: Sequence[Sequence[float]],
    depths: Sequence[Sequence[float]],
    bias: float,
) -> float:
    """Return 1 for a point that the light reaches, 0 for one in the shadow (listing of `shadow_map`)."""
    x, y, z = position
    u, v, depth = [a * x + b * y + c * z + d for a, b, c, d in to_map]  #: light-space
    column, row, size = floor(u), floor(v), len(depths)  #: texel
    is_inside = 0 <= column < size and 0 <= row < size
    is_lit = not is_inside or depth <= depths[row][column] + bias  #: compare
    return 1.0 if is_lit else 0.0  #: share


def average_share(
    position: Sequence[float],
    to_map: Sequence[Sequence[float]],
    depths: Sequence[Sequence[float]],
    bias: float,
) -> float:
    """Return how many of the four nearest texels let the light pass, over four (listing of `shadow_map_average`)."""
    x, y, z = position
    u, v, depth = [a * x + b * y + c * z + d for a, b, c, d in to_map]  #: light-space
    column, row, size = floor(u - 0.5), floor(v - 0.5), len(depths)
    texels = [(column, row), (column + 1, row), (column, row + 1), (column + 1, row + 1)]  #: texel
    is_lit = []
    for column, row in texels:
        is_inside = 0 <= column < size and 0 <= row < size
        is_lit.append(not is_inside or depth <= depths[row][column] + bias)  #: compare
    return sum(is_lit) / 4  #: share


def map_operations(texels: str) -> dict[str, tuple[Operation, ...]]:
    """Return what a row does to find its share of the light, by what the listing calls the texels."""
    return {
        "shadow": (
            Operation("light-space", "light-space", {"lamp_u": "u", "lamp_v": "v", "lamp_depth": "depth"}),
            Operation("map-texel", "texel", {"lamp_texels": texels}, ("lamp_stored",)),
            Operation("compare", "compare", {"texel_is_lit": "is_lit"}),
            Operation("share", "share", {"light_share": RETURN}),
        )
    }


@method(
    "shadow",
    "none",
    "None",
    source="Pellacini, Graphics pipeline: an object-local algorithm",
    exact_for="scenes in which nothing stands in the light",
    breaks_where="wherever something does: every surface that faces the light is lit",
)
def no_shadow(position: Floats, _lamp: Lamp) -> MapTests:
    """Compare points (F, 3) with no texel: all of the light arrives."""
    count = len(position)
    nothing = np.empty((count, 0))
    return MapTests(
        np.full((count, 3), np.nan),
        np.empty((count, 0, 2), np.int64),
        nothing,
        nothing.astype(bool),
        np.ones(count),
    )


@method(
    "shadow",
    "map",
    "Shadow map",
    source="Williams 1978; Pellacini, shadow maps",
    exact_for="points farther than a texel from the border of a shadow, with a bias of (s / sqrt 2) cot e at least",
    breaks_where="bias too small: lit surfaces shadow themselves (acne); too large: shadows detach and vanish; borders "
    "are stairs of texels",
    needs=("world-boxes",),
    takes=("map_size", "shadow_bias"),
    listing=map_share,
    operations=map_operations("column row"),
    traits="map",
)
def shadow_map(position: Floats, lamp: Lamp) -> MapTests:
    """Compare points (F, 3) in world space with the texel that each lies in.

    Returns
    -------
    MapTests
        ``share`` (F,) float64 of the light arrives, whatever the method; what was compared depends on it.
    """
    return compare_texels(position, lamp, ((0, 0),), 0.0)


@method(
    "shadow",
    "map-average",
    "Shadow map, mean of four comparisons",
    source="Reeves, Salesin, Cook 1987 (percentage-closer filtering)",
    exact_for="points farther than two texels from the border of a shadow, with twice the bias of one texel",
    breaks_where="borders are as soft as the texels are wide, not as the light is large; it needs twice the bias",
    needs=("world-boxes",),
    takes=("map_size", "shadow_bias"),
    listing=average_share,
    operations=map_operations("texels"),
    traits="map",
)
def shadow_map_average(position: Floats, lamp: Lamp) -> MapTests:
    """Compare points (F, 3) with the four texels whose middles are nearest, as `shadow_map`, and average."""
    return compare_texels(position, lamp, ((0, 0), (1, 0), (0, 1), (1, 1)), 0.5)
