"""A main window with a folder for preferences of its own."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from app.session.document import open_document
from app.window.main_window import MainWindow
from lessons.scenes import built_in_scene
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import LIGHT, current_theme


@pytest.fixture
def window(qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[MainWindow]:
    """Return a shown window with two triangles that share an edge, in the middle of the raster stage."""
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path / "config"))
    from PySide6.QtCore import QEvent
    from PySide6.QtWidgets import QApplication

    application = QApplication.instance()
    assert isinstance(application, QApplication)
    if current_theme() != LIGHT or application.style().name() != "fusion":
        apply_theme(application, LIGHT)
    application.setStyleSheet("")  # half the time that a window takes goes into its style sheet
    scene = built_in_scene("shared-edge")
    made = MainWindow(open_document(scene.make(), scene.title))
    made.resize(1280, 800)
    made.show()
    made.activateWindow()
    qtbot.waitExposed(made)
    qtbot.waitUntil(made.isActiveWindow)
    made.session.set_stage("raster", 4000)
    yield made
    made.close()
    made.deleteLater()
    # At once: the windows of earlier tests would be styled and painted with the next one.
    application.sendPostedEvents(made, QEvent.Type.DeferredDelete)
    if current_theme() != LIGHT:
        apply_theme(application, LIGHT)
