"""The bounds that plans rest on, each against what it bounds."""

from dataclasses import replace

import numpy as np
import pytest

from core.fragments.lighting import light_surface
from core.fragments.textures import texture_colors
from core.framebuffer.display import srgb
from core.geometry.vertex_stage import unit
from core.pipeline import render
from core.scene import Camera, ClipScene, DirectionalLight, Material, Mesh, PointLight, Scene, Texture
from core.stages.closed_meshes import is_closed
from core.study import Plan, Tolerance, everything_on, look_at, plan, plan_and_check
from core.study.accuracy.workloads import (
    checkerboard,
    overlapping_triangles,
    sphere_mesh,
    sphere_scene,
    textured_quad,
)
from core.study.planner import measuring
from core.study.planner.bounds.bytes import byte_error, byte_width
from core.study.planner.bounds.color_ranges import color_ranges
from core.study.planner.bounds.light_ranges import Reflectances, light_range
from core.study.planner.bounds.shading_bounds import shading_error
from core.study.planner.bounds.texture_ranges import magnified_range, minified_range, range_around, step_text
from core.study.planner.bounds.value_bounds import share_of_range
from core.study.planner.scene_analysis.conservative_coverage import components, touch
from core.study.planner.scene_analysis.orders import overlap
from core.study.planner.scene_analysis.surfaces import format_margin, surfaces
from core.study.planner.scene_analysis.tessellation import sagitta, sphere_edges, tessellations


def test_a_tolerance_says_what_it_wants() -> None:
    assert Tolerance.exact() == Tolerance(0.0, 0)
    assert Tolerance(2.5).bytes == 2
    with pytest.raises(ValueError, match="tolerance color must be from 0 to 255, got 256"):
        Tolerance(256)
    with pytest.raises(ValueError, match="tolerance pixels must be a whole number from 0 on, got -1"):
        Tolerance(2, -1)


def test_an_error_is_worst_where_light_is_darkest() -> None:
    dark = np.linspace(0, 0.9, 50)
    errors = byte_error(dark, np.full(50, 0.05))
    assert (np.diff(errors) < 0).all()
    assert errors[0] == pytest.approx(255 * float(srgb(np.array(0.05))))
    assert byte_error(np.array([0.5]), np.array([np.inf]))[0] < 255
    assert byte_width(np.array([0.2]), np.array([0.2]))[0] == 0


@pytest.mark.parametrize("ratio", [1.5, 4.0, 100.0])
def test_affine_is_off_by_the_closed_form_at_most_and_reaches_it(ratio: float) -> None:
    scene = textured_quad(64, ratio, 1.0, None)
    touched = touch(scene, everything_on(scene))
    share = share_of_range(touched)
    root = np.sqrt(ratio)
    # Snapping lets a triangle reach beyond its corners by a hair.
    assert ((root - 1) / (root + 1) <= share).all()
    assert share == pytest.approx((root - 1) / (root + 1), rel=0.06)
    v = [
        render(scene, replace(everything_on(scene), antialiasing="none", interpolation=name)).attributes[
            ..., 1
        ]
        for name in ("affine", "perspective")
    ]
    worst = np.abs(v[0] - v[1]).max()
    assert 0.9 * share[0] < worst <= share[0] + 1e-6


@pytest.mark.parametrize(
    "light", [DirectionalLight(np.array([0.3, -1.0, -0.4])), PointLight(np.array([1.0, 2, 1]))]
)
def test_light_in_a_patch_is_within_its_range(light: DirectionalLight | PointLight) -> None:
    source = np.random.default_rng(3)
    material = Material(ambient=0.1, diffuse=0.7, specular=0.5, shininess=20)
    normals = unit(source.normal(size=(1, 200, 3)) + 0.2 * source.normal(size=(3, 200, 3)))
    positions = 0.3 * source.normal(size=(3, 200, 3))
    eye = np.array([0.0, 0, 3])
    ones = np.ones(200)
    found = light_range(
        normals,
        positions,
        eye - positions,
        (light,),
        Reflectances(0.1 * ones, 0.7 * ones, 0.5 * ones, 20 * ones),
    )
    for weights in source.dirichlet(np.ones(3), 60):
        normal, position = (np.tensordot(weights, values, 1) for values in (normals, positions))
        diffuse, specular = light_surface(position, normal, eye, (light,), material, two_sided=False)
        assert (diffuse >= found.diffuse_low - 1e-9).all()
        assert (diffuse <= found.diffuse_high + 1e-9).all()
        assert (specular >= found.specular_low - 1e-9).all()
        assert (specular <= found.specular_high + 1e-9).all()
    assert np.median(found.diffuse_high - found.diffuse_low) < 0.5


def test_texels_in_reach_are_within_their_range() -> None:
    texture = checkerboard(32, 5)
    source = np.random.default_rng(1)
    low = source.uniform(-2, 2, (300, 2))
    high = low + source.uniform(0, 0.1, (300, 2))
    least, most = range_around(texture, low, high, np.full(300, 2.0), "repeat")
    inner_least, inner_most = magnified_range(texture, low, high, "repeat")
    for part in source.uniform(0, 1, (40, 2)):
        for name in ("bilinear", "nearest"):
            color = texture_colors(texture, low + part * (high - low), name, "repeat")[:, :3]
            assert (color >= least - 1e-7).all()
            assert (color <= most + 1e-7).all()
            if name == "bilinear":
                assert (color >= inner_least - 1e-7).all()
                assert (color <= inner_most + 1e-7).all()
    top_least, top_most = minified_range(texture, np.array([-3.0, 50.0]))
    assert (top_least[0] == texture.pixels.min(axis=(0, 1))).all()
    assert top_most[1] == pytest.approx(texture.pixels.mean(axis=(0, 1), dtype=np.float64), abs=1e-6)


@pytest.mark.parametrize("name", ["gouraud", "flat"])
def test_shading_is_off_by_its_bound_at_most(name: str) -> None:
    scene = sphere_scene(16, 96)
    everything = replace(everything_on(scene), antialiasing="none")
    touched = touch(scene, everything)
    error = shading_error(touched, scene, name)
    bound = np.zeros((len(scene.meshes[0].triangles), 3))
    primitives = touched.geometry.primitives
    np.maximum.at(bound, primitives.triangle, error.diffuse + error.specular)
    exact, cheap = render(scene, everything), render(scene, replace(everything, shading=name))
    seen = exact.primitive[exact.primitive >= 0]
    off = np.abs(exact.color - cheap.color)[exact.primitive >= 0][:, :3]
    assert (off <= bound[seen] + 1e-6).all()
    assert off.max() > 0.01


def test_any_number_of_samples_shows_colors_of_the_candidates() -> None:
    scene = ClipScene(
        overlapping_triangles((40, 40), 6, 2), np.random.default_rng(0).uniform(0, 1, (6, 3, 4)), (40, 40)
    )
    everything = replace(everything_on(scene), blend="opaque")
    touched = touch(scene, everything)
    found = surfaces(
        touched,
        color_ranges(touched, scene, everything, touched.is_drawn),
        scene.background,
        format_margin("z-16"),
    )
    pictures = [
        measuring.shown(scene, replace(everything, antialiasing=name, depth=depth))
        for name in ("none", "ssaa-4", "ssaa-16", "msaa-4")
        for depth in ("z-16", "reversed-z")
    ]
    for first in pictures:
        for second in pictures:
            apart = measuring.difference(first, second).ravel()
            assert (apart <= np.ceil(found.width)).all()
    assert (found.width == 0).any()
    assert (found.width > 100).any()


def test_triangles_that_share_an_edge_do_not_overlap() -> None:
    scene = textured_quad(16, 1.0, 1.0, None)
    touched = touch(scene, everything_on(scene))
    assert not overlap(touched, np.array([0]), np.array([1]), 1)[0]
    assert overlap(touched, np.array([0]), np.array([0]), 1)[0]


def test_what_hangs_together_has_one_number() -> None:
    vertex = np.array([[0, 1, 2], [7, 8, 9], [5, 6, 2], [9, 10, 11], [3, 4, 5]])
    label = components(vertex)
    assert label[0] == label[2] == label[4] != label[1] == label[3]


def test_a_sphere_is_closed_and_its_lower_half_is_not() -> None:
    mesh = sphere_mesh(6)
    assert is_closed(mesh.positions, mesh.triangles)
    assert not is_closed(mesh.positions, mesh.triangles[: len(mesh.triangles) // 2])
    facts = {fact.name: fact.text for fact in look_at(sphere_scene(6, 32)).facts}
    assert facts["closed"] == "1 of 1"
    assert facts["w-signs"] == "0"


def test_an_arc_rises_by_the_closed_form_of_the_sphere() -> None:
    radius, count = 50.0, 24
    chord, turned = 2 * radius * np.sin(np.pi / count), 2 * np.pi / count
    rise = radius * (1 - np.cos(np.pi / count))
    assert sagitta(np.array([chord]), np.array([turned]))[0] == pytest.approx(rise)
    assert sphere_edges(radius, rise) == count
    coarse, fine = (tessellations(sphere_scene(rings, 128))[0].deviation for rings in (8, 16))
    assert coarse / fine == pytest.approx(4, rel=0.3)


def test_a_choice_that_is_measured_to_be_wrong_is_put_back(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = sphere_scene(8, 32)

    def careless(*arguments: object) -> Plan:
        right = plan(scene, Tolerance())
        wrong = {"shading": "flat", "antialiasing": "none"}
        decisions = tuple(
            replace(each, chosen=wrong.get(each.setting, each.chosen), predicted_error=0.5)
            for each in right.decisions
        )
        return replace(right, settings=replace(right.settings, **wrong), decisions=decisions)

    monkeypatch.setattr(measuring, "plan", careless)
    report = plan_and_check(scene, Tolerance(), rounds=1)
    assert report.is_within
    assert set(report.fallen_back) == {"shading", "antialiasing"}
    assert report.plan.settings.shading == "phong"
    wrong = measuring.measure_plan(scene, careless(), 1)
    assert not wrong.is_within
    texts = {each.decision.setting: each.text for each in wrong.outcomes}
    assert texts["shading"].startswith("predicted 1/255 (0.5 before rounding), measured ")
    assert texts["shading"].endswith("the prediction was wrong")


def test_a_wireframe_keeps_everything() -> None:
    scene = sphere_scene(4, 24)
    chosen = plan(scene, base=replace(everything_on(scene), polygon_mode="wireframe"))
    assert chosen.settings == chosen.everything
    assert chosen.everything.polygon_mode == "wireframe"


def test_an_empty_picture_needs_nothing() -> None:
    texture = Texture(np.ones((2, 2, 3), np.float32))
    scene = ClipScene(np.array([[[5.0, 5, 0, 1], [6, 5, 0, 1], [5, 6, 0, 1]]]), None, (8, 8))
    assert plan(scene, Tolerance.exact()).settings.antialiasing == "none"
    outside = textured_quad(8, 1.0, 1.0, texture)
    assert plan(outside, Tolerance.exact()).settings.texture_filter == "nearest"


def test_a_bound_that_is_far_longer_than_a_texture_is_not_told_in_numbers() -> None:
    assert step_text(1.0) == "2 texels at most"
    assert step_text(30.0) == "not known to be shorter than 16,384 texels"


def test_normals_without_a_middle_that_no_light_reaches_are_bounded() -> None:
    """Corners turned from the light, two of them opposite: a pixel just beside may be lit, and nothing is undefined."""
    positions = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]])
    normals = np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    away = DirectionalLight(np.array([0.0, 0.0, 1.0]))
    camera = Camera(np.array([0.0, 0.0, 3.0]), np.zeros(3))
    scene = Scene((Mesh(positions, np.array([[0, 1, 2]]), normals),), camera, (away,), (20, 20))
    error = shading_error(touch(scene, everything_on(scene)), scene, "gouraud")
    assert (error.diffuse >= 0).all()
    assert (error.diffuse <= Material().diffuse).all()
