"""A main window with a folder for preferences of its own."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PySide6.QtCore import QEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.files.open_any import Opened
from app.files.state_files import State
from app.pages import start_page
from app.session.document import open_document
from app.window.main_window import MainWindow
from core import Trace
from core.scene import AnyScene
from lessons.scenes import BuiltInScene, built_in_scene
from tests.patience import PATIENCE
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import LIGHT, current_theme


@pytest.fixture(scope="session", autouse=True)
def cards_drawn_once() -> Iterator[None]:
    """Let all Start pages have the pictures that the first one draws: they take longer than most tests of a page."""
    drawn: dict[str, NDArray[np.uint8]] = {}
    draw = start_page.picture_of

    def picture_of(built_in: BuiltInScene, scene: AnyScene) -> NDArray[np.uint8]:
        if built_in.name not in drawn:
            drawn[built_in.name] = draw(built_in, scene)
        return drawn[built_in.name]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(start_page, "picture_of", picture_of)
        yield


@contextmanager
def shown_window(application: QApplication) -> Iterator[MainWindow]:
    """Show two triangles that share an edge, in the middle of the raster stage; close and delete the window at last."""
    if current_theme() != LIGHT or application.style().name() != "fusion":
        apply_theme(application, LIGHT)
    application.setStyleSheet("")  # half the time that a window takes goes into its style sheet
    scene = built_in_scene("shared-edge")
    made = MainWindow(open_document(scene.make(), scene.title))
    made.resize(1280, 800)
    made.session.set_stage("raster", 4000)  # before it is painted
    bring_forward(made)
    yield made
    with pytest.MonkeyPatch.context() as patch:
        # Who closes while presenting comes back to the desk first, and a window that goes need not be styled for it.
        patch.setattr("app.window.appearance.apply_theme", lambda application, theme: None)
        made.close()
    made.deleteLater()
    # At once: the windows of earlier tests would be styled and painted with the next one.
    application.sendPostedEvents(made, QEvent.Type.DeferredDelete)
    if current_theme() != LIGHT:
        apply_theme(application, LIGHT)


@pytest.fixture
def window(request: pytest.FixtureRequest) -> MainWindow:
    """Return a shown window: one of the test's own, or the one that the tests of its module share."""
    marks = {mark.name for mark in request.node.iter_markers()}
    is_shared = "shared_window" in marks and "own_window" not in marks
    return request.getfixturevalue("kept_window" if is_shared else "new_window")


@pytest.fixture
def new_window(
    qtbot: QtBot, qapp: QApplication, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[MainWindow]:
    """Return a shown window of the test's own."""
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path / "config"))
    for other in qapp.topLevelWidgets():
        if isinstance(other, MainWindow):
            other.hide()  # that of the module would be styled and painted with this one
    with shown_window(qapp) as made:
        yield made


@pytest.fixture(scope="module")
def window_of_module(
    qapp: QApplication, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[tuple[MainWindow, State, Trace]]:
    """Return a shown window, what it shows, and the trace of that."""
    with pytest.MonkeyPatch.context() as patch, shown_window(qapp) as made:
        patch.setenv("RASTERSCOPE_CONFIG", str(tmp_path_factory.mktemp("config")))
        yield made, made.files.state(), made.session.trace


@pytest.fixture
def kept_window(window_of_module: tuple[MainWindow, State, Trace], qtbot: QtBot) -> Iterator[MainWindow]:
    """Return the module's window, and bring it back to where it was but for what can be undone."""
    made, before, trace = window_of_module
    to_the_desk(made)
    bring_forward(made)
    yield made
    to_the_desk(made)
    put_back(made, before, trace)


@pytest.fixture
def presented(window_of_module: tuple[MainWindow, State, Trace], qtbot: QtBot) -> Iterator[MainWindow]:
    """Return the module's window, arranged for presenting on a small screen; the next test finds it so."""
    made, before, trace = window_of_module
    bring_forward(made)
    made.resize(1280, 720)
    if not made.presenter.is_presenting:
        made.appearance.set_theme("light")
        made.presenter.arrange()
    made.page.main_view().setFocus()
    made.page.settle()
    yield made
    put_back(made, before, trace)


def to_the_desk(window: MainWindow) -> None:
    """Bring a window back to the look in which it was opened."""
    window.presenter.leave()
    if current_theme() != LIGHT:
        window.appearance.set_text_size(100)
        window.appearance.set_theme("light")
    application = QApplication.instance()
    assert isinstance(application, QApplication)
    if application.styleSheet():
        application.setStyleSheet("")  # as at first: with it everything that a later test shows takes longer
    window.resize(1280, 800)


def bring_forward(window: MainWindow) -> None:
    """Show a window, which has the keyboard then."""
    window.show()
    window.activateWindow()
    assert QTest.qWaitForWindowActive(window, PATIENCE)


def put_back(window: MainWindow, before: State, trace: Trace) -> None:
    """Bring a window back to what it showed, as a user would: nothing lies over it, the saved state is opened."""
    while window.overlays.close_top():
        pass
    window.help.close()
    if window.session.is_predicting:
        window.run_action("predict")
    window.pages.show_page("step")
    window.files.show_opened(Opened(before.document, state=before), trace)
    window.messages.clear()
    window.statusBar().clearMessage()
    after = window.files.state()
    assert after.document is before.document
    for name in {field.name for field in fields(State)} - {"document"}:
        assert getattr(after, name) == getattr(before, name), name
