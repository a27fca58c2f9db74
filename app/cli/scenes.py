"""``rasterscope scenes``: the built-in scenes."""

import argparse
import json

from lessons.lectures.scenes import LECTURE_SCENES, LECTURES
from lessons.scenes import CATALOGUE, BuiltInScene

DESCRIPTION = (
    """List the built-in scenes, then the lectures' own examples. Their names can be given for any FILE."""
)
EXAMPLES = """examples:
  rasterscope scenes
  rasterscope shared-edge
  rasterscope render knot -o knot.png
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    parser.add_argument("--json", action="store_true", help="name, title, description and lecture, as JSON")


def run(options: argparse.Namespace) -> int:
    """Write the list."""
    groups = {"": CATALOGUE, **LECTURE_SCENES}
    if options.json:
        print(json.dumps([row(scene, lecture) for lecture, of in groups.items() for scene in of], indent=1))
        return 0
    for lecture, scenes in groups.items():
        print(*([LECTURES[lecture]] if lecture else []), *map(line, scenes), sep="\n")
    return 0


def row(scene: BuiltInScene, lecture: str) -> dict[str, str]:
    """Return a scene as JSON has it; ``lecture`` is empty where it is of none."""
    return {"name": scene.name, "title": scene.title, "description": scene.description, "lecture": lecture}


def line(scene: BuiltInScene) -> str:
    """Return a scene as a person reads it."""
    return f"{scene.name:<23}{scene.description}"
