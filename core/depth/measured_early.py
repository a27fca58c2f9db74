"""The time of the depth test, measured: fragments that are shaded, by the order in which layers are drawn."""

import numpy as np

from core.records.arrays import Floats, Integers
from core.records.frame import Frame
from core.settings import Settings
from core.study.family import Assignment, StudyFamily
from core.study.frame_task import WRONG_VISIBLE, SeenTask
from core.study.record import Axis, WorkKind
from core.study.workloads import clip_of_window, flat_scene, random_source
from core.trace import trace

SIZE = (32, 24)
LAYERS = Axis("layers", "Layers over every pixel", "", (1, 2, 4, 8, 16, 32), default=4, is_cost=True)


class LayersTask(SeenTask):
    """Triangles over the whole picture, each at one of ``depths`` (T,), in drawing order."""

    def __init__(self, depths: Floats) -> None:
        width, height = SIZE
        window = np.tile([[0.0, 0.0], [2.0 * width, 0.0], [0.0, 2.0 * height]], (len(depths), 1, 1))
        corners = np.repeat(depths[:, None], 3, axis=1)
        clip = clip_of_window(window, SIZE, corners, np.ones_like(corners))
        nearest: Integers = np.full(SIZE[::-1], int(np.argmin(depths)))
        super().__init__(flat_scene(clip, SIZE), len(depths), "shade", lambda: nearest)

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return the counts of the frame, and what the method shades; the frame itself shades what is seen alone."""
        counts = super().counts(settings, made)
        del counts["pixels shaded"]
        return counts | {"fragments shaded": trace(self.scene, settings).fragment_counts[3]}


def make_layers(assignment: Assignment) -> LayersTask:
    """Make the layers in one order."""
    count = int(assignment.dials["layers"])
    depths = (np.arange(count) + 0.5) / count
    if assignment.work == "far-to-near":
        depths = depths[::-1]
    elif assignment.work == "random":
        depths = depths[random_source(assignment.seed).permutation(count)]
    return LayersTask(depths)


DEPTH_TEST_TIME = StudyFamily(
    "depth_test_time",
    "Depth test",
    ("depth_test_time",),
    (
        WorkKind("random", "Layers in random order", "frame", (LAYERS,)),
        WorkKind("near-to-far", "Layers from near to far", "frame", (LAYERS,)),
        WorkKind("far-to-near", "Layers from far to near", "frame", (LAYERS,)),
    ),
    (WRONG_VISIBLE,),
    make_layers,
)
