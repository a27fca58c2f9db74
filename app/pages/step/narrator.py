"""What is said after a step: sentence, line of the algorithm, formula, the value at the pixel, and what is asked."""

from PySide6.QtCore import QObject, QTimer, Slot
from PySide6.QtGui import QAccessible

from app.pages.step.inspector_column import InspectorColumn
from app.session.cursor import Cursor
from app.session.moment import Moment
from core.stages.declared import stage_of
from widgets.basics.accessible import announce
from widgets.grid.pixel_grid import PixelGrid
from widgets.timeline.transport import Timeline

REST_MILLISECONDS = 150
"""Steps that follow each other faster than this are not said: only the one that is reached."""


class StepNarrator(QObject):
    """Has a screen reader say what stands in the inspector now, and the value of the pinned or pointed pixel."""

    def __init__(
        self,
        cursor: Cursor,
        column: InspectorColumn,
        grid: PixelGrid,
        timeline: Timeline,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._cursor, self._column, self._grid, self._timeline = cursor, column, grid, timeline
        self._said = ("", "", "", "", "")
        """Stage, level, step, value and question that were said last."""
        self._rest = QTimer(self)
        self._rest.setSingleShot(True)
        self._rest.setInterval(REST_MILLISECONDS)
        self._rest.timeout.connect(self._say)

    def owe(self, moment: Moment) -> None:
        """Say what is shown as soon as nothing moves any more."""
        self._cursor = moment.cursor
        if QAccessible.isActive():
            self._rest.start()

    @Slot()
    def _say(self) -> None:
        """Say what differs from what was said last."""
        level = self._timeline.level_buttons[self._cursor.level].accessibleName()
        stage = f"Stage {stage_of(self._cursor.stage).short_title}"
        column, question = self._column, self._column.prediction.question
        texts = (column.sentence.text(), column.listing.accessibleDescription(), column.formula.spoken())
        step = ". ".join(text.rstrip(".") for text in texts if text)
        asked = question.text() if question.isVisible() else ""
        now = (stage, level, step, self._grid.spoken_description(), asked)
        new = [text for text, before in zip(now, self._said, strict=True) if text and text != before]
        self._said = now
        announce(column.sentence, ". ".join(new), is_urgent=step in new)
