"""Z-fighting: two walls, one a little nearer than the other, in every depth format.

The nearer wall has to be seen everywhere. Which one is nearer at a pixel is decided by ray casting, exactly.

References
----------
N. Reed, *Depth precision visualized*, 2015.
K. Akeley, J. Su, *Minimum triangle separation for correct z-buffer occlusion*, 2006.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from core.pipeline import render
from core.records.arrays import Floats
from core.records.cached import cached_property
from core.records.frame import Frame
from core.scene import AnyScene, Camera, Scene
from core.settings import Settings
from core.study.accuracy.frame_task import judge_order
from core.study.accuracy.record import Axis, Judgement
from core.study.accuracy.workloads import layered_walls, random_source, wall_scene
from core.study.stability.experiment import Case, Experiment
from core.study.stability.fragments.cases import NearestCase

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
        Axis(
            "distance",
            "Distance, as a part of the range",
            "",
            (0.01, 0.03, 0.1, 0.3, 0.5, 0.7, 0.8),
            True,
        ),
        Axis("gap", "Gap, as a part of the range", "", tuple(2.0**-k for k in range(30, 8, -2)), True),
    ),
    FORMATS,
    "1/w and the logarithm refuse, because w is constant. 16 bits are right down to a gap of 2^-16 of the "
    "range; 24 bits, float32 and reversed z, which is no better here, down to 2^-24; 38 bits down to 2^-30.",
    lambda place, seed: HiddenCase(orthographic_walls(place[0], place[1], leaning(seed))),
    NearestCase,
    BASE,
)
