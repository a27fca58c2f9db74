"""Every step has a sentence, with its real numbers and its reason."""

import re

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core import STAGES, Settings
from core.explain.number_text import (
    FEW_STEPS,
    exact_text,
    fraction_text,
    number_text,
    pair_text,
    parse_number,
    position_text,
    steps_apart,
)
from core.explain.stage_texts import summary_sentence
from core.explain.steps import sentence
from core.records.steps import Level
from core.records.words import counted, joined
from core.trace.stage_trace import Explanation
from tests.core.explain.explained_steps import all_said, explained, rare_trace, said, steps_of

NUMBERS = {
    "transform.object-to-world.x": "after_x",
    "transform.camera-to-clip.w": "after_w",
    "transform.divide.z": "after_z",
    "transform.viewport.y": "after_y",
    "cull.facing.test": "facing",
    "clip.in-out.t": "t",
    "clip.out-in.t": "t",
    "edges.orientation.area": "doubled_area",
    "edges.edge.a": "a",
    "edges.edge.b": "b",
    "edges.edge.c": "c",
    "raster.test.edge-0": "value_0",
    "raster.test.edge-1": "value_1",
    "raster.test.edge-2": "value_2",
    "interpolate.perspective.total": "total",
    "interpolate.affine.total": "total",
    "depth.test.value": "value",
    "depth.store.value": "value",
    "depth.test.depth": "stored",
    "depth.store.depth": "stored",
    "depth.ray-first.hit": "nearness",
    "depth.ray.hit": "nearness",
    "depth.out-of-range.range": "depth",
}
"""Keys whose sentence must give this number."""


def test_every_step_has_a_finished_sentence() -> None:
    for _, text, *_ in all_said():
        assert re.fullmatch(r"[A-Z].*\.", text), text
        assert not re.search(r"[{}\[\]]|\bnan\b|\binf\b|None|array|\s\s|\.\.|(?<!fixed)-\d", text), text
        assert ". " not in text, f"more than one sentence: {text}"
        assert len(text) < 330, text


def test_what_has_a_number_in_its_triangle_names_the_triangle() -> None:
    """A view may label the edges of another one: that of the pixel pinned."""
    for group in ("scenes", "rare"):
        for (explanation, triangle, _), (_, text, *_) in zip(explained(group), said(group), strict=True):
            if explanation.corner_count == 3:
                is_numbered = re.search(r"\b(?:edge|corner|vertex|E|λ)s? ?\d|(?i:this triangle)", text)
                assert not is_numbered or f"riangle {triangle}" in text, text


def test_nothing_is_undefined_in_the_built_in_scenes() -> None:
    for explanation, text, *_ in said("scenes"):
        # Products above 65,504 are infinite in float16, and their differences no numbers.
        if explanation.values.get("number_format") != "float16":
            assert "NaN" not in text


def test_an_undefined_number_is_said_only_where_there_is_one() -> None:
    count = 0
    overflown = [
        (step[0], sentence(*step)) for step in steps_of(rare_trace("far-away", Settings(coverage="float16")))
    ]
    for explanation, text in (*(step[:2] for step in said("rare")), *overflown):
        if "NaN" in text:
            count += 1
            names = {*explanation.known, "before", "after"} & set(explanation.values)
            values = [value for value in map(explanation.values.get, names) if not isinstance(value, str)]
            numbers = np.concatenate([np.ravel(np.asarray(value, float)) for value in values])
            assert np.isnan(numbers).any(), text
    assert count


def test_sentences_give_the_numbers_of_the_step() -> None:
    found = set()
    for explanation, text, *_ in all_said():
        variable = NUMBERS.get(explanation.key)
        if variable:
            found.add(explanation.key)
            number = exact_text(float(np.asarray(explanation.values[variable])))
            assert number in text
    assert found == set(NUMBERS)


def test_an_operation_without_a_row_lists_what_it_sets() -> None:
    values = {"slope": 0.5, "pixels": np.array([1.0, 2.0])}
    made = Explanation("lines.walk.next-pixel", values, ("slope", "pixels"), ("slope", "pixels"), None, 0)
    assert sentence(made, 0, None) == "Walk, next pixel: slope is 0.5 and pixels is (1, 2)."


def test_every_stage_can_be_summed_up() -> None:
    for stage in STAGES:
        traced = rare_trace("unsnapped", Settings()).stage(stage)
        for level in (Level.STAGE, Level.TRIANGLE, Level.GROUP, Level.PIXEL):
            text = summary_sentence(stage, level, traced.summary(0, traced.steps.row_count), 0)
            beginning = "Whole stage" if level == Level.STAGE else "Triangle 0"
            assert re.fullmatch(beginning + r"[^{}]*\.", text), text


def test_words_and_numbers() -> None:
    assert joined([]) == ""
    assert joined(["a", "b", "c"]) == "a, b and c"
    assert counted(1, "pixel") == "1 pixel"
    assert counted(2048, "pixel") == "2,048 pixels"
    assert position_text([22.5, 41 + 77 / 256]) == "(22.5, 41 77/256)"
    assert position_text([float("nan"), -3.0]) == "(NaN, −3)"
    assert pair_text(0.5, 0.5) == ("0.5", "0.5")
    assert pair_text(0.1234567, 0.1234568) == ("0.1234567", "0.1234568")


@given(st.floats(-10, 10), st.floats(1e-12, 1e-3))
def test_two_numbers_are_written_alike_only_if_they_are_the_same(value: float, more: float) -> None:
    first, second = pair_text(value, value + more)
    assert (first == second) == (value == value + more)


@given(st.integers(-2000, 2000))
def test_a_mixed_fraction_reads_back_and_has_a_whole_part_only_where_there_is_one(count: int) -> None:
    text = fraction_text(count / 256)
    assert parse_number(text) == count / 256
    assert (" " in text) == (abs(count) > 256 and count % 256 != 0)


@given(st.floats(0.5, 2.0, width=32), st.integers(1, 2 * FEW_STEPS))
def test_steps_of_float32_are_counted_where_they_are_few(value: float, steps: int) -> None:
    above = float((np.float32(value).view(np.int32) + np.int32(steps)).view(np.float32))
    few = f"{counted(steps, 'unit')} in the last place of float32 apart" if steps <= FEW_STEPS else ""
    assert steps_apart(value, above, is_whole=False) == steps_apart(above, value, is_whole=False) == few


@given(st.integers(-999_999, 999_999))
def test_whole_numbers_keep_six_figures(value: int) -> None:
    assert number_text(value) == str(value).replace("-", "\u2212")
