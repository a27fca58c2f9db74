"""Shading: where the lighting rule is evaluated: at every fragment, vertex or face, or by the rule of an edited text.

A method of the family ``shading`` takes the vertices in world space and says what is interpolated, by name:
``position`` and ``normal`` where fragments are lit, ``diffuse_light`` and ``specular_light`` where vertices
or faces were. The colour of a fragment is ``albedo * diffuse_light + specular_light``; the albedo is the
vertex colour or the texture.

References
----------
H. Gouraud, Continuous shading of curved surfaces, 1971.
B. T. Phong, Illumination for computer generated pictures, 1975.
F. Pellacini, Computer Graphics, lecture "Graphics pipeline", "lighting computation".
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from core.methods import method
from core.records.arrays import Flags, Floats, Integers
from core.scene import Light
from core.shading.lighting import Surface, dot, planes

# A method of shading that lights points by a rule of its own: an edited listing.


class LightRule(ABC):
    """A method of the family ``shading`` with a lighting rule of its own."""

    @abstractmethod
    def __call__(self, *values: Any) -> dict[str, Floats]:
        """Return what is interpolated, as the method does whose listing is edited."""

    @abstractmethod
    def light(
        self, position: Floats, normal: Floats, eye: Floats, lights: Sequence[Light], material: Surface
    ) -> tuple[Floats, Floats]:
        """Return diffuse and specular light (F, 3) of points, as ``core.shading.lighting.light_surface`` does."""


# Shading: where the lighting rule is evaluated: at every fragment, vertex or face, or nowhere.


LightOf = Callable[[Floats, Floats, Integers], tuple[Floats, Floats]]
"""From position (M, 3), normal (M, 3) and the vertex (M,) that has the material: the two lights (M, 3)."""


@method(
    "shading",
    "phong",
    "Phong (per fragment)",
    source="Phong 1975; Pellacini, Phong shading",
    exact_for="surfaces whose normals are the interpolated ones",
    breaks_where="silhouettes: they stay polygons. Light can come from below the surface",
    takes=("shadow", "environment"),
    traits="fragments",
)
def phong(
    position: Floats, normal: Floats, corners: Integers, behind: Flags, _light: LightOf
) -> dict[str, Floats]:
    """Interpolate ``position`` and ``normal``; the rule lights every fragment, with ``two_sided=False``.

    Parameters
    ----------
    position, normal : (N, 3) float64 arrays
        Vertices in world space.
    corners : (T, 3) int64 array
        The vertices of every triangle.
    behind : (T,) bool array
        Triangles that are lit as if their normals were turned round: seen from the side that these point away from.
    light : callable
        The lighting rule with the scene's eye, lights and materials filled in.

    Returns
    -------
    dict of (T, 3, 3) float64 arrays
        What is to be interpolated, by name. All methods of the family take and give the same.
    """
    return {"position": position[corners], "normal": _turned(normal[corners], behind)}


@method(
    "shading",
    "gouraud",
    "Gouraud (per vertex)",
    source="Gouraud 1971; Pellacini, Gouraud shading; Jubair, Per-vertex shading",
    exact_for="matte surfaces of small triangles",
    breaks_where="highlights smaller than a triangle: they are lost, or jump from vertex to vertex",
    traits="vertices",
)
def gouraud(
    position: Floats, normal: Floats, corners: Integers, behind: Flags, light: LightOf
) -> dict[str, Floats]:
    """Light the vertices and interpolate the light. Arguments as in `phong`."""
    every_vertex = np.arange(len(position))
    diffuse_light, specular_light = (sums[corners] for sums in light(position, normal, every_vertex))
    if behind.any():
        other_side = light(position, -normal, every_vertex)
        diffuse_light[behind] = other_side[0][corners[behind]]
        specular_light[behind] = other_side[1][corners[behind]]
    return {"diffuse_light": diffuse_light, "specular_light": specular_light}


@method(
    "shading",
    "flat",
    "Flat (per face)",
    source="Pellacini, flat shading",
    exact_for="polyhedra under distant light",
    breaks_where="curved surfaces: they look faceted",
    traits="faces",
)
def flat(
    position: Floats, normal: Floats, corners: Integers, behind: Flags, light: LightOf
) -> dict[str, Floats]:
    """Light each face once, at its centroid with its own normal. Arguments as in `phong`.

    Notes
    -----
    The three corners of a face get the same light: interpolate it as GLSL's flat, a weighted mean rounds. The
    material is that of the first corner.
    """
    outward = outward_normals(position, normal, corners)
    light_of_face = light(centroids(position, corners), _turned(outward, behind), corners[:, 0])
    diffuse_light, specular_light = (np.repeat(sums[:, None], 3, axis=1) for sums in light_of_face)
    return {"diffuse_light": diffuse_light, "specular_light": specular_light}


@method(
    "shading",
    "unlit",
    "Unlit",
    source="colour as given",
    exact_for="colours that include their light",
    traits="nothing",
)
def unlit(
    _position: Floats, _normal: Floats, _corners: Integers, _behind: Flags, _light: LightOf
) -> dict[str, Floats]:
    """Interpolate nothing for lighting: the colour is the albedo. Arguments as in `phong`."""
    return {}


def shade(albedo: Floats, diffuse_light: Floats, specular_light: Floats) -> Floats:
    """Return (F, 4) colours: ``albedo`` (F, 4) lit by (F, 3) diffuse and specular light; alpha is kept.

    The colours are a view of four rows; where the arguments are such views too, it is soonest done.
    """
    rows = np.empty((4, len(albedo)))
    for channel in range(3):
        np.multiply(albedo[:, channel], diffuse_light[:, channel], out=rows[channel])
        rows[channel] += specular_light[:, channel]
    rows[3] = albedo[:, 3]
    return rows.T


def unlit_color(albedo: Sequence[float]) -> tuple[float, ...]:
    """Return the colour of one fragment without texture and light (listing of `shade`)."""
    return tuple(albedo)  #: color


def shaded_color(
    albedo: Sequence[float], diffuse_light: Sequence[float], specular_light: Sequence[float]
) -> tuple[float, ...]:
    """Return the colour of one fragment (listing of `shade`)."""
    red, green, blue = (albedo[k] * diffuse_light[k] + specular_light[k] for k in range(3))  #: color
    return red, green, blue, albedo[3]


def textured_albedo(texture_color: Sequence[float], color: Sequence[float]) -> list[float]:
    """Return the albedo of one fragment: the texture's colour times the interpolated one (listing of `shade`)."""
    return [texture_color[k] * color[k] for k in range(4)]  #: albedo


def face_normals(position: Floats, corners: Integers) -> Floats:
    """Return (T, 3) normals of triangles, to the side they are counter-clockwise from; length: two areas."""
    first, second, third = (planes(position[corners[:, corner]]) for corner in range(3))
    ux, uy, uz = (end - start for start, end in zip(first, second, strict=True))
    vx, vy, vz = (end - start for start, end in zip(first, third, strict=True))
    return np.stack((uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx), axis=1)


def centroids(position: Floats, corners: Integers) -> Floats:
    """Return the (T, 3) mean of the three corners."""
    centre: Floats = (position[corners[:, 0]] + position[corners[:, 1]] + position[corners[:, 2]]) / 3
    return centre


def outward_normals(position: Floats, normal: Floats, corners: Integers) -> Floats:
    """Return the face normals (T, 3) on the side of the vertex normals, whatever the order of the corners."""
    face = face_normals(position, corners)
    mean = normal[corners[:, 0]] + normal[corners[:, 1]] + normal[corners[:, 2]]
    return _turned(face, dot(planes(face), planes(mean)) < 0)


def _turned(normal: Floats, turn: Flags) -> Floats:
    """Return ``normal`` (T, ...) with the opposite sign where ``turn`` (T,) holds."""
    result = normal.copy()
    result[turn] *= -1
    return result
