"""What a plan chooses, finds and says in scenes made for it."""

from dataclasses import replace

import numpy as np
import pytest

from core.methods import table
from core.pipeline import render
from core.records.arrays import Floats
from core.scene import ClipScene, Texture
from core.settings import Settings
from core.stages.closed_meshes import is_closed
from core.stages.object_tree import object_tree
from core.study.planner.findings import sagitta, tessellations
from core.study.planner.measuring import check_plan, measure_plan
from core.study.planner.planning import CHEAPER, look_at, plan
from core.study.planner.records import PHRASES, Plan, Tolerance, figure
from core.study.planner.reference_settings import reference_settings
from core.study.planner.trials import Costs, difference, shown
from core.study.workloads import sphere_mesh, sphere_scene, textured_quad
from core.transform.vertex_stage import transform_vertices
from lessons.scenes import make_scene


class WithoutMultisampling(Costs):
    """A machine on which multisampling takes longer than anything."""

    def is_slower(self, settings: Settings, others: Settings) -> bool:
        """Tell whether the first has multisampling."""
        return settings.antialiasing == "msaa-4"


def test_a_tolerance_says_what_it_wants() -> None:
    assert Tolerance.exact() == Tolerance(0.0, 0)
    assert Tolerance(2.5).bytes == 2
    with pytest.raises(ValueError, match="tolerance color must be from 0 to 255, got 256"):
        Tolerance(256)
    with pytest.raises(ValueError, match="tolerance pixels must be a whole number from 0 on, got -1"):
        Tolerance(2, -1)


def careless(scene: ClipScene) -> Plan:
    """Return a plan with two choices that are wrong."""
    right = plan(scene, Tolerance(), costs=Costs())
    wrong = {"shading": "flat", "antialiasing": "none"}
    decisions = tuple(
        replace(each, chosen=wrong.get(each.setting, each.chosen), predicted_error=0.0)
        for each in right.decisions
    )
    return replace(right, settings=replace(right.settings, **wrong), decisions=decisions)


def test_a_choice_that_is_measured_to_be_wrong_is_put_back() -> None:
    scene = sphere_scene(8, 32)
    report = check_plan(scene, careless(scene), rounds=1)
    assert report.is_within
    assert set(report.fallen_back) >= {"shading", "antialiasing"}
    assert report.plan.settings.shading == "phong"
    wrong = measure_plan(scene, careless(scene), 1)
    assert not wrong.is_within
    texts = {each.decision.setting: each.text for each in wrong.outcomes}
    assert texts["shading"].startswith("predicted 0/255, measured ")
    assert texts["shading"].endswith("the prediction was wrong")


def test_a_wireframe_is_planned_as_any_picture() -> None:
    scene = sphere_scene(4, 24)
    chosen = plan(scene, base=replace(reference_settings(scene), polygon_mode="wireframe"), costs=Costs())
    assert chosen.everything.polygon_mode == chosen.settings.polygon_mode == "wireframe"
    assert measure_plan(scene, chosen, 1).is_within


def test_an_empty_picture_needs_nothing() -> None:
    scene = ClipScene(np.array([[[5.0, 5, 0, 1], [6, 5, 0, 1], [5, 6, 0, 1]]]), None, (8, 8))
    chosen = plan(scene, Tolerance.exact(), costs=Costs())
    assert all(getattr(chosen.settings, family) == names[0] for family, names in CHEAPER.items())
    assert "nothing is in view" in [fact.text for fact in chosen.findings.facts]


def halves(light: float) -> ClipScene:
    """Return a slanted edge between two greys that fills the picture."""
    corners = np.array([[-1.0, -1, 0, 1], [3.1, -1, 0, 1], [-1, 2.8, 0, 1], [3, 3, 0, 1]])
    clip = corners[[[0, 1, 2], [1, 3, 2]]] - np.array([0.4, 0.3, 0, 0])
    grey = np.array([0.4, 0.4, 0.4, 1.0])
    colors = np.stack([np.tile(grey, (3, 1)), np.tile([light, light, light, 1.0], (3, 1))])
    return ClipScene(clip, colors, (32, 32), background=tuple(grey))


def test_the_contrast_of_an_edge_decides_how_many_samples_it_takes() -> None:
    def samples(light: float, costs: Costs) -> str:
        return plan(halves(light), Tolerance(6.0), costs=costs).settings.antialiasing

    assert [samples(light, Costs()) for light in (0.41, 0.49, 0.9)] == ["none", "msaa-4", "ssaa-16"]
    assert samples(0.49, WithoutMultisampling()) == "ssaa-4"


def test_reasons_list_what_is_too_far_off_and_what_takes_longer() -> None:
    chosen = plan(halves(0.49), Tolerance(6.0), costs=WithoutMultisampling())
    reason = next(each.reason for each in chosen.decisions if each.setting == "antialiasing")
    assert "One sample a pixel: " in reason
    assert ": 1 pixel changes by more than 6/255, by up to 8/255." in reason
    assert "Multisampling with 4 samples would do, but takes longer here." in reason


def test_alpha_that_varies_is_not_interpolated_any_cheaper() -> None:
    clip = np.array([[[-1.0, -1, 0, 1], [9, -3, 0, 3], [-1, 3, 0, 1]]])
    colors: Floats = np.full((1, 3, 4), 0.5)
    colors[0, :, 3] = 0.1, 0.9, 0.4
    scene = ClipScene(clip, colors, (24, 24))
    assert plan(scene, Tolerance(2.0), costs=Costs()).settings.interpolation == "perspective"
    worse = shown(scene, replace(reference_settings(scene), interpolation="affine"))
    assert difference(worse, shown(scene, reference_settings(scene))).max() > 2


@pytest.mark.parametrize(
    ("depths", "alpha", "visibility"),
    [
        # Nearer than what is there: drawn from far to near.
        ((0.5, -0.5), 0.5, "last-drawn"),
        # Behind what is there: hidden, but for the painter, who would draw it first and let it shine through.
        ((-0.5, 0.5), 0.5, "z-buffer"),
        # Behind what nothing shines through: the painter covers it.
        ((-0.5, 0.5), 1.0, "painters"),
    ],
)
def test_sorting_is_chosen_only_where_nothing_shines_through(
    depths: tuple[float, float], alpha: float, visibility: str
) -> None:
    corners = np.array([[-0.8, -0.8, 0, 1], [0.8, -0.7, 0, 1], [0.1, 0.9, 0, 1]])
    clip = np.stack([corners, corners])
    clip[:, :, 2] = np.array(depths)[:, None]
    colors = np.array([[1.0, 0.0, 0.0, alpha], [0.0, 1.0, 0.0, alpha]])[:, None].repeat(3, axis=1)
    scene = ClipScene(clip, colors, (24, 20))
    assert plan(scene, Tolerance(2.0), costs=Costs()).settings.visibility == visibility


def test_facts_are_those_of_the_scene() -> None:
    mesh = sphere_mesh(6)
    assert is_closed(mesh.positions, mesh.triangles)
    assert not is_closed(mesh.positions, mesh.triangles[: len(mesh.triangles) // 2])
    facts = {fact.name: fact.text for fact in look_at(sphere_scene(6, 32)).facts}
    assert facts["closed"] == "1 of 1"
    assert facts["w-signs"] == "0"
    assert facts["layers"] == "2"
    assert facts["tried"] == "32 of 32"
    assert facts["normals"].endswith(" degrees")
    texture = Texture(np.ones((4, 4, 3), np.float32))
    facts = {fact.name: fact.text for fact in look_at(textured_quad(8, 3.0, 2.0, texture)).facts}
    assert facts["w-ratio"] == "3"
    assert float(facts["texels"].removesuffix(" texels")) > 1


def test_an_arc_rises_by_the_closed_form_of_the_sphere() -> None:
    radius, count = 50.0, 24
    chord, turned = 2 * radius * np.sin(np.pi / count), 2 * np.pi / count
    rise = radius * (1 - np.cos(np.pi / count))
    assert sagitta(np.array([chord]), np.array([turned]))[0] == pytest.approx(rise)
    coarse, fine = (tessellations(sphere_scene(rings, 128))[0].deviation for rings in (8, 16))
    assert coarse / fine == pytest.approx(4, rel=0.3)


def test_every_method_that_may_be_chosen_has_a_name_for_sentences() -> None:
    for family, names in CHEAPER.items():
        assert set(names) <= set(PHRASES[family]) <= set(table.names(family))


def test_figures_have_three_digits_and_no_exponent() -> None:
    assert [figure(value) for value in (5186.0, 0.8234, 2e-5, 0.0, 1e6)] == [
        *("5,190", "0.823", "0.001", "0", "1,000,000")
    ]


def test_a_plan_says_what_rays_in_a_tree_and_scan_lines_would_ask() -> None:
    scene = sphere_scene(6, 24)
    found = plan(scene, Tolerance(), costs=Costs())
    said = next(each.reason for each in found.decisions if each.setting == "visibility")
    grown = object_tree(scene, transform_vertices(scene), Settings(visibility="ray-casting-tree"))
    deepest = int(grown.tree.depth.max())
    assert f"would ask at most {1 + 2 * deepest} boxes and 8 triangles." in said
    covered = render(scene, Settings(cull="none")).cover_count
    text = f"where triangles overlap: in {(covered > 1).sum():,} of {(covered > 0).sum():,} pixels"
    assert text in said


def test_curves_are_advised_with_what_was_measured_and_what_the_bound_asks() -> None:
    (found,) = tessellations(make_scene("curve"), Settings(segments=6))
    assert (found.triangles, found.wanted, round(found.deviation, 3)) == (6, 13, 0.831)
    assert found.text == (
        "curve 0: its 6 segments lie up to 0.831 pixels away; 13 equal steps of t are surely within 0.25."
    )
    coarse, fine = (tessellations(make_scene("hill"), Settings(segments=n))[0] for n in (3, 6))
    assert (coarse.triangles, fine.triangles) == (18, 72)
    assert coarse.deviation > fine.deviation
