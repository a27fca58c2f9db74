"""What a plan comes to: the verdict in one line, the numbers under it, and what was seen in the scene."""

from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLabel, QScrollArea, QWidget

from widgets.basics.controls import button_with_tip, column_layout, row_layout
from widgets.basics.fold import Fold
from widgets.basics.labels import ElidedLabel, set_role, text_label
from widgets.basics.marks import Mark, mark_pixmap
from widgets.basics.theme import current_theme, theme_notifier


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
