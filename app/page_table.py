"""Which pages the window has: one row for each, in the order of the bar."""

from PySide6.QtWidgets import QWidget

from app.pages import Page, PageKind
from app.session import Session
from app.step_page import StepPage


def _make_step(session: Session, parent: QWidget) -> Page:
    return StepPage(session, parent)


def _make_compare(session: Session, parent: QWidget) -> Page:
    from app.compare_page import ComparePage  # pyqtgraph takes a moment: not before the page is shown.

    return ComparePage(session, parent)


def _make_plan(session: Session, parent: QWidget) -> Page:
    from app.plan_page import PlanPage  # As above.

    return PlanPage(session, parent)


PAGE_KINDS = (
    PageKind("step", "Step", "Step through the pipeline, pixel by pixel (Alt+1)", _make_step),
    PageKind(
        "compare",
        "Compare",
        "Chart speed against accuracy for every family (Alt+2)",
        _make_compare,
        (".json",),
    ),
    PageKind("plan", "Plan", "What does this scene need? No more than that (Alt+4)", _make_plan),
)


def page_of_file(path: str) -> str:
    """Return the name of the page that shows a file; empty: it is a scene or a state."""
    name = path.lower()
    return next((kind.name for kind in PAGE_KINDS if kind.endings and name.endswith(kind.endings)), "")


def page_endings() -> list[str]:
    """Return the endings of all files that a page shows."""
    return [ending for kind in PAGE_KINDS for ending in kind.endings]
