"""A program with a window that edits its scene all the time, for tests that end it; not a test itself.

``python edited_session.py FIRST SCENE`` opens a built-in scene, or goes on with what was open last where SCENE is
empty. It numbers its edits from FIRST and writes each number to the standard output when the edit is done.
"""

import faulthandler
import random
import signal
import sys
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from PySide6.QtCore import QTimer

from app.session.document import Document, open_document
from app.window import start
from app.window.appearance import the_application
from app.window.main_window import MainWindow
from core.scene import Scene
from lessons.scene_edits import set_value
from lessons.scenes import built_in_scene

LONGEST_PAUSE = 900
"""Milliseconds between two edits at most."""


def edited(document: Document, value: float) -> Document:
    """Return the document with a vertex moved: that of a mesh, or of the first triangle."""
    if isinstance(document.scene, Scene):
        mesh = document.scene.meshes[0]
        positions = mesh.positions.copy()
        positions[0, 0] = value
        meshes = (replace(mesh, positions=positions), *document.scene.meshes[1:])
        return replace(document, scene=replace(document.scene, meshes=meshes))
    return replace(document, scene=set_value(document.scene, "corner/0/0/x", value, document.scene.size))


class Editor:
    """Makes an edit at every tick of a timer, once the window is there."""

    def __init__(self, first: int, scene: str) -> None:
        self.number, self.scene = first, scene
        self.random = random.Random(first)
        self.timer = QTimer()
        self.timer.timeout.connect(self.edit)
        self.timer.start(20)

    def edit(self) -> None:
        """Move a vertex, and let the number of the edit be the title."""
        found = [window for window in the_application().topLevelWidgets() if isinstance(window, MainWindow)]
        if not found or not found[0].isVisible():
            return
        session = found[0].session
        if self.scene:
            session.open(open_document(built_in_scene(self.scene).make(), self.scene))
            self.scene = ""
        document = edited(session.document, self.random.uniform(0, 1))
        session.edit(replace(document, title=f"edit {self.number}"))
        print(self.number, flush=True)
        self.number += 1
        self.timer.setInterval(self.random.randrange(LONGEST_PAUSE))


faulthandler.enable()
# A shell starts what runs in the background with Ctrl+C ignored, nohup with SIGHUP, and with it its children.
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGHUP, signal.SIG_DFL)
the_application()
editor = Editor(int(sys.argv[1]), sys.argv[2])
sys.exit(start.run_window())
