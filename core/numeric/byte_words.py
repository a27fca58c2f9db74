"""Three bytes in one 64-bit word with room for fractions between them, and how they meet in a pixel.

A word has blue at bits 40 to 63 as 8.16 in fixed point, red at 20 to 39 and green at 0 to 19 as 8.12. Three
operations make a pixel of it: mask the three bytes, multiply so that they meet at bit 40, shift. In this order what the
product puts elsewhere lies below bit 40 or beyond bit 63.
"""

import numpy as np
from numpy.typing import NDArray

from core.numeric.buffers import ScratchBuffers
from core.records.arrays import Integers

Words = NDArray[np.uint32]

FIELDS = ((20, 12), (0, 12), (40, 16))
"""Lowest bit, and bits of the fraction, of red, green and blue."""
OPAQUE = np.uint32(0xFF000000)
"""A pixel with alpha 255 and no colour."""
DRIFT = 2.0**-13
"""Bytes that a value is off at most after one step: half of the last bit of the shortest fraction."""
_INTEGER_BITS = np.uint64(0xFF << 12 | 0xFF << 32 | 0xFF << 56)
_MEETING = np.uint64(1 + (1 << 8) + (1 << 36))
_SHIFT = np.uint64(40)


def pack_pixels(words: NDArray[np.uint64], wide: NDArray[np.uint64], pixels: NDArray[np.uint32]) -> None:
    """Write the whole parts of ``words`` (F,) as opaque ``pixels`` (F,); ``wide`` (F,) is memory, or ``words``."""
    np.bitwise_and(words, _INTEGER_BITS, out=wide)
    wide *= _MEETING
    wide >>= _SHIFT
    np.copyto(pixels, wide, casting="unsafe")
    pixels |= OPAQUE


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
