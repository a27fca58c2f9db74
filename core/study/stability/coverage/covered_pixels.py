"""An experiment on coverage: triangles made from a place on the axes, drawn, and counted pixel by pixel."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from core.arrays import Integers
from core.frame import STAGES, StageCount
from core.geometry_stages import process_geometry
from core.pipeline import render
from core.scene import ClipScene
from core.settings import Settings
from core.study.exact.coverage import count_pixels, exact_spans
from core.study.family import settings_of
from core.study.record import Opening
from core.study.stability.experiment import Verdict
from core.study.stability.record import ExperimentInfo, Outcome

EVERY_PIXEL = Settings(fill="bounding-box")
"""Any number format can be drawn so, and every pixel of a triangle's box is tested by it."""


def as_given(scene: ClipScene, settings: Settings) -> Integers:
    """Return (H, W) int64, how many triangles cover each pixel in rational arithmetic, corners where they are."""
    spans = exact_spans(
        scene.clip,
        scene.size,
        is_snapped=False,
        rule="shared-edge",
        pixel_center=settings.pixel_center,
    )
    _, column, row = spans.pixels()
    return count_pixels(column, row, scene.size)


def once_everywhere(scene: ClipScene, settings: Settings) -> Integers:
    """Return (H, W) int64 ones: what a mesh without gaps covers that reaches beyond the window."""
    return np.ones(scene.size[::-1], np.int64)


@dataclass(frozen=True, eq=False)
class CoverageExperiment:
    """Triangles that every method draws; wrong is a pixel that is covered more or less often than it should."""

    info: ExperimentInfo
    scene: Callable[[tuple[float, ...], int], ClipScene]
    """The triangles at a place of the axes, for a seed."""
    wanted: Callable[[ClipScene, Settings], Integers] = as_given
    """How often each pixel is to be covered, (H, W) int64."""
    base: Settings = EVERY_PIXEL
    """What the methods share."""

    def run(self, method: str, place: tuple[float, ...], seed: int) -> Verdict:
        """Draw the triangles of one place with one method."""
        return judge(self.scene(place, seed), settings_of(self.base, method), self.wanted)

    def opening(self, method: str, place: tuple[float, ...], seed: int) -> Opening | None:
        """Return the triangles, at the first pixel that goes wrong."""
        scene, settings = self.scene(place, seed), settings_of(self.base, method)
        return Opening(scene, settings, "raster", first_wrong_pixel(scene, settings, self.wanted))


Wanted = Callable[[ClipScene, Settings], Integers]


def cover_error(scene: ClipScene, settings: Settings, wanted: Wanted) -> Integers:
    """Draw triangles; return (H, W) int64 by how much each pixel is covered too often (below 0: too seldom)."""
    return render(scene, settings).cover_count.astype(np.int64) - wanted(scene, settings)


def first_wrong_pixel(scene: ClipScene, settings: Settings, wanted: Wanted) -> tuple[int, int] | None:
    """Return column and row of the first wrong pixel, row by row from below; ``None``: all are right."""
    try:
        rows, columns = np.nonzero(cover_error(scene, settings, wanted))
    except ValueError:
        # Methods that refuse the scene draw nothing that could be wrong.
        return None
    return (int(columns[0]), int(rows[0])) if len(rows) else None


def judge(scene: ClipScene, settings: Settings, wanted: Wanted) -> Verdict:
    """Draw triangles and say what came of it: how many pixels are missing or drawn too often, and why."""
    try:
        error = cover_error(scene, settings, wanted)
    except ValueError as problem:
        return Verdict(Outcome.REFUSED, np.nan, str(problem))
    missing, extra = int(np.maximum(-error, 0).sum()), int(np.maximum(error, 0).sum())
    if not missing and not extra:
        return Verdict(Outcome.RIGHT, 0.0, f"all {error.size} pixels are right")
    remark = f"{missing} pixels are missing and {extra} are drawn too often, of {error.size}"
    trouble = number_trouble(scene, settings)
    if trouble is None:
        trouble = Outcome.HOLE if missing >= extra else Outcome.DOUBLE_HIT
    return Verdict(trouble, float(missing + extra), remark)


def number_trouble(scene: ClipScene, settings: Settings) -> Outcome | None:
    """Tell whether edge functions left the range of their numbers: NaN, infinite, or wrapped around.

    Notes
    -----
    Whole numbers that wrap around cannot be told by looking at them. But their products and sums forget nothing else:
    where pixels differ from those of exact numbers on the same lattice, a value did not fit.
    """
    geometry = process_geometry(scene, settings, {stage: StageCount() for stage in STAGES})
    edges = geometry.edges
    if edges.numbers.rounding == "wrapped":
        on_lattice = render(scene, settings_of(settings, "coverage=snapped")).cover_count
        wrapped = (render(scene, settings).cover_count != on_lattice).any()
        return Outcome.OVERFLOW if wrapped else None
    if edges.a.dtype == object:
        return None
    parts = np.concatenate([edges.a, edges.b, edges.c])
    if np.isnan(parts).any():
        return Outcome.NOT_A_NUMBER
    return Outcome.OVERFLOW if np.isinf(parts).any() else None
