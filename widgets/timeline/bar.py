"""The steps of one stage as one bar: a lane of marks per outcome, the present position, zoom and scrub.

Position p means that p steps are done; step k (from 0) fills the stretch [k, k + 1) and is the one just done
at position k + 1.
"""

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal, Slot
from PySide6.QtGui import (
    QColor,
    QHelpEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPixmap,
    QPolygonF,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QAbstractSlider, QSizePolicy, QToolTip, QWidget

from widgets.basics.theme import current_theme, theme_notifier
from widgets.timeline.run_picture import RunView, TimelineRun, flag_height, lane_height, ruler_height

_SMALLEST_SPAN = 8.0
_LARGEST_VALUE = 2**31 - 1
"""The last position that a slider can have."""
LANES_AT_LEAST = 4
"""Lanes that there is always room for; a stage with more takes more."""


class TimelineBar(QAbstractSlider):
    """Paints a `TimelineRun`; wheel zooms, click jumps, drag scrubs, Shift+wheel moves the view.

    A screen reader reads and sets its position as that of any slider.
    """

    position_requested = Signal(int)
    """The user wants this position (0 to count)."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._run = TimelineRun(0)
        self._position = 0
        self._first, self._last = 0.0, 1.0
        self._picture: QPixmap | None = None
        self._grabbed_at: float | None = None
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setMouseTracking(True)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName("Timeline")
        self.valueChanged.connect(self._request_position)
        theme_notifier().theme_changed.connect(self._forget_picture)

    @Slot(object)
    def show_run(self, run: TimelineRun) -> None:
        """Show a run from end to end; the position is kept inside it."""
        is_same_length = run.count == self._run.count
        self._run = run
        self._position = min(self._position, run.count)
        if not is_same_length:
            self._first, self._last = 0.0, float(max(run.count, 1))
        self.setMaximum(min(run.count, _LARGEST_VALUE))
        self._describe()
        self.updateGeometry()
        self._forget_picture()

    @Slot(int)
    def run(self) -> TimelineRun:
        """Return the run that is shown."""
        return self._run

    def show_position(self, position: int) -> None:
        """Move the grey line; the view follows it."""
        self._position = position
        span = self._last - self._first
        if not self._first <= position <= self._last:
            self._show_stretch(position - span * 0.1, position + span * 0.9)
        self.setValue(min(position, _LARGEST_VALUE))
        self._describe()
        self.update()

    @Slot()
    def show_everything(self) -> None:
        """Zoom out to the whole run."""
        self._show_stretch(0.0, float(max(self._run.count, 1)))

    def visible_stretch(self) -> tuple[float, float]:
        """Return the first and last position in view."""
        return self._first, self._last

    def x_of(self, position: float) -> float:
        """Return where a position lies, in widget pixels."""
        return self._view().x_of(position)

    def position_at(self, x: float) -> int:
        """Return the position after the step that is drawn at `x`; 0 left of the first step."""
        lane = self._lane_rect()
        place = self._first + (x - lane.left()) / max(1.0, lane.width()) * (self._last - self._first)
        return int(min(max(np.floor(place) + 1, 0), self._run.count)) if x > lane.left() else int(self._first)

    def zoom(self, factor: float, x: float | None = None) -> None:
        """Show `factor` times as many positions, holding the one at `x` (default: the present) in place."""
        lane = self._lane_rect()
        if x is None:
            anchor = float(self._position)
            share = (anchor - self._first) / (self._last - self._first)
        else:
            share = min(max((x - lane.left()) / max(1.0, lane.width()), 0.0), 1.0)
            anchor = self._first + share * (self._last - self._first)
        whole = float(max(self._run.count, 1))
        span = min(max((self._last - self._first) * factor, min(_SMALLEST_SPAN, whole)), whole)
        self._show_stretch(anchor - share * span, anchor + (1.0 - share) * span)

    def move_view(self, direction: int) -> None:
        """Show an eighth of what is in view further to the right (1) or left (-1)."""
        step = 0.125 * direction * (self._last - self._first)
        self._show_stretch(self._first + step, self._last + step)

    def sizeHint(self) -> QSize:
        """Room for the flags, the lanes of any stage and the ruler: a step that begins a lane must move nothing."""
        lanes = max(LANES_AT_LEAST, len(self._run.lanes()))
        return QSize(400, flag_height() + lane_height() * lanes + ruler_height())

    def minimumSizeHint(self) -> QSize:
        """As tall as wanted, but narrow."""
        return QSize(160, self.sizeHint().height())

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the kept picture of the marks, then the grey line."""
        del event
        ratio = self.devicePixelRatioF()
        if self._picture is None or self._picture.size() != self.size() * ratio:
            self._picture = QPixmap(self.size() * ratio)
            self._picture.setDevicePixelRatio(ratio)
            self._picture.fill(QColor(current_theme().panel))
            picture_painter = QPainter(self._picture)
            self._view().paint(picture_painter)
            picture_painter.end()
        painter = QPainter(self)
        painter.drawPixmap(0, 0, self._picture)
        if self._run.count:
            self._paint_position(painter)
        if self.hasFocus():
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(QColor(current_theme().focus), 2))
            painter.drawRect(self.rect().adjusted(1, 1, -1, -1))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Draw the marks anew."""
        super().resizeEvent(event)
        self._forget_picture()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Jump with the left button; take hold of the view with the middle one."""
        if event.button() == Qt.MouseButton.LeftButton:
            self._request(event.position().x())
        elif event.button() == Qt.MouseButton.MiddleButton:
            self._grabbed_at = event.position().x()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Scrub or move the view."""
        if event.buttons() & Qt.MouseButton.LeftButton:
            self._request(event.position().x())
        elif event.buttons() & Qt.MouseButton.MiddleButton and self._grabbed_at is not None:
            self._move_by(self._grabbed_at - event.position().x())
            self._grabbed_at = event.position().x()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom about the mouse; with Shift, or sideways, move the view."""
        turn = event.angleDelta()
        if turn.x() or event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            self._move_by(-0.5 * (turn.x() or turn.y()))
        elif turn.y():
            self.zoom(0.8 ** (turn.y() / 120.0), event.position().x())
        event.accept()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Zoom out to the whole run."""
        if event.button() == Qt.MouseButton.LeftButton:
            self.show_everything()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Step with Left and Right, go to the ends, zoom with plus and minus."""
        targets = {
            Qt.Key.Key_Left: self._position - 1,
            Qt.Key.Key_Right: self._position + 1,
            Qt.Key.Key_Home: 0,
            Qt.Key.Key_End: self._run.count,
        }
        key = Qt.Key(event.key())
        if key in (Qt.Key.Key_Plus, Qt.Key.Key_Equal):
            self.zoom(0.5)
        elif key == Qt.Key.Key_Minus:
            self.zoom(2.0)
        elif key in targets:
            self._request_position(min(max(targets[key], 0), self._run.count))
        else:
            event.ignore()

    def event(self, event: QEvent) -> bool:
        """Tell which step is under the mouse and what happened there."""
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            QToolTip.showText(event.globalPos(), self._tip_at(event.pos().x(), event.pos().y()), self)
            return True
        return super().event(event)

    def _request(self, x: float) -> None:
        self._request_position(self.position_at(x))

    @Slot(int)
    def _request_position(self, position: int) -> None:
        if self._run.count and position != self._position:
            self.position_requested.emit(position)

    def _tip_at(self, x: float, y: float) -> str:
        lane_number = int((y - flag_height()) // lane_height())
        if x < self._lane_rect().left():
            if 0 <= lane_number < len(self._run.lanes()):
                mark = self._run.lanes()[lane_number]
                return f"{mark.value}: {len(self._run.marks[mark]):,} steps"
            return ""
        position = self.position_at(x)
        if position == 0:
            return "before the first step"
        here = [mark.value for mark, steps in self._run.marks.items() if _contains(steps, position - 1)]
        return f"step {position:,} of {self._run.count:,}" + "".join(f"\n{name}" for name in here)

    def _describe(self) -> None:
        totals = [f"{len(self._run.marks[mark])} {mark.value}" for mark in self._run.lanes()]
        self.setAccessibleDescription(", ".join([f"{self._position} of {self._run.count}", *totals]))

    def _move_by(self, pixels: float) -> None:
        step = pixels / max(1.0, self._lane_rect().width()) * (self._last - self._first)
        self._show_stretch(self._first + step, self._last + step)

    def _show_stretch(self, first: float, last: float) -> None:
        whole = float(max(self._run.count, 1))
        span = min(last - first, whole)
        first = min(max(first, 0.0), whole - span)
        if (first, first + span) != (self._first, self._last):
            self._first, self._last = first, first + span
            self._forget_picture()

    @Slot()
    def _forget_picture(self) -> None:
        self._picture = None
        self.update()

    def _view(self) -> RunView:
        return RunView(self._run, self._first, self._last, self._lane_rect())

    def _lane_rect(self) -> QRectF:
        left = lane_height() + 12
        height = lane_height() * max(2, len(self._run.lanes()))
        return QRectF(left, flag_height(), max(1.0, self.width() - left - 8.0), height)

    def _paint_position(self, painter: QPainter) -> None:
        theme = current_theme()
        lane = self._lane_rect()
        if self._position > 0:
            left, right = self.x_of(self._position - 1), self.x_of(self._position)
            done = QRectF(left, lane.top(), max(2.0, right - left), lane.height())
            painter.setPen(QPen(QColor(theme.accent), 2.0))
            if right - left >= 6.0:
                painter.drawRect(done.adjusted(1.0, 1.0, -1.0, -1.0))
        x = self.x_of(self._position)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(
            QRectF(x - 1.0, lane.top() - 3.0, 2.0, lane.height() + 6.0), QColor(theme.muted_text)
        )
        top = lane.top() - 3.0
        handle = QPolygonF([QPointF(x - 5.0, top - 6.0), QPointF(x + 5.0, top - 6.0), QPointF(x, top + 1.0)])
        painter.setPen(QPen(QColor(theme.panel), 1.0))
        painter.setBrush(QColor(theme.accent))
        painter.drawPolygon(handle)


def _contains(steps: NDArray[np.int64], step: int) -> bool:
    place = int(np.searchsorted(steps, step))
    return place < len(steps) and int(steps[place]) == step
