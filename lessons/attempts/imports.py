"""Attempts of somebody else's file: judged again where their question is known, else marked."""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime

from core.records.words import counted
from lessons.attempts.record import ANSWER_LIMIT, NOT_CHECKED, Attempt, is_of_lesson
from lessons.exercises.answers.answer import NotCheckedError, Response
from lessons.exercises.question import Question, Template, ask, judge
from lessons.exercises.screen import PREFIX, screen_template

Report = Callable[[float, str], None]
NAMES_SHOWN = 3
"""Most exercises that a sentence names."""


@dataclass(frozen=True)
class Imported:
    """What came of a file of attempts."""

    attempts: tuple[Attempt, ...]
    sentences: tuple[str, ...]
    """What is to be told of them."""


def judged_again(
    attempts: Sequence[Attempt],
    templates: Mapping[str, Template],
    now: datetime,
    report: Report | None = None,
) -> Imported:
    """Judge attempts again; those whose question or answer is not known are marked, with no more points than there are.

    Steps of lessons earn no points, so they are taken as they are.

    Parameters
    ----------
    attempts : sequence of Attempt
        As a file holds them.
    templates : mapping
        All exercises that are known, by name.
    now : datetime
        In UTC: answers with a later date are reported.
    report : callable, optional
        Is called with the fraction that is done, and with what is being done.
    """
    questions: dict[tuple[str, int], Question | None] = {}
    unknown: Counter[str] = Counter()
    judged: list[Attempt] = []
    changed = 0
    for number, attempt in enumerate(attempts):
        if report is not None:
            report(number / len(attempts), "judging answers")
        if is_of_lesson(attempt):
            judged.append(attempt.model_copy(update={"points": 0.0, "most": 0}))
            continue
        place = attempt.template, attempt.seed
        template = _template(attempt.template, templates)
        is_known = template is not None and template.version == attempt.version
        if template is not None and is_known and place not in questions:
            questions[place] = _question(template, attempt.seed)
        question = questions.get(place) if is_known else None
        again = None if question is None else _judged(attempt, question)
        if again is None:
            unknown[attempt.template] += 1
            again = _marked(attempt, template)
        else:
            changed += again != attempt
        judged.append(again)
    return Imported(tuple(judged), tuple(_sentences(attempts, judged, unknown, changed, now)))


def _template(name: str, templates: Mapping[str, Template]) -> Template | None:
    if name.startswith(PREFIX) and name not in templates:
        try:
            return screen_template(name)
        except ValueError:
            return None
    return templates.get(name)


def _question(template: Template, seed: int) -> Question | None:
    try:
        return ask(template, seed)
    except ValueError:
        return None


def _judged(attempt: Attempt, question: Question) -> Attempt | None:
    """Return an attempt with what its answer earns; ``None``: its text is no answer to the question."""
    try:
        judgements = [judge(question, response) for response in responses_of(question, attempt.answer)]
    except NotCheckedError:  # A listing whose run does not end.
        return None
    if not judgements:
        return None
    found = next((one for one in judgements if abs(one.verdict.score - attempt.score) < 1e-9), judgements[0])
    return attempt.model_copy(
        update={
            "stage": question.template.stage,
            "asked": tuple(question.draft.mistakes),
            "verdict": found.verdict.counts,
            "score": found.verdict.score,
            "points": found.points,
            "most": question.template.points,
            "mistakes": found.mistakes,
            "is_slip": found.is_slip,
        }
    )


def _marked(attempt: Attempt, template: Template | None) -> Attempt:
    most = attempt.most if template is None else template.points
    verdict = (
        attempt.verdict if not attempt.is_checked else f"{NOT_CHECKED}: {attempt.verdict}"[:ANSWER_LIMIT]
    )
    points = min(attempt.points, attempt.score * most)
    return attempt.model_copy(update={"verdict": verdict, "most": most, "points": points})


def _sentences(
    given: Sequence[Attempt], judged: Sequence[Attempt], unknown: Counter[str], changed: int, now: datetime
) -> Iterable[str]:
    """Yield what is to be told."""
    again = len(judged) - unknown.total()
    if again:
        otherwise = f", {changed} with another result" if changed else ""
        yield f"{counted(again, 'answer')} judged again{otherwise}."
    if unknown:
        names = ", ".join(list(unknown)[:NAMES_SHOWN])
        more = f" and {len(unknown) - NAMES_SHOWN} more" if len(unknown) > NAMES_SHOWN else ""
        yield (
            f"{counted(unknown.total(), 'answer')} not checked: exercise, version or answer is not known "
            f"({names}{more})."
        )
    too_many = sum(one.points > other.most for one, other in zip(given, judged, strict=True))
    if too_many:
        yield f"{counted(too_many, 'answer')} had more points than there are."
    late = sum(attempt.at > now for attempt in judged)
    if late:
        yield f"{counted(late, 'answer')} dated later than now."


def responses_of(question: Question, text: str) -> Iterator[Response]:
    """Yield the answers to a question whose text is ``text``, the likeliest first; none where it is no such text.

    Notes
    -----
    Text has roots and long fractions rounded: sqrt(2) and 1.41421 are the same text. So the right answer and those of
    the mistakes follow where they have this text.
    """
    answer = question.draft.answer
    try:
        response = answer.read(answer.said(text))
        is_read = answer.text(response) == text
    except (NotCheckedError, ValueError, IndexError):
        is_read = False
    if is_read:
        yield response
    for known in (answer.reference, *question.draft.mistakes.values()):
        if answer.text(known) == text:
            yield known
