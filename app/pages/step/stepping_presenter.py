"""Stepping: the timeline with its chapters, and running to events, breakpoints and bookmarks."""

from collections.abc import Callable, Iterable
from functools import partial

import numpy as np
from PySide6.QtCore import QObject, Qt, Signal, Slot
from PySide6.QtWidgets import QComboBox

from app.files.state_models import Bookmark, Breakpoints
from app.pages.page_bar import Page
from app.pages.step.kept_look import Bookmarks, Breaks, line_positions
from app.session.moment import Cursor, Moment, stepped
from app.session.session import Session
from app.views.stage_views import chapters_of
from core import STAGES
from core.coverage.fills import effective_fill
from core.coverage.pixel_runs import fill_traits
from core.methods import table
from core.records.arrays import Integers
from core.records.steps import Level
from core.records.words import nouns
from core.stages.declared import stage_of
from core.trace.run_to import next_at_pixel, next_marked
from widgets.basics.controls import flat_button
from widgets.basics.drawing import Mark
from widgets.timeline.run_picture import TimelineRun
from widgets.timeline.transport import Timeline

MARKS = {
    "covered": Mark.COVERED,
    "rejected": Mark.REJECTED,
    "tie": Mark.TIE,
    "nan": Mark.NAN,
    "depth-failed": Mark.DEPTH_FAILED,
}
EVENT_TITLES = {
    "covered": "covered",
    "rejected": "rejected",
    "tie": "tie",
    "nan": "NaN or infinity",
    "depth-failed": "depth failed",
}
LEAPS = 20
"""Leaps with Page Down from the start of a stage to its end."""
LAST_STEP = "The picture is finished. Press Home for the start of this stage, 1 for the first stage."
FIRST_STEP = "Nothing comes before this. Press Right for the first step."


def nearest(positions: Integers, position: int, direction: int) -> int | None:
    """Return the nearest of rising positions after (1) or before (-1) a position, ``None`` where there is none."""
    found = positions[positions > position] if direction > 0 else positions[positions < position]
    return int(found[0 if direction > 0 else -1]) if len(found) else None


class SteppingPresenter(QObject):
    """Shows where the cursor is and moves it."""

    message_ended = Signal(str)
    """The last message no longer holds: the cursor or the pin has moved."""
    places_changed = Signal()
    """There are other bookmarks or breakpoints, or a bookmark has another note."""

    def __init__(self, session: Session, timeline: Timeline, page: Page) -> None:
        super().__init__(page)
        self._page = page
        self._session, self._timeline = session, timeline
        self.stepped_alone: Callable[[int, Level], bool] = lambda *_: False
        """Steps a run beside this one where only that one has steps left, and returns whether that was so."""
        self.event_kind = "covered"
        """Kind of event that N runs to."""
        self.breaks = Breaks()
        self.bookmarks = Bookmarks(session, self.tell, self)
        self.bookmarks.bookmarks_changed.connect(self._show_places)
        self._told = ""
        self.stops_at_ends = False
        """Whether a step stops once at the end of each stage, and says so."""
        self._stopped_at: Cursor | None = None
        timeline.position_requested.connect(session.scrub)
        timeline.step_requested.connect(self.step)
        timeline.ends_requested.connect(self.go_to_end)
        timeline.level_chosen.connect(session.set_level)
        timeline.leap_requested.connect(self.leap)
        timeline.chapters.chapter_chosen.connect(self.choose_stage)
        timeline.chapters.run_scrubbed.connect(self.scrub_run)
        self._stage = ""
        self.refresh_run(session.moment)

    @Slot(str)
    def tell(self, text: str) -> None:
        """Say something that holds until the cursor or the pin moves."""
        self._told = text
        self._page.tell(text)

    def end_message(self, moment: Moment) -> None:
        """Take the last message back: the cursor or the pin has moved."""
        self._stopped_at = None
        if self._told:
            text, self._told = self._told, ""
            self.message_ended.emit(text)

    # Showing.

    def refresh_run(self, moment: Moment) -> None:
        """Show another trace."""
        self._stage = ""
        self.refresh_cursor(moment)

    def refresh_cursor(self, moment: Moment) -> None:
        """Show where the cursor is."""
        cursor = moment.cursor
        if cursor.stage != self._stage:
            self._stage = cursor.stage
            self._timeline.show_level_names(_level_names(moment))
            self.refresh_marks(moment)
            self.show_chapters(moment)
        elif moment.is_predicting:
            self.refresh_marks(moment)
        self._timeline.show_level(cursor.level)
        self._timeline.show_position(cursor.position)

    def refresh_marks(self, moment: Moment) -> None:
        """Show the marks of the run, those of the pinned pixel, breakpoints and bookmarks."""
        trace = moment.stage_trace
        starts = trace.steps.starts
        marks = {MARKS[name]: starts[1:][flags] - 1 for name, flags in trace.marks.items()}
        if moment.pin is not None:
            marks[Mark.PINNED] = starts[1:][trace.rows_at_pixel(*moment.pin)] - 1
        marks[Mark.BREAKPOINT] = self.breaks.positions(trace) - 1
        here = [mark.position - 1 for mark in self.bookmarks.marks if mark.stage == trace.stage]
        marks[Mark.BOOKMARK] = np.array(sorted(set(here)), np.int64)
        place, last = STAGES.index(trace.stage), len(STAGES) - 1
        count, position = trace.steps.count, moment.cursor.position
        has_more = moment.is_predicting and position < count
        if has_more:
            # What lies ahead would tell the answer, also by how much it is.
            count = position
            marks = {mark: places[places < position] for mark, places in marks.items()}
        self._timeline.show_run(TimelineRun(count, marks, place > 0, place < last or has_more, has_more))
        self._timeline.show_position(position)

    def show_chapters(self, moment: Moment) -> None:
        """Show what every stage took in, gave out, and which part of the time it took."""
        self._timeline.chapters.show_chapters(
            chapters_of(moment.trace, current=moment.cursor.stage, is_predicting=moment.is_predicting)
        )

    # Moving.

    @Slot(int)
    def step(self, direction: int, level: Level | None = None) -> None:
        """Step once at the present level or another, from stage to stage; playing stops at the end of the last one."""
        before = self._session.cursor
        level = before.level if level is None else level
        if self.stepped_alone(direction, level) or (direction > 0 and self._stops_here(level)):
            return
        self._attempt(
            partial(self._session.step, direction, level), LAST_STEP if direction > 0 else FIRST_STEP
        )
        if self._session.cursor == before:
            self._timeline.show_playing(False)

    def _stops_here(self, level: Level) -> bool:
        """Say that a stage ends here, unless that is said, it plays, or each step is a stage; return whether it was."""
        moment, stepped_by_hand = self._session.moment, not self._timeline.is_playing()
        is_end = moment.is_stage_done and moment.steps.count > 0 and level > Level.STAGE
        stage = stepped(moment.cursor, moment.trace, 1, level).stage
        stops = self.stops_at_ends and is_end and stepped_by_hand and stage != moment.cursor.stage
        if not stops or self._stopped_at == moment.cursor:
            return False
        names = (stage_of(name).short_title for name in (moment.cursor.stage, stage))
        self.tell("{} is finished. The next step begins {}.".format(*names))
        self._stopped_at = moment.cursor
        return True

    def _attempt(self, action: Callable[[], object], otherwise: str) -> None:
        """Do something that moves the cursor or the pin, or say why it moves neither."""
        before = self._session.cursor, self._session.pin
        action()
        if (self._session.cursor, self._session.pin) == before:
            self.tell(otherwise)

    def go_back(self) -> None:
        """Undo the last jump."""
        self._attempt(self._session.go_back, "No jump to go back from.")

    def go_forward(self) -> None:
        """Do it again."""
        self._attempt(self._session.go_forward, "No jump was gone back from.")

    def go_to_stage(self, direction: int) -> None:
        """Go to the start of the next stage (1) or the one before (-1)."""
        end = "This is the last stage." if direction > 0 else "This is the first stage."
        self._attempt(partial(self._session.next_stage, direction), end)

    def move_pin(self, columns: int, rows: int) -> None:
        """Pin a neighbouring pixel."""
        self._attempt(partial(self._session.nudge_pin, columns, rows), "The stepped pixels end here.")

    @Slot(int)
    def go_to_end(self, direction: int) -> None:
        """Go to the start (-1) or the end (1) of the stage."""
        self._session.go_to(0 if direction < 0 else self._session.stage_trace.steps.count)

    @Slot(int)
    def choose_stage(self, index: int) -> None:
        """Go to the start of a stage, by its place in the run."""
        self._session.set_stage(STAGES[index], 0)

    @Slot(int, float)
    def scrub_run(self, index: int, share: float) -> None:
        """Go to where a share of a stage is done, while the chapters are dragged through."""
        count = self._session.trace.stage(STAGES[index]).steps.count
        self._session.scrub(round(share * count), STAGES[index])

    @Slot(int)
    def leap(self, direction: int) -> None:
        """Go on (1) or back (-1) by a part of the stage, from stage to stage."""
        cursor, count = self._session.cursor, self._session.stage_trace.steps.count
        position = min(max(cursor.position + direction * max(count // LEAPS, 1), 0), count)
        if position != cursor.position:
            self._session.scrub(position)
        else:
            self.step(direction)

    def toggle_play(self) -> None:
        """Play or pause; at the end of the last stage, play from the first."""
        trace, cursor = self._session.stage_trace, self._session.cursor
        is_at_end = cursor.stage == STAGES[-1] and cursor.position >= trace.steps.count
        if is_at_end and not self._timeline.is_playing():
            self._session.set_stage(STAGES[0], 0)
        self._timeline.toggle_play()

    def change_level(self, direction: int) -> None:
        """Make steps smaller (1) or larger (-1)."""
        level = self._session.cursor.level + direction
        if Level.STAGE <= level <= Level.OPERATION:
            self._session.set_level(Level(level))
        else:
            self.tell("There are no smaller steps." if direction > 0 else "There are no larger steps.")

    def step_larger(self, direction: int) -> None:
        """Step at the level above the present one."""
        self.step(direction, Level(max(self._session.cursor.level - 1, Level.STAGE)))

    def run_to_pin(self, direction: int) -> None:
        """Go to the next or last step at the pinned pixel."""
        pin = self._session.pin
        if pin is None:
            self.tell("Pin a pixel first: click it.")
            return
        if self._is_hidden(direction):
            return
        cursor, is_by_operation = self._session.cursor, self._session.cursor.level == Level.OPERATION
        reached = next_at_pixel(
            self._session.stage_trace, cursor.position, *pin, direction, by_operation=is_by_operation
        )
        self._go_on(reached, direction, f"at pixel ({pin[0]}, {pin[1]})")

    def run_to_event(self, direction: int) -> None:
        """Go to the next or last event of the chosen kind."""
        if self._is_hidden(direction):
            return
        trace, position = self._session.stage_trace, self._session.cursor.position
        reached = next_marked(trace, position, self.event_kind, direction)
        self._go_on(reached, direction, f"of the kind “{EVENT_TITLES[self.event_kind]}”")

    def run_to_breakpoint(self, direction: int) -> None:
        """Go to the next or last breakpoint, or else to the end."""
        if self._is_hidden(direction):
            return
        trace, position = self._session.stage_trace, self._session.cursor.position
        reached = nearest(self.breaks.positions(trace), position, direction)
        if reached is not None:
            self._session.go_to(reached)
        else:
            self.go_to_end(direction)

    def step_into(self, stage: str, column: int, row: int) -> None:
        """Go to the first step of a stage that is about a pixel."""
        trace = self._session.trace.stage(stage)
        rows = trace.rows_at_pixel(column, row)
        if len(rows):
            self._session.set_stage(stage, trace.steps.position_after(int(rows[0])))
        else:
            self.tell(f"{stage_of(stage).short_title} does nothing at pixel ({column}, {row}).")

    def _is_hidden(self, direction: int) -> bool:
        """Say, while the user predicts, that a search ahead would tell what comes; return whether it would."""
        would_tell = direction > 0 and self._session.is_predicting
        if would_tell:
            way = "Answer first." if self._session.is_asked_about else "P ends predicting."
            self.tell(f"A search ahead would tell what comes. {way}")
        return would_tell

    def _go_on(self, reached: int | None, direction: int, what: str) -> None:
        """Go to a position that a run has reached, or tell that there is none."""
        if reached is not None:
            self._session.go_to(reached)
        else:
            self.tell(f"No {'further' if direction > 0 else 'earlier'} step {what} in this stage.")

    def toggle_pixel_breakpoint(self) -> None:
        """Set or take away a breakpoint at the pinned pixel."""
        if self._session.pin is None:
            self.tell("Pin a pixel first: click it.")
            return
        self.breaks.pixels ^= {self._session.pin}
        self._show_places()

    def set_condition(self, text: str) -> None:
        """Stop where a condition holds, see `Breaks.set_condition`."""
        self.breaks.set_condition(text, self._session.stage_trace)
        self._show_places()

    def toggle_line_breakpoint(self, function: str, line: int) -> None:
        """Set or take away a breakpoint on a line of a listing."""
        self.breaks.lines ^= {(function, line)}
        self._show_places()

    def run_to_line(self, function: str, line: int) -> None:
        """Go to the next step of a line of a listing."""
        if self._is_hidden(1):
            return
        positions = line_positions(self._session.stage_trace, function, line)
        self._go_on(nearest(positions, self._session.cursor.position, 1), 1, f"at line {line}")

    # Bookmarks and breakpoints.

    @Slot()
    def _show_places(self) -> None:
        """Show bookmarks and breakpoints that have changed."""
        self.refresh_marks(self._session.moment)
        self.places_changed.emit()

    def set_places(self, bookmarks: Iterable[Bookmark] = (), breakpoints: Breakpoints | None = None) -> None:
        """Have these bookmarks and breakpoints, those of another scene, and no others."""
        before = self.breaks.record(), self.bookmarks.marks
        self.breaks, marks = Breaks(breakpoints), list(bookmarks)
        if before != (self.breaks.record(), marks):  # The run that was opened shows the others already.
            self.bookmarks.set_marks(marks)


def _level_names(moment: Moment) -> dict[Level, str]:
    """Return what a step of each level is in the stage at hand."""
    stage, settings = moment.cursor.stage, moment.document.settings
    declared, corner_count = stage_of(stage), moment.document.scene.corner_count
    names = {Level.TRIANGLE: nouns(corner_count).one.capitalize()} if corner_count != 3 else {}
    if moment.stage_trace.order is not None:
        return moment.stage_trace.order.names
    if "statement" in moment.stage_trace.steps.kinds:
        # A scene's own shader runs line by line.
        lane = "Vertex" if stage == "transform" else "Fragment"
        order = (lane, "Statement") if moment.document.lanes == "one" else ("Statement", lane)
        return names | dict(zip((Level.GROUP, Level.PIXEL), order, strict=True))
    if stage == "raster":
        is_wireframe = corner_count < 3 or table.get("polygon_mode", settings.polygon_mode).function()
        fill = effective_fill(settings.fill, settings.coverage)
        label = "Line" if is_wireframe else fill_traits(fill).group_label
        return names | {Level.GROUP: label if corner_count <= 3 else declared.group_label}
    names[Level.GROUP] = "Ring" if stage == "clip" and corner_count > 3 else declared.group_label
    return names | ({Level.PIXEL: declared.row_label} if declared.row_label else {})


# The choice of events above the timeline's bar, with a button to each side that runs to the next one of the
# kind.


class EventChoice(QObject):
    """Keeps the kind of event that the stepping runs to."""

    def __init__(self, stepping: SteppingPresenter, timeline: Timeline, parent: QObject) -> None:
        super().__init__(parent)
        self._stepping = stepping
        self.box = QComboBox(timeline)
        for name, title in EVENT_TITLES.items():
            self.box.addItem(f"Run to: {title}", name)
        self.box.setAccessibleName("Kind of event")
        self.box.setToolTip("What N (next) and Shift+N (previous) run to")
        self.box.activated.connect(self._choose)
        self.previous_button = flat_button(
            "<", "Previous event", "Previous event of this kind (Shift+N)", timeline
        )
        self.next_button = flat_button(">", "Next event", "Next event of this kind (N)", timeline)
        self.previous_button.clicked.connect(self._run_back)
        self.next_button.clicked.connect(self._run_on)
        for widget in (self.previous_button, self.box, self.next_button):
            widget.setFocusPolicy(Qt.FocusPolicy.TabFocus)
            timeline.add_control(widget)

    @Slot()
    def _run_back(self) -> None:
        self._stepping.run_to_event(-1)

    @Slot()
    def _run_on(self) -> None:
        self._stepping.run_to_event(1)

    @Slot(int)
    def _choose(self, index: int) -> None:
        self._stepping.event_kind = self.box.itemData(index)

    def choose(self, name: str) -> None:
        """Choose the kind of event that N runs to."""
        if name in EVENT_TITLES:
            self.box.setCurrentIndex(self.box.findData(name))
            self._stepping.event_kind = name
