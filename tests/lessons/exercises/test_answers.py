"""Numbers as they are written, and what answers of every type earn."""

from fractions import Fraction
from math import inf, sqrt

import pytest

from lessons.exercises.answers.answer import NotCheckedError
from lessons.exercises.answers.choices import ChoiceAnswer, OrderAnswer
from lessons.exercises.answers.fields import Column, NearMiss, NumberAnswer, TableAnswer, number_rows
from lessons.exercises.answers.marked import PixelAnswer, read_art
from lessons.exercises.numbers import Draws, number_text, read_number

ART = """
..##..
.####.
......
"""
MARKED = frozenset(pixel for pixel, mark in read_art(ART).items() if mark == "#")
PIXELS = PixelAnswer((6, 3), MARKED)
NINE_OF_MANY = PixelAnswer((12, 9), frozenset((k, k) for k in range(9)))
STAGES = OrderAnswer(("cull", "clip", "raster", "depth"), ("raster", "cull", "depth", "clip"))
SEVERAL = ChoiceAnswer(("a", "b", "c", "d"), frozenset({0, 1}), is_several=True)
ONE = ChoiceAnswer(("yes", "no", "only at the border"), frozenset({1}))
VECTOR = NumberAnswer((Fraction(1, 3), inf), (2,), tolerance=0.01)


def sums(own, row, mine):
    return (own[-1][0] if row else Fraction(0)) + 7


SUMS = TableAnswer((Column("sum"),), tuple("abcd"), number_rows([[7], [14], [21], [28]]), sums)
ANSWERS = [PIXELS, NINE_OF_MANY, STAGES, SEVERAL, ONE, VECTOR, SUMS]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1/3", Fraction(1, 3)),
        ("-2/6", Fraction(-1, 3)),
        ("1e-3", Fraction(1, 1000)),
        ("sqrt(2)", sqrt(2)),
        ("3/sqrt(4)", Fraction(3, 2)),
        ("−.5", Fraction(-1, 2)),
        ("-inf", -inf),
    ],
)
def test_numbers_are_understood(text: str, value: Fraction | float) -> None:
    assert read_number(text) == value


@pytest.mark.parametrize(
    "text",
    [
        "",
        "nan",
        "1e400",
        "1e999",
        "-1e300*1e300",
        "sqrt(1e301)*sqrt(1e301)",
        "١٢",
        "1/0",
        "sqrt(1/0)",
        "2*inf",
        "0x10",
        "1,5",
        "1" * 61,
        "__import__('os')",
        "1; DROP TABLE attempts",
        "[answer]",
        "sqrt(-1)",
        "1e-9999",
    ],
)
def test_what_is_no_number_is_refused_in_one_sentence(text: str) -> None:
    with pytest.raises(ValueError, match=r"expected|division|infinity") as problem:
        read_number(text)
    assert len(str(problem.value)) < 160
    assert "\n" not in str(problem.value)


def test_what_was_understood_is_shown() -> None:
    assert [number_text(read_number(text)) for text in ("2/6", "0.25", "sqrt(2)", "7.0", "inf")] == [
        "1/3 (0.3333)",
        "0.25",
        "1.41421",
        "7",
        "inf",
    ]


@pytest.mark.parametrize("answer", ANSWERS, ids=lambda answer: answer.kind)
def test_the_right_answer_earns_all_and_all_or_none_nothing(answer) -> None:
    assert answer.check(answer.reference).score == 1
    assert [answer.check(extreme).score for extreme in answer.extremes()] == [0] * len(answer.extremes())
    assert answer.credit.endswith(".")
    draws = Draws(1)
    guesses = [answer.check(answer.random(draws)).score for _ in range(100)]
    assert sum(guesses) / 100 < max(0.05, answer.chance + 0.1)


def test_pixels_lose_for_strays() -> None:
    assert PIXELS.check(MARKED - {(2, 2)}).counts == "5 right, 1 missing, 0 extra"
    assert PIXELS.check(MARKED | {(0, 0)}).score == pytest.approx(5 / 6)
    assert NINE_OF_MANY.check(NINE_OF_MANY.reference | {(k, 0) for k in range(3, 9)}).score == pytest.approx(
        3 / 9
    )
    strays = {(i, j) for i in range(12) for j in range(9) if i > j}
    assert NINE_OF_MANY.check(NINE_OF_MANY.reference | set(list(strays)[:30])).score == 0
    open_ones = PixelAnswer((6, 3), MARKED, may=frozenset({(0, 0)}))
    assert open_ones.check(MARKED | {(0, 0)}).score == open_ones.check(MARKED).score == 1
    assert open_ones.is_same(MARKED, MARKED | {(0, 0)})


def test_a_wrong_answer_is_told_where_it_goes_wrong_first() -> None:
    """Tables, orders, steps, places and pictures name their first wrong part, too."""
    line = frozenset({(4, 0), (3, 1), (2, 1), (1, 2)})
    wrong = (line - {(3, 1)} | {(3, 0)}) - {(1, 2)}
    assert PixelAnswer((6, 3), line).first_wrong(wrong) == "The lowest row with a wrong one: row 0."
    for direction, place in (
        ((-3, 2), "column 3"),
        ((3, -2), "column 1"),
        ((-2, 3), "row 0"),
        ((0, -3), "row 2"),
    ):
        told = PixelAnswer((6, 3), line, direction=direction).first_wrong(wrong)
        assert told == f"The first wrong one from the start of the line: {place}."
    assert VECTOR.first_wrong(VECTOR.read(["0.33", "1"])) == "The first number that is wrong: number 2."
    unit = tuple(Fraction(k in (0, 3)) for k in range(4))
    turned = NumberAnswer(unit, (2, 2)).first_wrong((*unit[:2], Fraction(5), Fraction(1)))
    assert turned == "The first number that is wrong: row 2, column 1."
    assert SEVERAL.first_wrong(frozenset({0, 3})) == "The first option to think over: b."
    assert not ONE.first_wrong(frozenset({0}))
    for answer in ANSWERS:
        assert not answer.first_wrong(answer.reference)


def test_text_art_is_read_back() -> None:
    assert PIXELS.read(PIXELS.text(MARKED)) == MARKED == PIXELS.read([list(pixel) for pixel in MARKED])


def test_a_slip_in_a_table_costs_one_cell() -> None:
    late = number_rows([[7], [15], [22], [29]])
    assert SUMS.check(late).score == 3 / 4
    assert SUMS.check(late).marks == {"wrong": [(1, 0)]}
    assert SUMS.is_slip(late)
    assert SUMS.check(SUMS.read(["7", "", "21", "28"])).score == 3 / 4
    assert TableAnswer(SUMS.columns, SUMS.labels, SUMS.reference).check(late).score == 1 / 4


def test_numbers_are_right_together_but_for_near_misses() -> None:
    assert VECTOR.check(VECTOR.read(["0.33", "inf"])).score == 1
    assert VECTOR.check(VECTOR.read(["0.33", "-inf"])).score == 0
    priced = NumberAnswer(
        (Fraction(5),), near=(NearMiss(((Fraction(-5),),), Fraction(1, 2), "The sign costs half."),)
    )
    assert [priced.check(priced.read(text)).score for text in ("5", "-5", "4")] == [1, 0.5, 0]
    assert priced.credit == "The number earns all points. The sign costs half."
    assert not priced.is_slip(priced.read("4"))
    matrix = NumberAnswer(tuple(map(Fraction, range(4))), (2, 2))
    assert matrix.check(matrix.read([[0, 1], [2, "3"]])).score == 1


def test_orders_are_scored_by_the_longest_run() -> None:
    by_chance = (1 * 11 + 2 * 10 + 3 * 2 + 4) / 24
    moved = STAGES.read(["depth", "cull", "clip", "raster"])
    assert STAGES.check(moved).score == pytest.approx((3 - by_chance) / (4 - by_chance))
    assert STAGES.is_slip(STAGES.read(["clip", "cull", "raster", "depth"]))


def test_several_of_costs_for_wrong_ones() -> None:
    assert [SEVERAL.check(SEVERAL.read(given)).score for given in (["a"], ["a", "b", "c"], ["c"])] == [
        0.5,
        0.5,
        0,
    ]
    assert ONE.chance == 1 / 3


@pytest.mark.parametrize(
    ("answer", "given", "wanted"),
    [
        (PIXELS, "", "the text art is empty"),
        (PIXELS, "...\n...", "expected 3 rows of text art, got 2"),
        (PIXELS, "......\n......\n.....", "expected 6 pixels in every row of text art, got 5 in row 3"),
        (PIXELS, "......\n..x...\n......", r"expected #, \? or . in text art, got 'x' in row 2"),
        (PIXELS, "......\n......\n......", "no pixels are marked"),
        (PIXELS, [[0, 0]] * 1_000_000, "got 1000000 entries"),
        (PIXELS, [[6, 0]], r"from \[0, 0\] to \[5, 2\], got \[6, 0\]"),
        (PIXELS, [["1; DROP TABLE", 0]], "expected .column, row."),
        (PIXELS, {"a": 1}, "got dict"),
        (VECTOR, ["1"], "expected a list of 2 numbers, got 1"),
        (VECTOR, ["nan", "1"], "expected a number such as"),
        (VECTOR, ["", "1"], "a number is missing"),
        (VECTOR, "", "empty"),
        (VECTOR, [True, 1], "got bool"),
        (SUMS, [["1", "2"]] * 4, "expected 4 rows of 1, got 2 in row 1"),
        (SUMS, ["1"], "expected 4 rows of 1, got 1 rows"),
        (SUMS, ["", "", "", ""], "the table is empty"),
        (STAGES, ["cull", "clip"], "expected all 4 in order, got 2"),
        (STAGES, ["cull", "clip", "clip", "depth"], "got one twice"),
        (ONE, ["yes", "no"], "expected one option, got 2"),
        (SEVERAL, "'; DROP TABLE", "expected one of a, b, c, d"),
    ],
)
def test_malformed_answers_are_not_checked(answer, given: object, wanted: str) -> None:
    with pytest.raises(NotCheckedError, match=wanted) as problem:
        answer.read(given)
    assert len(str(problem.value)) < 200


def test_draws_are_those_of_every_machine() -> None:
    draws = Draws(23)
    drawn = (
        [draws.whole(1, 6) for _ in range(8)],
        draws.shuffled("abcdef"),
        draws.step(*map(Fraction, (0, 3, "1/2"))),
    )
    assert drawn == EXPECTED_DRAWS
    with pytest.raises(ValueError, match="seed must be a whole number from 0"):
        Draws(-1)


EXPECTED_DRAWS = [6, 6, 6, 1, 4, 3, 4, 1], tuple("edfacb"), 0


def test_a_slip_in_the_only_number_is_one_digit_of_several_or_the_sign() -> None:
    for right, given in (("13", "12"), ("0.17", "0.19"), ("4", "-4")):
        assert NumberAnswer((Fraction(right),)).is_slip((Fraction(given),)), (right, given)
    for right, given in (("2", "0"), ("-4", "-1"), ("0.5", "0.7"), ("31", "12")):
        assert not NumberAnswer((Fraction(right),)).is_slip((Fraction(given),)), (right, given)
