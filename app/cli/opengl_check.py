"""``rasterscope opengl-check``: the core against the OpenGL of this machine."""

import argparse

from app.opengl_check.command import run_opengl_check

DESCRIPTION = """Draw random cases with OpenGL and with the core, and write a table of how they compare.
Needs the extra gpu: pip install moderngl."""
EXAMPLES = """examples:
  rasterscope opengl-check
  rasterscope opengl-check single shared --count 100 --seed 7

Exit code: 0 all families agree, 1 a family differs, or there is no OpenGL (stderr says why), 2 wrong usage.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    parser.add_argument("families", metavar="FAMILY", nargs="*", help="kinds of cases; default: all")
    parser.add_argument("--count", metavar="N", type=int, default=25, help="cases of each family (25)")
    parser.add_argument("--seed", metavar="N", type=int, default=0, help="seed of the random cases (0)")


def run(options: argparse.Namespace) -> int:
    """Compare; 0 if all families agree."""
    return run_opengl_check(options.families or None, options.count, options.seed)
