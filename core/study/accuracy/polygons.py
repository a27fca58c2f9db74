"""Study of polygon fills: which pixels rings enclose, against whole numbers."""

import numpy as np

from core.records.arrays import Flags, Floats
from core.records.cached import cached_property
from core.records.frame import Frame
from core.records.rings import Rings
from core.scene import ClipScene
from core.settings import Settings
from core.study.accuracy.family import Assignment, Errors, StudyFamily
from core.study.accuracy.frame_task import FrameTask, per_million, scalar_pictures
from core.study.accuracy.record import Dial, ErrorMeasure, Pictures, WorkKind
from core.study.accuracy.workloads import clip_of_window
from core.study.exact.polygons import exact_cover

SIZE = (48, 48)
MISCLASSIFIED = ErrorMeasure("misclassified", "Misclassified pixels", "per million")
CORNERS = Dial("corners", "Corners of a ring", "", (4, 8, 16, 32, 64, 128, 256), 16, is_cost=True)
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

    def errors(self, settings: Settings, made: Frame) -> Errors:
        """Count pixels that are wrongly covered or left out."""
        wrong = (made.primitive >= 0) != self.reference[settings.polygon_fill == "even-odd"]
        return {MISCLASSIFIED.name: per_million(int(np.count_nonzero(wrong)), wrong.size)}

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return which pixels are covered."""
        reference = self.reference[settings.polygon_fill == "even-odd"]
        return scalar_pictures(made.cover_count, reference.astype(np.int64))


POLYGON_FILL = StudyFamily(
    "polygon_fill", "Fills of polygons", ("polygon_fill",), WORKS, (MISCLASSIFIED,), PolygonTask
)
