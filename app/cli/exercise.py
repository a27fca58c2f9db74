"""``rasterscope exercise``: questions by seed, their check, exercises that teachers write, and attempts."""

import argparse
import sys
from datetime import UTC, datetime
from itertools import groupby
from operator import attrgetter
from pathlib import Path

import numpy as np
from pydantic import BaseModel, ConfigDict, ValidationError

from app.cli.arguments import add_folders_parser, known_templates, progress_line, run_exercise_folders
from app.cli.commands import whole_number
from app.files.file_access import read_input, write_file
from app.files.user_folders import MOST_ATTEMPT_BYTES, attempt_file
from app.usage import PROGRAM, UsageError
from lessons.attempts.imports import judged_again
from lessons.attempts.practice import MISSES_IN_A_ROW, Progress, next_question, progress
from lessons.attempts.record import DEFAULT_USER, Attempt, attempt_of, exported_attempts, read_attempts_json
from lessons.exercises.answers.answer import NotCheckedError, Response
from lessons.exercises.asked import LECTURES, Topic, check_template, kinds_by_stage, mistake_topics, topics
from lessons.exercises.catalogue import TEMPLATES, template_named
from lessons.exercises.coding.tasks import TASKS
from lessons.exercises.exercise_file import read_exercise
from lessons.exercises.numbers import SEED_LIMIT
from lessons.exercises.question import Judgement, Question, ask, judge
from lessons.exercises.toml_file import TomlFile
from lessons.mistakes.shelf import SHELF

# ``rasterscope exercise coverage``: what the templates ask, and what none asks, with the reason.


WIDTH = 66
"""Characters of the names of topics."""


def coverage_lines() -> list[str]:
    """Return the tables as lines of text; one question of every template is drawn."""
    questions = {name: ask(template, 0) for name, template in TEMPLATES.items()}
    by_stage = kinds_by_stage(questions)
    kinds = sorted({kind for counts in by_stage.values() for kind in counts})
    lines = ["".join(["stage".ljust(13), *(kind.rjust(len(kind) + 2) for kind in kinds), "  templates"])]
    for stage, counts in by_stage.items():
        cells = (str(counts[kind] or ".").rjust(len(kind) + 2) for kind in kinds)
        lines.append("".join([stage.ljust(13), *cells, str(counts.total()).rjust(11)]))
    sections = {
        "families of methods": topics()["families"],
        "experiments of the atlas": topics()["experiments"],
        "mistakes": mistake_topics(questions),
        **{f"questions of {lecture}": topics()[lecture] for lecture in LECTURES},
    }
    for title, rows in sections.items():
        asked = sum(bool(row.templates) for row in rows)
        lines += ["", f"{title}: {asked} of {len(rows)} asked", *map(topic_line, rows)]
    return lines


def topic_line(topic: Topic) -> str:
    """Return a topic with its templates, or the reason why it has none."""
    said = ", ".join(topic.templates) if topic.templates else f"- {topic.reason}"
    return f"  {topic.name:<{WIDTH}} {said}"


# What ``rasterscope exercise`` does with attempts: practice, progress, files to exchange.


def add_attempt_parsers(parsers: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the actions."""
    for name, summary in (
        ("practice", "choose the next question for a user"),
        ("progress", "show what a user has reached, and the mistakes"),
    ):
        one = parsers.add_parser(name, help=summary, allow_abbrev=False)
        one.add_argument(
            "--user", metavar="NAME", default=DEFAULT_USER, help=f"whose attempts ({DEFAULT_USER})"
        )
    export = parsers.add_parser(
        "export", help="write attempts into a JSON file, or a CSV table", allow_abbrev=False
    )
    export.add_argument(
        "path", metavar="ATTEMPTS", help="the file to write: .json, or .csv for a spreadsheet"
    )
    export.add_argument("--user", metavar="NAME", help="only the attempts of this user")
    taken = parsers.add_parser(
        "import", help="judge the attempts of a JSON file again, and add them", allow_abbrev=False
    )
    taken.add_argument("path", metavar="ATTEMPTS.json", help="a file that export has written")


def run_attempts(options: argparse.Namespace) -> int:
    """Do what the action asks."""
    file = attempt_file()
    if left_out := file.left_out():
        print(f"{PROGRAM}: warning: {left_out}", file=sys.stderr)
    if options.action == "practice":
        choice = next_question(
            file.attempts(options.user), known_templates(), options.user, datetime.now().astimezone()
        )
        assert choice is not None
        template, seed = choice.question.template, choice.question.seed
        if (missed := choice.explained) is not None:
            print(
                f"{missed.template} was missed {MISSES_IN_A_ROW} times in a row. What is right there:\n\n"
                f"  rasterscope exercise show {missed.template} --seed {missed.seed} --hints --answers\n"
            )
        print(f"{choice.reason}\n\n  rasterscope exercise show {template.name} --seed {seed}")
        return 0
    if options.action == "progress":
        print("\n".join(progress_lines(progress(file.attempts(options.user)))))
        return 0
    if options.action == "export":
        attempts = file.attempts(options.user)
        write_file(options.path, exported_attempts(attempts, options.path))
        print(f"{options.path}: {counted(len(attempts))}")
        return 0
    given = read_attempts_json(read_input(options.path, MOST_ATTEMPT_BYTES), options.path)
    with progress_line() as report:
        imported = judged_again(given, known_templates(), datetime.now(UTC), report)
    added = file.add_all(imported.attempts)
    print(f"{options.path}: {counted(added)} added, {len(given) - added} known before")
    print("\n".join(imported.sentences))
    return 0


def progress_lines(reached: Progress) -> list[str]:
    """Return a table: the templates with their best points, then mistakes by stage."""
    lines = [reached.points_text]
    for name, points in reached.best.items():
        lines.append(
            f"  {name:<32}{points:.3g} points, {reached.correct[name]} of {reached.tried[name]} right"
        )
    if reached.mistakes:
        lines.append("mistakes, and the answers in which each could show")
    for stage, counts in groupby(sorted(reached.mistakes, key=attrgetter("stage")), attrgetter("stage")):
        lines.append(f"  {stage}")
        lines += [f"    {count.mistake:<30}{count.made} of {count.asked}" for count in counts]
    return lines


def attempt_for(user: str, question: Question, response: Response, judgement: Judgement) -> Attempt:
    """Return the attempt of a user; UsageError for what is no name."""
    try:
        return attempt_of(user, question, response, judgement, 0, datetime.now(UTC))
    except ValidationError as problem:
        raise UsageError(f"argument --user: {problem.errors()[0]['msg']}") from None


def keep_attempt(attempt: Attempt) -> None:
    """Save an attempt whose verdict is on the screen; OSError where it is not saved."""
    try:
        told = attempt_file().add(attempt)
    except OSError as problem:
        raise OSError(f"the attempt is not kept: {problem}") from problem
    if told:
        print(f"{PROGRAM}: warning: {told}", file=sys.stderr)


def counted(count: int) -> str:
    """Return a number of attempts in words."""
    return "1 attempt" if count == 1 else f"{count} attempts"


# ``rasterscope exercise``: questions by seed, their check, and exercises that teachers write.


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
    add_folders_parser(parsers)
    add_attempt_parsers(parsers)


def run(options: argparse.Namespace) -> int:
    """Do what the action asks."""
    if options.action in LISTS:
        print("\n".join(LISTS[options.action]()))
        return 0
    if options.action == "folders":
        return run_exercise_folders(options)
    if options.action in ("practice", "progress", "export", "import"):
        return run_attempts(options)
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
    attempt = None if user is None else attempt_for(user, question, response, judgement)
    print(f"Understood:\n{answer.text(response)}")
    print(f"{judgement.points:.3g} of {points_text(question.template.points)}: {judgement.verdict.counts}")
    for sentence in filter(None, (*judgement.sentences, answer.first_wrong(response))):
        print(sentence)
    if attempt is not None:
        keep_attempt(attempt)
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
