"""A program that opens one mesh after the other in its window and prints its memory; not a test itself.

``python opened_meshes.py COUNT FOLDER`` makes COUNT rings in FOLDER. It runs alone, since tests leave memory behind.
"""

import os
import sys
import time
from collections.abc import Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from PySide6.QtCore import QCoreApplication

from app.session.document import open_document
from app.window.appearance import the_application
from app.window.main_window import MainWindow
from lessons.scenes import built_in_scene
from tests.app.files.mesh_writing import ply_binary
from tests.core.meshes import torus

LONGEST_WAIT = 120
"""Seconds until a mesh must be open."""


def wait_until(is_reached: Callable[[], bool]) -> None:
    """Let the window work until something has come about."""
    end = time.monotonic() + LONGEST_WAIT
    while not is_reached():
        if time.monotonic() > end:
            sys.exit("a mesh did not open in time")
        QCoreApplication.processEvents()


def resident_bytes() -> int:
    """Return the memory of this process."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


application = the_application()
scene = built_in_scene("shared-edge")
window = MainWindow(open_document(scene.make(), scene.title))
window.show()
window.memory.autosave.begin(None)
window.page.show_view("scene")
for number in range(int(sys.argv[1])):
    path = str(Path(sys.argv[2]) / f"ring {number}.ply")
    positions, triangles = torus(400, 200)
    Path(path).write_bytes(ply_binary(positions * (1 + number / 100), triangles.tolist()))
    window.open_path(path)
    wait_until(lambda path=path: window.session.document.path == path)
    window.session.set_setting("fill", ("blocks", "scanline")[number % 2])
    wait_until(lambda: not window.files.progress.is_busy and not window.page.views.is_drawing)
    wait_until(lambda: not window.files.freeing.is_waiting)
    print(resident_bytes(), flush=True)
window.close()
