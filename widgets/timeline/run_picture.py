"""A run of steps as a picture: a lane of marks per outcome, flags above them, numbers below.

Marks are binned per pixel column by binary search, so a million positions paint as fast as ten.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QGuiApplication, QImage, QPainter

from widgets.basics.drawing import Mark, mark_image
from widgets.basics.theme import CLEAR, contrast, current_theme

LANES = (Mark.COVERED, Mark.REJECTED, Mark.TIE, Mark.NAN, Mark.DEPTH_FAILED)
"""Outcomes with a lane of their own, top down."""
FLAGS = (Mark.PINNED, Mark.BREAKPOINT, Mark.BOOKMARK)
"""Marks that stand on the line above the lanes."""

_MOST_FLAGS = 60


@dataclass(frozen=True, eq=False)
class TimelineRun:
    """A run of steps and what happened in it."""

    count: int
    """Number of steps; positions go from 0 to `count`."""
    marks: Mapping[Mark, NDArray[np.int64]] = field(default_factory=dict)
    """Step numbers (n,) per kind of mark, each sorted in ascending order."""
    has_before: bool = False
    """Whether a step back from the start leads to another run."""
    has_after: bool = False
    """Whether a step from the end leads on to another run."""
    is_open: bool = False
    """Whether more steps follow that are not shown yet."""

    def lanes(self) -> tuple[Mark, ...]:
        """Return the outcomes that get a lane, top down."""
        return tuple(mark for mark in LANES if mark in self.marks)


def column_counts(steps: NDArray[np.int64], first: float, last: float, columns: int) -> NDArray[np.int64]:
    """Count marks per pixel column.

    Parameters
    ----------
    steps : ndarray, shape (n,), int64
        Step numbers in ascending order.
    first, last : float
        Stretch of positions that the columns show.
    columns : int
        Number of pixel columns W.

    Returns
    -------
    ndarray, shape (W,), int64
        Marks in each column.

    Notes
    -----
    Step k is counted where its left end lies, so a step that spans several columns is counted in one.
    """
    edges = np.linspace(first, last, columns + 1)
    places: NDArray[np.int64] = np.searchsorted(steps, edges, side="left").astype(np.int64)
    return np.diff(places)


@dataclass(frozen=True, eq=False)
class RunView:
    """The stretch of a run that is in view, and where its lanes stand."""

    run: TimelineRun
    first: float
    """Position at the left end."""
    last: float
    """Position at the right end."""
    lanes: QRectF
    """All lanes together, in widget pixels."""

    def x_of(self, position: float) -> float:
        """Return where a position lies, in widget pixels."""
        return self.lanes.left() + (position - self.first) * self.step_width()

    def step_width(self) -> float:
        """Return the width of one step in pixels."""
        return self.lanes.width() / (self.last - self.first)

    def paint(self, painter: QPainter) -> None:
        """Draw lanes, flags and ruler."""
        theme = current_theme()
        painter.fillRect(self.lanes, QColor(theme.canvas))
        if not self.run.count:
            painter.setPen(QColor(theme.muted_text))
            said = "The steps of this stage appear here." if self.run.is_open else "This stage has no steps."
            painter.drawText(self.lanes, Qt.AlignmentFlag.AlignCenter, said)
            return
        side = lane_height()
        for number, mark in enumerate(self.run.lanes()):
            top = self.lanes.top() + number * side
            _stamp(painter, mark, QPointF(6.0, top), side)
            if number:
                line = QRectF(self.lanes.left(), top, self.lanes.width(), 1.0)
                painter.fillRect(line, QColor(theme.panel))
            self._paint_lane(
                painter, mark, QRectF(self.lanes.left(), top + 1.0, self.lanes.width(), side - 1.0)
            )
        self._paint_flags(painter)
        self._paint_ruler(painter)

    def _paint_lane(self, painter: QPainter, mark: Mark, lane: QRectF) -> None:
        theme = current_theme()
        steps, ratio = self.run.marks[mark], painter.device().devicePixelRatioF()
        step_width, side = self.step_width(), lane.height()
        start, stop = np.searchsorted(steps, [self.first - 1.0, self.last])
        visible = steps[start:stop]
        if len(visible) * side <= lane.width() and _are_apart(visible, side / step_width):
            lefts = self.lanes.left() + (visible + 0.5 - self.first) * step_width - side / 2
            for left in lefts.tolist():
                _stamp(painter, mark, QPointF(left, lane.top()), side)
            return
        # One row of pixels, as wide as the lane, stretched over its height.
        columns = max(1, int(lane.width() * ratio))
        is_marked = column_counts(steps, self.first, self.last, columns) > 0
        tick = max(1, round(min(step_width, side) * 0.8 * ratio))
        is_painted = np.convolve(is_marked, np.ones(tick, dtype=np.int64))[:columns] > 0
        box = lane.adjusted(0.0, 1.0, 0.0, -1.0)
        color = _lane_color(mark)
        if contrast(color, theme.canvas) < CLEAR:
            # Alone it is too much like the ground.
            _paint_columns(painter, is_painted, theme.text, box)
            box.adjust(0.0, 1.5, 0.0, -1.5)
        _paint_columns(painter, is_painted, color, box)

    def _paint_flags(self, painter: QPainter) -> None:
        side = flag_height() - 2.0
        columns = max(1, int(self.lanes.width() / 4))
        for mark in FLAGS:
            if mark not in self.run.marks:
                continue
            places = np.flatnonzero(column_counts(self.run.marks[mark], self.first, self.last, columns))
            for place in places:
                middle = self.lanes.left() + 4.0 * place + min(self.step_width(), side) / 2
                if len(places) > _MOST_FLAGS:
                    tick = QRectF(middle - 1.0, 3.0, 2.0, side - 4.0)
                    painter.fillRect(tick, QColor(current_theme().text))
                else:
                    _stamp(painter, mark, QPointF(middle - side / 2, 1.0), side)

    def _paint_ruler(self, painter: QPainter) -> None:
        theme = current_theme()
        font = QFont(QGuiApplication.font())
        font.setPixelSize(theme.small_px)
        font.setFeature(QFont.Tag("tnum"), 1)
        painter.setFont(font)
        painter.setPen(QColor(theme.muted_text))
        metrics = QFontMetrics(font)
        label_width = metrics.horizontalAdvance(f"{self.run.count:,}") + 24
        step = _round_step(label_width / self.step_width())
        top = self.lanes.bottom() + 1
        farthest = self.lanes.right() + 6.0
        for position in range(int(np.ceil(self.first / step)) * step, int(self.last) + 1, step):
            x = self.x_of(position)
            painter.fillRect(QRectF(x, top, 1.0, 3.0), QColor(theme.grid_line))
            text = f"{position:,}"
            width = metrics.horizontalAdvance(text)
            left = min(max(x - width / 2, 2.0), farthest - width)
            painter.drawText(QPointF(left, top + 3.0 + metrics.ascent()), text)


def _stamp(painter: QPainter, mark: Mark, place: QPointF, side: float) -> None:
    """Draw a mark from a picture, on whole pixels: smooth lines are slow to draw."""
    ratio = painter.device().devicePixelRatioF()
    image = mark_image(mark, round(side), ratio, 0.0, current_theme())
    painter.drawImage(QPointF(round(place.x() * ratio) / ratio, place.y()), image)


def lane_height() -> int:
    """Return the height of one lane in logical pixels."""
    return max(8, round(current_theme().small_px * 0.82))


def flag_height() -> int:
    """Return the height of the line of flags."""
    return current_theme().small_px + 2


def ruler_height() -> int:
    """Return the height of the numbers."""
    return current_theme().small_px + 7


def _paint_columns(painter: QPainter, is_painted: NDArray[np.bool_], color: str, box: QRectF) -> None:
    pixels = np.where(is_painted, np.uint32(QColor(color).rgba()), np.uint32(0))
    image = QImage(pixels.data, len(pixels), 1, 4 * len(pixels), QImage.Format.Format_ARGB32)
    painter.drawImage(box, image, QRectF(0.0, 0.0, len(pixels), 1.0))


def _are_apart(steps: NDArray[np.int64], least: float) -> bool:
    return len(steps) < 2 or bool(np.diff(steps).min() >= least)


def _lane_color(mark: Mark) -> str:
    theme = current_theme()
    colors = {Mark.COVERED: theme.covered, Mark.REJECTED: theme.rejected, Mark.TIE: theme.tie}
    return colors.get(mark, theme.nan_dark if mark is Mark.NAN else theme.muted_text)


def _round_step(least: float) -> int:
    """Return the smallest of 1, 2, 5, 10, 20, ... that is at least `least`."""
    power = 1
    while True:
        for lead in (1, 2, 5):
            if lead * power >= least:
                return lead * power
        power *= 10
