"""The window without a person: pages are filled as a user would for a picture of them, and lessons are played."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any

from PySide6.QtCore import QEventLoop, Qt, QThread
from PySide6.QtWidgets import QApplication

from app.background import is_working
from app.files.open_any import open_any
from app.pages.compare.page import ComparePage
from app.pages.exercises.catalogue_presenter import FIRST_COURSE
from app.pages.exercises.page import ExercisesPage
from app.pages.lessons.walk import LessonWalk
from app.pages.page_bar import Page
from app.pages.plan.page import PlanPage
from app.pages.result_page import ResultPage
from app.pages.stability.page import StabilityPage
from app.pages.start_page import StartPage
from app.usage import UsageError
from app.window.appearance import the_application
from app.window.main_window import MainWindow
from app.window.start import theme_of
from lessons.course.catalogue import Lesson
from lessons.course.state import States, solved
from lessons.scenes import CATALOGUE
from widgets.basics.style_sheet import apply_theme
from widgets.exercises.records import Standing

# Fills a page as a user would, for a picture of it: chooses, measures or runs, waits, opens what is behind
# a mark.


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
    _wait_until(lambda: not is_working(page))


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


# Playing a lesson as one who knows everything: each step answered or solved, pictured before and after.


Pictured = Callable[[str], None]
"""Takes a picture of the window, which is called as the step, as ``2-asked``."""


@contextmanager
def hidden_window(size: tuple[int, int], theme: str) -> Iterator[MainWindow]:
    """Return a window that nobody sees, and in which nothing is kept."""
    application = the_application()
    apply_theme(application, theme_of(theme, application))
    window = MainWindow(open_any(CATALOGUE[0].name).document)
    window.page.lessons.keeps_attempts = False
    window.resize(*size)
    window.setAttribute(Qt.WidgetAttribute.WA_DontShowOnScreen)
    window.show()
    if theme.startswith("presenter"):
        window.presenter.arrange()
    try:
        yield window
    finally:
        window.hide()
        for page in window.pages.made:
            page.stop()


def play(window: MainWindow, lesson: Lesson, picture: Pictured, *, tries_wrong: bool = False) -> None:
    """Walk a lesson by its keys, to the end; ``tries_wrong``: after each wrong answer that the file knows.

    Raises ValueError where a step cannot be opened, or is not done by its right answer or recorded solution.
    """
    refusals: list[str] = []
    window.page.edit_refused.connect(refusals.append)
    window.page.lessons.open(lesson)
    settle(window)
    if refusals:
        raise ValueError(refusals[0])
    walk = window.page.lessons.walk
    assert walk is not None
    states = States(lesson)
    while walk.number < len(lesson.steps):
        number, name = walk.number, "before" if walk.number < 0 else f"{walk.number + 1}"
        picture(f"{name}-asked")
        if tries_wrong and number >= 0:
            _try_wrong(window, walk, lesson, name, picture)
        if _do(window, walk, states):
            settle(window)
            picture(f"{name}-done")
        if refusals or (number >= 0 and walk.standings[number] is not Standing.DONE):
            said = refusals[0] if refusals else "is not done by its right answer or solution"
            raise ValueError(f"{lesson.path}: step {name} {said}")
        window.run_action("lesson_next")
        settle(window)
        if walk.number == number:
            raise ValueError(f"{lesson.path}: nothing follows step {name}: {', '.join(refusals)}")
    picture("end")
    window.page.edit_refused.disconnect(refusals.append)


def settle(window: MainWindow) -> None:
    """Wait until everything is there: what is shown last may have begun more work."""
    for _ in range(3):
        for _ in range(10):
            the_application().processEvents()
        while window.session.tracing.is_busy:  # A run that takes long is traced in the background.
            the_application().processEvents()
            QThread.msleep(5)
        window.page.settle()


def _try_wrong(window: MainWindow, walk: LessonWalk, lesson: Lesson, name: str, picture: Pictured) -> None:
    """Give every wrong answer of a step; then begin the step again, as if none had been given."""
    asked = walk.answers.asked
    if asked is None or not lesson.steps[walk.number].wrong:
        return
    for place, wrong in enumerate(lesson.steps[walk.number].wrong, 1):
        walk.answers.fill(asked.question.draft.answer.read(wrong.given))
        window.run_action("lesson_check")
        settle(window)
        picture(f"{name}-wrong-{place}")
    window.run_action("lesson_return")
    settle(window)


def _do(window: MainWindow, walk: LessonWalk, states: States) -> bool:
    """Give the right answer, or do what the recorded solution says; return whether there was anything to do."""
    answers, step, session = walk.answers, walk.step, window.session
    if answers.asked is not None:
        answers.fill(answers.asked.question.draft.answer.reference)
        window.run_action("lesson_check")
        return True
    if step is not None and step.show:
        walk.view.link_chosen.emit(step.show)
        window.pages.show_page("step")
        return True
    if step is None or step.solution is None:
        return False
    state = states.of_step(walk.number)
    done = solved(state, step.solution)
    if done.edits != state.edits:
        window.page.show_view("compare")  # As the editor of a listing does.
    if (done.scene, done.settings, done.edits) != (state.scene, state.settings, state.edits):
        document = session.document
        raster = document.raster
        if done.scene.size != state.scene.size:
            raster = replace(raster, columns=done.scene.size[0], rows=done.scene.size[1])
        edited = replace(document, scene=done.scene, settings=done.settings, edits=done.edits, raster=raster)
        session.edit(edited)
        settle(window)
    if step.solution.stage is not None or step.solution.at is not None:
        session.set_stage(done.stage, done.position(session.trace))
    if step.solution.pixel is not None:
        session.set_pin(done.pixel)
    return True
