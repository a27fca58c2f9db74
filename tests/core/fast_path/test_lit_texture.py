"""Phong with a texture in single precision: within a byte of the buffers, and used only where that is known."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Camera, DirectionalLight, Material, Mesh, Scene, Settings, Texture, draw_picture
from core.fast_path.lit import position_error
from core.fast_path.lit_planes import CornerPlaces
from core.methods import table
from lessons.shapes import knot, sphere, torus
from tests.core.fast_path.references import assert_lit, noise
from tests.covering import every_pair

LIGHTS = (
    DirectionalLight(np.array([0.4, -0.8, -0.7]), np.full(3, 0.75)),
    DirectionalLight(np.array([-0.9, -0.1, -0.3]), np.array([0.3, 0.2, 0.1])),
)
CAMERA = Camera(np.array([1.0, 0.8, 3.0]), np.zeros(3))
BACKGROUND = np.array([0.1, 0.2, 0.3, 1.0])


def scene_of(
    mesh: Mesh, texture: Texture | None = None, camera: Camera = CAMERA, lights=LIGHTS, size=(160, 120)
) -> Scene:
    textured = replace(mesh, texture=noise() if texture is None else texture)
    return Scene((textured,), camera, lights, size, BACKGROUND)


@every_pair(wrap=table.names("wrap"), channels=[1, 3, 4], shape=[(16, 32), (7, 5), (1, 1), (3, 64)])
def test_every_wrap_of_every_texture(wrap: str, channels: int, shape: tuple[int, int]) -> None:
    mesh = torus()
    assert mesh.uvs is not None
    texture = noise(*shape, channels)
    assert_lit(
        scene_of(replace(mesh, uvs=3 * mesh.uvs - 1.2), texture, size=(90, 70)), chosen=Settings(wrap=wrap)
    )


@pytest.mark.parametrize("color", [(1.0, 1.0, 1.0), (0.5, 0.5, 0.5), (0.9, 0.4, 0.0)])
@pytest.mark.parametrize("channels", [1, 3])
@pytest.mark.parametrize("lights", [(), LIGHTS[:1], LIGHTS], ids=len)
def test_one_colour_times_the_texture(color, channels: int, lights) -> None:
    mesh = sphere()
    colors = np.tile([*color, 1.0], (len(mesh.positions), 1))
    assert_lit(scene_of(replace(mesh, colors=colors), noise(channels=channels), lights=lights))


@given(
    st.floats(-3, 3),
    st.floats(-3, 3),
    st.floats(2.5, 6),
    st.sampled_from(["perspective", "orthographic"]),
    st.floats(0.02, 0.4),
    st.floats(0, 0.6),
    st.floats(1, 60),
    st.integers(0, 99),
)
def test_any_view_of_any_material(
    x: float,
    y: float,
    z: float,
    projection: str,
    ambient: float,
    specular: float,
    shininess: float,
    seed: int,
) -> None:
    mesh = replace(knot(columns=150, rows=16), material=Material(ambient, 0.7, specular, shininess))
    camera = Camera(np.array([x, y, z]), np.zeros(3), projection=projection, view_height=2.5)
    assert_lit(scene_of(mesh, noise(seed=seed), camera))


@pytest.mark.parametrize("region", [(0, 0, 160, 40), (33, 21, 50, 60), (159, 119, 1, 1)])
def test_a_part_has_the_bytes_of_the_whole(region: tuple[int, int, int, int]) -> None:
    scene = scene_of(torus())
    column, row, columns, rows = region
    whole = draw_picture(scene).pixels[row : row + rows, column : column + columns]
    part = draw_picture(scene, region=region)
    assert np.array_equal(part.pixels, whole)


def test_a_piece_without_area_forbids_nothing() -> None:
    """Clipping leaves a piece that snapping makes a point: it covers no pixel, and nothing is divided by its area."""
    clipped = Settings(clipping="sutherland-hodgman")
    camera = Camera(np.array([0.0, 0.0, 3.0]), np.zeros(3), near=2.5)
    # All but a tip is nearer than the near plane.
    flat = np.array([[-0.1, 0.0, 0.7], [0.1, 0.0, 0.7], [0.0, 0.1, 0.5 - 1e-7]])
    ball = sphere()
    assert ball.normals is not None
    assert ball.uvs is not None
    mesh = Mesh(
        np.concatenate([0.4 * ball.positions, flat]),
        np.concatenate([ball.triangles, [np.arange(3) + len(ball.positions)]]),
        np.concatenate([ball.normals, np.tile([0.0, 0.0, 1.0], (3, 1))]),
        uvs=np.concatenate([ball.uvs, flat[:, :2]]),
    )
    assert_lit(scene_of(mesh, camera=camera), chosen=clipped)


def test_how_far_positions_are_off_is_asked_of_one_triangle_at_a_time() -> None:
    """What all bands of a picture allow the picture must allow: no mix of one triangle's texels, another's place."""
    x = np.array([[1.0, 9000.0], [3.0, 9100.0], [2.0, 9050.0]])
    y = np.array([[1.0, 9000.0], [1.0, 9000.0], [4.0, 9100.0]])
    area = np.array([6.0, 10000.0])
    across = [np.array([0.0, 0.0]), np.array([1e5, 1.0]), np.array([0.0, 0.0])]
    both = position_error(
        CornerPlaces(x, y, np.ones((3, 2)), area, np.zeros(2, bool)), [across, 3 * [np.zeros(2)]]
    )
    alone = [
        position_error(
            CornerPlaces(x[:, part], y[:, part], np.ones((3, 1)), area[part], np.zeros(1, bool)),
            [[of[part] for of in across], 3 * [np.zeros(1)]],
        )
        for part in (slice(0, 1), slice(1, 2))
    ]
    assert both == max(alone)


@pytest.mark.parametrize(
    "texture_filter", [name for name in table.names("texture_filter") if name != "bilinear"]
)
def test_other_filters_are_looked_up_as_in_the_buffers(texture_filter: str) -> None:
    scene, chosen = scene_of(sphere()), Settings(texture_filter=texture_filter)
    assert draw_picture(scene, chosen).route.color == "deferred"
