"""The middle of the Step page: views, buffers and thumbnails, and the keys that do there what the wheel does."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, Qt, Signal, Slot
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QSizePolicy, QStackedWidget, QTabBar, QToolButton, QWidget

from app.session.moment import Moment
from app.session.session import Session
from app.views.companions import COMPANIONS, Companion, NewDepths, ScreenBeside
from app.views.occluder_view import OccludersBeside
from app.views.pass_view import PassBeside
from app.views.stage_views import StageViews
from core.explain.step_tables import first_in_table
from core.stages.declared import stage_of
from widgets.basics.accessibility import announce
from widgets.basics.controls import column_layout, flat_button, row_layout, text_label
from widgets.basics.panes import PaneSplitter
from widgets.basics.theme import current_theme, theme_notifier
from widgets.grid.buffer_strip import BufferChoice, BufferStrip
from widgets.grid.compare_view import CompareView
from widgets.grid.layers import GridBuffer
from widgets.grid.paint import NUMBER_PART
from widgets.grid.pixel_grid import PixelGrid
from widgets.grid.range_control import RangeButton, RangeControl
from widgets.space.view import MovedArea

if TYPE_CHECKING:
    from app.pages.step.page import StepPage


# The middle of the Step page: the row of views and buffers, the view that is shown, and the thumbnails.


LEAST_ROOM_OF_BOTH = 31
"""Heights of the text below which the area shows one side of a stage only."""
STACKED_GAIN = 1.05
"""How much larger two pictures alike, or a picture with a table, must be one above the other to lie so."""
AXES = 2.5
"""Room of the axes beside a picture, in heights of their numbers."""
TABLE_AT_MOST, PRESENTED_AT_MOST = 0.44, 0.6
"""Largest part of the height that a table below the picture takes: it scrolls, but not while presenting."""
CHOICES_WIDTH, LEAST_CHOICE = 24, 7
"""Heights of the text that the choice of a buffer and its range take, and its box alone at least."""


class MainArea(QWidget):
    """As much room as there is for one view; a stage that is entered is shown in the view chosen for it."""

    view_changed = Signal(str)
    """Name of the main view that is shown now."""
    view_chosen = Signal()
    """The user has chosen a main view."""
    thumbnails_toggled = Signal()
    """The user wants the strip of thumbnails shown or folded away."""

    def __init__(self, session: Session, views: StageViews, parent: QWidget) -> None:
        super().__init__(parent)
        self._views = views
        self._table_at_most, self._is_presenting = TABLE_AT_MOST, False
        self.grid, self.strip = PixelGrid(self), BufferStrip(self)
        self.compare_view = CompareView(self)
        self.ranges, self.buffer_choice = RangeControl(self), BufferChoice(self)
        self.range_button = RangeButton(self.ranges, self)
        self.thumbnails_button = self._thumbnails_button()
        self.view_bar = QTabBar(self)
        self.view_bar.setDrawBase(False)
        self.view_bar.setExpanding(False)
        self.view_bar.setAccessibleName("Main view")
        self.view_stack = QStackedWidget(self)
        self._pixels = QStackedWidget(self)
        self._pixels.addWidget(self.grid)
        self._add_view("pixels", "Pixels", self._pixels)
        for name, title, widget in views.widgets:
            self._add_view(name, title, widget)
        self._add_view("compare", "A | B", self.compare_view)
        self.views_by_hand: dict[str, str] = {}
        self._moment, self._viewed_stage = session.moment, session.cursor.stage
        self.companions: dict[str, Companion] = {stage: make(session) for stage, make in COMPANIONS.items()}
        self.companions |= {"pass": PassBeside(session), "occluders": OccludersBeside(session)}
        """What stands beside a stage's own view, by stage."""
        self.beside = QStackedWidget(self)
        for companion in self.companions.values():
            self.beside.addWidget(companion.widget)
        self.gives_room = False
        """Whether the main view takes the place of the other side while that is hidden."""
        self._veil = text_label("Hidden while you predict.", self.beside, role="muted")
        self._veil.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.beside.addWidget(self._veil)
        self._lay_out()
        self.view_bar.currentChanged.connect(self._show_view)
        self.view_bar.tabBarClicked.connect(self._choose_view)
        theme_notifier().theme_changed.connect(self._show_beside)
        theme_notifier().theme_changed.connect(self._arrange_row)
        for companion in self.companions.values():
            if isinstance(companion, NewDepths | ScreenBeside):
                self.grid.view_changed.connect(companion.grid.set_view)
                companion.grid.view_changed.connect(self.grid.set_view)

    def _lay_out(self) -> None:
        self._row = QWidget(self)
        self._row_layout = row_layout(self._row, spacing=4)
        self._row_layout.addWidget(self.view_bar, 1)
        self._choices = QWidget(self)
        choices = row_layout(self._choices, spacing=4)
        choices.addStretch(1)
        for widget in (self.range_button, self.buffer_choice, self.thumbnails_button):
            choices.addWidget(widget)
        self._row_layout.addWidget(self._choices)
        self.rows = PaneSplitter(Qt.Orientation.Vertical, self)
        self.both_sides = QWidget(self.rows)
        main_side = QWidget(self.both_sides)
        titled = column_layout(main_side, 4)
        self._main_title = text_label("", main_side, role="muted")
        self._main_title.hide()
        titled.addWidget(self._main_title)
        titled.addWidget(self.view_stack, 1)
        self._sides = row_layout(self.both_sides, 4)
        for side in (main_side, self.beside):
            # Halves, whatever is written in them: a longer title must not move the pictures.
            side.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Ignored)
            self._sides.addWidget(side, 1)
        self.beside.hide()
        self.rows.addWidget(self.both_sides)
        self.rows.addWidget(self.strip)
        self.rows.setStretchFactor(0, 1)
        self.rows.setChildrenCollapsible(False)
        self.rows.setSizes([430, 150])
        self._layout = column_layout(self, 4)
        self._layout.addWidget(self._row)
        self._layout.addWidget(self.rows, 1)
        self.setMinimumWidth(160)
        self.strip.hide()
        # Over the view, not beside it: what is opened must not move the pixel under the pointer.
        self.ranges.setProperty("role", "floating")
        self.ranges.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.ranges.hide()
        self.ranges.installEventFilter(self)

    def _thumbnails_button(self) -> QToolButton:
        button = flat_button("▦", "Thumbnails of all buffers", "Thumbnails of all buffers (T)", self)
        button.setCheckable(True)
        button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        button.clicked.connect(self.thumbnails_toggled)
        return button

    def set_presenting(self, is_presenting: bool) -> None:
        """Leave out the row of views and buffers, or bring it back."""
        self._is_presenting = is_presenting
        self._row.setVisible(not is_presenting)
        self._table_at_most = PRESENTED_AT_MOST if is_presenting else TABLE_AT_MOST
        self._views.show_figures(not is_presenting)
        self.compare_view.show_choices(not is_presenting)

    def eventFilter(self, watched: object, event: QEvent) -> bool:
        """Put the control of the range below its button when it opens."""
        if watched is self.ranges and event.type() == QEvent.Type.Show:
            self._place_ranges()
        return False

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the control of the range inside."""
        super().resizeEvent(event)
        self._arrange_row()
        self._place_ranges()
        self._show_beside()

    @Slot()
    def _arrange_row(self) -> None:
        """Put the choice of a buffer below the names of the views where they have no room beside each other.

        The room for it is always the same: what a step writes there must not move the picture.
        """
        needed = self.view_bar.sizeHint().width() + CHOICES_WIDTH * current_theme().text_px
        directions = QBoxLayout.Direction.LeftToRight, QBoxLayout.Direction.TopToBottom
        direction = directions[needed > self.width()]
        # The box of the buffers gives way before a view is hidden.
        self.view_bar.setMinimumWidth(0 if needed > self.width() else self.view_bar.sizeHint().width())
        self.buffer_choice.setMinimumWidth(LEAST_CHOICE * current_theme().text_px)
        if direction != self._row_layout.direction():
            self._row_layout.setDirection(direction)
            self._row.updateGeometry()
            self._layout.activate()

    @contextmanager
    def arranged_once(self) -> Iterator[None]:
        """Give what is shown its room at the end, when the width of the area and its view are chosen."""
        stacked = self.view_stack.layout()
        assert stacked is not None
        for layout in (self._layout, stacked):
            layout.setEnabled(False)
        try:
            yield
        finally:
            self._row_layout.activate()
            for layout in (self._layout, stacked):
                layout.setEnabled(True)
                layout.invalidate()
            self._layout.activate()
            companion = self._companion()
            if companion is not None and not self.beside.isHidden():
                self._share_sides(companion)

    def _place_ranges(self) -> None:
        size = self.ranges.sizeHint()
        width = min(max(size.width(), 420), self.width() - 8)
        self.ranges.setGeometry(self.width() - width - 4, self.rows.y() + 4, width, size.height())
        self.ranges.raise_()

    def show_buffers(self, buffers: Sequence[GridBuffer], main: GridBuffer, drawn: GridBuffer) -> None:
        """Offer the buffers of the stage at hand, the ``main`` one chosen; what is ``drawn`` may hide parts of it."""
        self.buffer_choice.show_buffers(buffers, main.name)
        self.range_button.show_buffer(main)
        self._main_title.setText(f"Buffer: {main.label}")
        self.grid.show_buffer(drawn)
        self.show_thumbnails(self.thumbnails_button.isChecked())

    def show_thumbnails(self, is_shown: bool) -> None:
        """Show or fold the strip of thumbnails; a stage of one buffer has none."""
        self.thumbnails_button.setChecked(is_shown)
        has_choice = self.buffer_choice.count() > 1
        self.thumbnails_button.setEnabled(has_choice)
        self.strip.setVisible(is_shown and has_choice)

    def _has_two_sides(self) -> bool:
        """Return whether the stage is shown in its own view, with another side, in an area wide enough for both."""
        stage = self._moment.cursor.stage
        companion = self._companion()
        is_own = self.current_view() == self._own_view(stage)
        if companion is None or not is_own or not companion.is_wanted(self._moment):
            return False
        if companion.is_alike and self._needs_all_the_room():
            return False
        room = max(self.width(), self.height()) if self._are_stacked(companion) else self.width()
        return room >= LEAST_ROOM_OF_BOTH * current_theme().text_px

    def _companion(self) -> Companion | None:
        """Return what stands beside the stage's own view."""
        stage = self._moment.cursor.stage
        trace = self._moment.stage_trace
        if stage in ("depth", "transform") and first_in_table(trace) < trace.steps.row_count:
            return self.companions["order"]
        if stage == "cull" and self.companions["occluders"].is_wanted(self._moment):
            return self.companions["occluders"]
        if stage == "shade" and self.companions["pass"].is_wanted(self._moment):
            return self.companions["pass"]
        return self.companions.get(stage)

    def _needs_all_the_room(self) -> bool:
        """Return whether a hall can read the values in the cells only where the picture stands alone."""
        raster, small = self._moment.document.raster, current_theme().small_px
        across, up = self.rows.width(), self.rows.height()

        def cell(width: float, height: float) -> float:
            around = AXES * small
            return min((width - around) / raster.columns, (height - around) / raster.rows)

        beside = max(cell(across / 2, up), cell(across, up / 2))
        return self._is_presenting and NUMBER_PART * beside < small <= NUMBER_PART * cell(across, up)

    def _are_stacked(self, companion: Companion) -> bool:
        """Return whether both sides are larger one above the other, or can only be read so."""
        if companion.wanted_size(self._moment, self.rows.width())[0] > self.rows.width() / 2:
            return True
        raster = self._moment.document.raster
        width, height = self.rows.width() / raster.columns, self.rows.height() / raster.rows
        below = 0.5
        if not companion.is_alike:
            if self.current_view() != "pixels" or not (table := self._height_below(companion)):
                return False
            below = table / self.rows.height()
        return min(width, (1 - below) * height) > STACKED_GAIN * min(width / 2, height)

    def _height_below(self, companion: Companion) -> int:
        """Return the height that a table gets below the picture; 0: it needs none."""
        wanted = companion.wanted_size(self._moment, self.rows.width())[1]
        return min(wanted, round(self._table_at_most * self.rows.height()))

    def refresh_beside(self, moment: Moment) -> None:
        """Show the other side of a stage beside its own view: the space entered, the texture, the new depths."""
        self._moment = moment
        self._show_beside()

    @Slot()
    def _show_beside(self) -> None:
        companion = self._companion() if self._has_two_sides() else None
        is_veiled = self._moment.is_predicting and companion is not None and not companion.is_all_done
        if companion is None or (is_veiled and self.gives_room):
            self.beside.hide()
            self._main_title.hide()
            return
        self._share_sides(companion)
        self._main_title.setVisible(companion.is_alike)
        if is_veiled:
            # It keeps its place, so that the main view keeps its own.
            self.beside.setCurrentWidget(self._veil)
        else:
            companion.refresh(self._moment)
            self.beside.setCurrentWidget(companion.widget)
        self.beside.show()

    def _share_sides(self, companion: Companion) -> None:
        """Put both sides next to each other or one above the other, a table as high as it needs."""
        is_stacked, shares = self._are_stacked(companion), (1, 1)
        directions = QBoxLayout.Direction.LeftToRight, QBoxLayout.Direction.TopToBottom
        self._sides.setDirection(directions[is_stacked])
        if is_stacked and not companion.is_alike:
            below = self._height_below(companion)
            shares = (self.rows.height() - self._sides.spacing() - below, below)
        for side, share in enumerate(shares):
            self._sides.setStretch(side, share)

    # Views.

    def _add_view(self, name: str, title: str, widget: QWidget) -> None:
        index = self.view_bar.addTab(title)
        self.view_bar.setTabData(index, name)
        self.view_stack.addWidget(widget)

    def view_names(self) -> list[str]:
        """Return the names of the main views."""
        return [self.view_bar.tabData(index) for index in range(self.view_bar.count())]

    def current_view(self) -> str:
        """Return the name of the main view that is shown."""
        return str(self.view_bar.tabData(self.view_bar.currentIndex()))

    def shown(self) -> QWidget:
        """Return the widget of the main view: of A | B the three pictures, without what is around."""
        widget = self.view_stack.currentWidget()
        if widget is self._pixels:
            return self._pixels.currentWidget() or self.grid
        return self.compare_view.figure if widget is self.compare_view or widget is None else widget

    def show_asked(self, picture: PixelGrid | None) -> None:
        """Show the picture on which a question is answered in place of the pixels; ``None``: the pixels again."""
        shown = picture or self.grid
        if self._pixels.indexOf(shown) < 0:
            self._pixels.addWidget(shown)
        self._pixels.setCurrentWidget(shown)
        self._choices.setEnabled(shown is self.grid)

    def show_view(self, name: str) -> None:
        """Show a main view by its name."""
        if name in self.view_names():
            self.view_bar.setCurrentIndex(self.view_names().index(name))

    def show_own_view(self) -> None:
        """Show the stage at hand in the view that was chosen for it, or else in its own."""
        stage = self._moment.cursor.stage
        self.show_view(self.views_by_hand.get(stage, self._own_view(stage)))

    def _own_view(self, stage: str) -> str:
        """Return the view that shows the work of a stage: polygons are clipped in the window, among pixels."""
        if stage == "clip" and self._moment.document.scene.corner_count > 3:
            return "pixels"
        return stage_of(stage).view

    def next_view(self) -> None:
        """Show the next main view, as the user."""
        self._choose_view((self.view_bar.currentIndex() + 1) % self.view_bar.count())

    @Slot(int)
    def _show_view(self, index: int) -> None:
        self.view_stack.setCurrentIndex(index)
        name = self.current_view()
        # A | B has a choice of its own, of what both have.
        self._choices.setHidden(name == "compare")
        if name in {view[0] for view in self._views.widgets}:
            self._views.show(name)
        announce(self.view_bar, f"View: {self.view_bar.tabText(index)}")
        self._show_beside()
        self.view_changed.emit(name)

    @Slot(int)
    def _choose_view(self, index: int) -> None:
        """Show a main view, and again whenever the stage is entered: the user's wish."""
        if index >= 0:
            self.views_by_hand[self._moment.cursor.stage] = self.view_bar.tabData(index)
            self.view_bar.setCurrentIndex(index)
            self.view_chosen.emit()

    def follow_stage(self, moment: Moment) -> None:
        """Show a stage that is entered in the view that was chosen for it, or else in its own; A | B stays."""
        self._moment, stage = moment, moment.cursor.stage
        if stage != self._viewed_stage:
            self._viewed_stage = stage
            if self.current_view() != "compare":
                self.show_own_view()


# Keys that do in the main view and the timeline what else the wheel and a drag do.


ZOOM = 1.25
"""Magnification of one press."""
NUDGE = 0.5
"""Pixels by which one press moves a vertex."""


def _view(page: "StepPage") -> PixelGrid | MovedArea | None:
    """Return the view that is shown: of several side by side the first, which the others follow."""
    shown = page.main_view()
    parts: list[QWidget] = [shown, *shown.findChildren(QWidget)]
    return next(
        (part for part in parts if isinstance(part, PixelGrid | MovedArea) and part.isVisible()), None
    )


def zoom(page: "StepPage", factor: float) -> None:
    """Magnify the view, or the timeline that has the keyboard."""
    view = _view(page)
    if page.timeline.bar.hasFocus():
        page.timeline.bar.zoom(1 / factor)
    elif view is not None:
        view.zoom_by(factor)


def move_view(page: "StepPage", across: int, up: int) -> None:
    """Look further to a side, by columns and rows (y up)."""
    view = _view(page)
    if page.timeline.bar.hasFocus():
        page.timeline.bar.move_view(across)
    elif view is not None:
        view.move_view(across, up)


def choose_vertex(page: "StepPage") -> None:
    """Choose the next vertex to move."""
    if page.grid.choose_next_vertex() is None:
        page.tell("No vertex can be moved here. Show the pixels of a triangle in focus (V, F).")
    else:
        _tell_vertex(page)


def nudge_vertex(page: "StepPage", across: int, up: int) -> None:
    """Move the chosen vertex by a part of a pixel."""
    if page.grid.nudge_vertex(NUDGE * across, NUDGE * up):
        _tell_vertex(page)
    else:
        page.tell("Choose a vertex first (Alt+N).")


def _tell_vertex(page: "StepPage") -> None:
    page.tell(f"{page.grid.vertex_text()}. Ctrl+Shift+arrows move it.")
