"""What is lost where a pixel sees many texels: by texture filters, and by samples that share one shading.

A pixel should show the mean of the texels in its footprint. The texture is mapped without perspective, so footprints
are parallelograms, and their means are exact (``core.textures.footprints``). They follow from the corners alone:
so any such triangles can be judged, and made smaller.
"""

import numpy as np

from core.interpolation.measured import exact_values
from core.records.arrays import Flags, Floats
from core.records.frame import Frame
from core.scene import ClipScene
from core.settings import Settings
from core.study.case_text import listed_pixels
from core.study.experiment import TEXTURED_TRIANGLES, Case, Experiment
from core.study.frame_task import judge_colors
from core.study.record import Axis, Judgement
from core.study.workloads import checkerboard, random_source
from core.textures.footprints import footprint_means

SIDE = 24
"""Pixels on a side of the picture."""
TEXELS = 64
"""Texels on a side of the texture, which is repeated."""
TURN = np.radians(17.0)
"""How far the texture is turned, so that its rows are not those of the picture."""
TOLERANCE = 16.0
"""Mean colour error, in 1/255, that is taken as right."""
DENSITIES = Axis("density", "Texels per pixel", "", (1, 1.5, 2, 3, 4, 6, 8, 12, 16, 32), True)
ROUNDING = 1e-6
"""By how much sums of areas, and places on the texture, may differ and be the same."""
CORNER_PIXELS = np.array([0, 1, 0]), np.array([0, 0, 1])
"""Columns and rows of the window's corner, of a place a pixel to the right and of one a pixel up."""
ANGLES = Axis("angle", "Angle of the surface", "degrees", (0, 15, 30, 45, 60, 70, 80, 85))


class TextureCase(Case):
    """Triangles on which the texture lies without perspective; right are the means of the footprints.

    Pixels count that are covered as a whole, by as many triangles as it takes. Raises ValueError if it lies with
    perspective, or otherwise on one triangle than on another.
    """

    scene: ClipScene
    stage = "shade"

    def __init__(self, scene: ClipScene) -> None:
        super().__init__(scene)
        assert scene.texture is not None
        width, height = scene.size
        start, right, up = _laid_out(scene)
        row, column = np.mgrid[0:height, 0:width]
        lower_left = np.stack([column.ravel(), row.ravel()], axis=1)
        squares = lower_left[:, None] + np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
        footprints = start + squares[..., :1] * right + squares[..., 1:] * up
        self.wanted = footprint_means(scene.texture, footprints).reshape(height, width, -1)

    def _shown_and_whole(self, frame: Frame) -> tuple[Floats, Flags]:
        """Return the colours (H, W, 3) that are drawn, and which pixels (H, W) bool are covered as a whole."""
        colors = frame.color.astype(np.float64)
        whole = np.asarray(colors[..., 3] > 1 - ROUNDING)
        if not whole.any():
            raise ValueError("a pixel must be covered as a whole, none is")
        if np.isnan(self.wanted[whole]).any():
            raise ValueError(
                "every pixel must see a part of the texture, got one that sees a point or a line"
            )
        return colors[..., :3], whole

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Compare the colours with the means of the footprints."""
        shown, whole = self._shown_and_whole(made)
        return judge_colors(shown, self.wanted, TOLERANCE, whole, of_mean=True)

    def assertions(self, settings: Settings, made: Frame, wrong: Flags) -> str:
        """Return statements that the mean error over all pixels that count, ``wrong`` (H, W) bool or not, is small."""
        del wrong
        _, whole = self._shown_and_whole(made)
        pixels = listed_pixels(whole, self.wanted)
        return (
            f"{pixels}\n"
            f"errors = [255 * np.abs(frame.color[row, column, :3] - wanted).max() for column, row, wanted in pixels]\n"
            f"assert np.mean(errors) <= {TOLERANCE}"
        )


def _laid_out(scene: ClipScene) -> tuple[Floats, Floats, Floats]:
    """Return where the window's corner lies in texels, (2,), and how far a pixel to the right and one up lead."""
    assert scene.texture is not None
    assert scene.attributes is not None
    w = scene.clip[..., 3]
    if (w <= 0).any() or (w != w[0, 0]).any():
        raise ValueError("all corners must have the same positive w: with perspective the mean is not known")
    texels = np.array(scene.texture.pixels.shape[1::-1])
    places = [
        exact_values(corners, values[:, :2], scene.size, *CORNER_PIXELS, pixel_center="integer")
        for corners, values in zip(scene.clip, scene.attributes, strict=True)
    ]
    if not np.allclose(places, places[0], rtol=0, atol=ROUNDING):
        raise ValueError("the texture must lie on all triangles alike, and on none that is seen edge-on")
    start, right, up = places[0] * texels
    return start, right - start, up - start


def textured_square(density: float, angle: float, seed: int) -> ClipScene:
    """Return a square that fills the picture; the texture is ``density`` texels a pixel, and leans back by degrees."""
    texture = checkerboard(TEXELS, seed)
    start = random_source(seed).uniform(0, TEXELS, 2)
    cosine, sine = np.cos(TURN), np.sin(TURN)
    lean = 1 / np.cos(np.radians(angle))
    right = density * np.array([cosine, sine])
    up = density * lean * np.array([-sine, cosine])
    corners = start + SIDE * (
        np.array([[0.0], [1], [1], [0]]) * right + np.array([[0.0], [0], [1], [1]]) * up
    )
    place = np.array([[-1.0, -1, 0, 1], [1, -1, 0, 1], [1, 1, 0, 1], [-1, 1, 0, 1]])
    index = np.array([[0, 1, 2], [0, 2, 3]])
    return ClipScene(place[index], (corners / TEXELS)[index], (SIDE, SIDE), texture, shared=index)


MINIFICATION = Experiment(
    "minification",
    "Minification by each texture filter",
    "A pixel covers more and more texels, seen at an angle. How far is its colour from their mean?",
    (DENSITIES, ANGLES),
    (
        "texture_filter=nearest",
        "texture_filter=bilinear",
        "texture_filter=mipmap-nearest",
        "texture_filter=trilinear",
    ),
    "Nearest and bilinear are wrong from two texels per pixel on, at every angle. Trilinear is right up to 45"
    " degrees at any number of texels, and blurs where footprints are longer and narrower.",
    lambda place, seed: textured_square(place[0], place[1], seed),
    TextureCase,
    kind=TEXTURED_TRIANGLES,
)
SHADING_ALIASING = Experiment(
    "shading-aliasing",
    "Samples against detail inside a triangle",
    "The detail lies in the texture, not at edges. Do more samples per pixel give its mean?",
    (DENSITIES, ANGLES),
    (
        "antialiasing=none",
        "antialiasing=msaa-4",
        "antialiasing=area",
        "antialiasing=ssaa-4",
        "antialiasing=ssaa-16",
        "antialiasing=none texture_filter=trilinear",
    ),
    "Msaa-4 is as wrong as no antialiasing, because it shades once per pixel, and exact area is hardly "
    "better. 16 samples are right up to 4 texels per pixel and 60 degrees. A texture with mipmaps is right "
    "beyond that, with one sample.",
    lambda place, seed: textured_square(place[0], place[1], seed),
    TextureCase,
    Settings(texture_filter="nearest"),
    kind=TEXTURED_TRIANGLES,
)
