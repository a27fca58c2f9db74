"""The stepping page: scene, grids, inspector and timeline around one session."""

from math import isclose

from PySide6.QtCore import QCoreApplication, Qt, QThread, Signal, Slot
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QComboBox,
    QLabel,
    QScrollArea,
    QSizePolicy,
    QSplitter,
    QStackedWidget,
    QTabBar,
    QTabWidget,
    QWidget,
)

from app.pages.page_bar import Handlers, Page
from app.pages.step.ab_presenter import ComparePresenter
from app.pages.step.actions import step_handlers
from app.pages.step.grid_presenter import GridPresenter
from app.pages.step.inspector_presenter import InspectorPresenter
from app.pages.step.narrator import StepNarrator
from app.pages.step.pixel_menu import PixelMenu
from app.pages.step.prediction_presenter import PredictionPresenter
from app.pages.step.scene_outline_presenter import SceneOutlinePresenter
from app.pages.step.stepping_presenter import EVENT_TITLES, SteppingPresenter
from app.session.session import Session
from app.views.stage_views import StageViews
from core.stages.declared import stage_of
from widgets.basics.controls import column_layout, flat_button
from widgets.basics.scene_outline import SceneOutline
from widgets.basics.settings_panel import SettingsPanel
from widgets.basics.theme import current_theme, theme_notifier
from widgets.grid.buffer_strip import BufferStrip
from widgets.grid.compare_view import CompareView
from widgets.grid.overlay_legend import OverlayLegend
from widgets.grid.pixel_grid import PixelGrid
from widgets.grid.range_control import RangeControl
from widgets.inspector.formula_view import FormulaView
from widgets.inspector.history_view import PixelHistory
from widgets.inspector.listing import ListingView
from widgets.inspector.prediction import PredictionView
from widgets.inspector.variables import VariablesView
from widgets.timeline.stage_card import StageCardView
from widgets.timeline.transport import Timeline


class StepPage(Page):
    """All panes of the stepping page and their presenters."""

    look_changed = Signal()
    """The user has chosen to see something else: a buffer, an overlay, a view, another B."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.session = session
        self.timeline = Timeline(self)
        self.outline, self.settings_panel = SceneOutline(self), SettingsPanel(self)
        self.grid, self.strip = PixelGrid(self), BufferStrip(self)
        self.legend, self.ranges = OverlayLegend(self), RangeControl(self)
        self.card, self.formula, self.listing = StageCardView(self), FormulaView(self), ListingView(self)
        self.variables, self.history = VariablesView(self), PixelHistory(self)
        self.prediction, self.compare_view = PredictionView(self), CompareView(self)
        self.sentence = QLabel(self)
        self.event_box = QComboBox(self)

        self.stepping = SteppingPresenter(session, self.timeline, self)
        self.inspector = InspectorPresenter(
            session,
            self.stepping,
            self.sentence,
            self.card,
            self.formula,
            self.listing,
            self.variables,
            self.history,
            self,
        )
        self.grids = GridPresenter(session, self.grid, self.strip, self.legend, self.ranges, self)
        self.scene = SceneOutlinePresenter(session, self.outline, self.settings_panel, self)
        self.views = StageViews(session, self)
        self.comparing = ComparePresenter(session, self.compare_view, self)
        self.predicting = PredictionPresenter(session, self.prediction, self.grid, self.grids, self)
        self.narrator = StepNarrator(session, self.sentence, self.formula, self.listing, self.grid, self)
        self.pixel_menu = PixelMenu(session, self.stepping, self)
        self.grid.pixel_menu_requested.connect(self.pixel_menu.open_at)
        self.strip.pixel_menu_requested.connect(self.pixel_menu.open_at)
        self.stepping.message_sent.connect(self.message_sent)
        self.grids.look_changed.connect(self.look_changed)
        self.comparing.look_changed.connect(self.look_changed)
        for refusal in (
            self.scene.edit_refused,
            self.views.refused,
            self.grids.edit_refused,
            self.comparing.edit_refused,
        ):
            refusal.connect(self.edit_refused)
        self._lay_out()

    # Layout.

    def _lay_out(self) -> None:
        self.columns = QSplitter(Qt.Orientation.Horizontal, self)
        self.columns.addWidget(self._left())
        self.columns.addWidget(self._middle())
        self.columns.addWidget(self._right())
        self.columns.setStretchFactor(1, 1)
        self.columns.setSizes([296, 616, 352])
        self.columns.setChildrenCollapsible(True)
        page = column_layout(self, 8, margins=(8, 4, 8, 8))
        page.addWidget(self.columns, 1)
        self._add_run_to()
        page.addWidget(self.timeline)

    def _left(self) -> QWidget:
        scroll = QScrollArea(self)
        scroll.setWidgetResizable(True)
        scroll.setFrameShape(QScrollArea.Shape.NoFrame)
        scroll.setWidget(self.settings_panel)
        self.left_tabs = QTabWidget(self)
        self.left_tabs.setDocumentMode(True)
        self.left_tabs.tabBar().setDrawBase(False)
        # What a pane holds must not move its borders: stages have longer and shorter texts.
        self.left_tabs.setMinimumWidth(200)
        self.left_tabs.addTab(self.outline, "Scene")
        self.left_tabs.addTab(scroll, "Methods")
        self.left_tabs.addTab(self._overlay_pane(), "Overlays")
        return self.left_tabs

    def _overlay_pane(self) -> QWidget:
        pane = QWidget(self)
        layout = column_layout(pane, 8, margins=(8, 8, 8, 8))
        layout.addWidget(self.legend)
        layout.addStretch(1)
        return pane

    def _middle(self) -> QWidget:
        self.view_bar = QTabBar(self)
        self.view_bar.setDrawBase(False)
        self.view_bar.setExpanding(False)
        self.view_bar.setAccessibleName("Main view")
        self.view_stack = QStackedWidget(self)
        pixels = QWidget(self)
        under = column_layout(pixels, 4)
        under.addWidget(self.grid, 1)
        under.addWidget(self.ranges)
        self._add_view("pixels", "Pixels", pixels)
        for name, title, widget in self.views.widgets:
            self._add_view(name, title, widget)
        self._add_view("compare", "A | B", self.compare_view)
        self.view_bar.currentChanged.connect(self._show_view)
        self.views_by_hand: dict[str, str] = {}
        self._viewed_stage = self.session.cursor.stage
        self.view_bar.tabBarClicked.connect(self._choose_view)
        self.session.cursor_changed.connect(self._follow_stage)
        top = QWidget(self)
        layout = column_layout(top, 4)
        layout.addWidget(self.view_bar)
        layout.addWidget(self.view_stack, 1)
        self.rows = QSplitter(Qt.Orientation.Vertical, self)
        self.rows.setMinimumWidth(320)
        self.rows.addWidget(top)
        self.rows.addWidget(self.strip)
        self.rows.setStretchFactor(0, 1)
        self.rows.setSizes([430, 150])
        return self.rows

    def _add_view(self, name: str, title: str, widget: QWidget) -> None:
        index = self.view_bar.addTab(title)
        self.view_bar.setTabData(index, name)
        self.view_stack.addWidget(widget)

    def _right(self) -> QWidget:
        self.sentence.setWordWrap(True)
        self.sentence.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.sentence.setProperty("role", "sentence")
        self.sentence.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        self.sentence.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        self.sentence.setAccessibleDescription("What the step did")
        self.step_pane = QWidget(self)
        layout = column_layout(self.step_pane, 4)
        layout.addWidget(self.card)
        layout.addWidget(self.sentence)
        layout.addWidget(self.formula)
        layout.addStretch(1)
        self.detail_tabs = QTabWidget(self)
        self.detail_tabs.setDocumentMode(True)
        self.detail_tabs.tabBar().setDrawBase(False)
        self.detail_tabs.addTab(self.variables, "Variables")
        self.detail_tabs.addTab(self.history, "Pixel history")
        self.session.pin_changed.connect(self._show_history)
        self.inspector_rows = QSplitter(Qt.Orientation.Vertical, self)
        self.inspector_rows.setMinimumWidth(240)
        self.inspector_rows.addWidget(self.step_pane)
        self.inspector_rows.addWidget(self.listing)
        self.inspector_rows.addWidget(self.detail_tabs)
        self.inspector_rows.setStretchFactor(1, 1)
        self.inspector_rows.setStretchFactor(2, 2)
        self.inspector_rows.setSizes([165, 135, 270])
        self.card.card_folded.connect(self._fit_step_pane)
        self.session.cursor_changed.connect(self._fit_step_pane)
        self.session.document_changed.connect(self._fit_step_pane)
        self._text_px = current_theme().text_px
        self._owed_growth = 1.0
        theme_notifier().theme_changed.connect(self._follow_theme)
        self._fit_step_pane()
        column = QWidget(self)
        questions_first = column_layout(column, 8)
        # Here, and not below the grid, which keeps its place while it is asked about.
        questions_first.addWidget(self.prediction)
        questions_first.addWidget(self.inspector_rows, 1)
        self.prediction.hide()
        return column

    @Slot()
    def _follow_theme(self) -> None:
        """Give the side panes as much more room as their text has grown."""
        before, self._text_px = self._text_px, current_theme().text_px
        self._owed_growth *= self._text_px / before
        self._grow_sides()
        self._fit_step_pane()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Give the side panes what they could not have in a smaller window: large type comes before the full screen."""
        super().resizeEvent(event)
        self._grow_sides()

    def _grow_sides(self) -> None:
        """Widen or narrow the side panes by the growth that they are owed, if the picture keeps a third."""
        left, middle, right = self.columns.sizes()
        sides = round(left * self._owed_growth), round(right * self._owed_growth)
        if not isclose(self._owed_growth, 1.0) and 0 < sum(sides) < 0.66 * (left + middle + right):
            self._owed_growth = 1.0
            self.columns.setSizes([sides[0], left + middle + right - sum(sides), sides[1]])

    @Slot()
    def _fit_step_pane(self) -> None:
        """Keep room for three lines of the sentence and two of the formula, whatever the size of the type."""
        line = round(1.25 * current_theme().text_px)
        self.sentence.setMinimumHeight(3 * line)
        width = max(self.inspector_rows.width(), 240)
        card = (
            self.card.fold_button.sizeHint().height()
            if self.card.is_folded()
            else self.card.heightForWidth(width)
        )
        wanted = card + 3 * line + 4 * line + 8
        if wanted != self.step_pane.minimumHeight():
            self.step_pane.setMinimumHeight(wanted)

    def _add_run_to(self) -> None:
        """Put the choice of events, with a button to each side, above the timeline's bar."""
        for name, title in EVENT_TITLES.items():
            self.event_box.addItem(f"Run to: {title}", name)
        self.event_box.setAccessibleName("Kind of event")
        self.event_box.setToolTip("What N (next) and Shift+N (previous) run to")
        self.event_box.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.event_box.activated.connect(self._choose_event)
        buttons = []
        for text, name, key in (("<", "Previous event", "Shift+N"), (">", "Next event", "N")):
            button = flat_button(text, name, f"{name} of this kind ({key})", self)
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
            buttons.append(button)
        self.previous_event_button, self.next_event_button = buttons
        self.previous_event_button.clicked.connect(self._run_back)
        self.next_event_button.clicked.connect(self._run_on)
        for widget in (self.previous_event_button, self.event_box, self.next_event_button):
            self.timeline.add_control(widget)

    @Slot()
    def _run_back(self) -> None:
        self.stepping.run_to_event(-1)

    @Slot()
    def _run_on(self) -> None:
        self.stepping.run_to_event(1)

    # Views.

    @Slot()
    def _show_history(self) -> None:
        """Bring the history of a pixel forward when one is pinned."""
        if self.session.pin is not None and not self.session.is_predicting:
            self.detail_tabs.setCurrentWidget(self.history)

    @Slot(int)
    def _show_view(self, index: int) -> None:
        name = self.view_bar.tabData(index)
        self.view_stack.setCurrentIndex(index)
        if name in {view[0] for view in self.views.widgets}:
            self.views.show(name)
        self.comparing.set_active(name == "compare")

    @Slot(int)
    def _choose_view(self, index: int) -> None:
        """Show a main view, and again whenever the stage is entered: the user's wish."""
        if index >= 0:
            self.views_by_hand[self.session.cursor.stage] = self.view_bar.tabData(index)
            self.view_bar.setCurrentIndex(index)
            self.look_changed.emit()

    @Slot()
    def _follow_stage(self) -> None:
        """Show a stage that is entered in the view that was chosen for it, or else in its own; A | B stays."""
        stage = self.session.cursor.stage
        if stage != self._viewed_stage:
            self._viewed_stage = stage
            if self.current_view() != "compare":
                self.show_own_view()

    def show_own_view(self) -> None:
        """Show the stage at hand in the view that was chosen for it, or else in its own."""
        stage = self.session.cursor.stage
        self.show_view(self.views_by_hand.get(stage, stage_of(stage).view))

    def view_names(self) -> list[str]:
        """Return the names of the main views."""
        return [self.view_bar.tabData(index) for index in range(self.view_bar.count())]

    def current_view(self) -> str:
        """Return the name of the main view that is shown."""
        return str(self.view_bar.tabData(self.view_bar.currentIndex()))

    def main_view(self) -> QWidget:
        """Return the widget of the main view that is shown: the grid, or the three pictures, without what is around."""
        if self.current_view() == "compare":
            return self.compare_view.figure
        shown = self.view_stack.currentWidget()
        return self.grid if shown is None or self.current_view() == "pixels" else shown

    def show_view(self, name: str) -> None:
        """Show a main view by its name."""
        if name in self.view_names():
            self.view_bar.setCurrentIndex(self.view_names().index(name))

    def pointed_text(self, pixel: tuple[int, int]) -> str:
        """Return the value of the main grid at a pixel of the traced picture."""
        buffer = self.grid.buffer()
        if buffer is None or not self.session.has_pixel(pixel) or self.session.is_predicting:
            return ""
        first_column, first_row, _, _ = self.session.trace.source.raster.bounds
        return f"{buffer.label}: {self.grid.value_text((pixel[0] - first_column, pixel[1] - first_row))}"

    def next_view(self) -> None:
        """Show the next main view."""
        self._choose_view((self.view_bar.currentIndex() + 1) % self.view_bar.count())

    def toggle_compare(self) -> None:
        """Show A | B | difference, or the pixels again."""
        self.show_view("pixels" if self.current_view() == "compare" else "compare")

    def set_predicting(self, is_on: bool) -> None:
        """Hide what comes next until it has been predicted, or show everything."""
        if is_on:
            self.show_view("pixels")
        self.prediction.setVisible(is_on)
        self.predicting.set_active(is_on)

    @Slot(int)
    def _choose_event(self, index: int) -> None:
        self.stepping.event_kind = self.event_box.itemData(index)

    def choose_event(self, name: str) -> None:
        """Choose the kind of event that N runs to."""
        if name in EVENT_TITLES:
            self.event_box.setCurrentIndex(self.event_box.findData(name))
            self.stepping.event_kind = name

    def settle(self) -> None:
        """Wait until everything that is drawn a moment later (formulas, the 3D view) is there."""
        for _ in range(100):
            QCoreApplication.processEvents()
            if self.formula.is_complete():
                break
            QThread.msleep(10)
        while self.views.is_drawing:
            QCoreApplication.processEvents()
            QThread.msleep(5)

    # As a page of the window.

    def handlers(self) -> Handlers:
        """Return what the keys of this page do."""
        return {
            **step_handlers(self.session, self.stepping, self.timeline),
            "fit_view": self.grid.fit,
            "next_view": self.next_view,
            "compare": self.toggle_compare,
        }

    def dismiss(self) -> bool:
        """Stop playing, or else take the pin away."""
        if self.timeline.is_playing():
            self.timeline.show_playing(False)
            return True
        has_pin = self.session.pin is not None
        self.session.set_pin(None)
        return has_pin

    def leave(self) -> None:
        """Play no further."""
        self.timeline.show_playing(False)

    def stop(self) -> None:
        """Play no further, and end drawing in the background."""
        self.timeline.show_playing(False)
        self.comparing.stop()
        self.views.stop()

    def splitters(self) -> dict[str, QSplitter]:
        """Return what divides the panes."""
        return {"columns": self.columns, "rows": self.rows, "inspector": self.inspector_rows}
