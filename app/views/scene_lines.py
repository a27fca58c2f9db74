"""Lines in space drawn into a picture by the core's own line method, hidden parts faint."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from core.arrays import Floats, Integers
from core.framebuffer.display import Bytes
from core.geometry.culling import plane_distances
from core.geometry.matrices import transform
from core.raster.lines import draw_lines, interpolate_line

DEPTH_BIAS = 0.004
"""How much farther than the surface, as a part of its distance, a line on it may seem to be."""


@dataclass(frozen=True, eq=False)
class SpaceLine:
    """A line through points of the space that is shown."""

    points: Floats = field(repr=False)
    """(N, 3) float64; a point that is not finite interrupts it."""
    ink: str
    """Name of a colour, see ``widgets.ink``."""
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


def draw_space_lines(
    pixels: Bytes,
    depth: Floats,
    inverse_w: Callable[[Floats], Floats],
    lines: tuple[SpaceLine, ...],
    matrix: Floats,
    colors: list[str],
) -> None:
    """Draw lines over a picture.

    Parameters
    ----------
    pixels : (H, W, 4) uint8
        The picture, written to.
    depth : (H, W) float64
        Depth of what is seen.
    inverse_w : callable
        1/w of depths (F,).
    lines : tuple of SpaceLine
        From the first drawn to the last.
    matrix : (4, 4) float64
        Space to clip space of the viewing camera.
    colors : list of str
        ``#rrggbb`` of every line.
    """
    ends, owner = [], []
    for index, line in enumerate(lines):
        ends.append(np.stack([line.points[:-1], line.points[1:]], axis=1))
        owner.append(np.full(len(line.points) - 1, index))
    if not ends:
        return
    height, width = pixels.shape[:2]
    segments = np.concatenate(ends)
    homogeneous = np.concatenate([segments, np.ones((*segments.shape[:2], 1))], axis=2)
    with np.errstate(invalid="ignore", over="ignore"):
        clip, source = visible_part(transform(matrix, homogeneous))
    window = (clip[..., :2] / clip[..., 3:] + 1) * np.array([width / 2, height / 2])
    drawn = draw_lines(window, width, height, last_pixel=True)
    line_of = np.concatenate(owner)[source][drawn.owner]

    # 1/w is linear in the window, as depth is.
    near = interpolate_line(drawn.owner, drawn.steps.t, (1 / clip[..., 3])[..., None])[:, 0]
    column, row = drawn.pixels.T
    farthest = depth[row, column]
    # A line on a slanted surface or along its border counts as seen if it would be in a pixel beside.
    for up, right in ((0, 1), (0, -1), (1, 0), (-1, 0)):
        beside = depth[np.clip(row + up, 0, height - 1), np.clip(column + right, 0, width - 1)]
        farthest = np.maximum(farthest, beside)
    seen = inverse_w(farthest)
    opacity = np.where(
        near >= seen * (1 - DEPTH_BIAS), 1.0, np.array([line.hidden for line in lines])[line_of]
    )
    inks = np.array([[int(color[k : k + 2], 16) for k in (1, 3, 5)] for color in colors])[line_of]
    along = np.abs(window[:, 1] - window[:, 0])
    other_axis = np.where((along[:, 0] >= along[:, 1])[:, None], [0, 1], [1, 0])[drawn.owner]
    widths = np.array([line.width for line in lines])[line_of]
    for offset in range(int(widths.max(initial=1))):
        chosen = np.flatnonzero(widths > offset)
        place = drawn.pixels[chosen] + other_axis[chosen] * offset
        inside = (place < [width, height]).all(axis=1)
        chosen, place = chosen[inside], place[inside]
        under = pixels[place[:, 1], place[:, 0], :3]
        share = opacity[chosen, None]
        pixels[place[:, 1], place[:, 0], :3] = np.rint(under * (1 - share) + inks[chosen] * share)
        pixels[place[:, 1], place[:, 0], 3] = 255
