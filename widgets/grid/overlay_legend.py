"""The legend of the overlays that are on offer: how each looks, and a checkbox to lay it over the grid."""

import numpy as np
from PySide6.QtCore import QRect, QSize, Qt, Signal
from PySide6.QtGui import QColor, QIcon, QPainter, QPixmap, QShowEvent
from PySide6.QtWidgets import QCheckBox, QWidget

from widgets.basics.controls import column_layout
from widgets.basics.mark_patterns import is_pattern, transparent_image
from widgets.basics.theme import Theme, current_theme, theme_notifier
from widgets.grid.overlay import (
    BlockOverlay,
    BlockState,
    CenterOverlay,
    CountOverlay,
    Mark,
    MaskOverlay,
    Overlay,
    SegmentOverlay,
    SpanOverlay,
)
from widgets.grid.overlay_paint import paint_above, paint_below
from widgets.grid.view import GridPlacement

_SWATCH = QSize(28, 18)
_FORMS = {
    Mark.COVERED: "A translucent fill",
    Mark.EDGE_0: "Blue horizontal hatch",
    Mark.EDGE_1: "Orange vertical hatch",
    Mark.EDGE_2: "Green rising hatch",
    Mark.TIE: "A ring",
    Mark.REJECTED: "Falling hatch",
    Mark.DEPTH_PASSED: "An arrowhead that points up",
    Mark.DEPTH_FAILED: "A cross",
    Mark.NAN: "A fine checker",
    Mark.DIFFERENCE: "A filled corner",
    Mark.RIGHT: "A tick",
    Mark.MISSING: "A hollow square",
    Mark.EXTRA: "A large cross",
    Mark.DOUBLE: "Two bars",
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
