"""Messages and progress where the thing is, never modal; and the panel above a page that runs something."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum

from PySide6.QtCore import QEvent, Qt, Signal, Slot
from PySide6.QtGui import QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QComboBox, QLabel, QProgressBar, QPushButton, QSizePolicy, QSpinBox, QWidget

from widgets.basics.accessibility import announce
from widgets.basics.controls import (
    ElidedLabel,
    FlowLayout,
    button_with_tip,
    column_layout,
    flat_button,
    row_layout,
    text_label,
)
from widgets.basics.drawing import Mark, mark_pixmap
from widgets.basics.theme import current_theme, theme_notifier

# Messages and progress where the thing is: never modal, always dismissable.


class MessageKind(Enum):
    """How bad it is; each kind has its own shape."""

    INFORMATION = Mark.INFORMATION
    WARNING = Mark.WARNING
    ERROR = Mark.ERROR


@dataclass(frozen=True)
class Message:
    """One message: a plain sentence, and more for who wants it."""

    kind: MessageKind
    text: str
    details: str = ""
    """Shown on demand, selectable."""
    action: str = ""
    """Text of a button that offers the next thing to do; empty: none."""


@dataclass(frozen=True)
class Progress:
    """How far long work has come."""

    text: str
    done: int
    total: int
    """0 where it is not known."""


class MessageBar(QWidget):
    """Shows one message or one piece of long work; takes no room when it has nothing to say."""

    action_requested = Signal(object)
    """The user wants what this ``Message`` offers."""
    cancel_requested = Signal()
    """The user wants the long work to stop."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._is_missed = False
        """Whether the window was not active when the message came: a screen reader may not have heard of it."""
        self.setProperty("role", "floating")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self._message: Message | None = None
        self._standing: Message | None = None
        self._icon = QLabel(self)
        self.text = text_label("", self, wraps=True, is_selectable=True)
        self.text.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        self.progress = QProgressBar(self, textVisible=False)
        self.progress.setFixedHeight(8)
        self.progress.setMinimumWidth(160)
        self.details_button = self._button("Details", "Show or hide the details")
        self.details_button.setCheckable(True)
        self.details_button.toggled.connect(self._show_details)
        self.action_button = self._button("", "Do the suggested action")
        self.action_button.clicked.connect(self._request_action)
        self.cancel_button = self._button("Cancel", "Stop this work; the open scene is unchanged")
        self.cancel_button.clicked.connect(self._cancel)
        self.dismiss_button = flat_button("✕", "Dismiss the message", "Dismiss (Escape)", self)
        self.dismiss_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.dismiss_button.clicked.connect(self.dismiss)
        self.details = text_label("", self, role="muted", wraps=True, is_selectable=True)
        row = row_layout(spacing=8)
        row.addWidget(self._icon)
        row.addWidget(self.text, 1)
        row.addWidget(self.progress)
        for button in (self.details_button, self.action_button, self.cancel_button, self.dismiss_button):
            row.addWidget(button)
        layout = column_layout(self, 4, margins=(12, 4, 4, 4))
        layout.addLayout(row)
        layout.addWidget(self.details)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Maximum)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self.clear()

    @Slot(object)
    def show_message(self, message: Message | None) -> None:
        """Replace the message; None clears."""
        if message is None:
            self.clear()
            return
        self._message = message
        self.text.setText(message.text)
        self.details.setText(message.details)
        self.details_button.setChecked(False)
        self.details.hide()
        self.action_button.setText(message.action)
        self._show_only(self._icon, self.dismiss_button)
        self.details_button.setVisible(bool(message.details))
        self.action_button.setVisible(bool(message.action))
        self.setAccessibleName(f"{message.kind.value.value}: {message.text}")
        self._follow_theme()
        self.show()
        self._is_missed = not self.isActiveWindow()
        self._say()

    @Slot(object)
    def show_progress(self, progress: Progress | None) -> None:
        """Show how far the work has come; None clears."""
        if progress is None:
            self.clear()
            return
        self._message = None
        self.text.setText(progress.text)
        self.progress.setRange(0, progress.total)
        self.progress.setValue(progress.done)
        self.progress.setAccessibleName(progress.text)
        if not self.progress.isVisibleTo(self):
            self.cancel_button.setEnabled(True)
            self.cancel_button.setText("Cancel")
        self._show_only(self.progress, self.cancel_button)
        self.setAccessibleName(progress.text)
        self.show()

    def stand(self, message: Message) -> None:
        """Show a message whenever there is nothing else to show, until it is dismissed or its action is done."""
        self._standing = message
        if self.isHidden():
            self.clear()

    @Slot()
    def clear(self) -> None:
        """Say nothing and take no room, unless a message stands."""
        if self._standing is not None:
            self.show_message(self._standing)
            return
        self._message = None
        self._show_only()
        self.hide()

    def take_back(self, message: Message | None) -> None:
        """Take away this message if it is the one that is shown."""
        if message is not None and self._message is message:
            self.clear()

    @Slot()
    def dismiss(self) -> None:
        """Take away the message that is shown."""
        self._end_standing()
        self.clear()

    def event(self, event: QEvent) -> bool:
        """Say again what a screen reader has missed, as at the start of the program, once the window is active."""
        if event.type() == QEvent.Type.WindowActivate and self._is_missed:
            self._is_missed = False
            self._say()
        return super().event(event)

    def _say(self) -> None:
        message = self._message
        if message is not None:
            spoken = f"{message.kind.value.value.capitalize()}: {message.text}"
            announce(self, spoken, is_urgent=message.kind is not MessageKind.INFORMATION)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Escape dismisses a message or cancels the work."""
        if event.key() != Qt.Key.Key_Escape:
            super().keyPressEvent(event)
        elif self._message is not None:
            self.dismiss()
        else:
            self._cancel()

    def _button(self, text: str, tip: str) -> QPushButton:
        button = button_with_tip(text, tip, self)
        button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        button.setAutoDefault(False)
        return button

    def _show_only(self, *parts: QWidget) -> None:
        everything = (self._icon, self.progress, self.details_button, self.action_button)
        for part in (*everything, self.cancel_button, self.dismiss_button, self.details):
            part.setVisible(part in parts)

    @Slot(bool)
    def _show_details(self, is_shown: bool) -> None:
        self.details.setVisible(is_shown)

    @Slot()
    def _request_action(self) -> None:
        message = self._message
        self._end_standing()
        self.clear()
        self.action_requested.emit(message)

    def _end_standing(self) -> None:
        if self._message is self._standing:
            self._standing = None

    @Slot()
    def _cancel(self) -> None:
        self.cancel_button.setEnabled(False)
        self.cancel_button.setText("Cancelling…")
        self.cancel_requested.emit()

    @Slot()
    def _follow_theme(self) -> None:
        if self._message is not None:
            side = current_theme().text_px + 5
            self._icon.setPixmap(mark_pixmap(self._message.kind.value, side, self.devicePixelRatioF()))


# The panel above a page that runs something: its choices, starting and cancelling, and how far the work has
# come.


Named = Sequence[tuple[str, str]]
"""Names and titles."""


class RunPanel(QWidget):
    """Rows of controls that wrap; emits nothing when it is set by the program."""

    chosen = Signal(str, object)
    """Name of a control, and the value that the user has chosen there."""
    start_requested = Signal()
    cancel_requested = Signal()

    def __init__(
        self, name: str, intro: str, start: str, start_tip: str, cancel_tip: str, parent: QWidget | None
    ) -> None:
        """Make an empty panel; ``intro`` is what the page shows and how to begin, ``start`` what the button says."""
        super().__init__(parent)
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setAccessibleName(name)
        self.start_button = button_with_tip(start, start_tip, self)
        self.cancel_button = button_with_tip("Cancel", cancel_tip, self)
        self.progress = QProgressBar(self, textVisible=False)
        self.progress.setFixedSize(160, 8)
        self.doing = ElidedLabel(self)
        self.doing.setProperty("role", "muted")
        self.doing.setFixedWidth(320)
        # An elided label takes any width by itself; here it keeps its own, so that a line that is full wraps.
        self.doing.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.rows = column_layout(self, 8, margins=(8, 8, 8, 8))
        self.keeps_start = False
        """Whether work can be started while other work runs, which nobody asked for."""
        self._introduction = intro
        self.intro = text_label(intro, self, name="What this page shows", wraps=True, is_selectable=True)
        self.rows.addWidget(self.intro)
        self._controls: list[QWidget] = []
        """Rows of controls; the last one starts the work."""
        self.start_button.clicked.connect(self.start_requested)
        self.cancel_button.clicked.connect(self.cancel_requested)

    # Making controls.

    def box(self, name: str, title: str, tip: str) -> QComboBox:
        """Return a new list of choices, with its name for `chosen`."""
        box = QComboBox(self)
        box.setObjectName(name)
        box.activated.connect(self._tell_item)
        box.setAccessibleName(title)
        box.setToolTip(tip)
        box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        return box

    def number(self, name: str, title: str, tip: str, lowest: int, highest: int) -> QSpinBox:
        """Return a new field for a whole number, with its name for `chosen`."""
        box = QSpinBox(self)
        box.setObjectName(name)
        box.setRange(lowest, highest)
        box.setAccessibleName(title)
        box.setToolTip(tip)
        box.setKeyboardTracking(False)
        box.valueChanged.connect(self._tell_number)
        return box

    @Slot(int)
    def _tell_item(self, index: int) -> None:
        box = self.sender()
        assert isinstance(box, QComboBox)
        self.chosen.emit(box.objectName(), box.itemData(index))

    @Slot(int)
    def _tell_number(self, value: int) -> None:
        self.chosen.emit(self.sender().objectName(), value)

    def add_row(self, controls: Iterable[QWidget | tuple[str, QWidget]]) -> FlowLayout:
        """Add a row of controls, some with a label before them, and return its layout."""
        row = QWidget(self)
        row.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        flow = FlowLayout(row, 12)
        for control in controls:
            flow.addWidget(_labelled(*control) if isinstance(control, tuple) else control)
        self.rows.addWidget(row)
        self._controls.append(row)
        return flow

    # Showing.

    def show_task(self, task: str) -> None:
        """Show what is asked here instead of the introduction; empty: the introduction."""
        self.intro.setText(task or self._introduction)
        self.keep_height()

    def set_brief(self, is_brief: bool) -> None:
        """Leave the introduction and all rows but the last out, or bring them back."""
        for widget in (self.intro, *self._controls[:-1]):
            widget.setVisible(not is_brief)
        self.keep_height()

    def show_progress(self, progress: Progress | None) -> None:
        """Show how far the work has come; ``None``: nothing runs."""
        is_running = progress is not None
        had_focus = self.start_button.hasFocus() or self.cancel_button.hasFocus()
        for widget in (self.cancel_button, self.progress, self.doing):
            widget.setVisible(is_running)
        self.start_button.setVisible(not is_running or self.keeps_start)
        if had_focus and not (is_running and self.keeps_start):
            # One takes the place of the other, for the keyboard too.
            (self.cancel_button if is_running else self.start_button).setFocus()
        if progress is not None:
            self.progress.setRange(0, progress.total)
            self.progress.setValue(progress.done)
            self.progress.setAccessibleName(progress.text)
            self.doing.setText(progress.text)
        self.keep_height()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep room for all lines of controls."""
        super().resizeEvent(event)
        self.keep_height()

    def keep_height(self) -> None:
        """Ask for the height that this width needs: a splitter does not ask by itself."""
        self.setMinimumHeight(self.heightForWidth(self.width()))


def fill_box(box: QComboBox, named: Named, current: str) -> None:
    """Offer names with titles; what stands there already is left."""
    if [(box.itemData(k), box.itemText(k)) for k in range(box.count())] != list(named):
        box.clear()
        for name, title in named:
            box.addItem(title, name)
    box.setCurrentIndex(max(box.findData(current), 0))


def set_number(box: QSpinBox, value: int) -> None:
    """Show a number without a signal."""
    box.blockSignals(True)
    box.setValue(value)
    box.blockSignals(False)


def _labelled(text: str, control: QWidget) -> QWidget:
    """Return a widget that holds a label and the control that it names."""
    pair = QWidget()
    row = row_layout(pair, 4)
    label = QLabel(text, pair)
    label.setBuddy(control)
    row.addWidget(label)
    row.addWidget(control)
    return pair
