"""What a plan chose, stage by stage: the method, what it replaces, why, and how the prediction turned out."""

from dataclasses import dataclass
from enum import Enum

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtGui import QPixmap
from PySide6.QtWidgets import QLabel, QScrollArea, QSizePolicy, QVBoxLayout, QWidget

from widgets.basics.controls import button_with_tip, column_layout, row_layout
from widgets.basics.labels import set_role, text_label
from widgets.basics.marks import Mark, mark_pixmap
from widgets.basics.theme import current_theme, theme_notifier


class Verdict(Enum):
    """How a prediction turned out."""

    OPEN = ""
    """Nothing was predicted, or nothing has been measured yet."""
    HELD = "the prediction held"
    WRONG = "the prediction was wrong"


@dataclass(frozen=True)
class PlanRow:
    """The choice at one stage, in words."""

    name: str
    """Key of the stage."""
    stage: str
    chosen: str
    instead: str
    """What it replaces, or that no cheaper method is guaranteed."""
    reason: str
    numbers: str
    """Predicted and measured error and time; empty: nothing was predicted."""
    verdict: Verdict = Verdict.OPEN
    is_needed: bool = False
    """Whether something expensive is kept: it stands out."""
    can_draw: bool = False
    """Whether there is a difference to show."""


LONGEST_WORD = 9
"""Width of the longest word in the name of a method, in heights of the text."""


class PlanRowView(QWidget):
    """One row; its button asks for the difference picture."""

    picture_requested = Signal(str)

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._row = PlanRow(name, "", "", "", "", "")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.stage, self.chosen, self.instead = QLabel(self), QLabel(self), QLabel(self)
        self.reason, self.numbers, self.verdict = QLabel(self), QLabel(self), QLabel(self)
        self.mark = QLabel(self)
        self.picture_button = button_with_tip(
            "Difference", "Draw this choice alone, the reference settings, and the difference", self
        )
        self.picture_button.clicked.connect(self._ask)
        policy = self.picture_button.sizePolicy()
        policy.setRetainSizeWhenHidden(True)  # The columns of all rows stand under one another.
        self.picture_button.setSizePolicy(policy)
        font = self.chosen.font()
        font.setBold(True)
        self.chosen.setFont(font)
        for label in (self.stage, self.instead):
            label.setProperty("role", "muted")
        for label in (self.stage, self.chosen, self.instead, self.reason, self.numbers, self.verdict):
            label.setWordWrap(True)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._lay_out()
        theme_notifier().theme_changed.connect(self._paint_mark)

    def _lay_out(self) -> None:
        row = row_layout(self, 12, margins=(12, 8, 8, 8))
        row.addLayout(_stack(self.stage, self.chosen, self.instead), 5)
        row.addLayout(_stack(self.reason), 8)
        row.addLayout(_stack(self.numbers, self.verdict), 6)
        for widget in (self.mark, self.picture_button):
            row.addWidget(widget, 0, Qt.AlignmentFlag.AlignTop)

    def show_row(self, row: PlanRow) -> None:
        """Show the choice at one stage."""
        self._row = row
        for label, text in (
            (self.stage, row.stage),
            (self.chosen, row.chosen),
            (self.instead, row.instead),
            (self.reason, row.reason),
            (self.numbers, row.numbers),
            (self.verdict, row.verdict.value.capitalize()),
        ):
            label.setText(text)
            # An empty column keeps its share of the row.
            label.setVisible(bool(text) or label is self.numbers)
        set_role(self.verdict, {Verdict.HELD: "good", Verdict.WRONG: "bad"}.get(row.verdict, "muted"))
        set_role(self, "kept" if row.is_needed else "panel")
        self.picture_button.setVisible(row.can_draw)
        self.setAccessibleName(f"{row.stage}: {row.chosen}")
        self.picture_button.setAccessibleName(f"Difference of {row.stage}")
        self._paint_mark()

    @Slot()
    def _paint_mark(self) -> None:
        side = current_theme().text_px + 2
        self.chosen.setMinimumWidth(LONGEST_WORD * current_theme().text_px)
        shape = {Verdict.HELD: Mark.RIGHT, Verdict.WRONG: Mark.WRONG}.get(self._row.verdict)
        self.mark.setFixedSize(side, side)
        empty = QPixmap(side, side)
        empty.fill(Qt.GlobalColor.transparent)
        self.mark.setPixmap(mark_pixmap(shape, side, self.devicePixelRatioF()) if shape else empty)
        self.mark.setToolTip(self._row.verdict.value)

    @Slot()
    def _ask(self) -> None:
        self.picture_requested.emit(self._row.name)


def _stack(*labels: QLabel) -> QVBoxLayout:
    """Return a column of labels that share the room of a row with the other columns."""
    column = column_layout(spacing=2)
    for label in labels:
        # Each row by itself must share its width in the same way, whatever is written in it.
        label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Minimum)
        column.addWidget(label)
    column.addStretch(1)
    return column


class PlanRows(QScrollArea):
    """All rows under one another; an empty one says what they are for."""

    picture_requested = Signal(str)
    """Name of the stage whose difference picture the user wants."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.rows: dict[str, PlanRowView] = {}
        self._body = QWidget()
        self._layout = column_layout(self._body, 4)
        self.empty = text_label("", self._body, wraps=True)
        self.empty.setContentsMargins(12, 12, 12, 12)
        self.empty.setProperty("role", "muted")
        self._layout.addWidget(self.empty)
        self._layout.addStretch(1)
        self.setWidget(self._body)
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setAccessibleName("Choices of the plan")

    def show_rows(self, rows: tuple[PlanRow, ...], empty: str = "") -> None:
        """Show the choices of a plan; where there are none the text ``empty``."""
        self.empty.setText(empty)
        self.empty.setVisible(not rows)
        if [row.name for row in rows] != list(self.rows):
            for view in self.rows.values():
                self._layout.removeWidget(view)
                view.hide()
                view.deleteLater()
            self.rows = {row.name: PlanRowView(row.name, self._body) for row in rows}
            for place, view in enumerate(self.rows.values()):
                view.picture_requested.connect(self.picture_requested)
                self._layout.insertWidget(place + 1, view)
        for row in rows:
            self.rows[row.name].show_row(row)
