"""Where the cells of a formula stand, numbers under symbols, lines broken at relations; how it is drawn."""

import re
from collections import OrderedDict
from dataclasses import dataclass
from functools import lru_cache
from itertools import chain

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QFont, QFontDatabase, QFontMetricsF, QGuiApplication, QPainter

from core.explain.latex import (
    color_vertices,
    is_operator,
    is_product,
    may_begin_line,
    plain_text,
    split_cells,
    split_products,
    vertex_of,
)
from core.explain.records import Formula
from widgets.basics.theme import Theme, current_theme
from widgets.inspector.typesetter import Typesetter, typesetter_font

_NUMBER = re.compile(r"^\(?[-\u2212]?\d+(?:\.\d*)?\)?$")
_FRACTION = re.compile(r"^\\d?frac\{([-\u2212]?\d+(?:\.\d*)?)\}\{([-\u2212]?\d+(?:\.\d*)?)\}$")
_IN_TEXT = re.compile(r"(?<![\w.])[-\u2212]?\d+(?:\.\d+)?(?: \u00b7 10\^[-\u2212]?\d+)?")
"""A number in plain text; large and small ones have a power of ten."""
_SYMBOL = re.compile(r"[-\u2212]?\d+(?:\.\d+)?|[^\W\d]\w*(?:_\w+)?")
_FUNCTIONS = ("min", "max", "round", "float32")
"""Words of a formula that stand for no number."""

MARGIN = 8
"""Room around a formula, in logical pixels."""
SPACE = r"\quad"
"""What stands between two equations of one row."""
OPERATOR_ROOM = 0.28
"""Room on both sides of an operator, as a share of the size."""
WHOLE = 0
"""Stands for each width in which nothing of a formula is wrapped or shrunk."""
LONG_CELL = 50
"""Signs of a cell that is cut at its products, so that these can go on in the next line."""
KEPT_LAYOUTS = 256
"""Formulas that are kept laid out, at their widths: one is asked for many times a step, and comes again."""


@dataclass(frozen=True, eq=False)
class Piece:
    """A cell placed on a line, relative to the line's left end and baseline."""

    latex: str
    """What it shows."""
    color: str
    """``#rrggbb`` of what has no colour of its own."""
    left: float
    width: float
    symbol: str = ""
    """What stands above or below it in the other row: the symbols of its numbers."""


@dataclass(frozen=True)
class FormulaNumber:
    """A number of a formula."""

    symbol: str
    """Plain text of the symbol that it stands for, as ``λ0``; empty: it has none."""
    text: str
    """The number as it is written in plain text."""

    @property
    def name(self) -> str:
        """What it is called in a sentence."""
        return self.symbol.replace("_", "") or self.text


@dataclass(frozen=True, eq=False)
class Line:
    """Pieces on one baseline."""

    pieces: tuple[Piece, ...]
    ascent: float
    descent: float
    gap: float
    """Room above the line."""


@dataclass(frozen=True, eq=False)
class _Columns:
    """Cells of one or two rows that stand under each other, with the room that each column takes."""

    rows: list[list[tuple[str, str]]]
    boxes: list[list[QRectF]]
    widths: list[float]
    pads: list[float]

    def extent(self, start: int, stop: int) -> float:
        """Return the width of the columns from ``start`` to ``stop``, which is excluded."""
        return sum(self.widths[start:stop]) + 2 * sum(self.pads[start:stop])


class FormulaSetter:
    """Cuts, lays out and draws formulas at one size; what is not typeset yet is laid out as plain text."""

    def __init__(self, typesetter: Typesetter, text_font: QFont, size: float) -> None:
        self._typesetter = typesetter
        self._text_font = text_font
        self._size = size
        self._number_font = QFont(_mathematics_family())
        self._number_font.setPixelSize(round(size))
        self._number_metrics = QFontMetricsF(self._number_font)
        self._text_metrics = QFontMetricsF(text_font)
        self._layouts: OrderedDict[tuple[Formula, int, Theme], tuple[Line, ...]] = OrderedDict()
        """Of formulas all of whose cells were typeset, the last used at the end."""
        self._unfinished: dict[tuple[Formula, int, Theme], tuple[Line, ...]] = {}
        """Of others, as long as no cell is typeset."""
        self._unfinished_at = 0

    def cells_needed(self, formula: Formula | None) -> list[tuple[str, str]]:
        """Return what the typesetter must set: LaTeX with colours, and the colour of the rest."""
        return [cell for row in cell_rows(formula) for cell in row if cell[0] and not _is_quick(cell[0])]

    def is_ready(self, cell: tuple[str, str]) -> bool:
        """Return whether a cell is typeset already."""
        return self._typesetter.cached(*cell, self._size) is not None

    def typeset(self, cell: tuple[str, str]) -> None:
        """Typeset one cell."""
        self._typesetter.typeset(*cell, self._size)

    def problems(self, formula: Formula | None) -> list[str]:
        """Return why cells could not be typeset, each reason once."""
        cells = [self._typesetter.cached(*cell, self._size) for cell in self.cells_needed(formula)]
        return list(dict.fromkeys(cell.problem for cell in cells if cell is not None and cell.problem))

    def layout(self, formula: Formula | None, width: int) -> tuple[Line, ...]:
        """Break a formula into lines for a view of `width` logical pixels."""
        if formula is None:
            return ()
        key = formula, width, current_theme()
        whole = formula, WHOLE, current_theme()
        if whole in self._layouts and self._room(self._layouts[whole]) <= width:
            key = whole
        if key in self._layouts:
            self._layouts.move_to_end(key)
            return self._layouts[key]
        if self._unfinished_at != self._typesetter.made or len(self._unfinished) > KEPT_LAYOUTS:
            self._unfinished_at, self._unfinished = self._typesetter.made, {}
        if key in self._unfinished:
            return self._unfinished[key]
        lines = self._layout(formula, width)
        if all(map(self.is_ready, self.cells_needed(formula))):
            is_whole = len(lines) == len(cell_rows(formula)) and self._room(lines) <= width
            self._layouts[whole if is_whole else key] = lines
            if len(self._layouts) > KEPT_LAYOUTS:
                self._layouts.popitem(last=False)
        else:
            self._unfinished[key] = lines
        return lines

    def _room(self, lines: tuple[Line, ...]) -> float:
        """Return a width that is enough for lines, with what stands beside a last operator."""
        return extent(lines)[0] + 2 * OPERATOR_ROOM * self._size + 2 * MARGIN

    def _layout(self, formula: Formula, width: int) -> tuple[Line, ...]:
        rows = cell_rows(formula)
        if not rows:
            return ()
        if len(rows) == 2 and len(rows[0]) == len(rows[1]):
            return self._layout_together(rows, width)
        return tuple(line for row in rows for line in self._layout_together([row], width))

    def _layout_together(self, rows: list[list[tuple[str, str]]], width: int) -> tuple[Line, ...]:
        """Break the columns of one or two aligned rows into lines no wider than `width`.

        A row of several equations, with `SPACE` between them, is broken between two of them if it can be.
        """
        room = self._size * OPERATOR_ROOM
        boxes = [[self._box(latex, color) for latex, color in row] for row in rows]
        widths = [max(box.width() for box in column) for column in zip(*boxes, strict=True)]
        pads = [room if is_operator(rows[0][k][0]) else 0.0 for k in range(len(widths))]
        columns = _Columns(rows, boxes, widths, pads)
        limit, shrink = width - 2.0 * MARGIN, current_theme().formula_shrink
        if limit < columns.extent(0, len(widths)) <= limit / shrink:
            limit /= shrink
        lines: list[Line] = []
        for start, stop in _equations(columns, limit):
            lines += self._wrap(columns, start, stop, limit, is_first=not lines)
        return tuple(lines)

    def _wrap(self, columns: "_Columns", first: int, end: int, limit: float, *, is_first: bool) -> list[Line]:
        """Break the columns ``first`` to ``end`` (excluded) where a line may begin; lines but the first move in."""
        cells = [latex for latex, _ in columns.rows[0]]
        lines: list[Line] = []
        start = first
        while start < end:
            stop, total = start, 0.0
            while stop < end:
                after = next((k for k in range(stop + 1, end) if may_begin_line(cells, k)), end)
                if columns.extent(stop, after) > limit:
                    # Else it would shrink: a product goes on in the next line.
                    after = next((k for k in range(stop + 1, after) if is_product(cells[k])), after)
                step = columns.extent(stop, after)
                if stop > start and total + step > limit:
                    break
                total += step
                stop = after
            parts = [[latex for latex, _ in row[start:stop]] for row in columns.rows]
            for index, (row, boxes) in enumerate(zip(columns.rows, columns.boxes, strict=True)):
                if index and start > first and parts[0] == parts[1]:
                    continue  # The same words once more, as "covered" under "covered".
                left = 0.0 if start == first else self._size
                pieces = []
                for k in range(start, stop):
                    slack = (columns.widths[k] - boxes[k].width()) / 2
                    other = columns.rows[0][k][0] if index else ""
                    pieces.append(Piece(*row[k], left + columns.pads[k] + slack, boxes[k].width(), other))
                    left += columns.widths[k] + 2 * columns.pads[k]
                ascent = max(-boxes[k].top() for k in range(start, stop))
                descent = max(boxes[k].bottom() for k in range(start, stop))
                gap = 0.0 if is_first and not lines else self._size * (0.32 if index else 0.7)
                lines.append(Line(tuple(pieces), ascent, descent, gap))
            start = stop
        return lines

    def _box(self, latex: str, color: str) -> QRectF:
        size = self._size
        if _is_quick(latex):
            fraction = _FRACTION.match(latex)
            widths = [
                self._number_metrics.horizontalAdvance(_minus(text))
                for text in (fraction.groups() if fraction else [latex])
            ]
            if fraction:
                return QRectF(0.0, -1.32 * size, max(widths) + 0.2 * size, 2.0 * size)
            return QRectF(0.0, -0.7 * size, widths[0], 0.72 * size)
        cell = self._typesetter.cached(latex, color, size)
        if cell is not None and cell.renderer is not None:
            return cell.box
        metrics = self._text_metrics
        width = metrics.horizontalAdvance(plain_text(latex)) + 2.0
        return QRectF(0.0, -metrics.ascent(), width, metrics.height())

    def paint(self, painter: QPainter, lines: tuple[Line, ...]) -> None:
        """Draw lines from the painter's origin downwards."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        baseline = 1.0
        for line in lines:
            baseline += line.gap + line.ascent
            for piece in line.pieces:
                self._paint_piece(painter, piece, baseline)
            baseline += line.descent

    def _paint_piece(self, painter: QPainter, piece: Piece, baseline: float) -> None:
        if _is_quick(piece.latex):
            self._paint_quickly(painter, piece, baseline)
            return
        cell = self._typesetter.cached(piece.latex, piece.color, self._size)
        if cell is None or cell.renderer is None:
            painter.setFont(self._text_font)
            painter.setPen(QColor(piece.color))
            painter.drawText(QPointF(piece.left, baseline), plain_text(piece.latex))
            return
        cell.renderer.render(painter, cell.box.translated(piece.left - cell.box.left(), baseline))

    def _paint_quickly(self, painter: QPainter, piece: Piece, baseline: float) -> None:
        painter.setFont(self._number_font)
        painter.setPen(QColor(piece.color))
        fraction = _FRACTION.match(piece.latex)
        if fraction is None:
            painter.drawText(QPointF(piece.left, baseline), _minus(piece.latex))
            return
        size = self._size
        metrics = self._number_metrics
        middle = piece.left + piece.width / 2
        for text, shift in zip(fraction.groups(), (-0.64, 0.64), strict=True):
            left = middle - metrics.horizontalAdvance(_minus(text)) / 2
            painter.drawText(QPointF(left, baseline + shift * size), _minus(text))
        rule = QRectF(piece.left, baseline - 0.29 * size, piece.width, max(1.0, 0.068 * size))
        painter.fillRect(rule, QColor(piece.color))


def _equations(columns: _Columns, limit: float) -> list[tuple[int, int]]:
    """Return first and end column of the parts that begin lines of their own: as many equations as fit on one.

    The space before an equation that begins a line is left out.
    """
    cells = [latex for latex, _ in columns.rows[0]]
    spaces = [k for k, cell in enumerate(cells) if cell == SPACE]
    parts = []
    start = 0
    for number, space in enumerate(spaces):
        following = spaces[number + 1] if number + 1 < len(spaces) else len(cells)
        if space > start and columns.extent(start, following) > limit:
            parts.append((start, space))
            start = space + 1
    return [*parts, (start, len(cells))]


def number_at(lines: tuple[Line, ...], x: float, y: float) -> FormulaNumber | None:
    """Return the number at a place relative to the lines' origin; ``None``: there is a symbol, or nothing.

    Of several numbers in one cell it is the one that lies nearest: over each other in a fraction, else side by side.
    """
    top = 1.0
    for line in lines:
        top += line.gap
        if top <= y <= top + line.ascent + line.descent:
            for piece in line.pieces:
                if piece.symbol and piece.left <= x <= piece.left + piece.width:
                    across = (x - piece.left) / max(piece.width, 1.0)
                    return _number_in(piece, across, (y - top) / (line.ascent + line.descent))
        top += line.ascent + line.descent
    return None


def _number_in(piece: Piece, across: float, down: float) -> FormulaNumber | None:
    """Return the number of a cell that lies nearest to shares of its width and height."""
    numbers = list(_IN_TEXT.finditer(plain_text(piece.latex)))
    if not numbers:
        return None
    is_fraction = len(numbers) == 2 and "frac{" in piece.latex
    length = len(plain_text(piece.latex))
    places = [
        (k + 0.5) / len(numbers) - down if is_fraction else found.start() / length - across
        for k, found in enumerate(numbers)
    ]
    k = min(range(len(numbers)), key=lambda k: abs(places[k]))
    symbols = [part for part in _SYMBOL.findall(plain_text(piece.symbol)) if part not in _FUNCTIONS]
    return FormulaNumber(symbols[k] if k < len(symbols) == len(numbers) else "", numbers[k][0])


@lru_cache(KEPT_LAYOUTS)
def extent(lines: tuple[Line, ...]) -> tuple[float, float]:
    """Return width and height of lines in logical pixels."""
    width = max((piece.left + piece.width for line in lines for piece in line.pieces), default=1.0)
    return width + 4.0, sum(line.gap + line.ascent + line.descent for line in lines) + 4.0


def cell_rows(formula: Formula | None) -> list[list[tuple[str, str]]]:
    """Return one or two rows of cells: LaTeX with colours, and the colour of the rest."""
    return [] if formula is None else _themed_rows(formula, current_theme())


@lru_cache(KEPT_LAYOUTS)
def _themed_rows(formula: Formula, theme: Theme) -> list[list[tuple[str, str]]]:
    vertex_colors = theme.vertex_text
    symbols, numbers = _aligned_cells(formula)
    rows = [[(color_vertices(cell, vertex_colors), theme.text) for cell in symbols]]
    if numbers:
        row = []
        for index, cell in enumerate(numbers):
            owner = vertex_of(symbols[index]) if len(symbols) == len(numbers) else None
            color = theme.text if owner is None else vertex_colors[owner]
            row.append((color_vertices(cell, vertex_colors), color))
        rows.append(row)
    return rows


def _aligned_cells(formula: Formula) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Cut both lines finely if the cells then pair up, else coarsely."""
    for splits_products in (True, False):
        symbols = split_cells(formula.symbolic, splits_products=splits_products)
        numbers = split_cells(formula.substituted, splits_products=splits_products)
        if len(symbols) == len(numbers):
            break
    if len(symbols) == len(numbers):
        parts = [_aligned_parts(*cells) for cells in zip(symbols, numbers, strict=True)]
        symbols, numbers = (tuple(chain(*(part[row] for part in parts))) for row in range(2))
    return symbols, numbers


def _aligned_parts(symbols: str, numbers: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Cut a long cell around its multiplication signs, in both lines the same."""
    if max(len(plain_text(symbols)), len(plain_text(numbers))) > LONG_CELL:
        parts = split_products(symbols), split_products(numbers)
        if len(parts[0]) == len(parts[1]):
            return parts
    return (symbols,), (numbers,)


@lru_cache(4096)
def _is_quick(latex: str) -> bool:
    """Return whether a cell is a number or a fraction of two: these change at every step and are drawn here."""
    return bool(_NUMBER.match(latex) or _FRACTION.match(latex))


def _minus(text: str) -> str:
    return text.replace("-", "\u2212")


_FAMILY: list[str] = []


def _mathematics_family() -> str:
    """Return the family of the typesetter's own font, loaded once, so that numbers match symbols."""
    if not _FAMILY:
        number = QFontDatabase.addApplicationFont(str(typesetter_font()))
        families = QFontDatabase.applicationFontFamilies(number)
        _FAMILY.append(families[0] if families else QGuiApplication.font().family())
    return _FAMILY[0]
