"""Textures in single precision: bilinear means as close as float32, for pictures that go on reckoning with them.

`PackedSampler` (``packed_texture``) mixes three channels at once with weights of 8 bits, which is enough for a texel
that is shown as it is in linear bytes. Where a texture is lit and shown in sRGB, a small error in a dark colour is
several bytes; so here each channel is mixed by itself:

    A + s (B - A)  and  C + s (D - C),  then t of the way from the first to the second

for the texels A, B (right of it), C (above) and D. The texels stand in one table that goes on beyond the texture's
border as the wrap says, so that the four have fixed distances and there is one index for a fragment.

How exact it is: position and weights come from float64 coordinates, each of the three steps is rounded to float32:
a mean of texels from 0 to 1 is at most `ROUNDING` away from that of ``core.textures.look_up``.
"""

from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np

from core.methods import table
from core.records.arrays import Floats, Integers, Singles, read_only
from core.scene import Texture
from core.textures.packed import PLACES, AxisPlaces, place_count

BLOCK = 16384
"""Fragments that are looked up at once, so that their numbers stay in the processor's cache."""
FARTHEST = 2.0**20
"""Texels from the origin that coordinates may lie: so many, and their fraction, float64 tells with 32 bits to spare."""
ROUNDING = 2.0**-21
"""Three products and sums of numbers up to 1, and the weights, rounded to float32 each."""
MOST_TEXELS = 1 << 24
"""Places that a texture may be looked up at: the table has 4 bytes for each and each channel."""

_is_plain: WeakKeyDictionary[Texture, bool] = WeakKeyDictionary()
"""Which textures are opaque, with colours from 0 to 1."""


def is_plain(texture: Texture, wrap: str) -> bool:
    """Return whether a texture is opaque, with colours from 0 to 1, and wraps in a way that a table knows."""
    if wrap not in PLACES or place_count(texture.pixels.shape, wrap) > MOST_TEXELS:
        return False
    known = _is_plain.get(texture)
    if known is None:
        pixels = texture.pixels
        is_opaque = pixels.shape[2] < 4 or bool((pixels[:, :, 3] == 1).all())
        _is_plain[texture] = known = is_opaque and bool(pixels.min() >= 0 and pixels.max() <= 1)
    return known


class SingleSampler:
    """Looks positions up in a plain texture, see `is_plain`.

    Parameters
    ----------
    wrap : str
        Name of a method of this family.
    """

    def __init__(self, texture: Texture, wrap: str) -> None:
        self.channels = min(texture.pixels.shape[2], 3)
        """1 for grey, else 3."""
        _, self._texels, self._columns, self._rows = _bordered(texture, wrap)
        row = self.channels * (self._columns.count + 1)
        self._starts = ((0, self.channels), (row, row + self.channels))
        self._weights = np.empty((2, BLOCK), np.float32)
        self._four = np.empty((2, self.channels, 2, BLOCK), np.float32)
        self._double = np.empty((2, BLOCK))
        self._whole = np.empty((2, BLOCK), np.int32)
        self._index = np.empty(BLOCK, np.int64)

    def write_colors(self, x: Floats, y: Floats, colors: Singles) -> None:
        """Write the bilinear means at positions in texel units, the origin at the texture's bottom left corner.

        Parameters
        ----------
        x, y : (F,) float64 arrays
            Between -`FARTHEST` and `FARTHEST`.
        colors : (channels, F) float32 array
            Is written.
        """
        for start in range(0, len(x), BLOCK):
            part = slice(start, start + BLOCK)
            count = len(x[part])
            across, up = self._weights[:, :count]
            column = self._split(x[part], across, self._columns, 0)
            row = self._split(y[part], up, self._rows, 1)
            row *= self._columns.count + 1
            row += column
            row *= self.channels
            index = self._index[:count]
            np.copyto(index, row)
            self._mix(index, across, up, colors[:, part])

    def _split(self, position: Floats, fraction: Singles, places: AxisPlaces, axis: int) -> np.ndarray:
        """Write how far positions (F,) lie beyond the centre of the lower texel; return its place (F,) int32."""
        count = len(position)
        from_center, lower = self._double[:, :count]
        whole = self._whole[axis, :count]
        np.subtract(position, 0.5, out=from_center)
        np.floor(from_center, out=lower)
        np.subtract(from_center, lower, out=from_center)
        np.copyto(fraction, from_center, casting="unsafe")
        np.copyto(whole, lower, casting="unsafe")
        places.find(whole, whole)
        return whole

    def _mix(self, index: Integers, across: Singles, up: Singles, means: Singles) -> None:
        """Write the means (channels, F) of the four texels around each fragment."""
        near, far = (texels[:, :, : len(index)] for texels in self._four)
        for channel in range(self.channels):
            for level, (left, right) in enumerate(self._starts):
                self._texels[channel + left :].take(index, out=near[channel, level], mode="clip")
                self._texels[channel + right :].take(index, out=far[channel, level], mode="clip")
        far -= near
        far *= across
        near += far
        lower, upper = near[:, 0], near[:, 1]
        upper -= lower
        upper *= up
        np.add(lower, upper, out=means)


class BorderedTexels(NamedTuple):
    """The texels of a texture and beyond its border, for one wrap."""

    wrap: str
    texels: Singles
    """(N,) float32, by row, column and channel. Each axis has one texel more than places: the last has a neighbour."""
    columns: AxisPlaces
    rows: AxisPlaces


_tables: WeakKeyDictionary[Texture, BorderedTexels] = WeakKeyDictionary()
"""The table that each texture was last looked up in; they go when the texture goes."""


def _bordered(texture: Texture, wrap: str) -> BorderedTexels:
    """Return the table of a texture for one wrap."""
    known = _tables.get(texture)
    if known is not None and known.wrap == wrap:
        return known
    pixels = texture.pixels
    rows, columns = (PLACES[wrap](size) for size in pixels.shape[:2])
    wrapped = table.get("wrap", wrap).function
    row, column = (
        wrapped(places.first + np.arange(places.count + 1), places.size) for places in (rows, columns)
    )
    texels = pixels[row][:, column, : min(pixels.shape[2], 3)]
    made = BorderedTexels(wrap, read_only(np.ascontiguousarray(texels).reshape(-1)), columns, rows)
    _tables[texture] = made
    return made
