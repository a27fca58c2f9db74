"""What is kept of the Step page: how it looks, bookmarks, where runs stop, and all of it as a line of a lesson."""

from collections.abc import Callable, Iterable
from contextlib import suppress
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QGuiApplication

from app.files.state_files import State
from app.files.state_models import NOTE_LIMIT, Bookmark, Breakpoints, Look, OrbitRecord, TextSize
from app.session.moment import Cursor
from app.session.session import Session
from core import Trace
from core.records.arrays import Integers
from core.records.steps import Level
from core.stages.declared import stage_of
from core.trace.conditions import Condition, parse_condition
from core.trace.stage_trace import StageTrace
from widgets.space.orbit import Orbit

if TYPE_CHECKING:
    from app.pages.step.page import StepPage


# Bookmarks: remembered steps, each with a note that the user may type.


BOOKMARKS = 10
"""Bookmarks that have a key; there can be no more."""


class Bookmarks(QObject):
    """The bookmarks of the open scene, in the order in which they were set."""

    bookmarks_changed = Signal()
    """There are others, or one has another note."""

    def __init__(self, session: Session, tell: Callable[[str], None], parent: QObject) -> None:
        """``tell`` tells the user something."""
        super().__init__(parent)
        self._tell = tell
        self._session = session
        self.marks: list[Bookmark] = []

    def set_marks(self, marks: Iterable[Bookmark]) -> None:
        """Have these bookmarks, as those of another scene."""
        self.marks = list(marks)
        self.bookmarks_changed.emit()

    def here(self) -> Bookmark | None:
        """Return the bookmark of the present step."""
        cursor = self._session.cursor
        place = cursor.stage, cursor.position
        return next((mark for mark in self.marks if (mark.stage, mark.position) == place), None)

    def toggle(self) -> None:
        """Remember this step, or forget it."""
        mark = self.here()
        if mark is None:
            self.describe("")
        else:
            self.marks.remove(mark)
            self.bookmarks_changed.emit()

    def describe(self, note: str) -> None:
        """Remember this step with a note; ValueError if the note is too long."""
        if len(note) > NOTE_LIMIT:
            raise ValueError(f"A note has at most {NOTE_LIMIT} characters, got {len(note)}.")
        cursor, before = self._session.cursor, self.here()
        mark = Bookmark(stage=cursor.stage, position=cursor.position, note=note)
        if before is not None:
            self.marks[self.marks.index(before)] = mark
        elif len(self.marks) >= BOOKMARKS:
            self._tell("All ten bookmarks are set. Remove one first.")
            return
        else:
            self.marks.append(mark)
        self.bookmarks_changed.emit()

    def text(self, index: int) -> str:
        """Return a bookmark in words, by its number from 0."""
        mark = self.marks[index]
        text = f"{stage_of(mark.stage).short_title}, step {mark.position:,}"
        return f"{text}: {mark.note}" if mark.note else text

    def go_to(self, index: int) -> None:
        """Go to a bookmark by its number from 0, and tell its note."""
        if index >= len(self.marks):
            self._tell(f"Bookmark {index + 1} is not set: Ctrl+B sets one.")
            return
        mark = self.marks[index]
        self._session.set_stage(mark.stage, mark.position)
        if mark.note:
            self._tell(f"Bookmark {index + 1}: {mark.note}")


# Where a run stops: pixels, lines of listings, and a condition; and the steps that they stand for in a
# stage.


class Breaks:
    """The breakpoints of the open scene."""

    def __init__(self, record: Breakpoints | None = None) -> None:
        record = record or Breakpoints.model_construct()
        self.pixels: set[tuple[int, int]] = set(record.pixels)
        self.lines: set[tuple[str, int]] = set(record.lines)
        """Name of the listing's function and line."""
        self._condition: Condition | None = parse_condition(record.condition) if record.condition else None

    @property
    def condition(self) -> str:
        """Text of the condition, empty: none."""
        return self._condition.text if self._condition else ""

    def set_condition(self, text: str, trace: StageTrace) -> None:
        """Stop where a condition holds, as ``E0 < 0.5 and covered``; an empty text takes it away.

        Raises ValueError if the text is not a condition, or names what no stage has; the old condition stays.
        """
        condition = parse_condition(text) if text.strip() else None
        if condition is not None:
            condition.holds(trace)
        self._condition = condition

    def record(self) -> Breakpoints:
        """Return them as files keep them."""
        return Breakpoints.model_construct(
            pixels=sorted(self.pixels), lines=sorted(self.lines), condition=self.condition
        )

    def positions(self, trace: StageTrace) -> Integers:
        """Return the positions, rising, just after a step that a breakpoint stands on."""
        found = np.zeros(trace.steps.row_count, bool)
        for pixel in self.pixels:
            found[trace.rows_at_pixel(*pixel)] = True
        if self._condition is not None:
            # A stage without the variables of the condition has no such row.
            with suppress(ValueError):
                found |= self._condition.holds(trace)
        of_rows = trace.steps.starts[1:][found]
        if not self.lines:
            return of_rows
        return np.unique(np.concatenate([of_rows, *(line_positions(trace, *line) for line in self.lines)]))


def line_positions(trace: StageTrace, function: str, line: int) -> Integers:
    """Return the positions, rising, just after a step of a line of a listing, which goes by its function's name."""
    steps = trace.steps
    found = [np.empty(0, np.int64)]
    for number, kind in enumerate(steps.kinds):
        for place, operation in enumerate(steps.operations[kind]):
            listing = trace.listings.get(f"{kind}.{operation.name}", trace.listings.get(kind))
            if listing is None or listing.name != function:
                continue
            rows = np.flatnonzero(steps.kind == number)
            if isinstance(operation.label, str):
                rows = rows[: len(rows) * (listing.lines.get(operation.label) == line)]
            else:
                ran = operation.label(trace.columns, rows)
                rows = rows[np.isin(ran, [name for name, at in listing.lines.items() if at == line])]
            found.append(steps.starts[:-1][rows] + place + 1)
    return np.unique(np.concatenate(found))


# What the Step page shows, and how, as a state file keeps it.


def state_of(page: "StepPage", text_size: TextSize) -> State:
    """Return what a state file keeps."""
    moment, stepping = page.session.moment, page.stepping
    return State(
        document=moment.document,
        stage=moment.cursor.stage,
        position=moment.cursor.position,
        level=int(moment.cursor.level),
        pin=moment.pin,
        bookmarks=tuple(stepping.bookmarks.marks),
        breakpoints=stepping.breaks.record(),
        look=look_of(page, text_size),
    )


def show_state(page: "StepPage", state: State, trace: Trace | None = None) -> None:
    """Show what a state file has kept, with its trace if that is there already."""
    session = page.session
    page.timeline.show_playing(False)
    session.open(state.document, trace, Cursor(state.stage, state.position, Level(state.level)))
    page.stepping.set_places(state.bookmarks, state.breakpoints)
    session.set_pin(state.pin)
    show_look(page, state.look)
    page.column.show_step()


def look_of(page: "StepPage", text_size: TextSize) -> Look:
    """Return how the page shows the run, in text of a size in percent."""
    return Look(
        view=page.current_view(),
        views=dict(page.main_area.views_by_hand),
        grid=page.grids.look(),
        orbits={name: OrbitRecord(**vars(orbit)) for name, orbit in page.views.chosen_orbits().items()},
        other=dict(page.comparing.differences),
        printed=page.comparing.printed,
        drafts=page.editing.drafts,
        other_buffer=page.comparing.buffer,
        panes=page.desk_panes(),
        text_size=text_size,
        shader_drafts=page.shading.drafts(),
        event=page.stepping.event_kind,
    )


def show_look(page: "StepPage", look: Look) -> None:
    """Show the run as it was shown."""
    page.main_area.views_by_hand = dict(look.views)
    page.comparing.set_buffer(look.other_buffer)
    if not page.session.document.edits:
        page.comparing.set_differences(look.other)
    if look.printed:
        page.comparing.show_printed(look.printed, seeks=False)
    page.editing.show_drafts(look.drafts)
    page.events.choose(look.event)
    if look.panes is not None:
        page.show_desk_panes(look.panes)
    page.grids.show_look(look.grid)
    page.views.look_from({name: Orbit(**dict(orbit)) for name, orbit in look.orbits.items()})
    page.show_view(look.view)
    page.shading.show_drafts(look.shader_drafts)
    if look.lesson is not None:
        page.lessons.open(*look.lesson)


# Copy this state: what is on the Step page as a line of a lesson, on the clipboard.


ONLY_WHOLE = "only the whole view can stand in a lesson: press Shift+F"


def copy_state(page: "StepPage") -> None:
    """Put the line ``state = {...}`` of what is open on the clipboard, and say so; or say why it cannot be."""
    from lessons.course.copied import state_text  # All exercises come along: not before something is copied.

    moment, comparing = page.session.moment, page.comparing
    document, cursor = moment.document, moment.cursor
    is_compared = page.current_view() == "compare"
    try:
        if document.raster.origin is not None or document.before != "earlier":
            raise ValueError(ONLY_WHOLE)
        line = state_text(
            moment.trace,
            document.settings,
            document.title,
            cursor.stage,
            cursor.position,
            pixel=moment.pin,
            triangle=document.triangle,
            buffer=page.grids.look().buffers.get(cursor.stage, ""),
            view=page.current_view(),
            other=comparing.differences if is_compared and not document.edits else None,
            printed=comparing.printed if is_compared else "",
            edits=document.edits,
        )
    except ValueError as problem:
        page.tell(f"This cannot be copied: {problem}.")
    else:
        QGuiApplication.clipboard().setText(f"{line}\n")
        page.tell("Copied: paste it under [[step]] of a lesson.")
