"""``rasterscope screenshot``: the window in a file, without showing it."""

import argparse
import os
import sys

from app.cli import UsageError
from app.cli_arguments import add_file, add_settings, chosen_settings, size_from_text
from app.cli_window import load_qt
from core import STAGES

DESCRIPTION = """Save a picture of the window, as it shows FILE, without showing it."""
EXAMPLES = """examples:
  rasterscope screenshot shared-edge -o edge.png
  rasterscope screenshot teapot.obj -o teapot.png --theme dark --size 1600x1000
  rasterscope screenshot near-plane -o clip.svg --stage clip --step 4
  rasterscope screenshot cube -o samples.png --stage resolve --set antialiasing=msaa-4
"""
ENDINGS = (".png", ".svg", ".pdf")
SMALLEST = (900, 600)
"""Least size of the window in pixels."""


def step_from_text(text: str) -> int:
    """Return a position in a stage."""
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"must be a whole number from 0, got {text}")
    return int(text)


def window_size_from_text(text: str) -> tuple[int, int]:
    """Return a size that the window can have."""
    size = size_from_text(text)
    if size[0] < SMALLEST[0] or size[1] < SMALLEST[1]:
        raise argparse.ArgumentTypeError(f"must be at least {SMALLEST[0]}x{SMALLEST[1]}, got {text}")
    return size


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    add_file(parser)
    parser.add_argument("-o", "--output", metavar="out.png", required=True, help="PNG, SVG or PDF file")
    parser.add_argument(
        "--size",
        metavar="WxH",
        type=window_size_from_text,
        default=(1280, 800),
        help="of the window (1280x800)",
    )
    parser.add_argument(
        "--theme", choices=("light", "dark"), default="light", help="look of the window (light)"
    )
    parser.add_argument(
        "--stage", choices=STAGES, metavar="NAME", help=f"stage that is shown: {', '.join(STAGES)}"
    )
    parser.add_argument(
        "--step", metavar="N", type=step_from_text, help="operations of the stage that are done; default: all"
    )
    parser.add_argument("--view", metavar="NAME", help="main view, as pixels or compare")
    add_settings(parser)


def run(options: argparse.Namespace) -> int:
    """Draw the window and write it."""
    if not options.output.lower().endswith(ENDINGS):
        raise UsageError(f"argument -o: the file must end with {', '.join(ENDINGS)}, got {options.output}")
    if sys.platform.startswith("linux"):
        os.environ["QT_QPA_PLATFORM"] = "offscreen"
    load_qt()
    from app.window_start import grab_window

    grab_window(
        options.file,
        options.output,
        options.size,
        options.theme,
        options.stage,
        options.step,
        options.view,
        lambda settings: chosen_settings(settings, options.set),
    )
    return 0
