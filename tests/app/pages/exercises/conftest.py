"""The Exercises page of a shown window, with any question."""

import pytest
from PySide6.QtWidgets import QApplication

from app.pages.exercises.page import ExercisesPage
from app.window.main_window import MainWindow
from lessons.exercises.catalogue import TEMPLATES
from tests.app.pages.exercises.acting import Page


@pytest.fixture
def page(window: MainWindow) -> Page:
    """Return what shows the page with the question of a template and seed."""

    def show(name: str, seed: int = 7) -> ExercisesPage:
        window.run_action("page_exercises")
        shown = window.pages.current
        shown.settle()
        shown.questions.open(TEMPLATES[name], seed)
        shown.settle()
        QApplication.processEvents()
        return shown

    return show
