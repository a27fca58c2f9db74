"""Colour tables: viridis and cividis for scalars, diverging for signed errors, distinct colours for ids."""

from functools import cache
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from core.framebuffer.display import srgb

COLORMAPS = ("viridis", "cividis", "diverging", "grey")
"""Names that :func:`colormap_table` knows."""

ID_COLORS = ("#CC79A7", "#56B4E9", "#F0E442", "#D55E00")
"""The Okabe-Ito colours that are not taken by vertices 0, 1, 2: the first four ids."""

_DIVERGING = ("#40004b", "#7b4f96", "#c2a5cf", "#ffffff", "#dfb36a", "#a86a12", "#5a3000")
"""Purple to white to brown: apart for every kind of colour vision, and none of the three vertex colours."""


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
        entry 127 is exactly white.

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
    elif name in COLORMAPS:
        table = np.rint(255.0 * np.loadtxt(_table_file(name), delimiter=",", comments=";")).astype(np.uint8)
    else:
        raise ValueError(f"colormap must be one of {', '.join(COLORMAPS)}, got {name!r}")
    table.setflags(write=False)
    return table


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
