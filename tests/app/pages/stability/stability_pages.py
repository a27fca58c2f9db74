"""The Stability page as the tests use it: on a coarse grid, run, pointed at."""

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from app.pages.stability.page import StabilityPage
from app.window.main_window import MainWindow
from core.study.cases import Atlas
from core.study.stress import Shrunk
from widgets.experiments.maps import CellPlace

EXCLUSIVE = "fill_rule=exclusive"


LEFT = Qt.MouseButton.LeftButton


def stability_page(window: MainWindow) -> StabilityPage:
    """Return the page at a mesh whose edges pass through pixel centres, on a coarse grid."""
    QTest.keyClick(window, Qt.Key.Key_3, Qt.KeyboardModifier.AltModifier)
    found = window.pages.current
    found.show_named("shared-edges")
    found.choice.resolution = "coarse"
    found.refresh()
    return found


def run(page: StabilityPage, qtbot: QtBot) -> Atlas:
    """Run by the key and wait."""
    QTest.keyClick(page.window(), Qt.Key.Key_F5)
    assert page.is_running
    qtbot.waitUntil(lambda: not page.is_running, timeout=60000)
    return page.choice.result.content


def ran(page: StabilityPage, qtbot: QtBot) -> Atlas:
    """Return what an earlier test of the same window has run, or run it."""
    return run(page, qtbot) if page.choice.result is None else page.choice.result.content


def click(page: StabilityPage, place: CellPlace) -> None:
    QTest.mouseClick(page.maps.canvas, LEFT, pos=page.maps.canvas.cell_area(place).center())


def point_at(page: StabilityPage, place: CellPlace) -> None:
    QTest.mouseMove(page.maps.canvas, page.maps.canvas.cell_area(place).center())


def wait_for_case(page: StabilityPage, qtbot: QtBot) -> None:
    qtbot.waitUntil(lambda: page.opened.found is not None, timeout=60000)


def wait_for_shrunk(page: StabilityPage, qtbot: QtBot) -> Shrunk:
    """Wait until the case that is opened has been made small; return what it was made to."""
    qtbot.waitUntil(
        lambda: page.opened.found is not None and page.opened.found.shrunk is not None, timeout=60000
    )
    return page.opened.found.shrunk


def status(page: StabilityPage) -> str:
    window = page.window()
    return window.statusBar().currentMessage()
