"""What ``rasterscope exercise`` does with attempts: practice, progress, files to exchange."""

import argparse
import sys
from datetime import UTC, datetime
from itertools import groupby
from operator import attrgetter

from pydantic import ValidationError

from app.cli.arguments import progress_line
from app.cli.exercise_folders import known_templates
from app.files.attempts import SIZE_LIMIT, attempt_file
from app.files.file_writing import write_file
from app.files.input_files import read_input
from app.usage import PROGRAM, UsageError
from lessons.attempts.imports import judged_again
from lessons.attempts.practice import MISSES_IN_A_ROW, Progress, next_question, progress
from lessons.attempts.record import DEFAULT_USER, Attempt, attempt_of, exported_attempts, read_attempts_json
from lessons.exercises.answers.answer import Response
from lessons.exercises.question import Judgement, Question


def add_parsers(parsers: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
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


def run(options: argparse.Namespace) -> int:
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
    given = read_attempts_json(read_input(options.path, SIZE_LIMIT), options.path)
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


def keep(attempt: Attempt) -> None:
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
