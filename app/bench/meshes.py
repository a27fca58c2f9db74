"""The workloads that are a mesh before a camera: a sphere, a floor that runs behind the eye, a knot."""

from dataclasses import replace
from math import radians

import numpy as np

from app.bench.random_triangles import DARKEST
from app.bench.records import Bytes, Lighting, MeshFile, ViewedMesh
from app.opengl_check.shapes import icosphere
from core.geometry.matrices import projection, world_to_camera
from core.records.arrays import Floats, Integers
from core.scene import Camera
from lessons import shapes

TO_LIGHT = np.array([0.4, 0.8, 0.45]) / np.linalg.norm([0.4, 0.8, 0.45])
TEXTURE_SIDE = 1024


def lit_sphere() -> ViewedMesh:
    """Return an icosphere of 81,920 triangles with a colour at every vertex, lit at the vertices."""
    positions, normals, triangles = icosphere(6)
    colors = 0.55 + 0.45 * np.sin(5 * positions + np.array([0.0, 2.0, 4.0]))
    return viewed(
        positions,
        triangles,
        normals,
        camera=Camera(eye=np.array([1.1, 0.9, 2.6]), target=np.zeros(3)),
        size=(1024, 1024),
        colors=colors,
        lighting=Lighting(-TO_LIGHT, 0.15, 0.85, 0.0, 1.0, is_per_pixel=False),
    )


def unlike_sphere() -> ViewedMesh:
    """Return the sphere of `lit_sphere` with a random colour at every vertex, as scans have them."""
    sphere = lit_sphere()
    colors = np.random.default_rng(47).uniform(0.1, 1.0, sphere.positions.shape)
    return replace(sphere, colors=colors)


def sphere_file(extension: str) -> MeshFile:
    """Return an icosphere of 327,680 triangles as a file."""
    positions, _, triangles = icosphere(7)
    return MeshFile(positions, triangles, extension)


def textured_floor() -> ViewedMesh:
    """Return a floor of two triangles, one with a corner behind the eye, with a texture of 1024 x 1024 texels."""
    positions = np.array([[-8.0, 0.0, 4.0], [8.0, 0.0, 4.0], [8.0, 0.0, -12.0], [-8.0, 0.0, -12.0]])
    return viewed(
        positions,
        np.array([[0, 1, 2], [0, 2, 3]]),
        np.tile([0.0, 1.0, 0.0], (4, 1)),
        camera=Camera(
            eye=np.array([0.3, 1.6, 3.2]),
            target=np.array([0.0, -0.35, 0.0]),
            up=np.array([0.03, 1.0, 0.0]),
            field_of_view=radians(60),
        ),
        size=(1024, 1024),
        uvs=np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]),
        texture=patterned_texture(),
    )


def textured_knot() -> ViewedMesh:
    """Return a knot of 200,000 triangles with a texture, lit at every pixel, 1920 x 1080."""
    mesh = shapes.knot(columns=2500, rows=40)
    assert mesh.normals is not None
    assert mesh.uvs is not None
    return viewed(
        mesh.positions,
        mesh.triangles,
        mesh.normals,
        camera=Camera(eye=np.array([0.6, 0.9, 4.2]), target=np.zeros(3)),
        size=(1920, 1080),
        uvs=mesh.uvs * np.array([12.0, 1.0]),
        texture=patterned_texture(),
        lighting=Lighting(-TO_LIGHT, 0.15, 0.7, 0.25, 32.0, is_per_pixel=True),
    )


def patterned_texture() -> Bytes:
    """Return (1024, 1024, 3) uint8: squares in red, a ramp in green, noise in blue."""
    side = TEXTURE_SIDE
    row, column = np.mgrid[0:side, 0:side]
    texture = np.empty((side, side, 3), np.uint8)
    texture[..., 0] = 180 * ((column >> 5 ^ row >> 5) & 1) + (column >> 3 & 63)
    texture[..., 1] = row >> 2
    texture[..., 2] = np.random.default_rng(5).integers(0, 256, (side, side))
    return np.maximum(texture, DARKEST)


def viewed(
    positions: Floats,
    triangles: Integers,
    normals: Floats,
    *,
    camera: Camera,
    size: tuple[int, int],
    colors: Floats | None = None,
    uvs: Floats | None = None,
    texture: Bytes | None = None,
    lighting: Lighting | None = None,
) -> ViewedMesh:
    """Put a mesh before a camera: all that a library may ask for, the matrices too."""
    return ViewedMesh(
        positions,
        triangles,
        normals,
        eye=camera.eye,
        target=camera.target,
        up=camera.up,
        field_of_view=camera.field_of_view,
        near=camera.near,
        far=camera.far,
        view=world_to_camera(camera),
        projection=projection(camera, size[0] / size[1]),
        size=size,
        colors=colors,
        uvs=uvs,
        texture=texture,
        lighting=lighting,
    )
