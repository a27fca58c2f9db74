"""``rasterscope screenshot``: the window in a file, without showing it."""

import argparse
import os
import sys

from app.cli import arguments
from app.cli.commands import MOST_ROUNDS, load_qt, whole_number
from app.files.file_access import VIEW_ENDINGS, check_writable
from app.usage import UsageError
from core import STAGES

DESCRIPTION = """Save a picture of the window with FILE open, without showing the window."""
EXAMPLES = """examples:
  rasterscope screenshot shared-edge -o edge.png
  rasterscope screenshot teapot.obj -o teapot.png --theme dark --size 1600x1000
  rasterscope screenshot cube -o slide.png --theme presenter --size 1920x1080
  rasterscope screenshot near-plane -o clip.svg --stage clip --step 4
  rasterscope screenshot cube -o samples.png --stage resolve --set antialiasing=msaa-4
  rasterscope screenshot cube -o lines.png --page compare --show line --work pixel-ends --choose line=dda
  rasterscope screenshot cube -o cracks.png --page stability --show shared-edges --choose fill_rule=exclusive
  rasterscope screenshot teapot.obj -o plan.png --page plan
  rasterscope screenshot cube -o asked.png --page exercises --show triangle-coverage --choose corner-for-center
  rasterscope screenshot study-line-any-ends.json -o study.png

The other pages first measure or run their content, in fewer rounds than in the window. A saved study or atlas is shown
unchanged.
"""
PAGES = ("start", "step", "compare", "stability", "plan", "exercises")
ONLY_OF = {
    "stage": ("step",),
    "step": ("step",),
    "view": ("step",),
    "show": ("step", "compare", "stability", "exercises"),
    "work": ("compare",),
    "rounds": ("compare",),
    "grow": ("compare",),
    "choose": ("compare", "stability", "exercises"),
}
"""Options that are of some pages only."""
SMALLEST = (800, 500)
"""Least size of the window in pixels."""


def window_size_from_text(text: str) -> tuple[int, int]:
    """Return a size that the window can have."""
    size = arguments.size_from_text(text)
    if size[0] < SMALLEST[0] or size[1] < SMALLEST[1]:
        raise argparse.ArgumentTypeError(f"must be at least {SMALLEST[0]}x{SMALLEST[1]}, got {text}")
    return size


def add_window_look(parser: argparse.ArgumentParser) -> None:
    """Let a command that draws the window take its size and theme."""
    parser.add_argument(
        "--size",
        metavar="WxH",
        type=window_size_from_text,
        default=(1280, 800),
        help="of the window (1280x800)",
    )
    parser.add_argument(
        "--theme",
        choices=("light", "dark", "presenter", "presenter-dark"),
        default="light",
        help="theme of the window (light); those of the presenter fill it with the picture and the step",
    )


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    arguments.add_file(parser)
    parser.add_argument("-o", "--output", metavar="out.png", required=True, help="PNG, SVG or PDF file")
    add_window_look(parser)
    parser.add_argument("--stage", choices=STAGES, metavar="NAME", help=f"stage to show: {', '.join(STAGES)}")
    parser.add_argument(
        "--step",
        metavar="N",
        type=whole_number(0),
        help="number of operations done in the stage; default: all, or without --stage as the scene opens",
    )
    parser.add_argument(
        "--view",
        metavar="NAME",
        help="main view of the Step page: pixels, scene, clip, pyramid, texture, flow or compare",
    )
    parser.add_argument("--page", choices=PAGES, help="page to show (step)")
    parser.add_argument(
        "--show",
        metavar="NAME",
        help="family (page compare) or experiment (page stability) to run, exercise to ask, or main view as --view",
    )
    parser.add_argument("--work", metavar="NAME", help="kind of work of the family")
    parser.add_argument(
        "--rounds",
        metavar="N",
        type=whole_number(1, MOST_ROUNDS),
        help="timed runs of every method, fewer of slow ones (3)",
    )
    parser.add_argument(
        "--grow",
        action="store_true",
        default=None,
        help="also measure how the cost of the whole pipeline grows with the picture (minutes)",
    )
    parser.add_argument(
        "--choose",
        metavar="METHOD",
        help="open the pictures of a method, or the first cell where it fails; or check a mistake's answer",
    )
    arguments.add_settings(parser)
    arguments.add_edits(parser)


def check_page(options: argparse.Namespace) -> None:
    """Refuse, with a sentence, options that the page does not have, and any page for what has its own."""
    page = options.page or "step"
    is_saved = options.file.lower().endswith(".json")
    for name, pages in ONLY_OF.items():
        if getattr(options, name) is not None and (page not in pages or is_saved):
            where = "a saved study or atlas" if is_saved else f"page {page}"
            raise UsageError(f"argument --{name}: it is for page {' or '.join(pages)}, got {where}")
    if is_saved and (options.page is not None or options.set or options.edit):
        raise UsageError(
            f"--page, --set and --edit are for scenes; a saved study or atlas has its own, got {options.file}"
        )


def run(options: argparse.Namespace) -> int:
    """Draw the window and write it."""
    if not options.output.lower().endswith(VIEW_ENDINGS):
        raise UsageError(
            f"argument -o: the file must end with {', '.join(VIEW_ENDINGS)}, got {options.output}"
        )
    if sys.platform.startswith("linux"):
        os.environ["QT_QPA_PLATFORM"] = "offscreen"
    check_page(options)
    check_writable(options.output)
    load_qt()
    from app.window.start import grab_window

    content, view = None, options.view
    if options.page in (None, "step"):
        view = view or options.show
    else:
        from app.window.unattended import PageContent  # All pages come along: not for the Step page alone.

        content = PageContent(
            options.page,
            options.show or "",
            options.work or "",
            options.choose or "",
            options.rounds,
            bool(options.grow),
        )
    with arguments.outside_hinted():
        grab_window(
            options.file,
            options.output,
            options.size,
            options.theme,
            options.stage,
            options.step,
            view,
            lambda settings: arguments.chosen_settings(settings, options.set, options.edit),
            content,
            options.allow_outside,
        )
    return 0
