"""How far light is off where what it is made of is interpolated in a cheaper way.

Light of vertices is a value like any other. Light of interpolated normals is off by less than its slope times what the
normals and the ways to the lights and the eye turn by, see ``light_changes``. That says little where normals nearly
cancel, and of slivers, which snapping lets reach far beyond their corners: a few pixels as a rule, in which affine
interpolation and the right one are both evaluated, sample by sample.
"""

from collections.abc import Iterator

import numpy as np

from core.arrays import Floats, Integers
from core.fragments.lighting import Reflectance, light_surface
from core.scene import Scene
from core.study.planner.bytes import times
from core.study.planner.closer import sample_pairs
from core.study.planner.light_changes import moved_light_error
from core.study.planner.lit_patches import lit_primitives, lit_triangles
from core.study.planner.patterns import Pattern
from core.study.planner.shading_bounds import spread_of
from core.study.planner.touched import Touched
from core.surface import viewpoint

MOST_CLOSER = 2048
"""Pairs that are looked at sample by sample: those of the largest bounds."""

Light = tuple[Floats, Floats]
"""Diffuse and specular light, or how far they are off, (Q, 3) float64 linear each."""


def interpolated_light_error(
    touched: Touched, scene: Scene, share: Floats, shading: str, pattern: Pattern | None
) -> Light:
    """Return how far diffuse and specular light are off.

    Parameters
    ----------
    touched : Touched
    scene : Scene
    share : (P,) float64
        By what part of their range attributes are off; infinite: by anything.
    shading : str
    pattern : Pattern, optional
        The samples at which affine interpolation may be evaluated; ``None``: it is another, or is off elsewhere too.
    """
    primitive = touched.primitive
    if shading == "flat":
        nothing = np.zeros((len(primitive), 3))
        return nothing, nothing
    if shading == "gouraud":
        diffuse, specular = spread_of(lit_triangles(touched, scene), scene)
        return times(share[:, None], diffuse)[primitive], times(share[:, None], specular)[primitive]
    patches = lit_primitives(touched, scene)
    moved, whole = moved_light_error(patches, scene, share), spread_of(patches, scene)
    # Places that are off by nothing are lit alike; those that are off by anything are still in the triangle.
    error = [
        np.where((share > 0)[:, None], np.minimum(*each), 0.0)[primitive]
        for each in zip((moved.diffuse, moved.specular), whole, strict=True)
    ]
    is_off = np.isinf(share)[primitive]
    for each in error:
        each[is_off] = np.inf
    if pattern is not None:
        largest = np.where(is_off, 0.0, (error[0] + error[1]).max(axis=1, initial=0.0))
        index = np.sort(np.argsort(-largest, kind="stable")[:MOST_CLOSER])
        for each, closer in zip(error, affine_light_error(touched, scene, index, pattern), strict=True):
            each[index] = np.minimum(each[index], np.where(is_off[index, None], np.inf, closer))
    return error[0], error[1]


def affine_light_error(touched: Touched, scene: Scene, index: Integers, pattern: Pattern) -> Light:
    """Return how far light is off at the samples that the pairs ``index`` (R,) may cover, with affine interpolation."""
    found = np.zeros((2, len(index), 3))
    places = pattern.positions - 0.5
    for (_, may_cover, _), place in zip(sample_pairs(touched, index, pattern), places, strict=True):
        right, affine = (
            _light_at(touched, scene, index, weights) for weights in _weights(touched, index, place)
        )
        apart = np.abs(np.stack(right) - np.stack(affine))
        found = np.maximum(found, np.where(may_cover[:, None], np.nan_to_num(apart, nan=np.inf), 0.0))
    return found[0], found[1]


def _weights(touched: Touched, index: Integers, place: Floats) -> Iterator[Floats]:
    """Yield the perspective and the affine weights (3, R) of the corners at a ``place`` (2,) from pixels' centres."""
    primitive = touched.primitive[index]
    corner = touched.geometry.corners.window[primitive]
    x = corner[..., 0].T - (touched.x[index] + place[0])
    y = corner[..., 1].T - (touched.y[index] + place[1])
    area = np.stack([x[k - 2] * y[k - 1] - x[k - 1] * y[k - 2] for k in range(3)])
    near = area / touched.geometry.primitives.clip[primitive, :, 3].T
    with np.errstate(divide="ignore", invalid="ignore"):
        yield near / near.sum(axis=0)
        yield area / area.sum(axis=0)


def _light_at(touched: Touched, scene: Scene, index: Integers, weights: Floats) -> Light:
    """Return the light where the corners of the pairs (R,) have ``weights`` (3, R)."""
    patches = lit_primitives(touched, scene).take(touched.primitive[index])
    position, normal = (
        (weights[..., None] * each).sum(axis=0) for each in (patches.position, patches.normal)
    )
    of = patches.material
    material = Reflectance(of.ambient, of.diffuse, of.specular, of.shininess)
    eye = viewpoint(scene.camera, position)
    return light_surface(position, normal, eye, scene.lights, material, two_sided=False)
