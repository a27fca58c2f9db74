"""The ground of a chart: two logarithmic axes with places for 0 and infinity, series of marks, and lines.

A logarithmic axis has no 0, yet an exact method has exactly that error: it stands in a band below the axis, set apart
by a line, and infinity in a band above. Positions are decades (log10); nothing here knows pixels.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, floor, inf, log10

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, Qt, Slot
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen, QPolygonF
from PySide6.QtWidgets import QWidget

from core.explain.number_text import number_text
from core.records.arrays import Floats
from widgets.basics.theme import current_theme, text_font, theme_notifier
from widgets.experiments.series import ChartPicture, ChartSeries, paint_mark, series_color

# Where values stand on a logarithmic axis that has places of its own for 0 and for infinity.


_ROOM = 0.08
"""Part of the range that is kept free at its ends."""
_BAND = 0.16
"""Height of the band of 0, and of infinity, as a part of the range."""
_FEW_DECADES = 2.5
"""Of a range of fewer decades 1, 2 and 5 are labelled, else the decades alone."""
_MOST_DECADES = 7
_LEAST, _MOST = -307, 307
"""Decades of normal float64 numbers."""
_PREFIXES = ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"), (1e-12, "ps"))


@dataclass(frozen=True)
class ChartScale:
    """One axis."""

    low: float
    """Decade at which the logarithmic part begins."""
    high: float
    """Decade at which it ends."""
    has_zero: bool
    has_infinite: bool

    @property
    def band(self) -> float:
        """Height of a band, in decades."""
        return _BAND * (self.high - self.low)

    @property
    def start(self) -> float:
        """Lowest position of the axis."""
        return self.low - self.band if self.has_zero else self.low

    @property
    def stop(self) -> float:
        """Highest position of the axis."""
        return self.high + self.band if self.has_infinite else self.high

    @property
    def separators(self) -> tuple[float, ...]:
        """Positions of the lines between the bands and the logarithmic part."""
        return (self.low,) * self.has_zero + (self.high,) * self.has_infinite

    def positions(self, values: Floats) -> Floats:
        """Return the (N,) positions of (N,) values; those below 0 and NaN have none: NaN."""
        positive = np.isfinite(values) & (values > 0)
        found = np.full(len(values), np.nan)
        found[positive] = np.log10(values[positive])
        found[values == 0] = self.low - self.band / 2
        found[values == inf] = self.high + self.band / 2
        return found

    def ticks(self, low: float, high: float, unit: str) -> list[tuple[float, str]]:
        """Return positions between ``low`` and ``high`` that are labelled, with their labels."""
        low, high = max(low, self.low), min(high, self.high)
        marks = [(self.low - self.band / 2, axis_text(0.0, unit))] * self.has_zero
        marks += [(self.high + self.band / 2, "∞")] * self.has_infinite
        if high <= low:
            return marks
        steps = (1, 2, 5) if high - low < _FEW_DECADES else (1,)
        stride = max(1, ceil((high - low) / _MOST_DECADES))
        for decade in range(max(floor(low), _LEAST), min(ceil(high), _MOST) + 1):
            for step in steps if decade % stride == 0 else ():
                if low <= decade + log10(step) <= high:
                    marks.append((decade + log10(step), axis_text(step * 10.0**decade, unit)))
        return marks


def scale_of(values: Floats) -> ChartScale:
    """Return the scale that (N,) values need; NaN and values below 0 do not count."""
    positive = values[np.isfinite(values) & (values > 0)]
    has_zero, has_infinite = bool((values == 0).any()), bool((values == inf).any())
    if len(positive) == 0:
        # Nothing but zeros: one decade on which nothing stands, so that their band has a size.
        return ChartScale(-1.0, 0.0, has_zero, has_infinite)
    low, high = float(np.log10(positive.min())), float(np.log10(positive.max()))
    middle, half = (low + high) / 2, max((high - low) / 2, 0.25)
    room = 2 * half * _ROOM + 0.02
    return ChartScale(middle - half - room, middle + half + room, has_zero, has_infinite)


def time_text(seconds: float, digits: int = 4) -> str:
    """Write seconds with the prefix that leaves a number from 1 to 1000: ``12.5 µs``."""
    size, name = next(((s, n) for s, n in _PREFIXES if abs(seconds) >= s * 0.9995), _PREFIXES[-1])
    if seconds == 0:
        size, name = _PREFIXES[0]
    return f"{number_text(seconds / size, digits)} {name}"


def axis_text(value: float, unit: str) -> str:
    """Write a value at an axis: units other than seconds stand in its title."""
    if unit == "s":
        return "0" if value == 0 else time_text(value)
    if 1e-4 < value < 1e6:
        return f"{value:,.10g}"
    return number_text(value)


# The ground of a chart: two logarithmic axes, series of marks and lines, all in the colours of the theme.


pg.setConfigOptions(imageAxisOrder="row-major", antialias=True)

MARK_SIZE = 0.95
"""Width of a mark, in heights of the text."""
_DASHES = (Qt.PenStyle.SolidLine, Qt.PenStyle.DashLine, Qt.PenStyle.DotLine, Qt.PenStyle.DashDotLine)


class ChartCanvas(pg.GraphicsView):
    """Draws a `ChartPicture`; wheel zooms, drag pans, double click shows all again."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._picture: ChartPicture | None = None
        self._scales: tuple[ChartScale, ChartScale] | None = None
        self._fitted: list[list[float]] = []
        """The ranges that show everything; others are the user's."""
        self._places: dict[str, Floats] = {}
        """(N, 2) positions of the points of every series."""
        self.view = pg.ViewBox(enableMenu=False)
        self.axes = (pg.AxisItem("bottom"), pg.AxisItem("left"))
        layout = pg.GraphicsLayout()
        self._layout = layout
        layout.addItem(self.axes[1], 0, 0)
        layout.addItem(self.view, 0, 1)
        layout.addItem(self.axes[0], 1, 1)
        self.setCentralItem(layout)
        self.setCacheMode(pg.GraphicsView.CacheModeFlag.CacheNone)  # The ground is one colour, also in files.
        for axis in self.axes:
            axis.linkToView(self.view)
            axis.enableAutoSIPrefix(False)
        self.view.sigRangeChanged.connect(self._show_ticks)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self._follow_theme()

    @property
    def picture(self) -> ChartPicture | None:
        """What is shown."""
        return self._picture

    def show_picture(self, picture: ChartPicture | None) -> None:
        """Show series on axes that hold all of them."""
        axes = None if self._picture is None else (self._picture.x_axis, self._picture.y_axis)
        self._picture = picture
        self._rebuild()
        if picture is not None and (axes != (picture.x_axis, picture.y_axis) or not self._is_zoomed()):
            self.fit()

    def fit(self) -> None:
        """Show everything."""
        if self._scales is not None:
            across, up = self._scales
            self.view.setRange(xRange=(across.start, across.stop), yRange=(up.start, up.stop), padding=0)
            self._fitted = self.view.viewRange()
        self.viewport().update()

    def place_of(self, key: str, index: int = -1) -> QPointF | None:
        """Return where a point of a series is in the widget; ``None``: it has no place."""
        places = self._places.get(key)
        if places is None or not np.isfinite(places[index]).all():
            return None
        return self._in_widget(places[index : index + 1 or None])[0]

    def places(self) -> list[tuple[str, QPointF]]:
        """Return the key and the place in the widget of every point that can be seen."""
        return [(key, at) for key, _, at in self.points()]

    def points(self) -> list[tuple[str, int, QPointF]]:
        """Return key, number in its series and place in the widget of every point that can be seen."""
        area = self.plot_area().adjusted(-1, -1, 1, 1)
        found = []
        for key, places in self._places.items():
            for index in range(len(places)):
                at = self.place_of(key, index)
                if at is not None and area.contains(at):
                    found.append((key, index, at))
        return found

    def bars(self) -> list[QRectF]:
        """Return the rectangles in the widget that bars take."""
        found = []
        for series in () if self._picture is None else self._picture.series:
            for ends in self._bar_ends(series):
                start, stop = self._in_widget(ends)
                found.append(QRectF(start, stop).normalized().adjusted(-1, -2, 1, 2))
        return found

    def front_lines(self) -> list[QRectF]:
        """Return the rectangles in the widget that the parts of the front take."""
        corners = pairwise(self._in_widget(self._front()))
        return [QRectF(start, stop).normalized().adjusted(-1, -1, 1, 1) for start, stop in corners]

    def plot_area(self) -> QRectF:
        """Return the rectangle between the axes, in the widget."""
        return QRectF(self.view.sceneBoundingRect())

    def _in_widget(self, positions: Floats) -> list[QPointF]:
        """Return where (N, 2) positions on the axes are in the widget."""
        area, (across, up) = self.plot_area(), self.view.viewRange()
        x = area.left() + (positions[:, 0] - across[0]) * (area.width() / (across[1] - across[0]))
        y = area.bottom() - (positions[:, 1] - up[0]) * (area.height() / (up[1] - up[0]))
        return [QPointF(*at) for at in zip(x.tolist(), y.tolist(), strict=True)]

    def mark_size(self) -> float:
        """Return the width of a mark in pixels."""
        return MARK_SIZE * current_theme().text_px

    # Building.

    def _is_zoomed(self) -> bool:
        return self._scales is not None and self.view.viewRange() != self._fitted

    def _rebuild(self) -> None:
        self._places.clear()
        picture = self._picture
        for axis in self.axes:
            axis.setVisible(picture is not None)
        if picture is None:
            self._scales = None
            self.viewport().update()
            return
        self._scales = _scales(picture.series)
        across, up = self._scales
        for series in picture.series:
            self._places[series.key] = np.column_stack([across.positions(series.x), up.positions(series.y)])
        self._show_ticks()
        self.viewport().update()

    def _front(self) -> Floats:
        """Return (C, 2) corners of the front: right of this line and above it some other method is better in both."""
        picture, scales = self._picture, self._scales
        if picture is None or scales is None or not picture.front:
            return np.empty((0, 2))
        across, up = scales
        ends = np.concatenate([self._places[key][:1] for key in picture.front])
        steps_x = np.repeat(np.append(ends[:, 0], across.stop), 2)[:-1]
        return np.column_stack([steps_x, np.append(up.stop, np.repeat(ends[:, 1], 2))])

    def _bar_ends(self, series: ChartSeries) -> Floats:
        """Return the (B, 2, 2) positions of both ends of every bar that can be seen."""
        assert self._scales is not None
        found = [np.empty((0, 2, 2))]
        for axis, spread in enumerate((series.x_spread, series.y_spread)):
            if spread is None:
                continue
            ends = np.repeat(self._places[series.key][:, None], 2, axis=1)
            for end in (0, 1):
                ends[:, end, axis] = self._scales[axis].positions(spread[:, end])
            found.append(ends[np.isfinite(ends).all(axis=(1, 2))])
        return np.concatenate(found)

    # Painting. In pixels of the widget, not in decades of the view: pens keep their width in files too.

    def paint_series(self, painter: QPainter, picture: ChartPicture) -> None:
        """Draw the separators, the front, and the lines, bars and marks of all series."""
        theme = current_theme()
        painter.save()
        painter.setClipRect(self.plot_area())
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(QColor(theme.outline), 1.0, Qt.PenStyle.DotLine))
        self._paint_separators(painter)
        painter.setPen(QPen(QColor(theme.muted_text), 1.5, Qt.PenStyle.DashLine))
        painter.drawPolyline(QPolygonF(self._in_widget(self._front())))
        for series in picture.series:
            color = QColor(series_color(series.number))
            painter.setPen(QPen(color, 1.5, _DASHES[series.number % len(_DASHES)]))
            self.paint_line(painter, series)
            painter.setPen(QPen(color, 1.5))
            for ends in self._bar_ends(series):
                painter.drawLine(*self._in_widget(ends))
        for series in picture.series:
            # Marks along a line are smaller.
            size = self.mark_size() * (1.0 if len(series.x) == 1 else 0.7)
            places = self._places[series.key]
            for at in self._in_widget(places[np.isfinite(places).all(axis=1)]):
                paint_mark(painter, at, series.number, size)
        painter.restore()

    def paint_line(self, painter: QPainter, series: ChartSeries) -> None:
        """Draw the line of a series of several points, with a gap where a value has no place."""
        places = self._places[series.key]
        gaps = np.flatnonzero(~np.isfinite(places).all(axis=1))
        for part in np.split(places, gaps) if len(places) > 1 else ():
            painter.drawPolyline(QPolygonF(self._in_widget(part[np.isfinite(part).all(axis=1)])))

    def _paint_separators(self, painter: QPainter) -> None:
        assert self._scales is not None
        area, (across, up) = self.plot_area(), self._scales
        for at in self._in_widget(np.array([[x, up.low] for x in across.separators]).reshape(-1, 2)):
            painter.drawLine(QPointF(at.x(), area.top()), QPointF(at.x(), area.bottom()))
        for at in self._in_widget(np.array([[across.low, y] for y in up.separators]).reshape(-1, 2)):
            painter.drawLine(QPointF(area.left(), at.y()), QPointF(area.right(), at.y()))

    @Slot()
    def _show_ticks(self) -> None:
        """Label what can be seen."""
        if self._scales is None or self._picture is None:
            return
        records = (self._picture.x_axis, self._picture.y_axis)
        for axis, scale, record, seen in zip(
            self.axes, self._scales, records, self.view.viewRange(), strict=True
        ):
            low, high = seen
            axis.setTicks([scale.ticks(low, high, record.unit), []])
        self.viewport().update()

    @Slot()
    def _follow_theme(self) -> None:
        if self.closed:
            return  # Closing has emptied the scene already; the widget itself ends a little later.
        theme = current_theme()
        self.setBackground(theme.panel)
        metrics = QFontMetricsF(text_font(theme, theme.small_px))
        for axis in self.axes:
            axis.setPen(QPen(QColor(theme.outline)))
            axis.setTextPen(QPen(QColor(theme.text)))
            axis.setTickFont(text_font(theme, theme.small_px))
            axis.setStyle(tickLength=-4)
        # The titles are written by the chart: the upper one over the axis, across, so that it can be read.
        line = QFontMetricsF(text_font(theme)).height()
        self._layout.setContentsMargins(4, line + 8, 12, line + 6)
        self.setMinimumSize(18 * theme.text_px, 11 * theme.text_px)
        self.axes[0].setHeight(metrics.height() + 8)
        self.axes[1].setWidth(metrics.horizontalAdvance("1,000,000") + 8)
        self._rebuild()


def _scales(series: Sequence[ChartSeries]) -> tuple[ChartScale, ChartScale]:
    """Return the scales that hold all points and bars."""
    found = []
    for axis in ("x", "y"):
        values = [np.empty(0)]
        for one in series:
            values.append(getattr(one, axis))
            spread = getattr(one, f"{axis}_spread")
            if spread is not None:
                values.append(spread.ravel())
        found.append(scale_of(np.concatenate(values)))
    return found[0], found[1]
