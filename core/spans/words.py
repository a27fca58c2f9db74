"""Packed words along spans: depth and a payload in one 64-bit integer, linear over the window or rounded by pixels.

A word has the depth above (``fixed_depth``: 39 bits) and 24 bits for the number of the triangle plus one below. The
least word of a pixel is its nearest fragment and, of equally near ones, the triangle that was drawn first:
``numpy.minimum`` is the depth test.

Words are integer planes (``core.numeric.planes``): walking one pixel by pixel, row by row, or computing it
at once gives the same bits.

The depth at a pixel is evaluated from the plane anew, by the operations of ``interpolation.plane_value`` in their
order, so its float32 is the one that every other fill stores; only the gathering is saved: what belongs to the row is
computed once a span.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from core.coverage.pixel_runs import Raster
from core.numeric.large_arrays import ScratchBuffers
from core.numeric.planes import IntegerPlanes, QuadraticPlanes
from core.records.arrays import Flags, Floats, Integers
from core.spans.bands import Band
from core.spans.lanes import (
    Carried,
    Spans,
    TieOwners,
    TriangleSetup,
    bounds_of_rows,
    longest_first,
    walk_rows,
)

# Packed words: depth and a payload in one 64-bit integer that is linear over the window.


FEW = 96
"""Spans: below this the rest of them is written out pixel by pixel, since a pass costs as much as for thousands."""


@dataclass(frozen=True, eq=False)
class WordSpans:
    """S spans with the word of their first pixel."""

    pixel: Integers
    """(S,) int64, place of the first pixel in the buffer."""
    word: Integers
    """(S,) int64, word at the first pixel."""
    step: Integers
    """(S,) int64, change of the word from pixel to pixel."""
    longer: list[int]
    """Element k: how many spans have more than k pixels; longest first."""

    bend: Integers | None = None
    """(S,) int64, change of the step from pixel to pixel; ``None``: there is none."""

    @property
    def pixel_count(self) -> int:
        """Pixels of all spans together."""
        return sum(self.longer)


def word_spans(
    planes: IntegerPlanes, lanes: TriangleSetup, raster: Raster, owners: TieOwners, scratch: ScratchBuffers
) -> WordSpans:
    """Walk the rows of all lanes and return their spans with the words to start from."""
    count = len(lanes.triangle)
    across, up, word, pixel = (
        scratch(name, count, dtype=np.int64) for name in ("lane_across", "lane_up", "lane_word", "lane_pixel")
    )
    np.copyto(pixel, lanes.first_row, casting="unsafe")
    planes.up.take(lanes.triangle, out=up, mode="clip")
    np.multiply(up, pixel, out=word)
    planes.origin.take(lanes.triangle, out=across, mode="clip")
    word += across
    planes.across.take(lanes.triangle, out=across, mode="clip")
    columns = raster.shape[1]
    pixel *= columns
    pixel += raster.place_of_origin
    carried = (Carried(pixel, columns), Carried(word, up), Carried(across, 0))
    (pixel, word, step), start, length = bounds_of_rows(lanes, raster, owners, carried, scratch)

    # From column 0 to the first pixel of every row.
    column = scratch("row_column", len(start), dtype=np.int64)
    np.copyto(column, start)
    pixel += column
    column *= step
    word += column
    (pixel, word, step), longer = longest_first(length, (pixel, word, step), scratch)
    return WordSpans(pixel, word, step, longer)


def bent_spans(
    planes: QuadraticPlanes, lanes: TriangleSetup, raster: Raster, owners: TieOwners, scratch: ScratchBuffers
) -> WordSpans:
    """Walk the rows of all lanes and return their spans with words and steps to start from."""
    first_row = lanes.first_row.astype(np.int64)
    rows = walk_rows(lanes, raster, owners, (Carried(first_row, 1),), scratch)
    triangle, row = lanes.triangle.take(rows.lane), rows.carried[0]
    word, step = planes.at(triangle, rows.start, row)
    pixel = row * raster.shape[1] + (rows.start + raster.place_of_origin)
    return WordSpans(pixel, word, step, rows.longer, planes.bend.take(triangle))


def each_pass(spans: WordSpans) -> Iterator[tuple[int, Integers, Integers]]:
    """Yield k, and place and word of pixels, (F,) int64 each, until all pixels of ``spans`` have come.

    Notes
    -----
    Pass k is the k-th pixel of every span that has one: the first ``longer[k]``. It lies k places behind the first one,
    so its place is counted from there: where that of the first is in the buffer, this one is in ``buffer[k:]``, and no
    place has to be moved on. What is left of the few longest spans comes at once. The arrays are good until the next
    pass; the words are used up.
    """
    pixel, word, step, bend = spans.pixel, spans.word, spans.step, spans.bend
    for k, (count, further) in enumerate(pairwise((*spans.longer, 0))):
        if count < FEW:
            span, place = write_out(spans.longer[k:])
            rest = word[span] + place * step[span]
            if bend is not None:
                rest += (place * (place - 1) >> 1) * bend[span]
            yield k, pixel[span] + place, rest
            return
        yield k, pixel[:count], word[:count]
        word[:further] += step[:further]
        if bend is not None:
            step[:further] += bend[:further]


def draw_words(words: Integers, spans: WordSpans) -> None:
    """Keep the least word of every pixel of the buffer ``words`` (H*W,) int64; the spans are used up."""
    for k, pixel, word in each_pass(spans):
        np.minimum.at(words[k:], pixel, word)


def write_out(longer: list[int]) -> tuple[Integers, Integers]:
    """Return for every pixel of spans its span and its place in it, (F,) int64 each; ``longer`` as in `Spans`."""
    count = longer[0]
    length = len(longer) - np.searchsorted(longer[::-1], np.arange(count), side="right")
    span = np.repeat(np.arange(count), length)
    return span, np.arange(len(span)) - np.repeat(np.cumsum(length) - length, length)


def word_block(planes: IntegerPlanes, triangle: int, band: Band, scratch: ScratchBuffers) -> Integers:
    """Return the words (R, C) int64 of one triangle at all pixels of a band's block."""
    ramp = band.column * planes.across[triangle]
    of_row = planes.origin[triangle] + band.inside.row * planes.up[triangle]
    block = scratch("word_block", len(of_row), len(ramp), dtype=np.int64)
    np.add(ramp, of_row[:, None], out=block)
    return block


# Words of a depth that is rounded pixel by pixel: a depth that is a plane over the window, walked along the
# spans.


PAYLOAD_BITS = 32
"""Bits below the 31 bits of a float32 that is 0 or more."""
INFINITY = 0x7F800000
"""Bits of the float32 infinity."""
STEEPEST = 1e150
"""Coefficients beyond this could overflow within the window."""


@dataclass(frozen=True, eq=False)
class DepthPlanes:
    """Depth ``a x + (b y + c)`` of P triangles whose corners lie between the near and the far plane, in 0 to 1."""

    a: Floats
    """(P,) float64."""
    b: Floats
    """(P,) float64."""
    c: Floats
    """(P,) float64."""
    payload: Integers
    """(P,) int64, what stands below the depth in a word."""
    scale: float = 1.0
    """Depth 1 as a whole number, to which depths are rounded; 1: they are not, but for float32."""
    larger_is_nearer: bool = False

    @property
    def is_finite(self) -> Flags:
        """(P,) bool, where depth is a number all over the window."""
        return np.asarray(np.maximum(np.maximum(np.abs(self.a), np.abs(self.b)), np.abs(self.c)) < STEEPEST)

    def part(self, first: int, end: int) -> "DepthPlanes":
        """Return the planes of triangles ``first`` to ``end``."""
        at = slice(first, end)
        return replace(self, a=self.a[at], b=self.b[at], c=self.c[at], payload=self.payload[at])

    def block(self, triangle: int, band: Band, raster: Raster, scratch: ScratchBuffers) -> Integers:
        """Return the words (R, C) int64 of one triangle at all pixels of a band's block."""
        shape = (len(band.inside), len(band.column))
        depth = scratch("depth_block", *shape)
        of_row = self.b[triangle] * raster.along(band.inside.row) + self.c[triangle]
        np.add(self.a[triangle] * raster.along(band.column), of_row[:, None], out=depth)
        return self.words(depth.reshape(-1), self.payload[triangle], scratch).reshape(shape)

    def words(self, depth: Floats, payload: Integers, scratch: ScratchBuffers) -> Integers:
        """Return the words (F,) int64 of depths (F,), which are limited and rounded in place."""
        np.clip(depth, 0.0, 1.0, out=depth)
        if self.scale != 1:
            depth *= self.scale
            np.rint(depth, out=depth)
        single = scratch("plane_single", len(depth), dtype=np.float32)
        np.copyto(single, depth, casting="same_kind")
        single += np.float32(0)  # no negative zero: bits are compared
        words = scratch("plane_words", len(depth), dtype=np.int64)
        np.copyto(words, single.view(np.int32))
        if self.larger_is_nearer:
            np.subtract(INFINITY, words, out=words)
        words <<= PAYLOAD_BITS
        words |= payload
        return words


def plane_spans(lanes: TriangleSetup, raster: Raster, owners: TieOwners, scratch: ScratchBuffers) -> Spans:
    """Walk the rows of all lanes; the place of column 0 in the buffer and the row are carried along."""
    row = scratch("plane_row", len(lanes.triangle), dtype=np.int64)
    np.copyto(row, lanes.first_row, casting="unsafe")
    columns = raster.shape[1]
    pixel: Integers = np.multiply(row, columns, out=scratch("plane_pixel", len(row), dtype=np.int64))
    pixel += raster.place_of_origin
    return walk_rows(lanes, raster, owners, (Carried(pixel, columns), Carried(row, 1)), scratch)


def draw_plane_words(
    words: Integers,
    planes: DepthPlanes,
    spans: Spans,
    triangle: Integers,
    raster: Raster,
    scratch: ScratchBuffers,
) -> None:
    """Keep the least word of every pixel.

    Parameters
    ----------
    words : (H*W,) int64
    spans : Spans
        Of `plane_spans`; used up.
    triangle : (L,) int64
        The triangle of every lane.
    """
    if not spans.longer:
        return
    pixel, row = spans.carried
    pixel += spans.start
    owner = triangle.take(spans.lane)
    x, y = raster.along(spans.start), raster.along(row)
    a, payload = planes.a.take(owner), planes.payload.take(owner)
    of_row = planes.b.take(owner) * y + planes.c.take(owner)
    for k, (count, further) in enumerate(pairwise((*spans.longer, 0))):
        if count < FEW:
            span, place = write_out(spans.longer[k:])
            depth = a[span] * (x[span] + place) + of_row[span]
            np.minimum.at(words[k:], pixel[span] + place, planes.words(depth, payload[span], scratch))
            return
        depth = np.multiply(a[:count], x[:count], out=scratch("plane_depth", count))
        depth += of_row[:count]
        # The k-th pixel is k places behind the first, see `packed.each_pass`.
        np.minimum.at(words[k:], pixel[:count], planes.words(depth, payload[:count], scratch))
        x[:further] += 1
