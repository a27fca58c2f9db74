"""Lines in space drawn into a picture by the core's own line method, hidden parts faint."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from core.framebuffer.display import Bytes
from core.geometry.culling import plane_distances
from core.geometry.matrices import transform
from core.raster.lines.drawing import draw_lines, interpolate_line
from core.raster.pixel_runs import expand
from core.records.arrays import Flags, Floats, Integers

DEPTH_BIAS = 0.004
"""How much farther than the surface, as a part of its distance, a line on it may seem to be."""


@dataclass(frozen=True, eq=False)
class SpaceLine:
    """A line through points of the space that is shown."""

    points: Floats = field(repr=False)
    """(N, 3) float64; a point that is not finite interrupts it."""
    ink: str
    """Name of a colour, see ``widgets.basics.theme``."""
    width: int = 1
    """Pixels."""
    hidden: float = 0.25
    """Opacity of the parts behind something."""


def visible_part(clip: Floats) -> tuple[Floats, Integers]:
    """Cut segments (L, 2, 4) in clip space to the view volume.

    Returns
    -------
    cut : (M, 2, 4) float64, w > 0
    source : (M,) int64, the segment that each is from

    References
    ----------
    Y. Liang, B. Barsky, *A new concept and method for line clipping*, 1984.
    """
    distance = plane_distances(clip)
    start, end = distance[:, 0], distance[:, 1]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        crossing = start / (start - end)
    enter = np.where((start < 0) & (end >= 0), crossing, 0.0).max(axis=1)
    leave = np.where((start >= 0) & (end < 0), crossing, 1.0).min(axis=1)
    keep = ~((start < 0) & (end < 0)).any(axis=1) & (enter <= leave) & np.isfinite(clip).all(axis=(1, 2))
    ends = np.stack([enter, leave], axis=1)[..., None]
    cut = clip[:, :1] + ends * (clip[:, 1:] - clip[:, :1])
    keep &= (cut[..., 3] > 0).all(axis=1)
    return cut[keep], np.flatnonzero(keep).astype(np.int64)


@dataclass(frozen=True, eq=False)
class LinePixels:
    """N pixels of lines in a picture, a pixel of each line one after the other along it."""

    column: Integers
    """(N,) int64."""
    row: Integers
    """(N,) int64."""
    inverse_w: Floats
    """(N,) float64, 1/w of the line there."""
    line: Integers
    """(N,) int64, which line it is."""
    is_steep: Flags
    """(N,) bool, whether the line goes up more than it goes across: then it is thick across."""
    size: tuple[int, int]
    """Width and height of the picture."""

    @property
    def depth_at(self) -> Integers:
        """(5 N,) int64, the places of the pixels, then of those left, right, below and above, within the picture."""
        width, height = self.size
        place = self.row * width + self.column
        return np.concatenate(
            [
                place,
                place - (self.column > 0),
                place + (self.column < width - 1),
                place - width * (self.row > 0),
                place + width * (self.row < height - 1),
            ]
        )


def find_line_pixels(lines: Sequence[SpaceLine], matrix: Floats, size: tuple[int, int]) -> LinePixels:
    """Return the pixels of lines in a picture.

    Parameters
    ----------
    matrix : (4, 4) float64
        Space to clip space of the viewing camera.
    size : (width, height)
    """
    ends = [np.stack([line.points[:-1], line.points[1:]], axis=1) for line in lines]
    segments = np.concatenate([np.zeros((0, 2, 3)), *ends])
    owner = np.repeat(np.arange(len(lines)), [len(of_line) for of_line in ends])
    homogeneous = np.concatenate([segments, np.ones((*segments.shape[:2], 1))], axis=2)
    with np.errstate(invalid="ignore", over="ignore"):
        clip, source = visible_part(transform(matrix, homogeneous))
    window = (clip[..., :2] / clip[..., 3:] + 1) * np.array([size[0] / 2, size[1] / 2])
    drawn = draw_lines(window, *size, last_pixel=True)
    # 1/w is linear in the window, as depth is.
    near = interpolate_line(drawn.owner, drawn.steps.t, (1 / clip[..., 3])[..., None])[:, 0]
    across, up = np.abs(window[:, 1] - window[:, 0]).T
    column, row = drawn.pixels.T
    return LinePixels(column, row, near, owner[source][drawn.owner], (up > across)[drawn.owner], size)


def paint_lines(
    pixels: Bytes, found: LinePixels, seen: Floats, lines: Sequence[SpaceLine], colors: Sequence[str]
) -> None:
    """Paint lines over a picture.

    Parameters
    ----------
    pixels : (H, W, 4) uint8, contiguous
        The picture, written to.
    seen : (5 N,) float64
        1/w of what is seen at ``found.depth_at``.
    lines : sequence of SpaceLine
        From the first drawn to the last.
    colors : sequence of str
        ``#rrggbb`` of every line.
    """
    # A line on a slanted surface or along its border counts as seen if it would be in a pixel beside.
    farthest = seen.reshape(5, -1).min(axis=0)
    hidden = np.array([line.hidden for line in lines])[found.line]
    opacity = np.where(found.inverse_w >= farthest * (1 - DEPTH_BIAS), 1.0, hidden)[:, None]
    inks = np.array([[int(color[k : k + 2], 16) for k in (1, 3, 5)] for color in colors]).reshape(-1, 3)
    ink = inks[found.line] * opacity
    width, height = found.size
    which, offset = expand(np.array([line.width for line in lines], np.int64)[found.line])
    is_steep = found.is_steep[which]
    column, row = found.column[which] + offset * is_steep, found.row[which] + offset * ~is_steep
    inside = np.flatnonzero((column < width) & (row < height))
    which, place = which[inside], (row * width + column)[inside]
    flat = pixels.reshape(-1, 4)
    flat[place, :3] = np.rint(flat[place, :3] * (1 - opacity[which]) + ink[which])
    flat[place, 3] = 255
