"""How much light changes within a triangle: by slopes where a place is mistaken, by curvature between vertices.

A direction (normal, to a light, to the eye) is a mixture u of vectors at the corners. With m the least length of a
mixture and D the largest distance of two corners, a mixture that is off by e turns by no more than asin(e / m), and on
a straight way from a place to a corner the direction turns at a rate w of no more than D / m, with a second derivative
of no more than 2/sqrt(3) w^2. The halfway vector H = L + V, of length h, follows: its direction turns at a rate of
(w_L + w_V)/h, with a second derivative of no more than (2/sqrt(3)) (w_L^2 + w_V^2)/h + 3 (w_L + w_V)^2/h^2.

**A place that is off** (affine interpolation). The cosine has a slope of no more than 1, its power cos^s one of
s cos^(s-1) sin, greatest where sin^2 = 1/s.

**Light of the vertices, interpolated** (Gouraud). Where the second derivative of g is at most M, sum b_i g(corner i)
differs from g by no more than (1/2) sum b_i M |way to corner i|^2, and sum b_i |way|^2 = sum b_i b_j D_ij^2 is no more
than D^2/3. The cosine c has c'' <= 2/sqrt(3) w_N^2 + 2 w_N w + c'' of the other; its power s c^(s-1) c'' +
s (s-1) c^(s-2) sin^2 w^2. So the error falls with the square of the triangles' size: how fine a tessellation is enough.

Where the light sets within the triangle, highlights end at once. There N.L = 0, so the angle of N and H is at least
90 degrees less half the angle f of L and V: what is cut off is no more than sin(f/2)^s. Diffuse light has a kink there:
between corners of cosines p and -n the mean of what is cut at 0 is above by no more than p n/(p + n).

References
----------
P. Ciarlet, P. Raviart, *General Lagrange and Hermite interpolation in R^n*, 1972 (the remainder over a simplex).
T. Bishop, D. Weimer, *Fast Phong shading*, 1986.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from core.geometry.vertex_stage import unit
from core.records.arrays import Flags, Floats
from core.scene import DirectionalLight, Scene
from core.study.planner.bounds.light_ranges import Cones, angle, angles_between, cones, halfway
from core.study.planner.bounds.lit_patches import LitPatches

BENT = 2 / np.sqrt(3.0)
"""Second derivative of the direction of a point on a line, over the square of its speed by its distance, at most."""
UNIT = 1e-9
"""Lengths no farther from 1 are 1, but for rounding."""
LEAST_SHININESS = 2.0
"""Powers below have no second derivative where they begin."""


@dataclass(frozen=True, eq=False)
class LightError:
    """How far the light of P primitives may be off, (P, 3) float64 linear each."""

    diffuse: Floats
    specular: Floats


@dataclass(frozen=True, eq=False)
class Turn:
    """How a direction turns over P patches."""

    cone: Cones
    rate: Floats
    """(P,) float64, the largest distance of two corners over the least length; infinite: it may turn anywhere."""
    sagitta: Floats
    """(P,) float64, how much shorter than unit vectors at the corners a mixture can be, over its length."""


@dataclass(frozen=True, eq=False)
class _Highlight:
    """One light over P patches."""

    color: Floats
    """(3,) float64 linear."""
    towards: Turn
    least: Floats
    """(P,) float64 radians, the least angle of a normal and a halfway vector."""
    most: Floats
    """(P,) float64 radians, the largest."""
    half: Floats
    """(P,) float64, the least length of L + V; 0: not known."""
    between: Floats
    """(P,) float64 radians, the largest angle of L and V."""
    cosines: Floats
    """(3, P) float64, N.L at the corners, not cut at 0."""
    is_up: Flags
    """(P,) bool, the light is above the horizon of every normal."""
    is_down: Flags
    """(P,) bool, below that of every normal."""


def turn(vectors: Floats, below_zero: Floats) -> Turn:
    """Return how mixtures of vectors (3, P, 3), whose weights are no less than ``-below_zero`` (P,), turn."""
    cone = cones(vectors, below_zero)
    across = [np.linalg.norm(vectors[k] - vectors[k - 1], axis=1) for k in range(3)]
    along = np.stack([(each * cone.axis).sum(axis=1) for each in vectors])
    is_unit = (np.abs(np.linalg.norm(vectors, axis=2) - 1) < UNIT).all(axis=0)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        least = np.nan_to_num(along.min(axis=0) - 2 * below_zero * np.ptp(along, axis=0), nan=0.0)
        rate = np.where(least > 0, np.max(across, axis=0) / least, np.inf)
        sagitta = np.where(is_unit & (least > 0), np.maximum(1 / least - 1, 0.0), np.inf)
    return Turn(cone, np.nan_to_num(rate, nan=np.inf), sagitta)


def moved_light_error(patches: LitPatches, scene: Scene, share: Floats) -> LightError:
    """Return how far light is off where a place is, by ``share`` (P,) of the range of every attribute."""
    normal, eye = turn(patches.normal, patches.below_zero), turn(patches.to_eye, patches.below_zero)
    error = LightError(*np.zeros((2, len(share), 3)))
    material = patches.material
    with np.errstate(invalid="ignore", over="ignore", divide="ignore"):
        of_normal, of_eye = _turned(normal.rate, share), _turned(eye.rate, share)
        for light in _highlights(patches, scene, normal, eye):
            of_light = _turned(light.towards.rate, share)
            error.diffuse[:] += (material.diffuse * (of_normal + of_light))[:, None] * light.color
            change = of_normal + _arcsine((of_light + of_eye) / light.half)
            rise = _steepest(light, material.shininess) * change + _cut_off(light, material.shininess)
            rise = np.where(light.is_down, 0.0, rise)
            error.specular[:] += _product(material.specular, rise)[:, None] * light.color
    return LightError(_known(error.diffuse), _known(error.specular))


def bent_light_error(patches: LitPatches, scene: Scene) -> LightError:
    """Return how far light that is interpolated between vertices is from that of interpolated normals."""
    normal, eye = turn(patches.normal, patches.below_zero), turn(patches.to_eye, patches.below_zero)
    error = LightError(*np.zeros((2, len(normal.rate), 3)))
    material, below = patches.material, patches.below_zero
    with np.errstate(invalid="ignore", over="ignore", divide="ignore"):
        # Weights below 0 lengthen the ways to the corners, and count twice.
        sixth = (1 + 2 * below) ** 2 * (1 + 12 * below) / 6
        for light in _highlights(patches, scene, normal, eye):
            of_light, of_eye = light.towards.rate, eye.rate
            bend = BENT * (normal.rate**2 + of_light**2) + 2 * normal.rate * of_light
            # Where the light sets, weights below 0 may lift it above the horizon again.
            beyond = np.where(light.is_up, 0.0, 2 * below * np.abs(light.cosines).max(axis=0))
            bright = np.maximum(light.cosines.max(axis=0), 0.0) + beyond
            arc = (1 + 4 * below) * _product(bright, normal.sagitta) + 2 * light.towards.cone.radius
            diffuse = np.where(light.is_down, 0.0, np.fmin(sixth * bend, arc) + _kink(light) + beyond)
            error.diffuse[:] += _product(material.diffuse, diffuse)[:, None] * light.color
            rate = (of_light + of_eye) / light.half
            bend_of_half = BENT * (of_light**2 + of_eye**2) / light.half + 3 * rate**2
            bend = BENT * normal.rate**2 + 2 * normal.rate * rate + bend_of_half
            specular = sixth * _power_bend(light, material.shininess, bend, (normal.rate + rate) ** 2)
            specular = np.where(light.is_down, 0.0, specular + _cut_off(light, material.shininess))
            error.specular[:] += _product(material.specular, specular)[:, None] * light.color
    return LightError(_known(error.diffuse), _known(error.specular))


def _highlights(patches: LitPatches, scene: Scene, normal: Turn, eye: Turn) -> Iterator[_Highlight]:
    """Yield every light with the angles that it makes over the patches."""
    for light in scene.lights:
        if isinstance(light, DirectionalLight):
            vectors = np.broadcast_to(-light.direction, patches.position.shape)
        else:
            vectors = light.position - patches.position
        towards = turn(vectors, patches.below_zero)
        between = angle(towards.cone.axis, eye.cone.axis) + towards.cone.radius + eye.cone.radius
        half = np.where(between < np.pi, 2 * np.cos(np.minimum(between, np.pi) / 2), 0.0)
        least, most = angles_between(normal.cone, halfway(towards.cone, eye.cone))
        above, below = angles_between(normal.cone, towards.cone)[::-1]
        color = np.maximum(light.color, 0)
        cosines = np.stack(
            [(unit(each) * unit(way)).sum(axis=1) for each, way in zip(patches.normal, vectors, strict=True)]
        )
        is_up, is_down = above < np.pi / 2, below > np.pi / 2
        yield _Highlight(color, towards, least, most, half, between, cosines, is_up, is_down)


def _kink(light: _Highlight) -> Floats:
    """Return how far the mean of cosines that are cut at 0 is above their mean, cut at 0 (P,)."""
    bright, dark = np.maximum(light.cosines.max(axis=0), 0.0), np.maximum(-light.cosines.min(axis=0), 0.0)
    return np.asarray(bright * dark / np.maximum(bright + dark, 1e-300))


def _cut_off(light: _Highlight, shininess: Floats) -> Floats:
    """Return how bright a highlight (P,) can be where the light sets; 0 where it does not set."""
    reach = np.float_power(np.sin(np.minimum(light.between, np.pi) / 2), shininess)
    return np.where(light.is_up, 0.0, reach)


def _turned(rate: Floats, share: Floats) -> Floats:
    """Return by what angle (P,) a direction turns that is off by ``share`` of what it turns over."""
    return _arcsine(_product(share, rate))


def _arcsine(sine: Floats) -> Floats:
    """Return the angle; infinite where the sine is not below 1."""
    return np.asarray(np.where(sine < 1, np.arcsin(np.clip(sine, 0.0, 1.0)), np.inf))


def _steepest(light: _Highlight, shininess: Floats) -> Floats:
    """Return the steepest slope (P,) of cos^s between the least and the largest angle."""
    power = np.maximum(shininess, 1.0)
    at = np.clip(np.arcsin(1 / np.sqrt(power)), light.least, np.minimum(light.most, np.pi / 2))
    at = np.maximum(at, 0.0)
    slope = power * np.float_power(np.maximum(np.cos(at), 0.0), power - 1) * np.sin(at)
    return np.where((light.least >= np.pi / 2), 0.0, np.where(shininess >= 1, slope, np.inf))


def _power_bend(light: _Highlight, shininess: Floats, bend: Floats, squared_rate: Floats) -> Floats:
    """Return the largest second derivative (P,) of cos^s where that of the cosine is no more than ``bend`` (P,)."""
    power = np.maximum(shininess, LEAST_SHININESS)
    at = np.clip(np.arcsin(np.sqrt(2 / power)), light.least, np.minimum(light.most, np.pi / 2))
    top, there = np.maximum(np.cos(light.least), 0.0), np.maximum(np.cos(at), 0.0)
    straight = power * np.float_power(top, power - 1) * bend
    curved = power * (power - 1) * np.float_power(there, power - 2) * np.sin(at) ** 2 * squared_rate
    found = np.where(light.least >= np.pi / 2, 0.0, straight + curved)
    return np.where(shininess >= LEAST_SHININESS, found, np.inf)


def _product(first: Floats, second: Floats) -> Floats:
    """Return the product of bounds; nothing times the unknown is nothing."""
    return np.asarray(np.where((first == 0) | (second == 0), 0.0, first * second))


def _known(error: Floats) -> Floats:
    return np.nan_to_num(error, nan=np.inf, posinf=np.inf)
