"""Questions about what is on the Step page: Predict asks about the next step, Ask this takes an exercise."""

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Slot

from app.pages.page_bar import Page
from app.pages.step.grid_overlays import Guesses
from app.pages.step.grid_presenter import GridPresenter
from app.session.moment import Moment
from app.session.session import Session
from core.explain.records import Verdict
from core.records.steps import Level
from widgets.grid.pixel_grid import PixelGrid
from widgets.inspector.prediction import PredictionView

if TYPE_CHECKING:
    from app.pages.step.prediction import Prediction
    from lessons.exercises.screen import Screen


# Predict, then reveal: asks about the next step, or about coverage as a whole, and says at once what is
# right.


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
        self._asked: Prediction | None = None
        self._guesses: Guesses | None = None
        self._right = self._count = 0
        self.is_active = False
        """Whether it asks: a lesson hides what comes next for a question of its own."""
        view.answer_given.connect(self._answer)
        view.reveal_requested.connect(self._reveal)
        view.next_requested.connect(self._next)
        grid.pixel_clicked.connect(self._click)

    def set_active(self, is_active: bool) -> None:
        """Start asking, or stop and show everything."""
        self.is_active = is_active
        self._right = self._count = 0
        self._view.show_count(0, 0)
        self._session.set_predicting(is_active)
        if is_active:
            self._ask()
        else:
            self._show(None)
            self._view.show_question(None)

    def _ask(self) -> None:
        """Ask about the next row of the stage, or about coverage as a whole before the first one."""
        # The questions of the exercises are imported when the first one is asked: the window does not wait for them.
        from app.pages.step.prediction import predict

        trace, position = self._session.stage_trace, self._session.cursor.position
        self._show(predict(trace, self._session.trace.source.raster, position))
        if self._asked is None:
            is_done = position >= trace.steps.count
            self._view.show_question(None, STAGE_DONE if is_done else NOTHING_ASKED)
        else:
            self._view.show_question(self._asked.question)

    def _show(self, asked: "Prediction | None") -> None:
        """Take a question, and show what was clicked of its pixels."""
        self._asked = asked
        guesses = None if asked is None else asked.guesses
        if guesses is not self._guesses:
            self._guesses = guesses
            self._grid.set_brush(guesses is not None and not guesses.is_revealed)
            self._grids.show_guesses(guesses)

    @Slot(object)
    def _answer(self, value: float) -> None:
        if self._asked is not None:
            self._judge(self._asked.verdict(value))

    @Slot()
    def _reveal(self) -> None:
        if self._asked is not None:
            asked, verdict = self._asked.revealed()
            if asked is not self._asked:
                self._session.go_to(self._session.stage_trace.steps.count)
            self._show(asked)
            self._view.show_verdict(verdict)
            self._session.reveal()

    @Slot()
    def _next(self) -> None:
        self._session.step(1, Level.PIXEL)

    @Slot(int, int)
    def _click(self, column: int, row: int) -> None:
        """Judge a pixel that is said to be covered."""
        clicked = None if self._asked is None else self._asked.clicked(column, row)
        if clicked is not None:
            asked, verdict = clicked
            self._show(asked)
            self._judge(verdict)

    def _judge(self, verdict: Verdict) -> None:
        self._count += 1
        self._right += bool(verdict.is_right)
        self._view.show_verdict(verdict)
        self._view.show_count(self._right, self._count)
        self._session.reveal()

    def refresh(self, moment: Moment) -> None:
        """Ask for what comes next, while the user predicts."""
        if moment.is_predicting and self.is_active:
            self._ask()


# Ask this: what is on the Step page as a question of the exercises, with a line to hand out.


ONLY_WHOLE = "only the whole view of all triangles can be asked about: press A, then Shift+F"
NO_PIXEL = "Pin a pixel first: its value is asked for."


class AskThis(QObject):
    """Turns the step just done, or the value of the pinned pixel, into the line of a question."""

    def __init__(self, session: Session, page: Page) -> None:
        super().__init__(page)
        self._page = page
        self._session = session

    @Slot()
    def ask_step(self) -> None:
        """Ask about the step just done."""
        cursor = self._session.cursor
        row, _ = self._session.stage_trace.steps.row_at(cursor.position)
        if row < 0:
            self._page.tell("Take a step first: the step just done is asked about.")
        else:
            self._ask(row=row)

    def ask_value(self, buffer: str) -> None:
        """Ask for the value of a buffer at the pinned pixel."""
        pin = self._session.pin
        if pin is None:
            self._page.tell(NO_PIXEL)
        else:
            steps = self._session.stage_trace.steps
            self._ask(buffer=buffer, pixel=pin, rows_done=steps.rows_done(self._session.cursor.position))

    def _ask(self, **what: object) -> None:
        from lessons.exercises.numbers import Draws
        from lessons.exercises.screen import VERSION, screen_template

        try:
            name = self._screen(**what).name
            screen_template(name).make(Draws(0))
        except ValueError as problem:
            self._page.tell(f"This cannot be asked: {problem}.")
        else:
            self._page.question_requested.emit(f"{name} {VERSION}, seed 0")

    def _screen(self, **what: object) -> "Screen":
        from lessons.exercises.screen import Screen, scene_name, settings_of

        document = self._session.document
        if (
            document.raster.origin is not None
            or document.triangle is not None
            or document.before != "earlier"
        ):
            raise ValueError(ONLY_WHOLE)
        return Screen(
            scene_name(document.scene, document.title),
            (document.raster.columns, document.raster.rows),
            settings_of(document.settings),
            self._session.cursor.stage,
            **what,  # type: ignore[arg-type]
        )
