"""How far texture coordinates stray where perspective is left out, or put in every n pixels only.

References
----------
J. Blinn, *Hyperbolic interpolation*, 1992.
"""

import numpy as np

from core.fragments.corrected_affine import largest_affine_error
from core.records.arrays import Flags, Floats
from core.records.cached import cached_property
from core.records.frame import Frame
from core.scene import ClipScene
from core.settings import Settings
from core.study.accuracy.record import Axis, Judgement, Outcome, Verdict
from core.study.accuracy.workloads import receding_quad
from core.study.exact.values import exact_values
from core.study.stability.case_text import pixels_text
from core.study.stability.experiment import Case, Experiment, check_in_view_volume
from core.study.stability.kinds import VALUED_TRIANGLES

ROWS = 4
"""Rows of the picture: all of them are alike."""
HALF_TEXEL = 1 / 512
"""Half a texel of a texture of 256: a coordinate that strays less takes the same texel, about."""


class StripCase(Case):
    """Triangles that lead away, u their first value; right is u with perspective, by fractions.

    Raises ValueError if a triangle is cut by a plane of depth: its pieces have other ratios of w.
    """

    scene: ClipScene
    stage = "interpolate"

    def __init__(self, scene: ClipScene) -> None:
        super().__init__(scene)
        check_in_view_volume(scene)
        w = scene.clip[..., 3]
        self.bound = float(largest_affine_error(w.max(axis=1) / w.min(axis=1)).max())

    @cached_property
    def wanted(self) -> Floats:
        """(T, H, W) float64, u of every triangle at every pixel, whether it covers it or not."""
        width, height = self.scene.size
        row, column = (index.ravel() for index in np.mgrid[0:height, 0:width])
        attributes = self.scene.attributes
        assert attributes is not None
        u = [
            exact_values(corners, values[:, :1], self.scene.size, column, row)
            for corners, values in zip(self.scene.clip, attributes, strict=True)
        ]
        return np.stack(u).reshape(-1, height, width)

    def _shown_and_wanted(self, frame: Frame) -> tuple[Floats, Floats]:
        """Return u as it is drawn and as it should be, (H, W) float64 each; the same where nothing is drawn."""
        shown = frame.attributes[..., 0].astype(np.float64)
        of_seen = np.take_along_axis(self.wanted, np.maximum(frame.primitive, 0)[None], axis=0)[0]
        return shown, np.where(frame.primitive >= 0, of_seen, shown)

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Return the largest error as a part of the edge, and what it may be without any correction."""
        shown, wanted = self._shown_and_wanted(made)
        error = np.abs(shown - wanted)
        largest = float(error.max())
        remark = (
            f"u is off by {largest:.4g} of the edge; without perspective by (sqrt r - 1)/(sqrt r + 1) = "
            f"{self.bound:.4g} at most"
        )
        outcome = Outcome.RIGHT if largest <= HALF_TEXEL else Outcome.WRONG_PICTURE
        return Judgement(Verdict(outcome, largest, remark), error > HALF_TEXEL)

    def assertions(self, settings: Settings, made: Frame, wrong: Flags) -> str:
        """Return statements that, where ``wrong`` (H, W) bool, u is within half a texel of what it should be."""
        _, wanted = self._shown_and_wanted(made)
        return pixels_text(wrong, wanted, f"abs(frame.attributes[row, column, 0] - wanted) <= {HALF_TEXEL}")


def leaning_strip(w_ratio: float, width: int) -> ClipScene:
    """Return a rectangle of ``width`` x 4 pixels whose right side is ``w_ratio`` times as far as its left side."""
    return receding_quad((width, ROWS), np.array([1.0, w_ratio, w_ratio, 1.0]))


AFFINE = Experiment(
    "affine-w-ratio",
    "Affine interpolation by the ratio of w",
    "A strip recedes from the eye. How far off are texture coordinates without perspective correction, or "
    "with it every n pixels? Right is within half a texel of 256.",
    (
        Axis(
            "w-ratio",
            "Ratio of w, far over near",
            "",
            (1, 1.005, 1.02, 1.1, 1.25, 1.5, 2, 4, 8, 16),
            True,
        ),
        Axis("width", "Length on screen", "pixels", (8, 16, 32, 64, 128, 256, 512), True),
    ),
    (
        "interpolation=affine",
        "interpolation=affine-n correction_interval=64",
        "interpolation=affine-n correction_interval=16",
        "interpolation=affine-n correction_interval=4",
        "interpolation=affine-n correction_interval=1",
        "interpolation=perspective",
    ),
    "Affine interpolation is off by up to (sqrt r - 1)/(sqrt r + 1) of the edge at every length. Corrected "
    "every n pixels, the same bound holds with the ratio of w within n pixels. Perspective-correct "
    "interpolation is right.",
    lambda place, _: leaning_strip(place[0], int(place[1])),
    StripCase,
    kind=VALUED_TRIANGLES,
)
