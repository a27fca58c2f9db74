"""A process that draws one picture with one library and ends.

It reads the triangles from a file and writes the pixels to another one:
``python -m app.bench.first_picture LIBRARY_MODULE TRIANGLES.npz PIXELS.npy``. Little else is imported here, since the
time of a process from its beginning to its end is what is measured.
"""

import sys
from contextlib import ExitStack
from importlib import import_module

import numpy as np

from app.bench.contender import Contender
from app.bench.records import WindowTriangles


def draw_first(module: str, triangles: str, pixels: str) -> None:
    """Draw what stands in one file with one library, and save the pixels to another."""
    with np.load(triangles) as file:
        width, height = file["size"].tolist()
        work = WindowTriangles(file["corners"], file["depth"], file["colors"], (width, height))
    warm: Contender = import_module(module).contender(work)
    with ExitStack() as stack:
        np.save(pixels, warm.prepare(stack).run())


if __name__ == "__main__":
    draw_first(*sys.argv[1:])
