"""Scenes that several processes draw: of every kind that takes a way of its own."""

from dataclasses import replace

import numpy as np

from core import Camera, ClipScene, DirectionalLight, Material, Mesh, PointLight, Scene, Settings, Texture
from core.transform.matrices import camera_axes
from tests.core.meshes import icosphere, torus

SPANS = Settings(fill="spans", depth="fixed-38")


def ball(subdivisions: int = 3, size: tuple[int, int] = (96, 80), eye=(0.4, 0.8, 2.6), **changes) -> Scene:
    positions, triangles = icosphere(subdivisions)
    colors = np.concatenate([np.abs(positions), np.ones((len(positions), 1))], axis=1)
    mesh = Mesh(positions, triangles, normals=positions, colors=colors)
    camera = Camera(np.array(eye), np.zeros(3))
    lights = (DirectionalLight(np.array([-1.0, -1.0, -1.0])), PointLight(np.array([2.0, 2.0, 1.0])))
    return replace(Scene((mesh,), camera, lights, size), **changes)


def plain_ball() -> Scene:
    """Return a ball of one colour under two lights, that is lit pixel by pixel."""
    positions, triangles = icosphere(4)
    return replace(ball(size=(120, 90)), meshes=(Mesh(positions, triangles, normals=positions),))


def textured_ball(with_near_triangle: bool = False) -> Scene:
    """Return a textured ball lit from far away; the triangle above it has a corner hardly before the eye."""
    positions, triangles = icosphere(4)
    normals = positions
    scene = ball(size=(220, 200))
    if with_near_triangle:
        right, up, backward = camera_axes(scene.camera)
        places = ((1.5, -0.5, 0.5), (1.5, 0.5, 0.5), (1e-12, 0.0, 0.9))
        corners = [w * (0.4 * (x * right + y * up) - backward) for w, x, y in places]
        positions = np.concatenate([positions, scene.camera.eye + np.array(corners)])
        normals = np.concatenate([normals, np.tile(backward, (3, 1))])
        triangles = np.concatenate(
            [triangles, [[len(positions) - 3, len(positions) - 2, len(positions) - 1]]]
        )
    texture = Texture(np.random.default_rng(4).random((32, 32, 3), np.float32))
    mesh = Mesh(positions, triangles, normals, uvs=positions[:, :2] * 1.5, texture=texture)
    lights = (DirectionalLight(np.array([-1.0, -1.0, -1.0])),)
    return replace(scene, meshes=(mesh,), lights=lights)


def several_meshes() -> Scene:
    """Return a textured ball, a plain one above it and a ring, lit from far away."""
    ball_of_texture = textured_ball()
    positions, triangles = torus(24, 12)
    above = np.eye(4)
    above[1, 3] = 0.9
    meshes = (
        ball_of_texture.meshes[0],
        replace(plain_ball().meshes[0], transform=above),
        Mesh(positions * 1.3, triangles),
    )
    return replace(ball_of_texture, meshes=meshes)


def on_endless_floor() -> Scene:
    """Return several meshes on a floor of two triangles that reach behind the eye."""
    scene = several_meshes()
    corners = np.array([[-9.0, -0.8, -9.0], [-9.0, -0.8, 9.0], [9.0, -0.8, 9.0], [9.0, -0.8, -9.0]])
    return replace(scene, meshes=(*scene.meshes, Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]))))


def textured_rings() -> Scene:
    positions, triangles = torus(24, 12)
    generator = np.random.default_rng(3)
    texture = Texture(generator.random((16, 16, 3), np.float32))
    uvs = generator.random((len(positions), 2)) * 2
    first = Mesh(positions, triangles, uvs=uvs, texture=texture)
    return Scene(
        (first, replace(first, transform=np.diag([0.7, 0.7, 2.0, 1.0])), ball().meshes[0]),
        Camera(np.array([0.3, 0.2, 1.2]), np.zeros(3), near=0.5),
        (PointLight(np.array([1.0, 2.0, 2.0])),),
        (101, 67),
        np.array([0.1, 0.2, 0.3, 1.0]),
    )


def shiny_rings(size: tuple[int, int] = (140, 110)) -> Scene:
    """Return two rings through each other, one with colours at its corners, under a sharp light."""
    positions, triangles = torus(40, 20)
    colors = np.concatenate([0.5 + 0.4 * np.sin(9 * positions), np.ones((len(positions), 1))], axis=1)
    turned = np.array([[1.0, 0, 0, 0.7], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
    first = Mesh(positions, triangles, material=Material(0.1, 0.8, 0.6, 30.0))
    second = Mesh(positions, triangles, colors=colors, transform=turned)
    lights = (DirectionalLight(np.array([-1.0, -1.0, -1.0])),)
    return replace(ball(size=size, eye=(0.6, 1.8, 2.6)), meshes=(first, second), lights=lights)


def loose_triangles(count: int, size: tuple[int, int]) -> ClipScene:
    generator = np.random.default_rng(count)
    clip = generator.normal(0.0, 1.0, (count, 3, 4))
    clip[:, :, 3] = generator.uniform(-0.2, 2.0, (count, 3))
    return ClipScene(clip, generator.random((count, 3, 4)), size)


def textured_sheets() -> Scene:
    """Return two sheets below, one behind the other, and one above: only the lower half has two layers."""
    sheets = [(-1.0, -0.7, 0.0), (-0.97, -0.72, 0.1), (-0.5, 0.97, 0.1)]
    positions = np.array(
        [
            corner
            for low, high, z in sheets
            for corner in ((-1, low, z), (1, low, z), (1, high, z), (-1, high, z))
        ]
    )
    triangles = np.array(
        [[4 * k + i for i in corners] for k in range(3) for corners in ((0, 1, 2), (0, 2, 3))]
    )
    uvs = np.tile([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], (3, 1))
    texture = Texture(np.random.default_rng(1).random((64, 64, 3), np.float32))
    mesh = Mesh(positions, triangles, uvs=uvs, texture=texture)
    return Scene((mesh,), Camera(np.array([0.2, 0.3, 2.9]), np.zeros(3)), (), (512, 512))


def smooth_below_and_steep_above() -> ClipScene:
    """Return two triangles: bytes are right for the lower one, not for the upper one, whose w differ a lot."""
    clip = np.array(
        [
            [[-1.0, -1.0, 0, 1], [1, -1, 0, 1], [0, -0.8, 0, 1]],
            [[-9.0, 4.5, 0, 9], [1, 0.5, 0, 1], [0, 0.9, 0, 1]],
        ]
    )
    colors = np.array([[0.5, 0.5, 0.5, 1], [0.52, 0.5, 0.5, 1], [0.5, 0.52, 0.5, 1]])
    bright = np.array([[1.0, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1]])
    return ClipScene(clip, np.stack([colors, bright]), (60, 90))


def behind_the_eye_below_and_smooth_above() -> ClipScene:
    """Return a triangle that reaches behind the eye, and before its upper part one whose colours may be bytes."""
    clip = np.array(
        [
            [[-1.0, -1, 0, 1], [1, -1, 0, 1], [0, 3, 0, -1]],
            [[-1.0, 0.2, -0.9, 1], [1, 0.2, -0.9, 1], [0, 0.95, -0.9, 1]],
        ]
    )
    bright = np.array([[1.0, 0, 0, 1], [0, 1, 0, 1], [0.3, 0.3, 0.3, 1]])
    colors = np.array([[0.1, 0.1, 0.1, 1], [0.103, 0.1, 0.1, 1], [0.1, 0.104, 0.1, 1]])
    return ClipScene(clip, np.stack([bright, colors]), (160, 120))


def clipped_above_and_see_through_out_of_sight() -> ClipScene:
    """Return two triangles whose colours may be bytes, the upper one clipped, and a see-through one behind the eye."""
    clip = np.array(
        [
            [[-1.0, -1, 0, 1], [1, -1, 0, 1], [0, -0.1, 0, 1]],
            [[-1.0, 0.2, -1.5, 1], [1, 0.2, 0.5, 1], [0, 0.95, 0.5, 1]],
            [[-1.0, -1, 0, -1], [1, -1, 0, -1], [0, 1, 0, -1]],
        ]
    )
    colors = np.array([[0.1, 0.1, 0.1, 1], [0.103, 0.1, 0.1, 1], [0.1, 0.104, 0.1, 1]])
    see_through = colors * [1, 1, 1, 0.5]
    return ClipScene(clip, np.stack([colors, colors, see_through]), (160, 120))


def at_upper_edge() -> ClipScene:
    """Return a triangle whose colours are bytes, and nothing below it."""
    clip = np.array([[[-1.0, 0.8, 0, 1], [1, 0.8, 0, 1], [0, 0.95, 0, 1]]])
    colors = np.array([[0.1, 0.1, 0.1, 1], [0.103, 0.1, 0.1, 1], [0.1, 0.104, 0.1, 1]])
    return ClipScene(clip, colors[None], (160, 120))


SCENES = {
    "ball": (ball(), SPANS),
    "ball, one side drawn": (ball(), replace(SPANS, cull="back", shading="gouraud")),
    "ball in bytes": (ball(5, (200, 200)), replace(SPANS, cull="back", shading="gouraud")),
    "ball in bytes, both sides": (ball(5, (200, 200)), replace(SPANS, shading="gouraud")),
    "ball of flat faces": (ball(), replace(SPANS, shading="flat", depth="z-float32")),
    "ball behind the lower edge": (
        ball(eye=(0.0, 2.0, 2.0), size=(64, 97)),
        replace(SPANS, depth="inverse-w"),
    ),
    "rings with a texture": (textured_rings(), SPANS),
    "smooth below, steep above": (smooth_below_and_steep_above(), SPANS),
    "behind the eye below, smooth above": (behind_the_eye_below_and_smooth_above(), SPANS),
    "smooth at the upper edge": (at_upper_edge(), SPANS),
    "clipped above, see-through out of sight": (
        clipped_above_and_see_through_out_of_sight(),
        replace(SPANS, clipping="sutherland-hodgman"),
    ),
    "shiny rings, some triangles in bytes": (shiny_rings(), replace(SPANS, shading="gouraud")),
    "two layers in one band": (textured_sheets(), replace(SPANS, cull="back", shading="unlit")),
    "wireframe": (textured_rings(), replace(SPANS, polygon_mode="wireframe")),
    "blended": (loose_triangles(60, (50, 41)), replace(SPANS, blend="over")),
    "painter": (loose_triangles(60, (50, 41)), replace(SPANS, visibility="painters")),
    "another fill": (textured_rings(), Settings(fill="blocks")),
    "through the eye": (loose_triangles(200, (64, 64)), SPANS),
    "clipped": (loose_triangles(200, (64, 33)), replace(SPANS, clipping="sutherland-hodgman")),
    "two rows": (loose_triangles(40, (300, 2)), SPANS),
    "one row": (loose_triangles(40, (300, 1)), SPANS),
    "ball of one colour": (plain_ball(), replace(SPANS, cull="back")),
    "textured ball": (textured_ball(), replace(SPANS, cull="back")),
    "textured ball below a near triangle": (textured_ball(True), replace(SPANS, cull="back")),
    "several meshes under far lights": (several_meshes(), SPANS),
    "meshes on an endless floor": (on_endless_floor(), SPANS),
    "multisampled": (textured_rings(), replace(SPANS, antialiasing="msaa-4")),
    "nothing": (ball(eye=(0.0, 0.0, 90.0), size=(9, 9)), SPANS),
}
