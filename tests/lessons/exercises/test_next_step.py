"""Questions about a run that is stepped: judged by the same answers as those of the exercises."""

from fractions import Fraction

import pytest

from core import Settings, trace
from core.explain.steps import question
from lessons.exercises.answers.choices import ChoiceAnswer
from lessons.exercises.question import coverage_sentence, next_draft, pixel_sentence, row_draft
from lessons.small_scenes import triangle_scene

SIZE = (8, 6)
TRACED = trace(triangle_scene([[(1, 1), (6, 2), (3, 5)]], SIZE), Settings(fill="bounding-box"))
RASTER = TRACED.source.raster


def test_coverage_is_asked_as_a_whole_and_then_row_by_row() -> None:
    stage = TRACED.stage("raster")
    asked = next_draft(stage, RASTER, 0)
    assert asked.answer.size == SIZE
    assert coverage_sentence(asked.answer, frozenset({(2, 1), (0, 0)})).startswith("1 of ")
    assert pixel_sentence(asked.answer, (0, 0), RASTER) == "(0, 0) is not covered."
    row = next_draft(stage, RASTER, 1)
    assert isinstance(row.answer, ChoiceAnswer)
    assert row.text.startswith("Does triangle 0 cover pixel (")
    assert row.pixel == tuple(stage.pixel[stage.steps.rows_done(1)])
    assert next_draft(stage, RASTER, stage.steps.count) is None


def test_where_nothing_is_covered_single_pixels_are_asked() -> None:
    empty = trace(triangle_scene([[(1.6, 1.6), (2.4, 1.6), (1.6, 2.4)]], SIZE), Settings(fill="bounding-box"))
    asked = next_draft(empty.stage("raster"), empty.source.raster, 0)
    assert asked is None or isinstance(asked.answer, ChoiceAnswer)


def test_numbers_count_within_one_percent() -> None:
    stage = TRACED.stage("interpolate")
    asked, answer = question(stage, 3), row_draft(stage, 3).answer
    right = Fraction(asked.answer)
    assert answer.check((right * Fraction(1009, 1000),)).score == 1
    assert answer.check((right * Fraction(1011, 1000),)).score == 0
    assert row_draft(stage, 3).text.endswith("? (within 1 %)")
    assert row_draft(stage, 3).reveal == asked.reveal


@pytest.mark.parametrize("stage", ["cull", "shade"])
def test_stages_without_questions_ask_none(stage: str) -> None:
    assert next_draft(TRACED.stage(stage), RASTER, 0) is None
