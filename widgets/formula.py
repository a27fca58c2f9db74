"""A typeset formula with the present numbers under its symbols."""

import importlib.resources
import re
import time
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, QTimer, Signal, Slot
from PySide6.QtGui import (
    QAction,
    QColor,
    QFont,
    QFontDatabase,
    QFontMetricsF,
    QGuiApplication,
    QImage,
    QKeySequence,
    QPainter,
    QPaintEvent,
    QResizeEvent,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from widgets.latex import (
    Typesetter,
    color_vertices,
    is_operator,
    may_begin_line,
    plain_text,
    split_cells,
    vertex_of,
    without_macros,
)
from widgets.theme import current_theme, theme_notifier

_NUMBER = re.compile(r"^\(?[-\u2212]?\d+(?:\.\d*)?\)?$")
_FRACTION = re.compile(r"^\\d?frac\{([-\u2212]?\d+(?:\.\d*)?)\}\{([-\u2212]?\d+(?:\.\d*)?)\}$")
_SHARED = Typesetter()

MARGIN = 8
"""Room around a formula, in logical pixels."""


@dataclass(frozen=True)
class Formula:
    """Two lines of LaTeX; with equal cell counts (see `widgets.latex`) numbers stand under their symbols."""

    symbolic: str
    r"""The law in symbols, as ``E_0 = a_0 x + b_0 y + c_0``; ``\vertex{k}{...}`` colours other symbols."""
    substituted: str = ""
    """The same with the numbers of this step put in; may be empty."""


@dataclass(frozen=True, eq=False)
class _Piece:
    """A cell placed on a line, relative to the line's left end and baseline."""

    latex: str
    """What it shows."""
    color: str
    """``#rrggbb`` of what has no colour of its own."""
    left: float
    width: float


@dataclass(frozen=True, eq=False)
class _Line:
    """Pieces on one baseline."""

    pieces: tuple[_Piece, ...]
    ascent: float
    descent: float
    gap: float
    """Room above the line."""


class FormulaView(QWidget):
    """Shows a `Formula`; wraps at relations, shrinks what still does not fit, never holds up a step."""

    formula_copied = Signal(str)
    """The user has copied the formula; the argument says as what (``latex`` or ``png``)."""

    POINT_SIZE_FACTOR = 1.32
    """Size of a formula relative to the widget's text."""
    BUDGET_SECONDS = 0.004
    """Typesetting that one `show_formula` may do at once; the rest follows when the event loop is free."""

    def __init__(self, parent: QWidget | None = None, typesetter: Typesetter | None = None) -> None:
        super().__init__(parent)
        self._typesetter = typesetter or _SHARED
        self._formula: Formula | None = None
        self._problems: tuple[str, ...] = ()
        self._lines: tuple[_Line, ...] = ()
        self._catch_up_timer = QTimer(self)
        self._catch_up_timer.setSingleShot(True)
        self._catch_up_timer.timeout.connect(self._catch_up)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName("Formula")
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        policy = QSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)
        self._add_action("Copy as LaTeX", QKeySequence(QKeySequence.StandardKey.Copy)).triggered.connect(
            self.copy_latex
        )
        self._add_action("Copy as picture", QKeySequence("Ctrl+Shift+C")).triggered.connect(self.copy_picture)
        theme_notifier().theme_changed.connect(self._rebuild)
        self._rebuild()

    @Slot(object)
    def show_formula(self, formula: Formula | None) -> None:
        """Show a formula, or the hint for an empty pane."""
        if formula == self._formula:
            return
        self._formula = formula
        self._rebuild()

    def is_complete(self) -> bool:
        """Whether everything shown is typeset (nothing waits for the event loop)."""
        return not self._catch_up_timer.isActive()

    def to_image(self, scale: float = 4.0) -> QImage:
        """Return the formula alone on a clear ground, `scale` device pixels to a logical pixel."""
        width, height = self._extent()
        image = QImage(
            max(1, round(width * scale)),
            max(1, round(height * scale)),
            QImage.Format.Format_ARGB32_Premultiplied,
        )
        image.fill(Qt.GlobalColor.transparent)
        painter = QPainter(image)
        painter.scale(scale, scale)
        self._paint_lines(painter)
        painter.end()
        return image

    @Slot()
    def copy_latex(self) -> None:
        """Put both lines on the clipboard as standard LaTeX."""
        if self._formula is not None:
            lines = [without_macros(self._formula.symbolic), without_macros(self._formula.substituted)]
            QGuiApplication.clipboard().setText(" \\\\\n".join(line for line in lines if line))
            self.formula_copied.emit("latex")

    @Slot()
    def copy_picture(self) -> None:
        """Put the formula on the clipboard as a picture."""
        if self._formula is not None:
            QGuiApplication.clipboard().setImage(self.to_image())
            self.formula_copied.emit("png")

    def hasHeightForWidth(self) -> bool:
        """Tell the layout that a narrow view needs more lines."""
        return True

    def heightForWidth(self, width: int) -> int:
        """Height that shows every line without shrinking."""
        return (
            round(sum(line.gap + line.ascent + line.descent for line in self._layout(width))) + 2 * MARGIN + 4
        )

    def sizeHint(self) -> QSize:
        """Room for the lines at the present width."""
        width = self.width() if self.width() > 50 else 320
        return QSize(width, self.heightForWidth(width))

    def minimumSizeHint(self) -> QSize:
        """Two lines of text."""
        return QSize(120, round(self.fontMetrics().height() * 2.5))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Wrap anew."""
        super().resizeEvent(event)
        self._lines = self._layout(self.width())

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the lines, or what the pane is for."""
        del event
        painter = QPainter(self)
        if self._formula is None:
            painter.setPen(QColor(current_theme().muted_text))
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(
                self.rect().adjusted(8, 0, -8, 0), flags, "The formula of each step appears here."
            )
            return
        width, height = self._extent()
        room = (self.width() - 2 * MARGIN, self.height() - 2 * MARGIN)
        scale = min(1.0, room[0] / width, room[1] / height)
        painter.translate(MARGIN, MARGIN)
        painter.scale(scale, scale)
        self._paint_lines(painter)
        if self.hasFocus():
            painter.resetTransform()
            painter.setPen(QColor(current_theme().focus))
            painter.drawRect(self.rect().adjusted(0, 0, -1, -1))

    def _add_action(self, text: str, shortcut: QKeySequence) -> QAction:
        action = QAction(text, self)
        action.setShortcut(shortcut)
        action.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
        self.addAction(action)
        return action

    def _size(self) -> float:
        return round(self.fontInfo().pixelSize() * self.POINT_SIZE_FACTOR, 1)

    def _number_font(self) -> QFont:
        font = QFont(_mathematics_family())
        font.setPixelSize(round(self._size()))
        return font

    @Slot()
    def _rebuild(self) -> None:
        self._typeset_within(self.BUDGET_SECONDS)
        self._refresh()

    @Slot()
    def _catch_up(self) -> None:
        self._typeset_within(self.BUDGET_SECONDS)
        self._refresh()

    def _refresh(self) -> None:
        self._lines = self._layout(self.width())
        self._describe()
        self.updateGeometry()
        self.update()

    def _typeset_within(self, seconds: float) -> None:
        # Typeset at least one cell a turn, so that a slow machine gets there too.
        start = time.perf_counter()
        size = self._size()
        for latex, color in self._cells_needed():
            if self._typesetter.cached(latex, color, size) is None:
                self._typesetter.typeset(latex, color, size)
                if time.perf_counter() - start > seconds:
                    break
        if any(self._typesetter.cached(latex, color, size) is None for latex, color in self._cells_needed()):
            self._catch_up_timer.start(0)
        else:
            self._catch_up_timer.stop()

    def _cells_needed(self) -> list[tuple[str, str]]:
        return [
            (latex, color) for row in self._rows() for latex, color in row if latex and not _is_quick(latex)
        ]

    def _rows(self) -> list[list[tuple[str, str]]]:
        """One or two rows of (LaTeX with colours, colour of the rest)."""
        if self._formula is None:
            return []
        theme = current_theme()
        vertex_colors = theme.vertex_text
        symbols, numbers = _aligned_cells(self._formula)
        rows = [[(color_vertices(cell, vertex_colors), theme.text) for cell in symbols]]
        if numbers:
            row = []
            for index, cell in enumerate(numbers):
                owner = vertex_of(symbols[index]) if len(symbols) == len(numbers) else None
                color = theme.text if owner is None else vertex_colors[owner]
                row.append((color_vertices(cell, vertex_colors), color))
            rows.append(row)
        return rows

    def _layout(self, width: int) -> tuple[_Line, ...]:
        rows = self._rows()
        if not rows:
            return ()
        if len(rows) == 2 and len(rows[0]) == len(rows[1]):
            return self._layout_together(rows, width)
        return tuple(line for row in rows for line in self._layout_together([row], width))

    def _layout_together(self, rows: list[list[tuple[str, str]]], width: int) -> tuple[_Line, ...]:
        """Break the columns of one or two aligned rows into lines no wider than `width`."""
        room = self._size() * 0.28
        cells = [latex for latex, _ in rows[0]]
        boxes = [[self._box(latex, color) for latex, color in row] for row in rows]
        widths = [max(box.width() for box in column) for column in zip(*boxes, strict=True)]
        pads = [room if is_operator(rows[0][k][0]) else 0.0 for k in range(len(widths))]
        lines: list[_Line] = []
        start = 0
        while start < len(widths):
            stop, total = start, 0.0
            while stop < len(widths):
                after = next(
                    (k for k in range(stop + 1, len(widths)) if may_begin_line(cells, k)), len(widths)
                )
                step = sum(widths[stop:after]) + 2 * sum(pads[stop:after])
                if stop > start and total + step > width - 2 * MARGIN:
                    break
                total += step
                stop = after
            for index, row in enumerate(rows):
                left = 0.0 if start == 0 else self._size()
                pieces = []
                for k in range(start, stop):
                    slack = (widths[k] - boxes[index][k].width()) / 2
                    pieces.append(_Piece(*row[k], left + pads[k] + slack, boxes[index][k].width()))
                    left += widths[k] + 2 * pads[k]
                ascent = max(-boxes[index][k].top() for k in range(start, stop))
                descent = max(boxes[index][k].bottom() for k in range(start, stop))
                gap = 0.0 if not lines else self._size() * (0.32 if index else 0.7)
                lines.append(_Line(tuple(pieces), ascent, descent, gap))
            start = stop
        return tuple(lines)

    def _box(self, latex: str, color: str) -> QRectF:
        size = self._size()
        if _is_quick(latex):
            fraction = _FRACTION.match(latex)
            metrics = QFontMetricsF(self._number_font())
            widths = [
                metrics.horizontalAdvance(_minus(text))
                for text in (fraction.groups() if fraction else [latex])
            ]
            if fraction:
                return QRectF(0.0, -1.32 * size, max(widths) + 0.2 * size, 2.0 * size)
            return QRectF(0.0, -0.7 * size, widths[0], 0.72 * size)
        cell = self._typesetter.cached(latex, color, size)
        if cell is not None and cell.renderer is not None:
            return cell.box
        metrics = QFontMetricsF(self.font())
        width = metrics.horizontalAdvance(plain_text(latex)) + 2.0
        return QRectF(0.0, -metrics.ascent(), width, metrics.height())

    def _extent(self) -> tuple[float, float]:
        width = max((piece.left + piece.width for line in self._lines for piece in line.pieces), default=1.0)
        return width + 4.0, sum(line.gap + line.ascent + line.descent for line in self._lines) + 4.0

    def _paint_lines(self, painter: QPainter) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        baseline = 1.0
        for line in self._lines:
            baseline += line.gap + line.ascent
            for piece in line.pieces:
                self._paint_piece(painter, piece, baseline)
            baseline += line.descent

    def _paint_piece(self, painter: QPainter, piece: _Piece, baseline: float) -> None:
        painter.setPen(QColor(piece.color))
        if _is_quick(piece.latex):
            self._paint_quickly(painter, piece, baseline)
            return
        cell = self._typesetter.cached(piece.latex, piece.color, self._size())
        if cell is None or cell.renderer is None:
            painter.setFont(self.font())
            painter.drawText(QPointF(piece.left, baseline), plain_text(piece.latex))
            return
        cell.renderer.render(painter, cell.box.translated(piece.left - cell.box.left(), baseline))

    def _paint_quickly(self, painter: QPainter, piece: _Piece, baseline: float) -> None:
        painter.setFont(self._number_font())
        fraction = _FRACTION.match(piece.latex)
        if fraction is None:
            painter.drawText(QPointF(piece.left, baseline), _minus(piece.latex))
            return
        size = self._size()
        metrics = QFontMetricsF(self._number_font())
        middle = piece.left + piece.width / 2
        for text, shift in zip(fraction.groups(), (-0.64, 0.64), strict=True):
            left = middle - metrics.horizontalAdvance(_minus(text)) / 2
            painter.drawText(QPointF(left, baseline + shift * size), _minus(text))
        rule = QRectF(piece.left, baseline - 0.29 * size, piece.width, max(1.0, 0.068 * size))
        painter.fillRect(rule, QColor(piece.color))

    def _describe(self) -> None:
        if self._formula is None:
            self.setToolTip("")
            self.setAccessibleDescription("")
            return
        lines = [plain_text(line) for line in (self._formula.symbolic, self._formula.substituted) if line]
        size = self._size()
        cells = [self._typesetter.cached(latex, color, size) for latex, color in self._cells_needed()]
        problems = dict.fromkeys(cell.problem for cell in cells if cell is not None and cell.problem)
        notes = [f"Shown as plain text: {problem}" for problem in problems]
        self.setAccessibleDescription("; ".join(lines))
        self.setToolTip("\n".join(lines + notes))


def _aligned_cells(formula: Formula) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Cut both lines finely if the cells then pair up, else coarsely."""
    for splits_products in (True, False):
        symbols = split_cells(formula.symbolic, splits_products=splits_products)
        numbers = split_cells(formula.substituted, splits_products=splits_products)
        if len(symbols) == len(numbers):
            break
    return symbols, numbers


def _is_quick(latex: str) -> bool:
    """Tell whether a cell is a number or a fraction of two, which change at every step and need no typesetter."""
    return bool(_NUMBER.match(latex) or _FRACTION.match(latex))


def _minus(text: str) -> str:
    return text.replace("-", "\u2212")


_FAMILY: list[str] = []


def _mathematics_family() -> str:
    """Return the family of the typesetter's own font, loaded once, so that numbers match symbols."""
    if not _FAMILY:
        font = importlib.resources.files("ziamath") / "fonts" / "STIXTwoMath-Regular.ttf"
        number = QFontDatabase.addApplicationFontFromData(font.read_bytes())
        families = QFontDatabase.applicationFontFamilies(number)
        _FAMILY.append(families[0] if families else QGuiApplication.font().family())
    return _FAMILY[0]
