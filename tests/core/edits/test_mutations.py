"""Random changes of listings: none gives a traceback, hangs, or takes more memory than is allowed."""

import random
import tracemalloc
from time import thread_time

import numpy as np
import pytest

from core import Settings, draw_lines, render
from core.edits.edit import Edit, apply_edit, original
from core.edits.editable import EDITABLE, refusal
from core.lanes.problem import LISTING, Problem
from core.methods import table
from lessons.small_scenes import triangle_scene
from tests.core.trace.trace_cases import lit_scene, textured_clip_scene

MEMORY = 30_000_000
"""Bytes that a changed text and its picture may take at their peak."""
SIGNS_AND_NAMES = (
    "+ - * / // % ** < <= == = ( ) [ ] , : 0 1 2"
    " x y k a value D pixels if else for in while return and or not"
    " range(9) abs( True [] .append( 0.5 10**9 break continue"
)
WORDS = (*SIGNS_AND_NAMES.split(), "\n", "  ", "'", "len(", "*x")
SCENE = triangle_scene(
    [[(1, 1), (7, 1), (7, 7)], [(1, 1), (7, 7), (1, 7)]], (8, 8), depth=[[0.5] * 3, [0.4, 0.5, 0.6]]
)
SCENES = {"texture_filter": textured_clip_scene(), "shading": lit_scene()}
ENDS = np.array([[[0.5, 0.5], [6.5, 3.5]], [[6.5, 5.5], [1.5, 0.5]], [[2.5, 2.5], [2.5, 2.5]]])
TEXTS = [
    (part.name, of, original(part.name, of).source)
    for part in EDITABLE.values()
    for of in table.names(part.family)
    if not refusal(part.name, of)
]


def mutated(text: str, chance: random.Random) -> str:
    """Return a text with one to three changes: letters, words and lines go, come, or change places."""
    for _ in range(chance.randint(1, 3)):
        lines = text.split("\n")
        at = chance.randrange(len(text) + 1)
        match chance.randrange(7):
            case 0:
                text = text[:at] + chance.choice(WORDS) + text[at:]
            case 1:
                text = text[:at] + text[at + chance.randint(1, 6) :]
            case 2:
                words = text.split(" ")
                words[chance.randrange(len(words))] = chance.choice(WORDS)
                text = " ".join(words)
            case 3:
                lines.insert(chance.randrange(len(lines) + 1), chance.choice(lines))
                text = "\n".join(lines)
            case 4:
                del lines[chance.randrange(len(lines))]
                text = "\n".join(lines)
            case 5:
                first, second = chance.randrange(len(lines)), chance.randrange(len(lines))
                lines[first], lines[second] = lines[second], lines[first]
                text = "\n".join(lines)
            case _:
                text = text[:at] + chr(chance.choice((*range(32, 127), 9, 0x2212, 0x1F600))) + text[at:]
    return text


def try_out(part: str, of: str, text: str) -> str:
    """Run a text as the program does, and return what is said of it; empty: it draws."""
    try:
        mode = "wireframe" if part == "line_clipping" else "fill"
        plain = Settings(
            fill="bounding-box", blend="opaque" if mode == "wireframe" else "over", polygon_mode=mode
        )
        settings = apply_edit(plain, Edit(part, of, text))
        if part == "line":
            draw_lines(ENDS, 8, 8, settings.line, last_pixel=True)
        else:
            # Infinite and undefined values go through the later stages, as the command line reports them.
            with np.errstate(all="ignore"):
                render(SCENES.get(part, SCENE), settings)
    except Problem as problem:
        return problem.sentence
    return ""


def run_all(seed: int, count: int, measures_memory: bool) -> tuple[int, float]:
    """Try so many texts; return how many drew, and the longest time."""
    chance, drawn, longest = random.Random(seed), 0, 0.0
    for _ in range(count):
        part, of, source = chance.choice(TEXTS)
        text = mutated(source, chance)
        if measures_memory:
            tracemalloc.start()
        started = thread_time()
        try:
            drawn += not try_out(part, of, text)
        except Exception as problem:
            raise AssertionError(f"{part} {of}: {type(problem).__name__}: {problem}\n{text}") from problem
        longest = max(longest, thread_time() - started)
        if measures_memory:
            peak = tracemalloc.get_traced_memory()[1]
            tracemalloc.stop()
            assert peak < MEMORY, text
    return drawn, longest


def test_a_few_random_changes():
    drawn, longest = run_all(7, 150, measures_memory=False)
    assert 0 < drawn < 150
    assert longest < 10 * LISTING.seconds


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(10))
def test_many_random_changes(seed):
    _, longest = run_all(seed, 2_000, measures_memory=True)
    assert longest < 10 * LISTING.seconds
