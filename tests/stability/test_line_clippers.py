"""Line clippers on segments along a border, of no length, and past a corner."""

import re

import numpy as np
import pytest

from core.lines.line_clipping import clip_lines
from core.lines.measured import clipped_ends
from core.lines.measured_clipping import PROMISED, SIDE, judge_clip, stretch_text
from core.study.record import Outcome, Verdict
from core.study.stability import experiments, stress
from core.trace import trace
from tests.covering import is_everything
from tests.stability.maps import is_right_everywhere, outcomes

NAMES = ("parallel-segments", "zero-length-segments", "segments-past-a-corner")


def judged(segment: np.ndarray, clipper: str) -> Verdict:
    return judge_clip(segment, clip_lines(segment[None], (0, 0, SIDE, SIDE), clipper))


@pytest.mark.parametrize("name", NAMES)
def test_exact_signs_hold_everywhere(name: str) -> None:
    assert is_right_everywhere(name, "line_clipping=exact")


def test_exact_signs_hold_on_random_segments_at_the_border() -> None:
    source = np.random.default_rng(3)
    for _ in range(150 if is_everything() else 40):
        ends = (
            source.choice([-9.3, 0.0, 17.7, 64.0, 80.1], (2, 2)) + source.integers(-3, 4, (2, 2)) * 2.0**-46
        )
        assert judged(ends, "exact").outcome == Outcome.RIGHT


def test_the_printed_program_keeps_parallel_segments_outside() -> None:
    for (first, second), outcome in outcomes("parallel-segments", "line_clipping=cyrus-beck-lecture").items():
        is_outside_and_level = first == second > 0
        assert outcome == (Outcome.DOUBLE_HIT if is_outside_and_level else Outcome.RIGHT)


@pytest.mark.parametrize("method", ["line_clipping=liang-barsky", "line_clipping=cyrus-beck"])
def test_parametric_clippers_hold_along_a_border(method: str) -> None:
    assert is_right_everywhere("parallel-segments", method)
    assert is_right_everywhere("zero-length-segments", method)


def test_cohen_sutherland_moves_ends_that_lie_along_a_border() -> None:
    assert Outcome.DOUBLE_HIT in outcomes("parallel-segments", "line_clipping=cohen-sutherland").values()


def test_upright_segments_outside_are_kept_by_the_printed_program_and_points_are_not() -> None:
    found = outcomes("zero-length-segments", "line_clipping=cyrus-beck-lecture")
    assert {outcome for (across, up), outcome in found.items() if across == 0 != up} == {Outcome.DOUBLE_HIT}
    assert found[0.0, 0.0] == Outcome.RIGHT


@pytest.mark.parametrize(
    "method", ["line_clipping=cohen-sutherland", "line_clipping=liang-barsky", "line_clipping=cyrus-beck"]
)
def test_rounded_crossings_err_at_a_corner_and_only_there(method: str) -> None:
    found = outcomes("segments-past-a-corner", method)
    assert Outcome.DOUBLE_HIT in found.values()
    assert {outcome for (offset, _), outcome in found.items() if abs(offset) > PROMISED} == {Outcome.RIGHT}


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_remarks_are_sentences_with_short_numbers(name: str) -> None:
    said = {remark for each in stress(name).maps for row in each.remarks for remark in row}
    assert all(re.match(r"the (segment|ends) ", remark) for remark in said)
    assert not [remark for remark in said if re.search(r"[\[\]]|[1-9]\d{4}", remark)]


def test_a_remark_tells_where_a_wrong_stretch_lies() -> None:
    level = np.array([[-9.0, 64.0 + 2.0**-45], [80.0, 64.0 + 2.0**-45]])
    verdict = judged(level, "cyrus-beck-lecture")
    assert verdict.remark == "the segment is kept from (0, 64) to (64, 64), but lies outside"
    assert stretch_text([[64.0, 64.0], [64.0, 64.0 + 2.0**-45]]) == "at (64, 64)"
    assert stretch_text([[0.0, np.nan], [1.25, -np.inf]]) == "from (0, nan) to (1.25, -inf)"


def test_the_reference_keeps_the_border() -> None:
    assert clipped_ends(np.array([[-1.0, 64.0], [70.0, 64.0]]), (0, 0, 64, 64)) == ((0, 64), (64, 64))
    assert clipped_ends(np.array([[64.5, 1.0], [64.5, 1.0]]), (0, 0, 64, 64)) is None
    assert clipped_ends(np.array([[64.0, 1.0], [64.0, 1.0]]), (0, 0, 64, 64)) == ((64, 1), (64, 1))


def test_a_segment_opens_as_an_edge_and_a_point_does_not() -> None:
    experiment = experiments.get("zero-length-segments")
    opened = experiment.opening("line_clipping=liang-barsky", (-6.0, -6.0), 0)
    assert opened.settings.polygon_mode == "wireframe"
    assert opened.settings.line_clipping == "liang-barsky"
    stage = trace(opened.scene, opened.settings).stage("raster")
    kinds = {stage.steps.kinds[kind] for kind in stage.steps.kind}
    assert {"clip-enter", "clip-leave"} <= kinds
    assert experiment.opening("line_clipping=liang-barsky", (0.0, 0.0), 0) is None
