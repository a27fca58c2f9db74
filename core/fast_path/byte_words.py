"""Colours that change linearly over the window, as words of three bytes (``core.numeric.byte_words``)."""

import numpy as np
from numpy.typing import NDArray

from core.numeric.byte_words import FIELDS, OPAQUE, pack_pixels
from core.raster.spans.scratch_buffers import ScratchBuffers
from core.records.arrays import Integers

Words = NDArray[np.uint32]

DRIFT = 2.0**-13
"""Bytes that a value is off at most after one step: half of the last bit of the shortest fraction."""


def unpack(word: Integers, scratch: ScratchBuffers) -> Words:
    """Return words (F,) as opaque pixels (F,) uint32; each has half a byte more, so that cutting off rounds."""
    pixels: Words = scratch("unpacked_pixels", len(word), dtype=np.uint32)
    pack_pixels(word.view(np.uint64), scratch("unpacked", len(word), dtype=np.uint64), pixels)
    return pixels


def pack_level(pixels: Words) -> Integers:
    """Return the words (P,) int64 that `unpack` turns into ``pixels`` (P,), whatever their alpha."""
    words = np.zeros(len(pixels), np.int64)
    for channel, (shift, bits) in enumerate(FIELDS):
        byte = (pixels.astype(np.int64) >> 8 * channel) & 0xFF
        words += byte << (shift + bits)
    return words


__all__ = ["DRIFT", "FIELDS", "OPAQUE", "pack_level", "unpack"]
