"""Answers that are runs: points and dials that are drawn at once, steps, and the cheapest methods."""

from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from app.pages.exercises.answer_kind import AnswerKind, Live, coverage_of, number_of, plain_number, understood
from app.pages.exercises.scene_outline import scene_outline
from core import render
from core.methods import table
from core.raster.edges.snapping import window_position
from core.settings import FAMILIES
from lessons.exercises.answers.amounts import read_entry
from lessons.exercises.answers.answer import Response, Verdict
from lessons.exercises.answers.places import PlaceAnswer, Places
from lessons.exercises.answers.steps import FIXED, Run, StepsAnswer
from lessons.exercises.answers.trials import BreakAnswer, CheapestAnswer, Dial, Values
from lessons.exercises.drawn_scene import frame_art
from lessons.exercises.numbers import number_text
from lessons.exercises.question import Draft, Question
from widgets.exercises.records import (
    CornerRecord,
    DialForm,
    DialRecord,
    FamilyRecord,
    ItemMarks,
    MethodForm,
    NoMarks,
    PlaceForm,
    StepLine,
    StepsForm,
    StepsState,
    Understood,
)
from widgets.grid.overlay import Mark, MaskOverlay


def nearest(value: float, low: Fraction, high: Fraction, step: Fraction) -> Fraction:
    """Return the nearest of ``low``, ``low + step`` ... up to ``high``."""
    last = (high - low) // step
    return low + min(max(round((Fraction(value) - low) / step), 0), last) * step


class PlaceKind(AnswerKind):
    """Points on the picture, with fields beside it."""

    def form(self, answer: PlaceAnswer) -> PlaceForm:
        """Return the points."""

        def understand(column: int, text: str) -> Understood:
            return understood(lambda text: number_text(read_entry(text)), text)

        def snapped(value: float) -> str:
            return plain_number(nearest(value, Fraction(0), Fraction(max(answer.size)), answer.step))

        return PlaceForm(answer.size, answer.names, snapped, number_of, understand)

    def given(self, answer: PlaceAnswer, response: Places) -> list[list[str]]:
        """Return x and y as texts."""
        del answer
        return [[plain_number(x), plain_number(y)] for x, y in response]

    def read(self, answer: PlaceAnswer, given: list[list[str]]) -> object:
        """Return the texts; of points without a place, nothing."""
        del answer
        return given if any(text.strip() for place in given for text in place) else ""

    def marks(self, question: Question, response: Places, verdict: Verdict) -> ItemMarks:
        """Return which points are right."""
        del question, response
        return ItemMarks(frozenset(verdict.marks["right"]), frozenset(verdict.marks["wrong"]))

    def size(self, draft: Draft) -> tuple[int, int]:
        """Return the window in which the points lie."""
        answer = draft.answer
        assert isinstance(answer, PlaceAnswer)
        return answer.size

    def _target(self, draft: Draft) -> Any:
        """Return the picture that the question gives, or ``None``: a run decides, and its coverage is what is given."""
        answer = draft.answer
        assert isinstance(answer, PlaceAnswer)
        if answer.scene_of is None or answer.is_right is None:
            return None
        frame = render(answer.scene_of(answer.reference), draft.settings)
        return frame if frame_art(frame) in draft.given else None

    def numbers(self, draft: Draft) -> str:
        """Return the numbers without the picture that is to be covered."""
        frame = self._target(draft)
        return draft.given if frame is None else draft.given.replace(frame_art(frame), "").strip("\n")

    def live(self, draft: Draft, response: Places | None) -> Live | None:
        """Return the outlines with the points, over the picture that is to be covered."""
        answer = draft.answer
        assert isinstance(answer, PlaceAnswer)
        if answer.scene_of is None:
            return None
        frame = self._target(draft)
        picture = None if frame is None else coverage_of(frame, "to be covered")
        return Live(None if response is None else scene_outline(answer.scene_of(response)), picture)


class StepsKind(AnswerKind):
    """One step after the other."""

    def form(self, answer: StepsAnswer) -> StepsForm:
        """Return the steps."""
        return StepsForm(partial(self._state, answer))

    def _state(self, answer: StepsAnswer, given: list[list[str]]) -> StepsState:
        run: Run = answer.read(self._plain(given)) if given else ()
        number = answer.open_step(run)
        lines = []
        for k, step in enumerate(answer.steps):
            tries = run[k] if k < len(run) else ()
            text = ", then ".join(step.text(value) for value in tries if value is not FIXED)
            standing = "open" if k == number else ""
            if FIXED in tries:
                standing, text = "fixed", ", then ".join(filter(None, (text, step.text(step.right))))
            elif tries and k != number:
                standing = "right" if len(tries) == 1 else "wrong"
            lines.append(StepLine(step.prompt, text, standing))
        done = answer.steps[: len(answer.steps) if number is None else number]
        pixels = frozenset(step.right for step in done if step.kind == "pixel")
        if number is None:
            return StepsState(tuple(lines), None, pixels=pixels)
        step = answer.steps[number]
        return StepsState(tuple(lines), number, step.kind, step.options, number < len(run), pixels)

    def _plain(self, given: list[list[str]]) -> list[Any]:
        """Return the tries as files have them: one alone is no list."""
        return [tries[0] if len(tries) == 1 else tries for tries in given]

    def given(self, answer: StepsAnswer, response: Run) -> list[list[str]]:
        """Return the tries as texts."""
        return [
            [self._text(answer.steps[k].kind, answer.steps[k].options, value) for value in tries]
            for k, tries in enumerate(response)
        ]

    def _text(self, kind: str, options: tuple[str, ...], value: Any) -> str:
        if value is FIXED:
            return "fixed"
        if kind == "choice":
            return options[int(value)]
        if kind == "number":
            return plain_number(value)
        return ", ".join(plain_number(Fraction(part) if isinstance(part, int) else part) for part in value)

    def read(self, answer: StepsAnswer, given: list[list[str]]) -> object:
        """Return the tries as files have them."""
        del answer
        return self._plain(given)

    def marks(self, question: Question, response: Response, verdict: Verdict) -> NoMarks:
        """Return no marks: every step has its own already."""
        del question, response, verdict
        return NoMarks()


class BreakKind(AnswerKind):
    """Dials, with the picture of the weak method as they turn."""

    def form(self, answer: BreakAnswer) -> DialForm:
        """Return the dials."""

        def snapped(number: int, value: float) -> str:
            dial = answer.dials[number]
            return plain_number(nearest(value, dial.low, dial.high, dial.step))

        corners: dict[tuple[int, int], list[int | None]] = {}
        for number, dial in enumerate(answer.dials):
            if dial.corner is not None:
                corners.setdefault(dial.corner[:2], [None, None])[dial.corner[2]] = number
        records = tuple(
            CornerRecord(f"{'ABCDEFGH'[at[0] % 8]}{at[1]}", x, y, partial(self._at, answer, at))
            for at, (x, y) in corners.items()
        )
        dials = tuple(
            DialRecord(
                dial.name, dial.count, partial(self._value, dial), partial(self._place, dial), dial.values
            )
            for dial in answer.dials
        )
        start = tuple(snapped(number, float(value)) for number, value in enumerate(answer.start))
        return DialForm(dials, start, records, snapped)

    def _at(self, answer: BreakAnswer, at: tuple[int, int], given: list[str]) -> tuple[float, float]:
        scene = answer.scene_of(answer.read(given))
        x, y = window_position(scene.clip, scene.size)[at].tolist()
        return x, y

    def _value(self, dial: Dial, place: int) -> str:
        return plain_number(dial.value(place))

    def _place(self, dial: Dial, text: str) -> int:
        return int((dial.read(text) - dial.low) / dial.step)

    def given(self, answer: BreakAnswer, response: Values) -> list[str]:
        """Return the numbers as texts."""
        del answer
        return [plain_number(value) for value in response]

    def marks(self, question: Question, response: Response, verdict: Verdict) -> NoMarks:
        """Return no marks: words say which method fails."""
        del question, response, verdict
        return NoMarks()

    def size(self, draft: Draft) -> tuple[int, int]:
        """Return the raster of the scene."""
        answer = draft.answer
        assert isinstance(answer, BreakAnswer)
        return answer.scene_of(answer.start).size

    def live(self, draft: Draft, response: Values | None) -> Live:
        """Return the picture of the weak method, marked where the other one draws another or it draws twice."""
        answer = draft.answer
        assert isinstance(answer, BreakAnswer)
        scene = answer.scene_of(answer.start if response is None else response)
        weak, robust = render(scene, answer.weak), render(scene, answer.robust)
        differs = np.asarray(weak.primitive != robust.primitive)
        overlays = (
            MaskOverlay("differs", Mark.DIFFERENCE, differs, title="the other method draws otherwise"),
            MaskOverlay("double", Mark.DOUBLE, np.asarray(weak.cover_count > 1), title="drawn twice"),
        )
        return Live(scene_outline(scene), coverage_of(weak, "weak method"), overlays)


class CheapestKind(AnswerKind):
    """A method of each family."""

    def form(self, answer: CheapestAnswer) -> MethodForm:
        """Return the families with the costs of their methods."""
        families = tuple(
            FamilyRecord(
                family.name,
                FAMILIES[family.name].title,
                tuple(
                    (name, f"{table.get(family.name, name).title}, cost {number_text(cost)}")
                    for name, cost in zip(family.methods, family.costs, strict=True)
                ),
            )
            for family in answer.families
        )

        def cost(given: dict[str, str]) -> str:
            return f"Cost together: {number_text(answer.cost(answer.read(given)))}"

        return MethodForm(families, cost)

    def given(self, answer: CheapestAnswer, response: Response) -> dict[str, str]:
        """Return the methods by family."""
        return {family.name: family.methods[k] for family, k in zip(answer.families, response, strict=True)}

    def read(self, answer: CheapestAnswer, given: dict[str, str]) -> object:
        """Return the methods; where none is chosen, nothing."""
        del answer
        return given if any(given.values()) else ""

    def marks(self, question: Question, response: Response, verdict: Verdict) -> NoMarks:
        """Return no marks: words say error and cost."""
        del question, response, verdict
        return NoMarks()
