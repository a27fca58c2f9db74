"""Studies of what is seen: hidden surfaces and polygon clipping, against exact comparison."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Floats, Integers
from core.records.cached import cached_property
from core.records.frame import Frame
from core.settings import Settings
from core.study.accuracy.family import Assignment, Errors, StudyFamily
from core.study.accuracy.fill import MISCLASSIFIED
from core.study.accuracy.frame_task import (
    WRONG_VISIBLE,
    FrameTask,
    color_pictures,
    per_million,
    scalar_pictures,
)
from core.study.accuracy.record import Dial, Pictures, WorkKind
from core.study.accuracy.workloads import (
    COLORS,
    clip_of_window,
    cyclic_triangles,
    flat_scene,
    overlapping_triangles,
    random_source,
    random_triangles,
)
from core.study.exact.coverage import count_pixels
from core.study.exact.values import ExactFragments, exact_fragments, exact_visible

SIZE = (128, 128)
COUNTS = Dial("count", "Triangles", "", (2, 4, 8, 16, 32, 64, 128), 16, is_cost=True)


class VisibleTask(FrameTask):
    """Triangles given in clip space; the reference is the nearest one at every pixel, exactly."""

    def __init__(self, clip: Floats, size: tuple[int, int], stage: str) -> None:
        super().__init__(flat_scene(clip, size), 1)
        self.stage = stage
        self._clip = clip

    @cached_property
    def fragments(self) -> ExactFragments:
        """What is covered and in depth range."""
        return exact_fragments(self._clip, self.scene.size)

    @cached_property
    def reference(self) -> Integers:
        """(H, W) int64, the triangle seen; -1: none."""
        return exact_visible(self.fragments, self.scene.size)

    def errors(self, settings: Settings, made: Frame) -> Errors:
        """Count the pixels that show another triangle."""
        wrong = int(np.count_nonzero(made.primitive != self.reference))
        return {WRONG_VISIBLE.name: per_million(wrong, made.primitive.size)}

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return the colours of the triangles seen."""
        return color_pictures(colors_of(made.primitive), colors_of(self.reference))


def colors_of(triangle: NDArray[Any]) -> Floats:
    """Return a colour (H, W, 4) for each triangle (H, W), nothing for -1."""
    colors = COLORS[triangle % len(COLORS)].copy()
    colors[triangle < 0] = 0
    return np.asarray(colors)


def make_visibility(assignment: Assignment) -> VisibleTask:
    """Make triangles that hide each other."""
    if assignment.work == "cycle":
        return VisibleTask(cyclic_triangles(SIZE), SIZE, "depth")
    count = int(assignment.dials["count"])
    if assignment.work == "layers":
        window = random_triangles(SIZE, count, 0.6 * min(SIZE), assignment.seed)
        depth = random_source(assignment.seed + 1).permutation(count) / max(count, 1) * 0.8 + 0.1
        clip = clip_of_window(window, SIZE, np.repeat(depth[:, None], 3, axis=1), np.ones((count, 3)))
        return VisibleTask(clip, SIZE, "depth")
    return VisibleTask(overlapping_triangles(SIZE, count, assignment.seed), SIZE, "depth")


VISIBILITY = StudyFamily(
    "visibility",
    "Hidden surfaces",
    ("visibility",),
    (
        WorkKind("crossing", "Random triangles that pass through each other", "frame", (COUNTS,)),
        WorkKind("layers", "Random triangles, each at one depth", "frame", (COUNTS,)),
        WorkKind("cycle", "Three bars that overlap in a circle", "frame"),
    ),
    (WRONG_VISIBLE,),
    make_visibility,
)


class ClippingTask(VisibleTask):
    """Triangles that cross planes of the view volume; the reference keeps what is covered and in depth range."""

    @cached_property
    def cover_reference(self) -> Integers:
        """(H, W) int64, how many triangles cover each pixel in depth range."""
        return count_pixels(self.fragments.column, self.fragments.row, self.scene.size)

    def errors(self, settings: Settings, made: Frame) -> Errors:
        """Count pixels that are covered too often or too seldom."""
        wrong = int(np.abs(made.cover_count - self.cover_reference).sum())
        looked_at = len(self._clip) * made.primitive.size
        return {MISCLASSIFIED.name: per_million(wrong, looked_at), **super().errors(settings, made)}

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return how often each pixel is covered."""
        return scalar_pictures(made.cover_count, self.cover_reference)


def crossing_clip(work: str, count: int, seed: int) -> Floats:
    """Return clip corners (count, 3, 4): across the borders of the window, the near plane, or the eye."""
    source = random_source(seed)
    reach = np.array(SIZE)
    if work == "window":
        window = source.uniform(-1.0, 2.0, (count, 3, 2)) * reach
        return clip_of_window(
            window, SIZE, source.uniform(0.1, 0.9, (count, 3)), source.uniform(1, 3, (count, 3))
        )
    clip = np.empty((count, 3, 4))
    clip[..., :2] = source.uniform(-2.5, 2.5, (count, 3, 2))
    w = source.uniform(1.0, 4.0, (count, 3))
    low = 0.4 if work == "near" else -1.5
    w[:, 0] = source.uniform(low, 0.9, count) if work == "near" else source.uniform(low, -0.3, count)
    # A perspective with near 1 and far 20: z = (21 w - 40) / 19.
    clip[..., 2], clip[..., 3] = (21 * w - 40) / 19, w
    return clip


def make_clipping(assignment: Assignment) -> ClippingTask:
    """Make triangles that have to be clipped, or drawn without."""
    clip = crossing_clip(assignment.work, int(assignment.dials["count"]), assignment.seed)
    task = ClippingTask(clip, SIZE, "clip")
    task.unit_count = len(clip)
    return task


CLIPPING = StudyFamily(
    "clipping",
    "Polygon clipping",
    ("clipping",),
    (
        WorkKind("near", "Triangles across the near plane", "triangle", (COUNTS,)),
        WorkKind("eye", "Triangles with a corner behind the eye", "triangle", (COUNTS,)),
        WorkKind("window", "Triangles across the borders of the window", "triangle", (COUNTS,)),
    ),
    (MISCLASSIFIED, WRONG_VISIBLE),
    make_clipping,
)
