"""Display: linear colour to the sRGB bytes of a screen or file, and back.

A byte is ``floor(255 s + 1/2)`` of the sRGB value s (half rounds up), values outside 0 to 1 are cut off. The
formula has a power in it, and there are only 256 results: the smallest float32 value of every byte is
searched once, and a table made of these, the thresholds, gives the bytes of the formula, bit for bit, by one
look-up and one addition (see `byte_table`).

References
----------
IEC 61966-2-1, Default RGB colour space: sRGB, 1999.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from math import floor, isnan

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Flags, Floats, Singles, read_only

Bytes = NDArray[np.uint8]
Words = NDArray[np.uint32]

SRGB_LIMIT, SRGB_SLOPE = 0.0031308, 12.92
"""Linear values up to the limit are on the straight part of the sRGB curve, which rises by the slope."""
SRGB_SCALE, SRGB_OFFSET, SRGB_EXPONENT = 1.055, 0.055, 2.4
"""Beyond it is the part ``scale * linear ** (1 / exponent) - offset``."""
ENCODED_LIMIT = 0.04045
"""The sRGB value at the limit."""

_BLOCK = 16384
"""Values that are encoded at once, so that their numbers stay in the processor's cache."""

_INFINITY = 0x7F80
"""Upper 16 bits of float32 infinity, and of the first NaNs."""


@dataclass(frozen=True, eq=False)
class DisplayImage:
    """A frame as a screen shows it."""

    pixels: Bytes
    """(H, W, C) uint8: sRGB, alpha linear."""
    undefined: Flags
    """(H, W) bool, pixels with a NaN; it is shown as 0."""


def srgb(linear: Floats) -> Floats:
    """Return the sRGB values (0 to 1) of linear ones (0 to 1): the formula, for arrays of any shape."""
    with np.errstate(invalid="ignore"):
        power = SRGB_SCALE * np.float_power(linear, 1 / SRGB_EXPONENT) - SRGB_OFFSET
    return np.where(linear <= SRGB_LIMIT, SRGB_SLOPE * linear, power)


def linear_light(encoded: Floats) -> Floats:
    """Return the linear values of sRGB ones, for arrays of any shape: the inverse of `srgb`."""
    power = np.float_power((encoded + SRGB_OFFSET) / SRGB_SCALE, SRGB_EXPONENT)
    return np.where(encoded <= ENCODED_LIMIT, encoded / SRGB_SLOPE, power)


def srgb_byte(linear: float) -> int:
    """Return the byte of one linear value (listing of `encode_srgb`)."""
    if isnan(linear):
        return 0
    clipped = min(max(linear, 0.0), 1.0)  #: clip
    if clipped <= 0.0031308:
        encoded = 12.92 * clipped  #: straight-part
    else:
        encoded = 1.055 * clipped ** (1 / 2.4) - 0.055  #: power-part
    return floor(255 * encoded + 0.5)  #: round


@lru_cache(maxsize=1)
def srgb_thresholds() -> Singles:
    """Return (255,) float32: element k is the smallest linear value whose byte is k + 1."""
    return _thresholds(srgb)


def _thresholds(encode: Callable[[Floats], Floats]) -> Singles:
    """Return the smallest float32 value of every byte but 0, for a rising ``encode`` of 0 to 1."""
    wanted = np.arange(1, 256)
    below, reached = np.zeros(255, np.int64), np.full(255, int(np.float32(1).view(np.int32)))
    # Positive floats are ordered like their bits: bisect those.
    while (reached - below > 1).any():
        middle = (below + reached) // 2
        values = middle.astype(np.int32).view(np.float32).astype(np.float64)
        high = np.floor(255 * encode(values) + 0.5) >= wanted
        reached, below = np.where(high, middle, reached), np.where(high, below, middle)
    return read_only(reached.astype(np.int32).view(np.float32))


def byte_table(thresholds: Singles) -> Words:
    """Return what is added to the bits of a float32 to carry its byte into bits 16 to 23.

    Parameters
    ----------
    thresholds : (255,) float32 array
        Rising; never two of them with the same upper 16 bits, and none among infinity and NaN.

    Returns
    -------
    (65536,) uint32 array
        One summand for every upper half of a float32.

    Notes
    -----
    Let the upper half of the bits be u and the lower half l. Without a threshold among the values of u, the
    entry is ``byte * 2**16 - u * 2**16``, so that the sum is ``byte * 2**16 + l``. A threshold with lower half
    t adds ``2**16 - t``: the sum carries into the byte just where l >= t. Infinity is 255, and NaN (the same
    u, l > 0) is one more, which is 0 in eight bits. Negative values and all other NaN are 0.
    """
    bits = thresholds.view(np.uint32).astype(np.int64)
    upper, lower = bits >> 16, bits & 0xFFFF
    # With a lower half of 0 a threshold is reached by all values of its u, otherwise by all of the next u only.
    is_between = lower > 0
    byte = np.cumsum(np.bincount(upper + is_between, minlength=65536)[:65536])
    summand = byte << 16
    summand[upper[is_between]] += 0x10000 - lower[is_between]
    summand[_INFINITY] = (255 << 16) + 0xFFFF
    summand[_INFINITY + 1 :] = 0
    return read_only((summand - (np.arange(65536) << 16)).astype(np.uint32))


@lru_cache(maxsize=1)
def _display_table() -> Words:
    """Return the table of gamma coded values, and behind it that of plain ones, (2 * 65536,) uint32."""
    plain = _thresholds(lambda values: values)
    return read_only(np.concatenate([byte_table(srgb_thresholds()), byte_table(plain)]))


def encode_srgb(linear: Singles) -> Bytes:
    """Return the sRGB bytes of linear values.

    Parameters
    ----------
    linear : float32 array of any shape
        Other types are rounded to float32 first. NaN gives 0, values outside 0 to 1 are cut off.

    Returns
    -------
    uint8 array of the same shape
    """
    return _encode(linear, plain=slice(0))


def encode_linear(values: Singles) -> Bytes:
    """Return the bytes of values (any shape) that are not gamma coded, such as alpha; else as `encode_srgb`."""
    return _encode(values, plain=slice(None))


def _encode(values: Singles, plain: slice) -> Bytes:
    values = _as_float32(values)
    encoded = np.empty(values.shape, np.uint8)
    _write_bytes(values.reshape(-1), encoded.reshape(-1), plain)
    return encoded


def _write_bytes(values: Singles, encoded: Bytes, plain: slice) -> None:
    """Write the bytes of ``values`` (F,), contiguous, to ``encoded`` (F,); ``plain`` ones are not gamma coded.

    Values are written a block at a time; ``plain`` must choose the same ones in every block.
    """
    table, bits = _display_table(), values.view(np.uint32)
    memory, index_memory = np.empty(_BLOCK, np.uint32), np.empty(_BLOCK, np.int64)
    for start in range(0, len(bits), _BLOCK):
        part = bits[start : start + _BLOCK]
        word, index = memory[: len(part)], index_memory[: len(part)]
        np.right_shift(part, 16, out=word)
        np.copyto(index, word)
        index[plain] += 65536
        table.take(index, out=word, mode="clip")
        word += part
        word >>= 16
        np.copyto(encoded[start : start + _BLOCK], word, casting="unsafe")


def write_pixels(color: Singles, pixels: Bytes) -> None:
    """Write the display bytes of ``color`` (F, 3 or 4) float32, contiguous, to ``pixels``, uint8 of its shape.

    The bytes are those of `to_display`.
    """
    alpha = slice(3, None, 4) if color.shape[1] == 4 else slice(0)
    _write_bytes(color.reshape(-1), pixels.reshape(-1), alpha)


def to_display(color: Singles) -> DisplayImage:
    """Return a frame's linear colours as display bytes.

    Parameters
    ----------
    color : (H, W, 3 or 4) float32 array
        Linear; row 0 stays row 0. Alpha is not gamma coded, and colours are not divided by it.

    Raises
    ------
    ValueError
        If ``color`` is not (H, W, 3 or 4).
    """
    color = _as_float32(color)
    if color.ndim != 3 or color.shape[2] not in (3, 4):
        raise ValueError(f"color must be (H, W, 3 or 4), got {color.shape}")
    pixels = np.empty(color.shape, np.uint8)
    channels = color.shape[2]
    write_pixels(color.reshape(-1, channels), pixels.reshape(-1, channels))
    return DisplayImage(read_only(pixels), read_only(_undefined(color)))


def picture_bytes(color: Singles, blend: str) -> Bytes:
    """Return the sRGB bytes (H, W, 4) uint8 of a frame with straight alpha, as image files want them.

    Parameters
    ----------
    color : (H, W, 4) float32
        As the method ``blend`` leaves it: ``opaque`` stores straight alpha, others premultiplied colours.
    """
    if blend != "opaque":
        alpha = color[..., 3:]
        is_partial = (alpha > 0) & (alpha < 1)
        straight = np.divide(color[..., :3], alpha, out=color[..., :3].copy(), where=is_partial)
        color = np.concatenate([straight, alpha], axis=2)
    return to_display(color).pixels


def _undefined(color: Singles) -> Flags:
    """Return where ``color`` (H, W, C) has a NaN, (H, W) bool."""
    undefined = np.zeros(color.shape[:2], np.bool_)
    # The maximum of an array with a NaN is NaN; hardly any picture has one.
    if color.size and np.isnan(color.max()):
        np.isnan(color).any(axis=2, out=undefined)
    return undefined


@lru_cache(maxsize=1)
def srgb_decode_table() -> Singles:
    """Return (256,) float32: the linear value of every sRGB byte."""
    return read_only(linear_light(np.arange(256) / 255).astype(np.float32))


def from_display(pixels: Bytes) -> Singles:
    """Return the linear colours of an image file, as a texture wants them.

    Parameters
    ----------
    pixels : (H, W, C) uint8 array
        C = 1, 3 or 4: sRGB; the fourth channel is alpha, which is not gamma coded.

    Returns
    -------
    (h, w, C) float32 array

    Raises
    ------
    ValueError
        If ``pixels`` is not (h, w, 1, 3 or 4) uint8.
    """
    pixels = np.asarray(pixels)
    if pixels.ndim != 3 or pixels.shape[2] not in (1, 3, 4):
        raise ValueError(f"pixels must be (h, w, 1, 3 or 4), got {pixels.shape}")
    if pixels.dtype != np.uint8:
        raise ValueError(f"pixels must be uint8, got {pixels.dtype}")
    color: Singles = srgb_decode_table().take(pixels)
    if pixels.shape[2] == 4:
        color[..., 3] = (pixels[..., 3] / 255).astype(np.float32)
    return color


def _as_float32(values: Singles) -> Singles:
    with np.errstate(over="ignore"):
        return np.ascontiguousarray(values, dtype=np.float32)
