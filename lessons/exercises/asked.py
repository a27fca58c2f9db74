"""What the templates ask, and what must hold of each at every seed."""

import re
import tomllib
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from math import sqrt
from pathlib import Path
from time import process_time

from core import STAGES
from lessons.exercises.answers.answer import Response
from lessons.exercises.numbers import SEED_LIMIT, Draws
from lessons.exercises.question import Question, Template, ask, judge
from lessons.mistakes.shelf import MISTAKES

# What the templates ask: each stage by type of answer, each family, experiment and question of the
# lectures.


PATH = Path(__file__).with_name("asked.toml")
LECTURES = ("Zwicker", "Pellacini", "Jubair", "LMU")


@dataclass(frozen=True)
class Topic:
    """Something to ask about."""

    name: str
    templates: tuple[str, ...] = ()
    """Names of those that ask it."""
    reason: str = ""
    """Why none does."""


@cache
def topics() -> dict[str, tuple[Topic, ...]]:
    """Return what there is to ask about: ``families``, ``experiments``, ``mistakes``, and each of ``LECTURES``."""
    with PATH.open("rb") as file:
        sections = tomllib.load(file)
    return {
        section: tuple(
            Topic(name, reason=value) if isinstance(value, str) else Topic(name, tuple(value))
            for name, value in rows.items()
        )
        for section, rows in sections.items()
    }


def kinds_by_stage(questions: Mapping[str, Question]) -> dict[str, Counter[str]]:
    """Count the templates of each stage by type of answer; ``questions`` has one of each, by name."""
    kinds = {stage: Counter[str]() for stage in STAGES}
    for question in questions.values():
        kinds[question.template.stage][question.draft.answer.kind] += 1
    return kinds


def mistake_topics(questions: Mapping[str, Question]) -> list[Topic]:
    """Return every mistake with the templates that show it; ``questions`` has one of each, by name."""
    shown: dict[str, list[str]] = {name: [] for name in MISTAKES}
    for name, question in questions.items():
        for mistake in question.draft.mistakes:
            shown[mistake].append(name)
    known = {topic.name: topic for topic in topics()["mistakes"]}
    return [known.get(name, Topic(name, tuple(templates))) for name, templates in shown.items()]


# What must hold of every template at every seed: checked by tests and by ``rasterscope exercise selftest``.


GUESSES, LEAST_GUESSES, MOST_GUESSES = 2000, 10, 100
"""Random answers to all questions of a template together, and to each question at least and at most."""
GUESS_LIMIT = 0.05
"""Most that random answers earn on average above the stated score of chance, and three times its spread."""
NAMED_LIMIT = 0.01
"""Largest share of wrong random answers that are called by the name of a mistake, where the answers are many."""

RULE_NUMBERS = {"0", "1", "2"}
"""Numbers of rules and names, such as 2 dy and x0: hints may hold them, and those that the question shows."""


@dataclass(frozen=True)
class Findings:
    """What was found of one template."""

    name: str
    seeds: int
    problems: tuple[str, ...]
    guessed: float
    """Mean score of random answers."""
    chance: float
    """The stated mean score of random answers."""
    equal: frozenset[tuple[str, str]]
    """Mistakes that gave one answer at some seed."""
    digest: str
    """Of all questions and answers as text: the same on every machine."""
    asking: tuple[float, ...]
    """Processor time of drawing each question and checking its right answer, in seconds."""
    naming: tuple[float, ...]
    """Likewise of naming each mistake."""


def check_template(template: Template, seeds: range) -> Findings:
    """Check the questions of seeds."""
    problems: list[str] = []
    equal: set[tuple[str, str]] = set()
    asking: list[float] = []
    naming: list[float] = []
    guessed = chance = named = 0.0
    is_many, count = True, len(seeds)
    guesses = min(max(GUESSES // count, LEAST_GUESSES), MOST_GUESSES)
    digest = sha256()
    for seed in seeds:
        begun = process_time()
        question = ask(template, seed)
        answer = question.draft.answer
        answer.check(answer.reference)
        asking.append(process_time() - begun)
        problems += [f"seed {seed}: {problem}" for problem in question_problems(question)]
        for name, wrong in question.draft.mistakes.items():
            begun = process_time()
            found = judge(question, wrong)
            naming.append(process_time() - begun)
            equal.update((name, other) for other in found.mistakes if other > name)
        # Of another seed than the question: its first draw would be the first draw of the question, too.
        draws = Draws(SEED_LIMIT - seed)
        judged = [judge(question, answer.random(draws)) for _ in range(guesses)]
        guessed += sum(one.verdict.score for one in judged) / guesses
        named += sum(bool(one.mistakes) for one in judged) / guesses
        chance += answer.chance
        is_many = is_many and answer.is_many
        digest.update(question_text(question).encode())
    guessed, chance, named = guessed / count, chance / count, named / count
    spread = sqrt(chance * (1 - chance) / (count * guesses))
    if guessed > chance + GUESS_LIMIT + 3 * spread:
        problems.append(f"random answers earn {guessed:.1%}, stated {chance:.1%}")
    if is_many and named > NAMED_LIMIT:
        problems.append(f"{named:.1%} of random answers are called a mistake")
    return Findings(
        template.name,
        count,
        tuple(problems),
        guessed,
        chance,
        frozenset(equal),
        digest.hexdigest()[:16],
        tuple(asking),
        tuple(naming),
    )


def question_problems(question: Question) -> list[str]:
    """Return what is wrong with a question: the right answer, all, none, each mistake."""
    answer = question.draft.answer
    problems = []
    right = judge(question, answer.reference)
    if right.verdict.score != 1 or right.mistakes or right.is_slip:
        problems.append("the right answer does not earn all points")
    if any(answer.check(extreme).score for extreme in answer.extremes()):
        problems.append("all or none earns points")
    for name, wrong in question.draft.mistakes.items():
        found = judge(question, wrong)
        if name not in found.mistakes or found.is_slip:
            problems.append(f"{name} is not recognised")
        if found.verdict.score == 1:
            problems.append(f"{name} earns all points")
    shown = numbers_in(question.draft.text, question.draft.given, answer.offered)
    if not question.template.is_fixed and shown and not shown & numbers_in(question.draft.hints[-1]):
        problems.append("the last hint has no number of the question")
    for hint in question.draft.hints:
        for number in sorted(numbers_in(hint) - shown - RULE_NUMBERS):
            problems.append(f"a hint holds {number}, which the question does not show")
    return problems


def numbers_in(*texts: str) -> set[str]:
    """Return the whole numbers that stand in texts."""
    return {number for text in texts for number in re.findall("[0-9]+", text)}


def question_text(question: Question) -> str:
    """Return a question with all its answers as text, to record and to compare."""
    draft = question.draft
    answers: dict[str, Response] = {"right": draft.answer.reference, **draft.mistakes}
    lines = [question.mark, draft.text, draft.given, draft.answer.offered]
    for name, response in answers.items():
        lines += [f"{name}:", draft.answer.text(response)]
    return "\n".join([*lines, ""])
