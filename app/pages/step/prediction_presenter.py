"""Predict, then reveal: asks about the next step, or about coverage as a whole, and says at once what is right."""

import numpy as np
from PySide6.QtCore import QObject, Slot

from app.pages.step.grid_presenter import GridPresenter
from app.pages.step.guesses import Guesses
from app.session.session import Session
from core.explain import question
from core.explain.records import Asked, Verdict
from core.explain.subjects.fills import COVERAGE_QUESTION, coverage_result, coverage_reveal
from core.records.arrays import Flags
from core.records.steps import Level
from widgets.grid.pixel_grid import PixelGrid
from widgets.inspector.prediction import PredictionView

STAGE_DONE = "This stage is done. Right goes on to the next stage; P ends predicting."
NOTHING_ASKED = "The next step needs no prediction. Press Right to do it; P ends predicting."


class PredictionPresenter(QObject):
    """Runs the questions while it is active."""

    def __init__(
        self,
        session: Session,
        view: PredictionView,
        grid: PixelGrid,
        grids: GridPresenter,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._session, self._view, self._grid, self._grids = session, view, grid, grids
        self._asked: Asked | None = None
        self._guesses: Guesses | None = None
        self._is_active = False
        self._right = self._count = 0
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
        self._view.show_count(0, 0)
        self._session.set_predicting(is_active)
        if is_active:
            self._ask()
        else:
            self._asked = None
            self._show_guesses(None)
            self._view.show_question(None)

    def _ask(self) -> None:
        """Ask about the next row of the stage, or about coverage as a whole before the first one."""
        trace, cursor = self._session.stage_trace, self._session.cursor
        self._asked = None
        if trace.stage == "raster" and cursor.position == 0 and trace.steps.count:
            covered = self._covered()
            self._show_guesses(Guesses(np.zeros_like(covered), covered))
            self._view.show_question(COVERAGE_QUESTION)
            return
        self._show_guesses(None)
        row = trace.steps.rows_done(cursor.position)
        is_done = row >= trace.steps.row_count
        if not is_done:
            self._asked = question(trace, row)
        if self._asked is None:
            self._view.show_question(None, STAGE_DONE if is_done else NOTHING_ASKED)
        else:
            self._view.show_question(self._asked.question)

    def _covered(self) -> Flags:
        """Return (H, W) bool, the pixels that are covered when the stage is done."""
        trace, raster = self._session.stage_trace, self._session.trace.source.raster
        covered = np.zeros(raster.shape, bool)
        pixels = trace.pixel[trace.marks["covered"] & (trace.pixel[:, 0] >= 0)]
        covered.ravel()[raster.index(pixels[:, 0], pixels[:, 1])] = True
        return covered

    def _show_guesses(self, guesses: Guesses | None) -> None:
        if guesses is not self._guesses:
            self._guesses = guesses
            self._grid.set_brush(guesses is not None and not guesses.is_revealed)
            self._grids.show_guesses(guesses)

    @Slot(object)
    def _answer(self, answer: float) -> None:
        if self._asked is not None:
            self._judge(self._asked.is_right(answer), self._asked.reveal)

    @Slot()
    def _reveal(self) -> None:
        guesses = self._guesses
        if self._asked is not None:
            self._view.show_verdict(Verdict(None, self._asked.reveal))
        elif guesses is not None:
            self._session.go_to(self._session.stage_trace.steps.count)
            self._show_guesses(Guesses(guesses.clicked, guesses.covered, is_revealed=True))
            self._view.show_verdict(Verdict(None, coverage_result(guesses.clicked, guesses.covered)))

    @Slot()
    def _next(self) -> None:
        self._session.step(1, Level.PIXEL)

    @Slot(int, int)
    def _click(self, column: int, row: int) -> None:
        """Judge a pixel that is said to be covered."""
        guesses = self._guesses
        if guesses is None or guesses.is_revealed or guesses.clicked[row, column]:
            return
        clicked = guesses.clicked.copy()
        clicked[row, column] = True
        self._show_guesses(Guesses(clicked, guesses.covered))
        is_covered = bool(guesses.covered[row, column])
        first_column, first_row, _, _ = self._session.trace.source.raster.bounds
        self._judge(is_covered, coverage_reveal(column + first_column, row + first_row, is_covered))

    def _judge(self, is_right: bool, text: str) -> None:
        self._count += 1
        self._right += is_right
        self._view.show_verdict(Verdict(is_right, text))
        self._view.show_count(self._right, self._count)

    @Slot()
    def _cursor_moved(self) -> None:
        if self._is_active:
            self._ask()
