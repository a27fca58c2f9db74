"""What lies over the main grid: the legend of its overlays, and in a corner the whole picture in small."""

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRect, QRectF, QSize, Qt, Signal, Slot
from PySide6.QtGui import (
    QColor,
    QIcon,
    QImage,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPixmap,
    QPolygonF,
    QShowEvent,
)
from PySide6.QtWidgets import QCheckBox, QWidget

from widgets.basics.accessibility import FocusRing, KeyClaim
from widgets.basics.controls import column_layout, flat_button
from widgets.basics.theme import Theme, current_theme, theme_notifier
from widgets.grid.layers import (
    BlockOverlay,
    BlockState,
    CellMark,
    CenterOverlay,
    CountOverlay,
    MaskOverlay,
    Overlay,
    SegmentOverlay,
    SpanOverlay,
)
from widgets.grid.marks import is_pattern, transparent_image
from widgets.grid.overlay_paint import paint_above, paint_below
from widgets.grid.view import GridPlacement

# The legend of the overlays that are on offer: how each looks, and a checkbox to lay it over the grid.


_SWATCH = QSize(28, 18)
_FORMS = {
    CellMark.COVERED: "A translucent fill",
    CellMark.EDGE_0: "Blue horizontal hatch",
    CellMark.EDGE_1: "Orange vertical hatch",
    CellMark.EDGE_2: "Green rising hatch",
    CellMark.TIE: "A ring",
    CellMark.REJECTED: "Falling hatch",
    CellMark.DEPTH_PASSED: "An arrowhead that points up",
    CellMark.DEPTH_FAILED: "A cross",
    CellMark.NAN: "A fine checker",
    CellMark.DIFFERENCE: "A filled corner",
    CellMark.RIGHT: "A tick",
    CellMark.MISSING: "A hollow square",
    CellMark.EXTRA: "A large cross",
    CellMark.DOUBLE: "Two bars",
}


class OverlayLegend(QWidget):
    """Lists overlays with a swatch and a checkbox each; swatches are painted as the grid is."""

    overlays_changed = Signal(object)
    """Keys of the overlays that are on, a frozenset of str, after the user changed them."""

    def __init__(self, parent: QWidget | None = None) -> None:
        """Make an empty legend."""
        super().__init__(parent)
        self._boxes: dict[str, QCheckBox] = {}
        self._overlays: tuple[Overlay, ...] = ()
        self._shown: frozenset[str] = frozenset()
        self._listed: list[tuple[str, str, str]] = []
        """Key, label and look of each checkbox."""
        self._rows = column_layout(self, 0)
        self.setAccessibleName("Overlays")
        theme_notifier().theme_changed.connect(self._repaint_swatches)

    def show_overlays(
        self, overlays: tuple[Overlay, ...] | list[Overlay], shown: frozenset[str] | None = None
    ) -> None:
        """List the overlays on offer; ``shown`` are the keys of those that are on (None: as before)."""
        self._overlays = tuple(overlays)
        kept = self._shown if shown is None else shown
        self._shown = kept & {overlay.key for overlay in self._overlays}
        if self.isVisible():
            self._fill()

    def showEvent(self, event: QShowEvent) -> None:
        """List what came while nobody saw it."""
        super().showEvent(event)
        self._fill()

    def _fill(self) -> None:
        """List the overlays, with those checked that are on."""
        looks = [(item.key, item.label, _look(item)) for item in self._overlays]
        if looks != self._listed:
            self._listed = looks
            self._rebuild()
        for key, box in self._boxes.items():
            box.blockSignals(True)
            box.setChecked(key in self._shown)
            box.blockSignals(False)

    def box(self, key: str) -> QCheckBox:
        """Return the checkbox of an overlay."""
        return self._boxes[key]

    def shown_keys(self) -> frozenset[str]:
        """Return the keys of the overlays that are on."""
        return self._shown

    def shown_overlays(self) -> tuple[Overlay, ...]:
        """Return the overlays that are on, the first lowest."""
        shown = self.shown_keys()
        return tuple(item for item in self._overlays if item.key in shown)

    def _rebuild(self) -> None:
        """Make one checkbox per overlay."""
        for box in self._boxes.values():
            self._rows.removeWidget(box)
            box.hide()
            box.deleteLater()
        self._boxes = {}
        for item in self._overlays:
            box = QCheckBox(item.label, self)
            box.setIconSize(_SWATCH)
            box.setToolTip(_look(item))
            box.toggled.connect(self._tell)
            self._rows.addWidget(box)
            self._boxes[item.key] = box
        self._repaint_swatches()

    def _tell(self) -> None:
        """Tell which overlays are on."""
        self._shown = frozenset(key for key, box in self._boxes.items() if box.isChecked())
        self.overlays_changed.emit(self._shown)

    def _repaint_swatches(self) -> None:
        """Paint the swatches with the present theme."""
        for item in self._overlays:
            if item.key in self._boxes:
                self._boxes[item.key].setIcon(QIcon(swatch(item, current_theme(), self.devicePixelRatioF())))


def swatch(overlay: Overlay, theme: Theme, ratio: float) -> QPixmap:
    """Return a small picture of how an overlay marks pixels, painted as on the grid."""
    image = transparent_image(_SWATCH.width(), _SWATCH.height(), ratio)
    painter = QPainter(image)
    area = QRect(0, 0, _SWATCH.width(), _SWATCH.height())
    painter.fillRect(area, QColor(theme.empty))
    painter.setClipRect(area)
    side = float(area.height())
    columns = 2 if isinstance(overlay, BlockOverlay) or _is_area(overlay) else 1
    placement = GridPlacement(columns, 1, area, (area.width() - columns * side) / 2, side, side)
    sample = [_sample(overlay)]
    paint_below(painter, placement, sample, theme)
    paint_above(painter, placement, sample, theme)
    if isinstance(overlay, CenterOverlay):
        painter.setPen(QColor(theme.text))
        painter.drawText(area, Qt.AlignmentFlag.AlignCenter, "0.5")
    painter.setPen(QColor(theme.outline))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawRect(area.adjusted(0, 0, -1, -1))
    painter.end()
    return QPixmap.fromImage(image)


def _is_area(overlay: Overlay) -> bool:
    """Return whether an overlay's mark is a pattern, which a swatch shows over its whole width."""
    return isinstance(overlay, MaskOverlay) and is_pattern(overlay.mark)


def _look(overlay: Overlay) -> str:
    """Return in words how an overlay looks."""
    if isinstance(overlay, MaskOverlay):
        return _FORMS[overlay.mark]
    if isinstance(overlay, CountOverlay):
        return "A tint that grows with the count; the number in large cells"
    if isinstance(overlay, BlockOverlay):
        return "Hatched: rejected. Filled: accepted whole. Dashed: split. Dotted: tested pixel by pixel"
    if isinstance(overlay, SpanOverlay):
        return "A bar with two ends through the middle of the row"
    if isinstance(overlay, CenterOverlay):
        return "x and y of the pixels' centres in place of the numbers of columns and rows"
    if overlay.is_polygon:
        return "A tinted polygon"
    return "Dashed thin lines" if overlay.extended else "Thin lines"


def _sample(overlay: Overlay) -> Overlay:
    """Return an overlay of the same kind that fills a swatch."""
    if isinstance(overlay, MaskOverlay):
        return MaskOverlay(overlay.key, overlay.mark, np.ones((1, 2 if _is_area(overlay) else 1), np.bool_))
    if isinstance(overlay, CountOverlay):
        return CountOverlay(overlay.key, np.full((1, 1), 2))
    if isinstance(overlay, BlockOverlay):
        blocks = np.array([[0, 0, 1, 1], [1, 0, 1, 1]])
        return BlockOverlay(overlay.key, blocks, (BlockState.REJECTED, BlockState.ACCEPTED))
    if isinstance(overlay, SpanOverlay):
        return SpanOverlay(overlay.key, np.array([[0, 0, 1]]))
    if isinstance(overlay, CenterOverlay):
        return overlay
    if overlay.is_polygon:
        corners = np.array([[0.1, 0.1], [0.9, 0.1], [0.1, 0.9]])
        sides = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
        return SegmentOverlay(overlay.key, sides, is_polygon=True)
    edges = sorted(set(overlay.edges)) or [-1]
    height = (np.arange(len(edges)) + 0.5) / len(edges)
    ends = np.array([[[-0.3, y - 0.1], [1.3, y + 0.1]] for y in height])
    return SegmentOverlay(overlay.key, ends, tuple(edges), overlay.extended)


# The whole picture in small, over a corner of the grid: where the magnified region is, and a way to move
# it.


WIDTH = 13
"""Largest width and height of the picture, in heights of the text."""
KEY_PART = 0.25
"""Part of the region that an arrow key moves it by."""
_FRAME = 3
_LEAST_BOX = 6.0
"""Least side of the outlined region, in logical pixels: a few pixels of a large picture can be found too."""
_MOVES = {Qt.Key.Key_Left: (-1, 0), Qt.Key.Key_Right: (1, 0), Qt.Key.Key_Down: (0, -1), Qt.Key.Key_Up: (0, 1)}


class Navigator(QWidget):
    """A picture with the region and the triangle in focus outlined; a drag or the arrow keys move the region.

    Places are parts of the picture's width and height, from its lower left corner.
    """

    region_moved = Signal(float, float)
    """The user wants the middle of the region here."""
    drag_ended = Signal()
    """The pointer was released: what comes next is another movement."""
    close_requested = Signal()
    """The user wants it out of the way."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._image: QImage | None = None
        self._region = QRectF(0, 0, 1, 1)
        self._triangle: NDArray[np.float64] | None = None
        self._aspect, self._most = 4 / 3, 1000
        self._grab: QPointF | None = None
        self._ring = FocusRing(self)
        KeyClaim(self, tuple(_MOVES))
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.OpenHandCursor)
        self.setAccessibleName("Navigator: the whole picture")
        self.setToolTip("The whole picture. Drag, or press the arrow keys, to move the magnified region")
        self.close_button = flat_button("✕", "Hide the navigator", "Hide the navigator (G)", self)
        self.close_button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.close_button.setProperty("flat", False)
        self.close_button.setFixedSize(24, 24)
        self.close_button.setCursor(Qt.CursorShape.ArrowCursor)
        self.close_button.clicked.connect(self.close_requested)
        theme_notifier().theme_changed.connect(self._fit)
        self._fit()

    def show_picture(self, image: QImage | None) -> None:
        """Show the whole picture; None while there is none."""
        self._image = image
        self.update()

    def show_shape(self, aspect: float, most: int) -> None:
        """Take the shape of a picture, its width over its height, and no more than ``most`` logical pixels."""
        if (aspect, most) != (self._aspect, self._most):
            self._aspect, self._most = aspect, most
            self._fit()

    def show_region(self, region: QRectF, words: str) -> None:
        """Outline a region; ``words`` say which pixels it holds."""
        self.setAccessibleDescription(words)
        if region != self._region:
            self._region = region
            self.update()

    def show_triangle(self, corners: NDArray[np.float64] | None) -> None:
        """Outline the (3, 2) corners of the triangle in focus, or none."""
        self._triangle = corners
        self.update()

    def region(self) -> QRectF:
        """Return the region that is outlined."""
        return QRectF(self._region)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the picture, then both outlines: dark in light lines, seen on every colour."""
        del event
        theme = current_theme()
        with QPainter(self) as painter:
            painter.fillRect(self.rect(), QColor(theme.outline))
            inside = self._inside()
            painter.fillRect(inside, QColor(theme.canvas))
            if self._image is not None:
                painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
                painter.drawImage(inside, self._image)
            painter.setClipRect(inside)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            for color, width in (("#ffffff", 4.0), ("#000000", 1.6)):
                painter.setPen(QPen(QColor(color), width))
                if self._triangle is not None and self._shows_triangle(self._triangle):
                    painter.drawPolygon(QPolygonF([self._place(x, y) for x, y in self._triangle.tolist()]))
                painter.drawRect(self._box())
            painter.setClipping(False)
            self._ring.paint(painter, self.rect())

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take the region where it is, or bring its middle here."""
        if event.button() != Qt.MouseButton.LeftButton:
            return
        box = self._box()
        self._grab = box.center() - event.position() if box.contains(event.position()) else QPointF()
        self.setCursor(Qt.CursorShape.ClosedHandCursor)
        self._move_to(event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Move the region along."""
        if self._grab is not None:
            self._move_to(event.position())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Leave the region here."""
        del event
        self._grab = None
        self.setCursor(Qt.CursorShape.OpenHandCursor)
        self.drag_ended.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move the region by a quarter of itself."""
        move = _MOVES.get(Qt.Key(event.key()))
        if move is None:
            super().keyPressEvent(event)
            return
        middle, region = self._region.center(), self._region
        across, up = (KEY_PART * step for step in move)
        self.region_moved.emit(middle.x() + across * region.width(), middle.y() + up * region.height())
        self.drag_ended.emit()

    def _move_to(self, position: QPointF) -> None:
        assert self._grab is not None
        inside, middle = self._inside(), position + self._grab
        x = (middle.x() - inside.left()) / inside.width()
        y = (inside.bottom() - middle.y()) / inside.height()
        self.region_moved.emit(x, y)

    def _inside(self) -> QRectF:
        return QRectF(self.rect()).adjusted(_FRAME, _FRAME, -_FRAME, -_FRAME)

    def _place(self, x: float, y: float) -> QPointF:
        inside = self._inside()
        return QPointF(inside.left() + x * inside.width(), inside.bottom() - y * inside.height())

    def _shows_triangle(self, corners: NDArray[np.float64]) -> bool:
        """Return whether a triangle is large enough to be told from the outline of the region."""
        inside = self._inside()
        return bool((np.ptp(corners, axis=0) * (inside.width(), inside.height())).max() >= 2 * _LEAST_BOX)

    def _box(self) -> QRectF:
        region = self._region
        box = QRectF(self._place(region.left(), region.bottom()), self._place(region.right(), region.top()))
        room = QPointF(max(_LEAST_BOX - box.width(), 0) / 2, max(_LEAST_BOX - box.height(), 0) / 2)
        return QRectF(box.topLeft() - room, box.bottomRight() + room)

    @Slot()
    def _fit(self) -> None:
        """Take the size that the picture's shape and the text ask for."""
        side = min(WIDTH * current_theme().text_px, self._most)
        wide = max(self._aspect, 0.05)
        size = QSize(side, round(side / wide)) if wide >= 1 else QSize(round(side * wide), side)
        self.setFixedSize(size.expandedTo(QSize(48, 48)) + QSize(2 * _FRAME, 2 * _FRAME))
        self.close_button.move(self.width() - self.close_button.width(), 0)
