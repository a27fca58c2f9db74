"""The measurement of the window from beginning to end: open, act, report, write."""

import gc
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

from PySide6.QtGui import QGuiApplication

from app.background.collecting import Collecting
from app.bench.machine import this_machine
from app.bench.meshes import lit_sphere
from app.bench.scenes import lights_of, mesh_of, view_of
from app.bench.window.figures import csv_text, table_text
from app.bench.window.script import QUICK, WHOLE, Sample, Script, opened_window
from app.files.file_writing import write_file
from app.files.open_any import Opened, open_any
from app.session.document import open_document
from app.window.appearance import the_application
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import LIGHT

SIZES = ((1280, 800), (1920, 1080))
LARGE_MESH = "large-mesh"
SCENES = ("single-triangle", "near-plane", "textured-floor", "cube", "sphere", LARGE_MESH)
FILE_NAME = "window.csv"


def opened_scene(name: str) -> Opened:
    """Open a built-in scene or a file, or a sphere of 81,920 triangles."""
    if name != LARGE_MESH:
        return open_any(name)
    sphere = lit_sphere()
    scene = view_of(sphere, mesh_of(sphere), lights_of(sphere))
    return Opened(open_document(scene, "Sphere of 81,920 triangles"))


def measure_window(
    scenes: Sequence[str], sizes: Iterable[tuple[int, int]], folder: Path | None, is_quick: bool
) -> int:
    """Measure windows of some sizes with some scenes, print a table for each, and write ``window.csv``."""
    gc.freeze()  # these as when the window is started
    application = the_application()
    collecting = Collecting(application)
    apply_theme(application, LIGHT)
    machine, display = this_machine(), QGuiApplication.platformName()
    print(
        f"{machine.sentence()}; display {display}\n"
        "Milliseconds from an input until nothing is left to do or to paint; stall: the longest time without taking "
        "input;\nprocessor: what the window's thread worked; fixed work: the same computation before every input.",
        flush=True,
    )
    opened = {name: opened_scene(name) for name in scenes}
    windows: dict[tuple[int, int], list[Sample]] = {}
    for size in sizes:
        samples: list[Sample] = []
        shown = size
        for name in scenes:
            print(f"{size[0]}x{size[1]} {name}", file=sys.stderr, flush=True)
            with opened_window(opened[name], size) as window:
                script = Script(window, name, QUICK if is_quick else WHOLE)
                script.run()
                shown = window.width(), window.height()
            samples += script.samples
        windows[shown] = samples
        print(f"\n{table_text(samples, shown)}", flush=True)
    if folder is not None:
        write_file(folder / FILE_NAME, csv_text(windows, machine, display).encode())
    collecting.stop()
    return 0
