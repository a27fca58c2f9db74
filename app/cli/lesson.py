"""``rasterscope lesson``: the lessons of the course as text, checked, played, and which slides they show."""

import argparse
import os
import sys
from collections.abc import Iterator, Sequence
from itertools import chain
from pathlib import Path
from textwrap import indent

from app.cli.arguments import add_folders_parser, change_folders
from app.cli.commands import load_qt
from app.cli.screenshot import add_window_look
from app.files.file_access import make_folder
from app.usage import PROGRAM
from core.stages.declared import stage_of
from lessons.attempts.record import Attempt, Standing, standings
from lessons.course.catalogue import Course, Lesson, chapters, coverage, read_lesson, slides
from lessons.course.state import States
from lessons.course.tasks import question_of
from lessons.course.validation import validate

# ``rasterscope lesson play``: lessons walked without showing the window, with a picture of each step.


def add_play_parser(parsers: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Say what the action takes."""
    parser = parsers.add_parser(
        "play", help="walk lessons by their keys, with a picture of each step", allow_abbrev=False
    )
    parser.add_argument("names", metavar="NAME", nargs="+", help="lessons of the list, or .toml files")
    parser.add_argument(
        "-o", "--output", metavar="DIR", help="folder of the pictures; left out: none are made"
    )
    add_window_look(parser)
    parser.add_argument("--wrong", action="store_true", help="give the wrong answers, too")


def play_lessons(options: argparse.Namespace, lessons: list[Lesson]) -> int:
    """Play the lessons; ValueError where a step is not done by its right answer or recorded solution."""
    if sys.platform.startswith("linux"):
        os.environ["QT_QPA_PLATFORM"] = "offscreen"
    load_qt()
    from app.export.views import export_widget
    from app.window.unattended import hidden_window, play

    if options.output is not None:
        make_folder(Path(options.output))
    with hidden_window(options.size, options.theme) as window:
        for lesson in lessons:

            def picture(step: str, name: str = lesson.name) -> None:
                if options.output is not None:
                    export_widget(window, str(Path(options.output) / f"{name}-{step}.png"))

            play(window, lesson, picture, tries_wrong=options.wrong)
            print(f"{lesson.name}: {len(lesson.steps)} steps played")
    return 0


# ``rasterscope lesson``: the lessons of the course as text, checked, and which slides of the lectures they
# cover.


DESCRIPTION = (
    """List the lessons, print one, check a lesson that a lecturer wrote, or say which slides they cover."""
)
EXAMPLES = """examples:
  rasterscope lesson list
  rasterscope lesson list --by-stage
  rasterscope lesson show shared-edges
  rasterscope lesson validate my-lesson.toml
  rasterscope lesson play shared-edges -o pictures --theme dark
  rasterscope lesson coverage
  rasterscope lesson folders --add my-lessons
"""
WIDTH = 72
"""Characters of the names of slides."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    parsers = parser.add_subparsers(dest="action", required=True, metavar="ACTION")
    listed = parsers.add_parser("list", help="list the lessons", allow_abbrev=False)
    listed.add_argument("--by-stage", action="store_true", help="in the order of the stages")
    listed.add_argument(
        "--user", metavar="NAME", help="whose steps are counted as done (who answers in the window)"
    )
    show = parsers.add_parser("show", help="print a lesson with answers and notes", allow_abbrev=False)
    show.add_argument("name", metavar="NAME", help="a lesson of the list, or a .toml file")
    check = parsers.add_parser("validate", help="check lesson files", allow_abbrev=False)
    check.add_argument("paths", metavar="PATH", nargs="+", help="a .toml file")
    add_folders_parser(parsers, "lessons")
    add_play_parser(parsers)
    parsers.add_parser(
        "coverage", help="list every slide with its lessons, or why none has it", allow_abbrev=False
    )


def run(options: argparse.Namespace) -> int:
    """Do what the action asks."""
    if options.action == "folders":
        from app.files.user_folders import LESSON_FOLDERS, own_lesson_folder

        return change_folders(options, LESSON_FOLDERS, own_lesson_folder())
    course = known_course(tells=options.action != "validate")
    if options.action == "list":
        print("\n".join(list_lines(course, options.by_stage, kept_attempts(options.user))))
    elif options.action == "show":
        print("\n".join(lesson_lines(lesson_named(course, options.name))))
    elif options.action == "play":
        return play_lessons(options, [lesson_named(course, name) for name in options.names])
    elif options.action == "validate":
        for path in options.paths:
            lesson = read_lesson(Path(path))
            validate(lesson, {*course.lessons, *chain(*chapters().values()), lesson.name})
            print(f"{path}: {lesson.title}, {len(lesson.steps)} steps: all that it says holds")
    else:
        print("\n".join(coverage_lines(course)))
    return 0


def known_course(*, tells: bool = True) -> Course:
    """Return all lessons, of the program and of folders; ``tells``: what is skipped is said on stderr."""
    from app.files.user_folders import whole_course

    course = whole_course()
    for sentence in course.problems if tells else ():
        print(f"{PROGRAM}: warning: skipped: {sentence}", file=sys.stderr)
    return course


def lesson_named(course: Course, name: str) -> Lesson:
    """Return a lesson by its name, or that of a file by its path; ValueError where there is none."""
    return read_lesson(Path(name)) if name.endswith(".toml") else course.named(name)


def kept_attempts(user: str | None) -> Sequence[Attempt]:
    """Return the attempts of a user, or of who answers in the window; OSError where they cannot be read."""
    from app.files.kept_work import learner
    from app.files.user_folders import attempt_file

    return attempt_file().attempts(user or learner())


def list_lines(course: Course, by_stage: bool, attempts: Sequence[Attempt]) -> Iterator[str]:
    """Yield the lessons, part by part, with the steps that are done in these attempts."""
    if by_stage:
        parts = {stage_of(stage).short_title: [*lessons] for stage, lessons in course.by_stage.items()}
    else:
        parts = {
            title: [course.lessons[name] for name in names if name in course.lessons]
            for title, names in chapters().items()
        }
        listed = {lesson.name for lessons in parts.values() for lesson in lessons}
        parts["Other lessons"] = [lesson for name, lesson in course.lessons.items() if name not in listed]
    for title, lessons in parts.items():
        if lessons:
            yield title
        for lesson in lessons:
            steps = standings(attempts, lesson)
            done = f"{steps.count(Standing.DONE)} of {len(steps)}"
            yield f"  {lesson.name:<22} {lesson.minutes:>2} min  {done}  {lesson.title}: {lesson.question}"


def lesson_lines(lesson: Lesson) -> Iterator[str]:
    """Yield a lesson step by step; ValueError where a question cannot be drawn."""
    part, states = lesson.part, States(lesson)
    yield f"{lesson.title} ({lesson.minutes} minutes)"
    yield lesson.question
    for title, said in (
        ("Before", ", ".join(part.needs)),
        ("Asked first", part.recall or ""),
        ("Closes with", ", ".join(part.exercises)),
        ("One can now answer", part.answers or ""),
        ("Then", f"{part.next.lesson}: {part.next.text}" if part.next else ""),
    ):
        if said:
            yield f"{title}: {said}"
    for number, step in enumerate(lesson.steps):
        yield from ("", f"{number + 1}. {step.kind}", indent(step.text, "   "))
        if step.task:
            yield f"   {step.task}"
        yield f"   [{state_text(states, number)}]"
        if step.answer is not None:
            answer = question_of(lesson, number, states).draft.answer
            yield f"   Right: {answer.text(answer.reference)}"
        for wrong in step.wrong:
            yield f"   {wrong.given}: {wrong.says}"
        if step.show:
            yield f"   Opens: {step.show}"
        if step.after:
            yield f"   Then: {' '.join(step.after.split())}"
    if part.notes:
        yield from ("", "Notes", part.notes)


def state_text(states: States, number: int) -> str:
    """Return in a line what is open at a step."""
    state = states.of_step(number)
    columns, rows = state.scene.size
    said = [f"{state.title}, {columns} x {rows}", state.stage, f"at {state.place.at}"]
    if state.pixel:
        said.append(f"pixel {state.pixel}")
    if state.other is not None or state.printed:
        said.append(f"A | B {state.printed}".strip())
    return ", ".join(said)


def coverage_lines(course: Course) -> Iterator[str]:
    """Yield every slide, with its lessons or a reason."""
    covered = coverage(course.lessons.values())
    found = sum(bool(covered[slide.name]) for slide in slides())
    reasons = sum(bool(slide.reason) and not covered[slide.name] for slide in slides())
    yield f"{len(slides())} slides: {found} in lessons, {reasons} with a reason, {len(slides()) - found - reasons} open"
    for slide in slides():
        where = ", ".join(covered[slide.name])
        yield f"  {slide.name:<{WIDTH}} {where or (f'- {slide.reason}' if slide.reason else 'open')}"
