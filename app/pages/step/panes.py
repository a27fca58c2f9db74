"""What the Step page consists of: panes that are shown or folded away, and what is refreshed after which change."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Qt, Slot
from PySide6.QtWidgets import QScrollArea, QWidget

from app.session.moment import Change, Moment
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
    scroll = QScrollArea(widgetResizable=True)
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


# What the page refreshes, one part after the other.


Order = tuple[tuple[Change, Callable[[Moment], object]], ...]


def order_of_parts(page: "StepPage") -> Order:
    """Return what shows a moment, and after which changes, in the order in which all are asked."""
    document, step, pin, pointing = Change.DOCUMENT, Change.STEP, Change.PIN, Change.POINTING
    cursor, run = Change.CURSOR, Change.DOCUMENT | Change.PREDICTING
    return (
        (Change.OPENED, page.begin_anew),
        (step | run | pointing | Change.ASKED, page.views.refresh),
        (step, page.main_area.follow_stage),
        (step | run, page.main_area.refresh_beside),
        (run, page.stepping.refresh_run),
        (cursor, page.stepping.refresh_cursor),
        (pin, page.stepping.refresh_marks),
        (step | pin, page.stepping.end_message),
        (run, page.inspector.refresh_run),
        (cursor, page.inspector.refresh_step),
        (cursor, page.column.show_step),
        (pointing, page.inspector.refresh_history),
        (pin, page.column.show_history),
        (step, page.inspector.ahead.begin),
        (document, page.grids.refresh_run),
        (cursor | Change.PREDICTING, page.grids.refresh_step),
        (pointing, page.grids.refresh_pointing),
        (document, page.scene.refresh),
        (document, page.table_editing.refresh),
        (document, page.shading.refresh),
        (run | Change.EDITS, page.comparing.refresh),
        (run | Change.EDITS | Change.ASKED, page.editing.refresh),
        (cursor, page.comparing.follow_step),
        (pointing, page.comparing.refresh_pointing),
        (step | run, page.show_place),
        (step, page.predicting.refresh),
        (step | run | pointing, page.narrator.owe),
        (run, page.navigation.refresh),
        (cursor, page.navigation.follow_step),
        (step, page.settle_layouts),
    )


class RefreshOrder(QObject):
    """Brings the parts of the Step page up to date, each once."""

    def __init__(self, page: "StepPage") -> None:
        super().__init__(page)
        self._session = page.session
        self._order = tuple((change.value, show) for change, show in order_of_parts(page))
        self._session.changed.connect(self._follow)

    @Slot(Change)
    def _follow(self, what: Change) -> None:
        """Show the moment: who shows another document shows its step and its pin, too, and what is asked."""
        if Change.DOCUMENT in what:
            what &= ~(Change.CURSOR | Change.POINTING | Change.PREDICTING)
        bits = what.value
        for changes, show in self._order:
            if changes & bits:
                # A part may have gone on to another step: the others show that one.
                show(self._session.moment)
