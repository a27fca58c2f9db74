"""Studies of polygons: which pixels rings enclose, and what is left of them in a clip window, against whole numbers."""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from core.records.arrays import Flags, Floats
from core.records.cached import cached_property
from core.records.clip_region import region_of_window
from core.records.frame import Frame, StageCount
from core.records.rings import Rings, join_rings
from core.scene import ClipScene
from core.settings import Settings
from core.stages.declared import STAGES
from core.stages.vertices import process_geometry
from core.study.accuracy.family import Assignment, StudyFamily
from core.study.accuracy.frame_task import FrameTask, per_million, scalar_pictures
from core.study.accuracy.record import Axis, ErrorMeasure, Judgement, Pictures, WorkKind, judged
from core.study.accuracy.workloads import clip_of_window
from core.study.exact.polygons import exact_cover

SIZE = (48, 48)
MISCLASSIFIED = ErrorMeasure("misclassified", "Misclassified pixels", "per million")
CONNECTING = ErrorMeasure("connecting", "Edges along the window that enclose nothing", "pixels")
WINDOW = np.array([[2.0, 38.0], [46.0, 39.0], [46.0, 47.0], [2.0, 47.0]])
"""(4, 2) convex clip window, in pixels."""
ON_BORDER = 1e-6
"""How far from the window's border an edge on it may lie by rounding, in pixels."""
CORNERS = Axis("corners", "Corners of a ring", "", (4, 8, 16, 32, 64, 128, 256), default=16, is_cost=True)
WORKS = (
    WorkKind("holes", "A concave polygon with a hole", "polygon", (CORNERS,)),
    WorkKind("crossing", "A polygon that crosses itself", "polygon", (CORNERS,)),
)


def random_rings(work: str, count: int, seed: int) -> list[Floats]:
    """Return rings (count, 2) float64 in `SIZE`: a star with a star-shaped hole, or corners anywhere."""
    generator = np.random.default_rng(seed)
    if work == "crossing":
        return [generator.uniform(0, SIZE, (count, 2))]
    angle = np.arange(count) * 2 * np.pi / count
    around = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return [
        np.array(SIZE) / 2 + around[::way] * generator.uniform(low, high, (count, 1))
        for way, low, high in ((1, 14, 23), (-1, 3, 10))
    ]


class PolygonTask(FrameTask):
    """One polygon that both rules fill."""

    def __init__(self, assignment: Assignment) -> None:
        rings = random_rings(assignment.work, int(assignment.dials["corners"]), assignment.seed)
        window = np.concatenate(rings)[None]
        level = np.ones(window.shape[:2])
        starts = np.cumsum([0, *(len(ring) for ring in rings)])
        clip = clip_of_window(window, SIZE, 0.5 * level, level)
        scene = ClipScene(clip, size=SIZE, kind="polygons", rings=starts[:-1])
        super().__init__(scene, 1, ("raster",))
        self._rings = Rings(window[0], starts, np.zeros(len(rings), np.int64))

    @cached_property
    def reference(self) -> dict[bool, Flags]:
        """By whether the rule is even-odd: (H, W) bool, the pixels inside."""
        return {is_even_odd: exact_cover(self._rings, 0, SIZE, is_even_odd) for is_even_odd in (True, False)}

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Count pixels that are wrongly covered or left out."""
        wrong = (made.primitive >= 0) != self.reference[settings.polygon_fill == "even-odd"]
        return judged({MISCLASSIFIED.name: per_million(int(np.count_nonzero(wrong)), wrong.size)})

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return which pixels are covered."""
        reference = self.reference[settings.polygon_fill == "even-odd"]
        return scalar_pictures(made.cover_count, reference.astype(np.int64))


class ClippedPolygonTask(PolygonTask):
    """One polygon that every method clips to the same convex window."""

    @cached_property
    def reference(self) -> dict[bool, Flags]:
        """By whether the rule is even-odd: (H, W) bool, the pixels inside both polygon and window."""
        window = exact_cover(join_rings([[WINDOW]]), 0, SIZE, is_even_odd=True)
        return {rule: found & window for rule, found in super().reference.items()}

    def __init__(self, assignment: Assignment) -> None:
        super().__init__(assignment)
        assert isinstance(self.scene, ClipScene)
        self.scene = replace(self.scene, clip_region=region_of_window(WINDOW, SIZE))

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Count wrong pixels, and add up the edges along the window's border that enclose nothing."""
        geometry = process_geometry(self.scene, settings, {stage: StageCount() for stage in STAGES})
        assert geometry.polygons is not None
        errors = super().judge(settings, made).errors
        return judged({**errors, CONNECTING.name: _connecting_length(geometry.polygons)})


def _connecting_length(rings: Rings) -> float:
    """Return how long the sides are, in pixels, that run along each other in opposite directions on the window."""
    total = 0.0
    start, end = rings.corners, rings.corners[rings.following]
    for a, b in zip(WINDOW, np.roll(WINDOW, -1, axis=0), strict=True):
        along = (b - a) / np.hypot(*(b - a))
        across = np.array([-along[1], along[0]])
        lies_on = (np.abs((start - a) @ across) < ON_BORDER) & (np.abs((end - a) @ across) < ON_BORDER)
        ends = np.stack([(start[lies_on] - a) @ along, (end[lies_on] - a) @ along], axis=1)
        marks = np.unique(ends)
        for low, high in pairwise(marks.tolist()):
            there = int(np.count_nonzero((ends[:, 0] <= low) & (ends[:, 1] >= high)))
            back = int(np.count_nonzero((ends[:, 1] <= low) & (ends[:, 0] >= high)))
            total += 2 * min(there, back) * (high - low)
    return total


POLYGON_CLIPPING = StudyFamily(
    "polygon_clipping",
    "Clipping of polygons",
    ("polygon_clipping",),
    WORKS[:1],
    (MISCLASSIFIED, CONNECTING),
    ClippedPolygonTask,
)
POLYGON_FILL = StudyFamily(
    "polygon_fill", "Fills of polygons", ("polygon_fill",), WORKS, (MISCLASSIFIED,), PolygonTask
)
