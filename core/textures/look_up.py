"""Texture look-up: which texels a fragment reads, with which weights, and the colour that comes of it.

A texture of ``width`` columns is ``width`` texel units wide: texel i covers [i, i + 1) and its centre is at
i + 1/2, where ``u = (i + 1/2) / width``. Row 0 is at v = 0, the bottom.

References
----------
M. Zwicker, Computergrafik, lecture "Texture mapping", 2016.
M. Segal, K. Akeley, The OpenGL Graphics System 4.6, 2022, section 8.14 (wrap modes, nearest, linear).
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import floor
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from core.methods import method, table
from core.records.arrays import Flags, Floats, Integers, Singles, read_only
from core.records.listing import RETURN, Operation
from core.scene import Texture

# A texture filter that finds colours by itself, beside those that say which texels are read: an edited
# listing.


class ColorRule(ABC):
    """A rule of the family ``texture_filter`` that finds colours by itself."""

    @abstractmethod
    def __call__(self, *values: Any) -> Any:
        """Return which texels, or levels, the method reads whose listing is edited."""

    @abstractmethod
    def colors(self, texture: Texture, uv: Floats, lod: Floats | None, wrap: str) -> Floats:
        """Return colours (4, F) float64 of finite coordinates ``uv`` (2, F), with mipmaps of levels of detail (F,)."""


# Texture coordinates as all filters take them: finite, and not so large that an index has no room.


COORDINATE_LIMIT = 2.0**32
"""Coordinates beyond this are moved here: a whole number of repetitions, and indices fit int64."""


def finite_coordinates(uv: Floats) -> Floats:
    """Return a copy of texture coordinates (F, 2) as (2, F); NaN is 0, what lies far outside `COORDINATE_LIMIT`."""
    coordinates = np.array(uv.T, order="C")
    smallest, largest = coordinates.min(initial=0), coordinates.max(initial=0)
    if not (smallest >= -COORDINATE_LIMIT and largest <= COORDINATE_LIMIT):
        coordinates[np.isnan(coordinates)] = 0.0
        np.clip(coordinates, -COORDINATE_LIMIT, COORDINATE_LIMIT, out=coordinates)
    return coordinates


# Texture look-up: which texels a fragment reads, with which weights, and the colour they give.


_BLOCK = 8192
"""Fragments of a picture that are looked up at once, so that their numbers stay in the processor's cache."""

Wrap = Callable[[Integers, int], Integers]


@dataclass(frozen=True)
class WrapTraits:
    """What is known of a wrap without running it."""

    period: int
    """Textures along an axis after which the plane repeats. 1: all are the same. 2: every second one is the mirror
    image. 0: the border texels go on."""


@method(
    "wrap",
    "repeat",
    "Repeat",
    source="OpenGL 4.6, GL_REPEAT",
    exact_for="textures whose opposite sides match",
    traits=WrapTraits(period=1),
)
def repeat(index: Integers, size: int) -> Integers:
    """Start again at the other side: ``index`` modulo ``size``, never negative."""
    if size & (size - 1) == 0:
        # Of a power of two the low bits are the remainder, and no division is needed.
        return index & (size - 1)
    return index % size


@method(
    "wrap",
    "clamp",
    "Clamp to edge",
    source="OpenGL 4.6, GL_CLAMP_TO_EDGE",
    exact_for="coordinates from 0 to 1",
    breaks_where="coordinates outside 0 to 1: the border texel is repeated",
    traits=WrapTraits(period=0),
)
def clamp(index: Integers, size: int) -> Integers:
    """Go on with the border texel."""
    return np.clip(index, 0, size - 1)


@method(
    "wrap",
    "mirror",
    "Mirrored repeat",
    source="OpenGL 4.6, GL_MIRRORED_REPEAT",
    exact_for="all textures: no seam",
    traits=WrapTraits(period=2),
)
def mirror(index: Integers, size: int) -> Integers:
    """Run to and fro: every second repetition is reflected."""
    there = repeat(index, 2 * size)
    back = 2 * size - 1 - there
    return np.minimum(there, back)


def wrap_period(wrap: str) -> int:
    """Return the period of a method of the family ``wrap``, see `WrapTraits`."""
    traits: WrapTraits = table.get("wrap", wrap).traits
    return traits.period


def wrapped_index(index: int, size: int, wrap: str) -> int:
    """Return the texel that ``index`` means (listing of the three wraps)."""
    if wrap == "repeat":
        return index % size
    if wrap == "clamp":
        return min(max(index, 0), size - 1)
    if wrap != "mirror":
        raise ValueError(f"no listing of the wrap {wrap}")
    there = index % (2 * size)
    return there if there < size else 2 * size - 1 - there


@dataclass(frozen=True, eq=False)
class Footprint:
    """The texels that F fragments read: R = 2 columns and rows for bilinear, 1 for nearest."""

    columns: tuple[Integers, ...]
    """R arrays (F,) int64 after wrapping: left, right."""
    rows: tuple[Integers, ...]
    """R arrays (F,) int64 after wrapping: bottom, top."""
    weights: Floats
    """(2, F) float64: w_u of the right column, w_v of the top row; 0 for nearest."""


def texel_operations(texels: str, color: str, *others: Operation) -> dict[str, tuple[Operation, ...]]:
    """Return what a row does to find a texture's colour, by what the listing calls the texels and the colour."""
    position = Operation("position", "position", {"texel_position": "x y"})
    chosen = Operation("texels", "texels", {"texels": texels}, ("texel_colors",))
    mixed = Operation("filter", "color", {"texture_color": color}, ("shares",))
    return {"texture": (position, chosen, *others, mixed)}


def wrapped_pair(index: int, size: int, wrap: str) -> tuple[int, int]:
    """Return the texels that ``index`` and the next one mean."""
    return wrapped_index(index, size, wrap), wrapped_index(index + 1, size, wrap)


def bilinear_color(
    pixels: Sequence[Sequence[Sequence[float]]], u: float, v: float, wrap: str
) -> tuple[float, ...]:
    """Return the mean of the four texels of ``pixels[row][column]`` around (u, v) (listing of bilinear)."""
    width, height = len(pixels[0]), len(pixels)
    x, y = u * width, v * height  #: position
    i, j = floor(x - 0.5), floor(y - 0.5)
    (left, right), (bottom, top) = wrapped_pair(i, width, wrap), wrapped_pair(j, height, wrap)  #: texels
    w_u, w_v = x - 0.5 - i, y - 0.5 - j  #: fractions
    low, high = pixels[bottom], pixels[top]
    color = []
    for k in range(len(pixels[0][0])):
        c_b = low[left][k] * (1 - w_u) + low[right][k] * w_u
        c_t = high[left][k] * (1 - w_u) + high[right][k] * w_u
        color.append(c_b * (1 - w_v) + c_t * w_v)  #: color
    return tuple(color)


@method(
    "texture_filter",
    "bilinear",
    "Bilinear",
    source="Zwicker 2016, Bilinear interpolation",
    exact_for="textures that are linear between texel centres",
    breaks_where="minification: aliasing. Strong magnification: creases at texel centres",
    listing=bilinear_color,
    operations=texel_operations(
        "left right bottom top", "color", Operation("fractions", "fractions", {"mix": "w_u w_v"})
    ),
)
def bilinear(position: Floats, size: tuple[int, int], wrap: Wrap) -> Footprint:
    """Read the four texels whose centres surround each position, weighted by nearness.

    Parameters
    ----------
    position : (2, F) float64 array
        x and y in texel units, finite.
    size : tuple of int
        Width and height of the texture.
    wrap : callable
        A function of the family ``wrap``.
    """
    from_centre = position - 0.5
    lower = np.floor(from_centre)
    weights = from_centre - lower
    column, row = lower.astype(np.int64)
    columns = (_wrapped(column, size[0], wrap), _wrapped(column + 1, size[0], wrap))
    rows = (_wrapped(row, size[1], wrap), _wrapped(row + 1, size[1], wrap))
    return Footprint(columns, rows, weights)


def nearest_color(
    pixels: Sequence[Sequence[Sequence[float]]], u: float, v: float, wrap: str
) -> tuple[float, ...]:
    """Return the texel of ``pixels[row][column]`` at (u, v) (listing of nearest)."""
    x, y = u * len(pixels[0]), v * len(pixels)  #: position
    across, up = len(pixels[0]), len(pixels)
    column, row = wrapped_index(floor(x), across, wrap), wrapped_index(floor(y), up, wrap)  #: texels
    return tuple(pixels[row][column])  #: color


@method(
    "texture_filter",
    "nearest",
    "Nearest texel",
    source="Zwicker 2016, Nearest-neighbor interpolation",
    exact_for="textures that are constant over each texel",
    breaks_where="minification: aliasing. Magnification: blocks",
    listing=nearest_color,
    operations=texel_operations("column row", RETURN),
)
def nearest(position: Floats, size: tuple[int, int], wrap: Wrap) -> Footprint:
    """Read the texel that contains each position, on a border the right or upper one; see `bilinear`."""
    column, row = np.floor(position).astype(np.int64)
    columns, rows = (_wrapped(column, size[0], wrap),), (_wrapped(row, size[1], wrap),)
    return Footprint(columns, rows, np.zeros_like(position))


def uses_mipmaps(texture_filter: str) -> bool:
    """Return whether a texture filter reads mipmaps, and needs to know how u and v change from pixel to pixel."""
    return "mipmaps" in table.get("texture_filter", texture_filter).needs


def _wrapped(index: Integers, size: int, wrap: Wrap) -> Integers:
    """Wrap ``index``; indices that are all inside need no work, whatever the wrap."""
    if index.size and index.min() >= 0 and index.max() < size:
        return index
    return wrap(index, size)


@dataclass(frozen=True, eq=False)
class TextureSamples:
    """What F fragments read from a texture; K = 4 texels each for bilinear, 1 for nearest."""

    color: Floats
    """(F, 4) float64, linear, straight alpha."""
    position: Floats
    """(F, 2) float64 in texel units, before wrapping; 0 where a coordinate is NaN."""
    undefined: Flags
    """(F, 2) bool, where a coordinate is NaN and was read as 0."""
    texels: Integers
    """(F, K, 2) int64 column and row after wrapping: bottom left, bottom right, top left, top right."""
    texel_colors: Floats
    """(F, K, 4) float64 colours of ``texels``."""
    weights: Floats
    """(F, 2) float64: w_u of the right column, w_v of the top row; 0 for nearest."""

    @property
    def shares(self) -> Floats:
        """(F, K) float64 share of each texel in the colour; they add up to 1."""
        w_u, w_v = self.weights.T
        products = ((1 - w_u) * (1 - w_v), w_u * (1 - w_v), (1 - w_u) * w_v, w_u * w_v)
        return np.stack(products[: self.texels.shape[1]], axis=1)


def sample_texture(
    texture: Texture, uv: Floats, texture_filter: str = "bilinear", wrap: str = "repeat"
) -> TextureSamples:
    """Look ``uv`` up in ``texture`` and keep everything that took part.

    For the fragments of a whole picture `texture_colors` gives the same colours sooner.

    Parameters
    ----------
    texture : Texture
        (h, w, C) float32, row 0 at v = 0. One channel reads as grey; without alpha, alpha is 1.
    uv : (F, 2) float64 array
        Texture coordinates: (0, 0) is the bottom left corner, (1, 1) the top right one.
    texture_filter, wrap : str
        Names of methods of these families; what reads mipmaps is in ``core.textures.mipmaps``.

    Raises
    ------
    ValueError
        If ``uv`` is not (F, 2), or a name is not in the table, or a filter of mipmaps.

    Notes
    -----
    As in OpenGL the texel *indices* are wrapped, not the coordinates: with ``repeat`` the bilinear filter
    mixes the last with the first texel at the seam, and nearest at u = 1 reads the first texel. NaN reads
    as 0, a coordinate beyond `core.textures.look_up.COORDINATE_LIMIT` as the limit.
    """
    uv = _checked_uv(uv)
    position = _position(uv, texture)
    footprint = _footprint(position, texture, texture_filter, wrap)
    color = texture_colors(texture, uv, texture_filter, wrap).T
    channels = texture.pixels.shape[2]
    texels = np.stack([np.stack(pair, axis=1) for pair in _pairs(footprint)], axis=1)
    texel_colors = np.empty((*texels.shape[:2], 4))
    texel_colors[..., :channels] = texture.pixels[texels[..., 1], texels[..., 0]]
    fill_missing_channels(texel_colors, channels)
    return TextureSamples(
        read_only(color.T),
        read_only(position.T),
        read_only(np.isnan(uv)),
        read_only(texels),
        read_only(texel_colors),
        read_only(footprint.weights.T),
    )


def texture_colors(
    texture: Texture, uv: Floats, texture_filter: str = "bilinear", wrap: str = "repeat"
) -> Floats:
    """Return the (F, 4) float64 colours of `sample_texture`, bit for bit, without the record: a view of four rows."""
    uv = _checked_uv(uv)
    rule = table.get("texture_filter", texture_filter).function
    if isinstance(rule, ColorRule):
        return rule.colors(texture, finite_coordinates(uv), None, wrap).T
    color = np.empty((4, len(uv)))
    for start in range(0, len(uv), _BLOCK):
        part = slice(start, start + _BLOCK)
        position = _position(uv[part], texture)
        _mix(texture, _footprint(position, texture, texture_filter, wrap), color[:, part])
    return color.T


def _checked_uv(uv: Floats) -> Floats:
    uv = np.asarray(uv, dtype=np.float64)
    if uv.ndim != 2 or uv.shape[1] != 2:
        raise ValueError(f"uv must be (F, 2), got {uv.shape}")
    return uv


def _position(uv: Floats, texture: Texture) -> Floats:
    """Return the (2, F) finite texel units of ``uv``."""
    height, width, _ = texture.pixels.shape
    coordinates = finite_coordinates(uv)
    coordinates *= np.array([[width], [height]])
    return coordinates


def _footprint(position: Floats, texture: Texture, texture_filter: str, wrap: str) -> Footprint:
    height, width, _ = texture.pixels.shape
    if uses_mipmaps(texture_filter):
        raise ValueError(f"texture_filter must be one that reads the texture itself, got {texture_filter}")
    footprint: Footprint = table.get("texture_filter", texture_filter).function(
        position, (width, height), table.get("wrap", wrap).function
    )
    return footprint


def _mix(texture: Texture, footprint: Footprint, color: Floats) -> None:
    """Write the weighted mean of the texels of ``footprint`` to ``color`` (4, F)."""
    width, channels = texture.pixels.shape[1:]
    read = [_read(texture, row * width, column) for row in footprint.rows for column in footprint.columns]
    right, top = footprint.weights
    left, bottom = 1 - right, 1 - top
    for channel, mixed in enumerate(color[:channels]):
        values = [texels[:, channel].astype(np.float64) for texels in read]
        if len(values) == 1:
            mixed[:] = values[0]
        else:
            _mix_pair(values[0], values[1], left, right, values[0])
            _mix_pair(values[2], values[3], left, right, values[2])
            _mix_pair(values[0], values[2], bottom, top, mixed)
    fill_missing_channels(color.T, channels)


def _read(texture: Texture, row_start: Integers, column: Integers) -> Singles:
    """Return the texels (F, C) or (F, 4) at ``column`` (F,) of rows that begin at ``row_start``."""
    records = _texel_records(texture)
    read = records.take(row_start + column, mode="clip").view(np.float32)
    return read.reshape(len(column), records.itemsize // 4)


def _mix_pair(first: Floats, second: Floats, share: Floats, rest: Floats, mixed: Floats) -> None:
    """Write ``first * share + second * rest`` to ``mixed`` (F,); ``first`` and ``second`` are used up."""
    first *= share
    second *= rest
    np.add(first, second, out=mixed)


_records: WeakKeyDictionary[Texture, NDArray[np.generic]] = WeakKeyDictionary()
"""The texels of each texture as `_texel_records` gives them; they go when the texture goes."""


def _texel_records(texture: Texture) -> NDArray[np.generic]:
    """Return the texels (h * w,), each one number of 4 or 16 bytes: these are looked up soonest."""
    known = _records.get(texture)
    if known is not None:
        return known
    height, width, channels = texture.pixels.shape
    if channels == 1:
        found: NDArray[np.generic] = texture.pixels.reshape(-1)
    else:
        padded = np.zeros((height * width, 4), np.float32)
        padded[:, :channels] = texture.pixels.reshape(-1, channels)
        found = padded.view(np.complex128).reshape(-1)
    _records[texture] = found
    return found


def _pairs(footprint: Footprint) -> list[tuple[Integers, Integers]]:
    """Return column and row of the texels: bottom left, bottom right, top left, top right."""
    return [(column, row) for row in footprint.rows for column in footprint.columns]


def fill_missing_channels(color: Floats, channels: int) -> None:
    """Complete ``color`` (..., 4) of which the first 1, 3 or 4 channels are set: grey, then alpha 1."""
    if channels == 1:
        color[..., 1] = color[..., 2] = color[..., 0]
    if channels < 4:
        color[..., 3] = 1.0
