"""What most templates need: numbers by a formula, their mistakes, and numbers as text."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Any

from core import Settings, render
from core.methods import table as table_of_methods
from core.records.frame import Frame
from core.records.sketch import Sketch
from core.scene import AnyScene, ClipScene
from core.settings import DEFAULTS
from lessons.exercises.answers.answer import Answer, Response
from lessons.exercises.answers.choices import ChoiceAnswer
from lessons.exercises.answers.fields import Column, Follow, NumberAnswer, Numbers, TableAnswer, number_rows
from lessons.exercises.answers.pixels import PixelAnswer, Pixels
from lessons.exercises.asked_text import parts_of
from lessons.exercises.drawn_scene import seen_pixels, window_text
from lessons.exercises.draws import reject
from lessons.exercises.numbers import Number, number_text
from lessons.exercises.question import Draft
from lessons.mistakes.shelf import RULES, SHELF

TOLERANCE = 0.005
WITHIN = "Fractions, or decimals within 0.005."


def place_text(place: Iterable[Any]) -> str:
    """Return numbers in brackets."""
    return f"({', '.join(number_text(as_number(c)) for c in place)})"


def words(value: Any) -> str:
    """Return a number, a place (a tuple), or several things (a list) as text; text stays."""
    if isinstance(value, str):
        return value
    if isinstance(value, list):
        return ", ".join(map(words, value))
    return place_text(value) if isinstance(value, tuple) else number_text(as_number(value))


def listed(line: str, *columns: Iterable[Any]) -> str:
    """Return a line for each row of some columns; ``{k}`` stands for its number."""
    rows = enumerate(zip(*columns, strict=False))
    return "\n".join(line.format(*map(words, row), k=k) for k, row in rows)


def factor_text(value: Number) -> str:
    """Return a number as it stands in an expression: a fraction without its decimals, what is negative in brackets."""
    text = number_text(value).partition(" (")[0]
    return f"({text})" if value < 0 else text


def run_exactly(family: str, name: str, *numbers: int | Fraction) -> Any:
    """Return what the listing of a method gives for exact numbers, whole ones as fractions."""
    listing = table_of_methods.get(family, name).listing
    assert listing is not None
    return listing(*map(Fraction, numbers))


def as_number(value: Any) -> Number:
    """Return whole numbers and fractions exactly, and floats without the rounding of their last digits."""
    return round(float(value), 12) + 0.0 if isinstance(value, float) else Fraction(value)


def as_numbers(values: Iterable[Any]) -> Numbers:
    """Return numbers of an answer."""
    return tuple(as_number(value) for value in values)


def drafted(
    asked: str,
    given: str,
    answer: Answer,
    mistakes: Mapping[str, Response] | None = None,
    scene: AnyScene | None = None,
    settings: Settings = DEFAULTS,
    behind: str = "",
    **more: Any,
) -> Draft:
    """Return a draft of a question and its hints in one block of text; ``more``: other fields of `Draft`.

    ``behind`` stands behind the question: how near a number must be, or what to do with a listing.
    """
    text, hints = parts_of(asked)
    return Draft(f"{text} {behind}".strip(), given, answer, hints, mistakes or {}, scene, settings, **more)


def numbers(
    asked: str,
    given: str,
    values: Iterable[Any],
    wrong: Mapping[str, Iterable[Any]] | None = None,
    names: Sequence[str] = (),
    shape: tuple[int, ...] | None = None,
    scene: AnyScene | None = None,
    settings: Settings = DEFAULTS,
    pixel: tuple[int, int] | None = None,
    sketch: Sketch | None = None,
) -> Draft:
    """Ask for numbers; ``shape`` is that of a matrix, without it a number or a vector is asked for."""
    right = as_numbers(values)
    if shape is None:
        shape = () if len(right) == 1 else (len(right),)
    mistakes = {name: as_numbers(response) for name, response in (wrong or {}).items()}
    # Runs give floats, which must be recognised when they are typed as whole numbers.
    every = [number for response in (right, *mistakes.values()) for number in response]
    is_whole = all(isinstance(number, Fraction) and number.denominator == 1 for number in every)
    answer = NumberAnswer(right, shape, tuple(names), 0.0 if is_whole else TOLERANCE)
    within = "" if is_whole else WITHIN
    return drafted(asked, given, answer, mistakes, scene, settings, within, pixel=pixel, sketch=sketch)


def by_rule(
    asked: str,
    given: str,
    arguments: tuple[Any, ...],
    mistakes: Sequence[str],
    names: Sequence[str] = (),
    shape: tuple[int, ...] | None = None,
    sketch: Sketch | None = None,
) -> Draft:
    """Ask for the numbers that a formula gives; the mistakes are wrong formulas of the same arguments."""
    wrong = {name: RULES[name].wrong(*arguments) for name in mistakes}
    right = RULES[mistakes[0]].right(*arguments)
    return numbers(asked, given, right, wrong, names, shape, sketch=sketch)


def pictured(
    asked: str,
    given: str,
    scene: ClipScene,
    names: Sequence[str],
    settings: Settings = DEFAULTS,
    read: Callable[[Frame], Pixels] = seen_pixels,
) -> Draft:
    """Ask for the pixels that are read from the picture of a scene; the mistakes draw it, too."""
    answer = PixelAnswer(scene.size, read(render(scene, settings)))
    wrong = {name: read(SHELF[name].draw(scene, settings)) for name in names}
    return drafted(asked, f"{window_text(scene.size)}\n{given}", answer, wrong, scene, settings)


def several(
    asked: str,
    given: str,
    options: Sequence[str],
    right: Iterable[int],
    wrong: Mapping[str, Iterable[int]] | None = None,
    scene: AnyScene | None = None,
    settings: Settings = DEFAULTS,
) -> Draft:
    """Ask which of several options hold: neither all, nor none."""
    chosen = frozenset(right)
    reject(not 0 < len(chosen) < len(options))
    mistakes = {name: frozenset(response) for name, response in (wrong or {}).items()}
    answer = ChoiceAnswer(tuple(options), chosen, is_several=True)
    return drafted(asked, given, answer, mistakes, scene, settings)


def one_of(
    asked: str,
    given: str,
    options: Sequence[str],
    right: int,
    wrong: Mapping[str, int] | None = None,
    scene: AnyScene | None = None,
) -> Draft:
    """Ask which one option holds."""
    mistakes = {name: frozenset({response}) for name, response in (wrong or {}).items()}
    answer = ChoiceAnswer(tuple(options), frozenset({right}))
    return drafted(asked, given, answer, mistakes, scene)


def table(
    asked: str,
    given: str,
    columns: Sequence[str],
    labels: Sequence[str],
    rows: Sequence[Sequence[Any]],
    wrong: Mapping[str, Sequence[Sequence[Any]]] | None = None,
    follow: Follow | None = None,
    scene: AnyScene | None = None,
    settings: Settings = DEFAULTS,
    pixel: tuple[int, int] | None = None,
    tolerance: float = TOLERANCE,
) -> Draft:
    """Ask for a table of numbers."""
    mistakes = {name: number_rows(cells) for name, cells in (wrong or {}).items()}
    is_whole = all(Fraction(cell).denominator == 1 for row in rows for cell in row)
    answer = TableAnswer(
        tuple(Column(name) for name in columns),
        tuple(labels),
        number_rows(rows),
        follow,
        0.0 if is_whole else tolerance,
    )
    within = "" if is_whole else f"Fractions, or decimals within {tolerance:g}."
    return drafted(asked, given, answer, mistakes, scene, settings, within, pixel=pixel)
