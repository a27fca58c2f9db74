"""How far texture coordinates stray where perspective is left out, or put in every n pixels only.

References
----------
J. Blinn, *Hyperbolic interpolation*, 1992.
"""

import numpy as np

from core.arrays import Floats
from core.fragments.corrected_affine import largest_affine_error
from core.pipeline import render
from core.scene import ClipScene
from core.settings import Settings
from core.study.exact.values import exact_values
from core.study.stability.experiment import Verdict
from core.study.stability.fragments.cases import Case, CaseExperiment, Judgement
from core.study.stability.record import Axis, ExperimentInfo, Outcome

ROWS = 4
"""Rows of the picture: all of them are alike."""
HALF_TEXEL = 1 / 512
"""Half a texel of a texture of 256: a coordinate that strays less takes the same texel, about."""


class StripCase(Case):
    """A strip that fills the picture and leads away to the right, w from 1 to ``w_ratio``, u from 0 to 1."""

    def __init__(self, w_ratio: float, width: int) -> None:
        self.scene = leaning_strip(w_ratio, width)
        self.bound = float(largest_affine_error(np.array([w_ratio]))[0])
        column, row = np.arange(width), np.zeros(width, np.int64)
        attributes = self.scene.attributes
        assert attributes is not None
        # u is one linear function over w in both triangles, so the first one's values hold in the whole row.
        self.wanted = exact_values(self.scene.clip[0], attributes[0], self.scene.size, column, row)[:, 0]

    def judge(self, settings: Settings) -> Judgement:
        """Return the largest error as a part of the edge, and what it may be without any correction."""
        shown = render(self.scene, settings).attributes[..., 0].astype(np.float64)
        error = np.abs(shown - self.wanted)
        largest = float(error.max())
        remark = (
            f"u strays by {largest:.4g} of the edge; without perspective by (sqrt r - 1)/(sqrt r + 1) = "
            f"{self.bound:.4g} at most"
        )
        outcome = Outcome.RIGHT if largest <= HALF_TEXEL else Outcome.WRONG_PICTURE
        return Judgement(Verdict(outcome, largest, remark), error > HALF_TEXEL)


def leaning_strip(w_ratio: float, width: int) -> ClipScene:
    """Return a rectangle of ``width`` x 4 pixels whose right side is ``w_ratio`` times as far as its left side."""
    x, y = np.array([-1.0, 1.0, 1.0, -1.0]), np.array([-1.0, -1.0, 1.0, 1.0])
    w = np.array([1.0, w_ratio, w_ratio, 1.0])
    corners: Floats = np.stack([x * w, y * w, np.zeros(4), w], axis=1)
    u = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    index = np.array([[0, 1, 2], [0, 2, 3]])
    return ClipScene(corners[index], u[index], (width, ROWS), shared=index)


def make_strip(place: tuple[float, ...], seed: int) -> StripCase:
    """Make the strip; nothing in it is random."""
    del seed
    return StripCase(place[0], int(place[1]))


AFFINE = CaseExperiment(
    ExperimentInfo(
        "affine-w-ratio",
        "Affine interpolation by the ratio of w",
        "A strip leads away from the eye: by how much do texture coordinates stray without perspective, or with it "
        "every n pixels? Right is within half a texel of 256.",
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
        "Affine strays by up to (sqrt r - 1)/(sqrt r + 1) of the edge at every length; corrected every n pixels by as "
        "much with the ratio of w within n pixels only; perspective holds.",
    ),
    make_strip,
    "interpolate",
)
