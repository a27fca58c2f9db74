"""Which variable a number of the formula is, and which step wrote what a pixel of the grid holds."""

import math
import re
from collections.abc import Iterator

import numpy as np

from app.session.moment import Moment
from core.explain.number_text import parse_number
from core.explain.steps import variables
from core.trace.origins import Origin
from core.trace.stage_trace import Explanation
from widgets.inspector.formula_layout import FormulaNumber

TOLERANCE = 6e-4
"""A number shown with four significant digits differs by no more than this part of it."""
COMPONENTS = {"x": 0, "y": 1, "z": 2, "w": 3, "r": 0, "g": 1, "b": 2, "u": 0, "v": 1}


def variable_of(explanation: Explanation, shown: FormulaNumber) -> tuple[str, int | None] | None:
    """Return column and element of the variable that a number of a step's formula shows.

    Of variables with that value, the one with its symbol is taken, then one with its symbol's first letters, then one
    that the step has not set itself.
    """
    value = parse_number(shown.text.replace(" · 10^", "e").replace("\u2212", "-"))
    symbol = _bare(shown.symbol)
    best, best_score = None, 0
    for name, column, element, held in _numbers(explanation):
        if not math.isclose(held, value, rel_tol=TOLERANCE, abs_tol=1e-12):
            continue
        score = 1 + (column not in explanation.changed)
        if _bare(name) == symbol:
            score += 8
        elif element is not None and (symbol[:1], element) in COMPONENTS.items():
            score += 4
        elif _bare(name)[:1] == symbol[:1]:
            score += 2
        if score > best_score:
            best, best_score = (column, element), score
    return best


def _numbers(explanation: Explanation) -> Iterator[tuple[str, str, int | None, float]]:
    """Yield name, column, element and value of every number of a step, those under Variables first."""
    for variable in variables(explanation):
        parts = variable.now if isinstance(variable.now, tuple) else (variable.now,)
        for k, part in enumerate(parts):
            if isinstance(part, int | float) and not isinstance(part, bool):
                is_part = isinstance(variable.now, tuple) and variable.element is None
                yield variable.name, variable.column, k if is_part else variable.element, float(part)
    for column, value in explanation.values.items():
        array = np.asarray(value)
        if array.dtype.kind in "iuf" and array.ndim <= 1:
            for k, number in enumerate(np.ravel(array).tolist()):
                yield column, column, k if array.ndim else None, float(number)


def _bare(name: str) -> str:
    """Return a symbol or a variable's name without what only one of the two has: brackets, gaps and underscores."""
    return re.sub(r"\(.*\)|[\s_{}]", "", name).lower()


def writer_of(moment: Moment, buffer: str, pixel: tuple[int, int]) -> Origin | None:
    """Return the step that wrote what a buffer of the present stage holds at a pixel; ``None``: none has yet."""
    stage = moment.stage_trace
    track = next((track for track in stage.buffers if track.name == buffer), None)
    if track is None:
        return None
    column, row = moment.place_of(pixel)
    place = row * track.initial.shape[1] + column
    writers = track.rows[(track.places == place) & (track.rows < moment.rows_done)]
    if not len(writers):
        return None
    return Origin(stage.stage, stage.steps.position_after(int(writers[-1])), track.name)
