"""Which number format fails on slivers, far corners, singular matrices and small triangles, and which ones hold."""

import pytest

from core import Settings, render
from core.coverage.measured_cover import as_given, count_cover
from core.coverage.measured_triangles import crowded_mesh, edge_on, sliver
from core.study.record import Outcome
from core.study.stability import experiments
from tests.covering import every_nth
from tests.stability.maps import is_right_everywhere, outcomes, wrong_at_random

NAMES = ("precision-dial", "slivers", "coordinates", "singular-matrix")


@pytest.mark.parametrize("name", NAMES)
def test_exact_numbers_are_right_everywhere(name: str) -> None:
    assert is_right_everywhere(name, "coverage=exact", every=3)
    assert wrong_at_random(name, "coverage=exact") == []


def test_a_triangle_flatter_than_a_float_can_tell_is_drawn_by_exact_numbers() -> None:
    place = (6.762111428779897e-17, 0.01964320596866134)
    scene = edge_on(place, 0)
    frame = render(scene, Settings(coverage="exact", cull="back"))
    assert (frame.cover_count == as_given(scene, Settings())).all()
    assert frame.cover_count.sum() == 11


@pytest.mark.parametrize(
    ("method", "right_from", "wrong_up_to"),
    every_nth(
        [
            ("coverage=float16", 0.5, 2.0**-6),
            ("coverage=snapped", 2.0**-8, 2.0**-10),
            ("coverage=int64", 2.0**-8, 2.0**-10),
            ("coverage=float32", 2.0**-17, 2.0**-20),
            ("coverage=float64", 2.0**-46, 2.0**-47),
            ("coverage=inverse", 2.0**-47, 2.0**-48),
        ],
        3,
    ),
)
def test_every_format_decides_down_to_its_own_spacing(
    method: str, right_from: float, wrong_up_to: float
) -> None:
    found = outcomes("precision-dial", method)
    if method != "coverage=float16":
        assert all(outcome == Outcome.RIGHT for (offset,), outcome in found.items() if offset >= right_from)
    assert all(outcome != Outcome.RIGHT for (offset,), outcome in found.items() if offset <= wrong_up_to)


def test_snapped_corners_lose_slivers_thinner_than_a_step() -> None:
    found = outcomes("slivers", "coverage=snapped", every=2)
    lost = [width for (width, offset), outcome in found.items() if outcome == Outcome.HOLE]
    assert min(lost) < 2.0**-9
    assert all(
        outcome == Outcome.HOLE for (width, offset), outcome in found.items() if offset < width < 2.0**-9
    )
    assert found == outcomes("slivers", "coverage=int64", every=2)


def test_floats_lose_slivers_below_their_spacing() -> None:
    for method, still, not_any_more in (
        ("coverage=float32", 2.0**-11, 2.0**-20),
        ("coverage=float64", 2.0**-44, 2.0**-47),
    ):
        found = outcomes("slivers", method, every=2)
        assert all(outcome == Outcome.RIGHT for (_, offset), outcome in found.items() if offset >= still)
        assert any(
            outcome != Outcome.RIGHT for (_, offset), outcome in found.items() if offset <= not_any_more
        )


@pytest.mark.parametrize(
    ("method", "last_right", "outcome"),
    every_nth(
        [
            ("coverage=fixed-24.8", 2.0**6, Outcome.OVERFLOW),
            ("coverage=int64", 2.0**22, Outcome.OVERFLOW),
            ("coverage=float32", 2.0**16, Outcome.HOLE),
        ],
        3,
    ),
)
def test_far_corners_leave_the_range_of_numbers(method: str, last_right: float, outcome: Outcome) -> None:
    found = outcomes("coordinates", method, every=2)
    assert all(each == Outcome.RIGHT for (distance, _), each in found.items() if distance <= last_right)
    assert outcome in {each for (distance, _), each in found.items() if distance > last_right}
    if outcome == Outcome.OVERFLOW:
        assert {each for (distance, _), each in found.items() if distance > 2 * last_right} == {outcome}


def test_float16_is_not_a_number_beyond_its_range() -> None:
    found = outcomes("coordinates", "coverage=float16", every=3)
    assert Outcome.NOT_A_NUMBER in found.values()


@pytest.mark.parametrize("method", ["coverage=float64", "coverage=snapped"])
def test_float64_holds_far_corners(method: str) -> None:
    assert is_right_everywhere("coordinates", method, every=4)


@pytest.mark.parametrize(
    "method", ["coverage=float32", "coverage=inverse", "coverage=snapped", "coverage=float64"]
)
def test_formats_lose_triangles_seen_almost_edge_on(method: str) -> None:
    found = outcomes("singular-matrix", method, every=3)
    assert {Outcome.HOLE, Outcome.DOUBLE_HIT} & set(found.values())
    assert all(outcome == Outcome.RIGHT for (distance, _), outcome in found.items() if distance >= 2.0**-3)


def test_elimination_fails_before_the_adjugate() -> None:
    wrong = {
        method: sum(
            outcome != Outcome.RIGHT for outcome in outcomes("singular-matrix", method, every=2).values()
        )
        for method in ("coverage=inverse", "coverage=float64", "coverage=float32")
    }
    assert wrong["coverage=float64"] < wrong["coverage=inverse"] < wrong["coverage=float32"]


def test_snapping_turns_small_triangles_over() -> None:
    found = outcomes("snapping", "coverage=snapped", every=2) | outcomes("snapping", "coverage=snapped", 3, 2)
    wrong = [cell for (cell, _), outcome in found.items() if outcome == Outcome.DOUBLE_HIT]
    assert wrong
    assert 2.0**-11 <= min(wrong) <= max(wrong) <= 2.0**-7


def test_float32_draws_small_triangles_twice_and_float64_does_not() -> None:
    found = outcomes("snapping", "coverage=float32", every=4)
    assert all(outcome != Outcome.RIGHT for (cell, _), outcome in found.items() if cell < 2.0**-12)
    assert all(outcome == Outcome.RIGHT for (cell, _), outcome in found.items() if cell > 2.0**-6)
    for method in ("coverage=float64", "coverage=exact"):
        assert is_right_everywhere("snapping", method, every=4)
        assert wrong_at_random("snapping", method, 6) == []


@pytest.mark.parametrize("coverage", ["float16", "snapped", "int64", "exact"])
def test_the_pixels_that_are_judged_are_those_of_the_picture(coverage: str) -> None:
    settings = Settings(fill="bounding-box", coverage=coverage)
    for scene in (sliver((2.0**-6, 2.0**-8), 0), crowded_mesh((0.125, 0.25), 1)):
        cover, _ = count_cover(scene, settings)
        assert (cover == render(scene, settings).cover_count).all()


def test_a_click_opens_the_very_case_at_its_first_wrong_pixel() -> None:
    experiment = experiments.get("slivers")
    opened = experiment.opening("coverage=snapped", (2.0**-12, 2.0**-14), 0)
    assert opened.settings.coverage == "snapped"
    column, row = opened.pixel
    assert render(opened.scene, opened.settings).cover_count[row, column] == 0
    assert experiment.opening("coverage=exact", (2.0**-12, 2.0**-14), 0).pixel is None
