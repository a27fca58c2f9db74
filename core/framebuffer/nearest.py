"""The nearest fragment of every pixel, found in batches: depth and drawing order packed into one integer key.

Notes
-----
The key is (nearness << 32) | (primitive + 1), so that the least key of a pixel is its nearest fragment, and of equally
near ones the one drawn first: exactly what testing them one by one keeps. With the depth test off it is
(later primitives first << 32) | bits of the stored depth. ``numpy.minimum.at`` takes about 2 ns a fragment.
"""

import numpy as np

from core.arrays import Integers, Singles
from core.framebuffer.depth import DepthFormat


class NearestFragments:
    """Least key per pixel over all fragments added so far; primitives are numbered in drawing order."""

    def __init__(
        self, pixel_count: int, primitive_count: int, depth_format: DepthFormat, uses_depth_test: bool
    ) -> None:
        self._format = depth_format
        self._uses_depth_test = uses_depth_test
        self._last = primitive_count - 1
        cleared = int(depth_format.nearness_key(np.array([depth_format.cleared], np.float32))[0])
        self._cleared = cleared << 32 if uses_depth_test else (primitive_count << 32) | cleared
        self._keys = np.full(pixel_count, self._cleared, np.int64)

    def add(self, pixel: Integers, primitive: Integers, stored: Singles) -> None:
        """Take fragments in: pixel index (F,), primitive (F,), stored depth (F,) float32."""
        nearness = self._format.nearness_key(stored)
        if self._uses_depth_test:
            key = (nearness << 32) | (primitive + 1)
        else:
            key = ((self._last - primitive) << 32) | nearness
        np.minimum.at(self._keys, pixel, key)

    def resolve(self) -> tuple[Integers, Integers, Singles]:
        """Return the pixels that something is seen at (V,), the primitive there (V,), and the depth buffer (H*W,)."""
        pixel = np.flatnonzero(self._keys != self._cleared)
        high, low = self._keys[pixel] >> 32, self._keys[pixel] & 0xFFFFFFFF
        primitive, nearness = (low - 1, high) if self._uses_depth_test else (self._last - high, low)
        depth = np.full(len(self._keys), self._format.cleared, np.float32)
        depth[pixel] = self._format.stored_of_key(nearness)
        return pixel, primitive, depth
