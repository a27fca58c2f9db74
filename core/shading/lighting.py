"""The lighting rule (Blinn-Phong), the same wherever it is evaluated.

With unit vectors N (normal), L (to the light), V (to the eye) and H = (L + V) / |L + V|::

    diffuse_light  = ambient + sum over lights of diffuse * max(N.L, 0) * colour
    specular_light =           sum over lights of specular * max(N.H, 0)^shininess * colour    (where N.L > 0)

The ambient light is white. Everything is linear and not cut off at 1; the display does that. Without
lights only the ambient term is left: who wants a headlight passes one.

References
----------
J. Blinn, Models of light reflection for computer synthesized pictures, 1977.
B. T. Phong, Illumination for computer generated pictures, 1975.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from typing import Any

import numpy as np

from core.records.arrays import Flags, Floats, Integers, read_only
from core.scene import DirectionalLight, Light, Material

_BLOCK = 16384
"""Points that are lit at once, so that their numbers stay in the processor's cache."""

_MODERATE = 1e150
"""The squared length of a vector between two places that are no farther out than this is finite."""

Planes = tuple[Floats, Floats, Floats]
"""x, y and z of F vectors, each (F,), or (1,) where all are the same."""


@dataclass(frozen=True, eq=False)
class Reflectance:
    """Materials of F points, a number each; stands wherever a `Material` does."""

    ambient: Floats
    """(F,) float64."""
    diffuse: Floats
    """(F,) float64."""
    specular: Floats
    """(F,) float64."""
    shininess: Floats
    """(F,) float64."""

    def take(self, index: Integers | slice) -> "Reflectance":
        """Return the points of ``index`` (Q,)."""
        return Reflectance(
            self.ambient[index], self.diffuse[index], self.specular[index], self.shininess[index]
        )


Surface = Material | Reflectance


def reflectance(materials: Sequence[Material], owner: Integers) -> Reflectance:
    """Return the material of every point, ``materials[owner]``, as arrays (F,)."""
    rows = np.array([(each.ambient, each.diffuse, each.specular, each.shininess) for each in materials])
    return Reflectance(*rows.T[:, owner])


@dataclass(frozen=True, eq=False)
class Lighting:
    """Every term of the lighting of F points by L lights, in the order of the lights."""

    normal: Floats
    """(F, 3) float64 unit N as used, or 0 where there was none."""
    turned: Flags
    """(F,) bool, N was turned to the eye."""
    to_eye: Floats
    """(F, 3) float64 unit V."""
    to_light: Floats
    """(L, F, 3) float64 unit L."""
    half: Floats
    """(L, F, 3) float64 unit H."""
    n_dot_l: Floats
    """(L, F) float64, with its sign."""
    n_dot_h: Floats
    """(L, F) float64, with its sign."""
    power: Floats
    """(L, F) float64 max(N.H, 0)^shininess, 0 where N.L <= 0."""
    diffuse_light: Floats
    """(L + 1, F, 3) float64 sum so far: row 0 is the ambient term, row k counts the first k lights."""
    specular_light: Floats
    """(L + 1, F, 3) float64 sum so far."""


@np.errstate(over="ignore", invalid="ignore")
def light_surface(
    position: Floats,
    normal: Floats,
    eye: Floats,
    lights: Sequence[Light],
    material: Surface,
    two_sided: bool = True,
    colors: Sequence[Floats] | None = None,
) -> tuple[Floats, Floats]:
    """Light F points by the Blinn-Phong rule.

    Parameters
    ----------
    position, normal : (F, 3) float64 arrays
        World space; normals need not be unit, a zero normal gets the ambient term only.
    eye : (3,) or (F, 3) float64 array
        Where the points are seen from, in world space; an orthographic camera sees each from another place.
    lights : sequence of DirectionalLight or PointLight
    material : Material or Reflectance
        One for all points, or one each.
    two_sided : bool
        Turn a normal that faces away from the eye.
    colors : sequence of (3,) or (3, F) float64 arrays, optional
        What arrives of each light, for all points or for each: less than its colour in a shadow. ``None``: all of it.

    Returns
    -------
    diffuse_light, specular_light : (F, 3) float64 arrays
        Linear RGB, views of three rows; ``diffuse_light`` includes the ambient term and multiplies the albedo.
    """
    diffuse_light, specular_light = np.empty((2, 3, len(position)))
    for start in range(0, len(position), _BLOCK):
        part = slice(start, start + _BLOCK)
        here = material.take(part) if isinstance(material, Reflectance) else material
        seen_from = eye if eye.ndim == 1 else eye[part]
        sums = diffuse_light[:, part].T, specular_light[:, part].T
        arriving = _arriving(lights, colors, part)
        _start_sums(*sums, here)
        if two_sided or not _is_matte(here, position[part], seen_from):
            points = _points(position[part], normal[part], seen_from, two_sided)
            for light, color in zip(lights, arriving, strict=True):
                _add_light(*sums, _terms(points, light, here), color, here)
        else:
            _add_matte_light(*sums, position[part], normal[part], lights, arriving, here)
    return diffuse_light.T, specular_light.T


def _arriving(
    lights: Sequence[Light], colors: Sequence[Floats] | None, part: slice = slice(None)
) -> list[Floats]:
    """Return what arrives of lights at the points of ``part``: (3,) each, or (3, Q) where it differs."""
    if colors is None:
        return [light.color for light in lights]
    return [color if color.ndim == 1 else color[:, part] for color in colors]


def _is_matte(material: Surface, position: Floats, eye: Floats) -> bool:
    """Return whether points (F, 3) have no highlight whatever the lights, so that the eye does not matter.

    Nothing times a highlight is nothing, unless the highlight is undefined: that of a place without end.
    """
    return not np.any(material.specular) and _is_moderate(position) and _is_moderate(eye)


def _is_moderate(places: Floats) -> bool:
    """Return whether no coordinate of (F, 3) places is NaN, infinite or beyond ``_MODERATE``."""
    return bool(places.min() >= -_MODERATE and places.max() <= _MODERATE)


def _add_matte_light(
    diffuse_sum: Floats,
    specular_sum: Floats,
    position: Floats,
    normal: Floats,
    lights: Sequence[Light],
    arriving: Sequence[Floats],
    material: Surface,
) -> None:
    """Add ``lights`` to the (F, 3) sums of points without highlight, as `_add_light` does.

    Normals or lights without end make the cosine NaN, and then the highlight is NaN too.
    """
    where, unit_normal = planes(position), _unit(planes(normal))
    for light, color in zip(lights, arriving, strict=True):
        n_dot_l = dot(unit_normal, _unit(_towards(light, where)))
        _add_diffuse(diffuse_sum, n_dot_l, color, material)
        undefined = np.isnan(n_dot_l)
        if undefined.any():
            specular_sum[undefined] = np.nan


@np.errstate(over="ignore", invalid="ignore")
def trace_lighting(
    position: Floats,
    normal: Floats,
    eye: Floats,
    lights: Sequence[Light],
    material: Surface,
    two_sided: bool = True,
    colors: Sequence[Floats] | None = None,
) -> Lighting:
    """Do what `light_surface` does for (F, 3) points, and keep every term."""
    count = len(position)
    points = _points(position, normal, eye, two_sided)
    diffuse_light, specular_light = np.empty((2, len(lights) + 1, count, 3))
    to_light, half = np.empty((2, len(lights), count, 3))
    n_dot_l, n_dot_h, power = np.empty((3, len(lights), count))
    _start_sums(diffuse_light[0], specular_light[0], material)
    for number, (light, color) in enumerate(zip(lights, _arriving(lights, colors), strict=True)):
        terms = _terms(points, light, material)
        _store(to_light[number], terms.to_light)
        _store(half[number], terms.half)
        n_dot_l[number], n_dot_h[number], power[number] = terms.n_dot_l, terms.n_dot_h, terms.power
        diffuse_light[number + 1], specular_light[number + 1] = diffuse_light[number], specular_light[number]
        _add_light(diffuse_light[number + 1], specular_light[number + 1], terms, color, material)
    unit_normal, to_eye = np.empty((2, count, 3))
    _store(unit_normal, points.normal)
    _store(to_eye, points.to_eye)
    return Lighting(
        normal=read_only(unit_normal),
        turned=read_only(points.turned),
        to_eye=read_only(to_eye),
        to_light=read_only(to_light),
        half=read_only(half),
        n_dot_l=read_only(n_dot_l),
        n_dot_h=read_only(n_dot_h),
        power=read_only(power),
        diffuse_light=read_only(diffuse_light),
        specular_light=read_only(specular_light),
    )


@dataclass(frozen=True, eq=False)
class _Points:
    """F points to be lit; the normals and directions are unit."""

    position: Planes
    normal: Planes
    to_eye: Planes
    turned: Flags


@dataclass(frozen=True, eq=False)
class _Terms:
    """What one light does to F points."""

    to_light: Planes
    half: Planes
    n_dot_l: Floats
    n_dot_h: Floats
    power: Floats


def unit_directions(position: Floats, normal: Floats, eye: Floats) -> tuple[Floats, Floats]:
    """Return the unit normals and unit directions to the eye, (F, 3) each, as `light_surface` has them."""
    points = _points(position, normal, eye, False)
    return np.stack(points.normal, axis=1), np.stack(points.to_eye, axis=1)


def _points(position: Floats, normal: Floats, eye: Floats, two_sided: bool) -> _Points:
    """Make the normals and the directions to the eye unit, and turn normals if wanted."""
    where = planes(position)
    seen_from = planes(eye.reshape(-1, 3))
    to_eye = _unit((seen_from[0] - where[0], seen_from[1] - where[1], seen_from[2] - where[2]))
    unit_normal = _unit(planes(normal))
    turned = np.zeros(len(position), np.bool_)
    if two_sided:
        turned = dot(unit_normal, to_eye) < 0
        for component in unit_normal:
            np.negative(component, out=component, where=turned)
    return _Points(where, unit_normal, to_eye, turned)


def _terms(points: _Points, light: Light, material: Surface) -> _Terms:
    """Evaluate the cosines of one light and the power of the highlight."""
    to_light = _unit(_towards(light, points.position))
    (lx, ly, lz), (vx, vy, vz) = to_light, points.to_eye
    half = _unit((lx + vx, ly + vy, lz + vz))
    n_dot_l, n_dot_h = dot(points.normal, to_light), dot(points.normal, half)
    base = np.maximum(n_dot_h, 0.0)
    base *= n_dot_l > 0
    # float_power rounds alike for one value and for many; power has short cuts for some exponents.
    power = np.zeros(base.shape)
    np.float_power(base, material.shininess, out=power, where=base != 0)
    return _Terms(to_light, half, n_dot_l, n_dot_h, power)


def _start_sums(diffuse_sum: Floats, specular_sum: Floats, material: Surface) -> None:
    """Set the (F, 3) sums to the ambient term and to 0."""
    diffuse_sum.T[:] = material.ambient
    specular_sum[:] = 0.0


def _add_light(
    diffuse_sum: Floats, specular_sum: Floats, terms: _Terms, color: Floats, material: Surface
) -> None:
    """Add one light, of which ``color`` (3,) or (3, F) arrives, to the (F, 3) sums."""
    _add_diffuse(diffuse_sum, terms.n_dot_l, color, material)
    specular = material.specular * terms.power
    for channel in range(3):
        specular_sum[:, channel] += specular * color[channel]


def _add_diffuse(diffuse_sum: Floats, n_dot_l: Floats, color: Floats, material: Surface) -> None:
    """Add the diffuse term of one light, (F,) cosines, to the (F, 3) sum."""
    diffuse = np.maximum(n_dot_l, 0.0)
    diffuse *= material.diffuse
    for channel in range(3):
        diffuse_sum[:, channel] += diffuse * color[channel]


def _towards(light: Light, position: Planes) -> Planes:
    """Return the vectors from ``position`` to ``light``; one for all where it is directional."""
    if isinstance(light, DirectionalLight):
        x, y, z = -light.direction[:, None]
        return x, y, z
    x, y, z = position
    return light.position[0] - x, light.position[1] - y, light.position[2] - z


def planes(vectors: Floats) -> Planes:
    """Return the components of ``vectors`` (F, 3), each contiguous; not to be written to."""
    x, y, z = np.ascontiguousarray(vectors.T, dtype=np.float64)
    return x, y, z


def _store(vectors: Floats, components: Planes) -> None:
    for axis, component in enumerate(components):
        vectors[:, axis] = component


def dot(a: Planes, b: Planes) -> Floats:
    """Return (F,) dot products, summed in the order x, y, z."""
    total = a[0] * b[0]
    total += a[1] * b[1]
    total += a[2] * b[2]
    return total


def _unit(vectors: Planes) -> Planes:
    """Return vectors of length 1; a zero vector stays zero."""
    length = dot(vectors, vectors)
    np.sqrt(length, out=length)
    if not length.min(initial=1.0) > 0:
        length[length == 0] = 1.0
    x, y, z = vectors
    return x / length, y / length, z / length


Vector = Sequence[float]
PlainLight = Sequence[Any]
"""Where a light is, or the direction to it; whether it is a point; its colour."""


def plain_lights(lights: Sequence[Light]) -> list[PlainLight]:
    """Return lights as the listing knows them."""
    return [
        [(-light.direction).tolist(), False, light.color.tolist()]
        if isinstance(light, DirectionalLight)
        else [light.position.tolist(), True, light.color.tolist()]
        for light in lights
    ]


def plain_material(material: Surface) -> tuple[Any, Any, Any, Any]:
    """Return a material as the listing knows it: four numbers, or (F,) each."""
    return material.ambient, material.diffuse, material.specular, material.shininess


def blinn_phong(
    position: Vector,
    normal: Vector,
    eye: Vector,
    lights: Sequence[PlainLight],
    material: tuple[float, float, float, float],
    two_sided: bool,
) -> tuple[list[float], list[float]]:
    """Return diffuse and specular light of one point (listing of the rule)."""
    ambient, diffuse, specular, shininess = material
    n, v = unit(normal), towards(position, eye)  #: normal
    if two_sided and inner(n, v) < 0:
        n = [-n[0], -n[1], -n[2]]
    diffuse_light, specular_light = [ambient, ambient, ambient], [0.0, 0.0, 0.0]  #: ambient
    for place, is_point, color in lights:
        to_light = towards(position, place) if is_point else unit(place)
        h = unit([to_light[k] + v[k] for k in range(3)])
        n_dot_l, n_dot_h = inner(n, to_light), inner(n, h)  #: cosines
        power = pow(max(n_dot_h, 0.0), shininess) if n_dot_l > 0 else 0.0  #: power
        for k in range(3):
            diffuse_light[k] += diffuse * max(n_dot_l, 0.0) * color[k]  #: diffuse
            specular_light[k] += specular * power * color[k]  #: specular
    return diffuse_light, specular_light


def inner(a: Vector, b: Vector) -> float:
    """Return the dot product of two vectors."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def unit(vector: Vector) -> list[float]:
    """Return a vector at length 1; a zero vector stays zero."""
    length = sqrt(inner(vector, vector))
    length = 1.0 if length == 0 else length
    return [vector[0] / length, vector[1] / length, vector[2] / length]


def towards(start: Vector, end: Vector) -> list[float]:
    """Return the unit vector from one place to another."""
    return unit([end[0] - start[0], end[1] - start[1], end[2] - start[2]])
