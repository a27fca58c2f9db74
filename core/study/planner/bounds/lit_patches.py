"""What light is evaluated on: the corners of primitives, or of the whole triangles that they are pieces of."""

from dataclasses import dataclass, fields

import numpy as np

from core.fragments.lighting import planes
from core.fragments.shading import face_normals
from core.geometry.vertex_stage import unit
from core.records.arrays import Floats, Integers
from core.scene import Scene
from core.stages.vertex_light import viewpoint
from core.study.planner.bounds.color_ranges import MOST_WEIGHT, materials, weights_below_zero
from core.study.planner.bounds.light_ranges import Reflectances
from core.study.planner.scene_analysis.conservative_coverage import Touched


@dataclass(frozen=True, eq=False)
class LitPatches:
    """P patches, one for each primitive of a look."""

    position: Floats
    """(3, P, 3) float64, world space."""
    normal: Floats
    """(3, P, 3) float64, world space, as interpolated."""
    to_eye: Floats
    """(3, P, 3) float64, world space, of any length."""
    material: Reflectances
    below_zero: Floats
    """(P,) float64, how far below 0 weights of the corners can be; infinite: not known."""

    def take(self, index: Integers) -> "LitPatches":
        """Return the patches ``index`` (R,)."""
        return LitPatches(
            self.position.take(index, axis=1),
            self.normal.take(index, axis=1),
            self.to_eye.take(index, axis=1),
            Reflectances(
                *(getattr(self.material, field.name).take(index) for field in fields(self.material))
            ),
            self.below_zero.take(index),
        )


def lit_primitives(touched: Touched, scene: Scene) -> LitPatches:
    """Return the primitives themselves: over these perspective and affine interpolation differ."""
    weight = weights_below_zero(touched)
    return _patches(touched, scene, touched.geometry.primitives.varyings, weight)


def lit_triangles(touched: Touched, scene: Scene) -> LitPatches:
    """Return for every primitive the triangle that it is a piece of: vertices and faces are lit there.

    Notes
    -----
    Light of the vertices goes through clipping as any attribute does, so within a piece it is the triangle's. With
    weights of the piece's corners no less than -t, those of the triangle's are no less than -2 t.
    """
    geometry = touched.geometry
    row = np.zeros(int(geometry.kept.triangle.max(initial=-1)) + 1, np.int64)
    row[geometry.kept.triangle] = np.arange(len(geometry.kept))
    varyings = geometry.kept.varyings.take(row[geometry.primitives.triangle], axis=0)
    return _patches(touched, scene, varyings, 2 * weights_below_zero(touched))


def _patches(touched: Touched, scene: Scene, varyings: Floats, weight: Floats) -> LitPatches:
    layout = touched.geometry.primitives.layout
    position, normal = (varyings[..., layout[name]].swapaxes(0, 1) for name in ("position", "normal"))
    to_eye = viewpoint(scene.camera, position.reshape(-1, 3)) - position.reshape(-1, 3)
    material = materials(scene, touched.geometry.primitives.mesh)
    below_zero = np.where(weight <= MOST_WEIGHT, weight, np.inf)
    return LitPatches(position, normal, to_eye.reshape(position.shape), material, below_zero)


def normals_of_faces(patches: LitPatches) -> Floats:
    """Return the unit normals of the faces (P, 3), on the side of those of the corners."""
    count = patches.position.shape[1]
    corners = np.arange(3 * count).reshape(3, count).T
    face = unit(face_normals(patches.position.reshape(-1, 3), corners))
    x, y, z = planes(face * patches.normal.sum(axis=0))
    return np.asarray(np.where((x + y + z < 0)[:, None], -face, face))
