"""``rasterscope exercise folders``: where exercises of teachers are found beside those of the program."""

import argparse
import sys

from app.usage import PROGRAM
from lessons.exercises.question import Template


def add_parser(parsers: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the action."""
    folders = parsers.add_parser("folders", help="list the folders of own exercises", allow_abbrev=False)
    change = folders.add_mutually_exclusive_group()
    change.add_argument("--add", metavar="FOLDER", help="look for exercises in this folder, too")
    change.add_argument("--remove", metavar="FOLDER", help="look no more in this folder; its files stay")


def run(options: argparse.Namespace) -> int:
    """Add or remove a folder, and list all."""
    from app.files.exercise_folders import add_folder, added_folders, own_folder, remove_folder

    if options.add is not None:
        add_folder(options.add)
    if options.remove is not None:
        remove_folder(options.remove)
    print("\n".join(map(str, (own_folder(), *added_folders()))))
    return 0


def known_templates() -> dict[str, Template]:
    """Return all exercises, of the program and of folders; what is skipped is said on stderr."""
    from app.files.exercise_folders import all_templates  # Qt takes a moment: not before it is needed.

    templates, skipped = all_templates()
    for sentence in skipped:
        print(f"{PROGRAM}: warning: skipped: {sentence}", file=sys.stderr)
    return templates
