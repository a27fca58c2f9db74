"""Triangles thinner than a pixel: which of them fall between the samples.

References
----------
F. C. Crow, *The aliasing problem in computer-generated shaded images*, 1977 (small objects are lost).
E. Catmull, *A hidden-surface algorithm with anti-aliasing*, 1978 (exact area).
"""

import numpy as np

from core.records.arrays import Flags, Floats
from core.records.frame import Frame
from core.scene import ClipScene
from core.settings import Settings
from core.study.accuracy.record import Axis, Judgement, Outcome, Verdict
from core.study.accuracy.workloads import clip_of_window
from core.study.exact.areas import area_in_pixels
from core.study.stability.experiment import Case, Experiment, check_in_view_volume

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
    clip = scene.clip[0]
    window = (clip[:, :2] / clip[:, 3:] + 1) / 2 * scene.size
    window = np.rint(256 * window) / 256
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
