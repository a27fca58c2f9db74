"""Temporal antialiasing measured: the error of what is kept against exact areas, by the number of pictures."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from core.antialiasing.measured import mean_of_areas
from core.pipeline import render
from core.records.motion import Motion
from core.scene import ClipScene
from core.settings import Settings
from core.study.family import Assignment, StudyFamily
from core.study.frame_task import LARGEST_COLOR, MEAN_COLOR, ColorTask
from core.study.record import Axis, WorkKind
from core.study.workloads import clip_of_window, flat_scene, window_mesh

PICTURES = Axis(
    "pictures", "Pictures", "", (1, 2, 4, 8, 16, 32), default=16, is_cost=True, setting="pictures"
)
SIDE = 32
"""Pixels on a side of the picture."""
STEP = 2 / SIDE
"""NDC of a pixel."""


class TemporalTask(ColorTask):
    """A scene that is drawn as so many pictures."""

    def __init__(self, scene: ClipScene, reference: Callable[[], Any], pictures: int) -> None:
        super().__init__(scene, SIDE * SIDE, "resolve", reference)
        self.turned = {"pictures": pictures}


def make_temporal(assignment: Assignment) -> TemporalTask:
    """Make a mesh of flat colours at rest, or two of its triangles that move one pixel a picture."""
    window = window_mesh((SIDE, SIDE), 4, assignment.seed, 256)
    level = np.ones(window.shape[:2])
    scene = flat_scene(clip_of_window(window, (SIDE, SIDE), 0.5 * level, level), (SIDE, SIDE))
    count = int(assignment.dials["pictures"])
    if assignment.work == "at-rest":
        return TemporalTask(scene, lambda: (mean_of_areas(window, scene), None), count)
    assert scene.attributes is not None
    few = replace(
        scene,
        clip=scene.clip[:2],
        attributes=scene.attributes[:2],
        motion=Motion(objects=tuple((number, (STEP, 0.0, 0.0)) for number in range(2))),
    )
    exact = Settings(antialiasing="area", cull="none")
    return TemporalTask(few, lambda: (render(few, exact).color.astype(np.float64), None), count)


TEMPORAL = StudyFamily(
    "temporal",
    "Temporal antialiasing",
    ("history",),
    (
        WorkKind("at-rest", "A mesh of flat colours at rest", "pixel", (PICTURES,)),
        WorkKind("moving", "Two triangles that move a pixel a picture", "pixel", (PICTURES,)),
    ),
    (MEAN_COLOR, LARGEST_COLOR),
    make_temporal,
    Settings(antialiasing="temporal"),
)
