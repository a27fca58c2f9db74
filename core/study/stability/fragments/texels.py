"""What is lost where a pixel sees many texels: by texture filters, and by samples that share one shading.

A pixel should show the mean of the texels in its footprint. The texture is mapped without perspective, so footprints
are parallelograms, and their means are exact (``core.fragments.footprint_mean``).
"""

import numpy as np

from core.arrays import Floats
from core.fragments.footprint_mean import footprint_means
from core.scene import ClipScene
from core.settings import Settings
from core.study.stability.fragments.cases import (
    Case,
    CaseExperiment,
    Judgement,
    drawn_colors,
    judge_colors,
)
from core.study.stability.record import Axis, ExperimentInfo
from core.study.workloads import checkerboard, random_source

SIDE = 24
"""Pixels on a side of the picture."""
TEXELS = 64
"""Texels on a side of the texture, which is repeated."""
TURN = np.radians(17.0)
"""How far the texture is turned, so that its rows are not those of the picture."""
TOLERANCE = 16.0
"""Mean colour error, in 1/255, that is taken as right."""
DENSITIES = Axis("density", "Texels for a pixel", "", (1, 1.5, 2, 3, 4, 6, 8, 12, 16, 32), True)
BOUND_TO = "the mean over all pixels of the textured square, and single pixels of it may be off"
"""Why nothing of it can be left out."""
ANGLES = Axis("angle", "Angle of the surface", "degrees", (0, 15, 30, 45, 60, 70, 80, 85))


class TextureCase(Case):
    """A square that fills the picture; the texture is ``density`` texels a pixel, and leans back by an angle."""

    def __init__(self, density: float, angle: float, seed: int) -> None:
        texture = checkerboard(TEXELS, seed)
        start = random_source(seed).uniform(0, TEXELS, 2)
        cosine, sine = np.cos(TURN), np.sin(TURN)
        lean = 1 / np.cos(np.radians(angle))
        self._right = density * np.array([cosine, sine])
        self._up = density * lean * np.array([-sine, cosine])
        corners = start + SIDE * (
            np.array([[0.0], [1], [1], [0]]) * self._right + np.array([[0.0], [0], [1], [1]]) * self._up
        )
        place = np.array([[-1.0, -1, 0, 1], [1, -1, 0, 1], [1, 1, 0, 1], [-1, 1, 0, 1]])
        index = np.array([[0, 1, 2], [0, 2, 3]])
        self.scene = ClipScene(place[index], (corners / TEXELS)[index], (SIDE, SIDE), texture, shared=index)
        row, column = np.mgrid[0:SIDE, 0:SIDE]
        pixels = np.stack([column.ravel(), row.ravel()], axis=1)
        self.wanted = footprint_means(texture, self._footprints(start, pixels)).reshape(SIDE, SIDE, 3)

    def _footprints(self, start: Floats, pixels: Floats) -> Floats:
        """Return the corners (F, 4, 2), in texels, of pixels with lower left corners (F, 2)."""
        squares = pixels[:, None] + np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
        return np.asarray(start + squares[..., :1] * self._right + squares[..., 1:] * self._up)

    def judge(self, settings: Settings) -> Judgement:
        """Compare the colours with the means of the footprints."""
        shown = drawn_colors(self.scene, settings)[..., :3]
        return judge_colors(shown, self.wanted, TOLERANCE, of_mean=True)


def make_texture_case(place: tuple[float, ...], seed: int) -> TextureCase:
    """Make the square; the seed chooses single texels and where the texture begins."""
    return TextureCase(place[0], place[1], seed)


MINIFICATION = CaseExperiment(
    ExperimentInfo(
        "minification",
        "Minification by each texture filter",
        "A pixel sees more and more texels, and from the side: how far is it from their mean?",
        (DENSITIES, ANGLES),
        (
            "texture_filter=nearest",
            "texture_filter=bilinear",
            "texture_filter=mipmap-nearest",
            "texture_filter=trilinear",
        ),
        "Nearest and bilinear are wrong from two texels for a pixel on, seen from anywhere; trilinear holds up to "
        "45 degrees at any number of texels, and blurs where footprints are longer and narrower.",
    ),
    make_texture_case,
    "shade",
    bound_to=BOUND_TO,
)
SHADING_ALIASING = CaseExperiment(
    ExperimentInfo(
        "shading-aliasing",
        "Samples against detail inside a triangle",
        "The detail lies in the texture, not at edges: do more samples for a pixel bring its mean?",
        (DENSITIES, ANGLES),
        (
            "antialiasing=none",
            "antialiasing=msaa-4",
            "antialiasing=area",
            "antialiasing=ssaa-4",
            "antialiasing=ssaa-16",
            "antialiasing=none texture_filter=trilinear",
        ),
        "Msaa-4 is as wrong as no antialiasing, as it shades once, and exact area is hardly better; 16 samples "
        "hold up to 4 texels for a pixel and 60 degrees; a texture with mipmaps holds beyond, with one sample.",
    ),
    make_texture_case,
    "shade",
    Settings(texture_filter="nearest"),
    bound_to=BOUND_TO,
)
