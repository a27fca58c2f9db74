"""Temporal antialiasing: one sample a pixel in every picture, each picture's at another place, mixed over time.

Picture k of N is taken at point N - k of a Halton sequence, bases 2 and 3, moved by half a pixel: so the last one,
which is stepped in all other stages, has its samples at the pixels' centres. Points lie on the 1/256-pixel grid that
corners are snapped to, so moving the triangles is exact.

The colour that is kept, the history, goes towards the new one by a share: 1/k in picture k, which makes the plain mean
of all of them, but no less than ``blend_share``: from then on old pictures fade. Where the camera moves, the history is
looked up where the surface was in the picture before (``history`` reprojected). Where something else moves, what it
leaves behind stays as a ghost until it has faded, unless the history is limited to the range of the 3 x 3 new colours
around (clamped). Then what is thinner than a pixel is lost wherever no sample around has hit it, and flickers.

References
----------
J. Halton, *On the efficiency of certain quasi-random sequences of points*, 1960.
B. Karis, *High quality temporal supersampling*, SIGGRAPH course, 2014 (clamping).
L. Yang, S. Liu, M. Salvi, *A survey of temporal antialiasing techniques*, 2020.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import floor

import numpy as np

from core.antialiasing.moving import moves_camera, place_before
from core.coverage.snapping import SUBPIXELS
from core.records.arrays import Flags, Floats, Singles
from core.scene import AnyScene, Scene


def halton(index: int, base: int) -> float:
    """Return a number of the Halton sequence: the digits of ``index`` behind the point, in reverse order."""
    value = 0.0
    share = 1.0
    while index > 0:
        share /= base
        value += share * (index % base)
        index //= base
    return value


def sample_point(index: int) -> tuple[float, float]:
    """Listing of where in its pixel a sample lies, from the lower left corner, in steps of 1/256 pixel.

    Examples
    --------
    >>> [sample_point(k) for k in range(3)]
    [(0.5, 0.5), (0.0, 0.83203125), (0.75, 0.1640625)]
    """
    x, y = ((halton(index, base) + 0.5) % 1.0 for base in (2, 3))
    return floor(SUBPIXELS * x) / SUBPIXELS, floor(SUBPIXELS * y) / SUBPIXELS  #: point


def blended_history(
    new: float, history: float | None, low: float, high: float, k: int, least: float, is_clamped: bool
) -> float:
    """Listing of one channel of a pixel in picture ``k``: what is kept of it."""
    if history is None:
        return new  #: begin
    if is_clamped:
        history = min(max(history, low), high)  #: clamp
    share = max(1 / k, least)  #: share
    return history + share * (new - history)  #: mix


@dataclass(frozen=True, eq=False)
class HistoryRule:
    """What is done to the history before a new picture is mixed in."""

    follows_camera: bool
    is_clamped: bool


@dataclass(frozen=True, eq=False)
class MixedPicture:
    """Picture k of a sequence of H x W pictures: what is new, what was kept, what is kept now."""

    point: tuple[float, float]
    """Where the samples lie in their pixels."""
    share: float
    """Of the new picture in what is kept, where there is a history."""
    new: Singles
    """(H, W, 4) float32, linear."""
    from_x: Floats
    """(H, W) float64, where in the window the history was looked up."""
    from_y: Floats
    """(H, W) float64."""
    is_known: Flags
    """(H, W) bool, whether there is a history: not in the first picture, nor where a pixel was outside of it."""
    history: Floats
    """(H, W, 4) float64, looked up; the new colour where there is none."""
    low: Floats
    """(H, W, 4) float64, least of the 3 x 3 new colours around."""
    high: Floats
    """(H, W, 4) float64, greatest of them."""
    limited: Floats
    """(H, W, 4) float64, the history that is mixed with the new colour."""
    kept: Floats
    """(H, W, 4) float64."""


def mix_pictures(
    scene: AnyScene,
    rule: HistoryRule,
    count: int,
    least: float,
    origin: tuple[float, float],
    draw: Callable[[int, tuple[float, float]], tuple[Singles, Floats]],
) -> list[MixedPicture]:
    """Draw ``count`` pictures and mix each with the history.

    Parameters
    ----------
    least : float
        Least share of a new picture.
    origin : (float, float)
        Where the centre of the lower left pixel lies in the window.
    draw : callable
        Of how many pictures ago, and the sample's place: colours (H, W, 4) and window depths (H, W).
    """
    found: list[MixedPicture] = []
    for k in range(1, count + 1):
        age = count - k
        point = sample_point(age)
        new, depth = draw(age, point)
        height, width = depth.shape
        y, x = np.mgrid[:height, :width] + np.array(origin)[::-1, None, None]
        is_known = np.full((height, width), k > 1)
        history = new.astype(np.float64)
        if k > 1:
            x, y, history, is_known = _looked_up(
                scene, rule, age, point, (x, y, depth), origin, found[-1].kept, history
            )
        low, high = range_around(new)
        limited = np.clip(history, low, high) if rule.is_clamped else history
        share = max(1 / k, least)
        kept = np.where(is_known[..., None], limited + share * (new - limited), new)
        found.append(MixedPicture(point, share, new, x, y, is_known, history, low, high, limited, kept))
    return found


def _looked_up(
    scene: AnyScene,
    rule: HistoryRule,
    age: int,
    point: tuple[float, float],
    seen: tuple[Floats, Floats, Floats],
    origin: tuple[float, float],
    kept: Floats,
    new: Floats,
) -> tuple[Floats, Floats, Floats, Flags]:
    """Return where the history of pixels lies, x and y (H, W), its colours (H, W, 4), and where there is one."""
    x, y, depth = seen
    if not (rule.follows_camera and moves_camera(scene)):
        return x, y, kept, np.ones(x.shape, bool)
    assert isinstance(scene, Scene)
    # What the sample sees has moved; the pixel's centre goes the same way.
    at_x, at_y = x + point[0] - 0.5, y + point[1] - 0.5
    was_x, was_y = place_before(scene, age, at_x, at_y, depth)
    from_x, from_y = x + (was_x - at_x), y + (was_y - at_y)
    history, is_known = look_up(kept, from_x - origin[0], from_y - origin[1])
    return from_x, from_y, np.where(is_known[..., None], history, new), is_known


def look_up(picture: Floats, column: Floats, row: Floats) -> tuple[Floats, Flags]:
    """Return the colours (H, W, 4) of a picture between its pixels, bilinear, and whether they lie in it (H, W).

    ``column`` and ``row`` (H, W) are 0 at the first pixel's centre; half a pixel beyond the outermost ones is in it.
    """
    height, width = picture.shape[:2]
    with np.errstate(invalid="ignore"):
        is_inside = (column >= -0.5) & (column <= width - 0.5) & (row >= -0.5) & (row <= height - 0.5)
    x, y = (
        np.clip(np.where(is_inside, at, 0.0), 0, most - 1) for at, most in ((column, width), (row, height))
    )
    left, below = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    right, above = np.minimum(left + 1, width - 1), np.minimum(below + 1, height - 1)
    across, up = (x - left)[..., None], (y - below)[..., None]
    lower = picture[below, left] + across * (picture[below, right] - picture[below, left])
    upper = picture[above, left] + across * (picture[above, right] - picture[above, left])
    return lower + up * (upper - lower), is_inside


def range_around(new: Singles) -> tuple[Floats, Floats]:
    """Return the least and the greatest (H, W, 4) of the 3 x 3 colours around pixels; those at the border repeat."""
    wide = np.pad(new.astype(np.float64), ((1, 1), (1, 1), (0, 0)), mode="edge")
    height, width = new.shape[:2]
    parts = np.stack([wide[j : j + height, i : i + width] for j in range(3) for i in range(3)])
    return parts.min(axis=0), parts.max(axis=0)


def ghost_length(share: float, visible: float = 1 / 255) -> int:
    """Return after how many pictures less than ``visible`` is left of a colour, each new one with a constant share.

    Examples
    --------
    >>> [ghost_length(share) for share in (0.5, 0.2, 0.1, 0.05)]
    [8, 25, 53, 109]
    """
    left, count = 1.0, 0
    while left >= visible:
        left *= 1 - share
        count += 1
    return count
