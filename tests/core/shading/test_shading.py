import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.methods import table
from core.scene import DirectionalLight, Material, PointLight
from core.shading.lighting import (
    blinn_phong,
    light_surface,
    plain_lights,
    plain_material,
    reflectance,
    trace_lighting,
)
from core.shading.shading import face_normals, shade, shaded_color
from tests.core.shading.seen_sides import is_seen_from_behind

DOWN = DirectionalLight([0, 0, -1], [1.0, 0.5, 0.25])
LAMP = PointLight([3, 0, 4], [0.5, 1.0, 2.0])
EYE = np.array([0.0, 0.0, 5.0])
ORIGIN = np.zeros((1, 3))
UP = np.array([[0.0, 0.0, 1.0]])
MATERIAL = Material(ambient=0.125, diffuse=0.5, specular=0.25, shininess=2.0)

component = st.floats(-8, 8)
vector = st.tuples(component, component, component)


def test_light_eye_and_normal_in_one_line():
    diffuse, specular = light_surface(ORIGIN, 7 * UP, EYE, [DOWN], MATERIAL)
    assert diffuse.tolist() == [[0.625, 0.375, 0.25]]
    assert specular.tolist() == [[0.25, 0.125, 0.0625]]


def test_point_light_in_a_three_four_five_triangle():
    lighting = trace_lighting(ORIGIN, UP, EYE, [LAMP], MATERIAL)
    assert lighting.to_light[0].tolist() == [[0.6, 0.0, 0.8]]
    assert lighting.n_dot_l.tolist() == [[0.8]]
    half = np.array([0.6, 0, 1.8]) / np.sqrt(0.6**2 + 1.8**2)
    assert lighting.half[0, 0] == pytest.approx(half, abs=1e-15)
    assert lighting.power[0, 0] == pytest.approx(half[2] ** 2, abs=1e-15)
    assert lighting.diffuse_light[1, 0] == pytest.approx(0.125 + 0.5 * 0.8 * LAMP.color, abs=1e-15)


def test_without_lights_only_the_ambient_term_is_left():
    diffuse, specular = light_surface(ORIGIN, UP, EYE, (), MATERIAL)
    assert (diffuse.tolist(), specular.tolist()) == ([[0.125] * 3], [[0.0] * 3])


@pytest.mark.parametrize("normal", [[0.0, 0.0, 0.0], [0.0, 1e-200, 0.0], [0.0, 1e200, 0.0]])
def test_a_normal_without_direction_gets_ambient_light_only(normal):
    diffuse, specular = light_surface(ORIGIN, np.array([normal]), EYE, [DOWN, LAMP], MATERIAL)
    assert (diffuse.tolist(), specular.tolist()) == ([[0.125] * 3], [[0.0] * 3])


def test_points_at_the_eye_or_the_lamp_are_defined():
    at_lamp, at_eye = LAMP.position[None], EYE[None]
    for position in (at_lamp, at_eye):
        lit = light_surface(position, UP, EYE, [LAMP, DOWN], MATERIAL)
        assert all(np.isfinite(sums).all() for sums in lit)


def test_a_light_opposite_to_the_eye_has_no_highlight():
    below = DirectionalLight([0, 0, 1])
    lighting = trace_lighting(ORIGIN, UP, EYE, [below], MATERIAL)
    assert lighting.half.tolist() == [[[0.0, 0.0, 0.0]]]
    assert lighting.power.tolist() == [[0.0]]
    assert lighting.diffuse_light[-1].tolist() == [[0.125] * 3]


def test_one_and_two_sided():
    front = light_surface(ORIGIN, UP, EYE, [DOWN], MATERIAL)
    turned = light_surface(ORIGIN, -UP, EYE, [DOWN], MATERIAL)
    dark, no_highlight = light_surface(ORIGIN, -UP, EYE, [DOWN], MATERIAL, two_sided=False)
    assert [sums.tolist() for sums in turned] == [sums.tolist() for sums in front]
    assert (dark.tolist(), no_highlight.tolist()) == ([[0.125] * 3], [[0.0] * 3])
    assert trace_lighting(ORIGIN, -UP, EYE, [DOWN], MATERIAL).turned.tolist() == [True]


def test_undefined_input_stays_visible():
    position = np.array([[np.nan, 0, 0], [np.inf, 0, 0], [0, 0, 0]])
    diffuse, _ = light_surface(position, np.repeat(UP, 3, axis=0), EYE, [LAMP], MATERIAL)
    assert np.isnan(diffuse[0]).all()
    assert np.isfinite(diffuse[2]).all()


@given(
    points=st.lists(st.tuples(vector, vector), min_size=1, max_size=12),
    lamp=vector,
    direction=vector.filter(any),
    shininess=st.sampled_from([0.5, 1.0, 2.0, 3.7, 32.0, 1000.0]),
    two_sided=st.booleans(),
)
def test_listing_gives_the_same_bits(points, lamp, direction, shininess, two_sided):
    position, normal = (np.array([point[k] for point in points]) for k in range(2))
    lights = [PointLight(lamp, [0.3, 0.7, 1.1]), DirectionalLight(direction)]
    material = Material(0.1, 0.7, 0.3, shininess)
    batch = light_surface(position, normal, EYE, lights, material, two_sided)
    traced = trace_lighting(position, normal, EYE, lights, material, two_sided)
    for row, (place, direction_out) in enumerate(points):
        known = plain_lights(lights), plain_material(material)
        scalar = blinn_phong(place, direction_out, tuple(EYE.tolist()), *known, two_sided)
        assert [sums[row].tolist() for sums in batch] == [list(sums) for sums in scalar]
    assert np.array_equal(traced.diffuse_light[-1], batch[0])
    assert np.array_equal(traced.specular_light[-1], batch[1])


@pytest.mark.parametrize("shininess", [0.5, 1.0, 2.0, 17.3])
def test_one_material_for_all_or_one_each_and_any_batch_give_the_same_bits(shininess):
    random = np.random.default_rng(4)
    position, normal = random.normal(size=(2, 40000, 3))
    materials = [Material(0.2, 0.4, 0.6, 5.0), Material(0.1, 0.5, 0.7, shininess)]
    whole = light_surface(position, normal, EYE, [LAMP, DOWN], materials[1])
    each = light_surface(
        position, normal, EYE, [LAMP, DOWN], reflectance(materials, np.ones(40000, np.int64))
    )
    from_places = np.broadcast_to(EYE, position.shape)
    alone = light_surface(position[33333:33334], normal[33333:33334], EYE, [LAMP, DOWN], materials[1])
    placed = light_surface(position, normal, from_places, [LAMP, DOWN], materials[1])
    for term in range(2):
        assert np.array_equal(whole[term], each[term])
        assert np.array_equal(whole[term], placed[term])
        assert np.array_equal(whole[term][33333:33334], alone[term])


def test_no_points():
    nowhere = np.empty((0, 3))
    assert light_surface(nowhere, nowhere, EYE, [LAMP, DOWN], MATERIAL)[0].shape == (0, 3)
    assert trace_lighting(nowhere, nowhere, EYE, [LAMP, DOWN], MATERIAL).n_dot_l.shape == (2, 0)


@pytest.mark.parametrize("specular", [0.0, 0.4])
@pytest.mark.parametrize("two_sided", [False, True])
def test_matte_and_shiny_points_are_lit_by_the_same_rule(specular, two_sided):
    """Without highlights the eye is left out, but not where the place, the normal or the light has no end."""
    random = np.random.default_rng(5)
    position, normal = random.normal(size=(2, 9000, 3)) * 10.0 ** random.integers(-200, 200, (2, 9000, 1))
    normal[:9], normal[9:12], position[12:15], position[20:23] = 0, np.nan, np.inf, np.nan
    material, lights = Material(0.1, 0.6, specular, 7.0), [LAMP, DOWN]
    for part in (slice(None), slice(30, None), slice(8000, None)):
        lit = light_surface(position[part], normal[part], EYE, lights, material, two_sided)
        traced = trace_lighting(position[part], normal[part], EYE, lights, material, two_sided)
        assert np.array_equal(lit[0], traced.diffuse_light[-1], equal_nan=True)
        assert np.array_equal(lit[1], traced.specular_light[-1], equal_nan=True)


@given(position=vector, normal=vector, color=st.floats(0, 3))
def test_light_is_never_negative_and_adds_up(position, normal, color):
    place, direction = np.array([position]), np.array([normal])
    lights = [PointLight([3, 2, 4], [color] * 3), DOWN]
    both = light_surface(place, direction, EYE, lights, MATERIAL)
    first, second = (light_surface(place, direction, EYE, [light], MATERIAL) for light in lights)
    assert (both[0] >= 0.125).all()
    assert (both[1] >= 0).all()
    assert both[0] + 0.125 == pytest.approx(first[0] + second[0], abs=1e-12)
    assert both[1] == pytest.approx(first[1] + second[1], abs=1e-12)


def test_shade_keeps_alpha_and_does_not_cut_off():
    albedo = np.array([[0.5, 1.0, 0.25, 0.3], [1.0, 1.0, 1.0, 0.0]])
    diffuse, specular = np.array([[2.0, 0.5, 1.0], [1.0] * 3]), np.array([[0.5, 0.25, 1.0], [0.0] * 3])
    color = shade(albedo, diffuse, specular)
    assert color.tolist() == [[1.5, 0.75, 1.25, 0.3], [1.0, 1.0, 1.0, 0.0]]
    rows = zip(albedo.tolist(), diffuse.tolist(), specular.tolist(), strict=True)
    assert color.tolist() == [list(shaded_color(*row)) for row in rows]


# Where the rule is evaluated: a roof of two faces over the x-axis, seen from above.

ROOF = np.array([[-1.0, 0, 0], [1, 0, 0], [0, 1, -1], [0, -1, -1]])
ROOF_CORNERS = np.array([[0, 1, 2], [1, 0, 3]])
ROOF_NORMALS = np.array([[0.0, 0, 1], [0, 0, 1], [0, 1, 1], [0, -1, 1]])
SIDE = DirectionalLight([0, -1, 0])


def light(position, normal, vertex):
    assert len(vertex) == len(position)
    return light_surface(position, normal, EYE, [SIDE], MATERIAL, two_sided=False)


def varyings(name, eye=EYE, corners=ROOF_CORNERS, normals=ROOF_NORMALS):
    behind = is_seen_from_behind(ROOF, normals, corners, eye)
    return table.get("shading", name).function(ROOF, normals, corners, behind, light)


def test_phong_interpolates_positions_and_normals():
    parts = varyings("phong")
    assert set(parts) == {"position", "normal"}
    assert np.array_equal(parts["position"], ROOF[ROOF_CORNERS])
    assert np.array_equal(parts["normal"], ROOF_NORMALS[ROOF_CORNERS])


def test_gouraud_lights_the_vertices():
    diffuse = varyings("gouraud")["diffuse_light"]
    slope = 0.125 + 0.5 * (1 / np.sqrt(2))
    assert diffuse[:, :, 0] == pytest.approx(np.array([[0.125, 0.125, slope], [0.125] * 3]), abs=1e-15)


def test_flat_lights_each_face_once():
    diffuse = varyings("flat")["diffuse_light"]
    slope = 0.125 + 0.5 * (1 / np.sqrt(2))
    assert diffuse[:, 0, 0] == pytest.approx([slope, 0.125], abs=1e-15)
    assert np.array_equal(diffuse[:, [0, 0, 0]], diffuse)


def test_unlit_interpolates_nothing():
    assert varyings("unlit") == {}


@pytest.mark.parametrize("name", ["phong", "gouraud", "flat"])
def test_the_order_of_the_corners_does_not_matter_and_a_side_is_chosen_by_face(name):
    reversed_corners = ROOF_CORNERS[:, ::-1]
    above, below = varyings(name), varyings(name, eye=-EYE)
    for eye, expected in ((EYE, above), (-EYE, below)):
        wound_the_other_way = varyings(name, eye, reversed_corners)
        turned_round = varyings(name, eye, normals=-ROOF_NORMALS)
        for part, values in expected.items():
            assert wound_the_other_way[part][:, ::-1] == pytest.approx(values, abs=1e-15)
            assert turned_round[part] == pytest.approx(values, abs=1e-15)
    assert any(not np.array_equal(above[part], below[part]) for part in above)


def test_seen_from_behind():
    below = np.array([0.0, 0, -9])
    assert is_seen_from_behind(ROOF, ROOF_NORMALS, ROOF_CORNERS, EYE).tolist() == [False, False]
    assert is_seen_from_behind(ROOF, ROOF_NORMALS, ROOF_CORNERS, below).tolist() == [True, True]
    places = np.array([EYE, below])
    assert is_seen_from_behind(ROOF, ROOF_NORMALS, ROOF_CORNERS, places).tolist() == [False, True]
    assert is_seen_from_behind(ROOF, ROOF_NORMALS, np.array([[0, 0, 1]]), below).tolist() == [False]


def test_face_normals_are_counter_clockwise_and_two_areas_long():
    assert face_normals(ROOF, ROOF_CORNERS).tolist() == [[0.0, 2.0, 2.0], [0.0, -2.0, 2.0]]
