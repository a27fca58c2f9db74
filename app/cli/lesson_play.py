"""``rasterscope lesson play``: lessons walked without showing the window, with a picture of each step."""

import argparse
import os
import sys
from pathlib import Path

from app.cli.screenshot import add_window_look
from app.cli.window import load_qt
from app.files.file_writing import make_folder
from lessons.course.lesson_file import Lesson


def add_parser(parsers: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
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


def run(options: argparse.Namespace, lessons: list[Lesson]) -> int:
    """Play the lessons; ValueError where a step is not done by its right answer or recorded solution."""
    if sys.platform.startswith("linux"):
        os.environ["QT_QPA_PLATFORM"] = "offscreen"
    load_qt()
    from app.export.views import export_widget
    from app.window.lesson_play import hidden_window, play

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
