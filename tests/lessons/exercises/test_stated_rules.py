"""Exercises on pixels: their answers follow from the rule that the question states, in exact numbers."""

from collections.abc import Callable
from fractions import Fraction
from math import floor

import numpy as np
import pytest

from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.question import ask
from lessons.exercises.templates.filling import is_decided

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
    ("name", "rule"),
    [("midpoint-line", nearest), ("diamond-exit", left_or_last), ("rectangle-line", beside)],
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


def test_no_sentence_of_a_file_is_broken_in_the_middle() -> None:
    for name, template in TEMPLATES.items():
        for line in ask(template, 0).draft.text.strip().split("\n")[:-1]:
            assert line.endswith((".", "?", ":")), name
