"""Colours and samples measured: filters and samples against 256 of these, and triangles thinner than a pixel.

References
----------
F. C. Crow, *The aliasing problem in computer-generated shaded images*, 1977.

References
----------
F. C. Crow, *The aliasing problem in computer-generated shaded images*, 1977 (small objects are lost).
E. Catmull, *A hidden-surface algorithm with anti-aliasing*, 1978 (exact area).
"""

from copy import copy
from dataclasses import replace

import numpy as np

from core.coverage.measured_exactly import area_in_pixels
from core.coverage.pixel_runs import make_raster
from core.coverage.snapping import snap, window_position
from core.pipeline import draw
from core.records.arrays import Flags, Floats, Integers
from core.records.frame import Frame
from core.records.primitives import lit_by
from core.scene import SIZE_LIMIT, AnyScene, ClipScene, Scene
from core.settings import Settings
from core.shading.measured import sphere_picture
from core.study.experiment import Case, Experiment, check_in_view_volume
from core.study.family import Assignment, StudyFamily
from core.study.frame_task import LARGEST_COLOR, MEAN_COLOR, ColorTask, premultiplied
from core.study.record import Axis, Judgement, Outcome, Verdict, WorkKind
from core.study.workloads import (
    checkerboard,
    clip_of_window,
    flat_scene,
    sphere_scene,
    textured_quad,
    window_mesh,
)
from core.trace import trace

# The picture of 256 samples: the scene drawn at 16 times its size and averaged, the reference for colours.


SIDE = 16
"""Samples on a side of a pixel."""
ROWS = 32
"""So many rows of a picture are enough to tell its mean error."""
ROWS_AT_ONCE = 4


def can_be_sampled(size: tuple[int, int]) -> bool:
    """Return whether a picture of this size can be drawn at 16 times its size."""
    return SIDE * max(size) <= SIZE_LIMIT


def spread_rows(height: int) -> Integers:
    """Return (R,) int64 rows of a picture, evenly spread, all of a small one."""
    count = min(height, ROWS)
    return (np.arange(count) * height) // count


def sampled_rows(scene: AnyScene, settings: Settings, rows: Integers) -> Floats:
    """Return the mean colours (R, W, 4) float64, times alpha, of 16 x 16 samples in every pixel of some rows (R,).

    Notes
    -----
    Samples lie at the centres of a grid of 16 x 16 squares in the pixel, whatever ``pixel_center`` says.
    """
    width, height = scene.size
    enlarged = replace(copy(scene), size=(SIDE * width, SIDE * height))
    settings = replace(settings, pixel_center="half")
    result = np.empty((len(rows), width, 4))
    # Neighbouring rows are drawn together.
    parts = np.split(np.arange(len(rows)), np.flatnonzero(np.diff(rows) != 1) + 1)
    for part in (
        chunk for run in parts for chunk in np.split(run, range(ROWS_AT_ONCE, len(run), ROWS_AT_ONCE))
    ):
        if not len(part):
            continue
        region = (0, SIDE * int(rows[part[0]]), SIDE * width, SIDE * len(part))
        frame = draw(enlarged, settings, make_raster(enlarged.size, "half", region))
        samples = premultiplied(frame.color, settings).reshape(len(part), SIDE, width, SIDE, 4)
        result[part] = samples.mean(axis=(1, 3))
    return result


def sampled_picture(scene: AnyScene, settings: Settings) -> Floats:
    """Return the mean colours (H, W, 4) float64, times alpha, of 256 samples in every pixel."""
    return sampled_rows(scene, settings, np.arange(scene.size[1]))


# Studies of colours: texture filters against 256 samples, antialiasing against areas, shading against the
# sphere.


TEXELS = 256
"""Texels on a side of the texture."""
DENSITIES = Axis("density", "Texels per pixel", "", (0.125, 0.25, 0.5, 1, 2, 4, 8, 16), default=4)
SIDES = Axis("side", "Side of the picture", "pixels", (16, 32, 64, 128, 256), default=64, is_cost=True)


class TextureTask(ColorTask):
    """A textured square."""

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return the counts of the frame, and the texels that are read."""
        columns = trace(self.scene, settings, region=(0, 0, 1, 1)).stage("shade").columns
        # The texels of a fragment by their columns: of one level, or of the nearer and the farther.
        each = sum(values.shape[1] for name, values in columns.items() if name.rpartition("_")[2] == "texels")
        return super().counts(settings, made) | {"texels read": each * made.statistics["shade"].incoming}


def make_texture_filter(assignment: Assignment) -> TextureTask:
    """Make a textured square, facing the camera or leaning back.

    Notes
    -----
    Magnified, the texture is taken to be linear between texel centres, as OpenGL's bilinear filter does; with a texel
    or more for a pixel each texel is a square of one colour, whose mean over a pixel is what mipmaps keep.
    """
    side = int(assignment.dials["side"])
    repeats = side * assignment.dials["density"] / TEXELS
    ratio = 1.0 if assignment.work == "facing" else 4.0
    scene = textured_quad(side, ratio, repeats, checkerboard(TEXELS, assignment.seed))
    base = Settings(texture_filter="bilinear" if assignment.dials["density"] < 1 else "nearest")
    return TextureTask(scene, side * side, "shade", lambda: (sampled_picture(scene, base), None), ("shade",))


TEXTURE_FILTER = StudyFamily(
    "texture_filter",
    "Texture filters",
    ("texture_filter",),
    (
        WorkKind("facing", "A textured square, facing the camera", "pixel", (DENSITIES, SIDES)),
        WorkKind("leaning", "A textured square, leaning back", "pixel", (DENSITIES, SIDES)),
    ),
    (MEAN_COLOR, LARGEST_COLOR),
    make_texture_filter,
)


def make_antialiasing(assignment: Assignment) -> ColorTask:
    """Make a mesh of flat colours with edges in all directions."""
    side = int(assignment.dials["side"])
    # On the 1/256-pixel grid: samples and areas see the same triangles, as nothing is snapped.
    window = window_mesh((side, side), 6, assignment.seed, 256)
    level = np.ones(window.shape[:2])
    scene = flat_scene(clip_of_window(window, (side, side), 0.5 * level, level), (side, side))
    return ColorTask(scene, side * side, "resolve", lambda: (mean_of_areas(window, scene), None))


def mean_of_areas(window: Floats, scene: ClipScene) -> Floats:
    """Return the colours (H, W, 4) float64 of triangles (T, 3, 2) in pixels side by side, by their exact areas."""
    row, column = (index.ravel() for index in np.mgrid[: scene.size[1], : scene.size[0]])
    assert scene.attributes is not None
    colors = np.zeros((len(row), 4))
    for corners, color in zip(window, scene.attributes[:, 0], strict=True):
        (ax, ay), (bx, by) = corners[1] - corners[0], corners[2] - corners[0]
        turned = corners if ax * by > ay * bx else corners[::-1]
        colors += area_in_pixels(turned, column, row)[:, None] * color
    return colors.reshape(*scene.size[::-1], 4)


ANTIALIASING = StudyFamily(
    "antialiasing",
    "Antialiasing",
    ("antialiasing",),
    (WorkKind("edges", "A mesh of flat colours, edges in all directions", "pixel", (SIDES,)),),
    (MEAN_COLOR, LARGEST_COLOR),
    make_antialiasing,
)


class ShadingTask(ColorTask):
    """A sphere of triangles; the reference is the sphere itself, met by every pixel's ray."""

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return the counts of the frame, and how often the lighting rule is evaluated."""
        assert isinstance(self.scene, Scene)
        (mesh,), counts = self.scene.meshes, super().counts(settings, made)
        lit = {
            "fragments": counts["pixels shaded"],
            "vertices": len(mesh.positions),
            "faces": len(mesh.triangles),
            "nothing": 0,
        }
        return counts | {"lights evaluated": lit[lit_by(settings.shading)]}


def make_shading(assignment: Assignment) -> ShadingTask:
    """Make a sphere of triangles."""
    scene = sphere_scene(int(assignment.dials["rings"]), int(assignment.dials["side"]))
    return ShadingTask(scene, 1, "shade", lambda: sphere_picture(scene, 1.0)[::-1])


SHADING = StudyFamily(
    "shading",
    "Shading",
    ("shading",),
    (
        WorkKind(
            "sphere",
            "A shining sphere",
            "frame",
            (
                Axis(
                    "rings",
                    "Rings of the sphere",
                    "",
                    (4, 6, 8, 12, 16, 24, 32, 48, 64),
                    default=16,
                    is_cost=True,
                ),
                Axis("side", "Side of the picture", "pixels", (32, 64, 128, 256), default=128),
            ),
        ),
    ),
    (MEAN_COLOR, LARGEST_COLOR),
    make_shading,
)


# Triangles thinner than a pixel: which of them fall between the samples.


SIZE = (16, 32)
FOOT, TIP = 8.0, 1024.0
"""How far below the picture's lower border the needle begins, and how far above it ends, in pixels."""
SLANT = 1 / 32
"""Pixels to the right with every row: a pixel over the whole picture."""
TOLERANCE = 1 / 4
"""Largest error of a pixel's cover that is taken as right: one sample of four."""


class ThinCase(Case):
    """One white triangle; right is the exact area of it in every pixel, with its corners on the grid.

    Raises ValueError if there are several triangles, which may cover the same part of a pixel, or it is cut by a plane
    of depth.
    """

    scene: ClipScene
    stage = "resolve"

    def __init__(self, scene: ClipScene) -> None:
        if len(scene.clip) != 1:
            raise ValueError(f"expected one triangle, got {len(scene.clip)}")
        check_in_view_volume(scene)
        super().__init__(scene)
        width, height = scene.size
        row, column = np.mgrid[0:height, 0:width]
        window = counter_clockwise_window(scene)
        self.wanted = area_in_pixels(window, column.ravel(), row.ravel()).reshape(row.shape)

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Compare how much of each pixel is covered with the exact area; a row without any cover is a hole."""
        shown = made.color[..., 3].astype(np.float64)
        error = np.abs(shown - self.wanted)
        largest = float(error.max())
        is_lost = (shown.sum(axis=1) == 0) & (self.wanted.sum(axis=1) > 0)
        lost = int(np.count_nonzero(is_lost))
        remark = f"the needle is lost in {lost} rows of {len(shown)}; cover is off by {largest:.3g} of a pixel at most"
        wrong = (error > TOLERANCE) | (is_lost[:, None] & (self.wanted > 0))
        if lost:
            outcome = Outcome.HOLE
        else:
            outcome = Outcome.RIGHT if largest <= TOLERANCE else Outcome.WRONG_PICTURE
        return Judgement(Verdict(outcome, largest, remark), wrong)

    def assertions(self, settings: Settings, made: Frame, wrong: Flags) -> str:
        """Return statements about the cover of all pixels (H, W), and the rows that have to have some."""
        rows = np.flatnonzero(self.wanted.sum(axis=1) > 0).tolist()
        return (
            f"cover = frame.color[..., 3]\n"
            f"assert np.abs(cover - {self.wanted.tolist()}).max() <= {TOLERANCE}\n"
            f"assert all(cover[row].any() for row in {rows})"
        )


def counter_clockwise_window(scene: ClipScene) -> Floats:
    """Return the corners (3, 2) of the first triangle in pixels, on the 1/256-pixel grid, counter-clockwise."""
    window, _ = snap(window_position(scene.clip[0], scene.size))
    (x1, y1), (x2, y2) = window[1:] - window[0]
    return np.asarray(window[::-1] if x1 * y2 < y1 * x2 else window)


def needle(width: float, offset: float) -> ClipScene:
    """Return a white needle, almost upright, from below the picture to a tip far above it: hardly wider below."""
    # All on the 1/256-pixel grid, so that snapping moves nothing.
    left = 7.0 + offset
    tip = left + width / 2 + SLANT * (TIP + FOOT)
    window = np.array([[left, -FOOT], [left + width, -FOOT], [tip, TIP]])
    window = np.rint(256 * window) / 256
    level = np.ones((1, 3))
    return ClipScene(clip_of_window(window[None], SIZE, 0.5 * level, level), np.ones((1, 3, 4)), SIZE)


THIN = Experiment(
    "thin-triangles",
    "Needles between the samples",
    "A needle becomes thinner and moves across a pixel. Is it visible in every row, and how close is its "
    "area?",
    (
        Axis("width", "Width", "pixels", tuple(2.0**k for k in range(-6, 3)), True),
        Axis("offset", "Offset in the pixel", "pixels", tuple(k / 8 for k in range(8))),
    ),
    (
        "antialiasing=none",
        "antialiasing=msaa-4",
        "antialiasing=ssaa-4",
        "antialiasing=ssaa-16",
        "antialiasing=area",
    ),
    "Rows of a needle are lost where it is narrower than the distance between columns of samples: 1 pixel "
    "with one sample, 1/2 with four on a grid (ssaa-4), 1/4 with four on a rotated grid (msaa-4) and with "
    "sixteen. Exact area loses none.",
    lambda place, _: needle(place[0], place[1]),
    ThinCase,
)
