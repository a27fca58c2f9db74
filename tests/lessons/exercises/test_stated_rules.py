"""Exercises on pixels: their answers follow from the rule that the question states, in exact numbers."""

import re
from collections.abc import Callable
from fractions import Fraction
from math import floor

import numpy as np
import pytest

from core import render
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.drafting import place_text, seen_pixels
from lessons.exercises.numbers import are_close
from lessons.exercises.question import ask
from lessons.exercises.templates.filling import is_decided
from tests.lessons.exercises.first_questions import first_question

HALF = Fraction(1, 2)
Place = tuple[Fraction, Fraction]
SEEDS = range(12)


def nearest(start: Place, end: Place, pixel: Place) -> bool:
    """Say whether the centre is the closest of its column; half way, the upper one."""
    (x0, y0), (x1, y1), (x, y) = start, end, pixel
    return x0 <= x <= x1 and floor(y0 + (x - x0) * (y1 - y0) / (x1 - x0)) == y - HALF


def left_or_last(start: Place, end: Place, pixel: Place) -> bool:
    """Say whether the line meets the open diamond: leaves it, or ends in it; touching it must not happen."""
    direction = [b - a for a, b in zip(start, end, strict=True)]
    times = [(p - a) / d for a, d, p in zip(start, direction, pixel, strict=True)]
    nearest_place = min(
        sum(abs(a + t * d - p) for a, d, p in zip(start, direction, pixel, strict=True))
        for t in (Fraction(0), Fraction(1), *times)
        if 0 <= t <= 1
    )
    assert nearest_place != HALF
    return nearest_place < HALF


def beside(start: Place, end: Place, pixel: Place) -> bool:
    """Say whether the centre lies in the rectangle around the segment; one near its rim must not exist."""
    (x0, y0), (x1, y1), (x, y) = start, end, pixel
    length = float(np.hypot(float(x1 - x0), float(y1 - y0)))
    along = float((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / length
    aside = abs(float((x - x0) * (y1 - y0) - (y - y0) * (x1 - x0))) / length
    inside = min(along, length - along, 0.5 - aside)
    assert abs(inside) > 0.01
    return inside > 0


@pytest.mark.parametrize(
    ("name", "rule"), [("midpoint-line", nearest), ("diamond-exit", left_or_last), ("rectangle-line", beside)]
)
def test_the_answer_follows_from_the_stated_rule(
    name: str, rule: Callable[[Place, Place, Place], bool]
) -> None:
    for seed in SEEDS:
        question = ask(TEMPLATES[name], seed)
        columns, rows = question.draft.answer.size
        clip = question.draft.scene.clip[0, :, :2]
        start, end = (
            tuple(
                Fraction(round((c + 1) / 2 * size * 20), 20)
                for c, size in zip(one, (columns, rows), strict=True)
            )
            for one in clip.tolist()
        )
        found = {
            (i, j) for i in range(columns) for j in range(rows) if rule(start, end, (i + HALF, j + HALF))
        }
        assert question.draft.answer.reference == found, question.mark


def test_no_centre_lies_on_a_side_that_snapping_moves() -> None:
    # The centre (8.5, 1.5) lies on the first side exactly; snapped to 1/256 pixel the side runs beside it.
    tenths = [[(73, 7), (91, 19), (62, 86)], [(73, 7), (91, 21), (62, 86)]]
    on_side, clear = ([(Fraction(x, 10), Fraction(y, 10)) for x, y in one] for one in tenths)
    assert not is_decided(on_side)
    assert is_decided(clear)
    assert is_decided([(Fraction(1, 2), HALF), (Fraction(9, 2), HALF), (HALF, Fraction(5, 2))])


def test_what_every_question_says_and_shows() -> None:
    for name in TEMPLATES:
        draft = first_question(name).draft
        # No sentence of a file is broken in the middle.
        for line in draft.text.strip().split("\n")[:-1]:
            assert line.endswith((".", "?", ":")), name
        # What is answered on the picture says where row 0 is.
        if draft.answer.kind in ("pixels", "places", "spot"):
            assert "row 0 at the bottom" in draft.given or "Window 0.." in draft.given, name
        # A sketch shows what is given, and nothing else.
        for _, place in () if draft.sketch is None else draft.sketch.points:
            assert place_text(place) in draft.given + draft.text, name


@pytest.mark.parametrize("name", ["outside-one-border", "rejected-at-once", "cohen-sutherland-table"])
def test_what_lies_on_a_border_is_said_where_it_decides(name: str) -> None:
    assert "on a border is inside" in ask(TEMPLATES[name], 0).draft.text


def test_a_line_is_printed_from_exact_numbers() -> None:
    # With floats 2 + 3/6 grew to less than 5/2 here, and the pixel of the tie was the lower one.
    draft = ask(TEMPLATES["printed-line"], 96).draft
    assert "From (0, 2) to (10, 5)" in draft.given
    assert "round(y)" in draft.given
    assert "1/2 is rounded up" in draft.text
    assert draft.answer.reference == {(x, floor(2 + Fraction(3 * x, 10) + HALF)) for x in range(10)}


def covered(corners: list[Place]) -> set[tuple[int, int]]:
    """Return the pixels of a counter-clockwise triangle, by the stated rule."""
    sides = [
        (start[1] - end[1], end[0] - start[0], start)
        for start, end in zip(corners, [*corners[1:], corners[0]], strict=True)
    ]
    return {
        (i, j)
        for i in range(12)
        for j in range(9)
        if all(
            (value := a * (i + HALF - x) + b * (j + HALF - y)) > 0 or (value == 0 and (a > 0 or a == 0 < b))
            for a, b, (x, y) in sides
        )
    }


def test_the_near_plane_turns_no_edge_that_runs_through_centres() -> None:
    for seed in (3, 9):
        given = ask(TEMPLATES["pixels-beyond-near"], seed).draft.given
        places = re.findall(r"\(([0-9.]+), ([0-9.]+)\)", given)
        border = Fraction(re.search(r"\(x - ([0-9]+)\)", given)[1])
        pixels = covered([(Fraction(x), Fraction(y)) for x, y in places])
        right = ask(TEMPLATES["pixels-beyond-near"], seed).draft.answer.reference
        assert right == {(i, j) for i, j in pixels if i >= border}


def test_a_wrong_method_is_not_within_the_tolerance() -> None:
    for seed in range(8):
        draft = ask(TEMPLATES["reciprocal-w"], seed).draft
        assert draft.mistakes["distance-linear"]
        table = ask(TEMPLATES["inverse-w-table"], seed).draft
        for wrong in table.mistakes.values():
            for mine, its in zip(wrong, table.answer.reference, strict=True):
                assert mine == its or not are_close(mine[0], its[0], table.answer.tolerance)


@pytest.mark.slow
def test_every_exercise_has_variants_and_none_always_one_number() -> None:
    for template in TEMPLATES.values():
        if template.is_fixed:
            continue
        drafts = [ask(template, seed).draft for seed in range(12)]
        variants = {(draft.text, draft.given, draft.answer.offered) for draft in drafts}
        assert len(variants) > 1, template.name
        answers = {draft.answer.text(draft.answer.reference) for draft in drafts}
        if drafts[0].answer.kind in ("numbers", "pixels", "places", "table"):
            assert len(answers) > 1, template.name


def test_a_square_is_as_its_two_triangles_with_their_borders() -> None:
    for seed in SEEDS:
        draft = ask(TEMPLATES["level-sides"], seed).draft
        assert seen_pixels(render(draft.scene, draft.settings)) == draft.answer.reference
