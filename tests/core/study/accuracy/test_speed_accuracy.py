"""Measuring: every family gives numbers or reasons, cancelling leaves nothing, and published orderings hold."""

import gc
from dataclasses import replace

import numpy as np
import pytest

from core import Settings
from core.methods import table
from core.settings import families
from core.study import speed_accuracy
from core.study.families import study_families, study_family
from core.study.family import settings_of
from core.study.frame_task import check_pixel_tests
from core.study.record import Point, Study, StudyCancelledError, pareto_front
from core.study.speed_accuracy import measure, opening, pictures
from core.study.whole_picture import SAMPLED_COLOR, PictureTask, same_look, scaled, standard_scene
from core.study.workloads import sphere_scene
from lessons.scenes import make_scene

SMALL = {"size": 8, "cells": 4, "length": 16, "count": 6, "side": 32, "rings": 6, "scale": 0.125}
"""Values of dials that make the work of a test small."""
SCENE = replace(make_scene("cube"), size=(128, 96))
NUMBERS_ONLY = {"orientation", "depth-steps"}
"""Families that draw nothing."""
CASES = [
    pytest.param(family.name, work.name, marks=[pytest.mark.slow] if place else [])
    for family in study_families()
    for place, work in enumerate(family.works)
]


def small_dials(family: str, work: str) -> dict[str, float]:
    kind = study_family(family).work(work)
    small = SMALL if family != "dicing" else {"side": 128}  # the longer a side, the fewer there are
    return {dial.name: small[dial.name] for dial in kind.dials if dial.name in small}


def measured(family: str, work: str | None = None, **options) -> Study:
    kind = study_family(family).work(work)
    dials = small_dials(family, kind.name) | options.pop("dials", {})
    if family == "pipeline":
        options.setdefault("scene", SCENE)
    return measure(family, kind.name, dials, rounds=1, grow=False, **options)


def by_method(study: Study) -> dict[str, Point]:
    return {point.method: point for point in study.points}


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let one run be a block, and draw and fill small pictures."""
    monkeypatch.setattr("core.study.family.BLOCK", 0.0)
    monkeypatch.setattr("core.coverage.measured.SIZE", (64, 64))
    monkeypatch.setattr(
        "core.trees.measured.sphere_scene", lambda *parts: scaled(sphere_scene(*parts), 0.125)
    )


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize(("family", "work"), CASES)
def test_every_family_gives_numbers_or_reasons_and_has_pictures(family: str, work: str) -> None:
    study = measured(family, work)
    check_numbers(study)
    check_pictures(study)


def check_numbers(study: Study) -> None:
    """Check that every point has a number of every measure, or a reason."""
    names = {each.name for each in study.measures}
    assert study.points
    assert any(point.is_measured for point in study.points)
    for point in study.points:
        if point.refused:
            assert point.refused.endswith(".")
            assert not len(point.seconds)
            assert not point.errors
            continue
        assert len(point.seconds) == 1
        assert np.isfinite(point.median)
        assert point.median > 0
        assert point.unit_count > 0
        assert set(point.errors) == names
        for name, value in point.errors.items():
            assert (name in point.reasons) == bool(np.isnan(value))
            assert np.isnan(value) or value >= 0
        assert point.counts
        assert all(isinstance(count, int) and count >= 0 for count in point.counts.values())
        settings_of(study.settings, point.method)


def check_pictures(study: Study) -> None:
    """Check that the last point has pictures, and a scene that it opens in."""
    point = next(point for point in reversed(study.points) if point.is_measured)
    scene = SCENE if study.family == "pipeline" else None
    shown = pictures(study, point, scene)
    assert shown.result.shape == shown.reference.shape
    assert shown.difference.shape == shown.result.shape[:2]
    assert shown.result.dtype == shown.reference.dtype == shown.difference.dtype == np.float32
    where = opening(study, point, scene)
    assert (where is None) == (study.family in NUMBERS_ONLY)
    if where is not None and where.pixel is not None:
        column, row = where.pixel
        width, height = where.scene.size
        assert 0 <= column < width
        assert 0 <= row < height


def test_every_family_of_settings_has_a_study() -> None:
    names = {family.name for family in study_families()}
    varied = {name for family in study_families() for name in family.varies}
    several = {name for name in families() if len(table.names(name)) > 1}
    assert several <= varied
    assert "pipeline" in names
    assert len(names) == len(study_families())


def test_a_family_without_methods_yet_is_not_shown() -> None:
    for family in study_families():
        assert family.candidates(family.base), family.name


def test_all_methods_of_a_family_are_points() -> None:
    methods = [point.method for point in measured("fill").points]
    assert methods == [f"fill={name}" for name in table.names("fill")]


@pytest.mark.usefixtures("quick")
def test_the_work_is_the_same_for_the_same_seed() -> None:
    first, second = (by_method(measured("coverage", "slivers", seed=4)) for _ in range(2))
    other = by_method(measured("coverage", "slivers", seed=5))
    assert {name: dict(point.errors) for name, point in first.items()} != {
        name: dict(point.errors) for name, point in other.items()
    }
    for name, point in first.items():
        assert point.counts == second[name].counts
        assert point.errors["misclassified"] == second[name].errors["misclassified"]


# Published orderings, by work counts and errors


def test_integer_bresenham_needs_no_floats_and_is_never_worse_than_float_bresenham() -> None:
    study = measured("line", "pixel-ends", dials={"length": 64})
    points = by_method(study)
    integer, with_floats = points["line=bresenham"], points["line=bresenham-float"]
    assert not [name for name in integer.counts if name.startswith("float")]
    assert with_floats.counts["float additions"] > with_floats.counts["pixels drawn"]
    assert with_floats.counts["float divisions"] > 0
    assert integer.counts["pixels drawn"] == with_floats.counts["pixels drawn"]
    assert integer.errors["largest-distance"] <= 0.5 < with_floats.errors["largest-distance"] + 1e-9
    assert integer.errors["largest-distance"] <= with_floats.errors["largest-distance"]
    assert integer.errors["not-nearest"] == 0


def test_blocks_test_fewer_pixels_than_brute_force_on_small_triangles() -> None:
    points = by_method(measured("fill", "triangles", dials={"size": 4}))
    blocks, brute = points["fill=blocks"], points["fill=brute-force"]
    assert (
        100 * (blocks.counts["pixels tested"] + blocks.counts["blocks tested"])
        < brute.counts["pixels tested"]
    )
    assert blocks.counts["pixels covered"] == brute.counts["pixels covered"]
    assert blocks.errors["misclassified"] == brute.errors["misclassified"] == 0


def test_depth_crowds_at_a_far_plane_where_1_over_w_does_not() -> None:
    points = by_method(measured("depth", dials={"far": 1e5, "gap": 1e-5, "side": 64}))
    assert points["depth=z-float32"].errors["wrong-visible"] > 50_000
    for name in {"inverse-w", "reversed-z"} & set(table.names("depth")):
        assert points[f"depth={name}"].errors["wrong-visible"] == 0
        assert (
            points[f"depth={name}"].counts["pixels covered"]
            == points["depth=z-float32"].counts["pixels covered"]
        )


# What the errors say


def test_errors_are_where_they_have_to_be() -> None:
    rules = by_method(measured("coverage", "ties"))
    assert rules["coverage=snapped"].errors["cracks"] == 0
    assert rules["fill_rule=inclusive"].errors["cracks"] > 0
    assert rules["fill_rule=exclusive"].errors["cracks"] > 0
    square = by_method(measured("interpolation", dials={"w-ratio": 4, "side": 64}))
    assert square["interpolation=perspective"].errors["largest-texel"] < 1e-9
    # The closed form: an affine coordinate is wrong by (sqrt r - 1)/(sqrt r + 1) of the edge at most.
    assert square["interpolation=affine"].errors["largest-texel"] == pytest.approx(256 / 3, rel=0.01)
    cycle = by_method(measured("visibility", "cycle"))
    assert cycle["visibility=z-buffer"].errors["wrong-visible"] == 0
    assert cycle["visibility=painters"].errors["wrong-visible"] > 0
    culled = by_method(measured("cull", "closed"))
    # At the rim a back face may be the nearest at a centre that only snapping gives to both.
    assert culled["cull=back"].errors["wrong-visible"] < 500 < culled["cull=front"].errors["wrong-visible"]
    assert culled["cull=back"].counts["triangles drawn"] < culled["cull=none"].counts["triangles drawn"]
    assert by_method(measured("cull", "open"))["cull=back"].errors["wrong-visible"] > 0
    shaded = by_method(measured("shading", dials={"rings": 12, "side": 64}))
    error = {name: shaded[f"shading={name}"].errors["mean-color"] for name in ("phong", "gouraud", "flat")}
    assert error["phong"] < error["gouraud"] < error["flat"]


def test_magnified_bilinear_is_near_its_samples_and_nearest_is_not() -> None:
    points = by_method(measured("texture_filter", "facing", dials={"density": 0.125}))
    bilinear, nearest = points["texture_filter=bilinear"], points["texture_filter=nearest"]
    assert 5 * bilinear.errors["mean-color"] < nearest.errors["mean-color"]
    assert bilinear.counts["texels read"] == 4 * nearest.counts["texels read"]


# Measuring


@pytest.mark.slow
def test_pipeline_measures_the_scene_and_settings_that_are_given() -> None:
    scene = scaled(standard_scene(), 0.25)
    base = Settings(shading="flat", cull="back")
    study = measure(
        "pipeline", dials={"scale": 1}, scene=scene, settings=base, scene_title="two", rounds=1, grow=False
    )
    assert study.scene == "two"
    assert study.settings == base
    points = by_method(study)
    assert points["fill=spans"].title == "Unchanged"
    assert points["fill=spans"].counts["triangles drawn"] < points["cull=none"].counts["triangles drawn"]
    assert points["shading=unlit"].errors["mean-color"] > points["fill=spans"].errors["mean-color"]
    assert "line=dda" not in points
    shown = pictures(study, points["shading=unlit"], scene)
    assert shown.result.shape == (*scene.size[::-1], 4)


def test_outlines_with_samples_are_as_bright_whatever_the_blending_keeps() -> None:
    scene = scaled(standard_scene(), 0.25)
    for name in ("msaa-4", "ssaa-16"):
        base = Settings(antialiasing=name)
        task = PictureTask(scene, same_look(base))
        opaque, over = (
            task.run(settings).errors[SAMPLED_COLOR.name] for settings in (base, replace(base, blend="over"))
        )
        assert opaque == pytest.approx(over, rel=1e-3)  # opaque pictures may be a byte off here and there


def test_a_scene_is_refused_where_the_family_makes_its_own() -> None:
    with pytest.raises(ValueError, match="fill makes its own scene"):
        measure("fill", scene=standard_scene())


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"family": "colour"}, "family must be one of line, fill"),
        ({"family": "fill", "work": "circles"}, "work of fill must be one of triangles, slivers"),
        ({"family": "fill", "dials": {"angle": 1}}, "dial of triangles must be one of size, got angle"),
        ({"family": "fill", "dials": {"size": 1000}}, "size must be from 2 to 256, got 1000"),
        ({"family": "fill", "rounds": 0}, "rounds must be at least 1, got 0"),
    ],
)
def test_wrong_input_is_told(options: dict, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        measure(**options)


def test_a_method_that_refuses_is_a_point_without_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("core.study.frame_task.MOST_TESTS", 1000)
    refused: list[Point] = []
    study = measure(
        "fill",
        dials={"size": 2},
        rounds=1,
        grow=False,
        point_done=lambda p: refused.append(p) if p.refused else None,
    )
    point = by_method(study)["fill=brute-force"]
    assert point.refused.startswith("Brute force would test 3,145,728 pixels")
    assert not point.is_measured
    assert [each.method for each in refused] == ["fill=brute-force"]
    assert point not in pareto_front(study.points, "misclassified")
    with pytest.raises(ValueError, match="was refused"):
        pictures(study, point)


def test_what_goes_wrong_in_a_method_is_not_hidden(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_arguments) -> None:
        raise RuntimeError("a bug")

    monkeypatch.setattr("core.study.frame_task.render", broken)
    with pytest.raises(RuntimeError, match="a bug"):
        measured("fill")
    assert gc.isenabled()


def test_a_lack_of_memory_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    def too_large(*_arguments) -> None:
        raise MemoryError

    monkeypatch.setattr("core.study.frame_task.render", too_large)
    assert {point.refused for point in measured("fill").points} == {
        "There is not enough memory for this work."
    }


@pytest.mark.parametrize("after", [0, 1, 5, 9])
def test_cancelling_leaves_nothing_half(after: int) -> None:
    asked: list[bool] = []

    def is_cancelled() -> bool:
        asked.append(gc.isenabled())
        return len(asked) > after

    with pytest.raises(StudyCancelledError):
        measure("cull", dials={"rings": 4}, rounds=3, grow=True, is_cancelled=is_cancelled)
    assert len(asked) == after + 1
    assert all(asked)
    assert gc.isenabled()


def test_progress_rises_and_points_come_one_by_one() -> None:
    fractions: list[float] = []
    points: list[Point] = []
    study = measure(
        "cull",
        dials={"rings": 4},
        rounds=3,
        grow=False,
        progress=lambda fraction, doing: fractions.append(fraction) if doing else None,
        point_done=points.append,
    )
    assert fractions == sorted(fractions)
    assert fractions[0] == 0
    assert fractions[-1] <= 1
    count = len(table.names("cull"))
    assert [len(point.seconds) for point in points] == [1] * count + [2] * count + [3] * count
    assert {id(point) for point in study.points} <= {id(point) for point in points}


def test_slow_methods_take_fewer_rounds(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(speed_accuracy, "BUDGET", 0.0)
    study = measure("cull", dials={"rings": 4}, rounds=5, grow=False)
    assert {len(point.seconds) for point in study.points} == {1}


@pytest.mark.slow
def test_growth_has_all_values_of_the_cost_dial_and_leaves_out_what_is_too_slow(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    study = measure("visibility", "layers", {"count": 8}, rounds=1)
    assert list(study.growth) == [2, 4, 8, 16, 32, 64, 128]
    assert study.growth[8] == study.points
    assert all(point.is_measured and not point.errors for point in study.growth[64])
    monkeypatch.setattr(speed_accuracy, "BUDGET", 0.0)
    slow = measure("visibility", "layers", {"count": 8}, rounds=1)
    assert slow.growth[16] == ()


def test_a_brute_force_that_would_take_minutes_is_refused() -> None:
    scene = replace(standard_scene(), size=(4096, 4096))
    with pytest.raises(ValueError, match="choose fewer triangles or a smaller picture"):
        check_pixel_tests(scene, Settings(fill="brute-force"))
    check_pixel_tests(scene, Settings(fill="spans"))
