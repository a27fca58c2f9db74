"""A lesson on the Step page, opened, answered and waited for."""

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.files.user_folders import attempt_file
from app.pages.lessons.walk import LessonWalk
from app.window.main_window import MainWindow
from lessons.attempts.record import Attempt
from tests.lessons.course.lesson_texts import GOOD
from widgets.exercises.records import Standing

OPEN, SEEN, DONE = Standing.OPEN, Standing.SEEN, Standing.DONE


def settled(window: MainWindow, qtbot: QtBot) -> LessonWalk:
    """Wait until nothing is worked on any more; return the lesson."""
    qtbot.waitUntil(lambda: not window.page.lessons.is_working)
    QApplication.processEvents()
    return window.page.lessons.walk


def opened(window: MainWindow, qtbot: QtBot, folder: Path, step: int = 0, text: str = GOOD) -> LessonWalk:
    """Open the lesson of a text, which nobody has begun, at a step from 0."""
    folder.mkdir(exist_ok=True)
    path = folder / f"{folder.name[:40].strip('_').replace('_', '-')}.toml"
    path.write_text(text, encoding="utf-8")
    window.open_path(str(path))
    walk = settled(window, qtbot)
    if step:
        walk.go(step)
        settled(window, qtbot)
    return walk


def answered(walk: LessonWalk, qtbot: QtBot, given: object) -> str:
    """Type an answer, press Return, and return what is said of it."""
    asked = walk.answers.asked
    walk.answers.fill(asked.question.draft.answer.read(given))
    QTest.keyClick(walk.view, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: not walk.is_working)
    return walk.view.feedback.text()


def kept(walk: LessonWalk, window: MainWindow, qtbot: QtBot) -> list[Attempt]:
    """Return what is kept of a lesson."""
    settled(window, qtbot)
    prefix = f"lesson/{walk.lesson.name}/"
    return [attempt for attempt in attempt_file().attempts() if attempt.template.startswith(prefix)]
