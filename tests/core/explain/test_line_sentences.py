"""Every step of a wireframe has a finished sentence and a formula with its numbers, for every line method."""

import re
from functools import cache

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

from core import ClipScene, Settings, trace
from core.explain.formulas.table import FORMULAS, formula
from core.explain.latex import split_cells
from core.explain.sentences.lines import SENTENCES as LINE_SENTENCES
from core.explain.sentences.table import SENTENCES, sentence
from core.explain.step_values import StepValues
from core.methods import table
from lessons.scenes import make_scene
from tests.core.explain.explained_steps import RARE_CLIP, Step, scene_and_window
from tests.core.strategies import clip_of_window
from widgets.inspector.typesetter import Typesetter

LINES = list(table.names("line"))
CORNERS = [(1.5, 1.5), (9.5, 3.5), (5.5, 8.5)]


def steps_of(traced, stages=("raster", "interpolate")) -> list[Step]:
    found: list[Step] = []
    for stage in stages:
        of_stage = traced.stage(stage)
        for position in range(1, of_stage.steps.count + 1):
            explanation = of_stage.explain(position)
            row, _ = of_stage.steps.row_at(position)
            column, line = of_stage.pixel[row].tolist()
            assert explanation is not None
            found.append((explanation, int(of_stage.triangle[row]), (column, line)))
    return found


@cache
def explained(line: str) -> tuple[Step, ...]:
    """Return steps of a triangle on pixel centres, of the rare ones, and of a part of some built-in scenes."""
    found: list[Step] = []
    for interpolation in ("perspective", "affine"):
        settings = Settings(polygon_mode="wireframe", line=line, interpolation=interpolation)
        scene = ClipScene(clip_of_window([CORNERS], (12, 10)), np.eye(3)[None], (12, 10))
        found += steps_of(trace(scene, settings))
        for clip in RARE_CLIP.values():
            found += steps_of(trace(ClipScene([clip], np.eye(3)[None], (8, 8)), settings))
        for name in ("near-plane", "cube", "textured-floor"):
            _, triangle, (column, row, _, _) = scene_and_window(name)
            region = (column - 6, row - 6, 12, 12)
            found += steps_of(trace(make_scene(name), settings, triangle, region, before="cleared"))
    return tuple(found)


@pytest.mark.parametrize("line", LINES)
def test_every_step_of_a_wireframe_has_a_finished_sentence(line: str) -> None:
    for explanation, triangle, pixel in explained(line):
        key = StepValues(explanation).key
        assert key in SENTENCES, key
        text = sentence(explanation, triangle, pixel)
        assert re.fullmatch(r"[A-Z].*\.", text), text
        assert not re.search(r"[{}\[\]]|\bnan\b|NaN|\binf\b|None|array|\s\s|\.\.|-\d", text), text
        assert ". " not in text, text
        assert len(text) < 330, text


@pytest.mark.parametrize("line", LINES)
def test_every_step_of_a_wireframe_has_a_formula(line: str) -> None:
    for explanation, _, _ in explained(line):
        made = formula(explanation)
        assert made is not None, explanation.key
        symbols, numbers = split_cells(made.symbolic), split_cells(made.substituted)
        assert len(symbols) == len(numbers), made
        assert not re.search(r"\bnan\b|NaN|\binf\b|None|−|e[-+]\d", made.substituted), made


def test_there_is_no_sentence_for_a_key_that_does_not_occur() -> None:
    found = {StepValues(explanation).key for line in LINES for explanation, _, _ in explained(line)}
    assert set(LINE_SENTENCES) <= found
    assert set(LINE_SENTENCES) <= set(FORMULAS)


def test_formulas_of_lines_can_be_typeset(qtbot: QtBot) -> None:
    typesetter = Typesetter(capacity=10_000)
    samples = {explanation.key: explanation for line in LINES for explanation, _, _ in explained(line)}
    for explanation in samples.values():
        made = formula(explanation)
        assert made is not None
        for cell in {*split_cells(made.symbolic), *split_cells(made.substituted)}:
            assert not typesetter.typeset(cell, "#000000", 18.0).problem, cell


def said(line: str, key: str, place: int = 0) -> tuple[str, str, str]:
    """Return a sentence and both lines of the formula of the triangle on pixel centres."""
    scene = ClipScene(clip_of_window([CORNERS], (12, 10)), np.eye(3)[None], (12, 10))
    steps = steps_of(trace(scene, Settings(polygon_mode="wireframe", line=line)))
    explanation, triangle, pixel = [step for step in steps if step[0].key == key][place]
    made = formula(explanation)
    assert made is not None
    return sentence(explanation, triangle, pixel), made.symbolic, made.substituted


@pytest.mark.parametrize(
    ("line", "operation", "place", "wanted"),
    [
        (
            "bresenham",
            "-start.octant",
            0,
            "Edge 2 of triangle 0 runs from pixel (1, 1) to pixel (9, 3): it is longer in x, so it is drawn "
            "column by column.",
        ),
        (
            "bresenham",
            "-start.lengths",
            0,
            "The line goes 8 pixels along x and 2 along y, so the decision value D starts at 2 · 2 − 8 = −4.",
        ),
        ("bresenham", ".test", 0, "D is −4, below 0, so y stays."),
        (
            "bresenham",
            ".test",
            1,
            "D is 0, a tie: the line passes exactly between two pixels, and by this version's rule y steps.",
        ),
        (
            "bresenham-lecture",
            ".test",
            1,
            "D is 0, a tie: the line passes exactly between two pixels, and by this version's rule y stays.",
        ),
        ("bresenham", ".step", 1, "The line has come nearer to the next pixel, so y steps to 2."),
        ("bresenham-float", ".test", 1, "The error e plus the slope m is 0.5, not above 0.5, so y stays."),
        ("bresenham", ".plot", 0, "Pixel (2, 1) is drawn: its centre lies at t = 0.125 of edge 2."),
        ("bresenham", "-start.plot", 0, "Pixel (1, 1) is drawn: its centre lies at the first end of edge 2."),
        (
            "midpoint",
            ".evaluate",
            0,
            "At x = 2 the line has y = 1.25, counted so that pixel centres are whole numbers.",
        ),
        ("midpoint", ".round", 0, "The nearest pixel centre to y = 1.25 is at 1."),
        (
            "midpoint",
            ".round",
            1,
            "The value y = 1.5 lies exactly between two pixel centres: halves go up, to 2.",
        ),
        ("dda", ".advance", 0, "The slope 0.25 is added for x = 2, which makes y = 1.25."),
        (
            "wu",
            ".share",
            0,
            "The line ends in this column and spans 0.5 of it: the intensities are scaled by that.",
        ),
        ("wu", ".share", 1, "The line spans the whole column."),
        (
            "wu",
            ".divide",
            1,
            "The line passes 0.25 of the way from y = 1 to y = 2, so pixel (2, 1) gets the intensity "
            "1 − 0.25 = 0.75.",
        ),
        (
            "gupta-sproull",
            ".distance",
            2,
            "The centre of pixel (2, 1) is 0.25 from the line along y, which makes a distance of 0.2425 px.",
        ),
        (
            "gupta-sproull",
            ".filter",
            2,
            "The table has 0.7032 for the nearest distance in it, 4 sixteenths of a pixel: this is the intensity of "
            "pixel (2, 1).",
        ),
        (
            "rectangle",
            "-start.length",
            0,
            "The ends, snapped to 1/256 pixel, are 8 and 2 apart along the axes, so the rectangle is 8.246 px long and "
            "reaches half a pixel to either side.",
        ),
        (
            "rectangle",
            ".across",
            0,
            "The centre of pixel (2, 1) is 0.2425 px to the right of the line, not more than 0.5, so it is between the "
            "rectangle's long sides.",
        ),
        (
            "diamond-exit",
            ".round",
            0,
            "Pixel (2, 1) is the nearest in this column: the line passes 0.25 px above its centre.",
        ),
    ],
)
def test_hand_computed_sentences(line: str, operation: str, place: int, wanted: str) -> None:
    assert said(line, f"raster.{line}{operation}", place)[0] == wanted


def test_hand_computed_formulas() -> None:
    _, symbols, numbers = said("bresenham", "raster.bresenham.plot")
    assert symbols == r"t & = & \frac{x - x_0}{x_1 - x_0}"
    assert numbers == r"0.125 & = & \frac{2.5 - 1.5}{9.5 - 1.5}"
    _, symbols, numbers = said("dda", "raster.dda.advance")
    assert symbols.endswith(r"& + & s & \cdot & m")
    assert numbers == r"1.25 & = & 1 & + & 1 & \cdot & 0.25"
    _, _, numbers = said("bresenham-lecture", "raster.bresenham-lecture.test", 1)
    assert numbers == r"0 & = & 0 & \Rightarrow & \text{stay}"
