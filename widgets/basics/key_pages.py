"""The pages of keys: the one that ``?`` opens shows every key, by group; on the other they are changed."""

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtGui import QHideEvent, QKeyEvent, QKeySequence, QResizeEvent, QShowEvent
from PySide6.QtWidgets import (
    QCheckBox,
    QGridLayout,
    QKeySequenceEdit,
    QLineEdit,
    QScrollArea,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from widgets.basics.accessibility import announce
from widgets.basics.controls import (
    FlowLayout,
    button_with_tip,
    closing_button,
    column_layout,
    flat_button,
    row_layout,
    set_role,
    text_label,
)
from widgets.basics.theme import current_theme, theme_notifier

# The page that ``?`` opens: every key, by group, with a field that finds.


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
        self.search = QLineEdit(self, placeholderText="Find a key or what it does", clearButtonEnabled=True)
        self.search.setAccessibleName("Find a key")
        self.search.setMaximumWidth(320)
        self.search.textChanged.connect(self._narrow)
        close = flat_button("✕", "Close the keys page", "Close (Escape)", self)
        close.clicked.connect(self.closed)
        self.close_button = close
        self.change_button = button_with_tip("Change keys…", "Give actions other keys, or none", self)
        self.change_button.clicked.connect(self.change_wanted)
        self.none_found = text_label("No key does that.", self, role="muted")
        self.none_found.hide()
        self._scroll = QScrollArea(self, widgetResizable=True)
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


# The page on which keys are changed: every action with its keys, and a field that listens to the next key.


_HINT = "Choose an action, press its new key in the field, then Use this key."


class KeyEditor(QWidget):
    """Reports which key the user wants for which action; what came of it is shown."""

    key_wanted = Signal(int, str)
    """Place of the action in the table, and Qt's portable text of its only key; empty: no key."""
    default_wanted = Signal(int)
    """Place of an action that is to have its first keys again."""
    characters_wanted = Signal(bool)
    """Whether letters, digits and signs alone are to be keys."""
    closed = Signal()
    """The user wants to leave the page."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setProperty("role", "panel")
        self.setAccessibleName("Change keys")
        self.characters_box = QCheckBox("Letters, digits and signs alone are keys", self)
        self.characters_box.setToolTip("Turn off when speech input or a tremor types keys by mistake")
        self.characters_box.clicked.connect(self.characters_wanted)
        self.table = QTreeWidget(self, columnCount=3)
        self.table.setHeaderLabels(["Group", "Action", "Keys"])
        self.table.setRootIsDecorated(False)
        self.table.setUniformRowHeights(True)
        self.table.setAccessibleName("Actions and their keys")
        self.table.currentItemChanged.connect(self._show_hint)
        self.field = QKeySequenceEdit(self, maximumSequenceLength=1)
        self.field.setAccessibleName("New key")
        self.use_button = button_with_tip("Use this key", "Make this the key of the chosen action", self)
        self.none_button = button_with_tip("No key", "Leave the chosen action without a key", self)
        self.default_button = button_with_tip("Default", "Give the chosen action its first keys again", self)
        self.use_button.clicked.connect(self._use)
        self.none_button.clicked.connect(self._clear)
        self.default_button.clicked.connect(self._restore)
        self.close_button = closing_button("the keys", self)
        self.close_button.clicked.connect(self.closed)
        self.note = text_label(_HINT, self, role="muted", wraps=True)
        self._lay_out()

    def _lay_out(self) -> None:
        top, row = row_layout(spacing=12), row_layout(spacing=8)
        top.addWidget(text_label("Change keys", self, role="title"))
        top.addWidget(self.characters_box)
        top.addStretch(1)
        top.addWidget(self.close_button)
        for widget in (text_label("New key", self), self.field):
            row.addWidget(widget)
        for button in (self.use_button, self.none_button, self.default_button):
            row.addWidget(button)
        row.addWidget(self.note, 1)
        layout = column_layout(self, 12, margins=(16, 12, 16, 12))
        layout.addLayout(top)
        layout.addWidget(self.table, 1)
        layout.addLayout(row)

    def show_keys(self, entries: Sequence[KeyEntry], has_characters: bool) -> None:
        """Show the actions with their keys; the chosen one stays."""
        chosen = max(self._chosen(), 0)
        self.table.clear()
        self.table.addTopLevelItems([QTreeWidgetItem([e.group, e.what, e.keys]) for e in entries])
        self.table.setCurrentIndex(self.table.model().index(chosen, 0))
        for column in range(2):
            self.table.resizeColumnToContents(column)
        self.characters_box.setChecked(has_characters)
        self.field.clear()

    def show_note(self, text: str, *, is_problem: bool = False) -> None:
        """Say what came of a wish."""
        self.note.setText(text)
        set_role(self.note, "bad" if is_problem else "good")
        announce(self, text, is_urgent=is_problem)

    def showEvent(self, event: QShowEvent) -> None:
        """Begin in the table."""
        super().showEvent(event)
        self.table.setFocus(Qt.FocusReason.OtherFocusReason)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Close with Escape."""
        if event.key() == Qt.Key.Key_Escape:
            self.closed.emit()
        else:
            super().keyPressEvent(event)

    def _chosen(self) -> int:
        return self.table.currentIndex().row()

    @Slot()
    def _show_hint(self) -> None:
        self.note.setText(_HINT)
        set_role(self.note, "muted")

    @Slot()
    def _use(self) -> None:
        text = self.field.keySequence().toString(QKeySequence.SequenceFormat.PortableText)
        if text:
            self.key_wanted.emit(self._chosen(), text)
        else:
            self.show_note("Press a key in the field first.", is_problem=True)

    @Slot()
    def _clear(self) -> None:
        self.key_wanted.emit(self._chosen(), "")

    @Slot()
    def _restore(self) -> None:
        self.default_wanted.emit(self._chosen())
