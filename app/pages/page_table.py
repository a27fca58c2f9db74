"""Which pages the window has: one row for each, in the order of the bar."""

from PySide6.QtWidgets import QWidget

from app.files.file_names import DRAWN_ENDINGS
from app.files.input_files import open_input
from app.pages.page_bar import Page, PageKind
from app.pages.step.page import StepPage
from app.session.session import Session


def _make_step(session: Session, parent: QWidget) -> Page:
    return StepPage(session, parent)


def _make_start(session: Session, parent: QWidget) -> Page:
    from app.pages.start.page import StartPage  # Not every start shows it.

    return StartPage(session, parent)


def _make_compare(session: Session, parent: QWidget) -> Page:
    from app.pages.compare.page import ComparePage  # pyqtgraph takes a moment: not before the page is shown.

    return ComparePage(session, parent)


def _make_stability(session: Session, parent: QWidget) -> Page:
    from app.pages.stability.page import (
        StabilityPage,  # All experiments come along: not before the page is shown.
    )

    return StabilityPage(session, parent)


def _make_plan(session: Session, parent: QWidget) -> Page:
    from app.pages.plan.page import PlanPage  # As above.

    return PlanPage(session, parent)


def _make_exercises(session: Session, parent: QWidget) -> Page:
    from app.pages.exercises.page import ExercisesPage  # All exercises come along, as above.

    return ExercisesPage(session, parent)


PAGE_KINDS = (
    PageKind(
        "start", "Start", "What this is, recent files and scenes (Alt+0)", _make_start, hides_itself=True
    ),
    PageKind(
        "step", "Step", "Step through the pipeline, pixel by pixel (Alt+1)", _make_step, hides_itself=True
    ),
    PageKind(
        "compare",
        "Compare",
        "Chart speed against accuracy for every family (Alt+2)",
        _make_compare,
        (".json",),
        b'"rasterscope study"',
    ),
    PageKind(
        "stability",
        "Stability",
        "See where methods fail: one map per method, one real run per cell (Alt+3)",
        _make_stability,
        (".json",),
        b'"rasterscope stress"',
    ),
    PageKind("plan", "Plan", "Find the cheapest methods that this scene needs (Alt+4)", _make_plan),
    PageKind(
        "exercises",
        "Exercises",
        "Answer on the picture (Alt+5)",
        _make_exercises,
        (".toml", *DRAWN_ENDINGS),
        hides_itself=True,
    ),
)
HEAD = 256
"""Bytes at the beginning of a file that name the program it is of."""


def page_of_file(path: str) -> str:
    """Return the name of the page that shows a file; empty: it is a scene or a state.

    Of several pages that take its ending it is the one that the file names; the first, if it names none.
    """
    kinds = [kind for kind in PAGE_KINDS if kind.endings and path.lower().endswith(kind.endings)]
    if len(kinds) > 1:
        head = _head(path)
        kinds = [kind for kind in kinds if kind.signature in head] or kinds
    return kinds[0].name if kinds else ""


def _head(path: str) -> bytes:
    """Return the beginning of a file; nothing where it cannot be read: the page that opens it says why."""
    try:
        with open_input(path) as file:
            return file.read(HEAD)
    except OSError:
        return b""


def page_endings() -> list[str]:
    """Return the endings of all files that a page shows."""
    return sorted({ending for kind in PAGE_KINDS for ending in kind.endings})
