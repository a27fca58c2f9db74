"""Where the run is looked at: the cursor, the pin and the pointer, and what may be shown; with one signal."""

from dataclasses import replace
from typing import Any

from PySide6.QtCore import QObject, Signal, Slot

from app.session.document import Document
from app.session.history import History
from app.session.moment import NOTHING, Change, Cursor, Moment, Pixel, placed, stepped
from core import STAGES, Trace
from core.records.steps import Level
from core.trace.stage_trace import Explanation, StageTrace


class Stepping(QObject):
    """A Moment, and the ways to others of its document. A value equal to the present one changes and emits nothing."""

    changed = Signal(Change)
    """What an operation has changed, all at once; `moment` is the new one."""

    def __init__(self, moment: Moment, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._moment = moment
        self._visited = History(moment.cursor)
        self._asked: dict[str, tuple[str, bool]] = {}
        """By who asks: the digest of a scene, and whether it is the open one."""

    def _become(self, what: Change, **fields: Any) -> None:
        """Go to another moment, and tell what has changed."""
        self._moment = replace(self._moment, **fields)
        self.changed.emit(what)

    @property
    def moment(self) -> Moment:
        """All that may be shown now."""
        return self._moment

    @property
    def document(self) -> Document:
        """What is open."""
        return self._moment.document

    @property
    def trace(self) -> Trace:
        """Its trace."""
        return self._moment.trace

    @property
    def cursor(self) -> Cursor:
        """Where the stepping is."""
        return self._moment.cursor

    @property
    def stage_trace(self) -> StageTrace:
        """The trace of the stage at the cursor."""
        return self._moment.stage_trace

    @property
    def explanation(self) -> Explanation | None:
        """What the step just done did."""
        return self._moment.explanation

    @property
    def pin(self) -> Pixel | None:
        """The pinned pixel: column and row in the traced picture."""
        return self._moment.pin

    @property
    def hover(self) -> Pixel | None:
        """The pixel under the pointer."""
        return self._moment.hover

    # Stepping.

    def step(self, direction: int, level: Level | None = None) -> None:
        """Go one step forward (1) or back (-1), at the present level or another one, from stage to stage."""
        level = self.cursor.level if level is None else level
        self._move(stepped(self.cursor, self.trace, direction, level))

    def go_to(self, position: int) -> None:
        """Go to a position of the present stage; the jump can be undone by ``go_back``."""
        self._jump(placed(self.cursor, self.trace, position))

    def scrub(self, position: int, stage: str = "") -> None:
        """Go to a position, of another stage if it is named, while a slider is dragged: not remembered."""
        self._move(placed(self.cursor, self.trace, position, stage))

    def jump(self, cursor: Cursor, pin: Pixel | None, is_predicting: bool) -> None:
        """Go to a place of the run with a pixel pinned, and hide what comes next from there or show it, all at once."""
        cursor = placed(cursor, self.trace, cursor.position)
        pin = None if pin is None or not self._moment.has_pixel(pin) else pin
        before = self._moment
        what = NOTHING
        for change, old, new in (
            (Change.CURSOR, before.cursor, cursor),
            (Change.PIN, before.pin, pin),
            (Change.PREDICTING, before.is_predicting, is_predicting),
        ):
            what |= NOTHING if old == new else change
        if what:
            self._remember(cursor)
            self._become(what, cursor=cursor, pin=pin, is_predicting=is_predicting)

    def set_stage(self, stage: str, position: int | None = None) -> None:
        """Go to another stage, to its end unless a position is given."""
        self._jump(placed(self.cursor, self.trace, position, stage))

    def next_stage(self, direction: int) -> None:
        """Go to the start of the neighbouring stage."""
        index = STAGES.index(self.cursor.stage) + direction
        if 0 <= index < len(STAGES):
            self.set_stage(STAGES[index], 0)

    def set_level(self, level: Level) -> None:
        """Choose how large a step is."""
        self._move(replace(self.cursor, level=Level(level)))

    def go_back(self) -> None:
        """Undo the last jump exactly."""
        if self._visited.can_undo:
            self._restore(self._visited.undo())

    def go_forward(self) -> None:
        """Do it again."""
        if self._visited.can_redo:
            self._restore(self._visited.redo())

    def _restore(self, cursor: Cursor) -> None:
        self._move(placed(cursor, self.trace, cursor.position))

    def _jump(self, cursor: Cursor) -> None:
        if cursor != self.cursor:
            self._remember(cursor)
            self._become(Change.CURSOR, cursor=cursor)

    def _remember(self, cursor: Cursor) -> None:
        """Have ``go_back`` lead from another cursor to the present one."""
        if cursor != self.cursor:
            if self._visited.present != self.cursor:
                self._visited.put(self.cursor)
            self._visited.put(cursor)

    def _move(self, cursor: Cursor) -> None:
        if cursor != self.cursor:
            self._become(Change.CURSOR, cursor=cursor)

    # Pointing.

    @Slot(int, int)
    def pin_place(self, column: int, row: int) -> None:
        """Pin the pixel at a place in the buffers."""
        self.set_pin(self._moment.pixel_at(column, row))

    @Slot(int, int)
    def hover_place(self, column: int, row: int) -> None:
        """Say that the pointer is at a place in the buffers."""
        self.set_hover(self._moment.pixel_at(column, row))

    @Slot()
    def end_hover(self) -> None:
        """Say that the pointer is on no pixel."""
        self.set_hover(None)

    def set_pin(self, pixel: Pixel | None) -> None:
        """Pin a pixel, or none."""
        if pixel != self.pin and (pixel is None or self._moment.has_pixel(pixel)):
            self._become(Change.PIN, pin=pixel)

    def nudge_pin(self, columns: int, rows: int) -> None:
        """Move the pin; without one it appears in the middle."""
        first_column, first_row, end_column, end_row = self.trace.source.raster.bounds
        at = self.pin or ((first_column + end_column) // 2 - columns, (first_row + end_row) // 2 - rows)
        self.set_pin((at[0] + columns, at[1] + rows))

    def set_hover(self, pixel: Pixel | None) -> None:
        """Say which pixel the pointer is on."""
        if pixel != self.hover:
            self._become(Change.HOVER, hover=pixel)

    @property
    def is_predicting(self) -> bool:
        """Whether results are hidden until they have been predicted."""
        return self._moment.is_predicting

    def set_predicting(self, is_predicting: bool) -> None:
        """Hide results, or show them again."""
        if is_predicting != self.is_predicting:
            self._become(Change.PREDICTING, is_predicting=is_predicting)

    def reveal(self) -> None:
        """Say that what comes next, or a part of it, has been shown while predicting."""
        self.changed.emit(Change.REVEALED)

    @property
    def is_asked_about(self) -> bool:
        """Whether an exercise or a lesson asks about the open scene: no page may show it."""
        return self._moment.is_asked_about

    @property
    def asker(self) -> str:
        """Who asks about the open scene: ``exercise`` or ``lesson``; empty: nobody."""
        return next((by for by, (_, is_open) in self._asked.items() if is_open), "")

    @property
    def asked_scenes(self) -> frozenset[str]:
        """Digests of the scenes that exercises and lessons ask about, open or not."""
        return frozenset(scene for scene, _ in self._asked.values() if scene)

    def set_asked(self, scene: str, *, is_open: bool, by: str = "exercise") -> None:
        """Keep a scene with this digest from being shown, and the open one if it ``is_open``; empty: none.

        ``by`` says who asks: each asks about one scene at a time.
        """
        before = self._asked.get(by, ("", False))
        self._asked[by] = scene, is_open
        if self._asked[by] != before:
            self._become(Change.ASKED, is_asked_about=any(is_open for _, is_open in self._asked.values()))
