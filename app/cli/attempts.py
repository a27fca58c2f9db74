"""What ``rasterscope exercise`` does with attempts: practice, progress, files to exchange."""

import argparse
import sys
from datetime import UTC, datetime
from itertools import groupby
from operator import attrgetter

from pydantic import ValidationError

from app.cli.exercise_folders import known_templates
from app.files.attempts import SIZE_LIMIT, attempt_file
from app.files.file_writing import write_file
from app.files.input_files import read_input
from app.usage import PROGRAM, UsageError
from lessons.attempts.practice import Progress, next_question, progress
from lessons.attempts.record import DEFAULT_USER, attempt_of, exported_attempts, read_attempts_json
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
    taken = parsers.add_parser("import", help="add the attempts of a JSON file", allow_abbrev=False)
    taken.add_argument("path", metavar="ATTEMPTS.json", help="a file that export has written")


def run(options: argparse.Namespace) -> int:
    """Do what the action asks."""
    file = attempt_file()
    if options.action == "practice":
        choice = next_question(
            file.attempts(options.user), known_templates(), options.user, datetime.now(UTC)
        )
        assert choice is not None
        template, seed = choice.question.template, choice.question.seed
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
    attempts = tuple(read_attempts_json(read_input(options.path, SIZE_LIMIT), options.path))
    added = file.add_all(attempts)
    print(f"{options.path}: {counted(added)} added, {len(attempts) - added} known before")
    return 0


def progress_lines(reached: Progress) -> list[str]:
    """Return a table: the templates with their best points, then mistakes by stage."""
    lines = [f"{reached.points:.3g} points"]
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


def keep(user: str, question: Question, response: Response, judgement: Judgement) -> None:
    """Save the attempt of a user; UsageError for what is no name."""
    try:
        attempt = attempt_of(user, question, response, judgement, 0, datetime.now(UTC))
    except ValidationError as problem:
        raise UsageError(f"argument --user: {problem.errors()[0]['msg']}") from None
    told = attempt_file().add(attempt)
    if told:
        print(f"{PROGRAM}: warning: {told}", file=sys.stderr)


def counted(count: int) -> str:
    """Return a number of attempts in words."""
    return "1 attempt" if count == 1 else f"{count} attempts"
