"""A plan: what may differ, what was chosen stage by stage and why, and what that comes to."""

from dataclasses import dataclass
from enum import Enum

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtGui import QPixmap
from PySide6.QtWidgets import QLabel, QScrollArea, QSizePolicy, QToolButton, QVBoxLayout, QWidget

from widgets.basics.controls import (
    ElidedLabel,
    button_with_tip,
    column_layout,
    keep_room,
    row_layout,
    set_role,
    text_label,
)
from widgets.basics.drawing import Mark, mark_pixmap
from widgets.basics.message_bar import RunPanel
from widgets.basics.theme import current_theme, theme_notifier

# A part of a pane that is folded away under its title until it is opened.


class Fold(QWidget):
    """A title that opens and closes the text under it."""

    def __init__(self, title: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._title = title
        self.button = QToolButton(self, toolButtonStyle=Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.button.setProperty("flat", True)
        self.button.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        font = self.button.font()
        font.setBold(True)
        self.button.setFont(font)
        self.text = text_label("", self, wraps=True)
        self.text.setTextFormat(Qt.TextFormat.RichText)
        self.text.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.text.setContentsMargins(8, 0, 8, 8)
        layout = column_layout(self, 0)
        layout.addWidget(self.button)
        layout.addWidget(self.text)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        self.button.clicked.connect(self._toggle)
        self.set_open(False)

    @property
    def is_open(self) -> bool:
        """Whether the text can be read."""
        return self.text.isVisibleTo(self)

    def show_text(self, text: str, note: str = "") -> None:
        """Put rich text under the title, and a ``note`` behind it."""
        self.button.setText(f"{self._title}  {note}".rstrip())
        self.text.setText(text)

    def set_open(self, is_open: bool) -> None:
        """Open or close it."""
        self.text.setVisible(is_open)
        self.button.setArrowType(Qt.ArrowType.DownArrow if is_open else Qt.ArrowType.RightArrow)

    @Slot()
    def _toggle(self) -> None:
        self.set_open(not self.is_open)


# What stands above a plan: how much may differ, how often it is timed, and the analysis.


MOST_COLOR = 255
MOST_PIXELS = 999_999
MOST_ROUNDS = 99
EXACT, WITHIN = "exact", "within"


class PlanControls(RunPanel):
    """Holds the tolerance; offers the analysis, and to use its settings."""

    applying_requested = Signal()
    chart_requested = Signal()
    """The user wants to see the plan's point among the others of the scene."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(
            "Tolerance and analysis",
            "What does this scene need? Press Analyse (F5): for every stage it finds the cheapest method whose picture "
            "stays within the tolerance, says why, and measures whether that was right.",
            "Analyse",
            "Analyse the scene, choose methods, and measure the result (F5)",
            "Stop the analysis; the previous plan is unchanged (Escape)",
            parent,
        )
        self.kind_box = self.box(
            "kind",
            "Tolerance",
            "Allowed difference from the picture with the reference settings. Exact: every byte is equal",
        )
        self.kind_box.addItem("Within", WITHIN)
        self.kind_box.addItem("Exact", EXACT)
        self.color_box = self.number(
            "color", "Colour", "Largest difference of a channel, in 1/255", 0, MOST_COLOR
        )
        self.color_box.setSuffix("/255")
        self.color_box.setValue(2)
        self.pixels_box = self.number(
            "pixels", "Allowed exceptions", "Number of pixels that may differ by more", 0, MOST_PIXELS
        )
        self.pixels_box.setGroupSeparatorShown(True)
        self.rounds_box = self.number(
            "rounds", "Rounds", "Rounds of measurement; more rounds take longer", 1, MOST_ROUNDS
        )
        self.rounds_box.setValue(3)
        self.apply_button = button_with_tip(
            "Apply", "Use these settings for the scene (Ctrl+Return); Undo restores the old ones", self
        )
        self.chart_button = button_with_tip(
            "On the chart", "Show the plan among all methods: Whole pipeline, on the Compare page", self
        )
        self.add_row(
            (
                ("Tolerance", self.kind_box),
                ("Colour", self.color_box),
                ("Allowed exceptions", self.pixels_box),
                ("Rounds", self.rounds_box),
                *(self.start_button, self.cancel_button, self.apply_button, self.chart_button),
                *(self.progress, self.doing),
            )
        )
        self.kind_box.activated.connect(self._show_kind)
        self.apply_button.clicked.connect(self.applying_requested)
        self.chart_button.clicked.connect(self.chart_requested)
        self.show_progress(None)
        self.show_usable(False)

    # What is chosen.

    @property
    def is_exact(self) -> bool:
        """Whether nothing may differ."""
        return bool(self.kind_box.currentData() == EXACT)

    @Slot()
    def _show_kind(self) -> None:
        for box in (self.color_box, self.pixels_box):
            box.setEnabled(not self.is_exact)

    def show_usable(self, is_usable: bool) -> None:
        """Show whether there is a plan to be applied and to be put on the chart."""
        self.apply_button.setEnabled(is_usable)
        self.chart_button.setEnabled(is_usable)


# What a plan chose, stage by stage: the method, what it replaces, why, and how the prediction turned out.


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
        keep_room(self.picture_button)  # The columns of all rows stand under one another.
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


# What a plan comes to: the verdict in one line, the numbers under it, and what was seen in the scene.


@dataclass(frozen=True)
class SummaryRecord:
    """A plan in short."""

    applied: str
    """What applying it has changed; empty: it is not applied."""
    headline: str
    details: str
    is_within: bool | None
    """Whether the tolerance holds; ``None``: it has not been measured yet."""
    about: str
    """Which scene, how large, which tolerance."""
    stale: str
    """Why this is not of what is open; empty: it is."""
    findings: str
    """Rich text."""
    findings_note: str
    advice: str
    """Rich text: how fine the meshes are."""
    can_draw: bool
    """Whether there is a difference to show."""


class PlanSummary(QWidget):
    """Shows a `SummaryRecord`; takes no room without one."""

    undo_requested = Signal()
    """The user wants the settings back that applying has replaced."""
    picture_requested = Signal()
    """The user wants to see where the whole choice differs from the reference settings."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setAccessibleName("Result of the plan")
        self._record: SummaryRecord | None = None
        self.mark, self.headline, self.details = QLabel(self), QLabel(self), QLabel(self)
        self.about, self.stale, self.applied = ElidedLabel(self), QLabel(self), QLabel(self)
        self.headline.setProperty("role", "title")
        self.about.setProperty("role", "muted")
        self.stale.setProperty("role", "bad")
        for label in (self.headline, self.details, self.stale, self.applied):
            label.setWordWrap(True)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.picture_button = button_with_tip(
            "Difference", "Draw all choices together, the reference settings, and the difference (D)", self
        )
        self.picture_button.clicked.connect(self.picture_requested)
        top = row_layout(spacing=8)
        top.addWidget(self.mark, 0, Qt.AlignmentFlag.AlignTop)
        top.addWidget(self.headline, 1)
        top.addWidget(self.picture_button, 0, Qt.AlignmentFlag.AlignTop)
        layout = column_layout(self, 4, margins=(12, 8, 8, 8))
        layout.addWidget(self.stale)
        layout.addLayout(top)
        self.undo_button = button_with_tip("Undo", "Put the settings back that applying has replaced", self)
        self.undo_button.clicked.connect(self.undo_requested)
        done = row_layout(spacing=8)
        done.addWidget(self.applied, 1)
        done.addWidget(self.undo_button, 0, Qt.AlignmentFlag.AlignTop)
        layout.addLayout(done)
        layout.addWidget(self.details)
        layout.addWidget(self.about)
        theme_notifier().theme_changed.connect(self._show_mark)
        self.show_record(None)

    def show_record(self, record: SummaryRecord | None) -> None:
        """Show a plan in short, or nothing."""
        self._record = record
        self.setVisible(record is not None)
        if record is None:
            return
        for label, text in (
            (self.headline, record.headline),
            (self.details, record.details),
            (self.about, record.about),
            (self.stale, record.stale),
            (self.applied, record.applied),
        ):
            label.setText(text)
        self.stale.setVisible(bool(record.stale))
        for widget in (self.applied, self.undo_button):
            widget.setVisible(bool(record.applied))
        self.details.setVisible(bool(record.details))
        set_role(self.details, "muted" if record.stale else "")
        self.picture_button.setEnabled(record.can_draw)
        self._show_mark()

    def _show_mark(self) -> None:
        is_within = None if self._record is None else self._record.is_within
        self.mark.setVisible(is_within is not None)
        if is_within is not None:
            side = current_theme().title_px + 2
            shape = Mark.RIGHT if is_within else Mark.WRONG
            self.mark.setPixmap(mark_pixmap(shape, side, self.devicePixelRatioF()))


class PlanFindings(QScrollArea):
    """Findings in the scene and how fine its meshes are; each can be folded away."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        body = QWidget()
        self.findings, self.advice = Fold("Findings", body), Fold("Mesh detail", body)
        self.hint = text_label("", body, role="muted", wraps=True)
        self.hint.setContentsMargins(8, 8, 8, 8)
        layout = column_layout(body, 4)
        for widget in (self.hint, self.findings, self.advice):
            layout.addWidget(widget)
        layout.addStretch(1)
        self.setWidget(body)
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setAccessibleName("Findings in the scene")
        for fold in (self.findings, self.advice):
            fold.set_open(True)
        self.show_record(None)

    def show_record(self, record: SummaryRecord | None) -> None:
        """Show what a plan is made of, or what will stand here."""
        self.hint.setVisible(record is None)
        self.hint.setText("Findings appear here: signs of w, layers, depth range, texels, highlights.")
        for fold in (self.findings, self.advice):
            fold.setVisible(record is not None)
        if record is not None:
            self.findings.show_text(record.findings, record.findings_note)
            self.advice.show_text(record.advice)

    def toggle_findings(self) -> None:
        """Open or close what was seen."""
        self.findings.set_open(not self.findings.is_open)
