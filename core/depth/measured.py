"""Depth measured: neighbouring depths that become equal or change places, and walls that fight in every format.

Depths in equal steps from the near to the far plane are seen by a turned camera. What a graphics card does is done in
float32: the view and the projection, one after the other or multiplied before, and the division by w. Then the depth is
stored. Of two neighbours the farther one must stay behind the nearer one.

References
----------
P. Upchurch, M. Desbrun, *Tightening the precision of perspective rendering*, Journal of Graphics Tools 16 (2012).
N. Reed, *Depth precision visualized*, 2015, and the simulator published with it (near 0.1, far 10,000, 10,000 steps).

The nearer wall has to be seen everywhere. Which one is nearer at a pixel is decided by ray casting, exactly.

References
----------
N. Reed, *Depth precision visualized*, 2015.
K. Akeley, J. Su, *Minimum triangle separation for correct z-buffer occlusion*, 2006.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from math import cos, sin, tan

import numpy as np
from numpy.typing import NDArray

from core.depth.depth import DepthFormat, Stored
from core.methods import table
from core.pipeline import render
from core.records.arrays import Floats, Integers, Singles, cached_property
from core.records.frame import Frame
from core.scene import AnyScene, Camera, Scene
from core.settings import Settings
from core.study.experiment import Case, Experiment
from core.study.family import Assignment, StudyFamily, Task
from core.study.fragment_cases import NearestCase
from core.study.frame_task import depth_bits, judge_order, scalar_pictures
from core.study.record import Axis, ErrorMeasure, Judgement, Pictures, WorkKind, judged
from core.study.workloads import layered_walls, random_source, wall_scene

# Study of depth precision: how many neighbouring depths become equal or change places, in a published test.


NEAR = 0.1
REACH = tan(0.65)
"""Largest y of the points over their distance; x reaches 16/9 as far."""
PITCH, YAW, EYE = 0.474747, 1.23123123, (14.9914, 0.832148, 29.7142128)
"""Where the camera looks and stands, as in Reed's simulator: numbers that no float32 holds exactly."""

EQUAL = ErrorMeasure("indistinguishable", "Neighbouring depths that become equal", "%")
SWAPPED = ErrorMeasure("swapped", "Neighbouring depths that change places", "%")
FAR_PLANE = Axis("far", "Far plane over near plane", "", (10, 100, 1e3, 1e4, 1e5, 1e6), default=1e5)
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
        WorkKind("separate", "Two float32 matrices (Upchurch 2012)", "depth", (FAR_PLANE, STEPS)),
        WorkKind("precomposed", "One float32 matrix (Upchurch 2012)", "depth", (FAR_PLANE, STEPS)),
    ),
    (EQUAL, SWAPPED),
    DepthStepsTask,
)


# Z-fighting: two walls, one a little nearer than the other, in every depth format.


SIDE = 32
"""Pixels on a side of the picture."""
FAR = 1e5
"""The far plane of the walls by distance; the near plane is at 1."""
FORMATS = (
    "depth=z-16",
    "depth=z-24",
    "depth=z-float32",
    "depth=inverse-w",
    "depth=logarithmic",
    "depth=reversed-z",
    "depth=fixed-38",
    "visibility=ray-casting",
)
"""From the coarsest to the referee."""


def visible_triangles(scene: AnyScene, settings: Settings | None = None) -> NDArray[np.int32]:
    """Return the number of the nearest triangle at every pixel, (H, W) int32, -1: none.

    Notes
    -----
    ``settings`` say what is covered and culled; shading, blending and the depth format play no part. Of triangles that
    are exactly as near, it is the first.
    """
    chosen = replace(settings or Settings(), visibility="ray-casting", depth="z-float32", blend="opaque")
    return render(scene, replace(chosen, shading="unlit", interpolation="flat")).primitive


class HiddenCase(Case):
    """A scene of opaque triangles; right is the nearest one at every pixel."""

    scene: Scene
    stage = "depth"

    @cached_property
    def nearest(self) -> NDArray[np.int32]:
        """(H, W) int32, the triangle that ray casting sees."""
        return visible_triangles(self.scene, Settings(fill="bounding-box"))

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Count the pixels that show the farther wall."""
        return judge_order(np.asarray(made.primitive != self.nearest), "the farther wall")


def facing_walls(distance: float, gap: float, lean: float) -> Scene:
    """Return two walls at ``distance`` before a perspective camera with planes at 1 and `FAR`, ``gap`` apart.

    Notes
    -----
    They are turned by ``lean``, so that every column is at a depth of its own. The nearer wall is the farther one made
    smaller about the eye: it is nearer along every ray.
    """
    farther = _leaning_wall(distance, lean, 0.6)
    camera = Camera(np.zeros(3), np.array([0.0, 0.0, -1.0]), near=1.0, far=FAR)
    return _between(farther, farther * (1 - gap / distance), camera)


def orthographic_walls(distance: float, gap: float, lean: float) -> Scene:
    """Return two walls before an orthographic camera with planes at 0 and 1, ``gap`` apart."""
    farther = _leaning_wall(1.0, 0.0, 1.2)
    farther[:, 2] = -distance * (1 + lean * farther[:, 0])
    camera = Camera(
        np.zeros(3), np.array([0.0, 0.0, -1.0]), projection="orthographic", view_height=2.0, near=0.0, far=1.0
    )
    return _between(farther, farther + np.array([0.0, 0.0, gap]), camera)


def _leaning_wall(distance: float, lean: float, reach: float) -> Floats:
    """Return the corners (4, 3) of a wall that fills the view, its right side farther by the part ``lean``."""
    x, y = np.array([-1.0, 1.0, 1.0, -1.0]), np.array([-1.0, -1.0, 1.0, 1.0])
    d = distance * (1 + lean * x)
    return np.stack([reach * x * d, reach * y * d, -d], axis=1)


def _between(farther: Floats, nearer: Floats, camera: Camera) -> Scene:
    """Return the nearer wall, drawn between the two halves of the farther one."""
    halves = np.array([[0, 1, 2], [0, 2, 3]])
    return Scene(layered_walls(farther, nearer, halves, np.array([True, False])), camera, (), (SIDE, SIDE))


def leaning(seed: int) -> float:
    """Return how walls lean, by chance."""
    return float(random_source(seed).uniform(0.1, 0.2))


def decades(first: int, last: int) -> tuple[float, ...]:
    """Return 10^first to 10^last, two for each decade."""
    return tuple(float(f"{10 ** (half / 2):.3g}") for half in range(2 * first, 2 * last + 1))


BASE = Settings(shading="unlit", fill="bounding-box")
"""What the depth formats share: nothing but depth matters."""

BY_DISTANCE = Experiment(
    "z-fighting-distance",
    "Z-fighting by gap and distance",
    "Two walls with a gap between them move away (near plane 1, far plane 100,000). From which distance does "
    "the farther wall show through?",
    (
        Axis("distance", "Distance, near plane = 1", "", decades(1, 4), True),
        Axis("gap", "Gap, near plane = 1", "", decades(-6, 0), True),
    ),
    FORMATS,
    "For z the gap must grow with the square of the distance: 2^-16 of it with 16 bits, 2^-24 with 24 bits "
    "and with float32, 2^-31 with 38 bits on planes. For 1/w, the logarithm and reversed z it must grow with "
    "the distance only. Ray casting needs no gap.",
    lambda place, seed: HiddenCase(facing_walls(place[0], place[1], leaning(seed))),
    NearestCase,
    BASE,
)
BY_RANGE = Experiment(
    "z-fighting-range",
    "Z-fighting by gap and depth range",
    "Two walls reach from the near plane to the far plane. The gap is a fraction of the distance. Which depth"
    " range can a format resolve?",
    (
        Axis("far", "Far plane over near plane", "", decades(1, 6), True),
        Axis("gap", "Gap, as a part of the distance", "", decades(-7, -2), True),
    ),
    FORMATS,
    "z in 16 or 24 bits or float32 loses pixels as the range grows, whatever the gap. 1/w, the logarithm, "
    "reversed z and 38 bits of z are right for a gap of 10^-6 of the distance at any range up to 10^6.",
    lambda place, _: HiddenCase(wall_scene(place[0], place[1], SIDE)),
    NearestCase,
    BASE,
)
ORTHOGRAPHIC = Experiment(
    "orthographic-depth",
    "Depth without perspective",
    "Two walls stand before an orthographic camera. How small may the gap be, and does the format work at "
    "all?",
    (
        Axis("distance", "Distance, as a part of the range", "", (0.01, 0.03, 0.1, 0.3, 0.5, 0.7, 0.8), True),
        Axis("gap", "Gap, as a part of the range", "", tuple(2.0**-k for k in range(30, 8, -2)), True),
    ),
    FORMATS,
    "1/w and the logarithm refuse, because w is constant. 16 bits are right down to a gap of 2^-16 of the "
    "range; 24 bits, float32 and reversed z, which is no better here, down to 2^-24; 38 bits down to 2^-30.",
    lambda place, seed: HiddenCase(orthographic_walls(place[0], place[1], leaning(seed))),
    NearestCase,
    BASE,
)
