"""Labels: text that is cut to its width, text that scrolls, and a role that the style sheet knows."""

from bisect import bisect_left

from PySide6.QtCore import QRect, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QTextDocumentFragment
from PySide6.QtWidgets import QLabel, QScrollArea, QSizePolicy, QWidget


def text_label(
    text: str,
    parent: QWidget | None,
    role: str = "",
    *,
    name: str = "",
    wraps: bool = False,
    is_selectable: bool = False,
) -> QLabel:
    """Return a text: its role in the style sheet, what it is for who hears it, and what may be done with it."""
    label = QLabel(text, parent) if parent is not None else QLabel(text)
    label.setWordWrap(wraps)
    if role:
        label.setProperty("role", role)
    if name:
        label.setAccessibleDescription(name)  # A name would be read instead of the text.
    if is_selectable:
        label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    return label


class ElidedLabel(QLabel):
    """A label of plain text that can be made as narrow as one likes."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)

    def setText(self, text: str) -> None:
        """Show a text."""
        super().setText(text)
        self.setToolTip(text)

    def minimumSizeHint(self) -> QSize:
        """Return the height of a line."""
        return QSize(0, super().sizeHint().height())

    def paintEvent(self, event: QPaintEvent) -> None:
        """Write as much as fits."""
        with QPainter(self) as painter:
            text = self.fontMetrics().elidedText(self.text(), Qt.TextElideMode.ElideRight, self.width())
            flags = int(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
            self.style().drawItemText(
                painter, self.rect(), flags, self.palette(), self.isEnabled(), text, self.foregroundRole()
            )


class CutLabel(QLabel):
    """A label of plain text in several lines, which ends in an ellipsis where it is higher than its place."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setWordWrap(True)

    def seen_text(self) -> str:
        """Return as much of the text as has room, up to a whole word."""
        text, area = self.text(), self.contentsRect()

        def has_room(part: str) -> bool:
            flags = int(Qt.TextFlag.TextWordWrap)
            wanted = self.fontMetrics().boundingRect(QRect(0, 0, area.width(), 1), flags, part)
            return wanted.height() <= area.height()

        if has_room(text):
            return text
        ends = [place for place, letter in enumerate(text) if letter.isspace()]
        count = bisect_left(ends, True, key=lambda end: not has_room(f"{text[:end]} …"))
        return f"{text[: ends[count - 1]]} …" if count else text

    def paintEvent(self, event: QPaintEvent) -> None:
        """Write what has room."""
        with QPainter(self) as painter:
            flags = int(self.alignment() | Qt.TextFlag.TextWordWrap)
            self.style().drawItemText(
                painter,
                self.contentsRect(),
                flags,
                self.palette(),
                self.isEnabled(),
                self.seen_text(),
                self.foregroundRole(),
            )


class Readout(QScrollArea):
    """Shows rich text that can be selected and copied."""

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.label = QLabel()
        self.label.setWordWrap(True)
        self.label.setTextFormat(Qt.TextFormat.RichText)
        self.label.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        self.label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.label.setContentsMargins(8, 8, 8, 8)
        self.setAccessibleName(name)
        self.setWidget(self.label)
        self.setWidgetResizable(True)
        self.setFrameShape(QScrollArea.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)

    def show_text(self, text: str) -> None:
        """Show rich text from its beginning."""
        if text != self.label.text():
            self.label.setText(text)
            self.verticalScrollBar().setValue(0)

    def text(self) -> str:
        """Return the rich text that is shown."""
        return self.label.text()

    def spoken_description(self) -> str:
        """Return the text for a screen reader: it has come to the pane, not to the label in it."""
        return QTextDocumentFragment.fromHtml(self.text()).toPlainText()


def set_role(widget: QWidget, role: str) -> None:
    """Give a widget a role of the style sheet (``muted``, ``title``, ``good``, ``bad``) and restyle it."""
    if widget.property("role") != role:
        widget.setProperty("role", role)
        widget.style().unpolish(widget)
        widget.style().polish(widget)
