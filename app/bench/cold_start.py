"""The first picture of a fresh process: the interpreter's start, the imports, and what a library does only once.

What the process does stands in `app.bench.first_picture`.
"""

import os
import subprocess
import sys
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from types import ModuleType

import numpy as np

from app.bench.contender import Contender, Prepared, UnavailableError
from app.bench.first_picture import ARRAYS, PIXELS
from app.bench.records import Bytes, ColdStart, WindowTriangles

CHILD = "app.bench.first_picture"
"""The module that runs in the process."""
ROOT = Path(__file__).resolve().parents[2]


def contender(module: ModuleType, work: ColdStart) -> Contender | None:
    """Return a library drawing in processes of their own, or ``None`` if it does not draw triangles."""
    warm: Contender | None = module.contender(work.triangles)
    if warm is None:
        return None
    return replace(warm, prepare=lambda stack: prepare(module.__name__, work.triangles, stack))


def prepare(module: str, work: WindowTriangles, stack: ExitStack) -> Prepared:
    """Write the triangles where the processes will find them."""
    folder = Path(stack.enter_context(TemporaryDirectory(prefix="rasterscope-bench-")))
    for name in ARRAYS:
        np.save(folder / f"{name}.npy", getattr(work, name))
    pixels = folder / PIXELS
    width, height = work.size
    command = [sys.executable, "-P", "-m", CHILD, module, str(folder), str(width), str(height)]
    environment = dict(os.environ, PYTHONPATH=str(ROOT))
    # The run that checks the picture leaves compiled files behind, as installing does for the other libraries.
    environment.pop("PYTHONDONTWRITEBYTECODE", None)

    def run() -> Bytes:
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        if done.returncode != 0:
            lines = done.stderr.strip().splitlines()
            raise UnavailableError(lines[-1] if lines else f"exit code {done.returncode}")
        drawn: Bytes = np.load(pixels)
        return drawn

    return Prepared(run)
