"""Study of interpolation: texture coordinates over a square in perspective, against exact ones."""

import numpy as np

from core.records.arrays import Floats
from core.records.frame import Frame
from core.records.primitives import interpolation_form
from core.settings import Settings
from core.study.accuracy.family import Assignment, Candidate, StudyFamily
from core.study.accuracy.frame_task import FrameTask, scalar_pictures
from core.study.accuracy.record import Axis, ErrorMeasure, Judgement, Pictures, WorkKind, judged
from core.study.accuracy.workloads import receding_quad
from core.study.exact.values import exact_values
from core.trace import trace

TEXELS = 256
"""Texels on a side of the texture that coordinates are measured by."""
MEAN_TEXEL = ErrorMeasure("mean-texel", "Mean error of the texture coordinate", "texels")
LARGEST_TEXEL = ErrorMeasure("largest-texel", "Largest error of the texture coordinate", "texels")

RATIOS = Axis("w-ratio", "Ratio of w, far over near", "", (1, 1.25, 1.5, 2, 3, 4, 8, 16, 64), default=4)
SIDES = Axis("side", "Side of the picture", "pixels", (16, 32, 64, 128, 256), default=64, is_cost=True)


class InterpolationTask(FrameTask):
    """A square in perspective with texture coordinates; the reference is every coordinate, correctly rounded."""

    stage = "interpolate"

    def __init__(self, assignment: Assignment) -> None:
        side, far = int(assignment.dials["side"]), assignment.dials["w-ratio"]
        self._receding = 1 if assignment.work == "square" else 0
        w = np.array([[1.0, far, far, 1.0], [1.0, 1.0, far, far]][self._receding])
        self._quad = receding_quad((side, side), w)
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

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return the counts of the frame, and how often 1/w is divided by: once for each pixel or anchor."""
        divisions = 0
        if interpolation_form(settings.interpolation) == "perspective":
            traced = trace(self._quad, settings)
            fragments, (x, _) = traced.source.fragments, traced.source.centers
            places = traced.stage("interpolate").columns.get("anchor_x", x[:, None])
            rows = np.broadcast_to((fragments.primitive * len(x) + fragments.row)[:, None], places.shape)
            divisions = len(np.unique(np.stack([rows.ravel(), places.ravel()]), axis=1).T)
        return super().counts(settings, made) | {"divisions by 1/w": divisions}

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Return how far the coordinates are off."""
        result, exact = self._coordinates(settings)
        distance = np.abs(result - exact).max(axis=2)
        distance = distance[np.isfinite(distance)]
        errors = {MEAN_TEXEL.name: float(distance.mean()), LARGEST_TEXEL.name: float(distance.max())}
        return judged(errors, LARGEST_TEXEL.name, tolerance=0.5)

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return the coordinate, u or v, that runs towards the far side, in texels."""
        result, exact = self._coordinates(settings)
        return scalar_pictures(result[..., self._receding], exact[..., self._receding])


INTERPOLATION = StudyFamily(
    "interpolation",
    "Interpolation",
    ("interpolation",),
    (
        WorkKind("aside", "A square that recedes to the right", "pixel", (RATIOS, SIDES)),
        WorkKind("square", "A square that leans back", "pixel", (RATIOS, SIDES)),
    ),
    (MEAN_TEXEL, LARGEST_TEXEL),
    InterpolationTask,
    more=tuple(
        Candidate(
            f"interpolation=affine-n correction_interval={interval}",
            f"Affine, corrected every {interval} pixels",
        )
        for interval in (4, 64)
    ),
)
