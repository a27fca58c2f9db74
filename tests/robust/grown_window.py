"""A program whose window is used at random, which prints what it holds now and then; not a test itself.

``python grown_window.py FOLDER STEPS...`` prints a line of JSON after each of these numbers of random steps: how many
objects of each kind there are once the window shows its first scene again, and the bytes of its arrays. The steps run
in an event loop, as nothing that Qt is asked to delete goes away without one.
"""

import gc
import json
import sys
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

import numpy as np
from PySide6.QtCore import QCoreApplication, QObject, QTimer

from app.session.document import open_document
from app.window.appearance import the_application
from app.window.main_window import MainWindow
from lessons.scenes import built_in_scene
from tests.app.files.mesh_writing import SQUARE, ply_binary
from tests.core.meshes import torus
from tests.robust.monkey import Monkey

SEED = 20
NOT_HELD = ("QComboBoxDelegate", "QComboMenuDelegate")
"""Kinds of objects of Qt that it makes anew with each style sheet and keeps as long as their box: two for each."""


def held(window: MainWindow) -> dict[str, object]:
    """Return how many objects of Qt and of Python the window holds, by kind, and the bytes of all arrays."""
    gc.collect()
    found = gc.get_objects()
    kinds = Counter(
        type(one).__name__ for one in found if str(type(one).__module__).startswith(("app.", "widgets."))
    )
    arrays = {id(one): one for holder in found for one in gc.get_referents(holder) if type(one) is np.ndarray}
    del found
    of_qt = Counter(one.metaObject().className() for one in window.findChildren(QObject))
    for kind in NOT_HELD:
        of_qt.pop(kind, None)
    return {
        "qt": of_qt,
        "python": kinds,
        "bytes": sum(one.nbytes for one in arrays.values() if one.base is None),
    }


class Run(QObject):
    """Random steps, and a look at what is held after some of them."""

    def __init__(self, folder: Path, looks: list[int]) -> None:
        super().__init__()
        ring, square = folder / "ring.ply", folder / "square.obj"
        positions, triangles = torus(96, 48)
        ring.write_bytes(ply_binary(positions, triangles.tolist()))
        square.write_text(SQUARE + "f 1 2 3 4\n")
        scene = built_in_scene("shared-edge")
        self.first = open_document(scene.make(), scene.title)
        self.window = MainWindow(self.first)
        self.window.show()
        self.monkey = Monkey(self.window, SEED, [ring, square])
        self.looks = looks
        self.timer = QTimer(self)
        self.timer.timeout.connect(self.step)
        self.timer.start(0)

    def step(self) -> None:
        """Do a step; where a look is due, come to rest first."""
        if self.monkey.number < self.looks[0]:
            self.monkey.step()
            return
        self.timer.stop()
        self.looks.pop(0)
        while self.window.overlays.close_top():
            pass
        self.window.appearance.set_theme("light")
        self.window.pages.show_page("step")
        self.window.page.show_view("pixels")
        self.window.session.open(self.first)
        QTimer.singleShot(3000, self.look)

    def look(self) -> None:
        """Print what is held, and go on or end."""
        print(json.dumps(held(self.window)), flush=True)
        if self.looks:
            self.timer.start(0)
        else:
            self.window.close()
            QCoreApplication.quit()


application = the_application()
application.setQuitOnLastWindowClosed(False)
run = Run(Path(sys.argv[1]), [int(text) for text in sys.argv[2:]])
sys.exit(application.exec())
