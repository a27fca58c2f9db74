"""The stepping page: side panes, main view, inspector and the run at the bottom, around one session."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import partial

from PySide6.QtCore import QCoreApplication, QEvent, QThread, Signal, Slot
from PySide6.QtWidgets import QSplitter, QStackedWidget, QWidget

from app.pages.columns import StepColumns
from app.pages.lessons.presenter import LessonPresenter
from app.pages.page_bar import Caption, Page
from app.pages.step.ab.presenter import ComparePresenter
from app.pages.step.grid_presenter import GridPresenter, PixelMenu
from app.pages.step.inspector_column import InspectorColumn, StepNarrator
from app.pages.step.inspector_presenter import InspectorPresenter
from app.pages.step.listing_presenter import ListingPresenter
from app.pages.step.main_area import MainArea
from app.pages.step.navigator_presenter import NavigatorPresenter
from app.pages.step.panes import PANES, SIDE_PANES, RefreshOrder
from app.pages.step.questions import AskThis, PredictionPresenter
from app.pages.step.scene_pane import DepthTablePresenter, SceneOutlinePresenter
from app.pages.step.shader_presenter import ShaderPresenter, make_shader_pane
from app.pages.step.side_column import SideColumn
from app.pages.step.stepping_presenter import EventChoice, SteppingPresenter
from app.session.moment import Moment
from app.session.passes import open_pass
from app.session.session import Session
from app.views.stage_views import StageViews
from core.scene import AnyScene
from core.stages.declared import stage_of
from widgets.basics.accessibility import announce
from widgets.basics.controls import ElidedLabel, column_layout, row_layout
from widgets.basics.panes import SideTabs
from widgets.basics.settings_panel import SettingsPanel
from widgets.grid.insets import Navigator, OverlayLegend
from widgets.scene.depth_table import DepthTableEditor
from widgets.scene.outline import SceneOutline
from widgets.timeline.transport import Timeline

PANES_AT_FIRST = ("inspector", "details", "navigator", "run")
ANSWER_FIRST = "Answer first, or choose Reveal: that shows the answer."
NESTED_LAYOUTS = 5
"""Layouts around a part of the inspector, up to the window's."""
MARGINS, PRESENTED_MARGINS = (4, 0, 8, 4), (8, 8, 16, 8)
"""Around the page; presenting, a projector may cut off a little."""


class StepPage(Page):
    """All panes of the stepping page and their presenters."""

    look_changed = Signal()
    """The user has chosen to see something else: a buffer, an overlay, a view, another B."""
    panes_changed = Signal()
    """Other panes are shown now."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.session = session
        self.timeline = Timeline(self)
        self.outline, self.settings_panel = SceneOutline(self), SettingsPanel(self)
        self.depth_tables = DepthTableEditor(self)
        self.shader_pane = make_shader_pane(self)
        self.legend = OverlayLegend(self)
        self.views = StageViews(session, self)
        self.columns = StepColumns(self)
        self.main_area = MainArea(session, self.views, self.columns)
        self.grid, self.strip = self.main_area.grid, self.main_area.strip
        self.compare_view, self.ranges = self.main_area.compare_view, self.main_area.ranges
        self.column = column = InspectorColumn(self)
        self.side = self.read = SideColumn(column, self.columns)
        self.card, self.sentence, self.formula = column.card, column.sentence, column.formula
        self.listing, self.variables, self.history = column.listing, column.variables, column.history
        self.prediction = column.prediction

        self.stepping = SteppingPresenter(session, self.timeline, self)
        self.events = EventChoice(self.stepping, self.timeline, self)
        self.inspector = InspectorPresenter(session, self.stepping, column, self)
        self.grids = GridPresenter(session, self.main_area, self.legend, self)
        self.scene = SceneOutlinePresenter(session, self.outline, self.settings_panel, self)
        self.table_editing = DepthTablePresenter(session, self.depth_tables, self)
        self.shading = ShaderPresenter(session, self.shader_pane, self)
        self.comparing = ComparePresenter(session, self.compare_view, self)
        self.editing = ListingPresenter(session, self.comparing, self.inspector, column, self)
        self.predicting = PredictionPresenter(session, self.prediction, self.grid, self.grids, self)
        self.narrator = StepNarrator(session.cursor, column, self.grid, self.timeline, self)
        self.navigator = Navigator(self.grid)
        self.navigation = NavigatorPresenter(session, self.navigator, self.grid, self)
        self.navigator.close_requested.connect(partial(self.toggle_pane, "navigator"))
        self.pixel_menu = PixelMenu(session, self.stepping, self)
        self.pixel_menu.origin_requested.connect(self.go_to_writer)
        self.asking = AskThis(session, self)
        self.pixel_menu.question_requested.connect(self.ask_value)
        self.variables.picture_requested.connect(self.show_variable)
        for pixels in (self.grid, self.strip, self.compare_view.linked):
            pixels.pixel_clicked.connect(self._show_clicked)
        self.grid.pixel_menu_requested.connect(self.pixel_menu.open_at)
        self.strip.pixel_menu_requested.connect(self.pixel_menu.open_at)
        self.main_area.view_changed.connect(self._follow_view)
        self.main_area.thumbnails_toggled.connect(self._toggle_thumbnails)
        self.stepping.stepped_alone = self.comparing.steps_alone
        self.inspector.ahead.is_drawing = lambda: self._is_drawing() or self.lessons.is_working
        self.views.message_sent.connect(self.message_sent)
        self.main_area.view_chosen.connect(self.look_changed)
        self.grids.look_changed.connect(self.look_changed)
        self.comparing.look_changed.connect(self.look_changed)
        self.shading.comparison_requested.connect(self._compare_scene)
        self.comparing.meeting.told.connect(self.shading.show_divergence)
        self.views.refused.connect(self.edit_refused)
        self.lessons = LessonPresenter(self)
        self.lessons.place_changed.connect(self._follow_lesson)
        self._settles = True
        """Whether layouts are settled after each change; else something sees to it after several."""
        self._desk_panes: list[str] | None = None
        """While presenting, the panes that come back after it."""
        self._lay_out()
        self.show_panes(PANES_AT_FIRST)
        self._order = RefreshOrder(self)

    @Slot()
    def _show_clicked(self) -> None:
        """Show the history of a clicked pixel, also of one that was pinned before."""
        self.column.show_history(self.session.moment)

    @Slot(object, object, str)
    def _compare_scene(self, differences: dict[str, str | int], scene: AnyScene, title: str) -> None:
        """Step the scene beside another one, at the stage at hand."""
        self.show_view("compare")
        self.comparing.show_mistake(differences, scene, title)

    def begin_anew(self, moment: Moment) -> None:
        """Show all pixels of a scene that was opened, and a B that has an effect there."""
        self.grid.fit()
        self.compare_view.grids[0].fit()
        self.comparing.begin_anew(moment)
        self.editing.begin_anew()
        self.shading.begin_anew()

    # Layout.

    def _lay_out(self) -> None:
        self.side_tabs = SideTabs(self)
        self.side_panes = QStackedWidget(self.columns)
        for pane in SIDE_PANES:
            self.side_tabs.add_tab(pane.name, pane.title, f"Show or fold away: {pane.title} ({pane.key})")
            self.side_panes.addWidget(pane.make(self))
        self.side_tabs.pane_chosen.connect(self.toggle_pane)
        self.columns.show_columns(self.side_panes, self.main_area, self.side)
        self._page_layout = page = column_layout(self, 4, margins=MARGINS)
        self.place = ElidedLabel(self)
        self.place.setAccessibleDescription("Stage, step and scene")
        self.place.hide()
        page.addWidget(self.place)
        row = row_layout(spacing=4)
        row.addWidget(self.side_tabs)
        row.addWidget(self.columns, 1)
        page.addLayout(row, 1)
        page.addWidget(self.timeline)

    @Slot()
    def _follow_lesson(self) -> None:
        """Name the step of the lesson that is shown, or what is open without one."""
        self.show_place(self.session.moment)

    def show_place(self, moment: Moment) -> None:
        """Name stage, step and scene, or lesson and step; while predicting, not how many steps are left."""
        if self.lessons.place:
            self.place.setText(self.lessons.place)
            return
        position, count = moment.cursor.position, moment.steps.count
        total = "?" if moment.is_predicting and not moment.is_stage_done else f"{count:,}"
        parts = (stage_of(moment.cursor.stage).short_title, f"step {position:,} of {total}")
        self.place.setText(" · ".join((*parts, *filter(None, [moment.document.title]))))

    def settle_layouts(self, moment: Moment | None = None) -> None:
        """Lay out now what has another size: each layout asks the one around it, and in between all is painted.

        What has just been shown asks to be painted, too: else it may be painted once before and once after that.
        """
        if not self._settles:
            return
        for _ in range(NESTED_LAYOUTS):
            QCoreApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)
        QCoreApplication.sendPostedEvents(None, QEvent.Type.UpdateLater.value)

    @contextmanager
    def laid_out_once(self) -> Iterator[None]:
        """Lay out what is shown meanwhile at the end."""
        self._settles = False
        self.side.put_off(True)
        try:
            yield
        finally:
            self._settles = True
            self.side.put_off(False)
            self.settle_layouts()

    # Panes.

    def shown_panes(self) -> list[str]:
        """Return the names of the panes that are shown, of `PANES`."""
        side = SIDE_PANES[self.side_panes.currentIndex()].name if not self.side_panes.isHidden() else ""
        is_shown = {
            side: True,
            "inspector": not self.column.isHidden(),
            "details": not self.column.variables.isHidden(),
            "thumbnails": self.main_area.thumbnails_button.isChecked(),
            "navigator": self.navigation.is_wanted,
            "run": not self.timeline.isHidden(),
        }
        return [pane.name for pane in PANES if is_shown.get(pane.name)]

    def desk_panes(self) -> list[str]:
        """Return the names of the panes that are shown at the desk, now or when presenting ends."""
        return self.shown_panes() if self._desk_panes is None else self._desk_panes

    def show_desk_panes(self, names: Iterable[str]) -> None:
        """Show these panes at the desk, now or when presenting ends."""
        if self._desk_panes is None:
            self.show_panes(names)
        else:
            self._desk_panes = list(names)

    def show_panes(self, names: Iterable[str]) -> None:
        """Show these panes and fold the others away; of the side panes the first one named."""
        known = {pane.name for pane in PANES}
        names = [name for name in names if name in known]
        sides = [pane.name for pane in SIDE_PANES]
        side = next((name for name in names if name in sides), "")
        if side:
            self.side_panes.setCurrentIndex(sides.index(side))
        self.columns.show_side(bool(side))
        self.side_tabs.show_open(side)
        self.column.setVisible("inspector" in names)
        self.column.variables.setVisible("details" in names)
        self.timeline.setVisible("run" in names)
        self.main_area.show_thumbnails("thumbnails" in names)
        self.navigation.set_wanted("navigator" in names)
        self.columns.spread()
        self.panes_changed.emit()

    @Slot(str)
    def toggle_pane(self, name: str) -> None:
        """Show a pane, in place of another one at the side, or fold it away."""
        shown = self.shown_panes()
        if name in shown:
            self.show_panes([other for other in shown if other != name])
        else:
            self.show_panes([name, *shown])
        announce(self, f"{name.capitalize()} {'folded away' if name in shown else 'shown'}")

    @Slot()
    def _toggle_thumbnails(self) -> None:
        # The button has changed already.
        self.show_panes(self.shown_panes())

    @property
    def is_presenting(self) -> bool:
        """Whether it is shown in front of a class."""
        return self._desk_panes is not None

    def set_presenting(self, is_presenting: bool) -> None:
        """Leave out all that does not show the step, or bring it back, with the panes of the desk."""
        panes = self.desk_panes()
        self._desk_panes = panes if is_presenting else None
        self.side_tabs.setVisible(not is_presenting)
        self.place.setVisible(is_presenting)
        self.show_place(self.session.moment)
        self.stepping.stops_at_ends = is_presenting
        self._page_layout.setContentsMargins(*(PRESENTED_MARGINS if is_presenting else MARGINS))
        self.main_area.set_presenting(is_presenting)
        self.column.set_presenting(is_presenting)
        self.side.set_presenting(is_presenting)
        self.columns.set_presenting(is_presenting)
        self.lessons.set_presenting(is_presenting)
        if not is_presenting:
            self.show_panes(panes)

    # Views.

    @Slot(str)
    def _follow_view(self, name: str) -> None:
        self.comparing.set_active(name == "compare")

    def show_own_view(self) -> None:
        """Show the stage at hand in the view that was chosen for it, or else in its own."""
        self.main_area.show_own_view()

    def focus_panes(self) -> list[QWidget]:
        """Return the views' row, a lesson, the run, the inspector, and what is at the side."""
        return [self.main_area, *self.side.panes(), self.timeline, self.column, self]

    def view_names(self) -> list[str]:
        """Return the names of the main views."""
        return self.main_area.view_names()

    def current_view(self) -> str:
        """Return the name of the main view that is shown."""
        return self.main_area.current_view()

    def main_view(self) -> QWidget:
        """Return the widget of the main view that is shown: the grid, or the three pictures, without what is around."""
        return self.main_area.shown()

    def show_view(self, name: str) -> None:
        """Show a main view by its name."""
        self.main_area.show_view(name)

    def pointed_text(self, pixel: tuple[int, int]) -> str:
        """Return the value of the main grid at a pixel of the traced picture."""
        buffer, moment = self.grid.buffer(), self.session.moment
        if buffer is None or not moment.has_pixel(pixel) or moment.is_predicting:
            return ""
        return f"{buffer.label}: {self.grid.value_text(moment.place_of(pixel))}"

    def toggle_compare(self) -> None:
        """Show A | B | difference, or the pixels again."""
        self.show_view("pixels" if self.current_view() == "compare" else "compare")

    def toggle_predicting(self) -> None:
        """Hide what comes next, or show it again; a lesson's question is not ended by a key that asks nothing."""
        if self.lessons.is_asking:
            self.tell(ANSWER_FIRST)
        else:
            self.set_predicting(not self.session.is_predicting)

    def set_predicting(self, is_on: bool) -> None:
        """Hide what comes next until it has been predicted, or show everything."""
        if is_on == self.session.is_predicting:
            return
        if is_on:
            self.show_view("pixels")
            self.show_panes(["inspector", *self.shown_panes()])
        self.column.show_prediction(is_on)
        self.predicting.set_active(is_on)
        if not is_on:
            self.main_area.show_own_view()

    def _is_drawing(self) -> bool:
        """Return whether a picture is being drawn in the background."""
        return self.views.is_drawing or self.navigation.is_drawing

    def settle(self) -> None:
        """Wait until everything that is drawn a moment later (formulas, the 3D view) is there."""
        for _ in range(100):
            QCoreApplication.processEvents()
            if self.formula.is_complete():
                break
            QThread.msleep(10)
        self.settle_layouts()
        parts = (self.lessons, self.editing.outcome, self.shading)
        while self._is_drawing() or self.comparing.is_drawing or any(part.is_working for part in parts):
            QCoreApplication.processEvents()
            QThread.msleep(5)

    @Slot()
    def go_to_writer(self) -> None:
        """Go to the step that wrote the value of the main grid at the pinned pixel."""
        buffer = self.grid.buffer()
        if buffer is not None:
            self.inspector.go_to_writer(buffer.name, buffer.label)

    def open_pass(self) -> None:
        """Open what is drawn before the picture as a document of its own."""
        try:
            open_pass(self.session)
        except ValueError as problem:
            self.refuse(str(problem))

    @Slot(str)
    def show_variable(self, name: str) -> None:
        """Show a variable, or a component of one, in every pixel; one of a vertex shader where it is interpolated."""
        moment, whole = self.session.moment, name.partition(".")[0]
        if moment.cursor.stage == "transform" and f"out {whole}" in {
            track.name for track in moment.trace.stage("interpolate").buffers
        }:
            self.session.set_stage("interpolate")
            name = whole = f"out {whole}"
        buffer = self.grids.buffer_of((name, f"{name}.x", whole))
        if buffer:
            self.show_view("pixels")
            self.grids.choose_buffer(buffer)
        else:
            self.tell(f"No pixel has a value of {name} at this stage.")

    @Slot()
    def ask_value(self) -> None:
        """Ask for the value of the main grid at the pinned pixel."""
        buffer = self.grid.buffer()
        if buffer is not None:
            self.asking.ask_value(buffer.name)

    # As a page of the window.

    def caption(self) -> Caption:
        """Return the sentence and the formula of the step just done."""
        return Caption(self.sentence.text(), self.formula.formula())

    def fit(self) -> None:
        """Show all pixels in the main view."""
        (self.compare_view.grids[0] if self.current_view() == "compare" else self.grid).fit()

    def flip(self) -> None:
        """Swap the pictures of A and B until the key is released."""
        if self.current_view() == "compare":
            self.compare_view.flip_while_held()
        else:
            self.tell("X swaps the pictures of A and B while it is held. Ctrl+D shows them.")

    def dismiss(self) -> bool:
        """Stop playing, or else take the pin away."""
        if self.timeline.is_playing():
            self.timeline.show_playing(False)
            return True
        if self.comparing.is_drawing:
            self.editing.leave()
            return True
        if self.shading.is_working:
            self.shading.leave()
            return True
        has_pin = self.session.pin is not None
        self.session.set_pin(None)
        return has_pin

    def is_busy(self) -> bool:
        """Return whether it plays."""
        return self.timeline.is_playing()

    def leave(self) -> None:
        """Play no further."""
        self.timeline.show_playing(False)

    def stop(self) -> None:
        """Play no further, and end drawing in the background."""
        self.timeline.show_playing(False)
        self.lessons.stop()
        self.inspector.ahead.stop()
        self.views.stop()
        self.navigation.stop()
        super().stop()

    def splitters(self) -> dict[str, QSplitter]:
        """Return what divides the panes."""
        return {
            "step columns": self.columns,
            "step thumbnails": self.main_area.rows,
            "step inspector": self.column.rows,
        }
