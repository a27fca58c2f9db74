"""The pixel grids of the stepping page: what they show of the trace, and what is done in them."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

from PySide6.QtCore import QObject, QPoint, Signal, Slot
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu, QWidget

from app.files.state_models import GridLook
from app.pages.page_bar import Page
from app.pages.step import grid_records
from app.pages.step.grid_overlays import Guesses, area_overlays, clip_overlays, polygon_overlays, step_mark
from app.pages.step.main_area import MainArea
from app.pages.step.stepping_presenter import SteppingPresenter
from app.session.document import Document
from app.session.document_edits import DragGestures
from app.session.moment import Moment
from app.session.passes import open_pass, passes_of, passes_to_open
from app.session.session import Session
from core import STAGES
from core.stages.declared import stage_of
from lessons.scene_edits import move_corner
from widgets.grid.geometry import GridGeometry
from widgets.grid.insets import OverlayLegend
from widgets.grid.layers import CenterOverlay, GridBuffer, Overlay
from widgets.grid.pixel_grid import PixelGrid
from widgets.grid.view import GridView

# Vertices dragged in pixel grids: the scene follows, and one drag is undone as a whole.


class VertexDrags(QObject):
    """Takes the drags in grids that show ``app.pages.step.grid_records.geometry_of`` to the session."""

    def __init__(
        self,
        session: Session,
        grids: Sequence[PixelGrid],
        focus: Callable[[], int | None],
        take: Callable[[Document, str], None],
        name: str,
        page: Page,
    ) -> None:
        """Listen to the grids.

        Parameters
        ----------
        focus : callable
            Returns the triangle with handles where the document has none in focus.
        take : callable
            Takes over a moved document and its gesture: ``Session.drag``, or ``Session.edit`` where the whole picture
            is looked at.
        name : str
            Of these drags, other than of those in other views.
        """
        super().__init__(page)
        self._page = page
        self._session, self._focus, self._take = session, focus, take
        self._drags = DragGestures(session, name, self._move, self)
        for grid in grids:
            grid.vertex_dragged.connect(self._drags.drag)
            grid.vertex_drag_finished.connect(self._drags.end)
            grid.vertex_drag_taken_back.connect(self._drags.take_back)

    def _move(self, vertex: int, x: float, y: float) -> None:
        document, latest, trace = self._session.document, self._session.latest, self._session.trace
        first_column, first_row, _, _ = trace.source.raster.bounds
        wanted = document.triangle if document.triangle is not None else self._focus()
        place, corner = divmod(vertex, trace.source.scene.corner_count)
        triangle = int(grid_records.outlined_triangles(trace, wanted)[place])
        position, size = (x + first_column, y + first_row), document.traced_scene.size
        try:
            scene = move_corner(latest.scene, triangle, corner, position, size)
            self._take(replace(latest, scene=scene), self._drags.name)
        except ValueError as error:
            self._page.refuse(f"The vertex was not moved: {error}")


# What can be done with one pixel: the menu of a right click in a grid.


class PixelMenu(QObject):
    """Pins the pixel, sets breakpoints at it, and goes to the first step of any stage that touches it."""

    origin_requested = Signal()
    """The user asks where the value of the pixel, which is pinned by now, comes from."""
    question_requested = Signal()
    """The value of the pixel, which is pinned by now, is to become a question."""

    def __init__(self, session: Session, stepping: SteppingPresenter, parent: QWidget) -> None:
        super().__init__(parent)
        self._session, self._stepping = session, stepping
        self.menu = QMenu(parent)
        self.menu.triggered.connect(self._run)
        self._pixel = (0, 0)

    @Slot(int, int, QPoint)
    def open_at(self, column: int, row: int, place: QPoint) -> None:
        """Offer what can be done with a pixel of the grid."""
        self.fill(column, row)
        self.menu.popup(place)

    def fill(self, column: int, row: int) -> None:
        """Make the entries for a pixel of the grid."""
        self._pixel = self._session.moment.pixel_at(column, row)
        self.menu.clear()
        heading = self.menu.addAction(f"Pixel ({self._pixel[0]}, {self._pixel[1]})")
        heading.setEnabled(False)
        is_pinned = self._session.pin == self._pixel
        self._add("Remove the pin" if is_pinned else "Pin", "pin")
        has_breakpoint = self._pixel in self._stepping.breaks.pixels
        self._add("Remove the breakpoint" if has_breakpoint else "Breakpoint", "breakpoint")
        self._add("Where does this value come from?", "origin")
        self._add("Ask for this value", "ask")
        planned = passes_of(self._session.document)
        for number in passes_to_open(self._session.moment, self._pixel) if planned else ():
            self._add(f"Open the pass “{planned[number].title}”", f"pass {number}")
        self.menu.addSeparator()
        for stage in STAGES[STAGES.index("raster") :]:
            self._add(f"Step here in {stage_of(stage).short_title}", stage)

    def _add(self, text: str, name: str) -> None:
        self.menu.addAction(text).setData(name)

    @Slot(QAction)
    def _run(self, action: QAction) -> None:
        name = action.data()
        if name == "pin":
            self._session.set_pin(None if self._session.pin == self._pixel else self._pixel)
        elif name == "breakpoint":
            self._session.set_pin(self._pixel)
            self._stepping.toggle_pixel_breakpoint()
        elif name == "origin":
            self._session.set_pin(self._pixel)
            self.origin_requested.emit()
        elif name == "ask":
            self._session.set_pin(self._pixel)
            self.question_requested.emit()
        elif name.startswith("pass "):
            self._session.set_pin(self._pixel)
            open_pass(self._session, int(name.removeprefix("pass ")))
        else:
            self._session.set_pin(self._pixel)
            self._stepping.step_into(name, *self._pixel)


OUTLINING = ("transform", "cull")
"""Stages in which outlines appear and vanish."""
PIECES = "tree pieces"
"""Key of the overlay that outlines the pieces of a BSP tree."""
CENTRES = "centres"
"""Key of the overlay that writes centres on the axes."""
DEFAULT_OVERLAYS = {
    "edges": frozenset({"edge lines", PIECES}),
    "bin": frozenset({"blocks", PIECES}),
    "clip": frozenset({"clip window", "clipped polygon", PIECES}),
    "raster": frozenset(
        {"rejected", "tie", "nan", "spans", "clip window", "clipped lines", "clipped polygon", PIECES}
    ),
    "shade": frozenset({*grid_records.LANE_MARKS, "unset", "nan"}),
    "depth": frozenset({"failed", "nan", PIECES}),
    "resolve": frozenset({"nan", "cutting edge", "cut polygon", "clipped polygon"}),
}
"""Overlays that are on at first, by stage."""


class GridPresenter(QObject):
    """Shows buffers, overlays and triangles of the session; takes hover, pin and drags back to it."""

    look_changed = Signal()
    """The user has chosen another buffer, overlay or colour range."""

    def __init__(self, session: Session, area: MainArea, legend: OverlayLegend, page: Page) -> None:
        super().__init__(page)
        self._page = page
        self._session = session
        self._area, self._legend, self._ranges = area, legend, area.ranges
        self._grid, self._strip = grid, strip = area.grid, area.strip
        self._chosen: dict[str, str] = {}
        self._own_ranges: dict[str, tuple[float, float]] = {}
        self._shown_overlays = dict(DEFAULT_OVERLAYS)
        self._drags = VertexDrags(session, (grid,), self._stepped_triangle, session.drag, "drag", page)
        for widget in (grid, strip):
            widget.pixel_hovered.connect(session.hover_place)
            widget.pixel_left.connect(session.end_hover)
            widget.pixel_clicked.connect(self._pin)
        grid.view_changed.connect(strip.set_view)
        strip.view_changed.connect(grid.set_view)
        strip.buffer_chosen.connect(self._choose_buffer)
        strip.strip_shown.connect(self.show_again)
        area.buffer_choice.buffer_chosen.connect(self._choose_buffer)
        legend.overlays_changed.connect(self._choose_overlays)
        area.ranges.range_changed.connect(self._choose_range)
        area.ranges.range_reset.connect(self._reset_range)
        area.ranges.fitting_changed.connect(self._keep_fitting)
        self._guesses: Guesses | None = None
        self._focus = 0
        self._moment = session.moment
        self._stepped_to = session.cursor
        self._outlined_at = ("", 0, True)
        self._geometry = grid_records.geometry_of(session.moment, 0)
        self.refresh_run(session.moment)

    # Showing.

    def refresh_run(self, moment: Moment) -> None:
        """Show another run: outlines, rulers, buffers."""
        before, now = self._moment.document, moment.document
        is_recut = now.scene.makes_positions and now.triangle_count != before.triangle_count
        self._moment, self._guesses = moment, None
        self._grid.set_pixel_center(now.settings.pixel_center)
        if is_recut and moment.triangle >= 0:
            self._focus = moment.triangle
        elif self._focus < now.triangle_count:
            # Only a step moves the handles to its triangle: an edit leaves them where the pointer has them.
            self._stepped_to = moment.cursor
        self._show_outlines()
        self.refresh_step(moment)
        self.refresh_pointing(moment)

    @Slot()
    def show_again(self) -> None:
        """Show the same step otherwise."""
        self.refresh_step(self._moment)

    def refresh_step(self, moment: Moment) -> None:
        """Show the state after the step just done."""
        self._moment, stage = moment, moment.cursor.stage
        if moment.cursor != self._stepped_to:
            self._guesses = None
            self.focus_on(moment.triangle)
        self._stepped_to = moment.cursor
        if self._outlined_at != self._geometry_step():
            self._show_outlines()
        buffers = grid_records.buffers_of(moment)
        names = [buffer.name for buffer in buffers]
        guesses = self._guesses
        chosen = self._chosen.get(stage, names[0]) if guesses is None else "coverage"
        main = self._ranged(buffers[names.index(chosen) if chosen in names else 0])
        self._area.show_buffers(buffers, main, main if guesses is None else guesses.buffer(main))
        if self._strip.isVisible():
            self._strip.show_buffers([self._ranged(buffer) for buffer in buffers])
            self._strip.show_chosen(main.name)
        self._grid.show_hidden(None if guesses is None else guesses.hidden)
        self._grid.show_samples(grid_records.sample_dots(moment))
        overlays = self._overlays() if guesses is None else guesses.overlays()
        shown = self._shown_in(stage)
        if guesses is not None:
            shown = frozenset(overlay.key for overlay in overlays) | (shown & {CENTRES})
            overlays = [*overlays, CenterOverlay(CENTRES)]
        self._legend.show_overlays(overlays, shown)
        self._grid.show_overlays([overlay for overlay in overlays if overlay.key in shown])
        mark = step_mark(moment)
        self._grid.show_step(mark)
        self._strip.show_step(mark)

    def look_only_at(self, stage: str, buffer: str) -> None:
        """Have a buffer of a stage shown alone; empty: its first one, with what is over it at first."""
        self._chosen = {stage: buffer} if buffer else {}
        self._own_ranges.clear()
        self._shown_overlays = dict(DEFAULT_OVERLAYS)
        if buffer:
            self._shown_overlays[stage] = frozenset({"nan"})

    def look(self) -> GridLook:
        """Return what the user has chosen to see."""
        view, overlays = self._grid.view(), self._shown_overlays
        return GridLook(
            buffers=dict(self._chosen),
            overlays={
                stage: sorted(keys) for stage, keys in overlays.items() if DEFAULT_OVERLAYS.get(stage) != keys
            },
            ranges=dict(self._own_ranges),
            fits_ranges=self._ranges.keeps_fitting(),
            hidden_buffers=sorted(self._strip.hidden_names()),
            middle=(view.x, view.y),
            zoom=view.zoom,
        )

    def show_look(self, look: GridLook) -> None:
        """Show what the user had chosen to see."""
        self._chosen = dict(look.buffers)
        self._shown_overlays = DEFAULT_OVERLAYS | {
            stage: frozenset(keys) for stage, keys in look.overlays.items()
        }
        self._own_ranges = dict(look.ranges)
        self._ranges.set_keeps_fitting(look.fits_ranges)
        self._strip.set_hidden_names(frozenset(look.hidden_buffers))
        view = GridView(*look.middle, look.zoom)
        self._grid.set_view(view)
        self._strip.set_view(view)
        self.show_again()

    def show_guesses(self, guesses: Guesses | None) -> None:
        """Show pixels that are held for covered, and cover up the others; ``None``: show the state of the step."""
        self._guesses = guesses
        self.show_again()

    def _stepped_triangle(self) -> int:
        return self._focus

    def focus_on(self, triangle: int) -> None:
        """Give a triangle coloured edges and handles, where the document has none in focus."""
        if triangle >= 0 and triangle != self._focus:
            self._focus = triangle
            if self._moment.document.triangle is None:
                self._show_outlines()

    @property
    def geometry(self) -> GridGeometry:
        """The outlines that are shown, in the columns and rows of the grid."""
        return self._geometry

    def _geometry_step(self) -> tuple[str, int, bool]:
        """Return what outlines depend on: the stages that move corners and drop triangles, and whose step it is."""
        moment, stage = self._moment, self._moment.cursor.stage
        at = (
            (stage, moment.rows_done)
            if stage in OUTLINING
            else (STAGES[-1], int(grid_records.is_presented(moment)))
        )
        return *at, moment.triangle in (-1, self._focus)

    def _show_outlines(self) -> None:
        self._outlined_at = self._geometry_step()
        self._geometry = geometry = grid_records.geometry_of(self._moment, self._focus)
        self._grid.show_geometry(geometry)
        self._strip.show_geometry(geometry)

    def refresh_pointing(self, moment: Moment) -> None:
        """Show pin and hover in all grids."""
        pin, hover = moment.pointed_places
        for widget in (self._grid, self._strip):
            widget.show_pin(pin)
            widget.show_hover(hover)

    def _shown_in(self, stage: str) -> frozenset[str]:
        """Return the keys of the overlays that are on in a stage."""
        return self._shown_overlays.get(stage, frozenset({"nan"}))

    def _overlays(self) -> list[Overlay]:
        moment = self._moment
        return [
            *grid_records.block_overlays(moment),
            *grid_records.mask_overlays(moment),
            *grid_records.span_overlays(moment),
            *area_overlays(moment),
            *clip_overlays(moment),
            *polygon_overlays(moment),
            *grid_records.edge_overlays(moment, self._geometry),
            *grid_records.piece_overlays(moment),
            CenterOverlay(CENTRES),
        ]

    def _ranged(self, buffer: GridBuffer) -> GridBuffer:
        # The range of a whole run tells values that are still to be predicted.
        is_fitted = self._ranges.keeps_fitting() or self._moment.is_predicting
        if is_fitted and buffer.name not in self._own_ranges:
            return replace(buffer, range=None)
        chosen = self._own_ranges.get(buffer.name)
        return replace(buffer, range=chosen) if chosen else buffer

    # Acting.

    def buffer_of(self, names: Iterable[str]) -> str:
        """Return the first of these names that a buffer of the stage has; empty: none has."""
        known = {buffer.name for buffer in grid_records.buffers_of(self._session.moment)}
        return next((name for name in names if name in known), "")

    def choose_buffer(self, name: str) -> None:
        """Show a buffer of the stage as the user chooses it."""
        self._choose_buffer(name)

    @Slot(int, int)
    def _pin(self, column: int, row: int) -> None:
        self._session.pin_place(column, row)
        if self._session.is_predicting:
            # The triangle that a pixel shows in the end is not known yet.
            return
        self.focus_on(int(self._session.trace.source.picture.primitive[row, column]))

    @Slot(str)
    def _choose_buffer(self, name: str) -> None:
        self._chosen[self._session.cursor.stage] = name
        self._show_choice()

    @Slot(object)
    def _choose_overlays(self, keys: frozenset[str]) -> None:
        now = self._session.cursor.stage
        if keys & {CENTRES} != self._shown_in(now) & {CENTRES}:
            # The axes are the same in all stages.
            for stage in STAGES:
                self._shown_overlays[stage] = self._shown_in(stage) ^ {CENTRES}
        self._shown_overlays[now] = keys
        self._show_choice()

    @Slot(float, float)
    def _choose_range(self, low: float, high: float) -> None:
        buffer = self._grid.buffer()
        if buffer is not None:
            self._own_ranges[buffer.name] = (low, high)
            self._show_choice()

    @Slot()
    def _reset_range(self) -> None:
        buffer = self._grid.buffer()
        if buffer is not None:
            self._own_ranges.pop(buffer.name, None)
            self._show_choice()

    @Slot(bool)
    def _keep_fitting(self, is_kept: bool) -> None:
        if is_kept:
            self._own_ranges.clear()
        self._show_choice()

    def _show_choice(self) -> None:
        self.show_again()
        self.look_changed.emit()
