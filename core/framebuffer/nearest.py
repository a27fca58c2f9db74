"""The nearest fragment of every pixel, found in batches: depth and drawing order packed into one integer key.

Notes
-----
The key is (nearness << bits) | (primitive + 1), so that the least key of a pixel is its nearest fragment, and of
equally near ones the one drawn first: exactly what testing them one by one keeps. With the depth test off it is
(later primitives first << bits) | nearness. ``numpy.minimum.at`` takes about 2 ns a fragment.
"""

from collections.abc import Iterator
from functools import cache

import numpy as np

from core.framebuffer.depth import DepthFormat, Stored
from core.records.arrays import Integers

BLOCK = 1 << 15
"""Pixels that are worked on together: their numbers stay in the processor's cache."""
READ_AT_ONCE = 8 * BLOCK
"""Pixels among which those are looked for that something is seen at."""


class NearestFragments:
    """Least key per pixel over all fragments added so far; primitives are numbered in drawing order.

    Raises ValueError if the key has too few bits for the number of primitives.
    """

    def __init__(
        self,
        pixel_count: int,
        primitive_count: int,
        depth_format: DepthFormat,
        uses_depth_test: bool,
        memory: Integers | None = None,
    ) -> None:
        self._format = depth_format
        self._uses_depth_test = uses_depth_test
        self._last = primitive_count - 1
        self.primitive_bits = 63 - depth_format.nearness_bits
        if primitive_count >= 1 << self.primitive_bits:
            raise ValueError(
                f"this depth method takes at most {(1 << self.primitive_bits) - 1} triangles, got {primitive_count}"
            )
        cleared = _cleared_key(depth_format)
        if uses_depth_test:
            self._cleared = cleared << self.primitive_bits
        else:
            self._cleared = (primitive_count << depth_format.nearness_bits) | cleared
        self.keys = np.empty(pixel_count, np.int64) if memory is None else memory
        self.keys.fill(self._cleared)

    def add(self, pixel: Integers, primitive: Integers, stored: Stored) -> None:
        """Take fragments in: pixel index (F,), primitive (F,), stored depth (F,)."""
        nearness = self._format.nearness_key(stored)
        if self._uses_depth_test:
            key = (nearness << self.primitive_bits) | (primitive + 1)
        else:
            key = ((self._last - primitive) << self._format.nearness_bits) | nearness
        np.minimum.at(self.keys, pixel, key)

    def seen(self) -> Iterator[tuple[Integers, Integers]]:
        """Yield the places that something is seen at (V,), and the primitive there (V,), up to `BLOCK` at a time.

        They come from the first to the last, in few parts even where little is seen: work on a part has its fixed cost.
        """
        for first in range(0, len(self.keys), READ_AT_ONCE):
            place, primitive = self.seen_in(slice(first, first + READ_AT_ONCE))
            part_count = -(-len(place) // BLOCK)
            for part in range(part_count):
                at = slice(len(place) * part // part_count, len(place) * (part + 1) // part_count)
                yield place[at], primitive[at]

    def seen_in(self, part: slice) -> tuple[Integers, Integers]:
        """Return the places, within ``part``, that something is seen at (V,), and the primitive there (V,)."""
        place = np.flatnonzero(self.keys[part] != self._cleared)
        place += part.start or 0
        return place, self.primitive_at(place)

    def primitive_at(self, place: Integers) -> Integers:
        """Return the primitive that is seen at places (V,) where something is."""
        seen = self.keys.take(place)
        if self._uses_depth_test:
            seen &= (1 << self.primitive_bits) - 1
            seen -= 1
        else:
            seen >>= self._format.nearness_bits
            np.subtract(self._last, seen, out=seen)
        return seen

    def number_in(self, part: slice, number: Integers) -> Integers:
        """Write the primitive plus one that is seen in ``part`` of the buffer (F,), 0 for none, and return it."""
        keys = self.keys[part]
        if self._uses_depth_test:
            return np.bitwise_and(keys, (1 << self.primitive_bits) - 1, out=number)
        np.right_shift(keys, self._format.nearness_bits, out=number)
        return np.subtract(self._last + 1, number, out=number)

    def resolve(self) -> tuple[Integers, Integers, Stored]:
        """Return the pixels that something is seen at (V,), the primitive there (V,), and the depth buffer (H*W,)."""
        return *self.seen_in(slice(None)), self.depth()

    def depth(self) -> Stored:
        """Return the depth buffer (H*W,)."""
        depth = np.empty(len(self.keys), self._format.stored_type)
        for first in range(0, len(depth), BLOCK):
            part = slice(first, first + BLOCK)
            depth[part] = self._stored(self.keys[part])
        return depth

    def depth_at(self, place: Integers) -> Stored:
        """Return the depth at places in the buffer (N,)."""
        return self._stored(self.keys.take(place))

    def _stored(self, keys: Integers) -> Stored:
        if self._uses_depth_test:
            return self._format.stored_of_key(keys >> self.primitive_bits)
        return self._format.stored_of_key(keys & ((1 << self._format.nearness_bits) - 1))


@cache
def _cleared_key(depth_format: DepthFormat) -> int:
    """Return the nearness key of the cleared buffer."""
    cleared = np.array([depth_format.cleared], depth_format.stored_type)
    return int(depth_format.nearness_key(cleared)[0])
