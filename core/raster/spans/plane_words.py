"""Words of a depth that is rounded pixel by pixel: a depth that is a plane over the window, walked along the spans.

The depth at a pixel is evaluated from the plane anew, by the operations of ``interpolation.plane_value`` in their
order, so its float32 is the one that every other fill stores; only the gathering is saved: what belongs to the row is
computed once a span.
"""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from core.numeric.buffers import ScratchBuffers
from core.raster.pixel_runs import Raster
from core.raster.spans.bands import Band
from core.raster.spans.lanes import TieOwners, TriangleSetup
from core.raster.spans.packed import FEW, write_out
from core.raster.spans.rows import Carried, Spans, walk_rows
from core.records.arrays import Flags, Floats, Integers

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
