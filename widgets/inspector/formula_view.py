"""A typeset formula with the present numbers under its symbols."""

import math
import time

from PySide6.QtCore import QEvent, QPointF, QRect, QSize, Qt, QTimer, Signal, Slot
from PySide6.QtGui import (
    QAccessible,
    QAction,
    QColor,
    QGuiApplication,
    QHelpEvent,
    QImage,
    QKeySequence,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
)
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from core.explain.latex import plain_text, spoken, without_macros
from core.explain.records import Formula
from widgets.basics.accessibility import FocusRing
from widgets.basics.theme import current_theme, theme_notifier
from widgets.inspector.formula_layout import MARGIN, FormulaNumber, FormulaSetter, Line, extent, number_at
from widgets.inspector.typesetter import Typesetter, is_typesetter_loaded, load_typesetter

_SHARED = Typesetter()


class FormulaView(QWidget):
    """Shows a `Formula`; wraps at relations, shrinks what still does not fit, never holds up a step."""

    spoken_role = QAccessible.Role.Equation

    number_pointed = Signal(object)
    """The pointer is on another `FormulaNumber`: `show_where` says where it comes from."""
    number_clicked = Signal(object)
    """The user asks where a `FormulaNumber` comes from."""
    typeset = Signal()
    """Everything shown is typeset, which may be higher or lower than what stood there for it."""

    BUDGET_SECONDS = 0.004
    """Typesetting that one `show_formula` may do at once; the rest follows when the event loop is free."""
    TURN_SECONDS = 0.008
    """Typesetting at a time that follows later."""
    LOADING_SECONDS = 0.02
    """Time between two looks whether the typesetter is loaded."""
    WIDTH_SHARES = (1.2, 1.5, 2.0)
    """Widths, as shares of the view's, for which lines are broken too where they would shrink at its own."""
    HURRY_SECONDS = 0.05
    """Formulas that follow each other faster than this (scrubbing, playing) are typeset only now and then."""

    def __init__(self, parent: QWidget | None = None, typesetter: Typesetter | None = None) -> None:
        super().__init__(parent)
        self._typesetter = typesetter or _SHARED
        self._formula: Formula | None = None
        self._hint = "The formula of each step appears here."
        self._shown_at = -math.inf
        self._kept_lines: tuple[Line, ...] | None = None
        self._heights: dict[int, int] = {}
        """By width; one step has the layouts ask for the same one several times."""
        self._kept_setter: tuple[str, float, FormulaSetter] | None = None
        self._catch_up_timer = QTimer(self, singleShot=True)
        self._catch_up_timer.timeout.connect(self._catch_up)
        self._pointed: FormulaNumber | None = None
        self._where = ""
        self.setMouseTracking(True)
        self._ring = FocusRing(self)
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

    def formula(self) -> Formula | None:
        """Return the formula that is shown."""
        return self._formula

    @Slot(object)
    def show_formula(self, formula: Formula | None) -> None:
        """Show a formula, or the hint for an empty pane."""
        if formula == self._formula:
            return
        self._formula = formula
        self._pointed = None
        self.show_where("")
        self._rebuild()
        self._shown_at = time.perf_counter()

    def show_where(self, text: str) -> None:
        """Say where the number under the pointer comes from, as a tooltip; empty: from nowhere."""
        if text == self._where:
            return
        self._where = text
        self.setCursor(Qt.CursorShape.PointingHandCursor if text else Qt.CursorShape.ArrowCursor)

    def number_under(self, position: QPointF) -> FormulaNumber | None:
        """Return the number at a place of the view."""
        scale = self._scale(self._lines)
        return number_at(self._lines, (position.x() - MARGIN) / scale, (position.y() - MARGIN) / scale)

    def can_prepare(self) -> bool:
        """Return whether the typesetter is loaded."""
        return is_typesetter_loaded()

    def prepare(self, formula: Formula | None) -> bool:
        """Typeset one cell of a formula that may be shown soon; return whether all were typeset already.

        The first call loads the typesetter off the GUI thread; until it `can_prepare`, nothing is typeset.
        """
        load_typesetter()
        if not self.can_prepare():
            return False
        setter = self._setter()
        cell = next((cell for cell in setter.cells_needed(formula) if not setter.is_ready(cell)), None)
        if cell is not None:
            setter.typeset(cell)
        return cell is None

    @Slot(str)
    def show_hint(self, text: str) -> None:
        """Say this where there is no formula."""
        if text != self._hint:
            self._hint = text
            self._refresh()

    def is_complete(self) -> bool:
        """Whether everything shown is typeset (nothing waits for the event loop)."""
        return not self._catch_up_timer.isActive()

    def spoken(self) -> str:
        """Return the formula in words; empty: there is none."""
        return "" if self._formula is None else spoken(self._formula)

    def spoken_description(self) -> str:
        """Return what a screen reader says of the pane."""
        return self.spoken() or self._hint

    def to_image(self, scale: float = 4.0) -> QImage:
        """Return the formula alone on a clear ground, `scale` device pixels to a logical pixel."""
        width, height = extent(self._lines)
        image = QImage(
            max(1, round(width * scale)),
            max(1, round(height * scale)),
            QImage.Format.Format_ARGB32_Premultiplied,
        )
        image.fill(Qt.GlobalColor.transparent)
        painter = QPainter(image)
        painter.scale(scale, scale)
        self._setter().paint(painter, self._lines)
        painter.end()
        return image

    @Slot()
    def copy_latex(self) -> None:
        """Put both lines on the clipboard as standard LaTeX."""
        if self._formula is not None:
            lines = [without_macros(self._formula.symbolic), without_macros(self._formula.substituted)]
            QGuiApplication.clipboard().setText(" \\\\\n".join(line for line in lines if line))

    @Slot()
    def copy_picture(self) -> None:
        """Put the formula on the clipboard as a picture."""
        if self._formula is not None:
            QGuiApplication.clipboard().setImage(self.to_image())

    def hasHeightForWidth(self) -> bool:
        """Tell the layout that a narrow view needs more lines."""
        return True

    def heightForWidth(self, width: int) -> int:
        """Height that shows every line, or the hint, without shrinking."""
        if width not in self._heights:
            self._heights[width] = self._height_in(width)
        return self._heights[width]

    def _height_in(self, width: int) -> int:
        if self._formula is None:
            room = QRect(0, 0, max(width - 2 * MARGIN, 1), 10_000)
            return (
                self.fontMetrics().boundingRect(room, Qt.TextFlag.TextWordWrap, self._hint).height()
                + 2 * MARGIN
            )
        _, height = extent(self._setter().layout(self._formula, width))
        return round(height) + 2 * MARGIN

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
        self._kept_lines = None

    def changeEvent(self, event: QEvent) -> None:
        """Set anew in another type."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._refresh()

    @property
    def _lines(self) -> tuple[Line, ...]:
        """What is painted and pointed at: laid out only then, for the view takes its height a moment after a step."""
        if self._kept_lines is None:
            self._kept_lines = self._best_lines()
        return self._kept_lines

    def _best_lines(self) -> tuple[Line, ...]:
        """Return the lines that can be read largest: where there is little height, fewer of them, a little smaller."""
        setter = self._setter()
        lines = setter.layout(self._formula, self.width())
        width, height = extent(lines)
        if width <= self.width() - 2 * MARGIN and round(height) <= self.height() - 2 * MARGIN:
            return lines
        others = [setter.layout(self._formula, round(share * self.width())) for share in self.WIDTH_SHARES]
        return max((lines, *others), key=self._scale)

    def _scale(self, lines: tuple[Line, ...]) -> float:
        """Return by how much lines shrink to fit into the view, 1 at most."""
        width, height = extent(lines)
        return min(1.0, (self.width() - 2 * MARGIN) / width, (self.height() - 2 * MARGIN) / height)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the lines, or what the pane is for."""
        del event
        painter = QPainter(self)
        self._ring.paint(painter, self.rect())
        if self._formula is None:
            painter.setPen(QColor(current_theme().muted_text))
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(self.rect().adjusted(8, 0, -8, 0), flags, self._hint)
            return
        scale = self._scale(self._lines)
        painter.translate(MARGIN, MARGIN)
        painter.scale(scale, scale)
        self._setter().paint(painter, self._lines)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Point at a number."""
        number = self.number_under(event.position())
        if number != self._pointed:
            self._pointed = number
            self.show_where("")
            if number is not None:
                self.number_pointed.emit(number)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take the press of a click."""
        event.accept()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Ask where the number under the pointer comes from."""
        number = self.number_under(event.position())
        if number is not None and event.button() == Qt.MouseButton.LeftButton:
            self._pointed = None
            self.number_clicked.emit(number)

    def event(self, event: QEvent) -> bool:
        """Say where the number under the pointer comes from, or else the formula as text."""
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            QToolTip.showText(event.globalPos(), self._where or self.tip(), self)
            return True
        return super().event(event)

    def _add_action(self, text: str, shortcut: QKeySequence) -> QAction:
        action = QAction(text, self, shortcut=shortcut, shortcutContext=Qt.ShortcutContext.WidgetShortcut)
        self.addAction(action)
        return action

    def _size(self) -> float:
        return round(self.fontInfo().pixelSize() * current_theme().formula_scale, 1)

    def _setter(self) -> FormulaSetter:
        font, size = self.font(), self._size()
        if self._kept_setter is None or self._kept_setter[:2] != (font.key(), size):
            self._kept_setter = font.key(), size, FormulaSetter(self._typesetter, font, size)
        return self._kept_setter[2]

    @Slot()
    def _rebuild(self) -> None:
        self._typeset_within(self.BUDGET_SECONDS)
        self._refresh()

    @Slot()
    def _catch_up(self) -> None:
        """Typeset what is missing, a little at a time, and show it at the end: it is laid out and painted once."""
        if not is_typesetter_loaded():
            load_typesetter()
            self._catch_up_timer.start(round(1000 * self.LOADING_SECONDS))
            return
        self._typeset_within(self.TURN_SECONDS, is_catching_up=True)
        if self.is_complete():
            self._refresh()
            self.typeset.emit()

    def _refresh(self) -> None:
        self._kept_lines = None
        self._heights.clear()
        self.updateGeometry()
        self.update()

    def _typeset_within(self, seconds: float, *, is_catching_up: bool = False) -> None:
        # Typeset at least one cell a turn, so that a slow machine gets there too.
        start = time.perf_counter()
        is_hurried = start - self._shown_at < self.HURRY_SECONDS and not is_catching_up
        can_start = is_catching_up or (is_typesetter_loaded() and not is_hurried)
        setter = self._setter()
        missing = [cell for cell in setter.cells_needed(self._formula) if not setter.is_ready(cell)]
        while missing and can_start:
            setter.typeset(missing.pop(0))
            if time.perf_counter() - start > seconds:
                break
        if missing:
            if not self._catch_up_timer.isActive():
                self._catch_up_timer.start(round(1000 * self.HURRY_SECONDS) if is_hurried else 0)
        else:
            self._catch_up_timer.stop()

    def tip(self) -> str:
        """Return the formula as text, and why it is shown as such if it is."""
        if self._formula is None:
            return ""
        lines = [plain_text(line) for line in (self._formula.symbolic, self._formula.substituted) if line]
        notes = [f"Shown as plain text: {problem}" for problem in self._setter().problems(self._formula)]
        return "\n".join(lines + notes)
