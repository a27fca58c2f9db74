"""How often each pixel is covered: what is right, and the cases and experiments that count it."""

from collections.abc import Callable
from copy import copy
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np

from core.coverage.measured_exactly import count_pixels, exact_spans
from core.coverage.number_formats import number_format
from core.coverage.pixel_runs import make_raster
from core.records.arrays import Integers
from core.records.frame import StageCount
from core.scene import ClipScene
from core.settings import Settings
from core.stages.bin_and_raster import covered
from core.stages.declared import STAGES
from core.stages.geometry import Geometry
from core.stages.vertices import process_geometry
from core.study.case_text import clip_text, cover_text, settings_text
from core.study.experiment import Case, Experiment
from core.study.family import settings_of
from core.study.record import Judgement, Outcome, Verdict

# Experiments on coverage: triangles are drawn, and how often each pixel is covered is counted.


EVERY_PIXEL = Settings(fill="bounding-box")
"""Any number format can be drawn so, and every pixel of a triangle's box is tested by it."""
Wanted = Callable[[ClipScene, Settings], Integers]
"""How often each pixel of a scene is to be covered, (H, W) int64."""
Cover = tuple[Integers, Geometry]
"""How often each pixel is covered, (H, W) int64, and the geometry."""


def as_given(scene: ClipScene, settings: Settings) -> Integers:
    """Return (H, W) int64, how many triangles cover each pixel in rational arithmetic, corners where they are."""
    return _exact_cover(scene, False)


def on_its_grid(scene: ClipScene, settings: Settings) -> Integers:
    """Return the same with the corners where the number format puts them: snapped for those that snap."""
    return _exact_cover(scene, number_format(settings.coverage).corner_kind == "snapped")


def once_everywhere(scene: ClipScene, settings: Settings) -> Integers:
    """Return (H, W) int64 ones: what a mesh without gaps covers that reaches beyond the window."""
    return np.ones(scene.size[::-1], np.int64)


@lru_cache(maxsize=1024)
def _exact_cover(scene: ClipScene, is_snapped: bool) -> Integers:
    _, column, row = exact_spans(scene.clip, scene.size, is_snapped=is_snapped).pixels()
    return count_pixels(column, row, scene.size)


class CoverCase(Case):
    """Triangles; wrong is a pixel that is covered more or less often than ``wanted``."""

    scene: ClipScene

    def __init__(self, scene: ClipScene, wanted: Wanted = as_given) -> None:
        super().__init__(scene)
        self.wanted = wanted

    def start(self, settings: Settings) -> Callable[[], Cover]:
        """Prepare the stages up to the rasterization."""
        return partial(count_cover, copy(self.scene), settings)

    def judge(self, settings: Settings, made: Cover) -> Judgement:
        """Say how many pixels of the cover (H, W) are missing or drawn too often, and why."""
        cover, geometry = made
        error = cover - self.wanted(self.scene, settings)
        missing, extra = int(np.maximum(-error, 0).sum()), int(np.maximum(error, 0).sum())
        if not missing and not extra:
            verdict = Verdict(Outcome.RIGHT, 0.0, f"all {error.size} pixels are right")
        else:
            verdict = self.fault(settings, geometry, cover, missing, extra)
        return Judgement(verdict, error != 0)

    def fault(
        self, settings: Settings, geometry: Geometry, cover: Integers, missing: int, extra: int
    ) -> Verdict:
        """Return what is wrong with the cover (H, W): the numbers themselves, or pixels missing or drawn too often."""
        outcome = _number_trouble(self.scene, settings, geometry, cover)
        if outcome is None:
            outcome = Outcome.HOLE if missing >= extra else Outcome.DOUBLE_HIT
        remark = f"{missing:,} of {cover.size:,} pixels missing, {extra:,} drawn too often"
        return Verdict(outcome, float(missing + extra), remark)

    def test_body(self, settings: Settings) -> str:
        """Return the statements of a test: how often each pixel should be covered."""
        rows = "\n".join(f'    "{row}",' for row in cover_text(self.wanted(self.scene, settings)))
        return (
            f"clip = {clip_text(self.scene.clip)}\n"
            f"scene = ClipScene(np.array(clip, float), size={self.scene.size})\n"
            f"cover = render(scene, {settings_text(settings)}).cover_count\n"
            f'rows = ["".join(".123456789"[min(count, 9)] for count in row) for row in cover[::-1]]\n'
            f"assert rows == [\n{rows}\n]"
        )


class MeshPartCase(CoverCase):
    """Part of a mesh without gaps; wrong is a pixel that several triangles draw and one has, or one has and none draws.

    Notes
    -----
    One triangle that draws a pixel of its neighbour is not wrong by itself: only together they tell.
    """

    def judge(self, settings: Settings, made: Cover) -> Judgement:
        """Say how many pixels of the cover (H, W) are lost or drawn twice."""
        cover, geometry = made
        wanted = self.wanted(self.scene, settings)
        extra = int(np.maximum(cover - np.maximum(wanted, 1), 0).sum())
        missing = int(((cover == 0) & (wanted > 0)).sum())
        verdict = Verdict(Outcome.RIGHT, 0.0, "no pixel is lost or drawn twice")
        if missing or extra:
            verdict = self.fault(settings, geometry, cover, missing, extra)
        return Judgement(verdict, cover != wanted)


@dataclass(frozen=True, eq=False)
class CoverageExperiment(Experiment):
    """An experiment on triangles that knows how often each pixel is to be covered.

    Of a mesh that covers everything once, parts are judged as parts.
    """

    case_of: Callable[..., CoverCase] = CoverCase
    base: Settings = EVERY_PIXEL
    wanted: Wanted = as_given

    def work(self, place: tuple[float, ...], seed: int) -> CoverCase:
        """Return the triangles at a place."""
        return self.case_of(self.make(place, seed), self.wanted)

    def part(self, scene: ClipScene) -> CoverCase:
        """Return any triangles with what is right for them."""
        return MeshPartCase(scene) if self.wanted is once_everywhere else self.case_of(scene, self.wanted)


def count_cover(scene: ClipScene, settings: Settings) -> Cover:
    """Run the stages up to the rasterization: (H, W) int64 how often each pixel is covered, and the geometry.

    Raises ValueError if a method does not take the scene.
    """
    counts = {stage: StageCount() for stage in STAGES}
    geometry = process_geometry(scene, settings, counts)
    raster = make_raster(scene.size, settings.pixel_center)
    cover = np.zeros(scene.size[::-1], np.int64)
    for fragments in covered(geometry, raster, counts):
        cover += count_pixels(fragments.column, fragments.row, scene.size)
    return cover, geometry


def _number_trouble(
    scene: ClipScene, settings: Settings, geometry: Geometry, cover: Integers
) -> Outcome | None:
    """Return whether edge functions left the range of their numbers: NaN, infinite, or wrapped around.

    Notes
    -----
    A whole number does not show that it wrapped around. But their products and sums forget nothing else:
    where pixels differ from those of exact numbers on the same grid, a value did not fit.
    """
    edges = geometry.edges
    if edges.numbers.rounding == "wrapped":
        on_grid, _ = count_cover(scene, settings_of(settings, "coverage=snapped"))
        return Outcome.OVERFLOW if (cover != on_grid).any() else None
    if edges.a.dtype == object:
        return None
    parts = np.concatenate([edges.a, edges.b, edges.c])
    if np.isnan(parts).any():
        return Outcome.NOT_A_NUMBER
    return Outcome.OVERFLOW if np.isinf(parts).any() else None
