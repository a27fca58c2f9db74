"""The lessons of the course as cards under the titles of their parts: title, question, and how far one is."""

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QSize, Qt, Signal, Slot
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QToolButton, QWidget

from core.records.words import counted, has_words
from widgets.basics.accessibility import ArrowGroup
from widgets.basics.card import GAP, SPACING, Card
from widgets.basics.controls import FlowLayout, button_with_tip, column_layout, row_layout, text_label
from widgets.basics.theme import current_theme, theme_notifier

WIDTH = 286
"""Least of a card at a text size of 13: three stand side by side in a window of 1280 pixels."""
WIDEST = 1.6
"""Times that width, at most."""
BY_STAGE, BY_LEARNING = "List by stage", "List in the order of learning"


@dataclass(frozen=True)
class LessonEntry:
    """One lesson."""

    name: str
    title: str
    question: str
    minutes: int
    done: tuple[bool, ...]
    """Of each step, whether it is done; empty: a single step."""
    seen: tuple[bool, ...] = ()
    """Of each step, whether its answer was shown; empty: none."""
    is_next: bool = False
    """Whether this is where one goes on."""

    @property
    def is_begun(self) -> bool:
        """Whether a step is done, or its answer was shown."""
        return any((*self.done, *self.seen))

    @property
    def is_finished(self) -> bool:
        """Whether all steps are done, or their answers were shown."""
        return bool(self.done) and sum(self.done) + sum(self.seen) == len(self.done)

    @property
    def progress(self) -> str:
        """How long it takes and how far one is, in words."""
        if not self.done:
            return f"{self.minutes} minutes"
        seen = f", {sum(self.seen)} seen" if any(self.seen) else ""
        return f"{self.minutes} minutes, {sum(self.done)} of {counted(len(self.done), 'step')} done{seen}"


@dataclass(frozen=True)
class LessonPart:
    """Lessons that belong together."""

    title: str
    lessons: tuple[LessonEntry, ...]

    @property
    def sentence(self) -> str:
        """What is in it, in words."""
        if not any(lesson.done for lesson in self.lessons):
            return counted(len(self.lessons), "surprise")
        minutes = sum(lesson.minutes for lesson in self.lessons)
        done = sum(lesson.is_finished for lesson in self.lessons)
        return f"{counted(len(self.lessons), 'lesson')}, {minutes} minutes{f', {done} done' if done else ''}"


class LessonCard(Card):
    """A button with title, question, minutes and a dot for each step."""

    def __init__(self, entry: LessonEntry, parent: QWidget | None = None) -> None:
        super().__init__(entry.name, (entry.title, entry.question), (Qt.Key.Key_Space,), parent)
        self.entry = entry
        self._width = WIDTH
        here = " Go on here." if entry.is_next else ""
        self.setAccessibleDescription(f"{entry.question} {entry.progress}.{here}")
        self.setToolTip(entry.progress)

    def sizeHint(self) -> QSize:
        """Return the size of all texts; the parent gives a part the height of its highest."""
        title, question = self.text_heights(self._width - 2 * GAP)
        last = round(1.5 * current_theme().text_px)
        return QSize(self._width, title + question + last + 3 * GAP)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the card, with a frame where it has the keyboard or the pointer, or where one goes on."""
        theme, entry = current_theme(), self.entry
        title_height, _ = self.text_heights(self._width - 2 * GAP)
        with QPainter(self) as painter:
            self.paint_card(painter, is_marked=entry.is_next)
            text = self.rect().adjusted(GAP, GAP, -GAP, -GAP)
            self.paint_texts(painter, text, title_height + GAP // 2)
            said = f"{entry.minutes} min" + (" · go on here" if entry.is_next and entry.is_begun else "")
            painter.drawText(text, int(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignBottom), said)
            radius = 0.3 * theme.text_px
            painter.setPen(QPen(QColor(theme.muted_text), 1.4))
            seen = entry.seen or (False,) * len(entry.done)
            for place, (is_done, is_seen) in enumerate(
                zip(reversed(entry.done), reversed(seen), strict=True)
            ):
                painter.setBrush(QColor(theme.muted_text) if is_done else Qt.BrushStyle.NoBrush)
                middle = QPointF(text.right() - radius * (1 + 3 * place), text.bottom() - 0.6 * theme.text_px)
                painter.drawEllipse(middle, radius, radius)
                if is_seen:  # A point, as in the lesson.
                    painter.setBrush(QColor(theme.muted_text))
                    painter.drawEllipse(middle, 0.3 * radius, 0.3 * radius)

    def set_width(self, width: int) -> None:
        """Take so many pixels of width."""
        self._width = width


class LessonPartView(QWidget):
    """The title of a part, which folds its cards away and shows them again."""

    lesson_chosen = Signal(str)

    def __init__(self, part: LessonPart, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.part = part
        self.button = QToolButton(self, toolButtonStyle=Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.button.setProperty("flat", True)
        self.button.setText(f"{part.title}: {part.sentence}")
        self.button.clicked.connect(self._toggle)
        self._group = QWidget(self, accessibleName=part.title)
        flow = FlowLayout(self._group, SPACING)
        self.cards = [LessonCard(entry, self._group) for entry in part.lessons]
        ArrowGroup(self.cards, self._group)
        for card in self.cards:
            card.clicked.connect(self._choose)
            flow.addWidget(card)
        layout = column_layout(self, 4)
        layout.addWidget(self.button)
        layout.addWidget(self._group)
        theme_notifier().theme_changed.connect(self._fit)
        self.set_open(False)

    @property
    def is_open(self) -> bool:
        """Whether the cards are shown, where no words are looked for."""
        return self._is_open

    def set_open(self, is_open: bool) -> None:
        """Show the cards, or fold them away."""
        self._is_open = is_open
        self._show_cards(is_open)

    def _show_cards(self, is_shown: bool) -> None:
        self._group.setVisible(is_shown)
        self.button.setArrowType(Qt.ArrowType.DownArrow if is_shown else Qt.ArrowType.RightArrow)
        self.button.setAccessibleDescription("shown" if is_shown else "folded away")

    def show_only(self, words: Sequence[str]) -> int:
        """Show the lessons that have all ``words`` in their texts, and return their number; no words: as before."""
        found = [
            has_words(words, card.entry.title, card.entry.question, card.entry.name) for card in self.cards
        ]
        for card, is_found in zip(self.cards, found, strict=True):
            card.setHidden(not is_found)
        self._show_cards(bool(words) or self._is_open)
        self.setVisible(any(found))
        return sum(found)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Choose how many cards stand side by side."""
        super().resizeEvent(event)
        self._fit()

    @Slot()
    def _fit(self) -> None:
        """Make the cards as wide as so many leave room for, and all as high as the highest."""
        least = round(WIDTH * current_theme().text_px / 13)
        columns = max((self.width() + SPACING) // (least + SPACING), 1)
        width = (self.width() + SPACING) // columns - SPACING
        for card in self.cards:
            card.set_width(min(max(width, least), round(WIDEST * least)))
        sizes = [card.sizeHint() for card in self.cards]
        for card, size in zip(self.cards, sizes, strict=True):
            card.setFixedSize(size.width(), max(each.height() for each in sizes))

    @Slot()
    def _toggle(self) -> None:
        self.set_open(not self.is_open)

    @Slot()
    def _choose(self) -> None:
        self.lesson_chosen.emit(self.sender().objectName())


class LessonList(QWidget):
    """All lessons, part by part; the part in which one goes on is open."""

    lesson_chosen = Signal(str)
    """Name of a lesson."""
    order_chosen = Signal(bool)
    """Whether they are to be listed by stage."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName("Lessons")
        self.parts: list[LessonPartView] = []
        self._words: Sequence[str] = ()
        self._is_by_stage = False
        self.lead = text_label("", self, wraps=True)
        self.order_button = button_with_tip(BY_STAGE, "List the lessons in another order", self)
        self.order_button.clicked.connect(self._turn)
        head = QWidget(self)
        row = row_layout(head, 8)
        row.addWidget(text_label("Lessons", head, role="title"))
        row.addStretch(1)
        row.addWidget(self.order_button)
        self._column = column_layout(self, 4)
        self._column.addWidget(head)
        self._column.addWidget(self.lead)

    @property
    def cards(self) -> list[LessonCard]:
        """All cards, also those that are folded away."""
        return [card for part in self.parts for card in part.cards]

    def show_lessons(self, parts: Sequence[LessonPart], lead: str) -> None:
        """Show the lessons, and a sentence on where to begin or to go on; parts that were open stay open."""
        were_open = {view.part.title for view in self.parts if view.is_open}
        for view in self.parts:
            self._column.removeWidget(view)
            view.hide()
            view.deleteLater()
        self.lead.setText(lead)
        self.parts = [LessonPartView(part, self) for part in parts]
        for view in self.parts:
            view.lesson_chosen.connect(self.lesson_chosen)
            is_next = any(lesson.is_next for lesson in view.part.lessons)
            view.set_open(is_next or view.part.title in were_open)
            self._column.addWidget(view)
        self.show_only(self._words)

    def show_only(self, words: Sequence[str]) -> int:
        """Leave out the lessons that do not have all ``words`` in their texts; return how many are left."""
        self._words = words
        self.lead.setVisible(not words)
        return sum(view.show_only(words) for view in self.parts)

    @Slot()
    def _turn(self) -> None:
        self._is_by_stage = not self._is_by_stage
        self.order_button.setText(BY_LEARNING if self._is_by_stage else BY_STAGE)
        self.order_chosen.emit(self._is_by_stage)
