"""Light tried out where bounds say little: both ways of lighting are evaluated, sample by sample, in a few pixels.

Bounds over whole triangles are wide where normals nearly cancel, and of slivers, which snapping lets reach far beyond
their corners. These are a few pixels as a rule, at the outlines. There the weights of the corners are computed at every
sample that a triangle may cover, and light by the right way and by the cheaper one: that is exact but for rounding.
"""

from collections.abc import Callable

import numpy as np

from core.fragments.lighting import Reflectance, light_surface
from core.records.arrays import Floats, Integers
from core.scene import Scene
from core.stages.vertex_light import viewpoint
from core.study.planner.bounds.bytes import times
from core.study.planner.bounds.color_ranges import ColorRanges
from core.study.planner.bounds.light_changes import LightError
from core.study.planner.bounds.lit_patches import LitPatches, lit_primitives, normals_of_faces
from core.study.planner.scene_analysis.conservative_coverage import Touched, is_cut
from core.study.planner.scene_analysis.per_sample_check import sample_pairs
from core.study.planner.scene_analysis.sample_patterns import Pattern

MOST = 2048
"""Pairs that are looked at sample by sample: those of the largest bounds."""
Light = tuple[Floats, Floats]
"""Diffuse and specular light (R, 3) float64 linear each."""
Way = Callable[[Scene, LitPatches, Floats, Floats], Light]
"""A way to light R places, from the perspective and the affine weights (3, R) of the corners."""


def tried_error(
    error: Floats, touched: Touched, colors: ColorRanges, scene: Scene, pattern: Pattern, name: str
) -> Floats:
    """Return bounds (Q, 3) of linear light, made tighter where they are the largest.

    Parameters
    ----------
    error : (Q, 3) float64
        Bounds that hold.
    touched : Touched
    colors : ColorRanges
    scene : Scene
    pattern : Pattern
        The samples; where these take their colours from elsewhere, nothing is tried.
    name : str
        Of the cheaper way, as in `WAYS`.
    """
    if not pattern.stays_inside:
        return error
    # A piece of a triangle has not the triangle's corners.
    is_open = ~is_cut(touched)[touched.primitive] & error.any(axis=1)
    largest = np.where(is_open, error.max(axis=1, initial=0.0), -1.0)
    index = np.sort(np.argsort(-largest, kind="stable")[:MOST])
    index = index[is_open[index]]
    light = light_error_at_samples(touched, scene, index, pattern, name)
    tighter = error.copy()
    tighter[index] = np.minimum(error[index], times(colors.albedo[index], light.diffuse) + light.specular)
    return tighter


def light_error_at_samples(
    touched: Touched, scene: Scene, index: Integers, pattern: Pattern, name: str
) -> LightError:
    """Return how far light is off at the samples that the pairs ``index`` (R,) may cover, (R, 3) each."""
    patches = lit_primitives(touched, scene).take(touched.primitive[index])
    diffuse, specular = np.zeros((2, len(index), 3))
    places = pattern.positions - 0.5
    for (_, may_cover, _), place in zip(sample_pairs(touched, index, pattern), places, strict=True):
        weights = _weights(touched, index, place)
        right, cheaper = interpolated(scene, patches, *weights), WAYS[name](scene, patches, *weights)
        for most, first, second in zip((diffuse, specular), right, cheaper, strict=True):
            apart = np.nan_to_num(np.abs(first - second), nan=np.inf)
            np.maximum(most, np.where(may_cover[:, None], apart, 0.0), out=most)
    return LightError(diffuse, specular)


def _weights(touched: Touched, index: Integers, place: Floats) -> tuple[Floats, Floats]:
    """Return the perspective and the affine weights (3, R) of corners at a ``place`` (2,) from the pixels' centres."""
    primitive = touched.primitive[index]
    corner = touched.geometry.corners.window[primitive]
    x = corner[..., 0].T - (touched.x[index] + place[0])
    y = corner[..., 1].T - (touched.y[index] + place[1])
    area = np.stack([x[k - 2] * y[k - 1] - x[k - 1] * y[k - 2] for k in range(3)])
    with np.errstate(divide="ignore", invalid="ignore"):
        near = area / touched.geometry.primitives.clip[primitive, :, 3].T
        return near / near.sum(axis=0), area / area.sum(axis=0)


def interpolated(scene: Scene, patches: LitPatches, weights: Floats, _affine: Floats) -> Light:
    """Light places by the normals that are interpolated there, by the ``weights`` (3, R) of the corners."""
    mixed = ((weights[..., None] * each).sum(axis=0) for each in (patches.position, patches.normal))
    return _light(scene, patches, *mixed)


def interpolated_affinely(scene: Scene, patches: LitPatches, _weights: Floats, affine: Floats) -> Light:
    """Light places by normals and positions that are interpolated in the window, by ``affine`` weights (3, R)."""
    return interpolated(scene, patches, affine, affine)


def at_vertices(scene: Scene, patches: LitPatches, weights: Floats, _affine: Floats) -> Light:
    """Light the corners and interpolate the light by the ``weights`` (3, R)."""
    corners = [
        _light(scene, patches, position, normal)
        for position, normal in zip(patches.position, patches.normal, strict=True)
    ]
    diffuse, specular = (
        sum(weight[:, None] * each for weight, each in zip(weights, lights, strict=True))
        for lights in zip(*corners, strict=True)
    )
    return np.asarray(diffuse), np.asarray(specular)


def at_faces(scene: Scene, patches: LitPatches, _weights: Floats, _affine: Floats) -> Light:
    """Light the middle of each face by its own normal, whatever the weights (3, R)."""
    return _light(scene, patches, patches.position.mean(axis=0), normals_of_faces(patches))


def _light(scene: Scene, patches: LitPatches, position: Floats, normal: Floats) -> Light:
    of = patches.material
    material = Reflectance(of.ambient, of.diffuse, of.specular, of.shininess)
    eye = viewpoint(scene.camera, position)
    return light_surface(position, normal, eye, scene.lights, material, two_sided=False)


WAYS: dict[str, Way] = {"affine": interpolated_affinely, "gouraud": at_vertices, "flat": at_faces}
"""Cheaper ways, by the name of the interpolation or the shading."""
