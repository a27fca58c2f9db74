"""``rasterscope exercise folders``: where exercises of teachers are found beside those of the program."""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from app.usage import PROGRAM
from lessons.exercises.question import Template

if TYPE_CHECKING:
    from app.files.folder_list import FolderList  # With Qt, see below.


def add_parser(
    parsers: "argparse._SubParsersAction[argparse.ArgumentParser]", what: str = "exercises"
) -> None:
    """Add the action for folders of own exercises, or of ``what`` else."""
    folders = parsers.add_parser("folders", help=f"list the folders of own {what}", allow_abbrev=False)
    change = folders.add_mutually_exclusive_group()
    change.add_argument("--add", metavar="FOLDER", help=f"look for {what} in this folder, too")
    change.add_argument("--remove", metavar="FOLDER", help="look no more in this folder; its files stay")


def change_folders(options: argparse.Namespace, folders: "FolderList", own: Path) -> int:
    """Add or remove a folder, and list all."""
    if options.add is not None:
        folders.add(options.add)
    if options.remove is not None:
        folders.remove(options.remove)
    print("\n".join(map(str, (own, *folders.added()))))
    return 0


def run(options: argparse.Namespace) -> int:
    """Add or remove a folder, and list all."""
    from app.files.exercise_folders import FOLDERS, own_folder

    return change_folders(options, FOLDERS, own_folder())


def known_templates() -> dict[str, Template]:
    """Return all exercises, of the program and of folders; what is skipped is said on stderr."""
    from app.files.exercise_folders import all_templates  # Qt takes a moment: not before it is needed.

    templates, skipped = all_templates()
    for sentence in skipped:
        print(f"{PROGRAM}: warning: skipped: {sentence}", file=sys.stderr)
    return templates
