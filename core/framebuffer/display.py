"""Display: linear colour to the sRGB bytes of a screen or file, and back.

A byte is ``floor(255 s + 1/2)`` of the sRGB value s (half rounds up), values outside 0 to 1 are cut off. The
formula has a power in it, and there are only 256 results: the smallest float32 value of every byte is
searched once, and a picture is compared with these. So the bytes are those of the formula, bit for bit.

References
----------
IEC 61966-2-1, Default RGB colour space: sRGB, 1999.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import floor, isnan

import numpy as np
from numpy.typing import NDArray

from core.arrays import Flags, Floats, Singles, read_only

Bytes = NDArray[np.uint8]

_BLOCK = 65536
"""Values that are encoded at once, so that their numbers stay in the processor's cache."""


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
        power = 1.055 * np.float_power(linear, 1 / 2.4) - 0.055
    return np.where(linear <= 0.0031308, 12.92 * linear, power)


def linear_light(encoded: Floats) -> Floats:
    """Return the linear values of sRGB ones, for arrays of any shape: the inverse of `srgb`."""
    return np.where(encoded <= 0.04045, encoded / 12.92, np.float_power((encoded + 0.055) / 1.055, 2.4))


def srgb_byte(linear: float) -> int:
    """Return the byte of one linear value (listing of `encode_srgb`)."""
    if isnan(linear):
        return 0  #: undefined
    clipped = min(max(linear, 0.0), 1.0)  #: clip
    if clipped <= 0.0031308:
        encoded = 12.92 * clipped  #: straight-part
    else:
        encoded = 1.055 * clipped ** (1 / 2.4) - 0.055  #: power-part
    return floor(255 * encoded + 0.5)  #: round


@lru_cache(maxsize=1)
def srgb_thresholds() -> Singles:
    """Return (255,) float32: element k is the smallest linear value whose byte is k + 1."""
    wanted = np.arange(1, 256)
    below, reached = np.zeros(255, np.int64), np.full(255, int(np.float32(1).view(np.int32)))
    # Positive floats are ordered like their bits: bisect those.
    while (reached - below > 1).any():
        middle = (below + reached) // 2
        values = middle.astype(np.int32).view(np.float32).astype(np.float64)
        high = np.floor(255 * srgb(values) + 0.5) >= wanted
        reached, below = np.where(high, middle, reached), np.where(high, below, middle)
    return read_only(reached.astype(np.int32).view(np.float32))


@lru_cache(maxsize=1)
def _tables() -> tuple[Bytes, Singles]:
    """Return the byte of the smallest float32 of each upper 16 bits, and the threshold above every byte.

    Values with the same upper 16 bits have never more than one threshold among them: one comparison decides.
    """
    thresholds = srgb_thresholds()
    upper_bits = np.arange(65536, dtype=np.uint32) << 16
    smallest = upper_bits.view(np.float32)
    lowest_byte = np.searchsorted(thresholds, smallest, side="right").astype(np.uint8)
    lowest_byte[~(smallest > 0)] = 0  # negative or NaN
    return lowest_byte, np.append(thresholds, np.float32(np.nan))


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
    values = _as_float32(linear)
    lowest_byte, next_threshold = _tables()
    flat, encoded = values.ravel(), np.empty(values.size, np.uint8)
    for start in range(0, flat.size, _BLOCK):
        part = flat[start : start + _BLOCK]
        byte = lowest_byte.take(part.view(np.uint32) >> 16)
        byte += part >= next_threshold.take(byte)
        encoded[start : start + _BLOCK] = byte
    undefined = np.isnan(flat)
    if undefined.any():
        encoded[undefined] = 0
    return encoded.reshape(values.shape)


def encode_linear(values: Singles) -> Bytes:
    """Return the bytes of values (any shape) that are not gamma coded, such as alpha; else as `encode_srgb`."""
    clipped = np.clip(np.nan_to_num(_as_float32(values).astype(np.float64), nan=0.0), 0.0, 1.0)
    return np.floor(255 * clipped + 0.5).astype(np.uint8)


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
    pixels = encode_srgb(color)
    if color.shape[2] == 4:
        pixels[..., 3] = encode_linear(color[..., 3])
    undefined = np.zeros(color.shape[:2], np.bool_)
    for channel in range(color.shape[2]):
        undefined |= np.isnan(color[..., channel])
    return DisplayImage(read_only(pixels), read_only(undefined))


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
