"""Environment maps measured: by how much a look-up is off, for what is near, in texels of the map."""

from dataclasses import replace

import numpy as np

from core.families import mirrors_of
from core.pipeline import render
from core.records.arrays import Floats, Integers
from core.records.frame import Frame
from core.records.primitives import IndexedPrimitives
from core.scene import Camera, DirectionalLight, Material, Mesh, Scene, Texture
from core.settings import Settings
from core.shading.mirror_rays import MirrorRays
from core.stages.environment import environment_passes, mirror_looks
from core.stages.needs import MOST_RAYS
from core.stages.passes import map_camera, planned_passes
from core.study.experiment import Experiment
from core.study.family import Assignment, StudyFamily
from core.study.frame_task import FrameTask, SceneWork, color_pictures
from core.study.record import Axis, ErrorMeasure, Judgement, Outcome, Pictures, Verdict, WorkKind
from core.trace import trace

OFF = ErrorMeasure("off-texels", "Largest error of a look-up", "texels")
DISTANCES = (1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0)
MAP_SIZES = (8.0, 16.0, 32.0, 64.0, 128.0, 256.0)
ENOUGH = 0.5
"""Texels that a look-up may be off."""
SIDE = 24
"""Pixels of the picture each way; all show the mirror."""


def off_angles(scene: Scene, settings: Settings, mesh: Integers, position: Floats, normal: Floats) -> Floats:
    """Return by how many radians the look-ups of points are off, (F,), NaN for those that mirror nothing.

    That is the angle, at the middle of the mirror, between R and what a ray along R really meets; nothing where it
    meets nothing. Arguments as `core.stages.environment.mirror_looks`.
    """
    found = np.full(len(mesh), np.nan)
    rays = replace(settings, environment="rays")
    for chosen, looks in mirror_looks(scene, rays, mesh, position, normal):
        assert isinstance(looks, MirrorRays)
        middle = map_camera(environment_passes(scene, settings, int(mesh[chosen[0]]))[0]).eye
        there = position[chosen] + np.nan_to_num(looks.distance)[:, None] * looks.direction - middle
        sine = np.linalg.norm(np.cross(looks.direction, there), axis=1)
        cosine = (looks.direction * there).sum(axis=1)
        found[chosen] = np.where(looks.met < 0, 0.0, np.arctan2(sine, cosine))
    return found


def in_texels(angle: float, size: int) -> float:
    """Return an angle in radians in texels of a map of ``size`` a side, of which 90 degrees are ``size``."""
    return angle / (np.pi / 2) * size


def largest_error(
    scene: Scene, settings: Settings, primitives: IndexedPrimitives
) -> tuple[float, float] | None:
    """Return the largest error of a look-up at the corners of mirrors, in degrees and texels.

    ``None`` where no map is looked into, or too many rays would be asked.
    """
    if not any(planned.name == "environment" for planned in planned_passes(scene, settings)):
        return None
    of_mirror = np.isin(primitives.mesh, mirrors_of(scene))
    if 3 * np.count_nonzero(of_mirror) * sum(len(mesh.triangles) for mesh in scene.meshes) > MOST_RAYS:
        return None
    at_corners = primitives.varyings[of_mirror].reshape(-1, primitives.varyings.shape[2])
    ends = (at_corners[:, primitives.layout[name]] for name in ("position", "normal"))
    angles = off_angles(scene, settings, np.repeat(primitives.mesh[of_mirror], 3), *ends)
    largest = float(np.nanmax(angles, initial=0.0))
    return float(np.degrees(largest)), in_texels(largest, settings.environment_size)


def facing_wall(distance: float) -> Scene:
    """Return a flat mirror of side 1 and a chequered wall before it, behind the viewer, whose rays are parallel.

    Every pixel sees along the normal, so R is the same everywhere: what is s beside the middle is off by atan(s / d).
    """
    corners = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])
    triangles, half = np.array([[0, 1, 2], [0, 2, 3]]), 4 * distance
    black = Material(0.0, 0.0, 0.0, mirror=1.0)
    colors = np.tile([0.0, 0.0, 0.0, 1.0], (4, 1))
    mirror = Mesh(corners / 2, triangles, np.tile([0.0, 0.0, 1.0], (4, 1)), colors=colors, material=black)
    squares = Texture(np.array([[[0.1], [0.9]], [[0.9], [0.1]]], np.float32))
    wall = Mesh(
        corners * half + [0.0, 0.0, distance],
        triangles[:, ::-1],
        np.tile([0.0, 0.0, -1.0], (4, 1)),
        uvs=(corners[:, :2] + 1) * 4 + 0.25,
        texture=squares,
        material=Material(1.0, 0.0, 0.0),
        name="wall",
    )
    eye = np.array([0.0, 0.0, 0.75])
    camera = Camera(eye, np.zeros(3), projection="orthographic", view_height=1.0, near=0.5, far=1.0)
    meshes = replace(mirror, name="mirror"), wall
    return Scene(meshes, camera, (DirectionalLight(np.array([0.0, 0.0, 1.0])),), (SIDE, SIDE))


class ReflectionTask(FrameTask):
    """A mirror before a wall, whose look-ups are compared with rays."""

    stage = "shade"
    wrong_pixel = SceneWork.wrong_pixel
    """The first look-up that is off, not the first pixel that differs a little from rays."""

    def __init__(self, distance: float, size: int) -> None:
        super().__init__(facing_wall(distance), 1)
        self._size = size
        self.turned = {"environment_size": size}

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return the counts of the frame, and the texels of the map."""
        looks = settings.environment == "cube"
        return {"texels of the map": 6 * self._size**2 if looks else 0, **super().counts(settings, made)}

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Find the largest error of a look-up; rays have none."""
        wrong, off = np.zeros(made.primitive.shape, bool), 0.0
        if settings.environment == "cube":
            source = trace(self.scene, self.with_dials(settings)).source
            layout, values = source.geometry.primitives.layout, source.interpolated[1]
            mesh = source.geometry.primitives.mesh[source.fragments.primitive]
            ends = values[:, layout["position"]], values[:, layout["normal"]]
            angles = off_angles(self.scene, self.with_dials(settings), mesh, *ends)
            off = in_texels(float(np.nanmax(angles)), self._size)
            is_off = in_texels(1.0, self._size) * angles > ENOUGH
            wrong[source.fragments.row[is_off], source.fragments.column[is_off]] = True
        outcome = Outcome.WRONG_PICTURE if off > ENOUGH else Outcome.RIGHT
        said = "each ray meets the wall itself"
        if settings.environment == "cube":
            said = f"look-ups are off by up to {off:.3g} texels"
        return Judgement(Verdict(outcome, off if outcome else 0.0, said), wrong, {OFF.name: off})

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return the colours, and those by rays."""
        return color_pictures(made.color, render(self.scene, replace(settings, environment="rays")).color)


def make_reflection(assignment: Assignment) -> ReflectionTask:
    """Make the picture of a wall so far away, with a map of so many texels."""
    return ReflectionTask(assignment.dials["distance"], int(assignment.dials["map"]))


_DISTANCE = Axis(
    "distance", "Distance of the wall", "sides of the mirror", DISTANCES, True, default=4, is_cost=True
)
_SIZE = Axis("map", "Environment map", "texels on a side", MAP_SIZES, True, default=64)
ENVIRONMENT = StudyFamily(
    "environment",
    "Reflections",
    ("environment",),
    (WorkKind("wall", "A mirror before a wall", "frame", (_DISTANCE, _SIZE)),),
    (OFF,),
    make_reflection,
    only=("cube", "rays"),
)
NEAR = Experiment(
    "near-reflection",
    "A wall mirrored by a map",
    "A mirror of side 1 faces a wall. Does its environment map show what is really there, to half a texel?",
    (_DISTANCE, _SIZE),
    ("environment=cube", "environment=rays"),
    "A map is off by atan(s/d), d the distance and s up to 0.7: right where that is half a texel at most. Twice the "
    "texels need twice the distance. Rays are right everywhere.",
    lambda place, _: ReflectionTask(place[0], int(place[1])),
)
