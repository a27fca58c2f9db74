"""All that may be shown at one time: a frozen value, made anew at each change, and what follows from it, found once."""

from dataclasses import dataclass
from enum import Flag, auto

from app.session.cursor import Cursor
from app.session.document import Document
from core import Trace
from core.records.cached import cached_property
from core.records.steps import Steps
from core.trace import Explanation, StageTrace

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
