"""How dark and how bright the light on a patch of surface can be: angles between cones.

Directions over a patch (normals, to the light, to the eye) are mixtures of those at a few corners, so they lie in the
cone around their mean direction that holds the corners: a cone of less than 90 degrees is convex. Two directions from
cones of radius r and s whose axes are at an angle t are at an angle from t - r - s to t + r + s, and the cosine and its
powers fall as the angle grows. The halfway vector L + V moves by no more than L and V together.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from core.geometry.vertex_stage import unit
from core.records.arrays import Floats, Integers
from core.scene import DirectionalLight, Light

HAIR = 1e-12
"""Radians that rounding may move an angle by."""


@dataclass(frozen=True, eq=False)
class Cones:
    """A cone for each of Q patches."""

    axis: Floats
    """(Q, 3) float64 unit."""
    radius: Floats
    """(Q,) float64 radians; pi: any direction."""


@dataclass(frozen=True, eq=False)
class LightRange:
    """Least and largest light of Q patches, (Q, 3) float64 linear each."""

    diffuse_low: Floats
    diffuse_high: Floats
    specular_low: Floats
    specular_high: Floats

    def take(self, index: Integers) -> "LightRange":
        """Return the light of the patches ``index`` (R,)."""
        return LightRange(*(getattr(self, field.name).take(index, axis=0) for field in fields(self)))


@dataclass(frozen=True, eq=False)
class Reflectances:
    """Materials of Q patches, (Q,) float64 each."""

    ambient: Floats
    diffuse: Floats
    specular: Floats
    shininess: Floats


def cones(directions: Floats, below_zero: Floats | float = 0.0) -> Cones:
    """Return the cones that hold all mixtures of directions.

    Parameters
    ----------
    directions : (H, Q, 3) float64
        At H corners, of any length.
    below_zero : (Q,) float64 or float
        How far below 0 weights of the mixture can be.

    Notes
    -----
    With the chord c from the axis to the farthest corner and weights that go t below 0, the part across the axis is at
    most (1 + 4 t) c times the greatest length, that along it at least the least length less 2 t of their spread.
    """
    lengths = np.linalg.norm(directions, axis=2)
    units = unit(directions)
    axis = unit(units.mean(axis=0))
    radius = 2 * np.arcsin(np.minimum(np.linalg.norm(units - axis, axis=2).max(axis=0) / 2, 1.0))
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        least, most = lengths.min(axis=0), lengths.max(axis=0)
        along = least - 2 * below_zero * (most - least)
        across = 2 * np.sin(radius / 2) * (1 + 4 * below_zero) * most
        share = np.where(along > 0, across / along, np.inf)
        beyond = np.where(share < 1, np.arcsin(np.minimum(share, 1.0)), np.pi)
    radius = np.where(np.asarray(below_zero) > 0, beyond, radius)
    is_lost = ~(radius < np.pi / 2) | ~np.any(axis != 0, axis=1)
    is_lost |= ~np.all(np.any(units != 0, axis=2), axis=0)
    return Cones(np.nan_to_num(axis), np.where(is_lost, np.pi, radius))


def angle(first: Floats, second: Floats) -> Floats:
    """Return the angles (Q,) between unit vectors (Q, 3), accurate for small ones too."""
    return np.asarray(
        2
        * np.arctan2(
            np.linalg.norm(first - second, axis=-1),
            np.maximum(np.linalg.norm(first + second, axis=-1), 1e-300),
        )
    )


def light_range(
    normals: Floats,
    positions: Floats,
    to_eye: Floats,
    lights: Sequence[Light],
    material: Reflectances,
    below_zero: Floats | float = 0.0,
) -> LightRange:
    """Return the range of the light on Q patches.

    Parameters
    ----------
    normals, positions, to_eye : (H, Q, 3) float64
        At H corners of each patch, world space.
    lights : sequence of DirectionalLight or PointLight
    material : Reflectances
    below_zero : (Q,) float64 or float
        How far below 0 weights can be, for patches that snapping lets reach beyond their corners.
    """
    count = normals.shape[1]
    normal, eye = cones(normals, below_zero), cones(to_eye, below_zero)
    low, high, shine_low, shine_high = np.zeros((4, count, 3))
    low += material.ambient[:, None]
    high += material.ambient[:, None]
    for light in lights:
        if isinstance(light, DirectionalLight):
            towards = Cones(np.broadcast_to(unit(-light.direction), (count, 3)), np.zeros(count))
        else:
            towards = cones(light.position - positions, below_zero)
        least, most = angles_between(normal, towards)
        color = np.maximum(light.color, 0)
        low += (material.diffuse * _cosine(most))[:, None] * color
        high += (material.diffuse * _cosine(least))[:, None] * color
        weak, strong = angles_between(normal, halfway(towards, eye))[::-1]
        power_low = np.where(most < np.pi / 2, np.float_power(_cosine(weak), material.shininess), 0.0)
        power_high = np.where(least < np.pi / 2, np.float_power(_cosine(strong), material.shininess), 0.0)
        shine_low += (material.specular * power_low)[:, None] * color
        shine_high += (material.specular * power_high)[:, None] * color
    return LightRange(low, high, shine_low, shine_high)


def halfway(towards: Cones, eye: Cones) -> Cones:
    """Return the cones that hold the halfway vectors."""
    total = towards.axis + eye.axis
    length = np.linalg.norm(total, axis=1)
    moved = towards.radius + eye.radius
    with np.errstate(divide="ignore", invalid="ignore"):
        share = moved / length
    is_lost = ~(share < 1)
    radius = np.where(is_lost, np.pi, np.arcsin(np.where(is_lost, 0.0, share)))
    return Cones(unit(total), radius)


def angles_between(first: Cones, second: Cones) -> tuple[Floats, Floats]:
    """Return the least and the largest angle (Q,) between directions of two cones; a hair is for rounding."""
    middle, reach = angle(first.axis, second.axis), first.radius + second.radius + HAIR
    return np.maximum(middle - reach, 0.0), np.minimum(middle + reach, np.pi)


def _cosine(at: Floats) -> Floats:
    return np.asarray(np.maximum(np.cos(at), 0.0))
