"""Phong in single precision: within a byte of the buffers, and used only where that is known."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Camera, DirectionalLight, Material, Mesh, PointLight, Scene, Settings, draw_picture
from lessons.shapes import sphere, torus
from tests.core.fast_path.references import exact_bytes

LIGHTS = (
    DirectionalLight(np.array([0.4, -0.8, -0.7]), np.full(3, 0.75)),
    DirectionalLight(np.array([-0.9, -0.1, -0.3]), np.array([0.3, 0.2, 0.1])),
)
CAMERA = Camera(np.array([1.0, 0.8, 3.0]), np.zeros(3))
PHONG = Settings(depth="fixed-38")


def scene_of(mesh: Mesh, camera: Camera = CAMERA, lights=LIGHTS, size=(160, 120)) -> Scene:
    return Scene((mesh,), camera, lights, size, np.array([0.1, 0.2, 0.3, 1.0]))


def drawn(scene: Scene, encoding: str, chosen: Settings = PHONG):
    return draw_picture(scene, chosen, encoding=encoding)


def assert_close(scene: Scene, encoding: str, chosen: Settings = PHONG) -> None:
    picture = drawn(scene, encoding, chosen)
    assert picture.route.color == "lit"
    away = np.abs(picture.pixels.astype(int) - exact_bytes(scene, chosen, encoding)).max(axis=2)
    assert away.max() <= 1
    assert (away > 0).mean() < 0.05


@pytest.mark.parametrize("encoding", ["srgb", "linear"])
@pytest.mark.parametrize("cull", ["none", "back", "front"])
@pytest.mark.parametrize("depth", ["fixed-38", "z-float32", "inverse-w"])
def test_a_sphere_is_lit_as_in_the_buffers(encoding: str, cull: str, depth: str) -> None:
    assert_close(scene_of(sphere()), encoding, Settings(depth=depth, cull=cull))


@pytest.mark.parametrize("lights", [(), LIGHTS[:1], LIGHTS[1:], (*LIGHTS, LIGHTS[1])], ids=len)
@pytest.mark.parametrize("specular", [0.0, 0.4])
def test_any_number_of_lights_white_or_coloured(lights, specular: float) -> None:
    mesh = replace(torus(), material=Material(0.2, 0.7, specular, 20.0))
    assert_close(scene_of(mesh, lights=lights), "srgb")


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
    assert_close(scene_of(replace(mesh, colors=colors), camera), "srgb")


@pytest.mark.parametrize("shininess", [3.0, 5.0])
@pytest.mark.parametrize("grazing", [-1e-6, -1e-9, 0.0, 1e-9, 1e-6])
def test_highlights_that_end_abruptly(grazing: float, shininess: float) -> None:
    """A sheet that faces the eye, and light along it: whether it is mirrored or not, less than rounding decides."""
    corners = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])
    normals = np.tile([0.0, 0.0, 1.0], (4, 1))
    sheet = Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]), normals)
    mesh = replace(sheet, material=Material(0.3, 0.3, 1.0, shininess))
    lights = (DirectionalLight(np.array([1.0, 0.3, grazing]), np.ones(3)),)
    assert_close(scene_of(mesh, Camera(np.array([0.2, 0.1, 6.0]), np.zeros(3)), lights), "srgb")


@given(st.integers(0, 999), st.sampled_from([1.0, 5.0, 32.0, 200.0]), st.sampled_from(["srgb", "linear"]))
def test_light_that_comes_from_beyond(seed: int, shininess: float, encoding: str) -> None:
    generator = np.random.default_rng(seed)
    eye = generator.normal(size=3)
    eye *= 3 / np.linalg.norm(eye)
    away = generator.normal(size=3) * generator.choice([0.01, 0.1, 1])
    mesh = replace(torus(), material=Material(0.3, 0.3, 1.0, shininess))
    lights = (DirectionalLight(eye + away, np.ones(3)),)
    assert_close(scene_of(mesh, Camera(eye, np.zeros(3)), lights, (300, 300)), encoding)


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
    assert_close(scene, encoding, replace(PHONG, cull=cull))
    near = Camera(np.array([0.2, 0.1, 1.9]), np.zeros(3), near=1.2)
    assert_close(replace(scene, camera=near), encoding, replace(PHONG, cull=cull))


def without_normals() -> Mesh:
    mesh = sphere()
    return replace(mesh, normals=np.zeros((len(mesh.positions), 3)))


@pytest.mark.parametrize("height", [1.02, 1.002, 1.0001])
def test_a_surface_seen_from_very_near(height: float) -> None:
    """Its triangles are larger than the window, and w at their corners differs by a factor of thousands."""
    camera = Camera(np.array([0.0, 0.03, height]), np.zeros(3), near=1e-6)
    assert_close(scene_of(sphere(), camera), "srgb")
    assert_close(
        scene_of(few_unlike_normals(), camera), "linear", replace(PHONG, clipping="sutherland-hodgman")
    )


def of_many_colors() -> Mesh:
    mesh = sphere()
    colors = np.random.default_rng(2).random((len(mesh.positions), 4))
    return replace(mesh, colors=colors)


def of_color(*color: float) -> Mesh:
    return replace(sphere(), colors=np.tile([*color, 1.0], (len(sphere().positions), 1)))


@pytest.mark.parametrize(
    "scene",
    [
        scene_of(unlike_normals()),
        scene_of(without_normals()),
        scene_of(of_many_colors()),
        scene_of(sphere(), lights=(PointLight(np.array([2.0, 2.0, 2.0])),)),
        scene_of(replace(sphere(), material=Material(0.0, 0.5, 1.0, 10000.0))),
        scene_of(of_color(-0.5, -0.5, -0.5)),
        scene_of(of_color(0.4, -0.8, 0.2)),
        scene_of(sphere(), lights=(*LIGHTS, DirectionalLight(np.array([0.9, -0.3, 0.7]), -np.ones(3)))),
    ],
    ids=[
        "unlike normals",
        "no normals",
        "colours",
        "point light",
        "sharp highlight",
        "all below 0",
        "one below 0",
        "a light that takes light away",
    ],
)
def test_otherwise_attributes_and_light_come_from_every_pixel(scene: Scene) -> None:
    picture = drawn(scene, "srgb")
    assert picture.route.color == "deferred"
    assert np.array_equal(picture.pixels, exact_bytes(scene, PHONG, "srgb"))
