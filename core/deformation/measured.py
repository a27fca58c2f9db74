"""Skinning, measured: how much of its width a tube keeps where two bones meet, and what a vertex costs."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from core.methods import table
from core.records.arrays import Floats, Integers
from core.records.deformations import Skin
from core.scene import Camera, DirectionalLight, Mesh, Scene
from core.settings import Settings
from core.study.experiment import Experiment
from core.study.family import Assignment, StudyFamily, Task
from core.study.frame_task import color_pictures
from core.study.record import Axis, ErrorMeasure, Judgement, Opening, Outcome, Pictures, Verdict, WorkKind
from core.study.workloads import COLORS
from core.transform.vertex_stage import unit

LENGTH, JOINT, SIDES = 8.0, 4.0, 16
"""Of the tube, where its joint is, and vertices around it; its radius is 1."""
LOST = ErrorMeasure("lost-width", "Width lost at the joint", "per million")
ENOUGH = 0.98
"""Part of its width that a tube must keep."""
ANGLES = (0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0, 105.0, 120.0, 135.0, 150.0, 165.0, 180.0)
BEND, TWIST = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])


def tube(rings: int) -> tuple[Floats, Floats, Integers]:
    """Return positions and normals (N, 3) and triangles (T, 3) of a tube along x; an even number of rings and one."""
    turn = 2 * np.pi * np.arange(SIDES) / SIDES
    x = np.repeat(np.linspace(0.0, LENGTH, rings), SIDES)
    normals = np.column_stack([np.zeros(len(x)), np.tile(np.cos(turn), rings), np.tile(np.sin(turn), rings)])
    row, k = (part.ravel() for part in np.mgrid[: rings - 1, :SIDES])
    a, b = row * SIDES + k, row * SIDES + (k + 1) % SIDES
    triangles = np.concatenate([np.stack([a, b, b + SIDES], 1), np.stack([a, b + SIDES, a + SIDES], 1)])
    return normals + x[:, None] * TWIST, normals, triangles


def tube_scene(angle: float, axis: Floats, softness: float, rings: int = 17) -> Scene:
    """Return a tube whose second half is turned by ``angle`` degrees about ``axis`` (3,).

    Weights change over a length of ``softness`` around x = 4.
    """
    positions, normals, triangles = tube(rings)
    second = np.clip((positions[:, 0] - JOINT) / max(softness, 1e-9) + 0.5, 0.0, 1.0)
    skin = Skin(
        np.stack([1 - second, second], axis=1),
        np.array([[0.0, 0.0, 0.0], [JOINT, 0.0, 0.0]]),
        np.array([[JOINT, 0.0, 0.0], [LENGTH, 0.0, 0.0]]),
        np.array([-1, 0]),
        np.stack([axis, axis]),
        np.array([0.0, np.radians(angle)]),
    )
    colors = skin.weights @ COLORS[:2]
    mesh = Mesh(positions, triangles, normals, colors=colors, name="tube", deformation=skin)
    camera = Camera(np.array([4.0, 3.0, 16.0]), np.array([4.0, 2.0, 0.0]), near=1.0, far=40.0)
    return Scene((mesh,), camera, (DirectionalLight(np.array([-0.4, -0.8, -1.0])),), (64, 48))


def kept_width(rest: Floats, placed: Floats) -> float:
    """Return how far the ring at the joint (K, 3) is from it after skinning, over before: the least.

    Notes
    -----
    The joint itself stays where it is. A bend leaves those in the plane through it and its axis of turning alone.
    """
    middle = np.array([JOINT, 0.0, 0.0])
    ring = np.isclose(rest[:, 0], JOINT)
    before, after = (np.sqrt(((each[ring] - middle) ** 2).sum(axis=1)) for each in (rest, placed))
    return float((after / before).min())


class WidthTask(Task):
    """A tube that is bent or twisted."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.unit_count = len(scene.meshes[0].positions)

    def start(self, settings: Settings) -> Callable[[], tuple[Floats, Floats]]:
        """Prepare the skinning of all vertices."""
        mesh = self.scene.meshes[0]
        assert mesh.normals is not None
        return partial(
            table.get("skinning", settings.skinning).function,
            mesh.deformation,
            mesh.positions,
            unit(mesh.normals),
        )

    def judge(self, settings: Settings, made: tuple[Floats, Floats]) -> Judgement:
        """Compare the width at the joint with that of the tube at rest; positions (N, 3)."""
        kept = kept_width(self.scene.meshes[0].positions, made[0])
        lost = max(1 - kept, 0.0)
        outcome = Outcome.RIGHT if kept >= ENOUGH else Outcome.WRONG_PICTURE
        remark = f"the joint keeps {100 * kept:.1f} % of its width"
        return Judgement(Verdict(outcome, lost if outcome else 0.0, remark), errors={LOST.name: 1e6 * lost})

    def counts(self, settings: Settings, made: Any) -> dict[str, int]:
        """Return vertices and bones."""
        held = self.scene.meshes[0].deformation
        assert isinstance(held, Skin)
        return {"vertices": held.vertex_count, "bones of a vertex, summed": int((held.weights > 0).sum())}

    def pictures(self, settings: Settings, made: tuple[Floats, Floats]) -> Pictures:
        """Return the outline of the tube from the front, and that of dual quaternions; positions (N, 3)."""
        whole = self.start(replace(settings, skinning="dual-quaternion"))()[0]
        return color_pictures(_seen_from_front(made[0]), _seen_from_front(whole))

    def opening(self, settings: Settings, made: Any) -> Opening:
        """Return the tube."""
        return Opening(self.scene, settings, "transform", None)


def _seen_from_front(positions: Floats) -> Floats:
    """Return a picture (64, 64, 4) with a dot for each of the vertices (N, 3)."""
    picture = np.zeros((64, 64, 4))
    picture[..., 3] = 1
    column, row = (np.clip((positions[:, k] + shift) * 6, 0, 63).astype(int) for k, shift in ((0, 1), (1, 4)))
    picture[row, column, :3] = 1
    return picture


def _experiment(name: str, title: str, axis: Floats, question: str, claim: str) -> Experiment:
    return Experiment(
        name,
        title,
        question,
        (
            Axis("angle", "Angle of the joint", "degrees", ANGLES),
            Axis("softness", "Length over which weights change", "", (0.0, 0.5, 1.0, 2.0, 4.0)),
        ),
        ("skinning=linear", "skinning=dual-quaternion"),
        claim,
        lambda place, _: WidthTask(tube_scene(place[0], axis, place[1])),
    )


COLLAPSE = _experiment(
    "collapsing-joint",
    "A tube bent at a joint",
    BEND,
    "A tube is bent in the middle, where both bones have the weight 1/2. Does it stay as wide as it was?",
    "Linear blending keeps |cos(t/2)| of the width: too little from 30 degrees on, whatever the length. Dual "
    "quaternions keep all of it.",
)
WRAPPER = _experiment(
    "candy-wrapper",
    "A tube twisted about its axis",
    TWIST,
    "One half of a tube is twisted about its own axis. Does it stay as wide as it was?",
    "Linear blending keeps |cos(t/2)| of the radius: too little from 30 degrees on, nothing at 180. Dual "
    "quaternions keep all of it.",
)


def make_tube(assignment: Assignment) -> WidthTask:
    """Make a tube of so many rings."""
    axis = TWIST if assignment.work == "twist" else BEND
    return WidthTask(tube_scene(assignment.dials["angle"], axis, 2.0, int(assignment.dials["rings"]) + 1))


_DIALS = (
    Axis(
        "rings",
        "Rings of 16 vertices",
        "",
        (4, 16, 32, 64, 128, 256, 512, 1024),
        True,
        default=64,
        is_cost=True,
    ),
    Axis("angle", "Angle of the joint", "degrees", ANGLES, default=90),
)
SKINNING = StudyFamily(
    "skinning",
    "Skinning",
    ("skinning",),
    (
        WorkKind("bend", "A bent tube", "vertex", _DIALS),
        WorkKind("twist", "A twisted tube", "vertex", _DIALS),
    ),
    (LOST,),
    make_tube,
)
