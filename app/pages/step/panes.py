"""The panes of the Step page: those beside the strip at the left, and what can be shown or folded away."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QScrollArea, QWidget

from widgets.basics.controls import column_layout

if TYPE_CHECKING:
    from app.pages.step.page import StepPage


@dataclass(frozen=True)
class Pane:
    """What can be shown on the Step page or folded away."""

    name: str
    title: str
    """Of its tab, or of its entry in the menu."""
    key: str


@dataclass(frozen=True)
class SidePane(Pane):
    """One of the panes that open beside the strip at the left, one at a time."""

    make: Callable[["StepPage"], QWidget]


def _scrolled(widget: QWidget) -> QScrollArea:
    scroll = QScrollArea()
    scroll.setWidgetResizable(True)
    scroll.setFrameShape(QScrollArea.Shape.NoFrame)
    scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    scroll.setWidget(widget)
    return scroll


def _scene_pane(page: "StepPage") -> QWidget:
    pane = QWidget()
    layout = column_layout(pane, 0)
    layout.addWidget(page.outline, 1)
    layout.addWidget(page.depth_tables, 6)
    return pane


def _overlay_pane(page: "StepPage") -> QWidget:
    pane = QWidget()
    layout = column_layout(pane, 8, margins=(8, 8, 8, 8))
    layout.addWidget(page.legend)
    layout.addStretch(1)
    return pane


def _methods_pane(page: "StepPage") -> QWidget:
    return _scrolled(page.settings_panel)


def _shader_pane(page: "StepPage") -> QWidget:
    return page.shader_pane


SIDE_PANES = (
    SidePane("scene", "Scene", "S", _scene_pane),
    SidePane("methods", "Methods", "M", _methods_pane),
    SidePane("overlays", "Overlays", "O", _overlay_pane),
    SidePane("shaders", "Shaders", "L", _shader_pane),
)
PANES = (
    *SIDE_PANES,
    Pane("inspector", "Inspector", "I"),
    Pane("details", "Variables", "H"),
    Pane("thumbnails", "Thumbnails of all buffers", "T"),
    Pane("navigator", "Navigator", "G"),
    Pane("run", "Run: stages and timeline", "R"),
)
