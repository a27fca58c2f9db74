"""Ask this: what is on the Step page as a question of the exercises, with a line to hand out."""

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Slot

from app.pages.page_bar import Page
from app.session.session import Session

if TYPE_CHECKING:
    from lessons.exercises.screen import Screen  # All exercises come along: not before something is asked.

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
        from lessons.exercises.draws import Draws
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
