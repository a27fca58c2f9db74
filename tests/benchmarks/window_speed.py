"""Measure the window: first paint, a step with six linked grids, a re-trace while dragging, an orbit.

Run it by hand (``.venv/bin/python tests/benchmarks/window_speed.py``); times are printed, never asserted.
"""

import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from time import perf_counter

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np  # noqa: E402
from PySide6.QtWidgets import QApplication  # noqa: E402

FIRST_PAINT = """
import sys, time
start = time.perf_counter()
sys.path.insert(0, {root!r})
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication
from app.session.document import open_document
from app.window.main_window import MainWindow
from lessons.scenes import make_scene
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import LIGHT
application = QApplication(["rasterscope"])
apply_theme(application, LIGHT)
window = MainWindow(open_document(make_scene("single-triangle"), "Single triangle"))
window.resize(1280, 800)
window.show()
application.processEvents()
print(time.perf_counter() - start)
"""


def report(name: str, seconds: list[float], goal: str) -> None:
    """Print median and 95th percentile in milliseconds."""
    milliseconds = np.array(seconds) * 1000
    median, high = np.median(milliseconds), np.percentile(milliseconds, 95)
    print(f"{name:52} median {median:8.1f} ms   95 % {high:8.1f} ms   goal {goal}   n = {len(seconds)}")


def first_paint() -> list[float]:
    """Start the program several times: from the interpreter's start of the imports to the first paint."""
    found = []
    for _ in range(5):
        code = FIRST_PAINT.format(root=str(ROOT))
        output = subprocess.run(
            [sys.executable, "-c", code], capture_output=True, text=True, check=True
        ).stdout
        found.append(float(output))
    return found


def main() -> int:
    """Measure and print."""
    report("first paint", first_paint(), "2000 ms")
    from app.session.document import open_document
    from app.window.main_window import MainWindow
    from core import Settings, render
    from core.records.steps import Level
    from lessons.scenes import make_scene
    from lessons.shapes import torus
    from widgets.basics.style_sheet import apply_theme
    from widgets.basics.theme import LIGHT

    application = QApplication.instance() or QApplication(["rasterscope"])
    apply_theme(application, LIGHT)
    window = MainWindow(open_document(make_scene("single-triangle"), "Single triangle"))
    window.resize(1280, 800)
    window.show()
    application.processEvents()

    steps = []
    window.session.set_level(Level.PIXEL)
    for _ in range(300):
        start = perf_counter()
        window.session.step(1)
        application.processEvents()
        steps.append(perf_counter() - start)
    report("step, linked 64x48 grids", steps, "  16.7 ms (95 %)")

    scrubs = []
    count = window.session.stage_trace.steps.count
    for position in np.linspace(0, count, 200).astype(int):
        start = perf_counter()
        window.session.scrub(int(position))
        application.processEvents()
        scrubs.append(perf_counter() - start)
    report("scrub, linked 64x48 grids", scrubs, "  16.7 ms (95 %)")

    drags = []
    for k in range(100):
        start = perf_counter()
        window.page.grid.vertex_dragged.emit(0, 8 + k / 20, 6 + k / 30)
        application.processEvents()
        drags.append(perf_counter() - start)
    report("re-trace while dragging a vertex", drags, "  50 ms")

    scene = replace(make_scene("torus"), meshes=(torus(columns=76, rows=40),))
    distance = np.linalg.norm(scene.camera.eye - scene.camera.target)
    for fill in ("hierarchy", "bounding-box", "scanline"):
        orbit = []
        for k in range(30):
            angle = k * np.pi / 15
            eye = distance * np.array([0.9 * np.sin(angle), 0.43, 0.9 * np.cos(angle)])
            turned = replace(scene, camera=replace(scene.camera, eye=eye))
            start = perf_counter()
            render(turned, Settings(fill=fill))
            orbit.append(perf_counter() - start)
        triangles = sum(len(mesh.triangles) for mesh in scene.meshes)
        report(f"orbit, {triangles} triangles, 512x512, Phong, {fill}", orbit, "  50 ms")
    window.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
