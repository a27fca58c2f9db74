"""A lit sphere without triangles: every pixel's ray meets the sphere itself, and the point is lit with its own normal.

References
----------
T. Whitted, *An improved illumination model for shaded display*, 1980 (ray and sphere).
"""

import numpy as np

from core.fragments.lighting import light_surface
from core.geometry.matrices import camera_axes
from core.records.arrays import Flags, Floats
from core.scene import Camera, Scene


def pixel_rays(camera: Camera, size: tuple[int, int]) -> Floats:
    """Return the directions (H, W, 3) from the eye of a perspective camera through the pixel centres, not unit."""
    width, height = size
    right, up, backward = camera_axes(camera)
    reach = np.tan(camera.field_of_view / 2)
    x = ((np.arange(width) + 0.5) * 2 / width - 1) * reach * width / height
    y = ((np.arange(height) + 0.5) * 2 / height - 1) * reach
    return np.asarray(x[None, :, None] * right + y[:, None, None] * up - backward)


def meet_sphere(eye: Floats, direction: Floats, radius: float) -> tuple[Flags, Floats]:
    """Return where rays meet a sphere around the origin first.

    Parameters
    ----------
    eye : (3,) float64
    direction : (H, W, 3) float64

    Returns
    -------
    meets : (H, W) bool
    position : (H, W, 3) float64, NaN where it is missed
    """
    a = (direction * direction).sum(axis=2)
    half_b = (direction * eye).sum(axis=2)
    inside = half_b * half_b - a * (float(eye @ eye) - radius * radius)
    meets = inside > 0
    distance = (-half_b - np.sqrt(np.where(meets, inside, np.nan))) / a
    return meets, eye + distance[..., None] * direction


def sphere_picture(scene: Scene, radius: float) -> tuple[Flags, Floats]:
    """Return where a sphere around the origin is seen, (H, W) bool, and its colours (H, W, 4) float64.

    Parameters
    ----------
    scene : Scene
        Its camera (perspective), lights, and the material of its first mesh; the surface is white.
    """
    meets, position = meet_sphere(scene.camera.eye, pixel_rays(scene.camera, scene.size), radius)
    seen = position[meets]
    diffuse, specular = light_surface(
        seen, seen / radius, scene.camera.eye, scene.lights, scene.meshes[0].material, False
    )
    color = np.empty((*meets.shape, 4))
    color[:] = scene.background
    color[meets] = np.column_stack([diffuse + specular, np.ones(len(seen))])
    return meets, color
