"""What several commands take: FILE, sizes and settings, and folders that users add."""

import argparse
import re
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from app.cli.commands import add_allow_outside
from app.files.file_access import read_input
from app.files.mesh_formats.reading import OutsideMeshError, Report
from app.files.open_any import Opened, open_any
from app.files.state_scenes import OutsideSourceError
from app.usage import PROGRAM, UsageError
from core import Settings
from core.edits.edit import Edit, apply_edit
from core.edits.editable import EDITABLE
from core.lanes.problem import LISTING, Problem
from core.scene import SIZE_LIMIT, AnyScene
from core.setting_texts import settings_from_texts

if TYPE_CHECKING:
    from app.files.user_folders import FolderList
    from lessons.exercises.question import Template


# What several commands take: FILE, sizes and settings.


FILE_HELP = "a mesh file, a state file, or the name of a built-in scene"
OUTSIDE_HINT = "--allow-outside reads it"


def size_from_text(text: str) -> tuple[int, int]:
    """Return width and height of a text such as ``640x480``."""
    found = re.fullmatch(r"(\d{1,9})[x×](\d{1,9})", text)
    if not found:
        raise argparse.ArgumentTypeError(f"must be WIDTHxHEIGHT such as 640x480, got {text}")
    width, height = int(found[1]), int(found[2])
    if not (1 <= width <= SIZE_LIMIT and 1 <= height <= SIZE_LIMIT):
        raise argparse.ArgumentTypeError(f"must be 1 to {SIZE_LIMIT} pixels each way, got {text}")
    return width, height


def setting_from_text(text: str) -> tuple[str, str]:
    """Return family and method of a text such as ``fill=blocks``."""
    family, sign, name = text.partition("=")
    if not (family and sign and name):
        raise argparse.ArgumentTypeError(f"must be family=method such as fill=blocks, got {text}")
    return family, name


def add_file(parser: argparse.ArgumentParser) -> None:
    """Let the command take FILE."""
    parser.add_argument("file", metavar="FILE", help=FILE_HELP)
    add_allow_outside(parser)


def add_size(parser: argparse.ArgumentParser, what: str = "pixels of the picture") -> None:
    """Let the command take ``--size``, of `sized`."""
    parser.add_argument(
        "--size", metavar="WxH", type=size_from_text, help=f"{what}; default: those of the scene"
    )


def sized(scene: AnyScene, options: argparse.Namespace) -> AnyScene:
    """Return the scene at the size that is asked for."""
    return scene if options.size is None else replace(scene, size=options.size)


LISTING_BYTES = 4 * LISTING.characters + 4
"""Largest file of a listing: as many characters as it may have, each of up to four bytes, and a mark before them."""
SETTINGS_HELP = (
    "choose methods (rasterscope methods lists them), block_size=N, correction_interval=N or samples_across=N; "
    "the others are those of the state file, or the defaults"
)


def add_settings(parser: argparse.ArgumentParser, what: str = SETTINGS_HELP) -> None:
    """Let the command take ``--set``; ``what`` says what is set."""
    parser.add_argument(
        *("--set", "-s"),
        metavar="family=method",
        type=setting_from_text,
        nargs="+",
        action="extend",
        default=[],
        help=what,
    )


def chosen_settings(
    settings: Settings, chosen: Sequence[tuple[str, str]], edits: Sequence[tuple[str, str]] = ()
) -> Settings:
    """Return ``settings`` with some chosen and listings edited on the command line.

    Raises UsageError for a setting that there is not, ValueError for a text that cannot run.
    """
    try:
        found = settings_from_texts(dict(chosen), settings)
    except ValueError as problem:
        raise UsageError(f"argument --set: {problem}") from problem
    for part, path in edits:
        try:
            of = str(getattr(found, EDITABLE[part].family)) if part in EDITABLE else ""
            edit = Edit(part, of, read_listing(path))
        except ValueError as problem:
            reason = str(problem)
            raise UsageError(f"argument --edit: {reason[0].lower()}{reason[1:].rstrip('.')}") from problem
        try:
            found = apply_edit(found, edit)
        except Problem as problem:
            raise ValueError(f"{path}: {problem}") from problem
    return found


def read_listing(path: str) -> str:
    """Return the text of a listing; OSError if it cannot be read, ValueError if it is no text."""
    try:
        return read_input(path, LISTING_BYTES).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise ValueError(f"{path} is no text in UTF-8") from None


def edit_from_text(text: str) -> tuple[str, str]:
    """Return what is edited, and the path of the listing, of a text such as ``line=mine.py``."""
    part, sign, path = text.partition("=")
    if not (part and sign and path):
        raise argparse.ArgumentTypeError(f"must be PART=FILE such as line=mine.py, got {text}")
    return part, path


def add_edits(parser: argparse.ArgumentParser) -> None:
    """Let the command take ``--edit``, of `chosen_settings`."""
    parser.add_argument(
        "--edit",
        metavar="PART=FILE",
        type=edit_from_text,
        nargs="+",
        action="extend",
        default=[],
        help=f"run the listing in FILE instead of the chosen method's own; PART is one of {', '.join(EDITABLE)}",
    )


def open_file(options: argparse.Namespace) -> Opened:
    """Open FILE; warnings go to stderr, and progress too if it is a terminal."""
    with outside_hinted(), progress_line() as progress:
        opened = open_any(options.file, progress, allows_outside=options.allow_outside)
    for warning in opened.warnings:
        hint = f"; {OUTSIDE_HINT}" if warning in opened.left_outside else ""
        print(f"{PROGRAM}: warning: {warning}{hint}", file=sys.stderr)
    return opened


@contextmanager
def outside_hinted() -> Iterator[None]:
    """Add the option that helps where a file names one outside its folder."""
    try:
        yield
    except (OutsideMeshError, OutsideSourceError) as problem:
        raise ValueError(f"{problem}; {OUTSIDE_HINT}") from problem


@contextmanager
def overflow_reported() -> Iterator[None]:
    """Tell in one line, at the end, if numbers got too large in the block; nothing stops for that."""
    problems: set[str] = set()

    def note(problem: str, flag: int) -> None:
        problems.add(problem)

    with np.errstate(over="call", invalid="call", divide="call", call=note):
        yield
    if problems:
        print(
            f"{PROGRAM}: warning: some numbers are too large or too small to compute with "
            f"({', '.join(sorted(problems))}); what depends on them is undefined",
            file=sys.stderr,
        )


@contextmanager
def progress_line() -> Iterator[Report | None]:
    """Give what shows progress where stderr is a terminal, else ``None``; its line is gone at the end."""
    shows_progress = sys.stderr is not None and sys.stderr.isatty()
    yield show_progress if shows_progress else None
    if shows_progress:
        print("\r\x1b[K", end="", file=sys.stderr, flush=True)


def show_progress(fraction: float | None, doing: str) -> None:
    """Write how far the work is over the line before."""
    done = "" if fraction is None else f" {100 * fraction:.0f} %"
    print(f"\r\x1b[K{doing}{done}", end="", file=sys.stderr, flush=True)


# ``rasterscope exercise folders``: where exercises of teachers are found beside those of the program.


def add_folders_parser(
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


def run_exercise_folders(options: argparse.Namespace) -> int:
    """Add or remove a folder, and list all."""
    from app.files.user_folders import EXERCISE_FOLDERS, own_exercise_folder

    return change_folders(options, EXERCISE_FOLDERS, own_exercise_folder())


def known_templates() -> dict[str, "Template"]:
    """Return all exercises, of the program and of folders; what is skipped is said on stderr."""
    from app.files.user_folders import all_templates  # All exercises come along.

    templates, skipped = all_templates()
    for sentence in skipped:
        print(f"{PROGRAM}: warning: skipped: {sentence}", file=sys.stderr)
    return templates
