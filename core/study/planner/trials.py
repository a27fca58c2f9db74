"""Trying settings: parts of the picture are drawn with them and compared with those of the reference settings.

Drawn in parts, a pixel is the very pixel of the whole picture, bit for bit. Small pictures are tried whole; of larger
ones bands of rows at equal distances, `PIXELS` in all. What lies between the bands is not seen. Of more pixels the
largest difference is larger, so one byte more is predicted there; ``measuring`` draws the whole.
"""

from collections.abc import Callable
from copy import copy
from dataclasses import dataclass

import numpy as np

from core.framebuffer.display import to_display
from core.pipeline import draw
from core.raster.pixel_runs import make_raster
from core.records.arrays import Integers
from core.scene import AnyScene
from core.settings import Settings
from core.study.planner.records import Tolerance

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
