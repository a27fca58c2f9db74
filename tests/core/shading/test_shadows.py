"""Shadow maps against rays in rational arithmetic, the bias that a plane needs, and what passes are refused."""

from dataclasses import replace
from fractions import Fraction
from math import sqrt

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from core import Camera, DirectionalLight, Mesh, PointLight, Scene, Settings, render, trace
from core.fast_path.draw import draw_picture
from core.framebuffer.display import to_display
from core.pixel_history import why
from core.pixel_history.told import link_sentence
from core.records.passes import PlannedPass
from core.settings import no_effect
from core.shading.measured_shadows import needed_biases
from core.shading.shadows import shadow_map, shadow_map_average
from core.stages.passes import drawn_depth, lamp_of, planned_passes, shadow_tests
from core.study.planner.planning import look_at
from core.trace.source import TraceSource
from lessons.scenes import make_scene
from tests.core.trace.fragment_listings import check_shade
from tests.core.trace.trace_cases import SCENES

BOX = replace(make_scene("box-in-light"), size=(96, 72))
"""A floor of 8 x 8 and a box of side 1 on it, in the size of the numbers below."""


def shares(scene: Scene, **choice: str | int) -> np.ndarray:
    """Return the share of the light that arrives at what is seen at every pixel, NaN where nothing is."""
    source = trace(scene, Settings(**choice)).source
    place = source.fragments.row, source.fragments.column
    seen = source.picture.primitive[place] == source.triangle_of_fragment
    found = np.full(source.picture.primitive.shape, np.nan)
    found[place[0][seen], place[1][seen]] = source.surface.light_share[seen]
    return found


@settings(max_examples=30, deadline=None)
@given(st.integers(-4, 4), st.integers(-4, 4), st.integers(-9, 9), st.integers(-9, -2), st.integers(-9, 9))
def test_a_plane_needs_the_bias_of_half_a_texel_and_no_more(a, b, x, y, z) -> None:
    # The plane y = (a x + b z) / 8. Half a texel along each axis of the map, its depth changes by half of both slopes.
    corners = np.array([[-8.0, -a - b, -8], [8, a - b, -8], [8, a + b, 8], [-8, -a + b, 8]])
    scene = Scene(
        (Mesh(corners, np.array([[0, 2, 1], [0, 3, 2]])),), Camera([0, 9, 0], [0, 0, 0], [0, 0, -1]),
        (DirectionalLight(np.array([x, y, z], float)),),
    )  # fmt: skip
    lamp = lamp_of(scene, Settings(shadow="map", map_size=16, shadow_bias=0))
    inner = np.random.default_rng(7).uniform(-5, 5, (2, 2000))
    position = np.stack([inner[0], (a * inner[0] + b * inner[1]) / 8, inner[1]], axis=1)
    across, up, along = lamp.to_map[:, :3]
    normal = np.array([-a / 8, 1, -b / 8])
    light = np.array([x, y, z]) / sqrt(x * x + y * y + z * z)
    sine = abs(normal @ light) / np.linalg.norm(normal)
    assume(sine > 1e-3)
    # Steps in the plane that go one texel to the right, and one up.
    steps = np.linalg.solve(np.stack([across, up, normal]), np.eye(3)[:, :2])
    bound = np.abs(along @ steps).sum() / 2

    camera = planned_passes(scene, Settings(shadow="map", map_size=16))[0].scene.camera
    texel = camera.view_height / 16 / (camera.far - camera.near)
    cotangent = sqrt(max(1 / sine**2 - 1, 0))
    assert bound <= texel / sqrt(2) * cotangent * (1 + 1e-9) + 1e-12
    if sine < 0.05:
        return

    def dark(method, bias: float) -> float:
        return float((method(position, replace(lamp, bias=bias)).share < 1).mean())

    rounding = 1e-6
    assert dark(shadow_map, bound + rounding) == 0
    assert dark(shadow_map_average, 2 * bound + rounding) == 0
    texels = np.ptp(position @ lamp.to_map[:2, :3].T, axis=0).min()
    if bound > 1e-3 and texels > 3 and sine > 0.2:
        # A half of every texel; of those at the border of what was taken, a part only.
        assert dark(shadow_map, 0) == pytest.approx(0.5, abs=0.05 + 0.5 / texels)
        assert dark(shadow_map, 0.8 * bound) > 0


def is_hidden(point: np.ndarray, light: np.ndarray) -> bool:
    """Return whether the box stands between a point of the floor and the light, by slabs in rational arithmetic."""
    low, high = [Fraction(-1, 2), Fraction(0), Fraction(-1, 2)], [Fraction(1, 2), Fraction(1), Fraction(1, 2)]
    place, way = [Fraction(float(c)) for c in point], [-Fraction(float(c)) for c in light]
    place[1] = Fraction(0)
    ends = [sorted(((a - p) / w, (b - p) / w)) for a, b, p, w in zip(low, high, place, way, strict=True)]
    return max(*(first for first, _ in ends), 0) <= min(last for _, last in ends)


def test_rays_are_exact_and_maps_have_the_numbers_of_the_scene() -> None:
    primitive = render(BOX).primitive
    is_floor = (primitive >= 0) & (primitive < 2)
    exact = shares(BOX, shadow="rays") == 0
    source = trace(BOX, Settings()).source
    layout = source.geometry.primitives.layout["position"]
    seen = primitive[source.fragments.row, source.fragments.column] == source.triangle_of_fragment
    for k in np.flatnonzero(seen & (source.triangle_of_fragment < 2))[::7]:
        point = source.interpolated[1][k, layout]
        hidden = is_hidden(point, BOX.lights[0].direction)
        assert exact[source.fragments.row[k], source.fragments.column[k]] == hidden
    found = {}
    for size, bias in ((16, 0), (16, 11), (16, 55), (64, 11), (256, 11), (256, 55)):
        dark = shares(BOX, shadow="map", map_size=size, shadow_bias=bias) == 0
        found[size, bias] = [
            int(np.count_nonzero(is_floor & wrong)) for wrong in (dark & ~exact, exact & ~dark)
        ]
    assert (int(is_floor.sum()), int((is_floor & exact).sum())) == (4705, 93)
    at_bound = {(16, 11): [10, 37], (64, 11): [9, 3], (256, 11): [3, 2]}
    assert found == {**at_bound, (16, 0): [2255, 35], (16, 55): [0, 93], (256, 55): [3, 3]}


@pytest.mark.parametrize("size", [64, 256])
def test_wrong_pixels_of_the_floor_lie_within_two_texels_of_a_border(size: int) -> None:
    # At the bound of the floor, whose texels are longer along the light by 1 / sin(e).
    source = trace(BOX, Settings()).source
    wrong = shares(BOX, shadow="map", map_size=size, shadow_bias=11) != shares(BOX, shadow="rays")
    place = source.fragments.row, source.fragments.column
    seen = source.picture.primitive[place] == source.triangle_of_fragment
    chosen = np.flatnonzero(wrong[place] & seen & (source.triangle_of_fragment < 2))
    light = BOX.lights[0].direction
    camera = planned_passes(BOX, Settings(shadow="map", map_size=size))[0].scene.camera
    texel = camera.view_height / size * np.linalg.norm(light) / -light[1]
    around = [(np.cos(t), np.sin(t)) for t in np.arange(12) * np.pi / 6]
    assert len(chosen) > 0
    for k in chosen:
        x, _, z = source.interpolated[1][k, source.geometry.primitives.layout["position"]]
        verdicts = {
            is_hidden(np.array([x + a * r * texel, 0.0, z + b * r * texel]), light)
            for a, b in around
            for r in (0.0, 0.5, 1.0, 1.5, 2.0)
        }
        assert verdicts == {False, True}, (x, z)


@pytest.mark.parametrize("method", ["map", "map-average", "rays"])
def test_picture_trace_and_listing_agree(method: str) -> None:
    scene, chosen = replace(BOX, size=(24, 18)), Settings(shadow=method, map_size=16, shadow_bias=4)
    traced = trace(scene, chosen)
    check_shade(traced)
    frame, stage = render(scene, chosen), traced.stage("shade")
    depth = traced.stage("depth")
    last = {
        tuple(pixel): row for row, pixel in enumerate(stage.pixel.tolist()) if depth.columns["passes"][row]
    }
    for (column, row), at in last.items():
        assert np.array_equal(frame.color[row, column], stage.columns["color"][at].astype(np.float32))
    assert np.array_equal(to_display(frame.color).pixels, draw_picture(scene, chosen).pixels)
    nothing = Settings(shadow=method, map_size=16, shadow_bias=1024, shading="gouraud")
    assert np.array_equal(render(scene, nothing).color, render(scene, Settings(shading="gouraud")).color)


def test_the_map_is_the_depth_buffer_of_its_pass_and_is_kept() -> None:
    chosen = Settings(shadow="map", map_size=32)
    (planned,) = planned_passes(BOX, chosen)
    assert np.array_equal(drawn_depth(planned), render(planned.scene, planned.settings).depth)
    moved = replace(BOX, camera=replace(BOX.camera, eye=np.array([3.0, 5, 5])))
    assert planned_passes(moved, chosen)[0] is planned
    assert planned_passes(BOX, Settings()) == () == planned_passes(BOX, replace(chosen, shading="flat"))


@pytest.mark.parametrize("antialiasing", ["none", "msaa-4", "ssaa-4"])
def test_a_map_that_is_drawn_in_the_midst_of_a_picture_leaves_it_as_it_is(antialiasing: str) -> None:
    scene, chosen = SCENES["orthographic"], Settings(shadow="map", antialiasing=antialiasing)
    drawn_depth.cache_clear()
    first = draw_picture(scene, chosen).pixels
    assert np.array_equal(first, draw_picture(scene, chosen).pixels)


def test_outside_of_the_map_all_is_lit() -> None:
    found = shadow_tests(BOX, Settings(shadow="map"), np.array([[100.0, -50, 0], [-10, -12, -6]]))
    assert found.share.tolist() == [1, 0]
    assert np.isinf(found.stored[0, 0])


def test_without_a_light_that_casts_there_is_no_shadow_and_a_reason() -> None:
    for lights in ((), (PointLight(np.ones(3)),), (replace(BOX.lights[0], casts_shadow=False),)):
        scene = replace(BOX, lights=lights, size=(24, 18))
        assert "No light of this scene casts shadows" in no_effect(Settings(), "shadow", scene)
        assert np.array_equal(render(scene, Settings(shadow="map")).color, render(scene).color)


def test_what_is_refused_says_why() -> None:
    with pytest.raises(ValueError, match="map_size must be a whole number from 1 to 2048, got 100000"):
        Settings(map_size=100_000)
    with pytest.raises(ValueError, match="a pass must need no pass itself, got one with shadow map"):
        PlannedPass("shadow-map", "itself", BOX, Settings(shadow="map"))
    with pytest.raises(ValueError, match="shadow rays needs at most 536,870,912 tests"):
        render(replace(make_scene("knot"), size=(512, 512)), Settings(shadow="rays"))
    projecting = replace(
        BOX.meshes[1], transform=np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1.0, 4]])
    )
    with pytest.raises(ValueError, match="needs meshes in world space"):
        render(replace(BOX, meshes=(projecting,)), Settings(shadow="map"))


@pytest.mark.parametrize(
    "direction", [(0.0, -1, 0), (0, 1, 0), (1e-300, -1e-300, 0), (1, 0, 0), (0, 0, 1e200)]
)
def test_any_direction_and_a_map_of_one_texel_draw(direction: tuple[float, float, float]) -> None:
    scene = replace(BOX, lights=(DirectionalLight(np.array(direction)),), size=(8, 6))
    for size in (1, 7):
        assert np.isfinite(render(scene, Settings(shadow="map", map_size=size)).color).all()


def test_the_history_of_a_pixel_tells_of_the_shadow() -> None:
    exact = shares(BOX, shadow="rays") == 0
    row, column = np.argwhere(exact & (render(BOX).primitive < 2))[0].tolist()
    history = why(TraceSource(BOX, Settings(shadow="map", shadow_bias=11)), column, row)
    links = [link for event in history.events for link in event.chain if link.stage == "shade"]
    assert [link_sentence(link) for link in links][-1].endswith("; in the shadow.")


def test_the_bias_that_a_surface_needs_is_that_of_its_plane() -> None:
    # The floor needs 16 cot(e) / 2 sixteenths of a texel, since its depth changes along one axis of the map.
    needed, share = needed_biases(BOX, Settings(shadow="map", map_size=16))
    light = BOX.lights[0].direction
    cotangent = np.hypot(light[0], light[2]) / -light[1]
    assert needed[share.argmax()] == pytest.approx(8 * cotangent)
    assert share.sum() == pytest.approx(1)
    four, _ = needed_biases(BOX, Settings(shadow="map-average", map_size=64))
    assert four == pytest.approx(2 * needed)
    found = {fact.name: fact.text for fact in look_at(BOX, Settings(shadow="map", shadow_bias=8)).facts}
    assert 90 < float(found["bias"].removesuffix(" %")) < 100
