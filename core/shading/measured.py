"""Shading measured: a sphere without triangles, its highlight between vertices, normals between opposite ones.

References
----------
T. Whitted, *An improved illumination model for shaded display*, 1980 (ray and sphere).

References
----------
B. T. Phong, *Illumination for computer generated pictures*, 1975 (why light is not interpolated).

References
----------
B. T. Phong, *Illumination for computer generated pictures*, 1975 (normals are interpolated, and made unit).
K. Shoemake, *Animating rotation with quaternion curves*, 1985 (turning evenly along the arc).
"""

from dataclasses import replace

import numpy as np

from core.interpolation.measured import exact_values
from core.records.arrays import Flags, Floats, Integers
from core.records.frame import Frame
from core.scene import Camera, DirectionalLight, Material, Mesh, Scene
from core.settings import Settings
from core.shading.lighting import light_surface
from core.stages.vertex_light import viewpoint
from core.study.case_text import pixels_text
from core.study.experiment import LIT_MESHES, Case, Experiment
from core.study.fragment_cases import clip_corners, faces_the_eye, mesh_and_normals
from core.study.frame_task import judge_colors
from core.study.record import Axis, Judgement, Outcome, Verdict
from core.study.workloads import random_source, sphere_scene, strip_triangles
from core.transform.matrices import camera_axes

# A lit sphere without triangles: every pixel's ray meets the sphere itself, and the point is lit with its
# own normal.


def pixel_rays(camera: Camera, size: tuple[int, int]) -> Floats:
    """Return the directions (H, W, 3) from the eye of a perspective camera through the pixel centres, not unit."""
    width, height = size
    right, up, backward = camera_axes(camera)
    reach = np.tan(camera.field_of_view / 2)
    x = ((np.arange(width) + 0.5) * 2 / width - 1) * reach * width / height
    y = ((np.arange(height) + 0.5) * 2 / height - 1) * reach
    return np.asarray(x[None, :, None] * right + y[:, None, None] * up - backward)


def meet_sphere(eye: Floats, direction: Floats, radius: float) -> tuple[Flags, Floats]:
    """Return where rays meet a sphere around the origin first.

    Parameters
    ----------
    eye : (3,) float64
    direction : (H, W, 3) float64

    Returns
    -------
    meets : (H, W) bool
    position : (H, W, 3) float64, NaN where it is missed
    """
    a = (direction * direction).sum(axis=2)
    half_b = (direction * eye).sum(axis=2)
    inside = half_b * half_b - a * (float(eye @ eye) - radius * radius)
    meets = inside > 0
    distance = (-half_b - np.sqrt(np.where(meets, inside, np.nan))) / a
    return meets, eye + distance[..., None] * direction


def sphere_picture(scene: Scene, radius: float) -> tuple[Flags, Floats]:
    """Return where a sphere around the origin is seen, (H, W) bool, and its colours (H, W, 4) float64.

    Parameters
    ----------
    scene : Scene
        Its camera (perspective), lights, and the material of its first mesh; the surface is white.
    """
    meets, position = meet_sphere(scene.camera.eye, pixel_rays(scene.camera, scene.size), radius)
    seen = position[meets]
    diffuse, specular = light_surface(
        seen, seen / radius, scene.camera.eye, scene.lights, scene.meshes[0].material, False
    )
    color = np.empty((*meets.shape, 4))
    color[:] = scene.background
    color[meets] = np.column_stack([diffuse + specular, np.ones(len(seen))])
    return meets, color


# The highlight of a sphere that is lost between its vertices.


SIDE = 96
"""Pixels on a side of the picture."""
HIGHLIGHT_TOLERANCE = 0.1
"""The part of the highlight that may be missing."""
SLACK = 1 / 16
"""How far a corner may lie off the sphere: its normal is still that of the sphere in its direction."""


class HighlightCase(Case):
    """Triangles with corners on a sphere; right is as bright a highlight as the sphere itself has where they are seen.

    Raises ValueError if the mesh is no part of the sphere of radius 1 around the origin.
    """

    scene: Scene
    stage = "shade"

    def __init__(self, scene: Scene) -> None:
        mesh, normals = mesh_and_normals(scene)
        away = np.abs(np.linalg.norm(mesh.positions, axis=1) - 1)
        if not np.array_equal(mesh.positions, normals) or away.max() > SLACK:
            raise ValueError(
                f"the corners must lie on the sphere of radius 1, got one {away.max():.3g} off it"
            )
        if mesh.material.specular == 0:
            raise ValueError("the sphere must shine, got one without a highlight")
        super().__init__(scene)
        self._specular = mesh.material.specular
        self._is_front = faces_the_eye(scene)
        matte = replace(mesh, material=replace(mesh.material, specular=0.0))
        seen, lit = sphere_picture(scene, 1.0)
        _, diffuse = sphere_picture(replace(scene, meshes=(matte,)), 1.0)
        # All is white: one channel tells.
        self._wanted = lit[..., 0]
        highlight = self._wanted - diffuse[..., 0]
        self._where = seen & (highlight > highlight[seen].max(initial=0.0) / 2)

    def _shown_and_where(self, frame: Frame) -> tuple[Floats, Flags]:
        """Return what is drawn, (H, W) float64, and where it should be bright, (H, W) bool."""
        is_front = (frame.primitive >= 0) & self._is_front[np.maximum(frame.primitive, 0)]
        where = np.asarray(self._where & is_front)
        if not where.any():
            raise ValueError("the highlight must be seen on a triangle, got triangles beside it")
        return frame.color[..., 0].astype(np.float64), where

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Return which part of the highlight is missing at its brightest pixel."""
        shown, where = self._shown_and_where(made)
        missing = max(float(self._wanted[where].max() - shown[where].max()) / self._specular, 0.0)
        remark = f"{100 * missing:.3g} % of the highlight is missing, over {int(where.sum())} pixels"
        if missing <= HIGHLIGHT_TOLERANCE:
            return Judgement(Verdict(Outcome.RIGHT, missing, remark), np.zeros(where.shape, bool))
        dark = where & (self._wanted - shown > HIGHLIGHT_TOLERANCE * self._specular)
        return Judgement(Verdict(Outcome.WRONG_PICTURE, missing, remark), dark)

    def assertions(self, settings: Settings, made: Frame, wrong: Flags) -> str:
        """Return statements that a pixel on the highlight, ``wrong`` (H, W) or not, is as bright as the sphere."""
        del wrong
        _, where = self._shown_and_where(made)
        least = float(self._wanted[where].max()) - HIGHLIGHT_TOLERANCE * self._specular
        rows, columns = np.nonzero(where)
        pixels = list(zip(columns.tolist(), rows.tolist(), strict=True))
        return (
            f"pixels = {pixels}\nassert max(frame.color[row, column, 0] for column, row in pixels) >= {least}"
        )


def highlight_case(scene: Scene) -> HighlightCase:
    """Return what is right for part of a sphere, of which so much has to be left that light per pixel keeps it.

    Raises ValueError if Phong loses the highlight too: then the triangles are too coarse for the sphere where they are
    looked at.
    """
    case = HighlightCase(scene)
    if case.run(Settings(shading="phong")).verdict.outcome != Outcome.RIGHT:
        raise ValueError("the triangles must be fine enough for light per pixel, got coarser ones")
    return case


def shining_sphere(rings: int, shininess: float, seed: int) -> Scene:
    """Return a white sphere, shining; the eye is moved a little, so that no vertex is at the highlight by design."""
    scene = sphere_scene(rings, SIDE)
    material = Material(ambient=0.12, diffuse=0.4, specular=0.5, shininess=shininess)
    shift = random_source(seed).uniform(-0.1, 0.1, 3)
    camera = replace(scene.camera, eye=scene.camera.eye + shift)
    return replace(scene, camera=camera, meshes=(replace(scene.meshes[0], material=material),))


HIGHLIGHT = Experiment(
    "lost-highlight",
    "Gouraud's lost highlight",
    "A shining sphere has more and more triangles and a smaller and smaller highlight. Is the highlight as "
    "bright as that of the true sphere?",
    (
        Axis("rings", "Rings of the sphere", "", (4, 6, 8, 12, 16, 24, 32, 48), True),
        Axis("shininess", "Shininess", "", (4, 8, 16, 32, 64, 128, 256, 512), True),
    ),
    ("shading=flat", "shading=gouraud", "shading=phong"),
    "Gouraud loses highlights between vertices: for shininess 128 and more it loses most of one on a sphere "
    "of 8 rings in some places. Flat shading loses it on all but very fine spheres. Phong keeps at least nine"
    " tenths everywhere.",
    lambda place, seed: HighlightCase(shining_sphere(int(place[0]), place[1], seed)),
    highlight_case,
    kind=LIT_MESHES,
)


# Normals between opposite ones: what is interpolated is 0 in the middle, and has no direction.


SIZE = (65, 3)
"""An odd number of columns: the centre of the middle one is where opposite normals interpolate to 0."""
MATERIAL = Material(ambient=0.1, diffuse=0.8, specular=0.0, shininess=1.0)
NORMAL_TOLERANCE = 8.0
"""Largest colour error, in 1/255, that is taken as right."""
LIGHT = DirectionalLight(np.array([0.3, -0.2, -1.0]))


class NormalsCase(Case):
    """Triangles whose normals are turned about the upright; right is light on normals that turn evenly between them.

    Raises ValueError if a normal is not level, or leads away from the eye, or a triangle is seen from behind.
    """

    scene: Scene
    stage = "shade"

    def __init__(self, scene: Scene) -> None:
        super().__init__(scene)
        self._mesh, normals = mesh_and_normals(scene)
        if normals[:, 1].any() or (normals[:, 2] < 0).any() or not normals.any(axis=1).all():
            raise ValueError("every normal must be turned from the front about the upright, got another one")
        if scene.camera.projection != "orthographic" or not faces_the_eye(scene).all():
            raise ValueError("every triangle must be seen from the front, by parallel rays, got another one")
        self._turn = np.arctan2(normals[:, 0], normals[:, 2])

    def _shown_and_wanted(self, frame: Frame) -> tuple[Floats, Floats]:
        """Return the colours as drawn and as they should be, (H, W, 3) each; the same where nothing is drawn."""
        shown = frame.color[..., :3].astype(np.float64)
        wanted = shown.copy()
        for triangle in np.unique(frame.primitive[frame.primitive >= 0]).tolist():
            row, column = np.nonzero(frame.primitive == triangle)
            wanted[row, column] = self._evenly_lit(triangle, column, row)
        return shown, wanted

    def _evenly_lit(self, triangle: int, column: Integers, row: Integers) -> Floats:
        """Return the colours (F, 3) of pixels (F,) of a triangle, if its normals turn evenly."""
        vertices = self._mesh.triangles[triangle]
        given = np.column_stack([self._turn[vertices], self._mesh.positions[vertices]])
        values = exact_values(clip_corners(self.scene)[triangle], given, self.scene.size, column, row)
        turn, position = values[:, 0], values[:, 1:]
        normal = np.stack([np.sin(turn), np.zeros(len(turn)), np.cos(turn)], axis=1)
        seen_from = viewpoint(self.scene.camera, position)
        diffuse, specular = light_surface(
            position, normal, seen_from, self.scene.lights, self._mesh.material, False
        )
        return diffuse + specular

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Compare the colours with those of normals that turn evenly."""
        return judge_colors(*self._shown_and_wanted(made), NORMAL_TOLERANCE)

    def assertions(self, settings: Settings, made: Frame, wrong: Flags) -> str:
        """Return statements that ``wrong`` pixels, (H, W) bool, are lit as by normals that turn evenly."""
        _, wanted = self._shown_and_wanted(made)
        return pixels_text(
            wrong, wanted, f"255 * np.abs(frame.color[row, column, :3] - wanted).max() <= {NORMAL_TOLERANCE}"
        )


def flattened_tube(angle: float, parts: int) -> Scene:
    """Return a flat strip that is lit like half a tube: its normals turn evenly, by ``angle`` degrees in all."""
    width, height = SIZE
    aspect = width / height
    x = np.linspace(-aspect, aspect, parts + 1)
    positions = np.array([[at, y, 0.0] for at in x for y in (-1.0, 1.0)])
    normals = np.repeat(turned_normals(np.linspace(0, 1, parts + 1), angle), 2, axis=0)
    mesh = Mesh(positions, strip_triangles(parts), normals, material=MATERIAL, name="half a tube, flattened")
    camera = Camera(
        np.array([0.0, 0.0, 1.0]), np.zeros(3), projection="orthographic", view_height=2.0, near=0.5, far=2.0
    )
    return Scene((mesh,), camera, (LIGHT,), SIZE)


def turned_normals(part: Floats, angle: float) -> Floats:
    """Return unit normals (N, 3) at parts (N,) of the way, turned by ``angle`` degrees about the upright in all."""
    turn = np.radians(angle) * (part - 0.5)
    across = np.cos(turn)
    # A quarter turn to either side is exactly opposite: the cosine of the rounded angle is not quite 0.
    across[np.abs(across) < 1e-15] = 0.0
    return np.stack([np.sin(turn), np.zeros(len(part)), across], axis=1)


NORMALS = Experiment(
    "opposite-normals",
    "Normals that interpolate to zero",
    "The normals at the two ends of a strip point away from each other, up to opposite directions. Which "
    "colour lies between them, and does dividing the strip help?",
    (
        Axis("angle", "Angle between the normals", "degrees", (0, 30, 60, 90, 120, 150, 170, 179, 180)),
        Axis("parts", "Parts of the strip", "", (1, 2, 3, 4, 6, 8, 16, 32), True),
    ),
    ("shading=flat", "shading=gouraud", "shading=phong"),
    "Nothing becomes NaN. Where opposite normals meet, the interpolated normal has no direction, and Phong "
    "and Gouraud draw a wrong picture. Divided into three parts or more, Phong is right at every angle. "
    "Gouraud needs sixteen.",
    lambda place, _: flattened_tube(place[0], int(place[1])),
    NormalsCase,
    kind=LIT_MESHES,
)
