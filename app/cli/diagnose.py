"""``rasterscope diagnose``: which mistake or method makes a picture that another program drew."""

import argparse
from pathlib import Path

from app.cli import arguments
from app.files.drawn_pictures import read_drawn
from lessons.diagnosis import (
    RIGHT,
    Diagnosis,
    check_size,
    compared_text,
    diagnose,
    pixels_text,
    right_text,
    scene_text,
)

DESCRIPTION = """Say which mistake, or which other method, makes a picture of a scene that another program drew; or how
near the nearest is. For homework in any language."""
EXAMPLES = """PICTURE is one of
  .png  colours; the top row of the picture is the last row of the scene. .ppm, .pgm, .bmp, .tga: the same
  .jpg  lossy: what it is compared with is saved in the same way first. Small differences are lost, so better send .png
  .npz  color (H, W, 3 or 4), primitive (H, W) numbers of triangles, -1 for none, or pixels (N, 2); row 0 at the bottom
  .csv  a pixel a line: column,row or column,row,triangle or column,row,red,green,blue; row 0 at the bottom
Colours a byte apart are equal. The background may have any colour. A picture in two colours shows what is covered.
A grey picture is compared with the scene in grey, too.

examples:
  rasterscope diagnose shared-edge homework.png
  rasterscope diagnose shared-edge homework.csv --size 32x24 --set fill_rule=inclusive
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    arguments.add_file(parser)
    parser.add_argument(
        "picture",
        metavar="PICTURE",
        help="what another program drew of it: .png, .ppm, .bmp, .tga, .jpg, .npz or .csv",
    )
    arguments.add_size(parser, "pixels")
    arguments.add_settings(parser)


def run(options: argparse.Namespace) -> int:
    """Compare and report."""
    opened = arguments.open_file(options)
    settings = arguments.chosen_settings(opened.document.settings, options.set)
    scene = arguments.sized(opened.document.scene, options)
    check_size(scene.size, scene.size)
    drawn = read_drawn(Path(options.picture), scene.size)
    with arguments.progress_line() as progress:
        diagnosis = diagnose(scene, settings, drawn, progress)
    print("\n".join(report(diagnosis)))
    print(f"scene: {scene_text(opened.document.title, scene)}. {compared_text(diagnosis.drawn)}")
    return 0


def report(diagnosis: Diagnosis) -> list[str]:
    """Return what was found, as lines of text."""
    if diagnosis.is_right:
        return [f"right: {right_text(diagnosis.drawn)}"]
    lines = []
    for each in diagnosis.found:
        kind = "mistake" if each.is_mistake else "method"
        lines.append(f"{kind} {each.name}: {each.sentence}")
    if lines:
        return [*lines, pixels_text(diagnosis.from_right, RIGHT)]
    nearest = diagnosis.nearest
    return [
        "unknown: no mistake on the shelf and no method makes this picture",
        f"{'' if nearest.name == RIGHT else 'nearest: '}{pixels_text(diagnosis.differing, nearest.name)}",
        *([nearest.sentence] if nearest.sentence else []),
    ]
