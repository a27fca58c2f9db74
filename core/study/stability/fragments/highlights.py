"""The highlight of a sphere that is lost between its vertices.

References
----------
B. T. Phong, *Illumination for computer generated pictures*, 1975 (why light is not interpolated).
"""

from dataclasses import replace

import numpy as np

from core.scene import Material
from core.settings import Settings
from core.study.exact.sphere import sphere_picture
from core.study.stability.experiment import Verdict
from core.study.stability.fragments.cases import Case, CaseExperiment, Judgement, drawn_colors
from core.study.stability.record import Axis, ExperimentInfo, Outcome
from core.study.workloads import random_source, sphere_scene

SIDE = 96
"""Pixels on a side of the picture."""
SPECULAR = 0.5
TOLERANCE = 0.1
"""The part of the highlight that may be missing."""


class HighlightCase(Case):
    """A sphere of triangles; right is as bright a highlight as the sphere itself has, at its place."""

    def __init__(self, rings: int, shininess: float, seed: int) -> None:
        scene = sphere_scene(rings, SIDE)
        material = Material(ambient=0.12, diffuse=0.4, specular=SPECULAR, shininess=shininess)
        matte = replace(material, specular=0.0)
        # The eye is moved a little, so that no vertex is at the highlight by design.
        shift = random_source(seed).uniform(-0.1, 0.1, 3)
        camera = replace(scene.camera, eye=scene.camera.eye + shift)
        mesh = scene.meshes[0]
        self.scene = replace(scene, camera=camera, meshes=(replace(mesh, material=material),))
        seen, lit = sphere_picture(self.scene, 1.0)
        _, diffuse = sphere_picture(replace(self.scene, meshes=(replace(mesh, material=matte),)), 1.0)
        # All is white: one channel tells.
        self._wanted = lit[..., 0]
        highlight = self._wanted - diffuse[..., 0]
        self._where = seen & (highlight > highlight[seen].max() / 2)

    def judge(self, settings: Settings) -> Judgement:
        """Return which part of the highlight is missing at its brightest pixel."""
        shown = drawn_colors(self.scene, settings)[..., 0]
        missing = max(float(self._wanted[self._where].max() - shown[self._where].max()) / SPECULAR, 0.0)
        remark = f"{100 * missing:.3g} % of the highlight is missing, over {int(self._where.sum())} pixels"
        if missing <= TOLERANCE:
            return Judgement(Verdict(Outcome.RIGHT, missing, remark), np.zeros(self._where.shape, bool))
        dark = self._where & (self._wanted - shown > TOLERANCE * SPECULAR)
        return Judgement(Verdict(Outcome.WRONG_PICTURE, missing, remark), dark)


def make_highlight(place: tuple[float, ...], seed: int) -> HighlightCase:
    """Make the sphere; the seed moves the eye a little."""
    return HighlightCase(int(place[0]), place[1], seed)


HIGHLIGHT = CaseExperiment(
    ExperimentInfo(
        "lost-highlight",
        "Gouraud's lost highlight",
        "A shining sphere of more and more triangles, its highlight smaller and smaller: is the highlight as bright as "
        "that of the sphere itself?",
        (
            Axis("rings", "Rings of the sphere", "", (4, 6, 8, 12, 16, 24, 32, 48), True),
            Axis("shininess", "Shininess", "", (4, 8, 16, 32, 64, 128, 256, 512), True),
        ),
        ("shading=flat", "shading=gouraud", "shading=phong"),
        "Gouraud loses a highlight between its vertices: of shininess 128 and more, most of it on a sphere of 8 "
        "rings in some places; flat shading loses it on all but very fine ones. Phong keeps nine tenths at least "
        "everywhere.",
    ),
    make_highlight,
    "shade",
    bound_to="the sphere that the triangles stand for, and its highlight",
)
