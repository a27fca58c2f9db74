"""Fills a page as a user would, for a picture of it: chooses, measures or runs, waits, opens what is behind a mark."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from PySide6.QtCore import QEventLoop
from PySide6.QtWidgets import QApplication

from app.pages.compare.page import ComparePage
from app.pages.exercises.catalogue_presenter import FIRST_COURSE
from app.pages.exercises.page import ExercisesPage
from app.pages.page_bar import Page
from app.pages.plan.page import PlanPage
from app.pages.result_page import ResultPage
from app.pages.stability.page import StabilityPage
from app.pages.start.page import StartPage
from app.usage import UsageError
from app.window.main_window import MainWindow

PICTURE_SEED = 7
"""Of the question that is asked for a picture."""
PICTURE_ROUNDS = 3
"""Timed runs of every method for a picture of the page: fewer than in the window, where the figures matter."""


@dataclass(frozen=True)
class PageContent:
    """What a page is to show."""

    page: str
    """Name of a page of ``app.pages.page_table``."""
    name: str = ""
    """Family of the Compare page, experiment of the Stability page, or exercise; empty: the first."""
    work: str = ""
    """Kind of work of the family; empty: the first."""
    method: str = ""
    """Method whose mark is opened, or whose first failing cell is; mistake whose answer is checked; empty: none."""
    rounds: int | None = None
    """Timed runs of every method of the family; ``None``: as many as a picture needs."""
    grow: bool = False
    """Whether to measure, of the whole pipeline too, how cost grows: that takes minutes."""


def fill_page(window: MainWindow, content: PageContent) -> None:
    """Show a page and fill it; returns when all is there.

    Raises
    ------
    ValueError
        If the page refuses. A UsageError: it has no such family, work, experiment or method; the message says which
        there are.
    """
    window.pages.show_page(content.page)
    page, refusals = window.pages.current, _Refusals()
    page.edit_refused.connect(refusals.take)
    if isinstance(page, ResultPage):
        _show_result(page, content)
    elif isinstance(page, StartPage):
        _wait_until(lambda: not page.is_drawing)
    elif isinstance(page, PlanPage):
        page.start()
        _wait_until(lambda: not page.is_running)
    elif isinstance(page, ExercisesPage):
        _ask(page, content)
    if refusals.texts:
        raise ValueError(refusals.texts[0])


def open_saved(window: MainWindow, path: str) -> None:
    """Show a saved study or atlas on its page; ValueError where it cannot be opened."""
    refusals = _Refusals()

    def listen(page: Page) -> None:
        page.edit_refused.connect(refusals.take)

    window.pages.page_made.connect(listen)
    window.open_path(path)
    window.pages.page_made.disconnect(listen)
    if refusals.texts:
        raise ValueError(refusals.texts[0])


class _Refusals:
    """Keeps what a page says that it cannot do."""

    def __init__(self) -> None:
        self.texts: list[str] = []

    def take(self, text: str) -> None:
        """Keep a sentence."""
        self.texts.append(text)


def _show_result(page: ResultPage[Any, Any], content: PageContent) -> None:
    """Run the requested work, and open the requested method."""
    if content.name:
        page.show_named(
            _known("family" if content.page == "compare" else "experiment", content.name, page.names)
        )
    if isinstance(page, ComparePage):
        choice = page.choice
        if content.work:
            works = [work.name for work in choice.works]
            choice.work = _known(f"work of {choice.name}", content.work, works)
        choice.rounds = content.rounds or PICTURE_ROUNDS
        choice.grow = content.grow or (choice.family is not None and not choice.family.takes_scene)
        page.refresh()
    page.start()
    _wait_until(lambda: not page.is_running)
    if not content.method or page.choice.result is None:
        return
    what = f"method of {page.choice.name}"
    if isinstance(page, ComparePage) and page.content is not None:
        page.choose(_known(what, content.method, [point.method for point in page.content.points]))
    elif isinstance(page, StabilityPage):
        page.choose_failure(_known(what, content.method, list(page.info.methods)))
    _wait_until(lambda: not page.jobs.is_running)


def _ask(page: ExercisesPage, content: PageContent) -> None:
    """Ask the requested exercise, and check the answer that a mistake gives."""
    templates = page.exercises.templates
    name = _known("exercise", content.name or FIRST_COURSE[0], list(templates))
    page.settle()
    page.questions.open(templates[name], PICTURE_SEED)
    page.settle()
    if content.method and page.question is not None:
        mistakes = page.question.draft.mistakes
        page.questions.answer(mistakes[_known(f"mistake of {name}", content.method, list(mistakes))])
        page.questions.check()
        page.settle()


def _known(what: str, name: str, names: list[str]) -> str:
    if name not in names:
        raise UsageError(f"{what} must be one of {', '.join(names)}, got {name}")
    return name


def _wait_until(is_done: Callable[[], bool]) -> None:
    while not is_done():
        QApplication.processEvents(QEventLoop.ProcessEventsFlag.AllEvents, 50)
