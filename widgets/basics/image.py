"""The one function that turns an array into a QImage, and the colour tables of scalars, signed errors and numbers.

Row 0, the bottom row, is flipped to the top.
"""

from functools import cache
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PySide6.QtGui import QImage

from core.framebuffer.display import linear_light, srgb
from widgets.basics.theme import VERTEX_COLORS, Theme
from widgets.grid.layers import GridBuffer

# Colour tables: viridis and cividis for scalars, diverging for signed errors, distinct colours for ids.


COLORMAPS = ("viridis", "cividis", "diverging", "diverging-dark", "grey")
"""Names that :func:`colormap_table` knows."""

ID_COLORS = ("#CC79A7", "#56B4E9", "#F0E442", "#D55E00")
"""The Okabe-Ito colours that are not taken by vertices 0, 1, 2: the first four ids."""

_DIVERGING = ("#40004b", "#7b4f96", "#c2a5cf", "#ffffff", "#dfb36a", "#a86a12", "#5a3000")
"""Purple to white to brown: apart for every kind of colour vision, and none of the three vertex colours."""
_DIVERGING_DARK = ("#e6c8f5", "#a678c4", "#5a3470", "#121415", "#6b4510", "#c08a3c", "#fbd79a")
"""The same on a dark page: a difference of 0 does not glare."""


@cache
def colormap_table(name: str) -> NDArray[np.uint8]:
    """Return a colour table.

    Parameters
    ----------
    name : str
        One of :data:`COLORMAPS`.

    Returns
    -------
    (N, 3) uint8 array
        sRGB from the lowest value to the highest, read-only. N is 256; 255 for ``diverging``, whose middle
        entry 127 is exactly white, and ``diverging-dark``, where it is nearly black.

    Raises
    ------
    ValueError
        If the name is unknown.

    References
    ----------
    S. van der Walt, N. Smith: viridis, 2015. J. Nunez, C. Anderton, R. Renslow: Optimizing colormaps with
    consideration for color vision deficiency (cividis), 2018. Tables as in pyqtgraph.
    """
    if name == "grey":
        table = np.repeat(np.arange(256, dtype=np.uint8)[:, None], 3, axis=1)
    elif name == "diverging":
        table = _through(_DIVERGING, 255)
    elif name == "diverging-dark":
        table = _through(_DIVERGING_DARK, 255)
    elif name in COLORMAPS:
        table = np.rint(255.0 * np.loadtxt(_table_file(name), delimiter=",", comments=";")).astype(np.uint8)
    else:
        raise ValueError(f"colormap must be one of {', '.join(COLORMAPS)}, got {name!r}")
    table.setflags(write=False)
    return table


def colormap_on(name: str, theme: Theme) -> str:
    """Return the colour table that stands for one of this name on the page of a theme."""
    return "diverging-dark" if name == "diverging" and theme.is_dark else name


def _table_file(name: str) -> Path:
    """Return the file of pyqtgraph with a map, without importing pyqtgraph, which takes 0.4 s."""
    spec = find_spec("pyqtgraph")
    if spec is None or not spec.submodule_search_locations:
        raise ModuleNotFoundError("the package pyqtgraph is not installed")
    return Path(spec.submodule_search_locations[0], "colors", "maps", f"{name}.csv")


@cache
def id_table(count: int = 4096) -> NDArray[np.uint8]:
    """Return ``count`` distinct colours for ids, (count, 3) uint8 sRGB, read-only.

    The first are :data:`ID_COLORS`; the others take the golden angle in hue and vary in lightness, so that
    neighbouring ids differ for every kind of colour vision. They avoid the hue of the accent.
    """
    ids = np.arange(count)
    fraction = (ids * 0.6180339887498949) % 1.0
    hue = np.radians(25.0 + 300.0 * fraction)
    lightness = np.array([0.78, 0.58, 0.88, 0.68])[ids % 4]
    table = oklch_to_srgb(lightness, np.full(count, 0.10), hue)
    for index, color in enumerate(ID_COLORS[:count]):
        table[index] = _parse(color)
    table.setflags(write=False)
    return table


def oklch_to_srgb(
    lightness: NDArray[np.float64], chroma: NDArray[np.float64], hue: NDArray[np.float64]
) -> NDArray[np.uint8]:
    """Turn N colours in OKLCH (lightness 0 to 1, chroma, hue in radians) into (N, 3) uint8 sRGB, clipped.

    References
    ----------
    B. Ottosson: A perceptual color space for image processing, 2020.
    """
    a, b = chroma * np.cos(hue), chroma * np.sin(hue)
    long = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3
    medium = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3
    short = (lightness - 0.0894841775 * a - 1.2914855480 * b) ** 3
    linear = np.stack(
        (
            4.0767416621 * long - 3.3077115913 * medium + 0.2309699292 * short,
            -1.2684380046 * long + 2.6097574011 * medium - 0.3413193965 * short,
            -0.0041960863 * long - 0.7034186147 * medium + 1.7076147010 * short,
        ),
        axis=-1,
    ).clip(0.0, 1.0)
    return np.rint(255.0 * srgb(linear)).astype(np.uint8)


def _through(colors: tuple[str, ...], count: int) -> NDArray[np.uint8]:
    """Return (count, 3) uint8 colours that run evenly through ``colors``."""
    stops = np.array([_parse(color) for color in colors], dtype=np.float64)
    places = np.linspace(0, len(colors) - 1, count)
    channels = [np.interp(places, np.arange(len(colors)), stops[:, k]) for k in range(3)]
    return np.rint(np.stack(channels, axis=-1)).astype(np.uint8)


def _parse(color: str) -> tuple[int, int, int]:
    """Return the three bytes of ``#rrggbb``."""
    return int(color[1:3], 16), int(color[3:5], 16), int(color[5:7], 16)


# The one function that turns an array into a QImage; row 0, the bottom row, is flipped here.


_SRGB_STEPS = 65535
_TRANSPARENT = 0
_OPAQUE = 0xFF000000


def buffer_image(buffer: GridBuffer, theme: Theme) -> QImage:
    """Return the picture of a buffer, one image pixel per pixel.

    Parameters
    ----------
    buffer : GridBuffer
        (H, W) or (H, W, C) values, row 0 at the bottom.
    theme : Theme
        Colours of empty, covered, NaN and infinite pixels.

    Returns
    -------
    QImage
        W x H pixels, ARGB32, row 0 at the top. No primitive (a negative id) and alpha 0 are transparent.

    Notes
    -----
    NaN alternates between two greys from pixel to pixel (a checker), infinite values have a colour of their
    own. Linear colour is encoded as sRGB by a table of 65536 entries, at most one level from the exact value.
    Transparency is straight alpha. Values outside the range take the colour of the nearest end.
    """
    values = buffer.values
    if values.ndim == 3 and buffer.channels == 1:
        values = values[:, :, 0]
    if buffer.kind == "bool":
        pixels = _pack(np.array([theme.empty, theme.covered]))[(values != 0).astype(np.intp)]
    elif buffer.kind == "ids":
        pixels = _id_pixels(values)
    elif buffer.kind == "color":
        pixels = _color_pixels(values, theme)
    elif buffer.kind == "weights":
        pixels = _weight_pixels(values, theme)
    elif values.ndim == 3:
        pixels = _channel_pixels(values, value_range(buffer), theme)
    else:
        pixels = _scalar_pixels(values, value_range(buffer), colormap_on(buffer.colormap, theme), theme)
    if buffer.known is not None:
        pixels = np.where(buffer.known, pixels, _pack(np.array([theme.empty]))[0])
    return _to_image(pixels)


def display_image(pixels: NDArray[np.uint8]) -> QImage:
    """Return a drawn picture as an image, quickly: many times a second.

    Parameters
    ----------
    pixels : (H, W, 4) uint8
        sRGB, row 0 at the bottom.

    Returns
    -------
    QImage
        W x H pixels, RGB32, row 0 at the top. Alpha is left out, as a window leaves it out that shows a
        frame buffer: what lies behind the pixels is in them already.
    """
    flipped = np.ascontiguousarray(pixels[::-1])
    rows, columns, _ = flipped.shape
    image = QImage(flipped.data, columns, rows, 4 * columns, QImage.Format.Format_RGBX8888)
    return image.convertToFormat(QImage.Format.Format_RGB32)


def transparent_image(pixels: NDArray[np.uint8]) -> QImage:
    """Return (H, W, 4) uint8 sRGB with straight alpha, row 0 at the bottom, as a W x H image."""
    flipped = np.ascontiguousarray(pixels[::-1])
    rows, columns, _ = flipped.shape
    return QImage(flipped.data, columns, rows, 4 * columns, QImage.Format.Format_RGBA8888).copy()


def mask_image(mask: NDArray[np.bool_]) -> QImage:
    """Return an (H, W) bool mask as a W x H image: opaque black where it is true, else transparent."""
    return _to_image(np.where(mask, np.uint32(_OPAQUE), np.uint32(_TRANSPARENT)))


def value_range(buffer: GridBuffer) -> tuple[float, float]:
    """Return the values at the two ends of a buffer's colormap, low <= high.

    The range of the buffer if it has one, else that of the finite values (for signed ones made symmetric
    about 0); (0, 1) where no value is finite.
    """
    low, high = buffer.range if buffer.range is not None else fitted_range(buffer.values)
    if buffer.kind == "signed":
        high = max(abs(low), abs(high))
        low = -high
    return low, high


def fitted_range(values: NDArray[np.generic]) -> tuple[float, float]:
    """Return the least and the largest finite value of an array of any shape, or (0, 1)."""
    if values.dtype.kind == "f":
        low, high = float(values.min()), float(values.max())
        if not (np.isfinite(low) and np.isfinite(high)):
            finite = values[np.isfinite(values)]
            if finite.size == 0:
                return 0.0, 1.0
            low, high = float(finite.min()), float(finite.max())
        return low, high
    return float(values.min()), float(values.max())


def _scalar_pixels(
    values: NDArray[np.generic], ends: tuple[float, float], name: str, theme: Theme
) -> NDArray[np.uint32]:
    """Return (H, W) packed colours of (H, W) scalars."""
    table = _packed_table(name)
    unit, is_finite = _normalized(values, ends)
    indices = (unit * (len(table) - 1) + 0.5).astype(np.intp)
    pixels = table[indices]
    return pixels if is_finite is None else _mark_not_finite(pixels, values, is_finite, theme)


def _channel_pixels(
    values: NDArray[np.generic], ends: tuple[float, float], theme: Theme
) -> NDArray[np.uint32]:
    """Return (H, W) packed colours of (H, W, C) values: three channels over the range, not encoded."""
    unit, is_finite = _normalized(values[:, :, :3], ends)
    levels = (unit * 255.0 + 0.5).astype(np.uint32)
    pixels = np.full(levels.shape[:2], _OPAQUE, np.uint32)
    for channel in range(levels.shape[2]):
        pixels |= levels[:, :, channel] << np.uint32(16 - 8 * channel)
    if is_finite is None:
        return pixels
    return _mark_not_finite(pixels, values[:, :, :3], is_finite, theme)


def _color_pixels(values: NDArray[np.generic], theme: Theme) -> NDArray[np.uint32]:
    """Return (H, W) packed colours of linear floats or of sRGB bytes, with 1, 3 or 4 channels."""
    if values.ndim == 2:
        values = np.repeat(values[:, :, None], 3, axis=2)
    is_finite = None
    if values.dtype == np.uint8:
        levels = values.astype(np.uint32)
    else:
        unit, is_finite = _normalized(values, (0.0, 1.0))
        steps = (unit[:, :, :3] * _SRGB_STEPS + 0.5).astype(np.uint16)
        levels = srgb_table()[steps].astype(np.uint32)
        if values.shape[2] == 4:
            alpha = (unit[:, :, 3:] * 255.0 + 0.5).astype(np.uint32)
            levels = np.concatenate((levels, alpha), axis=2)
    pixels = levels[:, :, 0] << np.uint32(16) | levels[:, :, 1] << np.uint32(8) | levels[:, :, 2]
    pixels |= levels[:, :, 3] << np.uint32(24) if values.shape[2] == 4 else np.uint32(_OPAQUE)
    return pixels if is_finite is None else _mark_not_finite(pixels, values, is_finite, theme)


def _weight_pixels(values: NDArray[np.generic], theme: Theme) -> NDArray[np.uint32]:
    """Return (H, W) packed colours of (H, W, 3) weights: the vertex colours mixed in linear light."""
    unit, is_finite = _normalized(values, (0.0, 1.0))
    mixed = unit @ _vertex_light()
    steps = (mixed.clip(0.0, 1.0) * _SRGB_STEPS + 0.5).astype(np.uint16)
    levels = srgb_table()[steps].astype(np.uint32)
    pixels = levels[:, :, 0] << np.uint32(16) | levels[:, :, 1] << np.uint32(8) | levels[:, :, 2]
    pixels |= np.uint32(_OPAQUE)
    return pixels if is_finite is None else _mark_not_finite(pixels, values, is_finite, theme)


def _id_pixels(values: NDArray[np.generic]) -> NDArray[np.uint32]:
    """Return (H, W) packed colours of (H, W) ids; entry 0 of the table is "none"."""
    table = _packed_ids()
    ids = values.astype(np.int64)
    return table[np.where(ids < 0, 0, ids % (len(table) - 1) + 1)]


def _normalized(
    values: NDArray[np.generic], ends: tuple[float, float]
) -> tuple[NDArray[np.float64], NDArray[np.bool_] | None]:
    """Return values as 0 to 1 over the range (0.5 if it has no width), and which are finite (None: all)."""
    low, high = ends
    is_finite = None
    floats = values.astype(np.float64)
    if values.dtype.kind == "f":
        found = np.isfinite(floats)
        if not found.all():
            is_finite = found
            floats[~found] = low
    if high > low:
        # Halved before the difference, which could overflow for values near the largest float.
        floats *= 0.5
        floats -= 0.5 * low
        floats /= 0.5 * high - 0.5 * low
        np.clip(floats, 0.0, 1.0, out=floats)
    else:
        floats = np.where(floats < low, 0.0, np.where(floats > low, 1.0, 0.5))
    return floats, is_finite


def _mark_not_finite(
    pixels: NDArray[np.uint32], values: NDArray[np.generic], is_finite: NDArray[np.bool_], theme: Theme
) -> NDArray[np.uint32]:
    """Give pixels with a NaN the checker's greys and pixels with an infinite value their colour."""
    is_nan: NDArray[np.bool_] = np.isnan(values)
    if values.ndim == 3:
        is_nan, is_finite = np.any(is_nan, axis=2), np.all(is_finite, axis=2)
    light, dark, infinite = _pack(np.array([theme.nan_light, theme.nan_dark, theme.infinite]))
    pixels[~is_finite] = infinite
    rows, columns = np.nonzero(is_nan)
    pixels[rows, columns] = np.where((rows + columns) % 2 == 0, light, dark)
    return pixels


def _to_image(pixels: NDArray[np.uint32]) -> QImage:
    """Return packed ARGB pixels, (H, W) uint32 with row 0 at the bottom, as an image that owns its memory."""
    flipped = np.ascontiguousarray(pixels[::-1])
    rows, columns = flipped.shape
    return QImage(flipped.data, columns, rows, 4 * columns, QImage.Format.Format_ARGB32).copy()


@cache
def srgb_table() -> NDArray[np.uint8]:
    """Return the sRGB byte of each linear value i / 65535, (65536,) uint8, read-only (IEC 61966-2-1)."""
    linear = np.arange(_SRGB_STEPS + 1) / _SRGB_STEPS
    table = np.rint(255.0 * srgb(linear)).astype(np.uint8)
    table.setflags(write=False)
    return table


@cache
def _vertex_light() -> NDArray[np.float64]:
    """Return the three vertex colours in linear light, (3, 3) float64."""
    packed = _pack(np.array(VERTEX_COLORS))
    encoded = (
        np.stack([(packed >> np.uint32(shift)) & np.uint32(255) for shift in (16, 8, 0)], axis=1) / 255.0
    )
    return linear_light(encoded)


@cache
def _packed_table(name: str) -> NDArray[np.uint32]:
    """Return a colormap as (N,) packed ARGB."""
    return _pack_bytes(colormap_table(name))


@cache
def _packed_ids() -> NDArray[np.uint32]:
    """Return the colours of ids as packed ARGB, after one transparent entry for "none"."""
    return np.concatenate((np.array([_TRANSPARENT], np.uint32), _pack_bytes(id_table())))


def _pack_bytes(table: NDArray[np.uint8]) -> NDArray[np.uint32]:
    """Return (N, 3) sRGB bytes as (N,) packed opaque ARGB."""
    wide = table.astype(np.uint32)
    packed: NDArray[np.uint32] = wide[:, 0] << np.uint32(16) | wide[:, 1] << np.uint32(8) | wide[:, 2]
    return packed | np.uint32(_OPAQUE)


def _pack(colors: NDArray[np.str_]) -> NDArray[np.uint32]:
    """Return N colours ``#rrggbb`` as (N,) packed opaque ARGB."""
    return np.array([int(color[1:], 16) | _OPAQUE for color in colors.tolist()], dtype=np.uint32)
