"""How overlays are painted: patterns under the grid lines; glyphs, outlines and thin lines above."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

from widgets.basics.image import mask_image
from widgets.basics.theme import Theme, faded, text_font
from widgets.grid.geometry import paint_chip
from widgets.grid.layers import (
    BlockOverlay,
    BlockState,
    CellMark,
    CountOverlay,
    MaskOverlay,
    Overlay,
    SegmentOverlay,
    SpanOverlay,
    bounds,
)
from widgets.grid.marks import is_pattern, mark_color, pattern_brush, transparent_image
from widgets.grid.names import moved_inside
from widgets.grid.view import GridPlacement, widget_lines

_GLYPH_CELL = 6.0
"""Side of a cell from which glyphs have their form; below it they are dots."""
_STROKES = {
    CellMark.DEPTH_FAILED: (((-1, -1), (1, 1)), ((-1, 1), (1, -1))),
    CellMark.RIGHT: (((-1, 0.1), (-0.3, 0.8), (1, -0.8)),),
    CellMark.MISSING: (((-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)),),
    CellMark.EXTRA: (((-1, -1), (1, 1)), ((-1, 1), (1, -1))),
    CellMark.DOUBLE: (((-0.45, -1), (-0.45, 1)), ((0.45, -1), (0.45, 1))),
}
"""Glyphs drawn as lines: the corners of each, x to the right and y down, 1 is the glyph's reach."""
_NUMBER_CELL = 24.0
"""Side of a cell from which small glyphs leave its middle to a number."""
_COUNT_CELL = 18.0
"""Side of a cell from which counts are written as numbers."""
_LABEL_CELL = 8.0
"""Side of a cell from which lines have their label."""


def paint_below(
    painter: QPainter, placement: GridPlacement, overlays: Iterable[Overlay], theme: Theme
) -> None:
    """Paint the parts of overlays that lie under the grid lines: fills, hatches, checkers and tints."""
    for overlay in overlays:
        if isinstance(overlay, MaskOverlay) and is_pattern(overlay.mark):
            paint_pattern(painter, placement, overlay.mask, overlay.mark, theme)
        elif isinstance(overlay, CountOverlay):
            _paint_tint(painter, placement, overlay.counts, theme)
        elif isinstance(overlay, BlockOverlay):
            _fill_blocks(painter, placement, overlay, theme)


def paint_above(
    painter: QPainter, placement: GridPlacement, overlays: Iterable[Overlay], theme: Theme
) -> None:
    """Paint the parts of overlays that lie over the grid lines: glyphs, numbers, outlines and thin lines."""
    for overlay in overlays:
        if isinstance(overlay, MaskOverlay):
            if not is_pattern(overlay.mark):
                _paint_glyphs(painter, placement, overlay, theme)
        elif isinstance(overlay, CountOverlay):
            _paint_counts(painter, placement, overlay.counts, theme)
        elif isinstance(overlay, BlockOverlay):
            _outline_blocks(painter, placement, overlay, theme)
        elif isinstance(overlay, SpanOverlay):
            _paint_spans(painter, placement, overlay, theme)
        elif isinstance(overlay, SegmentOverlay):
            _paint_segments(painter, placement, overlay, theme)


def paint_pattern(
    painter: QPainter, placement: GridPlacement, mask: NDArray[np.bool_], mark: CellMark, theme: Theme
) -> None:
    """Paint the pattern of ``mark`` over the visible cells of an (H, W) mask.

    The pattern fills a layer of its own that the mask, magnified, is cut out of: the cost does not depend
    on the number of cells, and a hatch runs on from cell to cell.
    """
    column0, row0, column1, row1 = _painted_cells(painter, placement)
    left, low, right, high = bounds(mask[row0:row1, column0:column1])
    if left == right:
        return
    part = mask[row0 + low : row0 + high, column0 + left : column0 + right]
    target = placement.cells_rect(column0 + left, row0 + low, right - left, high - low)
    ratio = painter.device().devicePixelRatioF()
    brush = pattern_brush(mark, theme, ratio)
    painter.save()
    if part.all():
        painter.setBrushOrigin(QPointF(placement.left, placement.bottom))
        painter.fillRect(target, brush)
    else:
        # Cut to the screen first: one cell may be far larger than the viewport shows.
        shown = target.intersected(QRectF(placement.viewport)).toAlignedRect()
        layer = transparent_image(shown.width(), shown.height(), ratio)
        inner = QPainter(layer)
        inner.setBrushOrigin(QPointF(placement.left - shown.x(), placement.bottom - shown.y()))
        inner.fillRect(QRectF(0, 0, shown.width(), shown.height()), brush)
        inner.setCompositionMode(QPainter.CompositionMode.CompositionMode_DestinationIn)
        inner.drawImage(target.translated(-shown.x(), -shown.y()), mask_image(part))
        inner.end()
        painter.drawImage(shown.topLeft(), layer)
    painter.restore()


def _paint_tint(
    painter: QPainter, placement: GridPlacement, counts: NDArray[np.integer], theme: Theme
) -> None:
    """Paint a tint that grows with the count."""
    column0, row0, column1, row1 = placement.visible_cells()
    part = counts[row0:row1, column0:column1]
    if part.size == 0:
        return
    for level in range(1, min(int(part.max()), 5) + 1):
        painter.save()
        painter.setOpacity(0.35)
        paint_pattern(painter, placement, counts >= level, CellMark.COVERED, theme)
        painter.restore()


def _paint_counts(
    painter: QPainter, placement: GridPlacement, counts: NDArray[np.integer], theme: Theme
) -> None:
    """Write counts into the lower right corner of large cells."""
    if placement.cell < _COUNT_CELL:
        return
    size = int(min(max(placement.cell * 0.3, 8), theme.small_px))
    painter.setFont(text_font(theme, size))
    metrics = painter.fontMetrics()
    chip, ink = faded(theme.panel, 0.85), QColor(theme.text)
    for column, row in _visible(painter, placement, counts > 0):
        text = f"×{int(counts[row, column])}"
        box = QRectF(0, 0, metrics.horizontalAdvance(text) + 4, metrics.height())
        box.moveBottomRight(placement.cells_rect(column, row).bottomRight() - QPointF(0, 1))
        painter.fillRect(box, chip)
        painter.setPen(ink)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)


def _paint_glyphs(painter: QPainter, placement: GridPlacement, overlay: MaskOverlay, theme: Theme) -> None:
    """Paint rings, arrowheads, crosses or corners; dots where cells are too small for them."""
    color, halo = QColor(mark_color(overlay.mark, theme)), QColor("#000000")
    cell = placement.cell
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    if cell < _GLYPH_CELL:
        # A mark that has to be told from its neighbours keeps a form: full, hollow or half.
        cells = [placement.cells_rect(*pixel) for pixel in _visible(painter, placement, overlay.mask)]
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(color)
        if overlay.mark is CellMark.MISSING:
            painter.setPen(QPen(color, 1.0))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRects([rect.adjusted(0.5, 0.5, -0.5, -0.5) for rect in cells])
        elif overlay.mark is CellMark.EXTRA:
            for rect in cells:
                painter.drawPolygon(QPolygonF([rect.bottomLeft(), rect.topRight(), rect.bottomRight()]))
        else:
            painter.drawRects(cells)
        painter.restore()
        return
    width = min(max(cell * 0.09, 1.2), 2.5)
    outer, inner = QPen(halo, width + 1.8), QPen(color, width)
    for pen in (outer, inner):
        pen.setJoinStyle(Qt.PenJoinStyle.MiterJoin)
    size = min(cell * 0.3, 14.0)
    for column, row in _visible(painter, placement, overlay.mask):
        rect = placement.cells_rect(column, row)
        middle = rect.center()
        if overlay.mark is CellMark.TIE:
            painter.setBrush(Qt.BrushStyle.NoBrush)
            for pen in (outer, inner):
                painter.setPen(pen)
                painter.drawEllipse(middle, size, size)
        elif overlay.mark in _STROKES:
            place, reach = (
                corner_glyph(rect) if overlay.mark is CellMark.DEPTH_FAILED else (middle, size * 0.9)
            )
            lines = [
                QPolygonF([place + QPointF(reach * x, reach * y) for x, y in stroke])
                for stroke in _STROKES[overlay.mark]
            ]
            for pen in (outer, inner):
                painter.setPen(pen)
                for line in lines:
                    painter.drawPolyline(line)
        else:
            painter.setPen(QPen(halo, 1.0))
            painter.setBrush(color)
            painter.drawPolygon(
                _arrowhead(*corner_glyph(rect)) if overlay.mark is CellMark.DEPTH_PASSED else _corner(rect)
            )
    painter.restore()


def corner_glyph(rect: QRectF) -> tuple[QPointF, float]:
    """Return middle and reach of a glyph beside a number: in the upper left corner, or the middle of a small cell."""
    if rect.height() < _NUMBER_CELL:
        return rect.center(), rect.height() * 0.165
    reach = min(rect.height() * 0.11, 7.7)
    return rect.topLeft() + QPointF(reach + 4, reach + 4), reach


def _arrowhead(place: QPointF, reach: float) -> QPolygonF:
    """Return a triangle that points up."""
    return QPolygonF(
        [
            place + QPointF(0, -reach),
            place + QPointF(reach, reach * 0.7),
            place + QPointF(-reach, reach * 0.7),
        ]
    )


def _corner(rect: QRectF) -> QPolygonF:
    """Return the upper right corner of a cell as a triangle."""
    size = min(rect.width() * 0.45, 16.0)
    corner = rect.topRight() + QPointF(-1.5, 1.5)
    return QPolygonF([corner, corner - QPointF(size, 0), corner + QPointF(0, size)])


def _fill_blocks(painter: QPainter, placement: GridPlacement, overlay: BlockOverlay, theme: Theme) -> None:
    """Fill accepted blocks and hatch rejected ones."""
    ratio = painter.device().devicePixelRatioF()
    fills = {BlockState.ACCEPTED: CellMark.COVERED, BlockState.REJECTED: CellMark.REJECTED}
    painter.save()
    painter.setBrushOrigin(QPointF(placement.left, placement.bottom))
    for rect, state in zip(_block_rects(placement, overlay), overlay.states, strict=True):
        if state in fills:
            painter.setOpacity(0.9 if state is BlockState.ACCEPTED else 0.5)
            painter.fillRect(rect, pattern_brush(fills[state], theme, ratio))
    painter.restore()


def _outline_blocks(painter: QPainter, placement: GridPlacement, overlay: BlockOverlay, theme: Theme) -> None:
    """Outline blocks by their state and write their labels."""
    styles = {
        BlockState.REJECTED: (theme.rejected, Qt.PenStyle.SolidLine),
        BlockState.ACCEPTED: (theme.covered, Qt.PenStyle.SolidLine),
        BlockState.SPLIT: (theme.text, Qt.PenStyle.DashLine),
        BlockState.LEAF: (theme.muted_text, Qt.PenStyle.DotLine),
    }
    painter.save()
    font = text_font(theme, theme.small_px)
    painter.setFont(font)
    height = painter.fontMetrics().height()
    for index, rect in enumerate(_block_rects(placement, overlay)):
        color, style = styles[overlay.states[index]]
        if overlay.edges and overlay.edges[index] in (0, 1, 2):
            color = theme.vertex[overlay.edges[index]]
        inside = rect.adjusted(1, 1, -1, -1)
        painter.setPen(QPen(faded(theme.halo(), 0.7), 3.0))
        painter.drawRect(inside)
        painter.setPen(QPen(QColor(color), 1.4, style))
        painter.drawRect(inside)
        label = overlay.labels[index] if overlay.labels else ""
        width = painter.fontMetrics().horizontalAdvance(label) + 8
        if label and rect.width() >= width + 4 and rect.height() >= height + 4:
            chip = QRectF(rect.left() + 2, rect.top() + 2, width, height)
            painter.fillRect(chip, faded(theme.panel, 0.85))
            painter.setPen(QColor(theme.text))
            painter.drawText(chip, Qt.AlignmentFlag.AlignCenter, label)
    painter.restore()


def _block_rects(placement: GridPlacement, overlay: BlockOverlay) -> list[QRectF]:
    """Return the widget rectangles of blocks."""
    return [placement.cells_rect(*block) for block in overlay.blocks.tolist()]


def _paint_spans(painter: QPainter, placement: GridPlacement, overlay: SpanOverlay, theme: Theme) -> None:
    """Paint each span as a bar with two ends."""
    tick = min(placement.cell * 0.25, 6.0)
    lines = []
    for row, first, end in overlay.spans.tolist():
        rect = placement.cells_rect(first, row, end - first, 1)
        # Where values are written, the bar runs below them.
        y = rect.center().y() if placement.cell < 40 else rect.bottom() - max(tick + 3, 0.14 * placement.cell)
        left, right = rect.left() + 2.5, rect.right() - 2.5
        if end > first:
            lines += [QLineF(left, y, right, y), QLineF(left, y - tick, left, y + tick)]
            lines.append(QLineF(right, y - tick, right, y + tick))
    _stroke(painter, lines, QColor(theme.text), 1.5, theme)


def _paint_segments(
    painter: QPainter, placement: GridPlacement, overlay: SegmentOverlay, theme: Theme
) -> None:
    """Paint window segments, or the whole lines through them, in the colours of their edges."""
    if overlay.is_polygon:
        _tint_polygon(painter, placement, overlay, theme)
    lines, source = widget_lines(overlay.segments, placement, overlay.extended)
    edges = np.array(overlay.edges or (-1,) * len(overlay.segments))[source]
    style = Qt.PenStyle.DashLine if overlay.extended else Qt.PenStyle.SolidLine
    for edge in (-1, 0, 1, 2):
        color = QColor(theme.text if edge < 0 else theme.vertex[edge])
        shown = [lines[index] for index in np.flatnonzero(edges == edge)]
        _stroke(painter, shown, color, overlay.width, theme, style)
    if overlay.tag and placement.cell >= _LABEL_CELL:
        _paint_label(painter, placement, overlay, theme)


def _paint_label(painter: QPainter, placement: GridPlacement, overlay: SegmentOverlay, theme: Theme) -> None:
    """Write the label inside the upper left corner of all segments."""
    x, y = overlay.segments[..., 0].min(), overlay.segments[..., 1].max()
    if not np.isfinite([x, y]).all():
        return
    painter.save()
    painter.setFont(text_font(theme, theme.small_px))
    metrics = painter.fontMetrics()
    box = QRectF(0, 0, metrics.horizontalAdvance(overlay.tag) + 6, metrics.height())
    box.moveTopLeft(placement.to_widget(float(x), float(y)) + QPointF(3, 3))
    paint_chip(painter, moved_inside(box, QRectF(placement.viewport)), overlay.tag, theme.text, theme)
    painter.restore()


def _tint_polygon(painter: QPainter, placement: GridPlacement, overlay: SegmentOverlay, theme: Theme) -> None:
    """Tint the inside of a polygon."""
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(faded(theme.covered, 0.6))
    painter.drawPolygon(QPolygonF([placement.to_widget(x, y) for x, y in overlay.segments[:, 0].tolist()]))
    painter.restore()


def _stroke(
    painter: QPainter,
    lines: list[QLineF],
    color: QColor,
    width: float,
    theme: Theme,
    style: Qt.PenStyle = Qt.PenStyle.SolidLine,
) -> None:
    """Draw thin lines over a halo, so that they are seen on any pixel."""
    if not lines:
        return
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(QPen(faded(theme.halo(), 0.7), width + 2.0))
    painter.drawLines(lines)
    painter.setPen(QPen(color, width, style))
    painter.drawLines(lines)
    painter.restore()


def _visible(painter: QPainter, placement: GridPlacement, mask: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return (column, row) of the true cells of an (H, W) mask in the part that is painted."""
    column0, row0, column1, row1 = _painted_cells(painter, placement)
    rows, columns = np.nonzero(mask[row0:row1, column0:column1])
    return list(zip((columns + column0).tolist(), (rows + row0).tolist(), strict=True))


def _painted_cells(painter: QPainter, placement: GridPlacement) -> tuple[int, int, int, int]:
    """Return (column0, row0, column1, row1) of the cells in the part that is painted."""
    if painter.hasClipping():
        return placement.cells_in(painter.clipBoundingRect())
    return placement.visible_cells()
