"""Every number of a slide comes out with the verdict that is recorded of it."""

import dataclasses

import pytest

from app.cli import slides
from lessons.lectures.catalogue import NUMBERS, PRINTED
from lessons.lectures.printed import is_same
from lessons.lectures.scenes import LECTURES
from tests.app.cli.cli_runs import refused, run_program

KNOWN_SLIPS = {
    "near at +1; ours has it at",
    "far at -1; ours has it at",
    "(-2, 1)-(6, 5): t_min, t_max as named; ours: smaller, larger t",
    "(2, 8)-(6, 8), parallel and outside of 8 x 6: something is kept",
    "dy < 0: D at the start of (0, 0)-(5, -2)",
}


def test_every_number_has_its_recorded_verdict():
    found = {(number.slide, number.what): (number, number.compute()) for number in NUMBERS}
    assert len(found) == len(NUMBERS), "two numbers of a slide have one name"
    wrong = {key: ours for key, (number, ours) in found.items() if number.verdict(ours) == "CHANGED"}
    assert wrong == {}
    assert {number.what for number in NUMBERS if number.recorded_verdict == "slip"} == KNOWN_SLIPS
    of_slides = [number for number in NUMBERS if not number.is_counted]
    assert len(of_slides) >= 40
    assert {number.lecture for number in of_slides} == set(LECTURES)
    assert {number.lecture for number in NUMBERS} | {printed.lecture for printed in PRINTED} == set(LECTURES)


def test_another_result_is_no_verdict():
    number = next(number for number in NUMBERS if number.what == "centre of the lower left pixel")
    slip = next(number for number in NUMBERS if number.what == "near at +1; ours has it at")
    assert (number.verdict((0.5, 0.5)), number.verdict((0.0, 0.0))) == ("agrees", "CHANGED")
    assert (slip.verdict(-1.0), slip.verdict(1.0), slip.verdict(0.0)) == ("slip", "CHANGED", "CHANGED")
    assert is_same((1.0, (2, "a")), (1.0 + 1e-15, (2, "a")))
    assert not is_same((1,), (1, 2))


def test_the_command_fails_where_a_verdict_changes(monkeypatch):
    first, second = NUMBERS[:2]
    monkeypatch.setattr(slides, "NUMBERS", (first, dataclasses.replace(second, compute=lambda: (4.0, 2.0))))
    run = run_program("slides", "--check")
    assert run.returncode == 1
    assert run.stdout.splitlines()[1:] == [
        "  agrees  Where is the center of a pixel? | viewport of 4 x 3 pixels: lower left | (0, 0) | (0, 0)",
        "  CHANGED Where is the center of a pixel? | viewport of 4 x 3 pixels: upper right | (4, 3) | (4, 2)",
        "2 numbers: 2 agree with the slide, 0 are slips of the slide, 0 were counted with what the slide prints; "
        "1 changed",
    ]


def test_the_command_checks_a_number_of_every_kind(monkeypatch):
    kinds = {number.recorded_verdict: number for number in NUMBERS}
    monkeypatch.setattr(slides, "NUMBERS", tuple(kinds.values()))
    run = run_program("slides", "--check")
    assert run.returncode == 0
    assert [line.split()[0] for line in run.stdout.splitlines() if line.startswith("  ")] == list(kinds)


def test_the_command_lists_slides_by_lecture_and_shows_a_listing():
    lines = run_program("slides").stdout.splitlines()
    assert [line for line in lines if not line.startswith("  ")] == list(LECTURES.values())
    assert "  bresenham's line rasterization: 4 numbers, listing pellacini-bresenham" in lines
    assert sum(len(line.split(" listing")) for line in lines) >= len(lines) + 8
    shown = run_program("slides", "pellacini-bresenham").stdout
    assert "    d += m\n    if d > 0.5\n" in shown
    assert "differ first at step 1: it draws (1, 1), chosen by 0.8, midpoint (1, 0), chosen by 0.4." in shown
    shown = run_program("slides", "lmu-naive", "--ends", "0", "0", "6", "4").stdout
    assert "On (0, 0)-(6, 4) it draws the pixels of bresenham-lecture." in shown
    assert "It is the method fill=scanline-lecture." in run_program("slides", "lmu-scanline").stdout


@pytest.mark.parametrize(
    ("arguments", "problem", "code"),
    [
        (["other"], "printed listing must be one of pellacini-midpoint", 1),
        (["lmu-naive", "--ends", "0", "0", "2", "6"], "slopes from 0 to 1", 2),
        (["lmu-projection", "--ends", "0", "0", "6", "2"], "lmu-projection is no line listing", 2),
        (["--ends", "0", "0", "6", "2"], "needs the name of a line listing", 2),
        (["lmu-naive", "--check"], "name no listing", 2),
    ],
)
def test_what_does_not_fit_is_refused(arguments, problem, code):
    assert problem in refused(code, "slides", *arguments)
