"""Study of interpolation: texture coordinates over a square in perspective, against exact ones."""

import numpy as np

from core.records.arrays import Floats
from core.records.frame import Frame
from core.settings import Settings
from core.study.accuracy.family import Assignment, Errors, StudyFamily
from core.study.accuracy.frame_task import FrameTask, scalar_pictures
from core.study.accuracy.record import Dial, ErrorMeasure, Pictures, WorkKind
from core.study.accuracy.workloads import textured_quad
from core.study.exact.values import exact_values
from core.trace import trace

TEXELS = 256
"""Texels on a side of the texture that coordinates are measured by."""
MEAN_TEXEL = ErrorMeasure("mean-texel", "Mean error of the texture coordinate", "texels")
LARGEST_TEXEL = ErrorMeasure("largest-texel", "Largest error of the texture coordinate", "texels")

RATIOS = Dial("w-ratio", "Ratio of w, far over near", "", (1, 1.25, 1.5, 2, 3, 4, 8, 16, 64), 4)
SIDES = Dial("side", "Side of the picture", "pixels", (16, 32, 64, 128, 256), 64, is_cost=True)


class InterpolationTask(FrameTask):
    """A square in perspective with texture coordinates; the reference is every coordinate, correctly rounded."""

    stage = "interpolate"

    def __init__(self, assignment: Assignment) -> None:
        side = int(assignment.dials["side"])
        self._quad = textured_quad(side, assignment.dials["w-ratio"], 1.0, None)
        super().__init__(self._quad, side * side, ("interpolate",))

    def _coordinates(self, settings: Settings) -> tuple[Floats, Floats]:
        """Return coordinates (H, W, 2) of the method, before they are rounded to float32, and exact ones; in texels."""
        width, height = self.scene.size
        source = trace(self._quad, settings).source
        result, exact = np.full((2, height, width, 2), np.nan)
        fragments, triangle = source.fragments, source.triangle_of_fragment
        values = source.interpolated[1]
        assert self._quad.attributes is not None
        for number in range(len(self._quad.clip)):
            chosen = np.flatnonzero(triangle == number)
            column, row = fragments.column[chosen], fragments.row[chosen]
            result[row, column] = values[chosen]
            exact[row, column] = exact_values(
                self._quad.clip[number],
                self._quad.attributes[number],
                self.scene.size,
                column,
                row,
                settings.pixel_center,
            )
        return TEXELS * result, TEXELS * exact

    def errors(self, settings: Settings, made: Frame) -> Errors:
        """Return how far the coordinates are off."""
        result, exact = self._coordinates(settings)
        distance = np.abs(result - exact).max(axis=2)
        distance = distance[np.isfinite(distance)]
        return {MEAN_TEXEL.name: float(distance.mean()), LARGEST_TEXEL.name: float(distance.max())}

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return the coordinate v, which runs towards the far side, in texels."""
        result, exact = self._coordinates(settings)
        return scalar_pictures(result[..., 1], exact[..., 1])


INTERPOLATION = StudyFamily(
    "interpolation",
    "Interpolation",
    ("interpolation",),
    (WorkKind("square", "A square in perspective", "pixel", (RATIOS, SIDES)),),
    (MEAN_TEXEL, LARGEST_TEXEL),
    InterpolationTask,
)
