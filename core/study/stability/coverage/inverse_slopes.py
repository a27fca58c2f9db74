"""Spans between sides that are walked by an added inverse slope, against the same program in fractions.

What is right follows from the triangles themselves, so any triangles can be judged, and made smaller.
"""

from collections.abc import Callable
from fractions import Fraction
from math import floor

import numpy as np

from core.raster.fills.scanline_lecture import draw_triangle
from core.records.arrays import Integers
from core.scene import ClipScene
from core.settings import Settings
from core.study.accuracy.record import Axis, Judgement, Outcome, Verdict
from core.study.exact.coverage import facing, whole_corner
from core.study.stability.coverage.covered_pixels import Cover, CoverCase, on_its_grid
from core.study.stability.coverage.number_formats import scene_of_window
from core.study.stability.experiment import Experiment


class SlopeCase(CoverCase):
    """Spans of triangles; wrong is a pixel that the fill's own rule does not give in rational numbers."""

    def __init__(self, scene: ClipScene) -> None:
        super().__init__(scene, lambda scene, settings: RULES[settings.fill](scene, settings))

    def judge(self, settings: Settings, made: Cover) -> Judgement:
        """Compare the cover (H, W)."""
        cover, _ = made
        error = cover - self.wanted(self.scene, settings)
        wrong = int(np.abs(error).sum())
        remark = f"{wrong} pixels of {cover.size} are too many or missing"
        outcome = Outcome.WRONG_PICTURE if wrong else Outcome.RIGHT
        return Judgement(Verdict(outcome, float(wrong), remark), error != 0)


def level_triangle(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a triangle ``height`` rows high with a level upper side, whose far corner is ``shift`` columns away."""
    height, shift = (int(value) for value in place)
    side = 1 << (height + 2).bit_length()
    corners = np.array([[1.5, 1.5], [2.5, height + 1.5], [1.5 + shift, height + 1.5]])
    return scene_of_window(corners[None], (1 << max(shift + 2, 4).bit_length(), side))


def printed_cover(scene: ClipScene, settings: Settings) -> Integers:
    """Return how often LMU's program covers each pixel, (H, W) int64, if its sums are fractions and never rounded.

    Raises ValueError if a corner does not lie in front of the eye.
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
        v1, v2, v3 = ((Fraction(x // w), Fraction(y // w)) for x, y, w in placed)
        for row, first, second in draw_triangle(v1, v2, v3, height):  # type: ignore[arg-type]
            start, stop = (floor(x + Fraction(1, 2)) for x in sorted((first, second)))
            if 0 <= row < height:
                cover[row, max(start, 0) : max(stop + 1, 0)] += 1
    return cover


RULES: dict[str, Callable[[ClipScene, Settings], Integers]] = {
    "scanline-lecture": printed_cover,
    "scanline": on_its_grid,
}
"""Name of a fill to how often it should cover each pixel."""

SLOPES = Experiment(
    "inverse-slopes",
    "Spans by an added inverse slope",
    "The sides of a triangle are followed by adding the inverse slope row by row. Do the sums still round to "
    "the same pixel?",
    (
        Axis("height", "Height of the triangle", "rows", tuple(map(float, range(2, 62, 3)))),
        Axis("shift", "Place of the far corner", "columns", tuple(map(float, range(2, 32, 3)))),
    ),
    ("fill=scanline-lecture", "fill=scanline"),
    "Inverse slopes added in float64 miss ties and round to another pixel. Spans in closed form do not.",
    level_triangle,
    SlopeCase,
)
EXPERIMENTS = (SLOPES,)
