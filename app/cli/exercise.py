"""``rasterscope exercise``: questions by seed, their check, and exercises that teachers write."""

import argparse
from pathlib import Path

import numpy as np
from pydantic import BaseModel, ConfigDict

from app.cli import attempts, exercise_folders
from app.cli.commands import whole_number
from app.cli.exercise_coverage import coverage_lines
from app.cli.exercise_folders import known_templates
from app.usage import UsageError
from lessons.exercises.answers.answer import NotCheckedError
from lessons.exercises.catalogue import TEMPLATES, template_named
from lessons.exercises.coding.tasks import TASKS
from lessons.exercises.draws import SEED_LIMIT
from lessons.exercises.exercise_file import read_exercise
from lessons.exercises.question import Question, ask, judge
from lessons.exercises.selftest import check_template
from lessons.exercises.toml_file import TomlFile
from lessons.mistakes.shelf import SHELF

DESCRIPTION = """Ask a question by its seed, check an answer, or check an exercise that a teacher wrote."""
EXAMPLES = """examples:
  rasterscope exercise list
  rasterscope exercise show triangle-coverage --seed 7
  rasterscope exercise check triangle-coverage --seed 7 answer.toml
  rasterscope exercise validate my-exercise.toml
  rasterscope exercise show my-exercise.toml
  rasterscope exercise selftest --seeds 200
  rasterscope exercise coverage
  rasterscope exercise folders --add my-exercises
  rasterscope exercise practice --user Ada
  rasterscope exercise export attempts.json --user Ada

An answer is a TOML file with one key. Pixels: answer = text art, top row first, or a list of [column, row].
Numbers: answer = "1/3", or a list of numbers. Table: a list of rows. Order and choice: a list of names.
Places: a list of [x, y]. Line: its number. Picture: {pixels = [[column, row]], option = "name"}. Steps: a list with one
entry, or a list of tries, for each. Break: a list of numbers. Cheapest: {family = "method"}.
"""
SEED = whole_number(0, SEED_LIMIT)


class AnswerFile(BaseModel):
    """A file with an answer."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    answer: object


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    parsers = parser.add_subparsers(dest="action", required=True, metavar="ACTION")
    parsers.add_parser("list", help="list the exercises", allow_abbrev=False)
    show = parsers.add_parser("show", help="print a question", allow_abbrev=False)
    check = parsers.add_parser("check", help="check an answer", allow_abbrev=False)
    for one in (show, check):
        one.add_argument("name", metavar="NAME", help="an exercise of the list, or a .toml file")
        one.add_argument("--seed", metavar="N", type=SEED, default=0, help="seed of the question (0)")
    show.add_argument("--hints", action="store_true", help="print the hints, too")
    show.add_argument(
        "--answers", action="store_true", help="print the right answer and those of the mistakes, too"
    )
    check.add_argument("answer", metavar="ANSWER.toml", help="a file with answer = ...")
    check.add_argument("--user", metavar="NAME", help="keep the attempt under this name")
    parsers.add_parser(
        "tasks", help="list what listings may have to do, with their lines", allow_abbrev=False
    )
    parsers.add_parser("mistakes", help="list the mistakes that a file may name", allow_abbrev=False)
    validate = parsers.add_parser("validate", help="check an exercise file", allow_abbrev=False)
    validate.add_argument("path", metavar="PATH", help="a .toml file")
    selftest = parsers.add_parser("selftest", help="check all exercises", allow_abbrev=False)
    selftest.add_argument("--seeds", metavar="K", type=SEED, default=10, help="seeds of each (10)")
    parsers.add_parser("coverage", help="list what the exercises ask, and what none asks", allow_abbrev=False)
    exercise_folders.add_parser(parsers)
    attempts.add_parsers(parsers)


def run(options: argparse.Namespace) -> int:
    """Do what the action asks."""
    if options.action in LISTS:
        print("\n".join(LISTS[options.action]()))
        return 0
    if options.action == "folders":
        return exercise_folders.run(options)
    if options.action in ("practice", "progress", "export", "import"):
        return attempts.run(options)
    if options.action == "selftest":
        return _selftest(options.seeds)
    if options.action == "validate":
        template = read_exercise(Path(options.path))
        question = ask(template, 0)
        print(
            f"{options.path}: valid: {template.title}; {question.draft.answer.kind}, {points_text(template.points)}"
        )
        return 0
    name = options.name
    is_known = name in TEMPLATES or name.endswith(".toml")
    question = ask(template_named(name, TEMPLATES if is_known else known_templates()), options.seed)
    if options.action == "show":
        print("\n".join(shown_question(question, options.hints)))
        if options.answers:
            print("\n".join(shown_answers(question)))
        return 0
    return _check(question, Path(options.answer), options.user)


def listed_templates() -> list[str]:
    """Return a line for each exercise."""
    return [f"{each.name:<23} {each.stage:<13}{each.title}" for each in known_templates().values()]


def listed_mistakes() -> list[str]:
    """Return a line for each mistake that a file may name."""
    return [f"{twin.name:<23} {twin.sentence}" for twin in SHELF.values()]


def listed_tasks() -> list[str]:
    """Return every task that a file may name, with the lines of its right listing, numbered."""
    lines = []
    for task in TASKS.values():
        lines += [f"{task.name}: {task.title}. {task.purpose}"]
        lines += [f"{number:>4}  {line}" for number, line in enumerate(task.text.split("\n"), 1)]
    return lines


LISTS = {
    "list": listed_templates,
    "tasks": listed_tasks,
    "mistakes": listed_mistakes,
    "coverage": coverage_lines,
}
"""Actions that only print."""


def points_text(points: int) -> str:
    """Return a number of points in words."""
    return "1 point" if points == 1 else f"{points} points"


def shown_question(question: Question, has_hints: bool) -> list[str]:
    """Return a question as lines of text."""
    template, draft = question.template, question.draft
    lines = [f"{template.title} ({question.mark})", "", draft.text]
    if draft.given:
        lines += ["", draft.given]
    if draft.answer.offered:
        lines += ["", draft.answer.offered]
    lines += ["", f"{points_text(template.points)}. {draft.answer.credit}"]
    if has_hints:
        count = len(draft.hints)
        lines += [f"Hint {number} of {count}: {hint}" for number, hint in enumerate(draft.hints, 1)]
    return lines


def shown_answers(question: Question) -> list[str]:
    """Return the right answer and those of the mistakes as lines of text."""
    draft = question.draft
    lines = ["", "Right answer:", draft.answer.text(draft.answer.reference)]
    for name, response in draft.mistakes.items():
        lines += ["", f"{name}:", draft.answer.text(response)]
    return lines


def _check(question: Question, path: Path, user: str | None) -> int:
    answer = question.draft.answer
    file = TomlFile(path)
    given = file.checked(AnswerFile).answer
    try:
        response = answer.read(given)
        judgement = judge(question, response)
    except NotCheckedError as problem:
        raise ValueError(f"not checked yet: {file.error(('answer',), str(problem))}") from None
    attempt = None if user is None else attempts.attempt_for(user, question, response, judgement)
    print(f"Understood:\n{answer.text(response)}")
    print(f"{judgement.points:.3g} of {points_text(question.template.points)}: {judgement.verdict.counts}")
    for sentence in filter(None, (*judgement.sentences, answer.first_wrong(response))):
        print(sentence)
    if attempt is not None:
        attempts.keep(attempt)
    return 0


def _selftest(count: int) -> int:
    if count < 1:
        raise UsageError("argument --seeds: must be 1 or more, got 0")
    problems = 0
    asking: list[float] = []
    naming: list[float] = []
    for template in TEMPLATES.values():
        found = check_template(template, range(count))
        asking += found.asking
        naming += found.naming
        alike = (
            "; one answer: " + ", ".join(sorted(" = ".join(pair) for pair in found.equal))
            if found.equal
            else ""
        )
        print(
            f"{found.name:<24}{found.seeds} seeds, random answers earn {found.guessed:.1%} "
            f"(stated {found.chance:.1%}), {found.digest}{alike}"
        )
        for problem in found.problems:
            print(f"  {problem}")
        problems += len(found.problems)
    for said, times in (("a question and its check", asking), ("a mistake named", naming)):
        print(
            f"{said}: {1000 * np.percentile(times, 95):.3g} ms at the 95th percentile, {1000 * max(times):.3g} at most "
            "(processor time)"
        )
    return 1 if problems else 0
