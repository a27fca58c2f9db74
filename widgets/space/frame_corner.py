"""The corner of a drawn view: what its last picture took, a menu of sizes, and where a picture of a size lies."""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, floor
from statistics import median

from PySide6.QtCore import QEvent, QPoint, QPointF, QRect, QRectF, QSize, Qt, Signal, Slot
from PySide6.QtGui import (
    QAction,
    QActionGroup,
    QColor,
    QFontMetrics,
    QFontMetricsF,
    QKeyEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
)
from PySide6.QtWidgets import QAbstractButton, QMenu, QWidget

from widgets.basics.accessibility import KeyClaim
from widgets.basics.theme import current_theme, faded, text_font, theme_notifier

_MARGIN = 6
_ARROW = 14
"""Room for the arrow that says that there is a menu."""
_EXPLANATION = (
    "Frames per second; time, size and triangles of the last picture.\n"
    "Click to choose the size it is drawn at."
)
_OPENING_KEYS = (Qt.Key.Key_Space, Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Down)


@dataclass(frozen=True)
class SizeChoice:
    """A size to draw at."""

    name: str
    title: str
    """What the menu says."""


class FrameCorner(QAbstractButton):
    """One quiet line that is also the button of a menu; it is not seen before there is something to say."""

    size_chosen = Signal(str)
    """Name of a :class:`SizeChoice`."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._is_under_mouse = False
        self._is_wanted = True
        self._most_width = 0
        self._menu = QMenu(self)
        self._group = QActionGroup(self)
        self._choices: tuple[SizeChoice, ...] = ()
        self._claim = KeyClaim(self, _OPENING_KEYS)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setToolTip(_EXPLANATION)
        self.setAccessibleName("Frames and size of the picture")
        self.clicked.connect(self._open_below)
        self._menu.triggered.connect(self._choose)
        self.hide()
        theme_notifier().theme_changed.connect(self._fit)

    def show_figures(self, text: str) -> None:
        """Show what the last picture took."""
        if text != self.text():
            self.setText(text)
            self._fit()
            self.setVisible(bool(text) and self._is_wanted)

    def set_wanted(self, is_wanted: bool) -> None:
        """Show the figures, or leave them out."""
        self._is_wanted = is_wanted
        self.setVisible(bool(self.text()) and is_wanted)

    def show_details(self, text: str) -> None:
        """Say under the mouse how the last picture was drawn."""
        self.setToolTip(f"{_EXPLANATION}\n\n{text}" if text else _EXPLANATION)

    def show_sizes(self, choices: Sequence[SizeChoice], chosen: str) -> None:
        """Offer sizes; one of them is chosen."""
        if tuple(choices) != self._choices:
            self._choices = tuple(choices)
            self._menu.clear()
            for choice in choices:
                action = self._menu.addAction(choice.title)
                action.setCheckable(True)
                action.setData(choice.name)
                self._group.addAction(action)
        for action in self._menu.actions():
            action.setChecked(action.data() == chosen)

    def menu(self) -> QMenu:
        """Return the menu of sizes."""
        return self._menu

    def open_menu(self, place: QPoint) -> None:
        """Open the menu at a place of the screen."""
        self._menu.popup(place)

    def set_most_width(self, width: int) -> None:
        """Say how wide the line may be; what is longer is cut off."""
        self._most_width = width
        self._fit()

    def sizeHint(self) -> QSize:
        """Return room for the line and the arrow."""
        metrics = QFontMetricsF(text_font(current_theme(), current_theme().small_px))
        # Text is elided by its exact width, which may be more than the whole pixels that it is said to take.
        text = ceil(metrics.horizontalAdvance(self.text())) + 1
        return QSize(text + 2 * _MARGIN + _ARROW, ceil(metrics.height()) + 4)

    def event(self, event: QEvent) -> bool:
        """Light up under the mouse."""
        if event.type() in (QEvent.Type.Enter, QEvent.Type.Leave):
            self._is_under_mouse = event.type() == QEvent.Type.Enter
            self.update()
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Open the menu as the mouse does."""
        if event.key() in _OPENING_KEYS:
            self._open_below()
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the line on a chip."""
        theme = current_theme()
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        is_lit = self._is_under_mouse or self.isDown()
        painter.setBrush(QColor(theme.selection) if is_lit else faded(theme.panel, 0.85))
        painter.setPen(QPen(QColor(theme.focus), 2) if self.hasFocus() else Qt.PenStyle.NoPen)
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(1, 1, -1, -1), 3, 3)
        font = text_font(theme, theme.small_px)
        painter.setFont(font)
        painter.setPen(QColor(theme.muted_text))
        room = QRect(_MARGIN, 0, self.width() - 2 * _MARGIN - _ARROW, self.height())
        text = QFontMetrics(font).elidedText(self.text(), Qt.TextElideMode.ElideRight, room.width())
        painter.drawText(room, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, text)
        tip = QPointF(self.width() - _MARGIN - 4, self.height() / 2 + 2)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(theme.muted_text))
        painter.drawPolygon(QPolygonF([tip, tip + QPointF(-4, -4), tip + QPointF(4, -4)]))
        painter.end()

    @Slot()
    def _fit(self) -> None:
        wanted = self.sizeHint()
        self.resize(min(wanted.width(), max(self._most_width, _ARROW + 2 * _MARGIN)), wanted.height())
        self.update()

    @Slot()
    def _open_below(self) -> None:
        self.open_menu(self.mapToGlobal(QPoint(0, self.height())))

    @Slot(QAction)
    def _choose(self, action: QAction) -> None:
        self.size_chosen.emit(action.data())


WINDOW_SECONDS = 1.0
"""The rate is that of the last so many seconds; a longer pause begins it anew."""


class FrameRate:
    """Remembers when the pictures of the last second were painted."""

    def __init__(self) -> None:
        self._times: deque[float] = deque()

    def add(self, seconds: float) -> None:
        """Take a picture that was painted at a time of one clock."""
        if self._times and seconds - self._times[-1] > WINDOW_SECONDS:
            self._times.clear()
        self._times.append(seconds)
        while seconds - self._times[0] > WINDOW_SECONDS:
            self._times.popleft()

    def per_second(self) -> float | None:
        """Return the rate of the median interval between two pictures, ``None``: there was only one.

        The median, because a hand that rests for a moment is no slow picture.
        """
        intervals = [after - before for before, after in pairwise(self._times)]
        typical = median(intervals) if intervals else 0.0
        return 1 / typical if typical > 0 else None


def picture_area(room: QRectF, size: tuple[int, int], ratio: float) -> QRectF:
    """Return the part of ``room`` that a picture fills, in the middle.

    Parameters
    ----------
    room : QRectF
        Logical pixels.
    size : (width, height)
        Of the picture in its own pixels.
    ratio : float
        Pixels of the screen to a logical pixel.

    Notes
    -----
    A picture that is too large is made smaller until it fits. One that is smaller is magnified by a whole number
    only, so that all of its pixels stay of one size; its border is on a pixel of the screen, so that they stay sharp.
    """
    width, height = max(room.width() * ratio, 1.0), max(room.height() * ratio, 1.0)
    factor = min(width / size[0], height / size[1])
    if factor >= 1:
        factor = floor(factor)
    columns, rows = size[0] * factor, size[1] * factor
    left, top = floor((width - columns) / 2), floor((height - rows) / 2)
    return QRectF(room.left() + left / ratio, room.top() + top / ratio, columns / ratio, rows / ratio)
