"""Fills a page as a user would, for a picture of it: chooses, measures or runs, waits, opens what is behind a mark."""

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QEventLoop
from PySide6.QtWidgets import QApplication

from app.pages.compare.page import ComparePage
from app.pages.page_bar import Page
from app.pages.plan.page import PlanPage
from app.pages.stability.page import StabilityPage
from app.window.main_window import MainWindow

PICTURE_ROUNDS = 3
"""Timed runs of every method for a picture of the page: fewer than in the window, where the figures are wanted."""


@dataclass(frozen=True)
class PageContent:
    """What a page is to show."""

    page: str
    """Name of a page of ``app.pages.page_table``."""
    name: str = ""
    """Family of the Compare page, or experiment of the Stability page; empty: the first."""
    work: str = ""
    """Kind of work of the family; empty: the first."""
    method: str = ""
    """Method whose mark is opened, or whose first failing cell is; empty: none."""
    rounds: int | None = None
    """Timed runs of every method of the family; ``None``: as many as a picture needs."""
    grow: bool = False
    """Whether to measure, of the whole pipeline too, how cost grows: that takes minutes."""


def fill_page(window: MainWindow, content: PageContent) -> None:
    """Show a page and fill it; returns when all is there.

    Raises
    ------
    ValueError
        If the page refuses, or has no such family, work, experiment or method; the message says which there are.
    """
    window.pages.show_page(content.page)
    page, refusals = window.pages.current, _Refusals()
    page.edit_refused.connect(refusals.take)
    if isinstance(page, ComparePage):
        _measure(page, content)
    elif isinstance(page, StabilityPage):
        _run(page, content)
    elif isinstance(page, PlanPage):
        page.plans.look()
        _wait_until(lambda: not page.desk.is_looking)
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


def _measure(page: ComparePage, content: PageContent) -> None:
    studies = page.studies
    if content.name:
        studies.show_family(_known("family", content.name, studies.names))
    if content.work:
        works = [work.name for work in studies.choice.works]
        studies.choice.work = _known(f"work of {studies.choice.name}", content.work, works)
    choice = studies.choice
    choice.rounds = content.rounds or PICTURE_ROUNDS
    choice.grow = content.grow or (choice.family is not None and not choice.family.takes_scene)
    studies.refresh()
    studies.measure()
    _wait_until(lambda: not page.desk.is_measuring)
    if content.method and studies.study is not None:
        methods = [point.method for point in studies.study.points]
        page.opened.choose(_known(f"method of {studies.choice.name}", content.method, methods))
        _wait_until(lambda: not page.desk.drawing.is_running)


def _run(page: StabilityPage, content: PageContent) -> None:
    runs = page.runs
    if content.name:
        runs.show_experiment(_known("experiment", content.name, runs.names))
    runs.run()
    _wait_until(lambda: not page.desk.is_running)
    if content.method and runs.result is not None:
        maps = {each.method: each for each in runs.result.atlas.maps}
        page.opened.choose_failure(_known(f"method of {runs.choice.name}", content.method, list(maps)))
        _wait_until(lambda: not page.desk.looking.is_running)


def _known(what: str, name: str, names: list[str]) -> str:
    if name not in names:
        raise ValueError(f"{what} must be one of {', '.join(names)}, got {name}")
    return name


def _wait_until(is_done: Callable[[], bool]) -> None:
    while not is_done():
        QApplication.processEvents(QEventLoop.ProcessEventsFlag.AllEvents, 50)
