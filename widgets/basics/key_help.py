"""The page that ``?`` opens: every key, by group, with a field that finds."""

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtGui import QHideEvent, QKeyEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QGridLayout, QLineEdit, QScrollArea, QVBoxLayout, QWidget

from widgets.basics.controls import button_with_tip, column_layout, flat_button, row_layout
from widgets.basics.flow_layout import FlowLayout
from widgets.basics.labels import text_label
from widgets.basics.theme import current_theme, theme_notifier

_COLUMN_WIDTH = 360
_MOST_KEYS = 160
"""Width of the keys of an entry, at most: more of them stand on more lines."""


@dataclass(frozen=True)
class KeyEntry:
    """One line of the table of keys."""

    group: str
    keys: str
    """As shown, several apart by ``, ``: ``Left, Right``."""
    what: str


class KeyHelp(QWidget):
    """Shows a table of keys in as many columns as fit; typing narrows it, Escape closes."""

    closed = Signal()
    """The user wants to leave the page."""
    change_wanted = Signal()
    """The user wants other keys."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setProperty("role", "panel")
        self.setAccessibleName("Keys")
        self._entries: tuple[KeyEntry, ...] = ()
        self._columns = 0
        title = text_label("Keys", self, role="title")
        self.search = QLineEdit(self)
        self.search.setPlaceholderText("Find a key or what it does")
        self.search.setAccessibleName("Find a key")
        self.search.setClearButtonEnabled(True)
        self.search.setMaximumWidth(320)
        self.search.textChanged.connect(self._narrow)
        close = flat_button("✕", "Close the keys page", "Close (Escape)", self)
        close.clicked.connect(self.closed)
        self.close_button = close
        self.change_button = button_with_tip("Change keys…", "Give actions other keys, or none", self)
        self.change_button.clicked.connect(self.change_wanted)
        self.none_found = text_label("No key does that.", self, role="muted")
        self.none_found.hide()
        self._scroll = QScrollArea(self)
        self._scroll.setWidgetResizable(True)
        self._scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        top = row_layout(spacing=12)
        top.addWidget(title)
        top.addWidget(self.search, 1)
        top.addStretch(1)
        top.addWidget(self.change_button)
        top.addWidget(close)
        layout = column_layout(self, 12, margins=(16, 12, 16, 12))
        layout.addLayout(top)
        layout.addWidget(self.none_found)
        layout.addWidget(self._scroll, 1)
        theme_notifier().theme_changed.connect(self._rebuild)

    @Slot(object)
    def show_keys(self, entries: Sequence[KeyEntry]) -> None:
        """Show a table of keys; groups stand in the order in which they first appear."""
        self._entries = tuple(entries)
        self._rebuild()

    def shown_entries(self) -> tuple[KeyEntry, ...]:
        """Return the entries that the typed text leaves."""
        words = self.search.text().lower().split()
        return tuple(
            entry
            for entry in self._entries
            if all(word in f"{entry.group} {entry.keys} {entry.what}".lower() for word in words)
        )

    def showEvent(self, event: QShowEvent) -> None:
        """Begin in the field that finds."""
        super().showEvent(event)
        self._build()
        self.search.setFocus(Qt.FocusReason.OtherFocusReason)

    def hideEvent(self, event: QHideEvent) -> None:
        """Leave no hundreds of labels behind, all of which another theme would be given."""
        super().hideEvent(event)
        if (body := self._scroll.takeWidget()) is not None:
            body.deleteLater()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Clear the field with Escape, then close."""
        if event.key() != Qt.Key.Key_Escape:
            super().keyPressEvent(event)
        elif self.search.text():
            self.search.clear()
        else:
            self.closed.emit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Use the room for more columns."""
        super().resizeEvent(event)
        if self._column_count() != self._columns:
            self._rebuild()

    def _column_count(self) -> int:
        width = round(_COLUMN_WIDTH * current_theme().text_px / 13)
        return max(1, self.width() // width)

    def _key_width(self, entries: Sequence[KeyEntry]) -> int:
        """Return one width for the keys of a column, so that what they do lines up."""
        cap = text_label("", self, role="key")
        cap.ensurePolished()
        metrics, border, spacing = cap.fontMetrics(), cap.sizeHint().width() + 2, 4
        cap.deleteLater()
        rows = [
            [metrics.horizontalAdvance(key) + border for key in entry.keys.split(", ")] for entry in entries
        ]
        whole = max((sum(row) + spacing * (len(row) - 1) for row in rows), default=0)
        widest = max((width for row in rows for width in row), default=0)
        return max(widest, min(whole, round(_MOST_KEYS * current_theme().text_px / 13)))

    @Slot()
    def _narrow(self) -> None:
        self._rebuild()

    @Slot()
    def _rebuild(self) -> None:
        """Show what there is now, or when the page is opened: hundreds of labels that few ask for take their time."""
        if self.isVisible():
            self._build()

    def _build(self) -> None:
        self._columns = self._column_count()
        entries = self.shown_entries()
        self.none_found.setVisible(bool(self._entries) and not entries)
        groups = {entry.group: [e for e in entries if e.group == entry.group] for entry in entries}
        body = QWidget()
        body.setProperty("role", "panel")
        body.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        row = row_layout(body, 32)
        stacks = [QVBoxLayout() for _ in range(self._columns)]
        heights = [0] * self._columns
        placed: list[list[tuple[str, list[KeyEntry]]]] = [[] for _ in stacks]
        for name, members in groups.items():
            # The shortest column so far takes the next group.
            place = heights.index(min(heights))
            heights[place] += len(members) + 2
            placed[place].append((name, members))
        for stack, boxes in zip(stacks, placed, strict=True):
            key_width = self._key_width([entry for _, members in boxes for entry in members])
            for name, members in boxes:
                stack.addWidget(_group(name, members, key_width))
            stack.setSpacing(16)
            stack.addStretch(1)
            row.addLayout(stack, 1)
        self._scroll.setWidget(body)


def _group(name: str, entries: Sequence[KeyEntry], key_width: int) -> QWidget:
    box = QWidget()
    grid = QGridLayout(box)
    grid.setContentsMargins(0, 0, 0, 0)
    grid.setHorizontalSpacing(12)
    grid.setVerticalSpacing(6)
    grid.setColumnStretch(1, 1)
    heading = text_label(name, None, role="title")
    grid.addWidget(heading, 0, 0, 1, 2)
    for number, entry in enumerate(entries, start=1):
        caps = QWidget()
        caps.setFixedWidth(key_width)
        row = FlowLayout(caps, 4)
        for key in entry.keys.split(", "):
            row.addWidget(text_label(key, None, role="key"))
        what = text_label(entry.what, None, wraps=True)
        grid.addWidget(caps, number, 0, Qt.AlignmentFlag.AlignTop)
        grid.addWidget(what, number, 1)
    return box
