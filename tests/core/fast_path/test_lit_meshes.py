"""Phong's shading of several meshes: each within a byte of the buffers, and used only where all of them allow it."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Camera, DirectionalLight, Material, Mesh, PointLight, Scene, Settings, Texture, draw_picture
from core.fast_path.lit import MOST
from lessons.shapes import cube, sphere, torus
from tests.core.fast_path.references import PHONG, assert_deferred, assert_lit
from tests.covering import every_pair

LIGHTS = (DirectionalLight(np.array([0.4, -0.8, -0.7])), DirectionalLight(np.array([-0.9, -0.1, -0.3])))
CAMERA = Camera(np.array([1.0, 1.2, 3.4]), np.zeros(3))
TEXTURE = Texture(np.random.default_rng(3).random((32, 16, 3)).astype(np.float32))


def at(mesh: Mesh, x: float, y: float, z: float, scale: float = 1.0) -> Mesh:
    transform = np.diag([scale, scale, scale, 1.0])
    transform[:3, 3] = x, y, z
    return replace(mesh, transform=transform)


def colored(mesh: Mesh, *color: float) -> Mesh:
    return replace(mesh, colors=np.tile([*color, 1.0], (len(mesh.positions), 1)))


def textured(mesh: Mesh) -> Mesh:
    return replace(colored(mesh, 1.0, 1.0, 1.0), uvs=mesh.positions[:, :2] * 2, texture=TEXTURE)


def of_vertex_colors(mesh: Mesh, channels: int) -> Mesh:
    colors = np.ones((len(mesh.positions), 4))
    colors[:, :3] = np.random.default_rng(2).random((len(colors), channels))
    return replace(mesh, colors=colors)


def see_through(mesh: Mesh) -> Mesh:
    return replace(mesh, colors=np.random.default_rng(2).random((len(mesh.positions), 4)))


def of_materials() -> tuple[Mesh, ...]:
    materials = (Material(0.1, 0.8, 0.0, 1.0), Material(0.3, 0.2, 0.6, 32.0), Material(0.2, 0.7, 0.2, 5.0))
    return tuple(
        replace(at(colored(sphere(), *color), k - 1.0, 0.3 * k, 0.5 * k, 0.6), material=material)
        for k, (material, color) in enumerate(
            zip(materials, ((0.9, 0.2, 0.1), (0.5, 0.5, 0.5), (0.1, 0.4, 0.8)), strict=True)
        )
    )


def floor(half: float) -> Mesh:
    corners = [[-half, -0.8, -half], [-half, -0.8, half], [half, -0.8, half], [half, -0.8, -half]]
    return Mesh(np.array(corners), np.array([[0, 1, 2], [0, 2, 3]]))


MESHES = {
    "two of one colour": (
        colored(torus(), 0.8, 0.5, 0.3),
        at(colored(sphere(), 0.2, 0.5, 0.9), 0.5, 0, 0.5, 0.7),
    ),
    "one mesh twice": (torus(), at(torus(), 0.2, 0.9, 0.1)),
    "one of one colour, one with a texture": (colored(torus(), 0.8, 0.5, 0.3), textured(sphere(0.6))),
    "colours of vertices, opaque and unlike": (
        of_vertex_colors(sphere(), 3),
        at(of_vertex_colors(torus(), 1), 0.5, 0, 0.5, 0.7),
    ),
    "two textures": (
        textured(torus()),
        replace(textured(sphere(0.6)), texture=Texture(np.ones((2, 2, 1), np.float32))),
    ),
    "materials": of_materials(),
    "one hides the other": (sphere(), sphere(0.5)),
    "on a floor of two triangles": (colored(torus(), 0.8, 0.5, 0.3), floor(2.0)),
    "on a floor that reaches behind the eye": (colored(torus(), 0.8, 0.5, 0.3), textured(floor(9.0))),
    "one beside the window": (sphere(), at(sphere(), 60.0, 0, 0)),
}


def box_of_eight_vertices() -> Mesh:
    """A box whose faces share their vertices: the normals at the ends of every diagonal are unlike."""
    corners = (
        np.stack(np.meshgrid([-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0], indexing="ij"), -1).reshape(8, 3) * 0.5
    )
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [(a, b, c) for p, q, r, s in quads for a, b, c in ((p, q, r), (p, r, s))]
    return Mesh(corners, np.array(triangles), corners / np.linalg.norm(corners, axis=1, keepdims=True))


def test_one_mesh_of_unlike_normals_among_many_triangles_forbids_nothing() -> None:
    """Nor does it in a part of the picture that shows it alone."""
    scene = scene_of((colored(sphere(), 0.8, 0.5, 0.3), at(box_of_eight_vertices(), 1.2, 0.4, 0.5)))
    assert_close(scene, "srgb")
    whole = draw_picture(scene, PHONG).pixels
    for region in ((140, 0, 60, 150), (0, 0, 60, 150)):
        part = draw_picture(scene, PHONG, region=region)
        assert part.route.allowed == "lit"
        assert np.array_equal(part.pixels, whole[:, region[0] : region[0] + region[2]])
    alone = draw_picture(scene_of((box_of_eight_vertices(),)), PHONG)
    assert alone.route.color == "deferred"


def scene_of(meshes: tuple[Mesh, ...], lights=LIGHTS, camera: Camera = CAMERA, size=(200, 150)) -> Scene:
    return Scene(meshes, camera, lights, size, np.array([0.1, 0.2, 0.3, 1.0]))


def assert_close(scene: Scene, encoding: str, chosen: Settings = PHONG) -> None:
    picture = assert_lit(scene, encoding, chosen)
    background = draw_picture(
        replace(scene, meshes=(at(sphere(), 60, 0, 0),)), chosen, encoding=encoding
    ).pixels
    assert picture.route.visible >= np.count_nonzero((picture.pixels != background).any(axis=2))


@every_pair(encoding=["srgb", "linear"], cull=["none", "back"], name=list(MESHES))
def test_every_mesh_is_lit_as_in_the_buffers(name: str, cull: str, encoding: str) -> None:
    assert_close(scene_of(MESHES[name]), encoding, replace(PHONG, cull=cull))


@given(st.sampled_from(list(MESHES)), st.floats(-3, 3), st.floats(-0.5, 3), st.floats(2.2, 6))
def test_any_view(name: str, x: float, y: float, z: float) -> None:
    assert_close(scene_of(MESHES[name], camera=Camera(np.array([x, y, z]), np.zeros(3))), "srgb")


@pytest.mark.parametrize("name", list(MESHES))
def test_a_region_is_that_part_of_the_picture(name: str) -> None:
    scene = scene_of(MESHES[name])
    whole = draw_picture(scene, PHONG).pixels
    part = draw_picture(scene, PHONG, region=(20, 30, 111, 70))
    assert np.array_equal(part.pixels, whole[30:100, 20:131])


@pytest.mark.parametrize(
    ("scene", "chosen"),
    [
        (scene_of((torus(), see_through(sphere()))), PHONG),
        (scene_of((torus(), sphere()), (PointLight(np.array([2.0, 2.0, 2.0])),)), PHONG),
        (scene_of((torus(), textured(sphere()))), replace(PHONG, texture_filter="nearest")),
        (scene_of(tuple(at(cube(), k % 9, k // 9, 0, 0.1) for k in range(MOST + 1))), PHONG),
        (
            scene_of((torus(), sphere()), camera=replace(CAMERA, near=3.4)),
            replace(PHONG, clipping="sutherland-hodgman"),
        ),
    ],
    ids=["see-through", "point light", "nearest texel", "many meshes", "cut by the near plane"],
)
def test_otherwise_attributes_and_light_come_from_every_pixel(scene: Scene, chosen: Settings) -> None:
    assert_deferred(scene, chosen)


def test_facts_of_one_mesh_are_not_those_of_another() -> None:
    """Drawn one after the other with the same meshes in another order, and with one of them alone."""
    first, second = MESHES["one of one colour, one with a texture"]
    for meshes in ((first, second), (second, first), (first, second)):
        assert_close(scene_of(meshes), "srgb")
    for mesh in (first, second):
        assert_close(scene_of((mesh,)), "srgb")
