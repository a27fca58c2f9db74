"""Places, wrong lines, wrong pictures, steps, broken methods and cheapest settings: what they earn, and bad input."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from core import Settings, render
from core.scene import ClipScene
from lessons.exercises.answers.answer import Dial, Entry, NotCheckedError
from lessons.exercises.answers.listings import LineAnswer
from lessons.exercises.answers.marked import PlaceAnswer
from lessons.exercises.answers.spot import SpotAnswer
from lessons.exercises.answers.steps import FIXED, StepsAnswer
from lessons.exercises.answers.trials import BreakAnswer, CheapestAnswer, Family
from lessons.exercises.numbers import Draws
from lessons.small_scenes import triangle_scene

SIZE = (8, 6)
ENDS = ((Fraction(11, 9), Fraction(0)), (Fraction(71, 9), Fraction(6)))
CORNERS = PlaceAnswer(SIZE, ("entry", "exit"), ENDS, (ENDS[::-1],), tolerance=0.1)


def corner_scene(values: tuple[Fraction, ...]) -> ClipScene:
    """Return a triangle of which one corner is given."""
    x, y = map(float, values)
    return triangle_scene([[(0.5, 0.5), (6.5, 0.5), (x, y)]], SIZE)


def covers_like(values: tuple[Fraction, ...]) -> bool:
    """Return whether the triangle covers what it does with its corner at (3, 5)."""
    right, mine = (render(corner_scene(at)).primitive for at in ((Fraction(3), Fraction(5)), values))
    return bool((right == mine).all())


CORNER = PlaceAnswer(
    SIZE, ("corner",), ((Fraction(3), Fraction(5)),), is_right=lambda places: covers_like(places[0]), rule="x"
)
LINE = LineAnswer(("let D = 2*dy - dx", "while (x <= x1) {", "  x += 2", "}"), 2)
SCENE = triangle_scene([[(1, 1), (6, 2), (3, 5)]], SIZE)
SPOT = SpotAnswer(SIZE, render(SCENE), frozenset({(2, 2), (3, 3), (4, 1)}), ("rounded", "upside down"), 1)
RUN = StepsAnswer(
    (
        Entry("D", "number", Fraction(-2)),
        Entry("the next pixel", "pixel", (2, 1)),
        Entry("inside", "choice", 0, ("yes", "no")),
        Entry("the corner", "place", (Fraction(1, 2), Fraction(3)), tolerance=0.1),
    ),
    SIZE,
)
INCLUSIVE = Settings(fill_rule="inclusive")


def is_drawn_at_center(scene: ClipScene, settings: Settings) -> bool:
    """Return whether pixel (0, 0) is drawn, whose centre is a corner of the triangle."""
    return bool(render(scene, settings).primitive[3, 6] >= 0)


BROKEN = BreakAnswer(
    (
        Dial("x", high=Fraction(8), step=Fraction(1, 2)),
        Dial("y", low=Fraction(1), high=Fraction(6), step=Fraction(1, 2)),
    ),
    (Fraction(3), Fraction(5)),
    (Fraction(13, 2), Fraction(5)),
    corner_scene,
    INCLUSIVE,
    Settings(),
    is_drawn_at_center,
    "pixel (6, 3) is drawn",
)
ERRORS = {"flat": Fraction(40), "affine": Fraction(8), "perspective": Fraction(0)}
CHEAPEST = CheapestAnswer(
    (
        Family("interpolation", tuple(ERRORS), tuple(map(Fraction, (0, 5, 11)))),
        Family("texture_filter", ("nearest", "bilinear"), (Fraction(1), Fraction(4))),
    ),
    Fraction(10),
    lambda settings: ERRORS[settings.interpolation] + 3 * (settings.texture_filter == "nearest"),
    Settings(),
)
ANSWERS = [CORNERS, CORNER, LINE, SPOT, RUN, BROKEN, CHEAPEST]


@pytest.mark.parametrize("answer", ANSWERS, ids=lambda answer: answer.kind)
def test_the_right_answer_earns_all_and_all_or_none_nothing(answer) -> None:
    assert answer.check(answer.reference).score == 1
    assert answer.is_same(answer.reference, answer.reference)
    assert [answer.check(extreme).score for extreme in answer.extremes()] == [0] * len(answer.extremes())
    assert answer.credit.endswith(".")
    draws = Draws(1)
    guesses = [answer.random(draws) for _ in range(50)]
    mean = sum(answer.check(guess).score for guess in guesses) / 50
    assert abs(mean - answer.chance) < 0.1
    assert all(answer.text(guess) for guess in guesses)


def test_what_is_offered_stands_in_text() -> None:
    assert CORNERS.offered == "Points: entry, exit"
    assert LINE.offered.splitlines()[2] == " 3    x += 2"
    assert SPOT.offered == "- rounded\n- upside down"
    assert RUN.offered.splitlines()[1:3] == ["2. the next pixel (a pixel)", "3. inside (yes | no)"]
    assert BROKEN.offered.splitlines()[0] == "x: 0 to 8 in steps of 0.5, at first 3"
    assert CHEAPEST.offered.splitlines()[1] == "texture_filter: nearest 1, bilinear 4"


def test_places_count_in_any_right_order_and_within_their_tolerance() -> None:
    near = CORNERS.read([["7.9", 6], "1.2, 0"])
    assert CORNERS.check(near).score == 1
    assert CORNERS.check(CORNERS.read([["7.5", 6], ["1.2", 0]])).marks == {"right": [1], "wrong": [0]}
    assert CORNERS.first_wrong(CORNERS.read([[1, 1], [8, 6]])) == "The first point that is wrong: entry."


def test_any_place_that_runs_right_counts() -> None:
    other = CORNER.read("3, 5.1")
    assert CORNER.check(other).score == 1
    assert CORNER.is_same(other, CORNER.reference)
    assert CORNER.check(CORNER.read([1, 5])).score == 0


def test_a_line_is_named_by_its_number_from_one() -> None:
    assert [LINE.check(LINE.read(given)).score for given in (3, "3", 1)] == [1, 1, 0]
    assert LINE.chance == 1 / 3


def test_a_picture_earns_half_for_the_place_and_half_for_the_mistake() -> None:
    given = [{"pixels": [[2, 2]], "option": "rounded"}, "upside down", [[2, 2], [4, 1]], [[2, 2], [0, 0]]]
    assert [SPOT.check(SPOT.read(one)).score for one in given] == [0.5, 0.5, 0.5, 0]
    assert SPOT.first_wrong(SPOT.read(given[3])) == "Pixel (0, 0) is the same in the right picture."
    only = replace(SPOT, options=())
    assert only.check(only.read([[2, 2]])).score == 1


def test_a_wrong_line_is_told_on_which_side_the_right_one_is() -> None:
    assert LINE.first_wrong(0) == "The wrong line comes after line 1."
    assert LINE.first_wrong(3) == "The wrong line comes before line 4."
    assert not LINE.first_wrong(2)


def test_only_the_first_try_of_a_step_earns() -> None:
    run = ()
    for value, number in ((Fraction(-2), 1), ((1, 1), 1), ((2, 1), 2), (1, 2), (FIXED, 3)):
        run = RUN.tried(run, value)
        assert RUN.open_step(run) == number
    run = RUN.tried(run, (Fraction(1, 2), Fraction(31, 10)))
    assert RUN.open_step(run) is None
    verdict = RUN.check(run)
    assert verdict.counts == "2 of 4 steps right, 2 wrong, 0 not done"
    assert verdict.marks == {"right": [0, 3], "wrong": [1, 2], "fixed": [2]}
    assert RUN.first_wrong(run) == "The first wrong step: the next pixel."
    assert RUN.read(["-2", ["1, 1", "2, 1"], ["no", "fixed"], ["1/2", "3.1"]]) == run
    assert RUN.read(["-2", [1, 1], "no", ["1/2", "3.1"]])[1] == ((1, 1), FIXED)
    with pytest.raises(ValueError, match="all steps are done"):
        RUN.tried(run, FIXED)


def test_a_run_that_is_wrong_somewhere_need_not_be_finished_to_be_recognised() -> None:
    one, other, third = (
        RUN.read(given) for given in (["-2", "1, 1", "yes"], ["-2", "1, 1"], ["-2", "1, 2", "yes"])
    )
    assert RUN.is_same(one, other)
    assert not RUN.is_same(one, third)
    assert not RUN.is_same(RUN.read(["-2"]), RUN.reference)


def test_whatever_breaks_only_the_weak_method_counts() -> None:
    found = [
        values
        for values in ((Fraction(k, 2), Fraction(n, 2)) for k in range(17) for n in range(2, 13))
        if BROKEN.check(values).score
    ]
    assert len(found) > 5
    weak, robust = "“Inclusive (>= 0)”", "“Left and bottom edges (top-left rule, y up)”"
    assert BROKEN.check(found[0]).counts == f"{weak} fails, {robust} does not fail"
    assert BROKEN.check(BROKEN.start).counts == f"{weak} does not fail, {robust} does not fail"
    assert BROKEN.read({"y": "5", "x": "6.5"}) == BROKEN.reference


def test_the_cheapest_within_the_tolerance_earns_all_and_dearer_ones_what_they_save() -> None:
    scores = [CHEAPEST.check(choices).score for choices in CHEAPEST.combinations]
    assert scores == pytest.approx([0, 0, 0, 1, 0.5, 0])
    assert CHEAPEST.text(CHEAPEST.reference) == "interpolation: affine\ntexture_filter: bilinear"
    with pytest.raises(ValueError, match="neither of the ends"):
        replace(CHEAPEST, limit=Fraction(100))


@pytest.mark.parametrize(
    ("answer", "given", "wanted"),
    [
        (CORNERS, "", "empty"),
        (CORNERS, [[1, 2]], "expected .x, y. of 2 points, got 1"),
        (CORNERS, [[1, 2], [1, "1e400"]], "expected a number up to 1e300"),
        (CORNERS, [[1, 2], [1, "inf"]], "expected a place in the window"),
        (CORNERS, [[1, 2], [9, 1]], r"from \(0, 0\) to \(8, 6\), got \[9, 1\]"),
        (CORNERS, [[1, 2], ["nan", 1]], "expected a number such as"),
        (CORNER, [1, True], "got bool"),
        (CORNER, "1", "expected x and y|expected .x, y. of 1 points"),
        (CORNER, "1; 2, '", "expected a number such as"),
        (LINE, 0, "expected the number of a line, 1 to 4, got 0"),
        (LINE, "٣", "expected the number of a line"),
        (LINE, True, "expected the number of a line"),
        (LINE, "9" * 5000, "expected the number of a line"),
        (SPOT, {}, "empty"),
        (SPOT, {"pixels": [], "option": ""}, "empty"),
        (SPOT, {"pixel": [[1, 1]]}, "expected pixels and option, got 'pixel'"),
        (SPOT, [[8, 0]], r"from \[0, 0\] to \[7, 5\]"),
        (SPOT, {"option": ["rounded", "upside down"]}, "expected one mistake, got 2"),
        (SPOT, {"option": "'; DROP"}, "expected one of rounded, upside down"),
        (replace(SPOT, options=()), {"option": "rounded"}, "expected pixels alone"),
        (RUN, ["1"] * 5, "expected a list of up to 4 steps, got 5"),
        (RUN, "-2", "expected a list of up to 4 steps, got str"),
        (RUN, ["nan"], "expected a number such as"),
        (RUN, ["1", "2"], "expected two numbers for the next pixel, got '2'"),
        (RUN, ["1", "1/2, 2"], "expected a pixel such as 3, 2"),
        (RUN, ["1", []], "expected 1 to 20 tries of a step, got 0"),
        (RUN, [["1"] * 21], "expected 1 to 20 tries of a step, got 21"),
        (RUN, ["1", "fixed", "maybe"], "expected one of yes, no"),
        (BROKEN, [1], "expected a number for each of x, y, got 1"),
        (BROKEN, {"x": 1}, "expected x, y, got 'x'"),
        (BROKEN, [1, "1/3"], "expected y from 1 to 6 in steps of 0.5, got '1/3'"),
        (BROKEN, ["inf", 1], "expected x from 0 to 8"),
        (BROKEN, {}, "empty"),
        (CHEAPEST, ["affine"], "expected a method for each of interpolation, texture_filter, got 1"),
        (CHEAPEST, ["affine", ["nearest"]], "expected one of nearest, bilinear"),
        (CHEAPEST, {"interpolation": "affine"}, "expected interpolation, texture_filter, got"),
    ],
)
def test_malformed_answers_are_not_checked(answer, given: object, wanted: str) -> None:
    with pytest.raises(NotCheckedError, match=wanted) as problem:
        answer.read(given)
    assert len(str(problem.value)) < 200


def test_answers_that_cannot_be_right_are_refused() -> None:
    with pytest.raises(ValueError, match="are not right"):
        replace(CORNER, reference=((Fraction(0), Fraction(5)),))
    with pytest.raises(ValueError, match="the weak method alone fails"):
        replace(BROKEN, reference=BROKEN.start)
    with pytest.raises(ValueError, match="no methods stay within"):
        replace(CHEAPEST, limit=Fraction(-1))
    assert np.isfinite(CORNERS.chance)


@pytest.mark.parametrize(
    ("answer", "given", "said"),
    [
        (SPOT, {"option": "rounded"}, "No pixel is marked"),
        (SPOT, {"pixels": [[2, 2]]}, "No mistake is named"),
        (RUN, [["-2"]], "3 steps are not done"),
        (RUN, [["-2"], ["9, 9"]], "3 steps are not done"),
        (RUN, [["-2"], ["2, 1"], ["yes"]], "1 step is not done"),
    ],
)
def test_what_is_left_out_is_said_before_it_is_charged(answer, given, said) -> None:
    assert answer.left_out(answer.read(given)) == said
    assert answer.left_out(answer.reference) == ""
