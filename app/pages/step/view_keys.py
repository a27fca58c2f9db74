"""Keys that do in the main view and the timeline what else the wheel and a drag do."""

from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QWidget

from app.pages.page_bar import Handlers
from widgets.grid.pixel_grid import PixelGrid
from widgets.space.moved_area import MovedArea

if TYPE_CHECKING:
    from app.pages.step.page import StepPage

ZOOM = 1.25
"""Magnification of one press."""
NUDGE = 0.5
"""Pixels by which one press moves a vertex."""
WAYS = {"left": (-1, 0), "right": (1, 0), "up": (0, 1), "down": (0, -1)}
"""Columns and rows (y up) of the four ways."""


def view_handlers(page: "StepPage") -> Handlers:
    """Return the handlers by the names of ``app.window.keys.ACTIONS``."""
    return {
        "zoom_in": partial(_zoom, page, ZOOM),
        "zoom_out": partial(_zoom, page, 1 / ZOOM),
        **{f"view_{way}": partial(_move, page, *ways) for way, ways in WAYS.items()},
        "next_vertex": partial(_choose_vertex, page),
        **{f"vertex_{way}": partial(_nudge, page, *ways) for way, ways in WAYS.items()},
    }


def _view(page: "StepPage") -> PixelGrid | MovedArea | None:
    """Return the view that is shown: of several side by side the first, which the others follow."""
    shown = page.main_view()
    parts: list[QWidget] = [shown, *shown.findChildren(QWidget)]
    return next(
        (part for part in parts if isinstance(part, PixelGrid | MovedArea) and part.isVisible()), None
    )


def _zoom(page: "StepPage", factor: float) -> None:
    view = _view(page)
    if page.timeline.bar.hasFocus():
        page.timeline.bar.zoom(1 / factor)
    elif view is not None:
        view.zoom_by(factor)


def _move(page: "StepPage", across: int, up: int) -> None:
    view = _view(page)
    if page.timeline.bar.hasFocus():
        page.timeline.bar.move_view(across)
    elif view is not None:
        view.move_view(across, up)


def _choose_vertex(page: "StepPage") -> None:
    if page.grid.choose_next_vertex() is None:
        page.message_sent.emit("No vertex can be moved here. Show the pixels of a triangle in focus (V, F).")
    else:
        _tell_vertex(page)


def _nudge(page: "StepPage", across: int, up: int) -> None:
    if page.grid.nudge_vertex(NUDGE * across, NUDGE * up):
        _tell_vertex(page)
    else:
        page.message_sent.emit("Choose a vertex first (Alt+N).")


def _tell_vertex(page: "StepPage") -> None:
    page.message_sent.emit(f"{page.grid.vertex_text()}. Ctrl+Shift+arrows move it.")
