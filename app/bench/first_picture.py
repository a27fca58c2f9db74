"""A process that draws one picture with one library and ends.

It reads the triangles from files of a folder and writes the pixels to another one:
``python -m app.bench.first_picture LIBRARY_MODULE FOLDER WIDTH HEIGHT``. Little else is imported here, since the
time of a process from its beginning to its end is what is measured.
"""

import sys
from contextlib import ExitStack
from importlib import import_module

import numpy as np

from app.bench.records import Contender, WindowTriangles

ARRAYS = ("corners", "depth", "colors")
"""The arrays of `WindowTriangles`, each in a file of its name; an archive of them would cost its own imports."""
PIXELS = "pixels.npy"


def draw_first(module: str, folder: str, width: int, height: int) -> None:
    """Draw the triangles of a folder with one library, and save the pixels there."""
    corners, depth, colors = (np.load(f"{folder}/{name}.npy") for name in ARRAYS)
    work = WindowTriangles(corners, depth, colors, (width, height))
    warm: Contender = import_module(module).contender(work)
    with ExitStack() as stack:
        np.save(f"{folder}/{PIXELS}", warm.prepare(stack).run())


if __name__ == "__main__":
    draw_first(sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4]))
