"""The state on the Step page, copied for a lesson, opens the same: A | B, pin, buffer and step."""

import tomllib

import pytest
from PySide6.QtGui import QGuiApplication
from pytestqt.qtbot import QtBot

from app.window.main_window import MainWindow

pytestmark = pytest.mark.shared_window


def copied(window: MainWindow) -> dict[str, object]:
    window.run_action("lesson_copy")
    state: dict[str, object] = tomllib.loads(QGuiApplication.clipboard().text())["state"]
    return state


def test_what_is_open_is_copied_for_a_lesson(window: MainWindow, qtbot: QtBot) -> None:
    window.open_path("fan")
    qtbot.waitUntil(lambda: window.session.document.title == "Fan of shared edges")
    session, page = window.session, window.page
    session.set_stage("raster", 4)
    session.set_pin((32, 24))
    page.grids.look_only_at(window.session.cursor.stage, "overdraw")
    page.grids.show_again()
    page.comparing.set_differences({"fill_rule": "inclusive"})
    page.show_view("compare")
    assert copied(window) == {
        "scene": "fan",
        "settings": {"fill": "bounding-box"},
        "stage": "raster",
        "at": "covered",
        "pixel": [32, 24],
        "buffer": "overdraw",
        "other": {"fill_rule": "inclusive"},
    }
    page.show_view("pixels")
    assert "other" not in copied(window)
    before = QGuiApplication.clipboard().text()
    window.open_path("sphere")
    qtbot.waitUntil(lambda: window.session.document.title == "Sphere")
    with qtbot.waitSignal(page.message_sent) as said:
        window.run_action("lesson_copy")
    assert said.args == ["This cannot be copied: only the whole view can stand in a lesson: press Shift+F."]
    assert QGuiApplication.clipboard().text() == before
