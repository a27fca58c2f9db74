"""Study of line clipping: exact signs are right everywhere, rounded ones off ties, the printed method not on ties."""

import pytest

from core.study.families import study_family
from core.study.speed_accuracy import measure, opening, pictures

WORKS = [work.name for work in study_family("line_clipping").works]


def errors_of(work: str) -> dict[str, dict[str, float]]:
    study = measure("line_clipping", work, {"count": 300}, rounds=1, grow=False)
    return {point.method.removeprefix("line_clipping="): dict(point.errors) for point in study.points}


@pytest.mark.parametrize("work", WORKS)
def test_exact_signs_are_right_and_clippers_stay_within_four_ulp(work):
    errors = errors_of(work)
    assert errors["exact"] == {"largest-ulp": 0, "mean-ulp": 0, "decisions": 0}
    for name in ("cohen-sutherland", "liang-barsky", "cyrus-beck"):
        assert errors[name]["largest-ulp"] <= 4
        assert errors[name]["mean-ulp"] <= errors[name]["largest-ulp"]
    assert errors["none"]["decisions"] > 10_000


def test_past_corners_rounding_decides_and_exact_signs_do_not_round():
    errors = errors_of("corners")
    assert errors["liang-barsky"]["decisions"] > 0
    assert errors["cohen-sutherland"]["decisions"] > 0


def test_cyrus_beck_as_printed_keeps_segments_that_lie_outside_along_a_border():
    errors = errors_of("ties")
    assert errors["cyrus-beck-lecture"]["decisions"] > 0
    assert errors["cyrus-beck"]["decisions"] == errors["liang-barsky"]["decisions"] == 0


def test_a_wrong_decision_shows_in_the_picture_and_opens():
    study = measure("line_clipping", "ties", {"count": 300}, rounds=1, grow=False)
    point = next(each for each in study.points if each.method == "line_clipping=cyrus-beck-lecture")
    assert pictures(study, point).difference.any()
    where = opening(study, point)
    assert where.settings.polygon_mode == "wireframe"
    assert where.settings.line_clipping == "cyrus-beck-lecture"
