"""Trying settings: parts of the picture are drawn with them, compared and timed, and lost fragments are counted.

Drawn in parts, a pixel is the very pixel of the whole picture, bit for bit. Small pictures are tried whole; of larger
ones bands of rows at equal distances, `PIXELS` in all. What lies between the bands is not seen. Of more pixels the
largest difference is larger, so one byte more is predicted there; ``measuring`` draws the whole.

Which of two methods is faster depends on the scene (how many triangles, which of the fast ways can draw it) and on the
machine, so it is asked, not assumed. A picture of few pixels is drawn at two sizes: the triangles cost the same in
both, the pixels what the larger one takes longer, and a picture of any size is on the line through the two. The least
of some times is taken, as whatever disturbs a measurement makes it longer.

A trial sees that in the rows it draws. Between them every triangle is asked how far its fragments may lie
(`farthest_stored`), and where that does not settle it, for its fragments themselves.
"""

from collections.abc import Callable, Iterator, Sequence
from copy import copy
from dataclasses import dataclass, replace
from math import inf, sqrt
from sys import platform
from time import perf_counter, thread_time

import numpy as np

from core.antialiasing.resolve import at_sample, finer_raster, finer_scene, finer_settings, in_squares
from core.coverage.binning import bound
from core.coverage.pixel_runs import Raster, make_raster
from core.depth.depth import DepthFormat, Stored
from core.fast_path.draw import draw_picture
from core.framebuffer.display import to_display
from core.methods import table
from core.pipeline import draw
from core.records.arrays import Flags, Integers
from core.records.frame import StageCount
from core.resolved import resolve
from core.scene import AnyScene
from core.settings import Settings
from core.stages.bin_and_raster import fragments_of
from core.stages.declared import STAGES
from core.stages.fragments import farthest_stored, fragment_depth
from core.stages.geometry import Geometry
from core.stages.vertices import process_geometry
from core.study.planner.records import Tolerance
from core.study.record import collector_off

# Trying settings: parts of the picture are drawn with them and compared with those of the reference
# settings.


PIXELS = 128 * 128
"""Pixels that are tried at most, but for one row in every band."""
BANDS = 16
"""Bands of a picture that is not tried whole."""


def shown(scene: AnyScene, settings: Settings, region: tuple[int, int, int, int] | None = None) -> Integers:
    """Return the red, green and blue bytes of a picture, or of a region (column, row, columns, rows): (H, W, 3)."""
    frame = draw(scene, settings, make_raster(scene.size, settings.pixel_center, region))
    return to_display(frame.color).pixels[..., :3].astype(np.int64)


def difference(first: Integers, second: Integers) -> Integers:
    """Return the difference of the channel that differs most, (H, W) int64, of pictures (H, W, 3)."""
    return np.asarray(np.abs(first - second).max(axis=2, initial=0))


@dataclass(frozen=True)
class Trial:
    """How far two pictures were apart where they were compared."""

    error: int
    """Largest difference in 1/255 that is predicted, but for the ``pixels``."""
    pixels: int
    """Pixels that differ by more than the tolerance's colour, in the whole picture; no more than it allows."""
    largest: int
    """Largest difference of all."""
    beyond: int
    """Pixels that differ by more than the tolerance's colour, in the whole picture."""
    is_within: bool
    """Whether the tolerance holds where it was compared."""


@dataclass(frozen=True)
class Choice:
    """What was chosen of one family, and what was tried before."""

    family: str
    chosen: str
    dearest: str
    trial: Trial | None = None
    """How far the choice is from what was chosen before it; ``None``: nothing was chosen, or it has no effect."""
    rejected: tuple[tuple[str, Trial], ...] = ()
    """Cheaper methods that are too far from the reference settings, and how far."""
    slower: tuple[str, ...] = ()
    """Cheaper methods that would do but take longer."""
    unseen: tuple[str, ...] = ()
    """Cheaper methods that change, or may, single pixels where nothing is tried."""


class Trials:
    """Pictures of one scene with some settings, each drawn once, where they are tried."""

    def __init__(
        self, scene: AnyScene, tolerance: Tolerance, before_each: Callable[[], None] = lambda: None
    ) -> None:
        self._scene, self._tolerance = copy(scene), tolerance
        self._before_each = before_each
        """Called before every drawing; whatever it raises ends the trial."""
        width, height = scene.size
        self.regions = bands(width, height)
        self.rows = sum(region[3] for region in self.regions)
        """Rows of pixels that are compared."""
        self._pictures: dict[Settings, Integers] = {}

    @property
    def is_whole(self) -> bool:
        """Whether every pixel of the picture is compared."""
        return self.rows == self._scene.size[1]

    def compare(self, settings: Settings, others: Settings) -> Trial:
        """Return how far pictures with ``settings`` are from those with ``others``."""
        differences = np.sort(difference(self._drawn(settings), self._drawn(others)).ravel())[::-1]
        allowed, most = self._tolerance.pixels, self._tolerance.bytes
        share = self.rows / self._scene.size[1]
        found = int(np.count_nonzero(differences > most))
        is_within = found <= allowed * share
        left_out = found if is_within else 0
        error = int(differences[left_out:].max(initial=0))
        if share < 1:
            error = max(error, min(error + 1, most))
        return Trial(
            error,
            min(round(left_out / share), allowed),
            int(differences.max(initial=0)),
            round(found / share),
            is_within,
        )

    def _drawn(self, settings: Settings) -> Integers:
        """Return the rows that are compared, (R, W, 3)."""
        if settings not in self._pictures:
            parts = []
            for region in self.regions:
                self._before_each()
                parts.append(shown(self._scene, settings, region))
            self._pictures[settings] = np.concatenate(parts)
        return self._pictures[settings]


def bands(width: int, height: int) -> tuple[tuple[int, int, int, int], ...]:
    """Return the regions (column, row, columns, rows) of a picture that are tried: all of it, or bands of rows."""
    if width * height <= PIXELS:
        return ((0, 0, width, height),)
    count = min(BANDS, height)
    rows = max(PIXELS // (width * count), 1)
    starts = np.linspace(0, height - rows, count).astype(np.int64)
    return tuple((0, start, width, rows) for start in np.unique(starts).tolist())


# What settings cost on a scene: small pictures of it are drawn and timed, and so the time of the whole is
# predicted.


ROUNDS = 3
"""Timed drawings of each, in turn, after one that does not count; fewer once it is plain."""
TIMED_PIXELS = 64 * 64
"""Pixels of the larger of the two pictures."""
CLOCK = perf_counter if platform == "win32" else thread_time
"""Seconds of this thread alone, so that other work of the machine does not count; Windows counts them in 1/64 s."""
BAND = 0.1
"""Part by which times must differ to count as different."""


class Costs:
    """Nothing is timed: the methods that the lectures call cheaper are, on every scene and machine alike."""

    def is_slower(self, settings: Settings, others: Settings) -> bool:
        """Return whether ``settings`` are known to take longer than ``others``."""
        return False

    def seconds(self, options: Sequence[Settings]) -> tuple[float, ...] | None:
        """Return how long pictures with some settings take, if that is known."""
        return None


class TriedCosts(Costs):
    """Times of small pictures of a scene, each of a scene that nothing is known of."""

    def __init__(self, scene: AnyScene, before_each: Callable[[], None] = lambda: None) -> None:
        self._before_each = before_each
        """Called before every drawing; whatever it raises ends the trial."""
        width, height = scene.size
        self._pixels = width * height
        self._scenes = [scene]
        if self._pixels > TIMED_PIXELS:
            share = sqrt(TIMED_PIXELS / self._pixels)
            self._scenes = [
                replace(scene, size=(max(round(width * part), 1), max(round(height * part), 1)))
                for part in (share, share / 2)
            ]
        self._least: dict[Settings, list[float]] = {}

    def is_slower(self, settings: Settings, others: Settings) -> bool:
        """Return whether ``settings`` took longer than ``others`` in most rounds, and by more than `BAND` in all."""
        faster = 0
        for _ in range(ROUNDS):
            faster += self._draw(settings) <= self._draw(others)
            if 2 * faster > ROUNDS:
                return False
        return self._predicted(settings) > (1 + BAND) * self._predicted(others)

    def seconds(self, options: Sequence[Settings]) -> tuple[float, ...]:
        """Return the predicted times of pictures, taken in turn: what disturbs one disturbs the others."""
        for _ in range(ROUNDS):
            for settings in options:
                self._draw(settings)
        return tuple(self._predicted(settings) for settings in options)

    def _draw(self, settings: Settings) -> float:
        """Draw the small pictures once more, and return the time of the larger in seconds."""
        if settings not in self._least:
            self._time(self._scenes[-1], settings)
            self._least[settings] = [inf] * len(self._scenes)
        times = [self._time(scene, settings) for scene in self._scenes]
        self._least[settings] = [min(pair) for pair in zip(self._least[settings], times, strict=True)]
        return times[0]

    def _time(self, scene: AnyScene, settings: Settings) -> float:
        self._before_each()
        fresh = copy(scene)
        with collector_off():
            start = CLOCK()
            draw_picture(fresh, settings)
            return CLOCK() - start

    def _predicted(self, settings: Settings) -> float:
        times = self._least[settings]
        if len(times) == 1:
            return times[0]
        larger, smaller = (scene.size[0] * scene.size[1] for scene in self._scenes)
        of_pixel = max(times[0] - times[1], 0.0) / max(larger - smaller, 1)
        return times[0] + of_pixel * (self._pixels - larger)


# Fragments that a depth format would lose: stored as the value of the cleared buffer, they are not nearer
# than it.


SAMPLES = 1 << 20
"""Samples in the boxes of triangles that are looked at; of triangles with more, some are taken to be lost."""


def far_triangles(geometry: Geometry) -> dict[str, Integers]:
    """Return by depth method the triangles (T,) of which a fragment may be lost."""
    found = {}
    for depth in table.names("depth"):
        depth_format: DepthFormat = table.get("depth", depth).function()
        is_far = ~_is_kept(farthest_stored(geometry, depth_format), depth_format)
        found[depth] = np.unique(geometry.primitives.triangle[is_far])
    return found


def loses_fragments(scene: AnyScene, settings: Settings, triangles: Integers) -> bool:
    """Return whether a fragment of some ``triangles`` (T,) is lost, or they have too many to be looked at."""
    if not len(triangles):
        return False
    depth_format = resolve(settings).depth_format
    counts = {stage: StageCount() for stage in STAGES}
    room = SAMPLES
    for geometry, raster in _of_samples(scene, settings, triangles):
        boxes = bound(geometry.edges, raster)
        room -= int(((boxes.row_end - boxes.row) * (boxes.column_end - boxes.column)).sum())
        if room < 0:
            return True
        for fragments in fragments_of(geometry, raster, counts):
            _, keeps, stored = fragment_depth(geometry, fragments, raster, depth_format)
            if not _is_kept(stored[keeps], depth_format).all():
                return True
    return False


def _is_kept(stored: Stored, depth_format: DepthFormat) -> Flags:
    """Return which of stored depths (F,) are nearer than the cleared buffer."""
    return depth_format.is_nearer(stored, np.full_like(stored, depth_format.cleared))


def _of_samples(
    scene: AnyScene, settings: Settings, triangles: Integers
) -> Iterator[tuple[Geometry, Raster]]:
    """Yield geometry and raster of all samples of one place in the pixel, or of those of a finer picture."""
    resolved, counts = resolve(settings), {stage: StageCount() for stage in STAGES}
    sampling, raster = resolved.sampling, Raster(*scene.size, resolved.center)
    if not sampling.side:
        geometry = process_geometry(scene, settings, counts, triangles)
        for sample in range(len(sampling.position)):
            yield at_sample(geometry, sample) if len(sampling.position) > 1 else geometry, raster
        return
    finer, plain = finer_scene(scene, sampling.side), finer_settings(settings)
    geometry = process_geometry(finer, plain, counts, triangles)
    yield in_squares(geometry, settings, sampling.side), finer_raster(raster, sampling.side)
