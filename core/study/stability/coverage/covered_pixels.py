"""An experiment on coverage: triangles made from a place on the axes, drawn, and counted pixel by pixel."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

import numpy as np

from core.pipeline import covered
from core.raster.number_formats.number_format import number_format
from core.raster.pixel_runs import make_raster
from core.records.arrays import Integers
from core.records.frame import STAGES, StageCount
from core.scene import ClipScene
from core.settings import Settings
from core.stages.vertices import Geometry, process_geometry
from core.study.accuracy.family import settings_of
from core.study.accuracy.record import Opening
from core.study.exact.coverage import count_pixels, exact_spans
from core.study.stability.case_text import clip_text, cover_text, settings_text
from core.study.stability.experiment import Verdict
from core.study.stability.minimization.kind import Kind
from core.study.stability.minimization.triangles import TRIANGLES, Triangles
from core.study.stability.record import ExperimentInfo, Outcome

EVERY_PIXEL = Settings(fill="bounding-box")
"""Any number format can be drawn so, and every pixel of a triangle's box is tested by it."""
Wanted = Callable[[ClipScene, Settings], Integers]
"""How often each pixel of a scene is to be covered, (H, W) int64."""


def as_given(scene: ClipScene, settings: Settings) -> Integers:
    """Return (H, W) int64, how many triangles cover each pixel in rational arithmetic, corners where they are."""
    return _exact_cover(scene, False)


def on_its_lattice(scene: ClipScene, settings: Settings) -> Integers:
    """Return the same with the corners where the number format puts them: snapped for those that snap."""
    return _exact_cover(scene, number_format(settings.coverage).corner_kind == "snapped")


def once_everywhere(scene: ClipScene, settings: Settings) -> Integers:
    """Return (H, W) int64 ones: what a mesh without gaps covers that reaches beyond the window."""
    return np.ones(scene.size[::-1], np.int64)


@lru_cache(maxsize=1024)
def _exact_cover(scene: ClipScene, is_snapped: bool) -> Integers:
    _, column, row = exact_spans(scene.clip, scene.size, is_snapped=is_snapped).pixels()
    return count_pixels(column, row, scene.size)


@dataclass(frozen=True, eq=False)
class CoverageExperiment:
    """Triangles that every method draws; wrong is a pixel that is covered more or less often than it should."""

    info: ExperimentInfo
    scene: Callable[[tuple[float, ...], int], ClipScene]
    """The triangles at a place of the axes, for a seed."""
    wanted: Wanted = as_given
    base: Settings = EVERY_PIXEL
    """What the methods share."""
    stage: ClassVar[str] = "raster"
    kind: ClassVar[Kind[Triangles]] = TRIANGLES

    def run(self, method: str, place: tuple[float, ...], seed: int) -> Verdict:
        """Draw the triangles of one place with one method."""
        scene, settings = _scene(self, place, seed), settings_of(self.base, method)
        return judge_cover(scene, settings, self.wanted(scene, settings))

    def opening(self, method: str, place: tuple[float, ...], seed: int) -> Opening | None:
        """Return the triangles, at the first pixel that goes wrong."""
        scene, settings = _scene(self, place, seed), settings_of(self.base, method)
        pixel = first_wrong_pixel(scene, settings, self.wanted(scene, settings))
        return Opening(scene, settings, self.stage, pixel)

    def case(self, method: str, place: tuple[float, ...], seed: int) -> tuple[ClipScene, Settings]:
        """Return the triangles of one place, and how one method draws them."""
        return _scene(self, place, seed), settings_of(self.base, method)

    def judge(self, scene: ClipScene, settings: Settings) -> Verdict:
        """Draw any triangles; a mesh may have lost some of its own."""
        if self.wanted is once_everywhere:
            return judge_mesh(scene, settings)
        return judge_cover(scene, settings, self.wanted(scene, settings))

    def test_body(self, scene: ClipScene, settings: Settings) -> str:
        """Return the statements of a test: how often each pixel should be covered."""
        return cover_test(scene, settings, self._wanted_of_part(scene, settings))

    def wrong_pixel(self, scene: ClipScene, settings: Settings) -> tuple[int, int] | None:
        """Return the first pixel that is covered too often or too seldom."""
        return first_wrong_pixel(scene, settings, self._wanted_of_part(scene, settings))

    def _wanted_of_part(self, scene: ClipScene, settings: Settings) -> Integers:
        """Return how often each pixel is to be covered where a mesh may have lost triangles."""
        return (as_given if self.wanted is once_everywhere else self.wanted)(scene, settings)


@lru_cache(maxsize=1024)
def _scene(experiment: CoverageExperiment, place: tuple[float, ...], seed: int) -> ClipScene:
    """Return the triangles of one place: the same, with the same referee, for all methods."""
    return experiment.scene(place, seed)


def count_cover(scene: ClipScene, settings: Settings) -> tuple[Integers, Geometry]:
    """Run the stages up to the rasterization: (H, W) int64 how often each pixel is covered, and the geometry.

    Raises
    ------
    ValueError
        If a method does not take the scene.
    """
    counts = {stage: StageCount() for stage in STAGES}
    geometry = process_geometry(scene, settings, counts)
    raster = make_raster(scene.size, settings.pixel_center)
    cover = np.zeros(scene.size[::-1], np.int64)
    for fragments in covered(geometry, settings, raster, counts):
        cover += count_pixels(fragments.column, fragments.row, scene.size)
    return cover, geometry


def first_wrong_pixel(scene: ClipScene, settings: Settings, wanted: Integers) -> tuple[int, int] | None:
    """Return column and row of the first pixel that is not as ``wanted``, (H, W) int64, row by row from below.

    ``None``: all are right, or the method refuses the scene.
    """
    try:
        cover, _ = count_cover(scene, settings)
    except ValueError:
        # A method that refuses the scene draws nothing that could be wrong.
        return None
    rows, columns = np.nonzero(cover != wanted)
    return (int(columns[0]), int(rows[0])) if len(rows) else None


def judge_cover(scene: ClipScene, settings: Settings, wanted: Integers) -> Verdict:
    """Draw triangles and say what came of it: how many pixels are missing or drawn too often, and why.

    Parameters
    ----------
    scene : ClipScene
    settings : Settings
    wanted : (H, W) int64
        How often each pixel is to be covered.
    """
    try:
        cover, geometry = count_cover(scene, settings)
    except ValueError as problem:
        return Verdict(Outcome.REFUSED, np.nan, str(problem))
    error = cover - wanted
    missing, extra = int(np.maximum(-error, 0).sum()), int(np.maximum(error, 0).sum())
    if not missing and not extra:
        return Verdict(Outcome.RIGHT, 0.0, f"all {error.size} pixels are right")
    outcome = _number_trouble(scene, settings, geometry, cover)
    if outcome is None:
        outcome = Outcome.HOLE if missing >= extra else Outcome.DOUBLE_HIT
    remark = _counted(missing, extra, error.size)
    return Verdict(outcome, float(missing + extra), remark)


def _counted(missing: int, extra: int, count: int) -> str:
    """Return in words how many pixels are wrong."""
    return f"{missing:,} of {count:,} pixels missing, {extra:,} drawn too often"


def judge_mesh(scene: ClipScene, settings: Settings) -> Verdict:
    """Draw part of a mesh; wrong is a pixel that several triangles draw and one has, or that one has and none draws.

    Notes
    -----
    One triangle that draws a pixel of its neighbour is not wrong by itself: only together they tell.
    """
    cover, geometry = count_cover(scene, settings)
    wanted = as_given(scene, settings)
    extra = int(np.maximum(cover - np.maximum(wanted, 1), 0).sum())
    missing = int(((cover == 0) & (wanted > 0)).sum())
    if not missing and not extra:
        return Verdict(Outcome.RIGHT, 0.0, "no pixel is lost or drawn twice")
    outcome = _number_trouble(scene, settings, geometry, cover)
    if outcome is None:
        outcome = Outcome.HOLE if missing >= extra else Outcome.DOUBLE_HIT
    remark = _counted(missing, extra, wanted.size)
    return Verdict(outcome, float(missing + extra), remark)


def cover_test(scene: ClipScene, settings: Settings, wanted: Integers) -> str:
    """Return the statements of a test that triangles cover each pixel as often as ``wanted``, (H, W) int64."""
    rows = "\n".join(f'    "{row}",' for row in cover_text(wanted))
    return (
        f"clip = {clip_text(scene.clip)}\n"
        f"scene = ClipScene(np.array(clip, float), size={scene.size})\n"
        f"cover = render(scene, {settings_text(settings)}).cover_count\n"
        f'rows = ["".join(".123456789"[min(count, 9)] for count in row) for row in cover[::-1]]\n'
        f"assert rows == [\n{rows}\n]"
    )


def _number_trouble(
    scene: ClipScene, settings: Settings, geometry: Geometry, cover: Integers
) -> Outcome | None:
    """Tell whether edge functions left the range of their numbers: NaN, infinite, or wrapped around.

    Notes
    -----
    Whole numbers that wrap around cannot be told by looking at them. But their products and sums forget nothing else:
    where pixels differ from those of exact numbers on the same lattice, a value did not fit.
    """
    edges = geometry.edges
    if edges.numbers.rounding == "wrapped":
        on_lattice, _ = count_cover(scene, settings_of(settings, "coverage=snapped"))
        return Outcome.OVERFLOW if (cover != on_lattice).any() else None
    if edges.a.dtype == object:
        return None
    parts = np.concatenate([edges.a, edges.b, edges.c])
    if np.isnan(parts).any():
        return Outcome.NOT_A_NUMBER
    return Outcome.OVERFLOW if np.isinf(parts).any() else None
