"""Keys that do in the main view and the timeline what else the wheel and a drag do."""

from PySide6.QtWidgets import QWidget

from app.pages.step.page import StepPage
from widgets.grid.pixel_grid import PixelGrid
from widgets.space.moved_area import MovedArea

ZOOM = 1.25
"""Magnification of one press."""
NUDGE = 0.5
"""Pixels by which one press moves a vertex."""


def _view(page: StepPage) -> PixelGrid | MovedArea | None:
    """Return the view that is shown: of several side by side the first, which the others follow."""
    shown = page.main_view()
    parts: list[QWidget] = [shown, *shown.findChildren(QWidget)]
    return next(
        (part for part in parts if isinstance(part, PixelGrid | MovedArea) and part.isVisible()), None
    )


def zoom(page: StepPage, factor: float) -> None:
    """Magnify the view, or the timeline that has the keyboard."""
    view = _view(page)
    if page.timeline.bar.hasFocus():
        page.timeline.bar.zoom(1 / factor)
    elif view is not None:
        view.zoom_by(factor)


def move_view(page: StepPage, across: int, up: int) -> None:
    """Look further to a side, by columns and rows (y up)."""
    view = _view(page)
    if page.timeline.bar.hasFocus():
        page.timeline.bar.move_view(across)
    elif view is not None:
        view.move_view(across, up)


def choose_vertex(page: StepPage) -> None:
    """Choose the next vertex to move."""
    if page.grid.choose_next_vertex() is None:
        page.tell("No vertex can be moved here. Show the pixels of a triangle in focus (V, F).")
    else:
        _tell_vertex(page)


def nudge_vertex(page: StepPage, across: int, up: int) -> None:
    """Move the chosen vertex by a part of a pixel."""
    if page.grid.nudge_vertex(NUDGE * across, NUDGE * up):
        _tell_vertex(page)
    else:
        page.tell("Choose a vertex first (Alt+N).")


def _tell_vertex(page: StepPage) -> None:
    page.tell(f"{page.grid.vertex_text()}. Ctrl+Shift+arrows move it.")
