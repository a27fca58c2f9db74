"""Light at pixels in float32, from directions in camera space: normals as planes, and how far off light may be.

The rule is that of ``core.shading.lighting`` (Blinn-Phong), for lights from far away: the direction to the eye
follows from the pixel alone, so a unit normal is all that is asked of a fragment. How far it may be from ``render``:
see ``light_errors``.

A normal divided by w is linear over the window, and dividing all of it by one number does not turn it; so its three
components are evaluated at every visible pixel and made a unit vector there: perspective-correct without a division
by w.

A normal that is off by an angle e moves the cosine by e at most. The highlight cos^n falls fastest where its angle has
the tangent 1 / sqrt(n - 1): by less than sqrt(n) e. In linear bytes that is 255 times as much. sRGB is steep where it
is dark, and a light that is dark changes little: with f the encoding, x f'(x) is at most `SHARE` x^(5/12), so the
diffuse part A D (albedo, light) moves by (A D)^(5/12) `SHARE` e / D, and the highlight S by S^(5/12) `SHARE` n tan e,
whose greatest value is that at cos^(5n/12). The encoding is concave: what the parts are off by in the dark they are
never off by more in a sum.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import sqrt

import numpy as np

from core.fast_path.draw_context import DrawContext, Words
from core.fast_path.lit_planes import (
    ALIKE,
    CornerPlaces,
    Plane,
    Shown,
    VertexFacts,
    are_unlike,
    evaluate,
    plane_through,
    rounding,
)
from core.framebuffer.display import SRGB_EXPONENT, SRGB_LIMIT, SRGB_SLOPE, encode_linear, encode_srgb
from core.numeric.large_arrays import ScratchBuffers
from core.records.arrays import Flags, Floats, Integers, Singles, read_only
from core.scene import Camera, DirectionalLight, Light, Material, Mesh, Scene
from core.transform.matrices import world_to_camera

# Light at pixels in float32, from directions in camera space; and the bytes of lit colours, through a
# table.


LEVELS = 1 << 14
"""Linear colours that are told apart."""
OPPOSITE = -7 / 8
"""Cosine between the directions to eye and light below which their sum is shorter than 1/2, and off by more than twice
the angle that they are."""
UNSEEN = 1e-5
"""Light that changes no byte by more than a thirtieth."""

MOST = np.float32(2)
"""Greater than any cosine: cutting off at both ends takes half the time of cutting off at one (NumPy 2.4)."""

FarLight = tuple[Singles, tuple[float, ...]]
"""Unit direction to a light in camera space, (3,) float32, and its colour."""


@dataclass(frozen=True, eq=False)
class PixelLight:
    """What lights a mesh, and how it is seen."""

    material: Material
    lights: tuple[FarLight, ...]
    camera: Camera

    @property
    def strength(self) -> float:
        """Greatest ambient and diffuse light that there can be."""
        return self.material.ambient + self.material.diffuse * sum(max(color) for _, color in self.lights)

    def at(
        self, context: DrawContext, normal: Singles, turn: float, column: Integers, row: Integers
    ) -> tuple[Singles, Singles, Integers]:
        """Return the light that falls on points, the light that they mirror, and where that is in doubt.

        Parameters
        ----------
        normal : (3, F) float32 array
            Unit normals in camera space.
        turn : float
            Angle that they may be off, in radians.
        column, row : (F,) int64 arrays
            The pixels.

        Returns
        -------
        diffuse, specular : (1 or 3, F) float32 arrays
            One row where light is grey; in the context's scratch.
        doubtful : (D,) int64 array
            Points, maybe twice, whose highlight ends within ``turn``, or whose light comes from beyond them so straight
            that it has no half-way to the eye: there a small error is a large one.
        """
        scratch, material, count = context.scratch, self.material, normal.shape[1]
        is_gray = all(len(set(color)) == 1 for _, color in self.lights)
        channels = 1 if is_gray else 3
        diffuse, specular = (
            scratch(f"light_{name}", channels, count, dtype=np.float32) for name in ("d", "s")
        )
        diffuse.fill(material.ambient)
        specular.fill(0)
        to_eye = self._to_eye(context, column, row)
        doubtful = [np.empty(0, np.int64)]
        for to_light, color in self.lights:
            cosine, power = self._terms(normal, to_eye, to_light, scratch)
            if material.specular:
                found = _at_the_edge(cosine, to_eye, to_light, turn, scratch)
                doubtful.append(found[power.take(found) * material.specular * max(color) > UNSEEN])
                power *= cosine > 0
            np.clip(cosine, np.float32(0), MOST, out=cosine)
            for channel in range(channels):
                if len(self.lights) == 1 and channel == channels - 1:
                    product = cosine
                else:
                    product = scratch("light_product", count, dtype=np.float32)
                np.multiply(cosine, np.float32(material.diffuse * color[channel]), out=product)
                diffuse[channel] += product
                if material.specular:
                    np.multiply(power, np.float32(material.specular * color[channel]), out=product)
                    specular[channel] += product
        return diffuse, specular, np.concatenate(doubtful)

    def _to_eye(self, context: DrawContext, column: Integers, row: Integers) -> Singles:
        """Return the unit directions (3, F) float32 from pixels to the eye, in camera space."""
        direction: Singles = context.scratch("to_eye", 3, len(column), dtype=np.float32)
        if self.camera.projection == "orthographic":
            direction[:2], direction[2] = 0, 1
            return direction
        (width, height), center = context.scene.size, context.raster.center
        half_height = float(np.tan(self.camera.field_of_view / 2))
        pixel = np.float32(2 * half_height / height)
        np.copyto(direction[0], column, casting="unsafe")
        np.copyto(direction[1], row, casting="unsafe")
        direction[0] -= np.float32(width / 2 - center)
        direction[1] -= np.float32(height / 2 - center)
        direction[:2] *= -pixel
        direction[2] = 1
        return make_unit(direction, context.scratch)

    def _terms(
        self, normal: Singles, to_eye: Singles, to_light: Singles, scratch: ScratchBuffers
    ) -> tuple[Singles, Singles]:
        """Return the cosine to a light, and the power of a highlight wherever it shines, (F,) float32 each."""
        cosine = _dot(normal, to_light, scratch("cosine", normal.shape[1], dtype=np.float32), scratch)
        power = scratch("power", normal.shape[1], dtype=np.float32)
        if self.material.specular:
            half = scratch("half", *normal.shape, dtype=np.float32)
            np.add(to_eye, to_light[:, None], out=half)
            _dot(normal, make_unit(half, scratch), power, scratch)
            np.clip(power, np.float32(1e-30), MOST, out=power)
            np.log2(power, out=power)
            power *= np.float32(self.material.shininess)
            np.exp2(power, out=power)
        return cosine, power


def _at_the_edge(
    cosine: Singles, to_eye: Singles, to_light: Singles, turn: float, scratch: ScratchBuffers
) -> Integers:
    """Return the points (D,) of which a turn of the normal decides whether they mirror a light; see `PixelLight.at`."""
    size = np.abs(cosine, out=scratch("cosine_size", len(cosine), dtype=np.float32))
    is_at_edge: Flags = size <= np.float32(turn)
    # Light from this side of the window is never opposite to an eye that looks at most 60 degrees past its middle.
    if to_light[2] < 0 or to_eye[2].min(initial=1) < 0.5:
        facing = _dot(to_eye, to_light, size, scratch)
        is_opposite: Flags = facing < np.float32(OPPOSITE)
        is_opposite &= cosine > -np.float32(turn)
        is_at_edge |= is_opposite
    return np.flatnonzero(is_at_edge)


def pixel_light(scene: Scene, mesh: Mesh) -> PixelLight | None:
    """Return what lights a mesh of a scene, or ``None`` where a light is not far away, or takes light away."""
    rotation = world_to_camera(scene.camera)[:3, :3]
    lights = [_far_light(light, rotation) for light in scene.lights if isinstance(light, DirectionalLight)]
    if len(lights) < len(scene.lights) or any(min(color) < 0 for _, color in lights):
        return None
    return PixelLight(mesh.material, tuple(lights), scene.camera)


def _far_light(light: Light, rotation: Floats) -> FarLight:
    """Return a light as seen from the camera, whose axes are the rows of ``rotation`` (3, 3)."""
    assert isinstance(light, DirectionalLight)
    to_light = -(rotation @ light.direction)
    direction: Singles = (to_light / np.linalg.norm(to_light)).astype(np.float32)
    return direction, tuple(float(part) for part in light.color)


def lit_pixels(
    context: DrawContext, albedo: Sequence[Singles | np.float32], diffuse: Singles, specular: Singles
) -> Words:
    """Return the opaque pixels (F,) uint32 of albedo times diffuse light plus specular light.

    Parameters
    ----------
    albedo : sequence of 1 or 3 numbers or (F,) float32 arrays
        Linear grey, or red, green and blue.
    diffuse, specular : (1 or 3, F) float32 arrays
        As from `PixelLight.at`.
    """
    scratch, count = context.scratch, diffuse.shape[1]
    is_gray = len(diffuse) == len(albedo) == 1
    level = scratch("level", count, dtype=np.float32)
    # Floats are cut off to 32 bits five times as fast as to 64.
    index = scratch("level_index", count, dtype=np.int32)
    pixels, byte = (scratch(f"level_{name}", count, dtype=np.uint32) for name in ("pixels", "byte"))
    tables = level_words(context.encoding)
    for channel in range(1 if is_gray else 3):
        source = min(channel, len(diffuse) - 1)
        np.multiply(diffuse[source], albedo[min(channel, len(albedo) - 1)], out=level)
        level += specular[source]
        level *= np.float32(LEVELS - 1)
        level += np.float32(0.5)
        np.clip(level, np.float32(0), np.float32(LEVELS - 1), out=level)
        np.copyto(index, level, casting="unsafe")
        table = tables[3] if is_gray else tables[channel]
        table.take(index, out=pixels if channel == 0 else byte, mode="clip")
        if channel:
            pixels |= byte
    return pixels


@lru_cache(maxsize=2)
def level_words(encoding: str) -> tuple[Words, Words, Words, Words]:
    """Return for every one of (16384,) linear levels its red, green, blue and grey pixel, uint32; red has the alpha."""
    level = np.linspace(0, 1, LEVELS).astype(np.float32)
    byte = (encode_linear(level) if encoding == "linear" else encode_srgb(level)).astype(np.uint32)
    opaque = np.uint32(0xFF000000)
    red, green, blue = byte | opaque, byte << np.uint32(8), byte << np.uint32(16)
    return read_only(red), read_only(green), read_only(blue), read_only(red | green | blue)


def make_unit(vectors: Singles, scratch: ScratchBuffers) -> Singles:
    """Make vectors (3, F) that are not zero unit, in place, and return them."""
    length = _dot(vectors, vectors, scratch("squared_length", vectors.shape[1], dtype=np.float32), scratch)
    np.sqrt(length, out=length)
    np.divide(np.float32(1), length, out=length)
    vectors *= length
    return vectors


def _dot(a: Singles, b: Singles, out: Singles, scratch: ScratchBuffers) -> Singles:
    """Write the dot products (F,) of vectors (3, F) with others, (3, F) or (3,)."""
    part = scratch("dot_part", len(out), dtype=np.float32)
    np.multiply(a[0], b[0], out=out)
    for axis in (1, 2):
        np.multiply(a[axis], b[axis], out=part)
        out += part
    return out


# Normals of triangles in camera space as planes: a direction is linear over the window.


FORWARD = np.array([[0.0], [0.0], [1.0]])
"""Any direction."""
STEEPEST_NORMAL = 2.0**40
"""Change of a component a pixel; steeper planes are seen edge-on."""

NormalPlanes = tuple[Plane, Plane, Plane]
"""Of x, y and z of P triangles, over w and in any scale."""


def normal_planes(
    context: DrawContext, camera: Camera, facts: VertexFacts, places: CornerPlaces
) -> tuple[NormalPlanes, Flags] | None:
    """Return the normals of all primitives, and which of them hold too different ones.

    Parameters
    ----------
    facts : VertexFacts
        Of the values at the vertices.
    places : CornerPlaces
        Where the corners lie in the window.

    Returns
    -------
    normals : NormalPlanes
    is_unlike : (P,) bool
        Where they point anywhere: the normals at the corners are too different, see `are_unlike`.

    ``None`` is returned where a plane is too steep.
    """
    normal = facts.values.normals_seen_by(camera)
    corners = [normal.take(index, axis=1) for index in context.geometry.primitives.values.index]
    is_unlike = np.zeros(len(places.is_doubtful), bool)
    if context.geometry.has_pieces or facts.unlike_count:
        is_unlike = are_unlike(corners)
        for corner in corners:
            corner[:, is_unlike] = FORWARD
    least = places.w.min(axis=0)
    for corner, of_corner in zip(corners, places.w, strict=True):
        corner *= least / of_corner
    x, y, z = (plane_through(places, [corner[axis] for corner in corners]) for axis in range(3))
    steepest = max(float(np.abs(slope).max(initial=0)) for plane in (x, y, z) for slope in plane[:2])
    return ((x, y, z), is_unlike) if steepest < STEEPEST_NORMAL else None


def unit_normals(
    planes: NormalPlanes, context: DrawContext, shown: Shown, column: Integers, row: Integers
) -> Singles:
    """Return the unit normals (3, F) float32 of primitives at pixels (F,), in the context's scratch."""
    x, y = context.raster.centers(column, row)
    value, term = context.scratch("normal_value", len(x)), context.scratch("normal_term", len(x))
    components = context.scratch("components", 3, len(x), dtype=np.float32)
    for plane, component in zip(planes, components, strict=True):
        evaluate(plane, shown, x, y, value, term)
        np.copyto(component, value, casting="same_kind")
    return make_unit(components, context.scratch)


# How far light in float32 may be from that of ``render``, in bytes.


STEEPEST = 255 * SRGB_SLOPE
"""Bytes that sRGB rises by per unit of light, at most."""
POWER = 1 / SRGB_EXPONENT
SHARE = STEEPEST * SRGB_LIMIT ** (1 - POWER)
"""x f'(x) / x^(1/2.4) is at most this: the value where the straight beginning of sRGB ends."""
SINGLE = 2.0**-20
"""Unit vectors in float32, and the products of two, are rounded by less."""
TABLE = 0.25
"""Bytes that the table of levels and the sums in float32 may be off."""


def normal_error(places: CornerPlaces) -> float:
    """Return the greatest angle, in radians, that an interpolated normal may be turned by, of P triangles (P,).

    Notes
    -----
    Doubtful triangles have no such bound. The components at the corners differ by 2 at most, and the shortest
    interpolated normal has length sqrt((1 + 2 ALIKE) / 3) times the least w over the greatest. `SINGLE` is what float32
    adds.
    """
    turn = rounding(places, np.full(len(places.is_doubtful), 4 * sqrt(3)))
    turn *= places.w.max(axis=0) / places.w.min(axis=0)
    # Of one triangle, so that what holds for all bands of a picture holds for the picture.
    return float(turn.max(initial=0)) / sqrt((1 + 2 * ALIKE) / 3) + SINGLE


def light_error(turn: float, light: PixelLight, brightest: float, encoding: str) -> float:
    """Return how many bytes a lit pixel may be off before rounding.

    Parameters
    ----------
    turn : float
        Angle that normals are off, from `normal_error`.
    brightest : float
        Greatest albedo there is.
    """
    material, strengths = light.material, [max(color) for _, color in light.lights]
    diffuse = material.diffuse * turn * sum(strengths)
    error = _diffuse_bytes(diffuse, material.ambient, brightest, encoding)
    for strength in strengths:
        error += _highlight_bytes(turn, material.specular * strength, material.shininess, encoding)
    return error + TABLE


def _diffuse_bytes(change: float, ambient: float, brightest: float, encoding: str) -> float:
    """Return how many bytes a ``change`` of diffuse light makes where it is at least ``ambient``."""
    if encoding == "linear":
        return 255 * brightest * change
    most = STEEPEST * brightest * change
    return min(most, SHARE * brightest**POWER * ambient ** (POWER - 1) * change) if ambient > 0 else most


def _highlight_bytes(turn: float, strength: float, exponent: float, encoding: str) -> float:
    """Return how many bytes a highlight of so much light changes by if its angle changes by ``turn``."""
    if strength == 0:
        return 0.0
    # A root of the cosine is infinitely steep at a right angle.
    fastest = np.sqrt(exponent) if exponent >= 1 else np.inf
    change = turn * fastest + SINGLE * exponent
    if encoding == "linear":
        return float(255 * strength * change)
    most = STEEPEST * strength * change
    damped = POWER * exponent
    if damped >= 1:
        relative = exponent * (turn / np.sqrt(damped) + SINGLE)
        most = min(most, SHARE * strength**POWER * relative)
    return float(most)
