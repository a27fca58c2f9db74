"""Phong's shading from packed normals: what it needs of a pixel is a direction, and that is linear over the window.

A normal divided by w is linear over the window, and dividing all of it by one number does not turn it; so the three
components are packed into one 64-bit word, looked up for every visible pixel by three reads, and made a unit vector
there: perspective-correct without a division by w. The direction to the eye follows from the pixel alone. Then the
lighting rule (``lighting``: Blinn-Phong) is evaluated in float32, and linear light becomes bytes through a table.

Used where the bytes stay within `TOLERANCE` of those of ``render`` before both are rounded: see `error_bound`.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from core.arrays import Floats, Integers, Singles, read_only
from core.framebuffer.display import encode_linear, encode_srgb
from core.framebuffer.nearest import NearestFragments
from core.geometry.matrices import world_to_camera
from core.geometry_record import Geometry
from core.integer_planes import FieldPlane, IntegerPlanes, integer_planes, window_slopes
from core.picture.job import Job, Words, blocks
from core.raster.spans.arena import Arena
from core.scene import Camera, DirectionalLight, Material, Scene

TOLERANCE = 1.0
"""Bytes that a colour may be away from the exact one before both are rounded."""
BITS = 19
"""Bits of the fraction of a component."""
OFFSET = 1.25
"""Added to components, from -1 to 1, so that they are positive by more than rounding."""
FIELD = 21
"""Bits from one component to the next."""
ALIKE = 0.2
"""Least cosine between the normals of a triangle: with less, those between them become too short."""
RATIO = 2.0
"""Largest ratio of w within a triangle, likewise."""
STEEPEST = 2.0**60
"""Units of a component a pixel; steeper planes are seen edge-on."""
LEVELS = 1 << 14
"""Linear colours that are told apart."""


@dataclass(frozen=True, eq=False)
class LitNormals:
    """Normals of P triangles in camera space, packed, and what lights them."""

    planes: IntegerPlanes
    material: Material
    albedo: tuple[float, ...]
    """Linear red, green and blue of everything."""
    lights: tuple[tuple[Singles, tuple[float, ...]], ...]
    """Per light the unit direction to it in camera space, (3,) float32, and its colour."""
    camera: Camera
    name = "normals"
    stage = "shade"

    def look_up(self, job: Job, nearest: NearestFragments) -> int:
        """Write the lit colour of what is seen at every pixel, and return how many there are; the others stay."""
        seen_count = 0
        for part in blocks(len(job.pixels)):
            place, primitive = nearest.seen_in(part)
            if not len(place):
                continue
            seen_count += len(place)
            column, row = job.raster.position(place)
            word = self.planes.at(primitive, column, row)
            normal = _unit(_components(word, job.arena), job.arena)
            job.pixels[place] = self._light(job, normal, self._to_eye(job, column, row))
        return seen_count

    def _to_eye(self, job: Job, column: Integers, row: Integers) -> Singles:
        """Return the unit directions (3, F) float32 from pixels to the eye, in camera space."""
        direction: Singles = job.arena("to_eye", 3, len(column), dtype=np.float32)
        if self.camera.projection == "orthographic":
            direction[:2], direction[2] = 0, 1
            return direction
        (width, height), center = job.scene.size, job.raster.center
        half_height = float(np.tan(self.camera.field_of_view / 2))
        pixel = np.float32(2 * half_height / height)
        np.copyto(direction[0], column, casting="unsafe")
        np.copyto(direction[1], row, casting="unsafe")
        direction[0] -= np.float32(width / 2 - center)
        direction[1] -= np.float32(height / 2 - center)
        direction[:2] *= -pixel
        direction[2] = 1
        return _unit(direction, job.arena)

    def _light(self, job: Job, normal: Singles, to_eye: Singles) -> Words:
        """Return the pixels (F,) uint32 of points with unit normals and directions (3, F)."""
        arena, material, count = job.arena, self.material, normal.shape[1]
        is_gray = all(len(set(color)) == 1 for _, color in self.lights)
        channels = 1 if is_gray else 3
        diffuse, specular = (arena(f"light_{name}", channels, count, dtype=np.float32) for name in ("d", "s"))
        diffuse.fill(material.ambient)
        specular.fill(0)
        for to_light, color in self.lights:
            cosine, power = self._terms(normal, to_eye, to_light, arena)
            for channel in range(channels):
                if len(self.lights) == 1 and channel == channels - 1:
                    product = cosine
                else:
                    product = arena("light_product", count, dtype=np.float32)
                np.multiply(cosine, np.float32(material.diffuse * color[channel]), out=product)
                diffuse[channel] += product
                if material.specular:
                    np.multiply(power, np.float32(material.specular * color[channel]), out=product)
                    specular[channel] += product
        return self._bytes(job, diffuse, specular)

    def _terms(
        self, normal: Singles, to_eye: Singles, to_light: Singles, arena: Arena
    ) -> tuple[Singles, Singles]:
        """Return the cosine to a light, 0 or more, and the power of the highlight, (F,) float32 each."""
        cosine = _dot(normal, to_light, arena("cosine", normal.shape[1], dtype=np.float32), arena)
        power = arena("power", normal.shape[1], dtype=np.float32)
        if self.material.specular:
            half = arena("half", *normal.shape, dtype=np.float32)
            np.add(to_eye, to_light[:, None], out=half)
            _dot(normal, _unit(half, arena), power, arena)
            np.maximum(power, np.float32(1e-30), out=power)
            np.log2(power, out=power)
            power *= np.float32(self.material.shininess)
            np.exp2(power, out=power)
            power *= cosine > 0
        np.maximum(cosine, np.float32(0), out=cosine)
        return cosine, power

    def _bytes(self, job: Job, diffuse: Singles, specular: Singles) -> Words:
        """Return the pixels (F,) uint32 of diffuse and specular light (1 or 3, F); the light is used up."""
        arena, count = job.arena, diffuse.shape[1]
        is_gray = len(diffuse) == 1 and len(set(self.albedo)) == 1
        level = arena("level", count, dtype=np.float32)
        index = arena("level_index", count, dtype=np.int64)
        pixels, byte = (arena(f"level_{name}", count, dtype=np.uint32) for name in ("pixels", "byte"))
        tables = level_words(job.encoding)
        for channel in range(1 if is_gray else 3):
            source = min(channel, len(diffuse) - 1)
            np.multiply(diffuse[source], np.float32(self.albedo[channel]), out=level)
            level += specular[source]
            level *= np.float32(LEVELS - 1)
            level += np.float32(0.5)
            np.minimum(level, np.float32(LEVELS - 1), out=level)
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


def _components(word: Integers, arena: Arena) -> Singles:
    """Return the components (3, F) float32 of packed normals (F,) int64."""
    components = arena("components", 3, len(word), dtype=np.float32)
    field = arena("field", len(word), dtype=np.int64)
    for axis, component in enumerate(components):
        np.right_shift(word, FIELD * axis, out=field)
        field &= (1 << FIELD) - 1
        np.copyto(component, field, casting="unsafe")
    components *= np.float32(2.0**-BITS)
    components -= np.float32(OFFSET)
    return components


def _dot(a: Singles, b: Singles, out: Singles, arena: Arena) -> Singles:
    """Write the dot products (F,) of vectors (3, F) with others, (3, F) or (3,)."""
    part = arena("dot_part", len(out), dtype=np.float32)
    np.multiply(a[0], b[0], out=out)
    for axis in (1, 2):
        np.multiply(a[axis], b[axis], out=part)
        out += part
    return out


def _unit(vectors: Singles, arena: Arena) -> Singles:
    """Make vectors (3, F) that are not zero unit, in place, and return them."""
    length = _dot(vectors, vectors, arena("squared_length", vectors.shape[1], dtype=np.float32), arena)
    np.sqrt(length, out=length)
    np.divide(np.float32(1), length, out=length)
    vectors *= length
    return vectors


def lit_normals(job: Job) -> LitNormals | None:
    """Return the lit normals of all primitives, or ``None`` where some pixel could be off by more than the tolerance.

    The scene is one mesh of one colour without a texture, lit from far away, all of it in front of the eye.
    """
    scene, geometry, settings = job.scene, job.geometry, job.settings
    if not isinstance(scene, Scene) or settings.shading != "phong" or len(scene.meshes) != 1:
        return None
    mesh = scene.meshes[0]
    if mesh.texture is not None or settings.interpolation != "perspective" or not geometry.is_projected.all():
        return None
    values = geometry.primitives.values
    colors = values.rows[:, values.layout["color"]]
    if (colors != colors[:1]).any() or (colors[:1, 3] != 1).any():
        return None
    if not all(isinstance(light, DirectionalLight) for light in scene.lights):
        return None
    rotation = world_to_camera(scene.camera)[:3, :3]
    normal = values.rows[:, values.layout["normal"]] @ rotation.T
    corners = [np.ascontiguousarray(normal.T).take(index, axis=1) for index in values.index]
    w = [geometry.primitives.vertex_clip[3].take(index) for index in geometry.primitives.corner]
    least = np.minimum(np.minimum(w[0], w[1]), w[2])
    greatest = np.maximum(np.maximum(w[0], w[1]), w[2])
    alike = [_cosine(corners[a], corners[b]) for a, b in ((0, 1), (1, 2), (2, 0))]
    albedo = tuple(float(part) for part in colors[0, :3])
    lights = tuple(
        (_direction(light, rotation), tuple(float(part) for part in light.color))
        for light in scene.lights
        if isinstance(light, DirectionalLight)
    )
    error = error_bound(geometry, scene, albedo, job.encoding)
    if not (
        min(float(of.min(initial=1)) for of in alike) >= ALIKE
        and float((greatest / least).max(initial=1)) <= RATIO
        and error <= TOLERANCE
    ):
        return None
    for corner, of_corner in zip(corners, w, strict=True):
        corner *= least / of_corner
    planes = _pack(geometry, corners, job.raster.center)
    return None if planes is None else LitNormals(planes, mesh.material, albedo, lights, scene.camera)


def _cosine(a: Floats, b: Floats) -> Floats:
    """Return the cosines (P,) between unit vectors (3, P); zero vectors have 0 with all others."""
    cosine: Floats = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    return cosine


def _direction(light: DirectionalLight, rotation: Floats) -> Singles:
    """Return the unit vector (3,) float32 to a light in camera space."""
    to_light = -(rotation @ light.direction)
    direction: Singles = (to_light / np.linalg.norm(to_light)).astype(np.float32)
    return direction


def error_bound(geometry: Geometry, scene: Scene, albedo: tuple[float, ...], encoding: str) -> float:
    """Return how many bytes a pixel may be off before rounding.

    Notes
    -----
    A component of the packed normal drifts by half of its last bit a pixel from corner 0, and the shortest
    interpolated normal has length sqrt((1 + 2 ALIKE) / 3) / RATIO. A unit vector that is off by e changes the cosine
    by e and the highlight by at most shininess * e; in bytes this is 255 times as much, or the slope of sRGB at
    the least light there is, the ambient term.
    """
    # Of one triangle, so that what holds for all bands of a picture holds for the picture.
    across, up = (np.abs(of[1:] - of[0]).max(axis=0) for of in (geometry.window_x, geometry.window_y))
    reach = float((across + up).max(initial=0)) + 2
    turn = np.sqrt(3) * reach * 2.0 ** -(BITS + 1) * RATIO / np.sqrt((1 + 2 * ALIKE) / 3)
    material = scene.meshes[0].material
    strength = sum(max(float(light.color.max()), 0.0) for light in scene.lights)
    change = turn * strength * (material.diffuse * max(albedo) + material.specular * material.shininess)
    return float(change * _slope(material.ambient * min(albedo), encoding)) + 0.25


def _slope(linear: float, encoding: str) -> float:
    """Return how many bytes the encoding rises by per unit of light above ``linear``, at most."""
    if encoding == "linear":
        return 255.0
    if linear <= 0.0031308:
        return 255 * 12.92
    return float(255 * 1.055 / 2.4 * linear ** (1 / 2.4 - 1))


def _pack(geometry: Geometry, corners: list[Floats], center: float) -> IntegerPlanes | None:
    """Return the words of normals at the three corners, each (3, P) float64; ``None``: one is too steep."""
    x, y, unit = geometry.window_x, geometry.window_y, 2.0**BITS
    across, up = window_slopes(x, y, geometry.doubled_area, *(corner * unit for corner in corners))
    if not max(float(np.abs(across).max(initial=0)), float(np.abs(up).max(initial=0))) < STEEPEST:
        return None
    fields = [
        FieldPlane((corners[0][axis] + OFFSET) * unit, across[axis], up[axis], FIELD * axis)
        for axis in range(3)
    ]
    return integer_planes(x[0], y[0], center, fields)
