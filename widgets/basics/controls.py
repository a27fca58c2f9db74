"""The controls that panes are made of: labels, buttons, and layouts that give them room."""

import re
from bisect import bisect_left
from typing import TypeVar

from PySide6.QtCore import QEvent, QPoint, QRect, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QTextDocumentFragment
from PySide6.QtWidgets import (
    QAbstractButton,
    QHBoxLayout,
    QLabel,
    QLayout,
    QLayoutItem,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

# Rows and columns of widgets with their gaps, and buttons that say what they do.


Margins = tuple[int, int, int, int]
"""Logical pixels at the left, top, right and bottom."""
Box = TypeVar("Box", QHBoxLayout, QVBoxLayout)
LEAST_TARGET = 24
"""Least width and height of what is clicked, in logical pixels (WCAG 2.2, 2.5.8)."""
NO_MARGINS: Margins = (0, 0, 0, 0)


def row_layout(
    parent: QWidget | None = None, spacing: int | None = None, margins: Margins = NO_MARGINS
) -> QHBoxLayout:
    """Return an empty row, the layout of ``parent`` if there is one; ``spacing``: between two widgets."""
    return _with_gaps(QHBoxLayout() if parent is None else QHBoxLayout(parent), spacing, margins)


def column_layout(
    parent: QWidget | None = None, spacing: int | None = None, margins: Margins = NO_MARGINS
) -> QVBoxLayout:
    """Return an empty column, as `row_layout`."""
    return _with_gaps(QVBoxLayout() if parent is None else QVBoxLayout(parent), spacing, margins)


def _with_gaps(box: Box, spacing: int | None, margins: Margins) -> Box:
    box.setContentsMargins(*margins)
    if spacing is not None:
        box.setSpacing(spacing)
    return box


def keep_room(widget: QWidget, is_kept: bool = True) -> None:
    """Let a widget have its room while it is hidden, or no longer."""
    policy = widget.sizePolicy()
    policy.setRetainSizeWhenHidden(is_kept)
    widget.setSizePolicy(policy)


def button_with_tip(text: str, tip: str, parent: QWidget) -> QPushButton:
    """Return a button that says what it does when it is pointed at."""
    button = QPushButton(text, parent)
    button.setToolTip(tip)
    return button


def flat_button(text: str, name: str, tip: str, parent: QWidget) -> QToolButton:
    """Return a button without a frame: one sign, with a name for who does not see it, and a tip."""
    button = QToolButton(parent)
    button.setText(text)
    button.setProperty("flat", True)
    button.setAccessibleName(name)
    button.setToolTip(tip)
    return button


def closing_button(what: str, parent: QWidget) -> QToolButton:
    """Return the cross that closes ``what``, as ``the case``; Escape does the same."""
    return flat_button("✕", f"Close {what}", f"Close {what} (Escape)", parent)


def wrap_text(button: QAbstractButton, text: str, width: int) -> None:
    """Write a text on a button in as many lines as it takes in a width; a screen reader hears one."""
    metrics = button.fontMetrics()
    room = width - (button.sizeHint().width() - metrics.size(0, button.text()).width())
    lines = [""]
    for word in text.split():
        longer = f"{lines[-1]} {word}".strip()
        if lines[-1] and metrics.horizontalAdvance(longer) > room:
            lines.append(word)
        else:
            lines[-1] = longer
    button.setMinimumWidth(1)
    button.setAccessibleName(text)
    button.setText("\n".join(lines))


# Labels: text that is cut to its width, text that scrolls, and a role that the style sheet knows.


class WrappedLabel(QLabel):
    """A text in as many lines as it needs; layouts ask many times how high it is, and it is measured once."""

    def __init__(self, text: str, parent: QWidget | None) -> None:
        self._heights: dict[tuple[int, int], int] = {}
        """By width and least height, of this text in this type."""
        super().__init__(text, parent)

    def setText(self, text: str) -> None:
        """Show another text."""
        self._heights.clear()
        super().setText(text)

    def changeEvent(self, event: QEvent) -> None:
        """Measure another type anew."""
        self._heights.clear()
        super().changeEvent(event)

    def heightForWidth(self, width: int) -> int:
        """Return the height of the text in a width; Qt calls this."""
        asked = width, self.minimumHeight()
        if asked not in self._heights:
            self._heights[asked] = super().heightForWidth(width)
        return self._heights[asked]


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
    # Measuring a text that can be selected also lays it out: without that Qt would paint it twice.
    label = WrappedLabel(text, parent) if wraps and not is_selectable else QLabel(text, parent)
    label.setWordWrap(wraps)
    if role:
        label.setProperty("role", role)
    if name:
        label.setAccessibleDescription(name)  # A name would be read instead of the text.
    if is_selectable:
        label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    return label


_OPERATOR = re.compile(r"(?<= [−+·=≈≠<>≥≤-]) (?=\S)")
_SYMBOL = re.compile(r"\b\w{1,3} (?=[=≈≠<>≥≤]\u00a0)")


def unbroken(text: str) -> str:
    """Return a text in which a line ends before an operator, not behind it, and not between a symbol and its sign."""
    return _SYMBOL.sub(lambda found: found[0][:-1] + "\u00a0", _OPERATOR.sub("\u00a0", text))


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


# A layout that fills one line after another, as text does: controls keep their sizes in a narrow window.


class FlowLayout(QLayout):
    """Places items from left to right and begins a new line where the next does not fit."""

    def __init__(self, parent: QWidget | None = None, spacing: int = 8, is_spread: bool = False) -> None:
        """Make an empty layout; ``is_spread``: the last item of several on a line stands at its right end."""
        super().__init__(parent)
        self._items: list[QLayoutItem] = []
        self._heights: dict[int, int] = {}
        """By width, as long as nothing in it has changed."""
        self._is_spread = is_spread
        self.setSpacing(spacing)
        self.setContentsMargins(0, 0, 0, 0)

    def addItem(self, item: QLayoutItem) -> None:
        """Take an item; Qt calls this."""
        self._items.append(item)

    def insert_widget(self, index: int, widget: QWidget) -> None:
        """Take a widget before the item of an index."""
        self.addWidget(widget)
        self._items.insert(index, self._items.pop())
        self.invalidate()

    def count(self) -> int:
        """Return the number of items."""
        return len(self._items)

    def itemAt(self, index: int) -> QLayoutItem:
        """Return an item; ``None`` beyond the last."""
        return self._items[index] if 0 <= index < len(self._items) else None  # type: ignore[return-value]

    def takeAt(self, index: int) -> QLayoutItem:
        """Remove an item and return it; ``None`` beyond the last."""
        return self._items.pop(index) if 0 <= index < len(self._items) else None  # type: ignore[return-value]

    def expandingDirections(self) -> Qt.Orientation:
        """Take no more room than is needed."""
        return Qt.Orientation(0)

    def hasHeightForWidth(self) -> bool:
        """Say that a narrower layout is a higher one."""
        return True

    def heightForWidth(self, width: int) -> int:
        """Return the height of all lines."""
        if width not in self._heights:
            self._heights[width] = self._place(QRect(0, 0, width, 0), is_only_measured=True)
        return self._heights[width]

    def invalidate(self) -> None:
        """Forget what was measured; Qt calls this."""
        self._heights.clear()
        super().invalidate()

    def setGeometry(self, rect: QRect) -> None:
        """Place the items."""
        super().setGeometry(rect)
        self._place(rect, is_only_measured=False)

    def sizeHint(self) -> QSize:
        """Return the size of all items on one line."""
        sizes = [item.sizeHint() for item in self._items if not item.isEmpty()]
        width = sum(size.width() for size in sizes) + self.spacing() * max(len(sizes) - 1, 0)
        return QSize(width, max((size.height() for size in sizes), default=0))

    def minimumSize(self) -> QSize:
        """Return the size of the largest item."""
        size = QSize()
        for item in self._items:
            size = size.expandedTo(item.minimumSize())
        return size

    def _place(self, rect: QRect, is_only_measured: bool) -> int:
        """Go through the lines; return their height."""
        x, y, line_height = rect.x(), rect.y(), 0
        line: list[tuple[QLayoutItem, int, QSize]] = []
        for item in self._items:
            if item.isEmpty():
                continue
            size = item.sizeHint()
            size.setWidth(min(size.width(), max(rect.width(), 1)))
            if line and x + size.width() > rect.right() + 1:
                self._set_line(line, rect, y, line_height, is_only_measured)
                x, y, line_height, line = rect.x(), y + line_height + self.spacing(), 0, []
            line.append((item, x, size))
            x += size.width() + self.spacing()
            line_height = max(line_height, size.height())
        self._set_line(line, rect, y, line_height, is_only_measured)
        return y + line_height - rect.y()

    def _set_line(
        self,
        line: list[tuple[QLayoutItem, int, QSize]],
        rect: QRect,
        y: int,
        height: int,
        is_only_measured: bool,
    ) -> None:
        """Place the items of one line, centred on it."""
        for place, (item, x, size) in enumerate(line if not is_only_measured else ()):
            is_at_end = self._is_spread and 0 < place == len(line) - 1
            left = rect.right() + 1 - size.width() if is_at_end else x
            item.setGeometry(QRect(QPoint(left, y + (height - size.height()) // 2), size))
