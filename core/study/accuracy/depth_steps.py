"""Study of depth precision: how many neighbouring depths become equal or change places, in a published test.

Depths in equal steps from the near to the far plane are seen by a turned camera. What a graphics card does is done in
float32: the view and the projection, one after the other or multiplied before, and the division by w. Then the depth is
stored. Of two neighbours the farther one must stay behind the nearer one.

References
----------
P. Upchurch, M. Desbrun, *Tightening the precision of perspective rendering*, Journal of Graphics Tools 16 (2012).
N. Reed, *Depth precision visualized*, 2015, and the simulator published with it (near 0.1, far 10,000, 10,000 steps).
"""

from collections.abc import Callable
from functools import partial
from math import cos, sin, tan

import numpy as np

from core.framebuffer.depth import DepthFormat, Stored
from core.methods import table
from core.records.arrays import Floats, Integers, Singles
from core.settings import Settings
from core.study.accuracy.family import Assignment, StudyFamily, Task
from core.study.accuracy.frame_task import depth_bits, scalar_pictures
from core.study.accuracy.record import Axis, ErrorMeasure, Judgement, Pictures, WorkKind, judged
from core.study.accuracy.workloads import random_source

NEAR = 0.1
REACH = tan(0.65)
"""Largest y of the points over their distance; x reaches 16/9 as far."""
PITCH, YAW, EYE = 0.474747, 1.23123123, (14.9914, 0.832148, 29.7142128)
"""Where the camera looks and stands, as in Reed's simulator: numbers that no float32 holds exactly."""

EQUAL = ErrorMeasure("indistinguishable", "Neighbouring depths that become equal", "%")
SWAPPED = ErrorMeasure("swapped", "Neighbouring depths that change places", "%")
FAR = Axis("far", "Far plane over near plane", "", (10, 100, 1e3, 1e4, 1e5, 1e6), default=1e5)
STEPS = Axis("steps", "Depths", "", (100, 400, 2500, 10000), default=10000, is_cost=True)


class DepthStepsTask(Task):
    """Depths in equal steps, through float32 matrices."""

    def __init__(self, assignment: Assignment) -> None:
        count = self.unit_count = int(assignment.dials["steps"])
        self._far, self._is_composed = NEAR * assignment.dials["far"], assignment.work == "precomposed"
        distance = np.linspace(NEAR, self._far, count + 1)
        x, y = random_source(assignment.seed).uniform(-REACH, REACH, (2, count + 1)) * distance
        x *= 16 / 9
        to_world = _turned_camera()
        world = np.stack([x, y, distance, np.ones(count + 1)], axis=1) @ to_world
        self._world, self._view = world.astype(np.float32), np.linalg.inv(to_world).astype(np.float32)

    def start(self, settings: Settings) -> Callable[[], Stored]:
        """Prepare the storing of all depths."""
        return partial(self._stored, _format(settings))

    def _stored(self, depth: DepthFormat) -> Stored:
        """Return what a format stores of all depths, (N + 1,), the nearest first."""
        near, far, plane = NEAR, self._far, depth.quantity.plane
        # z and w of clip space; both are linear in the distance: OpenGL's z from -w to w, or from w to 0.
        rows = {
            "z": [(far + near) / (far - near), -2 * far * near / (far - near)],
            "reversed-z": [-near / (far - near), far * near / (far - near)],
            "inverse-w": [0.0, 1.0],
        }
        projection = np.zeros((4, 2), np.float32)
        projection[2:, 0], projection[2, 1] = rows[plane], 1
        if self._is_composed:
            z, w = _product(self._world, _product(self._view, projection)).T
        else:
            z, w = _product(_product(self._world, self._view), projection).T
        value = z / w
        if plane == "z":
            value = np.float32(0.5) * value + np.float32(0.5)
        quantity = value.astype(np.float64)
        if depth.quantity.convert is not None:
            quantity = depth.quantity.convert(quantity, near, far)
        return depth.store(quantity)

    def counts(self, settings: Settings, made: Stored) -> dict[str, int]:
        """Return how many of N stored depths (N,) differ, and the bits of one."""
        return {"different depths": len(np.unique(made)), "bits of a depth": depth_bits(settings)}

    def judge(self, settings: Settings, made: Stored) -> Judgement:
        """Return the shares of neighbours in N depths (N,) that become equal, and that change places."""
        order = self._order(settings, made)
        equal, swapped = (100 * float(each.mean()) for each in (order == 0, order < 0))
        return judged({EQUAL.name: equal, SWAPPED.name: swapped})

    def _order(self, settings: Settings, made: Stored) -> Integers:
        """Return (N,) int64: 1 where the nearer of two neighbours stays nearer, 0 equal, -1 swapped."""
        nearer = _format(settings).is_nearer
        return nearer(made[:-1], made[1:]).astype(np.int64) - nearer(made[1:], made[:-1])

    def pictures(self, settings: Settings, made: Stored) -> Pictures:
        """Return the order of all neighbours as a square (H, H), row by row from the near plane."""
        side = int(np.sqrt(self.unit_count))
        order = self._order(settings, made)[: side * side].reshape(side, side)
        return scalar_pictures(order, np.ones_like(order))


def _format(settings: Settings) -> DepthFormat:
    depth: DepthFormat = table.get("depth", settings.depth).function()
    return depth


def _turned_camera() -> Floats:
    """Return the matrix (4, 4) float64 from camera to world, for row vectors."""
    tilt = np.array([[1, 0, 0], [0, cos(PITCH), sin(PITCH)], [0, -sin(PITCH), cos(PITCH)]])
    turn = np.array([[cos(YAW), 0, sin(YAW)], [0, 1, 0], [-sin(YAW), 0, cos(YAW)]])
    matrix = np.eye(4)
    matrix[:3, :3], matrix[3, :3] = tilt @ turn, EYE
    return matrix


def _product(rows: Singles, matrix: Singles) -> Singles:
    """Return rows (N, 4) times a matrix (4, K) in float32, from left to right by fused multiplication and addition.

    Notes
    -----
    A product and a sum are rounded once together, as graphics cards do and the library that Reed's figures come from.
    Rounded twice each, the same depths give 50 % and 15 % in place of 52 % and 14 %.
    """
    total = np.zeros((len(rows), matrix.shape[1]), np.float32)
    for k in range(4):
        total = (total + rows[:, k : k + 1].astype(np.float64) * matrix[k]).astype(np.float32)
    return total


DEPTH_STEPS = StudyFamily(
    "depth-steps",
    "Depth precision",
    ("depth",),
    (
        WorkKind("separate", "Two float32 matrices (Upchurch 2012)", "depth", (FAR, STEPS)),
        WorkKind("precomposed", "One float32 matrix (Upchurch 2012)", "depth", (FAR, STEPS)),
    ),
    (EQUAL, SWAPPED),
    DepthStepsTask,
)
