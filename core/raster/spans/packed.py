"""Packed words: depth and a payload in one 64-bit integer that is linear over the window.

A word has the depth above (``fixed_depth``: 39 bits) and 24 bits for the number of the triangle plus one below. The
least word of a pixel is its nearest fragment and, of equally near ones, the triangle that was drawn first:
``numpy.minimum`` is the depth test.

Words are integer planes (``core.numeric.integer_planes``): walking one pixel by pixel, row by row, or computing it
at once gives the same bits.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from core.numeric.buffers import ScratchBuffers
from core.numeric.integer_planes import IntegerPlanes
from core.numeric.quadratic_planes import QuadraticPlanes
from core.raster.pixel_runs import Raster
from core.raster.spans.bands import Band
from core.raster.spans.lanes import TieOwners, TriangleSetup
from core.raster.spans.rows import Carried, bounds_of_rows, longest_first, walk_rows
from core.records.arrays import Integers

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
