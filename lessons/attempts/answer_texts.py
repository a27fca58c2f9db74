"""An answer read again from its text, as attempts keep it."""

import re
from collections.abc import Callable, Iterator
from math import prod
from typing import Any

from lessons.exercises.answers.answer import NotCheckedError, Response
from lessons.exercises.answers.cells import Entry
from lessons.exercises.answers.choices import ChoiceAnswer, OrderAnswer
from lessons.exercises.answers.fields import NumberAnswer, TableAnswer
from lessons.exercises.answers.listings import LineAnswer
from lessons.exercises.answers.pixels import PixelAnswer
from lessons.exercises.answers.places import PlaceAnswer
from lessons.exercises.answers.spots import SpotAnswer
from lessons.exercises.answers.steps import StepsAnswer
from lessons.exercises.answers.trials import BreakAnswer, CheapestAnswer
from lessons.exercises.question import Question

_DECIMALS = re.compile(r" \([^()]*\)$")
"""What stands behind an exact fraction."""


def responses_of(question: Question, text: str) -> Iterator[Response]:
    """Yield the answers to a question whose text is ``text``, the likeliest first; none where it is no such text.

    Notes
    -----
    Text has roots and long fractions rounded: sqrt(2) and 1.41421 are the same text. So the right answer and those of
    the mistakes follow where they have this text.
    """
    answer = question.draft.answer
    try:
        response = answer.read(GIVEN[answer.kind](answer, text))
        is_read = answer.text(response) == text
    except (NotCheckedError, ValueError, IndexError):
        is_read = False
    if is_read:
        yield response
    for known in (answer.reference, *question.draft.mistakes.values()):
        if answer.text(known) == text:
            yield known


def _exact(text: str) -> str:
    return _DECIMALS.sub("", text)


def _behind(text: str, heads: list[str]) -> list[str]:
    """Return what stands behind its head in each line."""
    return [line.removeprefix(head) for head, line in zip(heads, text.split("\n"), strict=True)]


def _pair(text: str) -> list[str]:
    return list(map(_exact, text[1:-1].split(", ")))


def _numbers(answer: NumberAnswer, text: str) -> Any:
    parts = _behind(text, [f"{name} = " for name in answer.names]) if answer.names else text.split(", ")
    return _nested(list(map(_exact, parts)), answer.shape)


def _nested(values: list[str], shape: tuple[int, ...]) -> Any:
    if not shape:
        (value,) = values
        return value
    step = prod(shape[1:])
    return [_nested(values[k * step : (k + 1) * step], shape[1:]) for k in range(shape[0])]


def _choice(answer: ChoiceAnswer, text: str) -> list[str]:
    """Take the options in their order; they may hold commas themselves."""
    chosen, rest = [], f"{text}, "
    for option in answer.options:
        if rest.startswith(f"{option}, "):
            chosen.append(option)
            rest = rest.removeprefix(f"{option}, ")
    return chosen


def _table(answer: TableAnswer, text: str) -> list[list[str]]:
    """Cut the lines where the heads of the columns begin."""
    head, *lines = text.split("\n")
    begins = [max(map(len, answer.labels)) + 2]
    for column, following in zip(answer.columns, answer.columns[1:], strict=False):
        begins.append(head.index(f"  {following.name}", begins[-1] + len(column.name)) + 2)
    ends = [*(begin - 2 for begin in begins[1:]), None]
    rows = [
        [_exact(line[begin:end].strip()) for begin, end in zip(begins, ends, strict=True)] for line in lines
    ]
    return [["" if cell == "..." else cell for cell in row] for row in rows]


def _spot(answer: SpotAnswer, text: str) -> dict[str, object]:
    pixels, _, option = text.partition("; ")
    return {
        "pixels": [[int(i), int(j)] for i, j in re.findall(r"\((\d+), (\d+)\)", pixels)],
        "option": option,
    }


def _steps(answer: StepsAnswer, text: str) -> list[list[Any]]:
    steps = answer.steps[: text.count("\n") + 1]
    lines = _behind(text, [f"{step.label}: " for step in steps])
    return [_tries(step, line) for step, line in zip(steps, lines, strict=True)]


def _tries(step: Entry, line: str) -> list[Any]:
    if step.kind == "choice":  # An option may hold ", then" itself.
        longest_first = sorted((*step.options, "fixed"), key=len, reverse=True)
        return re.findall("|".join(map(re.escape, longest_first)), line)
    return [_pair(one) if one.startswith("(") else _exact(one) for one in line.split(", then ")]


def _itself(_: PixelAnswer, text: str) -> str:
    return text


def _order(_: OrderAnswer, text: str) -> list[str]:
    return text.split(" > ")


def _line(_: LineAnswer, text: str) -> str:
    return text.removeprefix("line ").partition(":")[0]


def _places(answer: PlaceAnswer, text: str) -> list[list[str]]:
    return [_pair(line) for line in _behind(text, [f"{name}: " for name in answer.names])]


def _dials(answer: BreakAnswer, text: str) -> list[str]:
    return list(map(_exact, _behind(text, [f"{dial.label} = " for dial in answer.dials])))


def _methods(answer: CheapestAnswer, text: str) -> list[str]:
    return _behind(text, [f"{family.name}: " for family in answer.families])


GIVEN: dict[str, Callable[[Any, str], Any]] = {
    NumberAnswer.kind: _numbers,
    PixelAnswer.kind: _itself,
    OrderAnswer.kind: _order,
    ChoiceAnswer.kind: _choice,
    LineAnswer.kind: _line,
    PlaceAnswer.kind: _places,
    SpotAnswer.kind: _spot,
    StepsAnswer.kind: _steps,
    TableAnswer.kind: _table,
    BreakAnswer.kind: _dials,
    CheapestAnswer.kind: _methods,
}
"""By type of answer, what it reads of a text."""
