"""Phong's shading of one colour from packed normals: what it needs of a pixel is a direction (``packed_normals``).

The direction to the eye follows from the pixel alone. Then the lighting rule is evaluated in float32 (``pixel_light``),
and linear light becomes bytes through a table.

Used where the bytes stay within `TOLERANCE` of those of ``render`` before both are rounded: see ``light_errors``.
"""

from dataclasses import dataclass

import numpy as np

from core.framebuffer.nearest import NearestFragments
from core.integer_planes import IntegerPlanes
from core.picture.job import Job, blocks
from core.picture.light_errors import light_error, normal_error
from core.picture.packed_normals import corner_w, pack_normals, unit_normals
from core.picture.pixel_light import PixelLight, lit_pixels, pixel_light
from core.scene import DirectionalLight, Scene

TOLERANCE = 1.0
"""Bytes that a colour may be away from the exact one before both are rounded."""


@dataclass(frozen=True, eq=False)
class LitNormals:
    """Normals of P triangles in camera space, packed, and what lights them."""

    planes: IntegerPlanes
    light: PixelLight
    albedo: tuple[np.float32, ...]
    """Linear grey, or red, green and blue, of everything."""
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
            normal = unit_normals(self.planes, job, primitive, column, row)
            job.pixels[place] = lit_pixels(job, self.albedo, *self.light.at(job, normal, column, row))
        return seen_count


def lit_normals(job: Job) -> LitNormals | None:
    """Return the lit normals of all primitives, or ``None`` where some pixel could be off by more than the tolerance.

    The scene is one mesh of one colour without a texture, lit from far away, all of it in front of the eye.
    """
    if job.has_texture:
        return None
    found = lit_color(job)
    if found is None:
        return None
    light, albedo = found
    geometry = job.geometry
    if error_of(job, albedo) > TOLERANCE:
        return None
    w = corner_w(geometry)
    x, y = geometry.window_x, geometry.window_y
    planes = pack_normals(job, light.camera, w, x, y, geometry.doubled_area)
    return None if planes is None else LitNormals(planes, light, albedo)


def lit_color(job: Job) -> tuple[PixelLight, tuple[np.float32, ...]] | None:
    """Return the light of a job and the colour (1 or 3) that all vertices have, or ``None``.

    The scene is one mesh, opaque, shaded by Phong's method, lit from far away, all of it in front of the eye.
    """
    scene, geometry, settings = job.scene, job.geometry, job.settings
    if not isinstance(scene, Scene) or settings.shading != "phong" or len(scene.meshes) != 1:
        return None
    if settings.interpolation != "perspective" or not geometry.is_projected.all():
        return None
    values = geometry.primitives.values
    colors = values.rows[:, values.layout["color"]]
    if not len(colors) or (colors != colors[:1]).any() or colors[0, 3] != 1:
        return None
    light = pixel_light(scene)
    if light is None:
        return None
    red, green, blue = (np.float32(part) for part in colors[0, :3])
    return light, (red,) if red == green == blue else (red, green, blue)


def error_of(job: Job, albedo: tuple[np.float32, ...], texture_error: float = 0.0) -> float:
    """Return how many bytes a pixel may be off before rounding; ``texture_error`` is what the albedo adds."""
    scene = job.scene
    assert isinstance(scene, Scene)
    lights = tuple(light for light in scene.lights if isinstance(light, DirectionalLight))
    turn = normal_error(job.geometry)
    brightest = float(max(albedo))
    return light_error(turn, scene.meshes[0].material, lights, brightest, job.encoding) + texture_error
