"""``rasterscope scenes``: the built-in scenes."""

import argparse
import json

from lessons.scenes import CATALOGUE

DESCRIPTION = """List the built-in scenes. Their names can be given for any FILE."""
EXAMPLES = """examples:
  rasterscope scenes
  rasterscope shared-edge
  rasterscope render knot -o knot.png
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    parser.add_argument("--json", action="store_true", help="name, title and description, as JSON")


def run(options: argparse.Namespace) -> int:
    """Write the list."""
    if options.json:
        rows = [{"name": s.name, "title": s.title, "description": s.description} for s in CATALOGUE]
        print(json.dumps(rows, indent=1))
    else:
        print("\n".join(f"{scene.name:<18}{scene.description}" for scene in CATALOGUE))
    return 0
