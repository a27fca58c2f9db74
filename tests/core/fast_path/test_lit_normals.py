"""Phong in single precision: within a byte of the buffers, and used only where that is known."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Camera, DirectionalLight, Material, Mesh, PointLight, Scene, Settings, Texture
from lessons.shapes import floor, sphere, torus
from tests.core.fast_path.references import PHONG, assert_deferred, assert_lit, noise
from tests.covering import every_pair

LIGHTS = (
    DirectionalLight(np.array([0.4, -0.8, -0.7]), np.full(3, 0.75)),
    DirectionalLight(np.array([-0.9, -0.1, -0.3]), np.array([0.3, 0.2, 0.1])),
)
CAMERA = Camera(np.array([1.0, 0.8, 3.0]), np.zeros(3))


def scene_of(mesh: Mesh, camera: Camera = CAMERA, lights=LIGHTS, size=(160, 120)) -> Scene:
    return Scene((mesh,), camera, lights, size, np.array([0.1, 0.2, 0.3, 1.0]))


def with_texture(scene: Scene, texture: Texture | None = None) -> Scene:
    """Return a scene whose mesh has a texture."""
    (mesh,) = scene.meshes
    return replace(scene, meshes=(replace(mesh, texture=texture or noise()),))


@every_pair(
    encoding=["srgb", "linear"],
    cull=["none", "back", "front"],
    depth=["fixed-38", "z-float32", "inverse-w"],
    texture=[None, noise()],
)
def test_a_sphere_is_lit_as_in_the_buffers(
    encoding: str, cull: str, depth: str, texture: Texture | None
) -> None:
    assert_lit(scene_of(replace(sphere(), texture=texture)), encoding, Settings(depth=depth, cull=cull))


@pytest.mark.parametrize("lights", [(), LIGHTS[:1], LIGHTS[1:], (*LIGHTS, LIGHTS[1])], ids=len)
@pytest.mark.parametrize("specular", [0.0, 0.4])
def test_any_number_of_lights_white_or_coloured(lights, specular: float) -> None:
    mesh = replace(torus(), material=Material(0.2, 0.7, specular, 20.0))
    assert_lit(scene_of(mesh, lights=lights), "srgb")


@given(
    st.floats(-3, 3),
    st.floats(-3, 3),
    st.floats(2.5, 6),
    st.sampled_from(["perspective", "orthographic"]),
    st.tuples(*[st.floats(0.6, 1)] * 3),
)
def test_any_view_of_one_colour(x: float, y: float, z: float, projection: str, color) -> None:
    mesh = sphere()
    colors = np.tile([*color, 1.0], (len(mesh.positions), 1))
    camera = Camera(np.array([x, y, z]), np.zeros(3), projection=projection, view_height=2.5)
    assert_lit(scene_of(replace(mesh, colors=colors), camera), "srgb")


@every_pair(shininess=[3.0, 5.0], grazing=[-1e-6, -1e-9, 0.0, 1e-9, 1e-6], texture=[None, noise()])
def test_highlights_that_end_abruptly(grazing: float, shininess: float, texture: Texture | None) -> None:
    """A sheet that faces the eye, and light along it: whether it is mirrored or not, less than rounding decides."""
    corners = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])
    normals = np.tile([0.0, 0.0, 1.0], (4, 1))
    sheet = Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]), normals, uvs=corners[:, :2])
    mesh = replace(sheet, texture=texture, material=Material(0.3, 0.3, 1.0, shininess))
    lights = (DirectionalLight(np.array([1.0, 0.3, grazing]), np.ones(3)),)
    assert_lit(scene_of(mesh, Camera(np.array([0.2, 0.1, 6.0]), np.zeros(3)), lights), "srgb")


@given(st.integers(0, 999), st.sampled_from([1.0, 5.0, 32.0, 200.0]), st.sampled_from(["srgb", "linear"]))
def test_light_that_comes_from_beyond(seed: int, shininess: float, encoding: str) -> None:
    generator = np.random.default_rng(seed)
    eye = generator.normal(size=3)
    eye *= 3 / np.linalg.norm(eye)
    away = generator.normal(size=3) * generator.choice([0.01, 0.1, 1])
    mesh = replace(torus(), material=Material(0.3, 0.3, 1.0, shininess))
    lights = (DirectionalLight(eye + away, np.ones(3)),)
    assert_lit(scene_of(mesh, Camera(eye, np.zeros(3)), lights, (300, 300)), encoding)


def unlike_normals() -> Mesh:
    mesh = sphere()
    normals = np.random.default_rng(1).normal(size=(len(mesh.positions), 3))
    return replace(mesh, normals=normals)


def few_unlike_normals() -> Mesh:
    mesh = sphere()
    normals = mesh.positions / np.linalg.norm(mesh.positions, axis=1, keepdims=True)
    chosen = np.random.default_rng(4).choice(len(normals), 20, replace=False)
    normals[chosen] = np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]]).repeat(
        5, axis=0
    )
    return replace(mesh, normals=normals)


@pytest.mark.parametrize("cull", ["none", "back"])
@pytest.mark.parametrize("encoding", ["srgb", "linear"])
def test_triangles_with_unlike_normals_are_coloured_as_in_the_buffers(encoding: str, cull: str) -> None:
    scene = scene_of(few_unlike_normals(), size=(320, 240))
    assert_lit(scene, encoding, replace(PHONG, cull=cull))
    near = Camera(np.array([0.2, 0.1, 1.9]), np.zeros(3), near=1.2)
    assert_lit(replace(scene, camera=near), encoding, replace(PHONG, cull=cull))


def without_normals() -> Mesh:
    mesh = sphere()
    return replace(mesh, normals=np.zeros((len(mesh.positions), 3)))


@pytest.mark.parametrize("height", [1.02, 1.002, 1.0001])
def test_a_surface_seen_from_very_near(height: float) -> None:
    """Its triangles are larger than the window, and w at their corners differs by a factor of thousands."""
    camera = Camera(np.array([0.0, 0.03, height]), np.zeros(3), near=1e-6)
    assert_lit(scene_of(sphere(), camera), "srgb")
    assert_lit(
        scene_of(few_unlike_normals(), camera), "linear", replace(PHONG, clipping="sutherland-hodgman")
    )


def of_many_colors() -> Mesh:
    mesh = sphere()
    colors = np.random.default_rng(2).random((len(mesh.positions), 4))
    return replace(mesh, colors=colors)


def of_color(*color: float) -> Mesh:
    return replace(sphere(), colors=np.tile([*color, 1.0], (len(sphere().positions), 1)))


FAR = replace(sphere(), uvs=sphere().uvs + 1e6)
OTHERWISE = {
    "unlike normals": scene_of(unlike_normals()),
    "no normals": scene_of(without_normals()),
    "colours": scene_of(of_many_colors()),
    "point light": scene_of(sphere(), lights=(PointLight(np.array([2.0, 2.0, 2.0])),)),
    "sharp highlight": scene_of(replace(sphere(), material=Material(0.0, 0.5, 1.0, 10000.0))),
    "all below 0": scene_of(of_color(-0.5, -0.5, -0.5)),
    "one below 0": scene_of(of_color(0.4, -0.8, 0.2)),
    "a light that takes light away": scene_of(
        sphere(), lights=(*LIGHTS, DirectionalLight(np.array([0.9, -0.3, 0.7]), -np.ones(3)))
    ),
}
OTHERWISE |= {
    f"textured: {name}": with_texture(OTHERWISE[name])
    for name in ("no normals", "colours", "point light", "sharp highlight")
}
OTHERWISE |= {
    "far coordinates": with_texture(scene_of(FAR)),
    "through the eye": with_texture(scene_of(floor(8))),
    "root of a cosine": with_texture(scene_of(replace(sphere(), material=Material(0.1, 0.5, 0.5, 0.5)))),
    "transparent": with_texture(scene_of(sphere()), Texture(np.full((2, 2, 4), 0.5, np.float32))),
    "brighter than white": with_texture(scene_of(sphere()), Texture(np.full((2, 2, 3), 1.5, np.float32))),
}
"""What forbids the light of single precision."""


@pytest.mark.parametrize("name", OTHERWISE)
def test_otherwise_attributes_and_light_come_from_every_pixel(name: str) -> None:
    assert_deferred(OTHERWISE[name])
