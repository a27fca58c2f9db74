"""No method costs more than the picture and the number of triangles allow, however far away corners lie."""

import sys
import tracemalloc
from collections.abc import Callable
from itertools import product
from types import FrameType
from typing import Any

import numpy as np
import pytest

from core import ClipScene, Settings, render, trace
from core.lines.line_method import STEP_LIMIT
from core.methods import table
from tests.core.strategies import clip_of_window
from tests.core.trace.trace_cases import CHOICES, EACH_METHOD, name_of
from tests.covering import every_nth

SIZE = (7, 12)
DISTANCES = (6e4, 1e6, 1e15)
"""Pixels: within the snapping limit, beyond it, and where float64 tells whole pixels from each other no longer."""
LINES = 100_000
"""Lines of code that a picture of this size may run: twice as many as any method does."""
MEMORY = 16_000_000
"""Bytes that it may take at a time; likewise."""
STEP_BY_STEP = ("bresenham-float", "dda", "dda-float32")
"""Lines whose numbers are added up from the first end on, also outside the raster: up to `STEP_LIMIT` of them."""
THROUGH_THE_EYE = [
    [[1.375, 3.625, 2.5, 1.75], [3, -3, -2, -3.125], [-2, -3, -1.5, 0.75]],
    [[1.375, 3.625, 0.5, 1e-9], [3, -3, -2, 0], [-2, -3, -0.5, 0.75]],
]


def far_scene() -> ClipScene:
    """Return triangles over the picture with one, two or three corners far away, to all sides."""
    points = [
        shape
        for r in DISTANCES
        for shape in (
            [[2, 3], [-r, 5], [3, r]],
            [[-r, -r], [r, -0.9 * r], [3, r]],
            [[3, -r], [5.5, r], [6, -r]],
        )
    ]
    clip = np.concatenate([clip_of_window(points, SIZE, [1, 2, 0.5], 0.25), THROUGH_THE_EYE])
    return ClipScene(clip, np.ones((len(clip), 3, 4)) * [0.2, 0.4, 0.6, 0.5], SIZE)


FAR = far_scene()
BY_LINES = [
    {"polygon_mode": "wireframe", "line": line, "line_clipping": clipping}
    for line, clipping in product(table.names("line"), table.names("line_clipping"))
]
BY_NUMBERS = [
    {"coverage": coverage, "fill": fill}
    for coverage, fill in product(table.names("coverage"), table.names("fill"))
]


class TooManyLines(Exception):
    """Some method runs on and on."""


def cost_of(run: Callable[[], Any], most: int) -> tuple[int, int]:
    """Return how many lines of core's code run, and the most bytes that are taken at a time."""
    count = 0

    def count_lines(frame: FrameType, event: str, value: Any) -> Any:
        nonlocal count
        if "core" not in frame.f_globals.get("__name__", ""):
            return None
        count += event == "line"
        if count > most:
            raise TooManyLines
        return count_lines

    before = sys.gettrace()
    tracemalloc.start()
    sys.settrace(count_lines)
    try:
        run()
    finally:
        sys.settrace(before)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
    return count, peak


def check(choice: dict[str, Any], run: Callable[[Settings], Any]) -> None:
    """Check that a run with a choice takes no more lines and bytes than it may."""
    chosen, lines, memory = Settings(**choice), LINES, MEMORY
    if chosen.polygon_mode == "wireframe" and chosen.line in STEP_BY_STEP:
        lines, memory = lines + 20 * STEP_LIMIT, memory + 64 * STEP_LIMIT
    _, peak = cost_of(lambda: run(chosen), lines)
    assert peak <= memory, f"{peak:,} bytes"


def test_pictures():
    lines = ({"polygon_mode": "wireframe", "line": line} for line in table.names("line"))
    for choice in every_nth([*EACH_METHOD, *lines], 3):
        check(choice, lambda chosen: render(FAR, chosen))


@pytest.mark.slow
@pytest.mark.parametrize("choice", [*BY_LINES, *BY_NUMBERS], ids=name_of)
def test_all_lines_and_all_numbers(choice):
    check(choice, lambda chosen: render(FAR, chosen))


@pytest.mark.slow
@pytest.mark.parametrize("choice", [*CHOICES, *BY_LINES, *BY_NUMBERS], ids=name_of)
def test_traces(choice):
    def run(chosen: Settings) -> None:
        traced = trace(FAR, chosen)
        for stage in ("clip", "bin", "raster", "depth", "resolve"):
            traced.stage(stage)

    check(choice, run)
