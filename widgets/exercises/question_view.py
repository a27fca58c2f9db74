"""A question: its text, numbers and sketch, the form of its answer, hints, and what a check found."""

import re
from collections.abc import Sequence
from math import ceil

from PySide6.QtCore import QPointF, QRectF, QSize, QSizeF, Qt, Signal, Slot
from PySide6.QtGui import QColor, QFont, QFontDatabase, QFontMetricsF, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QFrame, QLabel, QPushButton, QScrollArea, QSizePolicy, QWidget

from core.records.cells import Form, Place, Sketch
from widgets.basics.accessibility import announce
from widgets.basics.controls import (
    FlowLayout,
    button_with_tip,
    column_layout,
    row_layout,
    set_role,
    text_label,
    unbroken,
)
from widgets.basics.drawing import LabelPlaces, Mark, mark_pixmap
from widgets.basics.theme import current_theme, faded, text_font, theme_notifier
from widgets.exercises.answer_forms import make_view
from widgets.exercises.mark_grid import AnswerView, MarkGrid
from widgets.exercises.records import Feedback, QuestionRecord

# A plane or space with whole numbers on its axes, and the points and outlines of a question in it.


CLOSEST = 22.0
"""Least pixels between two numbers of an axis, at a text size of 13."""
HEIGHT = 260
"""Pixels at a text size of 13."""
RADIUS = 4.0
STEPS = (1, 2, 5, 10, 20, 50)
AXES = {"x": QPointF(4, -6), "y": QPointF(6, 10), "z": QPointF(-14, 4)}
"""Names of the axes of space, and how far from its end each stands."""
DEPTH = 0.35
"""How far a unit of z runs to the left and down: the z axis at 45 degrees, at half its length."""


class SketchView(QWidget):
    """Shows a `Sketch`; squares are square, and space is drawn obliquely."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._sketch = Sketch()
        self._answer: Place | None = None
        self._name = ""
        self.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Fixed)
        theme_notifier().theme_changed.connect(self._follow_theme)

    def show_sketch(self, sketch: Sketch | None) -> None:
        """Show a sketch; ``None``: there is none."""
        self.setVisible(sketch is not None)
        self._sketch = sketch or Sketch()
        self.show_answer(None)

    def show_answer(self, place: Place | None, name: str = "") -> None:
        """Show the point that is an answer, with its name; ``None``: there is none."""
        self._answer, self._name = place, name
        self.setAccessibleName(f"Sketch: {self.shown.text}")
        self.updateGeometry()
        self.update()

    @property
    def shown(self) -> Sketch:
        """The sketch with the point of the answer."""
        return self._sketch if self._answer is None else self._sketch.with_point(self._name, self._answer)

    def sizeHint(self) -> QSize:
        """Return the size that the theme's text asks for."""
        height = HEIGHT * current_theme().text_px // 13
        return QSize(3 * height // 2, height)

    @Slot()
    def _follow_theme(self) -> None:
        self.updateGeometry()
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint lines at whole numbers, both axes with their numbers, outlines, and points with their names."""
        theme, sketch = current_theme(), self.shown
        pixels = min(self.width(), self.height()) / 2 / (sketch.reach + 1)
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(self.rect(), QColor(theme.panel))
        (self._paint_space if sketch.is_space else self._paint_axes)(painter, pixels)
        painter.setPen(QPen(QColor(theme.text), 2.0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for outline in sketch.outlines:
            painter.drawPolygon(QPolygonF([self._at(place, pixels) for place in outline]))
        painter.setFont(text_font(theme))
        names, metrics = LabelPlaces(QRectF(self.rect())), QFontMetricsF(painter.font())
        centers = [self._at(place, pixels) for _, place in sketch.points]
        painter.setBrush(QColor(theme.text))
        for center in centers:
            painter.drawEllipse(center, RADIUS, RADIUS)
            names.take(QRectF(center.x() - RADIUS, center.y() - RADIUS, 2 * RADIUS, 2 * RADIUS))
        for (name, _), center in zip(sketch.points, centers, strict=True):
            size = QSizeF(metrics.horizontalAdvance(name) + 4, metrics.height())
            box = names.find(center, size, RADIUS + 2)
            if box is not None:
                painter.fillRect(box, faded(theme.panel, 0.8))
                painter.drawText(box, Qt.AlignmentFlag.AlignCenter, name)
        painter.end()

    def _at(self, place: Sequence[float], pixels: float) -> QPointF:
        """Return where a place is on the widget: the origin in its middle, ``pixels`` to a unit."""
        x, y, z = (*place, 0.0)[:3]
        x, y = x - DEPTH * z, y - DEPTH * z
        return QPointF(self.width() / 2 + x * pixels, self.height() / 2 - y * pixels)

    def _paint_space(self, painter: QPainter, pixels: float) -> None:
        """Paint three axes with dots at whole numbers, and the way to each point: along x, then z, then y."""
        theme, last = current_theme(), ceil(self.shown.reach)
        painter.setFont(text_font(theme))
        for axis, (name, beside) in enumerate(AXES.items()):
            places = [
                self._at([number * (axis == k) for k in range(3)], pixels)
                for number in range(-last, last + 1)
            ]
            painter.setPen(QPen(QColor(theme.muted_text), 1.0))
            painter.drawLine(places[0], places[-1])
            painter.drawText(places[-1] + beside, name)
            painter.setPen(QPen(QColor(theme.muted_text), 3.0))
            painter.drawPoints(places)
        painter.setPen(QPen(QColor(theme.muted_text), 1.0, Qt.PenStyle.DashLine))
        for _, (x, y, z) in self.shown.points:
            way = (x, 0, 0), (x, 0, z), (x, y, z)
            painter.drawPolyline(QPolygonF([self._at(place, pixels) for place in way]))

    def _paint_axes(self, painter: QPainter, pixels: float) -> None:
        """Paint a line at every whole number, or at every fifth, tenth ..., and the number beside the axis."""
        theme = current_theme()
        painter.setFont(text_font(theme, theme.small_px))
        metrics = QFontMetricsF(painter.font())
        step = next((step for step in STEPS if step * pixels >= CLOSEST * theme.text_px / 13), STEPS[-1])
        for axis, length in enumerate((self.width(), self.height())):
            last = int(length / 2 / pixels) // step * step
            for number in range(-last, last + 1, step):
                place = self._at((number, 0) if axis == 0 else (0, number), pixels)
                color, width = (
                    (QColor(theme.muted_text), 1.5) if number == 0 else (faded(theme.grid_line, 0.4), 1.0)
                )
                painter.setPen(QPen(color, width))
                if axis == 0:
                    painter.drawLine(QPointF(place.x(), 0), QPointF(place.x(), self.height()))
                else:
                    painter.drawLine(QPointF(0, place.y()), QPointF(self.width(), place.y()))
                size = QSizeF(metrics.horizontalAdvance(str(number)), metrics.height())
                across = -size.width() / 2 if axis == 0 else -size.width() - 4
                box = QRectF(place + QPointF(across, 2 if axis == 0 else -size.height() / 2), size)
                if number and QRectF(self.rect()).contains(box):
                    painter.setPen(QColor(theme.muted_text))
                    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, str(number))


# A question: its text and numbers, the form of its answer, hints, what a check found, and what to do next.


_ART = re.compile(r"^[.#?A-Z]{4,}$", re.MULTILINE)
WIDEST = 720
"""Pixels of a line of text at a size of 13: longer ones are hard to read."""


class QuestionView(QWidget):
    """Shows a `QuestionRecord` with the form for its answer; what is to be done is asked for by signals."""

    check_requested = Signal()
    hint_requested = Signal()
    variant_requested = Signal()
    again_requested = Signal()
    twin_requested = Signal()
    model_requested = Signal()
    step_requested = Signal()
    copy_requested = Signal()
    list_requested = Signal()
    """The list of exercises is to be unfolded, or folded away."""

    def __init__(self, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._grid = grid
        self._feedback: Feedback | None = None
        self._has_art = False
        """Whether the numbers hold a picture as text, whose columns must line up."""
        self.answer: AnswerView | None = None
        self.setAccessibleName("Question")
        self.list_button = self._button("All exercises", "Unfold the list of exercises, or fold it away")
        self.list_button.setCheckable(True)
        self.list_button.hide()
        self.title = text_label("", self, role="title", wraps=True)
        self.mark = text_label(
            "", self, role="muted", wraps=True, is_selectable=True, name="Line that gives this question again"
        )
        self.copy_button = self._button(
            "Copy line", "Copy the line that gives this question to anybody", flat=True
        )
        self.text, self.given, self.credit = (
            text_label("", self, role=role, wraps=True, is_selectable=True)
            for role in ("", "strong", "muted")
        )
        self.sketch = SketchView(self)
        self.note = text_label("", self, role="muted", wraps=True)
        self.hints = text_label("", self, wraps=True, is_selectable=True, name="Hints")
        self.check_button = self._button("Check", "Check the answer (Return)")
        self.check_button.setProperty("role", "primary")
        self.hint_button = self._button("Hint", "Show the next hint (Ctrl+H)")
        self.variant_button = self._button("New variant", "Ask the same with other numbers (Ctrl+N)")
        self.again_button = self._button(
            "Start again", "The same question again, without your answer (Ctrl+R)"
        )
        self.twin_button = self._button(
            "Show that run", "Step the right run beside the one with this mistake (Ctrl+D)"
        )
        self.model_button = self._button(
            "Model answer",
            "Show the right answer; before a check this ends the variant without points (Ctrl+M)",
        )
        self.step_button = self._button(
            "Step it, hidden", "Step the scene on the Step page, which hides what comes next (Ctrl+G)"
        )
        self.lesson_button = self._button("Back to the lesson", "Go on in the lesson that is open")
        self.lesson_button.setObjectName("back to the lesson")
        self.lesson_button.hide()
        self._icon = QLabel(self)
        self.verdict = text_label("", self, wraps=True, name="Verdict")
        self._arrange()
        for button, signal in (
            (self.check_button, self.check_requested),
            (self.hint_button, self.hint_requested),
            (self.variant_button, self.variant_requested),
            (self.again_button, self.again_requested),
            (self.twin_button, self.twin_requested),
            (self.model_button, self.model_requested),
            (self.copy_button, self.copy_requested),
            (self.step_button, self.step_requested),
            (self.list_button, self.list_requested),
        ):
            button.clicked.connect(signal)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self._follow_theme()

    def _button(self, text: str, tip: str, *, flat: bool = False) -> QPushButton:
        button = button_with_tip(text, tip, self)
        button.setProperty("flat", flat)
        return button

    def _arrange(self) -> None:
        self._content = QWidget(self)
        column = column_layout(self._content, 12, margins=(4, 4, 12, 8))
        head = row_layout(spacing=4)
        head.addWidget(self.mark, 1)
        head.addWidget(self.copy_button, 0, Qt.AlignmentFlag.AlignTop)
        column.addWidget(self.list_button, 0, Qt.AlignmentFlag.AlignLeft)
        column.addWidget(self.title)
        column.addLayout(head)
        for label in (self.text, self.given, self.credit):
            column.addWidget(label)
        column.addWidget(self.sketch)
        self._answer_place = column_layout(spacing=4)
        column.addLayout(self._answer_place)
        column.addWidget(self.note)
        column.addWidget(self.hints)
        column.addStretch(1)
        self.scroll_area = QScrollArea(self, widgetResizable=True, alignment=Qt.AlignmentFlag.AlignHCenter)
        self.scroll_area.setFrameShape(QFrame.Shape.NoFrame)
        self.scroll_area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.scroll_area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.scroll_area.setWidget(self._content)
        self._result = QWidget(self)
        self._result.setProperty("role", "panel")
        self._result.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        result = row_layout(self._result, spacing=8, margins=(8, 8, 8, 8))
        result.addWidget(self._icon, 0, Qt.AlignmentFlag.AlignTop)
        result.addWidget(self.verdict, 1)
        buttons = FlowLayout(spacing=8)
        for button in (
            self.check_button,
            self.hint_button,
            self.model_button,
            self.variant_button,
            self.again_button,
            # Behind those that stay: what comes and goes must not push another one under the pointer.
            self.step_button,
            self.twin_button,
        ):
            buttons.addWidget(button)
        self._foot = QWidget(self)
        foot = column_layout(self._foot, 8, margins=(4, 0, 4, 0))
        foot.addWidget(self._result)
        foot.addLayout(buttons)
        # In a line of its own: what comes and goes above must not put another one under the pointer.
        foot.addWidget(self.lesson_button, 0, Qt.AlignmentFlag.AlignLeft)
        middle = row_layout()
        middle.addStretch(1)
        middle.addWidget(self._foot, 1000)
        middle.addStretch(1)
        page = column_layout(self, 8)
        page.addWidget(self.scroll_area, 1)
        page.addLayout(middle)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Expanding)

    # What is shown.

    def show_question(self, record: QuestionRecord, form: Form) -> AnswerView:
        """Ask a question; return the form for its answer."""
        for label, text in (
            (self.title, record.title),
            (self.mark, record.mark),
            (self.text, record.text),
            (self.given, record.given),
            (self.credit, record.credit),
        ):
            label.setText(unbroken(text))
            label.setVisible(bool(text))
        self.sketch.show_sketch(record.sketch)
        self._has_art = _ART.search(record.given) is not None
        self._follow_theme()
        if self.answer is not None:
            self.answer.release()
            self._answer_place.removeWidget(self.answer)
            self.answer.hide()
            self.answer.deleteLater()
        self.answer = make_view(form, self._grid, self._content)
        self.answer.note_changed.connect(self.show_note)
        self._answer_place.addWidget(self.answer)
        # At once, not with the next turn of events: it may be given the keyboard now.
        self.answer.show()
        column = self._content.layout()
        assert column is not None
        column.activate()
        self.show_note("")
        self.show_feedback(None)
        self.scroll_area.verticalScrollBar().setValue(0)
        return self.answer

    def show_list_button(self, is_shown: bool, is_open: bool) -> None:
        """Offer to unfold the list of exercises, where it has no room of its own."""
        self.list_button.setVisible(is_shown)
        self.list_button.setChecked(is_open)

    @Slot(str)
    def show_note(self, text: str) -> None:
        """Say how the answer is understood, or why it is not checked yet."""
        self.note.setText(text)
        self.note.setVisible(bool(text))
        announce(self, text)

    def show_not_checked(self, text: str) -> None:
        """Say why the answer is not checked, and bring that into sight."""
        self.show_note(text)
        column = self._content.layout()
        assert column is not None
        column.activate()
        self.scroll_area.ensureWidgetVisible(self.note)

    def show_hints(self, shown: Sequence[str], count: int) -> None:
        """Show the hints so far, of ``count``."""
        before, numbered = self.hints.text(), enumerate(shown, 1)
        self.hints.setText("\n".join(f"Hint {number} of {count}: {hint}" for number, hint in numbered))
        self.hints.setVisible(bool(shown))
        self.hint_button.setText(f"Hint {min(len(shown) + 1, count)} of {count}" if count else "Hint")
        self.hint_button.setEnabled(len(shown) < count)
        if shown and not before.endswith(shown[-1]):
            announce(self, shown[-1])

    def show_feedback(self, feedback: Feedback | None, *, is_stale: bool = False) -> None:
        """Show what a check found; ``is_stale``: the answer has changed since."""
        self._feedback = feedback
        self._result.setVisible(feedback is not None)
        if feedback is None:
            return
        lines = [f"{feedback.heading}: {feedback.counts}.", *feedback.sentences]
        if is_stale:
            lines = [f"Last check: {feedback.heading}. The answer has changed since."]
        self.verdict.setText("\n".join(lines))
        set_role(self.verdict, "muted" if is_stale else "good" if feedback.is_right else "")
        self._icon.setVisible(not is_stale)
        self._follow_theme()
        if not is_stale:
            announce(self, self.verdict.text())
            if self.answer is not None:
                self.scroll_area.ensureWidgetVisible(self.answer)

    def show_choices(self, *, twin: str, model: str, step: str) -> None:
        """Offer the run of a mistake, the model answer and the scene by these texts; empty: there is no such."""
        for button, text in ((self.twin_button, twin), (self.model_button, model), (self.step_button, step)):
            button.setVisible(bool(text))
            button.setText(text)

    @Slot()
    def _follow_theme(self) -> None:
        theme = current_theme()
        for part in (self._content, self._foot):
            part.setMaximumWidth(WIDEST * theme.text_px // 13)
        font = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont) if self._has_art else QFont()
        if self._has_art:
            font.setPixelSize(theme.code_px)
        set_role(self.given, "")
        self.given.setFont(font)
        set_role(self.given, "" if self._has_art else "strong")
        if self._feedback is not None:
            mark = Mark.RIGHT if self._feedback.is_right else Mark.WRONG
            self._icon.setPixmap(mark_pixmap(mark, theme.text_px + 4, self.devicePixelRatioF()))
