"""A question: drawn from a template by a seed, answered, checked, refuted; and those about the next step of a run."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import combinations

import numpy as np

from core import Settings, trace
from core.coverage.pixel_runs import Raster
from core.explain.steps import question
from core.records.cells import Sketch
from core.records.words import counted
from core.scene import AnyScene
from core.settings import DEFAULTS
from core.trace.run_to import named_position
from core.trace.stage_trace import StageTrace
from lessons.exercises.answers.answer import Answer, Response, Verdict
from lessons.exercises.answers.choices import ChoiceAnswer
from lessons.exercises.answers.fields import NumberAnswer
from lessons.exercises.answers.marked import NothingToMarkError, Pixel, PixelAnswer, Pixels
from lessons.exercises.numbers import Draws, NoQuestionError
from lessons.mistakes.shelf import MISTAKES

# What refutes a belief: a sentence, and the step of a run that shows it.


@dataclass(frozen=True, eq=False)
class Refutation:
    """A sentence, and the first step of a stage that meets a condition."""

    sentence: str
    scene: AnyScene
    stage: str
    condition: str
    """What happens there, as `named_position` reads it."""
    settings: Settings = DEFAULTS

    def position(self) -> int:
        """Return where the cursor stands when the step is done; ValueError where no step meets the condition."""
        return named_position(trace(self.scene, self.settings).stage(self.stage), self.condition)


# A question: drawn from a template by a seed, answered, checked, and the mistake behind a wrong answer
# named.


TRY_LIMIT = 1000
"""Most draws of a question in which each named mistake must show."""
APART_LIMIT = 30
"""Most draws after the first such one, until the mistakes also differ from each other."""


@dataclass(frozen=True, eq=False)
class Draft:
    """What a template draws."""

    text: str
    """What is asked, with the rule that decides."""
    given: str
    """The numbers of the question, or its picture as text."""
    answer: Answer
    hints: tuple[str, ...] = ()
    """In order: where to look, which rule, the rule with this question's numbers."""
    mistakes: Mapping[str, Response] = field(default_factory=dict)
    """By the name of a twin, the answer that it gives."""
    scene: AnyScene | None = None
    """What is drawn: its outline stands beside the question, and its run is the model answer; ``None``: nothing is."""
    settings: Settings = DEFAULTS
    """Of the right run."""
    pixel: tuple[int, int] | None = None
    """Column and row of the pixel that the question is about, where there is one."""
    reveal: str = ""
    """A sentence with what is right, to be shown after the answer; empty: the answer says it."""
    refutations: Mapping[Response, Refutation] = field(default_factory=dict)
    """By wrong answers behind which a belief stands, what refutes it."""
    sketch: Sketch | None = None
    """The plane or space that the question is about, with what is given in it; ``None``: it is about none."""
    outlined: AnyScene | None = None
    """What the outline shows in place of the scene: more than is drawn; ``None``: the scene itself."""


Make = Callable[[Draws], Draft]
"""Draws a question; NoQuestionError where this draw makes none."""


@dataclass(frozen=True, eq=False)
class Template:
    """What questions of one kind are drawn from."""

    name: str
    version: int
    """Changes when a seed gives another question than before."""
    title: str
    stage: str
    """Of ``core.STAGES``."""
    points: int
    make: Make
    """Draws a question."""
    alike: tuple[frozenset[str], ...] = ()
    """Mistakes that may give the same answer: then both are named."""
    is_fixed: bool = False
    """Every draw is the same."""
    path: str = ""
    """File that it was read from; empty: it is written in Python."""


WRITTEN: dict[str, Template] = {}
"""The templates of all modules that are imported, by name."""


def template(
    name: str,
    version: int,
    title: str,
    stage: str,
    points: int,
    alike: tuple[frozenset[str], ...] = (),
    is_fixed: bool = False,
) -> Callable[[Make], Make]:
    """Declare a template above the function that draws its questions: see the fields of `Template`."""

    def declared(make: Make) -> Make:
        if name in WRITTEN:
            raise ValueError(f"two templates are called {name}")
        WRITTEN[name] = Template(name, version, title, stage, points, make, alike, is_fixed)
        return make

    return declared


@dataclass(frozen=True, eq=False)
class Question:
    """One question."""

    template: Template
    seed: int
    draft: Draft

    @property
    def mark(self) -> str:
        """Name, version and seed: what gives the same question everywhere."""
        return f"{self.template.name} {self.template.version}, seed {self.seed}"


@dataclass(frozen=True, eq=False)
class Judgement:
    """What an answer earns, and which mistake makes it."""

    verdict: Verdict
    points: float
    mistakes: tuple[str, ...]
    """Names of all twins that give exactly this answer."""
    is_slip: bool
    """No twin gives it, and it differs from the right answer in the smallest way."""
    refutation: Refutation | None = None
    """Of the belief behind the answer, where there is one."""
    reason: str = ""
    """Why it is wrong: what is said of a slip, or of a wrong option."""

    @property
    def sentences(self) -> list[str]:
        """The mistakes in words; of several that give one answer, all; what refutes a belief; the reason."""
        refuting = "" if self.refutation is None else self.refutation.sentence
        named = (MISTAKES[name].sentence for name in self.mistakes)
        return [*filter(None, (*named, refuting, self.reason))]


def ask(template: Template, seed: int) -> Question:
    """Draw the question of a seed.

    Raises
    ------
    ValueError
        If no draw makes a question in which each named mistake shows.

    Notes
    -----
    The first draw is taken in which every mistake gives an answer that differs from the right one; if one of the next
    draws also keeps the mistakes apart from each other, that one.
    """
    draws, first, reason = Draws(seed), None, "no draw makes a question"
    tries = 1 if template.is_fixed else TRY_LIMIT
    left = tries
    while left:
        left -= 1
        try:
            draft = template.make(draws)
        except NoQuestionError:
            continue
        hidden = [name for name in draft.mistakes if not _shows(draft, draft.mistakes[name])]
        if hidden:
            reason = f"{hidden[0]} gives the right answer, or none"
        elif template.is_fixed or all(_differ(draft, *pair, template.alike) for pair in _pairs(draft)):
            return Question(template, seed, draft)
        elif first is None:
            first, left = draft, min(left, APART_LIMIT)
    if first is not None:
        return Question(template, seed, first)
    tried = "" if template.is_fixed else f" in {tries} tries"
    raise ValueError(f"{template.name} cannot draw its question{tried}: {reason}")


def _pairs(draft: Draft) -> Iterator[tuple[str, str]]:
    return combinations(draft.mistakes, 2)


def _shows(draft: Draft, response: Response) -> bool:
    return bool(response) and not draft.answer.is_same(response, draft.answer.reference)


def _differ(draft: Draft, one: str, other: str, alike: tuple[frozenset[str], ...]) -> bool:
    is_alike = any({one, other} <= names for names in alike)
    return is_alike or not draft.answer.is_same(draft.mistakes[one], draft.mistakes[other])


def judge(question: Question, response: Response) -> Judgement:
    """Check an answer that was read; an exact twin wins over a slip."""
    draft = question.draft
    verdict = draft.answer.check(response)
    most = question.template.points
    if draft.answer.is_same(response, draft.answer.reference):
        return Judgement(verdict, most * verdict.score, (), False)
    names = tuple(name for name, wrong in draft.mistakes.items() if draft.answer.is_same(response, wrong))
    if names:
        verdict = replace(verdict, score=min(verdict.score, draft.answer.named_limit))
    refutation = draft.refutations.get(response) if draft.refutations else None
    is_slip = not names and draft.answer.is_slip(response)
    reason = draft.answer.slip if is_slip else draft.answer.reason(response)
    if not (names or refutation or reason) and draft.answer.kind == "choice" and verdict.score == 0:
        # The last hint is the rule with the question's numbers, and never holds the answer.
        reason = draft.hints[-1] if draft.hints else ""
    return Judgement(verdict, most * verdict.score, names, is_slip, refutation, reason)


def hints_after(draft: Draft, response: Response | None = None) -> tuple[str, ...]:
    """Return the hints in order; after a wrong answer the last says where it goes wrong first."""
    where = "" if response is None else draft.answer.first_wrong(response)
    return (*draft.hints, *((where,) if where else ()))


# Questions about a run that is stepped: which pixels are covered, or what the next step gives.


TOLERANCE = 0.01
"""Relative error of a number that still counts as right."""
SMALLEST = 1e-9
"""Error of a number near 0 that still counts as right."""
COVERAGE = (
    "Click the covered pixels in the grid: each is checked at once. "
    "Or press Right to be asked about one pixel at a time."
)


def next_draft(trace: StageTrace, raster: Raster, position: int) -> Draft | None:
    """Ask about what comes after a position of a stage: its coverage as a whole, or its next row.

    Returns
    -------
    Draft or None
        ``None``: the stage is done, or its next row needs no prediction.
    """
    if position == 0 and trace.stage == "raster":
        asked = coverage_draft(trace, raster)
        if asked is not None:
            return asked
    row = trace.steps.rows_done(position)
    return row_draft(trace, row) if row < trace.steps.row_count else None


def row_draft(trace: StageTrace, row: int) -> Draft | None:
    """Ask about a row of a stage; ``None`` where there is nothing to predict."""
    asked = question(trace, row)
    if asked is None:
        return None
    answer: Answer
    if asked.choices:
        answer, text = ChoiceAnswer(asked.choices, frozenset({int(asked.answer)})), asked.text
    else:
        tolerance = max(TOLERANCE * abs(asked.answer), SMALLEST)
        answer = NumberAnswer((Fraction(asked.answer),), tolerance=tolerance)
        text = f"{asked.text} (within {TOLERANCE:.0%})".replace("%", " %")
    column, line = (int(number) for number in trace.pixel[row])
    pixel = (column, line) if column >= 0 else None
    return Draft(text, "", answer, pixel=pixel, reveal=asked.reveal)


def coverage_draft(trace: StageTrace, raster: Raster) -> Draft | None:
    """Ask for the covered pixels of a raster stage, counted from its first; ``None`` where none or all are."""
    rows, columns = raster.shape
    covered = np.zeros((rows, columns), bool)
    pixels = trace.pixel[trace.marks["covered"] & (trace.pixel[:, 0] >= 0)]
    covered.ravel()[raster.index(pixels[:, 0], pixels[:, 1])] = True
    try:
        answer = PixelAnswer(
            (columns, rows), frozenset((column, row) for row, column in np.argwhere(covered).tolist())
        )
    except NothingToMarkError:
        return None
    return Draft(COVERAGE, "", answer)


def pixel_sentence(answer: PixelAnswer, pixel: Pixel, raster: Raster) -> str:
    """Say whether a pixel that was clicked is covered."""
    first_column, first_row, _, _ = raster.bounds
    said = "covered" if pixel in answer.reference else "not covered"
    return f"({pixel[0] + first_column}, {pixel[1] + first_row}) is {said}."


def coverage_sentence(answer: PixelAnswer, clicked: Pixels) -> str:
    """Say how the clicked pixels compare with the covered ones."""
    marks = answer.check(clicked).marks
    right, missing, extra = (len(marks[name]) for name in ("right", "missing", "extra"))
    covered = counted(right + missing, "covered pixel")
    return f"{right} of {covered} right (tick), {extra} extra (cross), {missing} missing (square)."
