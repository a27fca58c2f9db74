"""Split and dice measured: shaded points and the outline of a ball, by the side of micropolygons and by layers."""

from dataclasses import replace

import numpy as np

from core.pipeline import render
from core.records.arrays import Flags
from core.records.frame import Frame
from core.scene import Scene
from core.settings import Settings
from core.stages.before_matrices import before_matrices
from core.study.family import Assignment, StudyFamily
from core.study.frame_task import FrameTask, color_pictures
from core.study.record import Axis, ErrorMeasure, Judgement, Pictures, WorkKind, judged
from core.tessellation.ball import RADIUS, SIDE, balls

OUTLINE = ErrorMeasure("outline", "Pixels on the wrong side of the outline", "pixels")


def disc() -> Flags:
    """Return (48, 48) bool, the pixels whose centres lie in the ball's outline, a circle."""
    y, x = np.mgrid[0:SIDE, 0:SIDE] + 0.5 - SIDE / 2
    inside: Flags = x * x + y * y < RADIUS**2
    return inside


class DicedTask(FrameTask):
    """Balls that are diced into micropolygons at most ``side`` / 16 pixels long."""

    scene: Scene
    stage = "transform"

    def __init__(self, scene: Scene, side: int) -> None:
        super().__init__(scene, 1)
        self.turned = {"curve_tolerance": side}

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return the points that are shaded, the triangles, and the fragments that a pixel has at most."""
        made_scene = before_matrices(self.scene, self.with_dials(settings))
        assert isinstance(made_scene, Scene)
        return {
            "points shaded": sum(len(mesh.positions) for mesh in made_scene.meshes),
            "triangles": made.statistics["transform"].outgoing,
            "longest list": int(made.cover_count.max()),
        }

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Count the pixels that the exact outline decides otherwise."""
        return judged({OUTLINE.name: float(((made.primitive >= 0) != disc()).sum())})

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return the colours, and those of micropolygons half a pixel long."""
        fine = render(self.scene, replace(settings, curve_tolerance=8))
        return color_pictures(made.color, fine.color)


def make_balls(assignment: Assignment) -> DicedTask:
    """Make balls one behind another."""
    return DicedTask(balls(int(assignment.dials["layers"])), int(assignment.dials["side"]))


DICING = StudyFamily(
    "dicing",
    "Split and dice",
    ("tessellation",),
    (
        WorkKind(
            "balls",
            "Balls one behind another",
            "frame",
            (
                Axis(
                    "side",
                    "Side of a micropolygon",
                    "sixteenths of a pixel",
                    (16, 32, 64, 128),
                    default=64,
                    is_cost=True,
                ),
                Axis("layers", "Balls", "", (1, 2, 4), default=1),
            ),
        ),
    ),
    (OUTLINE,),
    make_balls,
    Settings(tessellation="reyes", shading="gouraud"),
    only=("reyes",),
)
