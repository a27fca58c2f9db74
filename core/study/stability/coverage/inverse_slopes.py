"""Spans between sides that are walked by an added inverse slope, against the same program in fractions.

What is right follows from the triangles themselves, so any triangles can be judged, and made smaller.
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from math import floor
from typing import Any, ClassVar

import numpy as np

from core.raster.fills.scanline_lecture import draw_triangle
from core.records.arrays import Integers
from core.scene import ClipScene
from core.settings import Settings
from core.study.accuracy.family import settings_of
from core.study.accuracy.record import Opening
from core.study.exact.coverage import facing, whole_corner
from core.study.stability.coverage.covered_pixels import count_cover, cover_test, on_its_lattice
from core.study.stability.coverage.number_formats import scene_of_window
from core.study.stability.experiment import Verdict
from core.study.stability.minimization.kind import Kind
from core.study.stability.minimization.triangles import TRIANGLES, Triangles, put_together, take_apart
from core.study.stability.record import Axis, ExperimentInfo, Outcome


@dataclass(frozen=True, eq=False)
class SlopeSumExperiment:
    """Spans of a triangle; wrong is a pixel that its own rule does not give in rational numbers."""

    info: ExperimentInfo
    stage: ClassVar[str] = "raster"
    kind: ClassVar[Kind[Triangles]] = TRIANGLES

    def run(self, method: str, place: tuple[float, ...], seed: int) -> Verdict:
        """Fill the triangle of one place and compare its spans."""
        return self.judge(level_triangle(place), settings_of(Settings(), method))

    def opening(self, method: str, place: tuple[float, ...], seed: int) -> Opening | None:
        """Return the triangle, at the first pixel that is wrong."""
        scene, settings = level_triangle(place), settings_of(Settings(), method)
        return Opening(scene, settings, self.stage, self.wrong_pixel(scene, settings))

    def case(self, method: str, place: tuple[float, ...], seed: int) -> tuple[ClipScene, Settings]:
        """Return the triangle of one place, and how it is filled."""
        return put_together(take_apart(level_triangle(place))), settings_of(Settings(), method)

    def judge(self, scene: ClipScene, settings: Settings) -> Verdict:
        """Fill any triangles and compare."""
        cover, _ = count_cover(scene, settings)
        wrong = int(np.abs(cover - RULES[settings.fill](scene, settings)).sum())
        remark = f"{wrong} pixels of {cover.size} are too many or missing"
        return Verdict(Outcome.WRONG_PICTURE if wrong else Outcome.RIGHT, float(wrong), remark)

    def test_body(self, scene: ClipScene, settings: Settings) -> str:
        """Return the statements of a test: how often each pixel should be covered."""
        return cover_test(scene, settings, RULES[settings.fill](scene, settings))

    def wrong_pixel(self, scene: ClipScene, settings: Settings) -> tuple[int, int] | None:
        """Return the first pixel that is too many or missing."""
        cover, _ = count_cover(scene, settings)
        rows, columns = np.nonzero(cover != RULES[settings.fill](scene, settings))
        return (int(columns[0]), int(rows[0])) if len(rows) else None


def level_triangle(place: tuple[float, ...]) -> ClipScene:
    """Return a triangle ``height`` rows high with a level upper side, whose far corner is ``shift`` columns away."""
    height, shift = (int(value) for value in place)
    side = 1 << (height + 2).bit_length()
    corners = np.array([[1.5, 1.5], [2.5, height + 1.5], [1.5 + shift, height + 1.5]])
    return scene_of_window(corners[None], (1 << max(shift + 2, 4).bit_length(), side))


def printed_cover(scene: ClipScene, settings: Settings) -> Integers:
    """Return how often LMU's program covers each pixel, (H, W) int64, if its sums are fractions and never rounded.

    Raises
    ------
    ValueError
        If a corner does not lie in front of the eye.
    """
    width, height = scene.size
    cover = np.zeros((height, width), np.int64)
    for corners in scene.clip:
        placed = [whole_corner(corner, scene.size, True) for corner in corners]
        if any(w <= 0 for _, _, w in placed):
            raise ValueError("every corner must lie in front of the eye")
        # The printed program knows no triangles without area: they are left out before it.
        if facing(placed) == 0:
            continue
        # Rounded, half up, to the pixel with the nearest centre: the one that the corner lies in.
        whole: list[Any] = [(Fraction(x // w), Fraction(y // w)) for x, y, w in placed]
        for row, first, second in draw_triangle(*whole):
            start, stop = (floor(x + Fraction(1, 2)) for x in sorted((first, second)))
            if 0 <= row < height:
                cover[row, max(start, 0) : max(stop + 1, 0)] += 1
    return cover


RULES: dict[str, Callable[[ClipScene, Settings], Integers]] = {
    "scanline-lecture": printed_cover,
    "scanline": on_its_lattice,
}
"""Name of a fill to how often it should cover each pixel."""

SLOPES = SlopeSumExperiment(
    ExperimentInfo(
        "inverse-slopes",
        "Spans by an added inverse slope",
        "The sides of a triangle are walked by adding the inverse slope row by row: do the sums still round alike?",
        (
            Axis("height", "Height of the triangle", "rows", tuple(map(float, range(2, 62, 3)))),
            Axis("shift", "Place of the far corner", "columns", tuple(map(float, range(2, 32, 3)))),
        ),
        ("fill=scanline-lecture", "fill=scanline"),
        "Inverse slopes added in float64 fall beside ties and round another way; spans in closed form do "
        "not.",
    )
)
EXPERIMENTS = (SLOPES,)
