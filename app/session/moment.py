"""All that may be shown at one time: a frozen value, with the cursor that says where the stepping is."""

from dataclasses import dataclass, replace
from enum import Flag, auto

import numpy as np

from app.session.document import Document
from core import STAGES, Trace
from core.explain.stage_texts import skipped_because
from core.records.arrays import cached_property
from core.records.steps import Level, Steps
from core.scene import AnyScene
from core.trace.stage_trace import Explanation, StageTrace
from lessons.run_place import RunPlace

# Where the stepping is, and where a step, a jump or another run takes it.


@dataclass(frozen=True)
class Cursor:
    """Where the stepping is: operations of a stage that are done, and how large a step is."""

    stage: str = "raster"
    position: int = 0
    level: Level = Level.PIXEL


def stage_for(scene: AnyScene, stage: str) -> str:
    """Return a stage, or the next one that a scene goes through, if it skips this one."""
    later = STAGES[STAGES.index(stage) :]
    return next(name for name in later if not skipped_because(name, scene.corner_count))


def cursor_for(scene: AnyScene, cursor: Cursor) -> Cursor:
    """Return the cursor, or the start of the next stage, if a scene skips the present one."""
    stage = stage_for(scene, cursor.stage)
    return cursor if stage == cursor.stage else replace(cursor, stage=stage, position=0)


def cursor_at(place: RunPlace, trace: Trace, level: Level) -> Cursor:
    """Return the cursor at a place, or at the start of the next stage, if the scene skips the place's own.

    ``level`` holds where the place has none.

    Raises ValueError where nothing of its name happens.
    """
    stage = stage_for(trace.source.scene, place.stage)
    return Cursor(stage, place.position(trace) if stage == place.stage else 0, place.level or level)


def placed(cursor: Cursor, trace: Trace, position: int | None, stage: str = "") -> Cursor:
    """Return a cursor at a position of its stage or another one, or the nearest there is; ``None``: at the end."""
    stage = stage or cursor.stage
    count = trace.stage(stage).steps.count
    return replace(cursor, stage=stage, position=count if position is None else min(max(position, 0), count))


def kept_at_pixel(cursor: Cursor, before: StageTrace, row: int, trace: Trace) -> Cursor:
    """Return a cursor at the triangle and pixel that a row of the stage was about, where shaders are stepped.

    It is after as many rows of the pixel as before, or after its last one where it was after that. Without shaders, or
    where nothing is about the pixel any more, the cursor stays at its position.
    """
    now = trace.stage(cursor.stage)
    if row < 0 or now is before or not any("statement" in stage.steps.kinds for stage in (before, now)):
        return placed(cursor, trace, cursor.position)
    mine, theirs = (
        np.flatnonzero(
            (stage.triangle == before.triangle[row]) & (stage.pixel == before.pixel[row]).all(axis=1)
        )
        for stage in (before, now)
    )
    if not len(theirs):
        return placed(cursor, trace, cursor.position)
    number = len(theirs) - 1 if row == mine[-1] else min(int(np.searchsorted(mine, row)), len(theirs) - 1)
    return replace(cursor, position=now.steps.position_after(int(theirs[number])))


def stepped(cursor: Cursor, trace: Trace, direction: int, level: Level) -> Cursor:
    """Return a cursor one step on (1) or back (-1), from the end of a stage in the next one that the scene has."""
    steps = trace.stage(cursor.stage).steps
    position = (steps.forward if direction > 0 else steps.back)(cursor.position, level)
    if position != cursor.position:
        return replace(cursor, position=position)
    index = STAGES.index(cursor.stage) + direction
    while 0 <= index < len(STAGES) and skipped_because(STAGES[index], trace.source.scene.corner_count):
        index += direction
    if not 0 <= index < len(STAGES):
        return cursor
    return placed(cursor, trace, 0 if direction > 0 else None, STAGES[index])


# All that may be shown at one time: a frozen value, made anew at each change, and what follows from it,
# found once.


Pixel = tuple[int, int]


class Change(Flag):
    """What has changed in a session, all at once."""

    DOCUMENT = auto()
    """Another scene, other settings, focus or raster: the trace is a new one, and the cursor may have moved along."""
    OPENED = auto()
    """That document is no edit of the one before: it was opened."""
    RETURNED = auto()
    """That document was open before: an edit, or opening another one, was undone or redone."""
    EDITS = auto()
    """Other edited listings run in side B; the run that is open is the same."""
    CURSOR = auto()
    """Another step of the same trace, or another stage."""
    PIN = auto()
    HOVER = auto()
    PREDICTING = auto()
    """What comes next is hidden, or shown again."""
    REVEALED = auto()
    """What comes next was shown while predicting, or a part of it."""
    ASKED = auto()
    """An exercise asks about another scene, or about none; or the open scene is the one from now on, or no longer."""
    PLAN = auto()
    """Something else is known of what the scene needs."""

    STEP = DOCUMENT | CURSOR
    POINTING = PIN | HOVER


NOTHING = Change(0)


@dataclass(frozen=True, eq=False)
class Step:
    """A run, and where it is."""

    trace: Trace
    cursor: Cursor
    is_predicting: bool = False
    """Whether results are hidden until they have been predicted."""

    @cached_property
    def stage_trace(self) -> StageTrace:
        """The trace of the stage at the cursor."""
        return self.trace.stage(self.cursor.stage)

    @property
    def steps(self) -> Steps:
        """The steps of that stage."""
        return self.stage_trace.steps

    @cached_property
    def row_and_operation(self) -> tuple[int, int]:
        """The row and the operation just done; -1 and -1 before the first one, which takes no trace."""
        return (-1, -1) if self.cursor.position == 0 else self.steps.row_at(self.cursor.position)

    @property
    def row(self) -> int:
        """The row of the step just done, -1 before the first one."""
        return self.row_and_operation[0]

    @cached_property
    def rows_done(self) -> int:
        """How many rows are done as a whole."""
        return self.steps.rows_done(self.cursor.position)

    @property
    def is_stage_done(self) -> bool:
        """Whether the stage has no further step."""
        return self.cursor.position >= self.steps.count

    @property
    def triangle(self) -> int:
        """The triangle of the step just done, -1: none."""
        return -1 if self.row < 0 else int(self.stage_trace.triangle[self.row])

    @property
    def pixel(self) -> Pixel | None:
        """The pixel of the step just done, if it is about one."""
        column, row = (-1, -1) if self.row < 0 else self.stage_trace.pixel[self.row].tolist()
        return (column, row) if column >= 0 else None

    @property
    def explanation(self) -> Explanation | None:
        """What the step just done did."""
        return self.stage_trace.explain(self.cursor.position)

    @property
    def origin(self) -> Pixel:
        """Column and row, in the traced picture, of the lower left pixel of the buffers."""
        column, row, _, _ = self.trace.source.raster.bounds
        return column, row

    def place_of(self, pixel: Pixel) -> Pixel:
        """Return column and row of a pixel in the buffers of the traced raster."""
        column, row = self.origin
        return pixel[0] - column, pixel[1] - row

    def pixel_at(self, column: int, row: int) -> Pixel:
        """Return the pixel that stands at a place in the buffers of the traced raster."""
        first_column, first_row = self.origin
        return column + first_column, row + first_row

    def has_pixel(self, pixel: Pixel) -> bool:
        """Return whether the traced raster has this pixel."""
        first_column, first_row, end_column, end_row = self.trace.source.raster.bounds
        return first_column <= pixel[0] < end_column and first_row <= pixel[1] < end_row


@dataclass(frozen=True, eq=False, kw_only=True)
class Moment(Step):
    """The step of what is open, and what is pointed at."""

    document: Document
    pin: Pixel | None = None
    """The pinned pixel: column and row in the traced picture."""
    hover: Pixel | None = None
    """The pixel under the pointer."""
    is_asked_about: bool = False
    """Whether an exercise or a lesson asks about the open scene: no page may show it."""

    @property
    def pointed_places(self) -> tuple[Pixel | None, Pixel | None]:
        """Where the pinned and the hovered pixel stand in the buffers."""
        pin, hover = (None if pixel is None else self.place_of(pixel) for pixel in (self.pin, self.hover))
        return pin, hover
