"""A lesson on the Step page, at its question."""

from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from app.pages.lessons.walk import LessonWalk
from app.window.main_window import MainWindow
from tests.app.pages.step.lesson_walks import opened


@pytest.fixture
def walk(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> LessonWalk:
    """Return a lesson at its first question."""
    return opened(window, qtbot, tmp_path, 1)
