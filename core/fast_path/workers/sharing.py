"""How the work on a picture is shared: whether it is worth it, where a band ends, and what the bands say."""

from collections import deque
from collections.abc import Sequence
from dataclasses import astuple, dataclass, replace
from itertools import pairwise
from multiprocessing.shared_memory import SharedMemory
from statistics import median

import numpy as np
from numpy.typing import NDArray

from core.fast_path.draw_context import Coloring, Picture, Route, Split, Visibility
from core.records.arrays import Floats
from core.records.frame import StageCount
from core.stages.declared import GEOMETRY_STAGES

# How the work on a picture was shared, and what the bands say about the whole picture.


@dataclass(frozen=True)
class BandTime:
    """Rows that one process drew."""

    first: int
    end: int
    seconds: float


@dataclass(frozen=True)
class Sharing:
    """How the work on the last picture was shared."""

    bands: tuple[BandTime, ...] = ()
    """The first was drawn by this process, the others by workers; empty: this process drew all."""
    reason: str = ""
    """Why this process drew all."""
    gain: float = 0.0
    """Seconds that sharing was estimated to gain, from the picture before."""

    @property
    def process_count(self) -> int:
        """Processes that drew."""
        return max(len(self.bands), 1)


def joined_counts(statistics: Sequence[dict[str, StageCount]]) -> dict[str, StageCount]:
    """Return the statistics of a picture out of those of its bands, the first of which this process drew.

    Notes
    -----
    Counts are those of the whole picture. Seconds are those of this process: the others ran at the same time.
    """
    counts = {stage: replace(count) for stage, count in statistics[0].items()}
    for stage, count in counts.items():
        if stage not in GEOMETRY_STAGES:
            count.incoming = sum(part[stage].incoming for part in statistics)
            count.outgoing = sum(part[stage].outgoing for part in statistics)
    # Each band clips its own triangles; one that reaches into two is clipped, and counted, twice.
    added = sum(part["clip"].outgoing - part["clip"].incoming for part in statistics)
    counts["clip"].outgoing = counts["clip"].incoming + added
    counts["edges"].incoming = counts["edges"].outgoing = counts["bin"].incoming = counts["clip"].outgoing
    return counts


def have_colors_of_whole(routes: Sequence[Route], plain_colors: bool) -> bool:
    """Return whether bands have the colours that one process gives the whole picture.

    Parameters
    ----------
    routes : sequence of Route
        Of all bands.
    plain_colors : bool
        Whether they were asked for colours of attributes and light at every pixel.

    Notes
    -----
    Which triangles have bytes is decided for each alone. Of the other cheaper colours, which are right where all
    triangles allow them, a scene has one kind at most, by what its vertices carry: the whole picture has them if all of
    its bands do. One colour a triangle is the same bytes whichever way it is worked out.
    """
    if not all(route.allowed for route in routes):
        # Parts of a supersampled picture choose for themselves.
        shown = {route.color for route in routes if route.visible}
        return not plain_colors and len(shown - {"palette"}) <= 1
    allowed = {route.allowed for route in routes} - {"palette"}
    return "deferred" in allowed if plain_colors else len(allowed) <= 1


def joined_route(routes: Sequence[Route]) -> Route:
    """Return the route of a picture out of those of its bands; a triangle in two bands went its way twice."""
    # A band that shows nothing says nothing of the others.
    shown = [route for route in routes if route.visible] or routes
    # A band in which nothing is hidden needs no depth; the picture does where one of its bands does.
    needed = next((route for route in shown if route.visibility != "layer"), shown[0])
    color = next((route.color for route in shown if route.color != "palette"), needed.color)
    visible = sum(route.visible for route in routes)
    splits = [route.split for route in routes if route.split is not None]
    total = Split(*(sum(ways) for ways in zip(*map(astuple, splits), strict=True))) if splits else None
    return replace(needed, color=color, split=total, visible=visible)


# Where one band ends and the next begins, so that all are done at the same time, and where its pixels lie.


PIXEL_BYTES = 4
STEP = 0.1
"""Largest part of the height that a cut moves after one picture: one slow picture is no reason to turn all over."""
DAMPING = 0.5
"""Part of the way that a cut moves: times are never twice the same."""


def even_cuts(count: int) -> Floats:
    """Return the cuts (count + 1,) float64 of bands of the same height, 0 at the bottom to 1 at the top."""
    return np.linspace(0.0, 1.0, count + 1)


def rows_of(cuts: Floats, height: int) -> list[tuple[int, int]]:
    """Return first and end row of every band of a picture of ``height`` rows, none of them empty.

    Parameters
    ----------
    cuts : (N + 1,) float64
        From 0 to 1, parts of the height.
    height : int
        At least N.
    """
    count = len(cuts) - 1
    place = np.arange(count + 1)
    rows = np.clip(np.rint(cuts * height).astype(np.int64), place, height - count + place)
    rows = np.maximum.accumulate(rows - place) + place
    return [(int(first), int(end)) for first, end in pairwise(rows)]


def moved_cuts(cuts: Floats, seconds: Floats, fixed: Floats) -> Floats:
    """Return the cuts for the next picture, closer to bands that take the same time.

    Parameters
    ----------
    cuts : (N + 1,) float64
        Those of the last picture.
    seconds : (N,) float64
        What every band took.
    fixed : (N,) float64
        The part of it that does not depend on its rows: vertices, culling, the message.

    Notes
    -----
    Within a band the work is taken to be spread evenly over its rows. Where it is not, the next picture tells: the
    cuts rest where all bands take the same time, however wrong ``fixed`` is.
    """
    fixed = np.minimum(fixed, seconds)
    divided = seconds - fixed
    total = divided.sum()
    wanted = np.maximum(seconds.mean() - fixed, 0.0)
    if total <= 0 or wanted.sum() <= 0:
        return cuts
    done = np.concatenate([[0.0], np.cumsum(divided)]) / total
    target = np.concatenate([[0.0], np.cumsum(wanted)]) / wanted.sum()
    # A band without work has no inside: the small slope keeps the places in order.
    done = (done + 1e-6 * cuts) / (1 + 1e-6)
    move: Floats = np.clip(DAMPING * (np.interp(target, done, cuts) - cuts), -STEP, STEP)
    return cuts + move


def byte_count(rows: int, columns: int) -> int:
    """Return how many bytes a band needs."""
    return rows * columns * PIXEL_BYTES


def band_pixels(memory: SharedMemory, rows: int, columns: int) -> NDArray[np.uint8]:
    """Return the pixels (rows, columns, 4) uint8 of a band, as a view of the memory."""
    return np.ndarray((rows, columns, PIXEL_BYTES), np.uint8, memory.buf)


# Whether more than one process is worth it: estimated from what the last picture held.


TRIANGLE, PIXEL = 60e-9, 1e-9
"""Seconds for a triangle that is drawn, and for a pixel that is cleared and shown; measured on one core, as all that
follow, to within a factor of two."""
FRAGMENT: dict[Visibility, float] = {
    "layer": 6e-9,
    "packed-depth": 8e-9,
    "stacks": 60e-9,
    "frame": 250e-9,
    "supersampled": 8e-9,
    "multisampled": 8e-9,
}
"""Seconds for a covered pixel of a triangle, by ``Route.visibility``."""
COLOR: dict[Coloring, float] = {
    "palette": 1e-9,
    "corners": 8e-9,
    "texture": 25e-9,
    "lit": 60e-9,
    "deferred": 120e-9,
}
"""Seconds for the colour of a pixel, by ``Route.color``."""
COLORS_EVERY_FRAGMENT = ("stacks", "frame")
"""Here the colour is part of what a fragment takes."""
ASKING = 0.5e-3
"""Seconds that asking, waking and putting together take."""
LEAST_GAIN = 1e-3
"""Seconds that must be gained: less is not seen, and the other core has its own work."""


@dataclass(frozen=True)
class Load:
    """What a picture held of the work that bands divide; vertices and culling are every band's own work."""

    triangles: int
    """Those that are drawn."""
    pixels: int
    fragments: int
    """Covered pixels of all triangles."""
    visible: int
    """Pixels that something is seen at."""
    visibility: Visibility = "packed-depth"
    """As in ``Route``, which see; also ``color``."""
    color: Coloring = "corners"

    @property
    def seconds(self) -> float:
        """Estimated time of the work that bands divide, on one core."""
        color = 0.0 if self.visibility in COLORS_EVERY_FRAGMENT else COLOR[self.color]
        return (
            TRIANGLE * self.triangles
            + PIXEL * self.pixels
            + FRAGMENT[self.visibility] * self.fragments
            + color * self.visible
        )

    def gain(self, processes: int) -> float:
        """Estimated seconds gained by so many processes."""
        return self.seconds * (1 - 1 / processes) - ASKING

    def is_worth(self, processes: int) -> bool:
        """Return whether so many processes draw such a picture noticeably faster than one."""
        return self.gain(processes) >= LEAST_GAIN


def load_of(picture: Picture) -> Load:
    """Return what a picture held."""
    height, width, _ = picture.pixels.shape
    route = picture.route
    return Load(
        picture.statistics["edges"].outgoing,
        width * height,
        picture.statistics["raster"].outgoing,
        route.visible,
        route.visibility,
        route.color,
    )


# Whether sharing is faster here and now: measured, because the other core may have work of its own.


EVIDENCE = 5
"""Pictures of a kind that tell how long they take."""
ALONE_FOR = 30
"""Pictures drawn in one process after sharing turned out slower, before it is tried again."""
ALONE_FOR_AT_MOST = 480
"""Each time it turns out slower again the pause doubles, up to this."""
SAME_KIND = 2.0
"""Pictures whose estimated work is within this factor can be compared."""


class Pace:
    """Compares pictures drawn alone with pictures drawn together.

    Notes
    -----
    A few pictures are drawn alone first. Then they are shared for as long as that is faster than those were; where it
    is not, one process draws for a while, and sharing is tried again: what keeps the other core busy may end. So while
    all is well no picture is drawn slowly only to compare.
    """

    def __init__(self) -> None:
        self._alone: deque[float] = deque(maxlen=EVIDENCE)
        self._shared: deque[float] = deque(maxlen=EVIDENCE)
        self._estimate = 0.0
        self._pause = 0
        self._next_pause = ALONE_FOR

    @property
    def may_share(self) -> bool:
        """Whether the next picture should be shared, as far as times tell."""
        return self._pause == 0 and len(self._alone) == EVIDENCE

    @property
    def reason(self) -> str:
        """Why the next picture should not be shared."""
        return "sharing was slower than one process" if self._pause else "one process is timed first"

    def alone(self, seconds: float, load: Load) -> None:
        """Take note of a picture that one process drew."""
        self._compare_with(load)
        self._alone.append(seconds)
        self._pause = max(self._pause - 1, 0)

    def shared(self, seconds: float, load: Load) -> None:
        """Take note of a picture that was shared."""
        if not self._compare_with(load):
            return
        self._shared.append(seconds)
        if len(self._shared) < EVIDENCE:
            return
        if median(self._shared) <= median(self._alone):
            self._next_pause = ALONE_FOR
            return
        self._pause = self._next_pause
        self._next_pause = min(2 * self._next_pause, ALONE_FOR_AT_MOST)
        self._shared.clear()

    def _compare_with(self, load: Load) -> bool:
        """Forget what was measured where the work is of another kind; return whether it is of the same."""
        if self._estimate / SAME_KIND <= load.seconds <= self._estimate * SAME_KIND:
            return True
        self._estimate = load.seconds
        self._alone.clear()
        self._shared.clear()
        self._pause, self._next_pause = 0, ALONE_FOR
        return False
