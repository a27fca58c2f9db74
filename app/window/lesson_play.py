"""Playing a lesson as one who knows everything: each step answered or solved, pictured before and after."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace

from PySide6.QtCore import Qt, QThread

from app.files.open_any import open_any
from app.pages.step.lesson_walk import LessonWalk
from app.window.appearance import the_application
from app.window.main_window import MainWindow
from app.window.start import theme_of
from lessons.course.lesson_file import Lesson
from lessons.course.state import States, solved
from lessons.scenes import CATALOGUE
from widgets.basics.style_sheet import apply_theme
from widgets.lessons.records import Standing

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
