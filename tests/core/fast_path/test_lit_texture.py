"""Phong with a texture in single precision: within a byte of the buffers, and used only where that is known."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Camera, DirectionalLight, Material, Mesh, PointLight, Scene, Settings, Texture, draw_picture
from core.fast_path.lit.corner_places import CornerPlaces
from core.fast_path.lit.textured import position_error
from core.methods import table
from lessons.shapes import floor, knot, sphere, torus
from tests.core.fast_path.references import exact_bytes
from tests.covering import every_pair

LIGHTS = (
    DirectionalLight(np.array([0.4, -0.8, -0.7]), np.full(3, 0.75)),
    DirectionalLight(np.array([-0.9, -0.1, -0.3]), np.array([0.3, 0.2, 0.1])),
)
CAMERA = Camera(np.array([1.0, 0.8, 3.0]), np.zeros(3))
BACKGROUND = np.array([0.1, 0.2, 0.3, 1.0])


def noise(rows: int = 16, columns: int = 32, channels: int = 3, seed: int = 0) -> Texture:
    """Return a texture of all that a bound has to bear: black beside white, dark beside darker."""
    generator = np.random.default_rng(seed)
    pixels = generator.random((rows, columns, channels)) ** generator.choice([0.1, 1, 9], (rows, columns, 1))
    pixels[generator.random((rows, columns)) < 0.2] = 0
    if channels == 4:
        pixels[:, :, 3] = 1
    return Texture(pixels.astype(np.float32))


def scene_of(
    mesh: Mesh, texture: Texture | None = None, camera: Camera = CAMERA, lights=LIGHTS, size=(160, 120)
) -> Scene:
    textured = replace(mesh, texture=noise() if texture is None else texture)
    return Scene((textured,), camera, lights, size, BACKGROUND)


def assert_close(scene: Scene, encoding: str = "srgb", chosen: Settings | None = None) -> None:
    chosen = chosen or Settings()
    picture = draw_picture(scene, chosen, encoding=encoding)
    assert picture.route.color == "lit"
    away = np.abs(picture.pixels.astype(int) - exact_bytes(scene, chosen, encoding)).max(axis=2)
    assert away.max() <= 1
    assert (away > 0).mean() < 0.05


@pytest.mark.parametrize("encoding", ["srgb", "linear"])
@pytest.mark.parametrize("cull", ["none", "back", "front"])
@pytest.mark.parametrize("depth", ["fixed-38", "z-float32", "inverse-w"])
def test_a_sphere_is_lit_as_in_the_buffers(encoding: str, cull: str, depth: str) -> None:
    assert_close(scene_of(sphere()), encoding, Settings(depth=depth, cull=cull))


@every_pair(wrap=table.names("wrap"), channels=[1, 3, 4], shape=[(16, 32), (7, 5), (1, 1), (3, 64)])
def test_every_wrap_of_every_texture(wrap: str, channels: int, shape: tuple[int, int]) -> None:
    mesh = torus()
    assert mesh.uvs is not None
    texture = noise(*shape, channels)
    assert_close(
        scene_of(replace(mesh, uvs=3 * mesh.uvs - 1.2), texture, size=(90, 70)), chosen=Settings(wrap=wrap)
    )


@pytest.mark.parametrize("color", [(1.0, 1.0, 1.0), (0.5, 0.5, 0.5), (0.9, 0.4, 0.0)])
@pytest.mark.parametrize("channels", [1, 3])
@pytest.mark.parametrize("lights", [(), LIGHTS[:1], LIGHTS], ids=len)
def test_one_colour_times_the_texture(color, channels: int, lights) -> None:
    mesh = sphere()
    colors = np.tile([*color, 1.0], (len(mesh.positions), 1))
    assert_close(scene_of(replace(mesh, colors=colors), noise(channels=channels), lights=lights))


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
    assert_close(scene_of(mesh, noise(seed=seed), camera))


@pytest.mark.parametrize("grazing", [-1e-6, -1e-9, 0.0, 1e-9, 1e-6])
def test_highlights_that_end_abruptly(grazing: float) -> None:
    """A sheet that faces the eye, and light along it: whether it is mirrored or not, less than rounding decides."""
    corners = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])
    normals = np.tile([0.0, 0.0, 1.0], (4, 1))
    sheet = Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]), normals, uvs=corners[:, :2])
    mesh = replace(sheet, material=Material(0.3, 0.3, 1.0, 3.0))
    lights = (DirectionalLight(np.array([1.0, 0.3, grazing]), np.ones(3)),)
    assert_close(scene_of(mesh, camera=Camera(np.array([0.2, 0.1, 6.0]), np.zeros(3)), lights=lights))


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
    assert_close(scene_of(mesh, camera=camera), chosen=clipped)


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


def of_many_colors() -> Mesh:
    mesh = sphere()
    return replace(mesh, colors=np.random.default_rng(2).random((len(mesh.positions), 4)))


def without_normals() -> Mesh:
    mesh = sphere()
    return replace(mesh, normals=np.zeros((len(mesh.positions), 3)))


def far_coordinates() -> Mesh:
    mesh = sphere()
    assert mesh.uvs is not None
    return replace(mesh, uvs=mesh.uvs + 1e6)


@pytest.mark.parametrize(
    "scene",
    [
        scene_of(of_many_colors()),
        scene_of(without_normals()),
        scene_of(far_coordinates()),
        scene_of(floor(8)),
        scene_of(sphere(), lights=(PointLight(np.array([2.0, 2.0, 2.0])),)),
        scene_of(replace(sphere(), material=Material(0.0, 0.5, 1.0, 10000.0))),
        scene_of(replace(sphere(), material=Material(0.1, 0.5, 0.5, 0.5))),
        scene_of(sphere(), Texture(np.full((2, 2, 4), 0.5, np.float32))),
        scene_of(sphere(), Texture(np.full((2, 2, 3), 1.5, np.float32))),
    ],
    ids=[
        "colours",
        "no normals",
        "far coordinates",
        "through the eye",
        "point light",
        "sharp highlight",
        "root of a cosine",
        "transparent",
        "brighter than white",
    ],
)
def test_otherwise_attributes_and_light_come_from_every_pixel(scene: Scene) -> None:
    picture = draw_picture(scene)
    assert picture.route.color == "deferred"
    assert np.array_equal(picture.pixels, exact_bytes(scene, Settings(), "srgb"))


@pytest.mark.parametrize(
    "texture_filter", [name for name in table.names("texture_filter") if name != "bilinear"]
)
def test_other_filters_are_looked_up_as_in_the_buffers(texture_filter: str) -> None:
    scene, chosen = scene_of(sphere()), Settings(texture_filter=texture_filter)
    assert draw_picture(scene, chosen).route.color == "deferred"
