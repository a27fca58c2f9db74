"""A number typed the way one writes it on the board: decimals, fractions, multiples of pi."""

import math
import re

from PySide6.QtCore import QEvent, QObject, QSize, Qt, QTimer, Signal, Slot
from PySide6.QtGui import QFocusEvent, QFont, QKeyEvent, QMouseEvent, QResizeEvent
from PySide6.QtWidgets import QLineEdit, QSizePolicy, QToolTip, QWidget

from core.explain.number_text import full_text, number_text, parse_number
from core.records.words import counted
from widgets.basics.accessibility import announce
from widgets.basics.controls import column_layout, text_label
from widgets.basics.theme import current_theme, theme_notifier

_SEPARATOR = re.compile(r"\s*(?:;|,\s)\s*")
"""Between numbers typed in one field; a comma without a space is a decimal one."""


def tabular_font(font: QFont) -> QFont:
    """Return the font with figures of one width, so that numbers line up and do not jitter."""
    result = QFont(font)
    result.setFeature(QFont.Tag("tnum"), 1)
    return result


class NumberEdit(QLineEdit):
    """A field for a number, in figures of one width; a double-click takes all of it, past the point and the minus.

    It keeps the keyboard after Enter, and the number that was taken is selected: the next one takes its place.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFont(tabular_font(self.font()))
        self._reason = ""

    def tell(self, reason: str) -> None:
        """Say below the field why its text is not taken, when the keyboard has gone where it goes."""
        self._reason = reason
        QTimer.singleShot(0, self, self._show_reason)

    @Slot()
    def _show_reason(self) -> None:
        if self.isVisible():
            QToolTip.showText(self.mapToGlobal(self.rect().bottomLeft()), self._reason, self)
            announce(self, self._reason)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Select the whole number."""
        self.selectAll()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Select a number that Enter has entered; one that was refused is left to be mended."""
        super().keyPressEvent(event)
        is_enter = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
        if is_enter and self.hasFocus() and not self.isModified():
            self.selectAll()


class TypedValue(QWidget):
    """One editable number: commits on Enter or on leaving, restores on Escape, explains bad text."""

    value_committed = Signal(float)
    """The user has entered a valid value that differs from the present one."""
    values_committed = Signal(object)
    """The user has entered several numbers, for this field and those after it: a list of float."""

    def __init__(self, name: str, parent: QWidget | None = None, *, is_compact: bool = False) -> None:
        super().__init__(parent)
        self._name = name
        self._value = 0.0
        self._lowest = -math.inf
        self._highest = math.inf
        self._most = 1
        self._is_compact = is_compact
        self.edit = NumberEdit(self)
        self.edit.setAccessibleName(name)
        self.edit.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.edit.installEventFilter(self)
        self.edit.editingFinished.connect(self._commit)
        self.edit.textEdited.connect(self._clear_error)
        self.error = text_label("", self, role="bad", wraps=True)
        self.error.hide()
        layout = column_layout(self, 2)
        layout.addWidget(self.edit)
        layout.addWidget(self.error)
        self.setFocusProxy(self.edit)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self._follow_theme()
        self._show_text()

    def value(self) -> float:
        """Return the last valid value."""
        return self._value

    @Slot(float)
    def show_value(self, value: float) -> None:
        """Show a value set by the program; text the user is typing at the moment is left alone."""
        if _is_same(value, self._value) and not self.edit.isModified():
            return
        self._value = float(value)
        if not (self.edit.hasFocus() and self.edit.isModified()):
            self._show_text(is_full=self.edit.hasFocus())

    def set_range(self, lowest: float, highest: float) -> None:
        """Refuse values outside [lowest, highest]."""
        self._lowest, self._highest = lowest, highest
        self.updateGeometry()

    def set_most_numbers(self, count: int) -> None:
        """Take up to so many numbers, the further ones for the fields after this."""
        self._most = count

    def error_text(self) -> str:
        """Return what is wrong with the typed text; empty when nothing is."""
        return self.error.text()

    def sizeHint(self) -> QSize:
        """Wide enough for a sign and seven figures."""
        hint = super().sizeHint()
        text = "\u22120.000" if self._is_compact else "\u22120.000000"
        return QSize(self.edit.fontMetrics().horizontalAdvance(text) + 16, hint.height())

    def minimumSizeHint(self) -> QSize:
        """Never narrower than four significant figures with sign and point, nor than the largest number allowed.

        Figures that are cut off at the end would leave another number, which looks whole.
        """
        hint = super().minimumSizeHint()
        text, room = ("\u22120.00", 10) if self._is_compact else ("\u22120.0000", 16)
        texts = [text, *(number_text(end) for end in (self._lowest, self._highest) if math.isfinite(end))]
        width = max(map(self.edit.fontMetrics().horizontalAdvance, texts))
        return QSize(width + room, hint.height())

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Show full precision while editing; Escape restores."""
        if watched is self.edit:
            if isinstance(event, QKeyEvent) and event.type() in (
                QEvent.Type.KeyPress,
                QEvent.Type.ShortcutOverride,
            ):
                if event.key() == Qt.Key.Key_Escape and (self.edit.isModified() or self.error_text()):
                    if event.type() == QEvent.Type.KeyPress:
                        self._clear_error()
                        self._show_text(is_full=True)
                    event.accept()
                    return True
            elif (
                isinstance(event, QFocusEvent)
                and event.type() == QEvent.Type.FocusIn
                and not self.error_text()
            ):
                self._show_text(is_full=True)
                if event.reason() != Qt.FocusReason.MouseFocusReason:
                    self.edit.selectAll()
        return False

    @Slot()
    def _commit(self) -> None:
        if not self.edit.isModified():
            if not self.edit.hasFocus() and not self.error_text():
                self._show_text()
            return
        try:
            value, *further = [parse_number(text) for text in _SEPARATOR.split(self.edit.text().strip())]
            if len(further) >= self._most:
                raise ValueError(f"expected {counted(self._most, 'number')}, got {len(further) + 1}")
            if not self._lowest <= value <= self._highest:
                raise ValueError(self._range_text())
        except ValueError as problem:
            self._show_error(str(problem))
            return
        self._clear_error()
        is_changed = value != self._value
        self._value = value
        self._show_text(is_full=self.edit.hasFocus())
        if further:
            self.values_committed.emit([value, *further])
        elif is_changed:
            self.value_committed.emit(value)

    def _range_text(self) -> str:
        if math.isinf(self._highest):
            return f"expected at least {number_text(self._lowest)}"
        if math.isinf(self._lowest):
            return f"expected at most {number_text(self._highest)}"
        return f"expected a number between {number_text(self._lowest)} and {number_text(self._highest)}"

    def _show_text(self, is_full: bool = False) -> None:
        text = full_text(self._value) if is_full else self._fitting_text()
        is_selected = self.edit.hasFocus() and self.edit.hasSelectedText()
        if text != self.edit.text() or self.edit.isModified():
            self.edit.setText(text)
            self.edit.setModified(False)
        self.edit.setCursorPosition(0)
        if is_selected:
            self.edit.selectAll()
        several = "\nType 1.5, 3 to fill the next field too." if self._most > 1 else ""
        self.edit.setToolTip(
            f"{self._name} = {full_text(self._value)}\nAccepts decimals, fractions (3/256) and pi.{several}"
        )

    def _fitting_text(self) -> str:
        """Return four significant digits, or in a narrow field as many as it can show."""
        room = self.edit.width() - 10
        texts = [number_text(self._value, digits) for digits in (4, 3, 2)]
        fitting = (text for text in texts if self.edit.fontMetrics().horizontalAdvance(text) <= room)
        return next(fitting, texts[0])

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show as many digits as fit."""
        super().resizeEvent(event)
        if not self.edit.hasFocus() and not self.error_text():
            self._show_text()

    def _show_error(self, text: str) -> None:
        self.error.setText(text)
        self.error.setVisible(not self._is_compact)
        self.edit.setToolTip(f"{self._name}: {text}. Escape restores {full_text(self._value)}.")
        self.edit.setAccessibleDescription(text)
        self._follow_theme()
        if self._is_compact:
            self.edit.tell(self.edit.toolTip())

    @Slot()
    def _clear_error(self) -> None:
        self.error.clear()
        self.error.hide()
        self.edit.setAccessibleDescription("")
        self._follow_theme()

    @Slot()
    def _follow_theme(self) -> None:
        rules = "padding-left: 2px; padding-right: 2px;" if self._is_compact else ""
        rules += f"border: 2px solid {current_theme().bad};" if self.error_text() else ""
        self.edit.setStyleSheet(f"QLineEdit {{ {rules} }}" if rules else "")


def _is_same(first: float, second: float) -> bool:
    """Return whether two values are written alike: a zero has a sign."""
    return first == second and math.copysign(1.0, first) == math.copysign(1.0, second)
