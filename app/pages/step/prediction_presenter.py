"""Predict, then reveal: asks about the next step, or about coverage as a whole, and says at once what is right."""

import numpy as np
from PySide6.QtCore import QObject, Slot

from app.pages.step.grid_records import grid_buffer
from app.session.session import Session
from core.explain import question
from core.explain.records import Asked, Verdict
from core.explain.subjects.fills import COVERAGE_QUESTION, coverage_result, coverage_reveal, covered_pixels
from core.records.steps import Level
from widgets.grid.pixel_grid import PixelGrid
from widgets.inspector.prediction import PredictionView


class PredictionPresenter(QObject):
    """Runs the questions while it is active."""

    def __init__(
        self, session: Session, view: PredictionView, grid: PixelGrid, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._session, self._view, self._grid = session, view, grid
        self._asked: Asked | None = None
        self._is_active = False
        self._right = self._count = 0
        self._found: set[tuple[int, int]] = set()
        view.answer_given.connect(self._answer)
        view.reveal_requested.connect(self._reveal)
        view.next_requested.connect(self._next)
        grid.pixel_clicked.connect(self._click)
        session.cursor_changed.connect(self._cursor_moved)
        session.document_changed.connect(self._cursor_moved)

    @property
    def is_active(self) -> bool:
        """Whether results are hidden."""
        return self._is_active

    def set_active(self, is_active: bool) -> None:
        """Start asking, or stop and show everything."""
        self._is_active = is_active
        self._right = self._count = 0
        self._found.clear()
        self._view.show_count(0, 0)
        self._session.set_predicting(is_active)
        if is_active:
            self._ask()
        else:
            self._asked = None
            self._grid.set_brush(False)
            self._view.show_question(None)

    def _ask(self) -> None:
        """Ask about the next row of the stage, or about coverage as a whole before the first one."""
        trace, cursor = self._session.stage_trace, self._session.cursor
        if trace.stage == "raster" and cursor.position == 0:
            self._asked = None
            self._found.clear()
            self._view.show_question(COVERAGE_QUESTION)
            self._grid.set_brush(True)
            self._hide_coverage()
            return
        self._grid.set_brush(False)
        row = trace.steps.rows_done(cursor.position)
        self._asked = question(trace, row) if row < trace.steps.row_count else None
        if self._asked is None:
            at_end = row >= trace.steps.row_count
            what = "This stage is done." if at_end else "There is nothing to predict in the next step."
            self._view.show_question(None, f"{what} Turn prediction off (P) to see the results.")
            return
        self._view.show_question(self._asked.question)

    def _hide_coverage(self) -> None:
        """Show the coverage as it will be, with every pixel covered up that has not been clicked."""
        session = self._session
        trace = session.stage_trace
        track = next(track for track in trace.buffers if track.name == "coverage")
        first_column, first_row = origin = session.trace.source.raster.bounds[:2]
        buffer = grid_buffer(track, trace.steps.row_count, origin)
        hidden = np.ones((buffer.rows, buffer.columns), bool)
        for column, row in self._found:
            hidden[row - first_row, column - first_column] = False
        self._grid.show_buffer(buffer)
        self._grid.show_hidden(hidden)

    @Slot(object)
    def _answer(self, answer: float) -> None:
        asked = self._asked
        if asked is None:
            return
        self._judge(asked.is_right(answer), asked.reveal)

    @Slot()
    def _reveal(self) -> None:
        if self._asked is not None:
            self._view.show_verdict(Verdict(None, self._asked.reveal))
        elif self._is_active:
            text = coverage_result(self._found, covered_pixels(self._session.stage_trace))
            self._session.go_to(self._session.stage_trace.steps.count)
            self._view.show_verdict(Verdict(None, text))

    @Slot()
    def _next(self) -> None:
        self._session.step(1, Level.PIXEL)

    @Slot(int, int)
    def _click(self, column: int, row: int) -> None:
        """Judge a pixel that is said to be covered."""
        cursor = self._session.cursor
        is_asked = (
            self._is_active and self._asked is None and cursor.stage == "raster" and cursor.position == 0
        )
        first_column, first_row, _, _ = self._session.trace.source.raster.bounds
        pixel = column + first_column, row + first_row
        if not is_asked or pixel in self._found:
            return
        self._found.add(pixel)
        self._hide_coverage()
        is_covered = pixel in covered_pixels(self._session.stage_trace)
        self._judge(is_covered, coverage_reveal(*pixel, is_covered))

    def _judge(self, is_right: bool, text: str) -> None:
        self._count += 1
        self._right += is_right
        self._view.show_verdict(Verdict(is_right, text))
        self._view.show_count(self._right, self._count)

    @Slot()
    def _cursor_moved(self) -> None:
        if self._is_active:
            self._ask()
