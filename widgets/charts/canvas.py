"""The ground of a chart: two logarithmic axes, series of marks and lines, all in the colours of the theme."""

from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import lcm

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, Qt, Slot
from PySide6.QtGui import QColor, QFontMetricsF, QPen
from PySide6.QtWidgets import QWidget

from core.records.arrays import Floats
from widgets.basics.theme import current_theme, text_font, theme_notifier
from widgets.charts.records import ChartPicture, ChartSeries
from widgets.charts.scale import ChartScale, scale_of
from widgets.charts.series_marks import LIGHT_COLORS, series_color, series_growth, series_shape

pg.setConfigOptions(imageAxisOrder="row-major", antialias=True)

MARK_SIZE = 0.95
"""Width of a mark, in heights of the text."""
_DASHES = (Qt.PenStyle.SolidLine, Qt.PenStyle.DashLine, Qt.PenStyle.DotLine, Qt.PenStyle.DashDotLine)
LOOKS = lcm(len(LIGHT_COLORS), len(_DASHES))
"""Numbers of series that colour and dashes tell apart; those of later ones come again."""


class ChartCanvas(pg.GraphicsView):
    """Draws a :class:`~widgets.charts.records.ChartPicture`; wheel zooms, drag pans, double click shows all again."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._picture: ChartPicture | None = None
        self._scales: tuple[ChartScale, ChartScale] | None = None
        self._fitted: list[list[float]] = []
        """The ranges that show everything; others are the user's."""
        self._items: list[pg.GraphicsObject] = []
        self._places: dict[str, Floats] = {}
        self._front = np.empty((0, 2))
        """(C, 2) positions of the corners of the line of the front."""
        self.view = pg.ViewBox(enableMenu=False)
        self.axes = (pg.AxisItem("bottom"), pg.AxisItem("left"))
        layout = pg.GraphicsLayout()
        self._layout = layout
        layout.addItem(self.axes[1], 0, 0)
        layout.addItem(self.view, 0, 1)
        layout.addItem(self.axes[0], 1, 1)
        self.setCentralItem(layout)
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
        return QPointF(self.view.mapViewToScene(QPointF(*places[index].tolist())))

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
            for ends in self._bar_ends(series).tolist():
                start, stop = (QPointF(self.view.mapViewToScene(QPointF(*end))) for end in ends)
                found.append(QRectF(start, stop).normalized().adjusted(-1, -2, 1, 2))
        return found

    def front_lines(self) -> list[QRectF]:
        """Return the rectangles in the widget that the parts of the front take."""
        corners = [self.view.mapViewToScene(QPointF(*corner)) for corner in self._front.tolist()]
        return [QRectF(start, stop).normalized().adjusted(-1, -1, 1, 1) for start, stop in pairwise(corners)]

    def plot_area(self) -> QRectF:
        """Return the rectangle between the axes, in the widget."""
        return QRectF(self.view.sceneBoundingRect())

    def mark_size(self) -> float:
        """Return the width of a mark in pixels."""
        return MARK_SIZE * current_theme().text_px

    # Building.

    def _is_zoomed(self) -> bool:
        return self._scales is not None and self.view.viewRange() != self._fitted

    def _rebuild(self) -> None:
        for item in self._items:
            self.view.removeItem(item)
        self._items.clear()
        self._places.clear()
        self._front = np.empty((0, 2))
        picture = self._picture
        for axis in self.axes:
            axis.setVisible(picture is not None)
        if picture is None:
            self._scales = None
            self.viewport().update()
            return
        self._scales = _scales(picture.series)
        self._add_separators()
        self._add_front(picture)
        across, up = self._scales
        for series in picture.series:
            self._places[series.key] = np.column_stack([across.positions(series.x), up.positions(series.y)])
        self._add_lines(picture.series)
        self._add_bars(picture.series)
        self._add_marks(picture.series)
        self._show_ticks()
        self.viewport().update()

    def _add_separators(self) -> None:
        assert self._scales is not None
        pen = _cosmetic(QPen(QColor(current_theme().outline), 1.0, Qt.PenStyle.DotLine))
        for scale, angle in zip(self._scales, (90, 0), strict=True):
            for position in scale.separators:
                self._add(pg.InfiniteLine(position, angle=angle, pen=pen))

    def _add_front(self, picture: ChartPicture) -> None:
        """Draw the front as a step line: right of it and above it some other method is better in both."""
        assert self._scales is not None
        by_key = {series.key: series for series in picture.series}
        if not picture.front:
            return
        across, up = self._scales
        x = across.positions(np.array([by_key[key].x[0] for key in picture.front]))
        y = up.positions(np.array([by_key[key].y[0] for key in picture.front]))
        steps_x = np.repeat(np.append(x, across.stop), 2)[:-1]
        steps_y = np.append(up.stop, np.repeat(y, 2))
        self._front = np.column_stack([steps_x, steps_y])
        pen = QPen(QColor(current_theme().muted_text), 1.5, Qt.PenStyle.DashLine)
        self._add(pg.PlotCurveItem(steps_x, steps_y, pen=_cosmetic(pen)))

    def _add_lines(self, series: Sequence[ChartSeries]) -> None:
        """Draw the lines of series of several points, those that look alike as one item: items are what takes time."""
        for number, alike in _by_look(one for one in series if len(one.x) > 1).items():
            pen = QPen(QColor(series_color(number)), 1.5, _DASHES[number % len(_DASHES)])
            gap = np.full((1, 2), np.nan)
            joined = np.concatenate([part for one in alike for part in (self._places[one.key], gap)])
            self._add(pg.PlotCurveItem(joined[:, 0], joined[:, 1], pen=_cosmetic(pen), connect="finite"))

    def _add_bars(self, series: Sequence[ChartSeries]) -> None:
        """Draw the bars from quartile to quartile, all of one colour as one item."""
        for number, alike in _by_look(series).items():
            ends = [found for one in alike if len(found := self._bar_ends(one))]
            if ends:
                joined = np.concatenate(ends).reshape(-1, 2)
                pen = _cosmetic(QPen(QColor(series_color(number)), 1.5))
                self._add(pg.PlotCurveItem(joined[:, 0], joined[:, 1], pen=pen, connect="pairs"))

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

    def _add_marks(self, series: Sequence[ChartSeries]) -> None:
        """Draw the marks of all series as one item."""
        spots = [
            {"pos": place, "symbol": series_shape(one.number), "size": self._size_of(one), "brush": brush}
            for one in series
            for brush in [pg.mkBrush(series_color(one.number))]
            for place in self._places[one.key]
            if np.isfinite(place).all()
        ]
        # Without its cache every mark is drawn as a path: sharp in every size, and in files.
        self._add(pg.ScatterPlotItem(spots, pen=pg.mkPen(None), useCache=False))

    def _size_of(self, series: ChartSeries) -> float:
        """Return the width in pixels of the marks of a series; those along a line are smaller."""
        return self.mark_size() * series_growth(series.number) * (1.0 if len(series.x) == 1 else 0.7)

    def _add(self, item: pg.GraphicsObject) -> None:
        self._items.append(item)
        self.view.addItem(item, ignoreBounds=True)

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


def _by_look(series: Iterable[ChartSeries]) -> dict[int, list[ChartSeries]]:
    """Return series by the number of the first that has their colour and dashes."""
    found: dict[int, list[ChartSeries]] = {}
    for one in series:
        found.setdefault(one.number % LOOKS, []).append(one)
    return found


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


def _cosmetic(pen: QPen) -> QPen:
    """Return a pen whose width is in pixels, whatever the scale."""
    pen.setCosmetic(True)
    return pen
