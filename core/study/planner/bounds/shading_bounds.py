"""How far light that is evaluated at vertices, faces or nowhere is from Phong's.

**Gouraud.** What is interpolated between vertices differs from what is lit by the curvature of the light over the
triangle, see ``light_changes``; and by no more than light differs there.

**Flat.** The normal of a face and the interpolated one are no farther apart than the face's is from the corners'.

A triangle that is cut is lit at its own corners and its own middle, though they may be out of view.

References
----------
H. Gouraud, *Continuous shading of curved surfaces*, 1971.
T. Bishop, D. Weimer, *Fast Phong shading*, 1986.
"""

import numpy as np

from core.geometry.vertex_stage import unit
from core.records.arrays import Floats
from core.scene import DirectionalLight, Scene
from core.study.planner.bounds.light_changes import LightError, bent_light_error
from core.study.planner.bounds.light_ranges import LightRange, cones, light_range
from core.study.planner.bounds.lit_patches import LitPatches, lit_primitives, lit_triangles, normals_of_faces
from core.study.planner.scene_analysis.conservative_coverage import Touched


def shading_error(touched: Touched, scene: Scene, name: str) -> LightError:
    """Return how far the light of a shading is from that of Phong's."""
    if name == "unlit":
        spread = light_of(lit_primitives(touched, scene), scene)
        away = np.maximum(np.abs(spread.diffuse_low - 1), np.abs(spread.diffuse_high - 1))
        return LightError(away, spread.specular_high)
    patches = lit_triangles(touched, scene)
    if name == "flat":
        diffuse, specular = spread_of(patches, scene, with_faces=True)
        return LightError(np.minimum(_flat_error(patches, scene), diffuse), specular)
    diffuse, specular = spread_of(patches, scene)
    bent = bent_light_error(patches, scene)
    return LightError(np.minimum(bent.diffuse, diffuse), np.minimum(bent.specular, specular))


def _flat_error(patches: LitPatches, scene: Scene) -> Floats:
    """Return the error of the diffuse light (P, 3): the chord from the face's normal to those of the corners."""
    face = normals_of_faces(patches)
    chord = np.max([np.linalg.norm(each - face, axis=1) for each in patches.normal], axis=0)
    error = np.zeros((len(chord), 3))
    for _, radius, color in _lights(patches, scene):
        error += (chord + 2 * radius)[:, None] * color
    is_wide = ~(chord < np.sqrt(2.0))
    return np.asarray(np.where(is_wide[:, None], np.inf, patches.material.diffuse[:, None] * error))


def _lights(patches: LitPatches, scene: Scene) -> list[tuple[Floats, Floats, Floats]]:
    """Return for every light the middle direction to it (P, 3), the radius of its cone (P,), and its colour (3,)."""
    found = []
    for light in scene.lights:
        if isinstance(light, DirectionalLight):
            towards = np.broadcast_to(unit(-light.direction), patches.position[0].shape)
            radius = np.zeros(len(towards))
        else:
            cone = cones(light.position - patches.position)
            towards, radius = cone.axis, cone.radius
        found.append((towards, radius, np.maximum(light.color, 0)))
    return found


def spread_of(patches: LitPatches, scene: Scene, with_faces: bool = False) -> tuple[Floats, Floats]:
    """Return how far apart the diffuse and the specular light over patches can be, (P, 3) each."""
    light = light_of(patches, scene, with_faces)
    return light.diffuse_high - light.diffuse_low, light.specular_high - light.specular_low


def light_of(patches: LitPatches, scene: Scene, with_faces: bool = False) -> LightRange:
    """Return the range of the light over patches (P, 3), ``with_faces`` at their middle too."""
    position, normal, to_eye = patches.position, patches.normal, patches.to_eye
    if with_faces:
        position, to_eye = (np.concatenate([each, each.mean(axis=0)[None]]) for each in (position, to_eye))
        normal = np.concatenate([normal, normals_of_faces(patches)[None]])
    with np.errstate(invalid="ignore"):
        return light_range(normal, position, to_eye, scene.lights, patches.material, patches.below_zero)
