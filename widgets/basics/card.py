"""A card: a button with a title and a text below it, which Return presses, too."""

from PySide6.QtCore import QRect, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QKeyEvent, QPainter, QPen
from PySide6.QtWidgets import QAbstractButton, QWidget

from widgets.basics.accessibility import KeyClaim
from widgets.basics.theme import Theme, current_theme, text_font

GAP = 8
"""Pixels between the frame of a card and what is in it."""
SPACING = 12
"""Pixels between two cards."""
WRAPPED = int(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop) | int(Qt.TextFlag.TextWordWrap)


class Card(QAbstractButton):
    """Says what it is to be painted with; what is on it beside its texts it paints itself."""

    def __init__(
        self, name: str, texts: tuple[str, str], keys: tuple[Qt.Key, ...], parent: QWidget | None = None
    ) -> None:
        """Make a card of a title and a text; it takes ``keys`` for itself."""
        super().__init__(parent)
        self._texts = texts
        self._heights: tuple[tuple[int, Theme], tuple[int, int]] | None = None
        """Of title and text, and what they are made from."""
        self.setObjectName(name)
        self.setText(texts[0])
        self.setAccessibleName(texts[0])
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAttribute(Qt.WidgetAttribute.WA_Hover)
        KeyClaim(self, keys)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Press it with Return too."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.click()
        else:
            super().keyPressEvent(event)

    def text_heights(self, width: int) -> tuple[int, int]:
        """Return the heights of title and text, wrapped to a width: a layout asks many times."""
        made_from = width, current_theme()
        if self._heights is None or self._heights[0] != made_from:
            title, text = (
                QFontMetrics(font).boundingRect(QRect(0, 0, width, 1000), WRAPPED, text).height()
                for font, text in zip(_fonts(), self._texts, strict=True)
            )
            self._heights = made_from, (title, text)
        return self._heights[1]

    def paint_card(self, painter: QPainter, *, is_marked: bool = False) -> None:
        """Paint the card without what is on it, with a frame where it has the keyboard or the pointer, or is marked."""
        theme = current_theme()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        is_framed = self.underMouse() or self.hasFocus() or is_marked
        frame = QPen(QColor(theme.focus if self.hasFocus() else theme.outline), 2)
        painter.setPen(frame if is_framed else Qt.PenStyle.NoPen)
        painter.setBrush(QColor(theme.selection if self.isDown() else theme.panel))
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(1, 1, -1, -1), 4, 4)

    def paint_texts(self, painter: QPainter, room: QRect, below: int) -> None:
        """Paint the title, and the text ``below`` pixels under its top; the pen stays that of the text."""
        for font, text, color, down in zip(
            _fonts(), self._texts, (current_theme().text, current_theme().muted_text), (0, below), strict=True
        ):
            painter.setFont(font)
            painter.setPen(QColor(color))
            painter.drawText(room.adjusted(0, down, 0, 0), WRAPPED, text)


def _fonts() -> tuple[QFont, QFont]:
    """Return the fonts of the title and of the text."""
    theme = current_theme()
    title = text_font(theme)
    title.setWeight(QFont.Weight.DemiBold)
    return title, text_font(theme, theme.text_px - 1)
