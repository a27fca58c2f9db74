"""What a learner does on the Exercises page."""

from collections.abc import Callable

from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from app.pages.exercises.page import ExercisesPage

Page = Callable[..., ExercisesPage]
LEFT = Qt.MouseButton.LeftButton


def check(page: ExercisesPage) -> str:
    """Check the answer; return what is found."""
    QTest.mouseClick(page.question_view.check_button, LEFT)
    page.settle()
    return page.question_view.verdict.text()


def at(page: ExercisesPage, pixel: tuple[int, int]) -> QPoint:
    """Return where a pixel is on the picture."""
    return page.grid.placement().cells_rect(*pixel).center().toPoint()


def paint(page: ExercisesPage, pixels: frozenset[tuple[int, int]]) -> None:
    """Drag over the pixels of every row."""
    for row in sorted({row for _, row in pixels}):
        columns = sorted(column for column, its in pixels if its == row)
        QTest.mousePress(page.grid, LEFT, pos=at(page, (columns[0], row)))
        QTest.mouseMove(page.grid, at(page, (columns[-1], row)))
        QTest.mouseRelease(page.grid, LEFT, pos=at(page, (columns[-1], row)))
