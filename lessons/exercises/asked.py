"""What the templates ask: each stage by type of answer, each family, experiment and question of the lectures."""

import tomllib
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from core import STAGES
from lessons.exercises.question import Question
from lessons.mistakes.shelf import MISTAKES

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
