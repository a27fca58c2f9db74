"""Fast approximate antialiasing: edges are found in the finished picture, and their staircases smoothed.

All is done on what the screen shows, sRGB values from 0 to 1. The luma of a pixel stands for its brightness. Where it
differs much among a pixel and its four neighbours, an edge is there; its direction is that in which luma bends less.
The two rows (or columns) beside the edge are walked both ways until the mean of their lumas leaves that at the pixel by
a quarter of the step between them: there the staircase has its next stair. The nearer end tells how far the colour is
moved towards the other side of the edge: half a pixel at the end, nothing in the middle. Detail of one pixel has no
long edge; there the 3 x 3 pixels around tell how far.

Beyond the image's border the pixels at the border repeat.

References
----------
T. Lottes, *FXAA*, NVIDIA white paper, 2009 (contrast, direction, walk); *FXAA 3.11 quality*, 2011 (both offsets).
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import floor
from typing import Any

import numpy as np

from core.antialiasing.resolve import grown, inner_of
from core.coverage.pixel_runs import Raster
from core.framebuffer.display import encode_srgb, linear_light, srgb
from core.records.arrays import Flags, Floats, Integers, Singles
from core.records.frame import Frame

LEAST_CONTRAST = 1 / 24
"""Range of luma below which nothing is an edge."""
CONTRAST_SHARE = 1 / 8
"""Share of the largest luma that the range must reach."""
END_SHARE = 1 / 4
"""Share of the step across the edge by which the mean of both sides leaves that at the pixel where the edge ends."""
MOST_STEPS = 12
"""Pixels walked each way."""
DETAIL_SHARE = 3 / 4
"""How far detail of one pixel is moved at most."""
REACH = MOST_STEPS + 1
"""Pixels each way that the colour of a pixel depends on."""


@dataclass(frozen=True, eq=False)
class EdgePixels:
    """What is found at E pixels that lie beside an edge; ``place`` tells which."""

    place: Integers
    """(E,) int64, row times width plus column."""
    around: Floats
    """(E, 3, 3) float64, luma by row and column from the lower left neighbour."""
    is_horizontal: Flags
    """(E,) bool: the edge runs along the row."""
    side: Integers
    """(E,) int64: 1 where the other side is above or to the right, -1 below or to the left."""
    pair: Floats
    """(E,) float64, mean luma of the pixel and the one across the edge."""
    step: Floats
    """(E,) float64, by how much their lumas differ."""
    walked: Floats
    """(E, 2, `MOST_STEPS`) float64, mean luma of both sides, backwards and forwards; NaN: not walked so far."""
    distance: Integers
    """(E, 2) int64, pixels walked backwards and forwards."""
    edge_offset: Floats
    """(E,) float64, by how much the nearer end moves the colour, in pixels."""
    detail_offset: Floats
    """(E,) float64, by how much the 3 x 3 pixels around do."""

    @property
    def offset(self) -> Floats:
        """(E,) float64, the larger of both."""
        return np.maximum(self.edge_offset, self.detail_offset)


@dataclass(frozen=True, eq=False)
class SmoothedPicture:
    """An H x W picture after the filter, and what it was made by."""

    color: Singles
    """(H, W, 4) float32, linear."""
    shown: Floats
    """(H, W, 4) float64, what the screen showed before: sRGB red, green, blue, and alpha, 0 to 1."""
    luma: Floats
    """(H, W) float64."""
    contrast: Floats
    """(H, W) float64, range of luma among a pixel and its four neighbours."""
    threshold: Floats
    """(H, W) float64, what the range must reach."""
    edges: EdgePixels
    other: Floats
    """(E, 4) float64, what the screen showed across the edge."""
    mixed: Floats
    """(E, 4) float64, what it shows now at pixels beside an edge."""


def luma_of(red: Floats, green: Floats, blue: Floats) -> Floats:
    """Return the luma of sRGB values, arrays of any shape (ITU-R BT.601)."""
    return 0.299 * red + 0.587 * green + 0.114 * blue


def smooth_edges(color: Singles) -> SmoothedPicture:
    """Filter a picture (H, W, 4) float32, linear; a NaN counts as 0, as it is shown."""
    with np.errstate(invalid="ignore"):
        clipped = np.clip(np.nan_to_num(color.astype(np.float64)), 0.0, 1.0)
    shown = np.concatenate([srgb(clipped[..., :3]), clipped[..., 3:]], axis=2)
    luma = luma_of(*np.moveaxis(shown[..., :3], 2, 0))
    height, width = luma.shape
    wide = np.pad(luma, 1, mode="edge")
    cross = np.stack([luma, wide[2:, 1:-1], wide[:-2, 1:-1], wide[1:-1, :-2], wide[1:-1, 2:]])
    highest = cross.max(axis=0)
    contrast = highest - cross.min(axis=0)
    threshold = np.maximum(LEAST_CONTRAST, CONTRAST_SHARE * highest)
    row, column = np.nonzero(contrast >= threshold)
    around = np.stack(
        [np.stack([wide[row + j, column + i] for i in range(3)], axis=1) for j in range(3)], axis=1
    )
    edges = _follow_edges(luma, row, column, around, contrast[row, column])
    other = _across_edge(edges.side, edges.is_horizontal, row, column, (height, width))
    share = edges.offset[:, None]
    mixed = (1 - share) * shown[row, column] + share * shown[other]
    smoothed, is_moved = color.copy(), edges.offset > 0
    smoothed[row[is_moved], column[is_moved]] = _linear_of(mixed[is_moved])
    return SmoothedPicture(smoothed, shown, luma, contrast, threshold, edges, shown[other], mixed)


def _linear_of(mixed: Floats) -> Singles:
    """Return linear colours (E, 4) float32 whose bytes are those of sRGB values ``mixed``, also of those half-way."""
    linear = linear_light(mixed[:, :3]).astype(np.float32)
    missing = np.floor(255 * mixed[:, :3] + 0.5) - encode_srgb(linear)
    linear = np.where(
        missing == 0, linear, np.nextafter(linear, np.where(missing > 0, np.float32(2), np.float32(-1)))
    )
    return np.concatenate([linear, mixed[:, 3:].astype(np.float32)], axis=1)


def _across_edge(
    side: Integers, is_horizontal: Flags, row: Integers, column: Integers, shape: tuple[int, int]
) -> tuple[Integers, Integers]:
    """Return row and column (E,) of the pixels on the other side of the edges at pixels (E,)."""
    height, width = shape
    up, right = side * is_horizontal, side * ~is_horizontal
    return np.clip(row + up, 0, height - 1), np.clip(column + right, 0, width - 1)


def _follow_edges(
    luma: Floats, row: Integers, column: Integers, around: Floats, contrast: Floats
) -> EdgePixels:
    """Find direction, ends and offsets of the edges at pixels (E,)."""
    height, width = luma.shape
    along_row, along_column = bends(around)
    is_horizontal = along_row >= along_column
    middle = around[:, 1, 1]
    before = np.where(is_horizontal, around[:, 0, 1], around[:, 1, 0])
    after = np.where(is_horizontal, around[:, 2, 1], around[:, 1, 2])
    is_before = np.abs(before - middle) >= np.abs(after - middle)
    side = np.where(is_before, -1, 1)
    other = np.where(is_before, before, after)
    pair, step = (middle + other) / 2, np.abs(other - middle)

    # Both rows, or columns, beside the edge, backwards and forwards.
    walked = np.full((len(row), 2, MOST_STEPS), np.nan)
    distance = np.full((len(row), 2), MOST_STEPS)
    end = np.zeros((len(row), 2))
    other_row, other_column = _across_edge(side, is_horizontal, row, column, luma.shape)
    for way, sign in enumerate((-1, 1)):
        going = np.arange(len(row))
        for k in range(1, MOST_STEPS + 1):
            up, right = sign * k * ~is_horizontal[going], sign * k * is_horizontal[going]
            one, two = (
                luma[np.clip(rows[going] + up, 0, height - 1), np.clip(columns[going] + right, 0, width - 1)]
                for rows, columns in ((row, column), (other_row, other_column))
            )
            value = (one + two) / 2
            walked[going, way, k - 1] = value
            end[going, way] = value - pair[going]
            has_ended = np.abs(end[going, way]) >= END_SHARE * step[going]
            distance[going[has_ended], way] = k
            going = going[~has_ended]
    nearer = np.where(distance[:, 0] < distance[:, 1], 0, 1)
    every = np.arange(len(row))
    edge_offset = 0.5 - distance[every, nearer] / distance.sum(axis=1)
    edge_offset[(middle < pair) == (end[every, nearer] < 0)] = 0.0

    sides, corners = _sums(around)
    share = np.minimum(np.abs((2 * sides + corners) / 12 - middle) / contrast, 1.0)
    smooth = (3 - 2 * share) * share * share
    detail_offset = DETAIL_SHARE * smooth * smooth
    return EdgePixels(
        row * width + column,
        around,
        is_horizontal,
        side,
        pair,
        step,
        walked,
        distance,
        edge_offset,
        detail_offset,
    )


def bends(around: Floats) -> tuple[Floats, Floats]:
    """Return second differences (E,) of luma (E, 3, 3) across rows and across columns; the middle one counts twice."""
    across = [around, around.transpose(0, 2, 1)]
    sizes = [np.abs(lumas[:, 0] - 2 * lumas[:, 1] + lumas[:, 2]) for lumas in across]
    row, column = (size[:, 0] + 2 * size[:, 1] + size[:, 2] for size in sizes)
    return np.asarray(row), np.asarray(column)


def _sums(around: Floats) -> tuple[Floats, Floats]:
    """Return the sums (E,) of the four neighbours beside a pixel, and of the four at its corners."""
    sides = around[:, 0, 1] + around[:, 1, 0] + around[:, 1, 2] + around[:, 2, 1]
    corners = around[:, 0, 0] + around[:, 0, 2] + around[:, 2, 0] + around[:, 2, 2]
    return sides, corners


def smoothed_frame(frame: Frame, wide: Raster, raster: Raster) -> Frame:
    """Return the pixels of ``raster`` of a frame that was drawn with `REACH` pixels more on every side."""
    with frame.statistics["resolve"]:
        color = smooth_edges(frame.color).color
    rows, columns = inner_of(wide, raster)
    names = ("depth", "primitive", "attributes", "cover_count")
    parts: dict[str, Any] = {
        name: np.ascontiguousarray(getattr(frame, name)[rows, columns]) for name in names
    }
    return replace(frame, color=np.ascontiguousarray(color[rows, columns]), **parts)


def around_edges(raster: Raster) -> Raster:
    """Return the raster with all pixels that the filter looks at."""
    return grown(raster, REACH)


def steps_to_end(means: Sequence[float], pair: float, step: float) -> int:
    """Listing of a walk: after how many pixels the mean of both sides has left that at the pixel, 12 at most."""
    k = 0
    for mean in means:
        k += 1
        if abs(mean - pair) >= step / 4:
            break
    return k


def edge_pixel(
    around: Sequence[Sequence[float]], back: Sequence[float], forth: Sequence[float]
) -> tuple[bool, int, float]:
    """Listing of one pixel: whether its edge is horizontal, the side of the other colour, and how far it is moved.

    ``around`` holds the lumas of the 3 x 3 pixels, from the lower left; ``back`` and ``forth`` are the means of both
    sides of the edge along it.
    """
    (sw, s, se), (w, m, e), (nw, n, ne) = around
    highest = max(n, s, w, e, m)
    contrast = highest - min(n, s, w, e, m)  #: contrast
    if contrast < max(1 / 24, highest / 8):
        return False, 0, 0.0
    along_row = abs(sw - 2 * w + nw) + 2 * abs(s - 2 * m + n) + abs(se - 2 * e + ne)  #: rows
    along_column = abs(sw - 2 * s + se) + 2 * abs(w - 2 * m + e) + abs(nw - 2 * n + ne)  #: columns
    horizontal = along_row >= along_column  #: direction
    before, after = (s, n) if horizontal else (w, e)
    side = -1 if abs(before - m) >= abs(after - m) else 1  #: side
    other = before if side < 0 else after
    pair, step = (m + other) / 2, abs(other - m)  #: pair
    k = steps_to_end(back, pair, step)  #: back
    j = steps_to_end(forth, pair, step)  #: forth
    end = back[k - 1] if k < j else forth[j - 1]
    edge = 0.0 if (m < pair) == (end < pair) else 1 / 2 - min(k, j) / (k + j)  #: edge
    sides, corners = s + w + e + n, sw + se + nw + ne
    share = min(abs((2 * sides + corners) / 12 - m) / contrast, 1.0)
    smooth = (3 - 2 * share) * share * share
    detail = 3 / 4 * smooth * smooth  #: detail
    return horizontal, side, max(edge, detail)  #: offset


def mixed_byte(own: float, other: float, offset: float) -> int:
    """Listing of one channel, sRGB from 0 to 1: moved towards the other side of the edge, and its byte."""
    mixed = (1 - offset) * own + offset * other  #: blend
    return floor(255 * mixed + 0.5)  #: round
