"""The highlight of a sphere that is lost between its vertices.

References
----------
B. T. Phong, *Illumination for computer generated pictures*, 1975 (why light is not interpolated).
"""

from dataclasses import replace

import numpy as np

from core.records.arrays import Flags, Floats
from core.records.frame import Frame
from core.scene import Material, Scene
from core.settings import Settings
from core.study.accuracy.record import Axis, Judgement, Outcome, Verdict
from core.study.accuracy.workloads import random_source, sphere_scene
from core.study.exact.sphere import sphere_picture
from core.study.stability.experiment import Case, Experiment
from core.study.stability.fragments.cases import faces_the_eye, mesh_and_normals
from core.study.stability.kinds import LIT_MESHES

SIDE = 96
"""Pixels on a side of the picture."""
TOLERANCE = 0.1
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
        if missing <= TOLERANCE:
            return Judgement(Verdict(Outcome.RIGHT, missing, remark), np.zeros(where.shape, bool))
        dark = where & (self._wanted - shown > TOLERANCE * self._specular)
        return Judgement(Verdict(Outcome.WRONG_PICTURE, missing, remark), dark)

    def assertions(self, settings: Settings, made: Frame, wrong: Flags) -> str:
        """Return statements that a pixel on the highlight, ``wrong`` (H, W) or not, is as bright as the sphere."""
        del wrong
        _, where = self._shown_and_where(made)
        least = float(self._wanted[where].max()) - TOLERANCE * self._specular
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
