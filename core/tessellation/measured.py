"""Tessellation measured: the segments of a curve, and how far it is from them."""

import numpy as np

from core.coverage.snapping import window_position
from core.pipeline import render
from core.records.arrays import Floats
from core.records.curves import Curves
from core.records.frame import Frame
from core.scene import ClipScene
from core.settings import Settings
from core.stages.before_matrices import tessellated
from core.study.family import Assignment, StudyFamily
from core.study.frame_task import FrameTask, color_pictures
from core.study.record import Axis, ErrorMeasure, Judgement, Pictures, WorkKind, judged
from core.tessellation.bezier import levels, shares
from core.tessellation.segments import TOLERANCE_PARTS

DEVIATION = ErrorMeasure("deviation", "Farthest point of the curve from its segments", "px")
ARCH = np.array([(2.0, 4.0), (10.0, 40.0), (50.0, 44.0), (60.0, 6.0)])
"""Control points of a smooth curve, in pixels of a 64 x 48 picture."""
HOOK = np.array([(2.0, 4.0), (62.0, 8.0), (62.0, 8.0), (60.0, 44.0)])
"""The same of a curve that is nearly straight at first, and bends at one place."""
SIZE = (64, 48)
POINTS = 4001
"""Points of the curve that are measured."""


def curve_of(control: Floats) -> ClipScene:
    """Return a scene of one curve, control points (D + 1, 2) in pixels of a 64 x 48 picture."""
    clip = np.concatenate([2 * control / SIZE - 1, np.tile([0.0, 1.0], (len(control), 1))], axis=1)
    curves = Curves(clip[None], np.ones((1, 4)))
    return ClipScene(clip[None, [0, -1]], size=SIZE, kind="segments", curves=curves)


def deviation(scene: ClipScene, settings: Settings, curve: int = 0) -> float:
    """Return how far the farthest of many points of a curve of a scene is from its segments, in pixels."""
    made = tessellated(scene, settings)
    assert isinstance(made.scene, ClipScene)
    every = np.arange(POINTS)
    control = np.repeat(made.control[curve][None], POINTS, axis=0)
    points = levels(*shares(every, np.full(POINTS, POINTS - 1)), control)[-1][:, 0]
    places = window_position(points, scene.size)
    ends = window_position(made.scene.clip[made.owner[::2] == curve], scene.size)
    nearest = np.full(POINTS, np.inf)
    for a, b in ends:
        chord, away = b - a, places - a
        along = np.clip(away @ chord / max(float(chord @ chord), 1e-300), 0, 1)
        nearest = np.minimum(nearest, np.hypot(*(away - along[:, None] * chord).T))
    return float(nearest.max())


class CurveTask(FrameTask):
    """A scene of one curve, cut by each method to so many ``segments`` or to a ``tolerance`` in 1/16 pixel."""

    scene: ClipScene
    stage = "transform"

    def __init__(self, scene: ClipScene, segments: int, tolerance: int) -> None:
        super().__init__(scene, 1)
        self.turned = {"segments": segments, "curve_tolerance": tolerance}

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return the segments, and the mixtures that their ends take."""
        assert self.scene.curves is not None
        segments, degree = made.statistics["transform"].outgoing, self.scene.curves.control.shape[1] - 1
        return {"segments": segments, "mixtures": (segments + 1) * degree * (degree + 1) // 2}

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Measure how far the curve is away; within the tolerance it is right."""
        found, tolerance = deviation(self.scene, self.with_dials(settings)), self.turned["curve_tolerance"]
        return judged({DEVIATION.name: found}, tolerance=tolerance / TOLERANCE_PARTS)

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return the line, and that of segments within 1/16 pixel."""
        fine = render(self.scene, Settings(tessellation="bound", curve_tolerance=1))
        return color_pictures(made.color, fine.color)


def make_curve(assignment: Assignment) -> CurveTask:
    """Make the smooth curve, or the one that bends at one place."""
    scene = curve_of(HOOK if assignment.work == "hook" else ARCH)
    return CurveTask(scene, *(int(assignment.dials[name]) for name in ("segments", "tolerance")))


_SEGMENTS = Axis(
    "segments", "Segments", "", (1, 2, 3, 4, 6, 8, 12, 16, 32, 64), default=6, setting="segments"
)
_TOLERANCE = Axis(
    "tolerance",
    "Tolerance",
    "sixteenths of a pixel",
    (1, 2, 4, 8, 16, 32, 64, 128),
    is_logarithmic=True,
    default=8,
    is_cost=True,
    setting="curve_tolerance",
)
TESSELLATION = StudyFamily(
    "tessellation",
    "Tessellation",
    ("tessellation",),
    (
        WorkKind("arch", "A smooth curve", "frame", (_TOLERANCE, _SEGMENTS)),
        WorkKind("hook", "A curve that bends at one place", "frame", (_TOLERANCE, _SEGMENTS)),
    ),
    (DEVIATION,),
    make_curve,
)
