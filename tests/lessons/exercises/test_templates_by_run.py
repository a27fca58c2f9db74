"""Templates of places, listings, pictures, steps and runs: what they say is what the pipeline does."""

import math
from fractions import Fraction

import numpy as np
import pytest

from core import Settings, clip_lines, render
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.question import ask, judge
from lessons.exercises.templates import placing, reading, stepping
from lessons.exercises.templates import reading as wrong_lines
from lessons.exercises.templates.lines import d_values
from lessons.mistakes.scan_conversion import LECTURE
from lessons.mistakes.shelf import SHELF
from lessons.mistakes.twin import line_pixels
from lessons.small_scenes import pixel_segments


def listed(lines: tuple[str, ...], ends: tuple[tuple[int, int], tuple[int, int]]) -> set[tuple[int, int]]:
    """Run a listing of the question as Python."""
    (x0, y0), (x1, y1) = ends
    source = "\n".join(
        line.replace("for x = x0 to ", "for x in range(x0, 1 + ").replace(
            ":", "):" if "for x" in line else ":"
        )
        for line in lines
    )
    pixels: set[tuple[int, int]] = set()
    exec(source, {"x0": x0, "y0": y0, "x1": x1, "y1": y1, "draw": lambda x, y: pixels.add((x, y))})
    return {(x, y) for x, y in pixels if 0 <= x < reading.SIZE[0] and 0 <= y < reading.SIZE[1]}


@pytest.mark.parametrize("fault", ["", *reading.FAULTS])
def test_a_listing_with_a_wrong_line_draws_what_its_twin_draws(fault: str) -> None:
    lines = list(reading.LISTING)
    if fault:
        number, wrong = reading.FAULTS[fault]
        assert lines[number] != wrong
        lines[number] = wrong
    settings = SHELF[fault].change_settings(LECTURE) if fault else LECTURE
    for ends in (((1, 1), (9, 4)), ((0, 6), (8, 1)), ((2, 0), (9, 6))):
        drawn = listed(tuple(lines), ends)
        assert drawn == line_pixels(pixel_segments([ends], reading.SIZE), settings), ends
        assert not fault or drawn == reading.listed_pixels(fault, ends)


def test_steps_of_a_line_are_those_of_the_run_and_twins_leave_them_where_their_runs_do() -> None:
    ends = ((1, 1), (9, 4))
    right = stepping.line_values(ends)
    assert right[::2] == [row[0] for row in d_values(ends, LECTURE)]
    assert set(right[1::2]) | {ends[0]} == line_pixels(pixel_segments([ends], (16, 12)), LECTURE)
    for twin in ("ties-step", "not-corrected", "start-not-doubled"):
        mine = stepping.line_values(ends, twin)
        run = [row[0] for row in d_values(ends, SHELF[twin].change_settings(LECTURE))]
        first = next(k for k, (a, b) in enumerate(zip(mine, right, strict=True)) if a != b)
        assert mine[0 : first + 1 : 2] == run[: first // 2 + 1]


def test_depth_verdicts_are_those_of_drawing() -> None:
    question = ask(TEMPLATES["depth-test-steps"], 2)
    seen = np.unique(render(question.draft.scene).primitive)
    passed = [k for k, tries in enumerate(question.draft.answer.reference) if tries == (0,)]
    assert set(seen.tolist()) - {-1} <= set(passed)
    last = {
        step.label.split(",")[0][-1]: k for k, step in enumerate(question.draft.answer.steps) if k in passed
    }
    assert set(seen.tolist()) - {-1} == set(last.values())


def test_ends_to_place_are_those_of_the_clipper() -> None:
    for seed in range(3):
        draft = ask(TEMPLATES["clip-ends"], seed).draft
        places = np.array(draft.answer.reference, float)
        ends = draft.scene.clip[..., :2][0] / draft.scene.clip[0, :, 3:]
        window = (ends + 1) / 2 * np.array(placing.SIZE)
        np.testing.assert_allclose(
            clip_lines(window[None], (0, 0, *placing.SIZE)).segments[0], places, atol=1e-9
        )


def test_the_crossing_of_a_side_lies_on_the_border_and_on_the_side() -> None:
    draft = ask(TEMPLATES["clip-side-steps"], 3).draft
    crossings = [step.right for step in draft.answer.steps if step.kind == "place"]
    assert len(crossings) == 2
    assert all(x == stepping.BORDER for x, _ in crossings)
    kept = [step.right for step in draft.answer.steps if step.kind == "choice"]
    assert sum(output in (1, 3) for output in kept) == 2


def test_the_picture_that_is_shown_is_that_of_the_mistake() -> None:
    question = ask(TEMPLATES["wrong-picture"], 4)
    answer = question.draft.answer
    name = answer.options[answer.right].replace(" ", "-")
    shown = SHELF[name].draw(question.draft.scene, Settings())
    np.testing.assert_array_equal(shown.primitive, answer.picture.primitive)
    right = render(question.draft.scene)
    wrong = {(c, r) for r, c in np.argwhere(shown.primitive != right.primitive).tolist()}
    assert answer.wrong == wrong


def test_any_corner_that_covers_the_same_is_right() -> None:
    question = ask(TEMPLATES["corner-from-pixels"], 1)
    (x, y) = question.draft.answer.reference[0]
    moved = question.draft.answer.read([[str(x - Fraction(1, 64)), str(y)]])
    assert judge(question, moved).verdict.score in (0, 1)
    assert question.draft.scene is None, "its outline would show the corner"


INPUTS = {
    "viewport-line": [{"x": x, "y": y, "w": 2, "W": 8, "H": 6} for x in (-2, -1, 1) for y in (-1.5, -0.5, 1)],
    "coverage-line": [{"rows": 5, "columns": 6, "edges": [(-3, -4, 17.1), (3, -1, -1.2), (0.1, 5, -3.3)]}],
    "liang-barsky-line": [
        {"borders": borders}
        for borders in (
            [(-10, -1), (10, 9), (-9, -2), (9, 8)],
            [(-4, -2), (4, 6), (0, 8), (0, -2)],
            [(-4, 2), (4, 6), (0, 8), (0, 2)],
            [(8, 3), (-8, -2), (4, 1), (-4, -3)],
            [(4, -1), (-4, 6), (0, 3), (0, 3)],
        )
    ],
    "perspective-line": [
        {"alpha": 0.5, "beta": 0.3, "gamma": 0.2, "w0": 2, "w1": 4, "w2": 1, "u0": 3, "u1": 0, "u2": 8}
    ],
    "depth-line": [{"background": "-", "fragments": [(5, "a"), (3, "b"), (3, "c"), (4, "d")]}],
    "over-line": [{"background": 1.0, "layers": [(0.5, 0.25), (0.0, 0.5), (1.0, 0.125)]}],
}
SHOWN = {
    "viewport-line": lambda found: (found["column"], found["row"], found["x_window"], found["y_window"]),
    "coverage-line": lambda found: tuple(found["covered"]),
    "liang-barsky-line": lambda found: (found["t_in"], found["t_out"]) if found["kept"] else (1, 0),
    "perspective-line": lambda found: found["u"],
    "depth-line": lambda found: found["shown"],
    "over-line": lambda found: found["shown"],
}
RIGHT = {
    "liang-barsky-line": (2 / 9, 8 / 9),
    "perspective-line": (0.25 * 3 + 0.2 * 8) / (0.25 + 0.075 + 0.2),
    "depth-line": "b",
    "over-line": (0.25 * 0.5 + 0.75) * 0.5 * 0.875 + 0.125,
}
"""What the first input must give."""


def outcomes(name: str, lines: list[str]) -> list[object]:
    """Run a listing on all inputs."""
    found = []
    for values in INPUTS[name]:
        names = {"inf": float("inf"), "floor": math.floor, "ceil": math.ceil, **values}
        exec("\n".join(lines), names)
        found.append(SHOWN[name](names))
    return found


@pytest.mark.parametrize("listed", wrong_lines.LISTINGS, ids=lambda listed: listed.name)
def test_each_wrong_line_of_a_listing_gives_something_else(listed: wrong_lines.Listed) -> None:
    lines = listed.text.split("\n")
    right = outcomes(listed.name, lines)
    if listed.name in RIGHT:
        assert right[0] == pytest.approx(RIGHT[listed.name])
    for number, faults in listed.faults.items():
        for fault in faults:
            assert outcomes(listed.name, [*lines[:number], fault, *lines[number + 1 :]]) != right, fault
