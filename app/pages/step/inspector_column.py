"""The inspector: the step in words, formula, listing and variables; and what is said of it aloud."""

from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal, Slot
from PySide6.QtGui import QAccessible, QResizeEvent
from PySide6.QtWidgets import QFrame, QScrollArea, QSizePolicy, QTabWidget, QWidget

from app.session.moment import Cursor, Moment
from core.explain.records import Formula
from core.stages.declared import stage_of
from widgets.basics.accessibility import announce
from widgets.basics.controls import column_layout, text_label
from widgets.basics.panes import PaneSplitter
from widgets.basics.theme import current_theme, text_font, theme_notifier
from widgets.grid.pixel_grid import PixelGrid
from widgets.inspector.formula_view import FormulaView
from widgets.inspector.listing_pane import ListingPane
from widgets.inspector.pixel_history import PixelHistory
from widgets.inspector.prediction import PredictionView
from widgets.inspector.variables import VariablesView
from widgets.timeline.stage_cards import StageCardView
from widgets.timeline.transport import Timeline

# The inspector's column: the step in words, formula, listing and variables; or the history of a pixel.


LISTING_LINES, PRESENTED_LINES = 10, 4
"""Lines of the listing that are seen whole, and the same while presenting: the formula goes before it."""
LEAST_LINES = 2
"""Lines of the listing that are enough to see the line of the step; in less room the column scrolls to more."""
SENTENCE_LINES = 3
"""Height of the sentence, in lines of text."""
VARIABLE_LINES = 6
"""Height of the variables, in lines, for which the listing wraps onto fewer rows."""


class InspectorColumn(QTabWidget):
    """Everything about the step just done, one below the other, where the window is low in a pane that scrolls.

    A click on a pixel shows its history instead of the step, and the next step brings the step back, unless the user
    has chosen the history. What the step says changes its own parts only: the column keeps its width, and so the
    picture its place; the listing moves only for a formula that is the tallest of its stage.
    """

    step_grown = Signal()
    """Sentence or formula need more room than any of the stage so far."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._listing_lines = LISTING_LINES
        self._width = self._tallest = self._longest = 0
        """Width of what is in the pane that scrolls, and heights of the stage's tallest formula and sentence so far."""
        self._is_presenting, self._is_card_wanted, self._folds_listing = False, True, False
        self._is_alone = self._is_put_off = self._is_owed = False
        self._is_history_chosen = False
        """Whether the user wants to see histories while stepping."""
        self.card, self.formula, self.code = StageCardView(self), FormulaView(self), ListingPane(self)
        self.listing = self.code.listing
        self.variables, self.history = VariablesView(self), PixelHistory(self)
        self.prediction = PredictionView(self)
        self.prediction.hide()
        self.sentence = text_label(
            "", self, "sentence", name="What the step did", wraps=True, is_selectable=True
        )
        self.sentence.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        self.sentence.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        self._step_pane = QWidget(self)
        layout = column_layout(self._step_pane, 4)
        for widget in (self.sentence, self.formula):
            layout.addWidget(widget)
        layout.addStretch(1)
        self.rows = PaneSplitter(Qt.Orientation.Vertical, self)
        for part in (self.code, self.variables):
            self.rows.addWidget(part)
        self.rows.setChildrenCollapsible(False)
        self.rows.setStretchFactor(1, 1)
        # As high as `fit` says: what the listing would like to have makes nothing scroll.
        self.rows.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Ignored)
        content = QWidget(self)
        self._parts = column_layout(content, 4)
        for pane in (self.card, self.prediction, self._step_pane):
            self._parts.addWidget(pane)
        self._parts.addWidget(self.rows, 1)
        self.step = QScrollArea(self)
        self.step.setWidget(content)
        self.step.setWidgetResizable(True)
        self.step.setFrameShape(QFrame.Shape.NoFrame)
        self.step.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.step.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.step.viewport().installEventFilter(self)
        self.setDocumentMode(True)
        self.tabBar().setDrawBase(False)
        # What is not in sight takes no room: beside a lesson there may be less than a history wants.
        self.history.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Ignored)
        self.addTab(self.step, "This step")
        self.addTab(self.history, "Pixel history")
        self.tabBarClicked.connect(self._choose)
        self.listing.room_changed.connect(self.fit)
        self.formula.typeset.connect(self._make_room_for_typeset)
        theme_notifier().theme_changed.connect(self._forget_heights)
        self.fit()

    @Slot(int)
    def _choose(self, index: int) -> None:
        self._is_history_chosen = self.widget(index) is self.history

    def show_step(self, moment: Moment | None = None) -> None:
        """Show the step just done from its sentence on, unless the user has chosen to see histories."""
        if not self._is_history_chosen:
            self.setCurrentWidget(self.step)
        self.step.verticalScrollBar().setValue(0)

    def show_history(self, moment: Moment) -> None:
        """Show the history of a pixel that is pinned, and the step again when none is."""
        if moment.pin is None or moment.is_predicting:
            self.show_step()
        else:
            self.setCurrentWidget(self.history)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Give the listing what room there is now; beside a bar or without one, everything is as wide."""
        if watched is self.step.viewport() and event.type() == QEvent.Type.Resize:
            bar = self.step.verticalScrollBar()
            beside = 0 if bar.isVisible() else self._bar_width()
            self._parts.setContentsMargins(0, 0, beside, 0)
            width = self.step.viewport().width() - beside
            if width == self._width:
                self.fit()
            else:
                self._width = width
                self._forget_heights()
        return super().eventFilter(watched, event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Give the pages their room: while hidden, Qt would first lay them out for the room that they had before."""
        super().resizeEvent(event)
        pages = self.currentWidget().parentWidget()
        if not self.isVisible() and pages is not None:
            top = self.tabBar().sizeHint().height()
            pages.setGeometry(0, top, self.width(), self.height() - top)

    def set_presenting(self, is_presenting: bool) -> None:
        """Leave out the stage's card, or bring it back."""
        self._is_presenting = is_presenting
        self._show_parts()
        self._listing_lines = PRESENTED_LINES if is_presenting else LISTING_LINES
        self.fit()

    def show_card(self, is_wanted: bool) -> None:
        """Show the stage's card, but not while presenting; or leave it out for something else that stands there."""
        if is_wanted != self._is_card_wanted:
            self._is_card_wanted = is_wanted
            self._show_parts()

    def fold_listing(self, is_folded: bool) -> None:
        """Leave out listing and variables while presenting, for the text of a lesson; or show them again."""
        if is_folded != self._folds_listing:
            self._folds_listing = is_folded
            self._show_parts()

    def _show_parts(self) -> None:
        self.card.setVisible(self._is_card_wanted and not self._is_presenting)
        self.rows.setVisible(not (self._folds_listing and self._is_presenting))
        self.tabBar().setVisible(not self._is_alone)
        self.sentence.setVisible(not self._is_alone)
        self._step_pane.setVisible(not (self._is_alone and self.wants_listing()))
        self.fit()

    def show_formula(self, formula: Formula | None, is_new_stage: bool) -> None:
        """Show the formula of a step; one that is the tallest of its stage so far moves what is below."""
        self.formula.show_formula(formula)
        self._longest = 0 if is_new_stage else self._longest
        self._make_room(0 if is_new_stage else self._tallest)

    def _make_room(self, least: int) -> None:
        """Give sentence and formula the height that they want, but the formula no less than ``least``."""
        before = self._tallest, self._longest
        self._tallest = max(self.formula.heightForWidth(max(self._width, 1)), least)
        self._longest = max(self.sentence.heightForWidth(max(self._width, 1)), self._longest)
        if (self._tallest, self._longest) != before:
            self.fit()
            self.step_grown.emit()

    @Slot()
    def _make_room_for_typeset(self) -> None:
        self._make_room(self._tallest)

    @Slot()
    def _forget_heights(self) -> None:
        """Find the room of the formula anew, in another width or type."""
        self.tabBar().setFont(
            text_font(current_theme())
        )  # Qt leaves it as it was while the column is hidden.
        self._tallest = self._longest = -1
        self._make_room(0)

    def put_off(self, is_put_off: bool) -> None:
        """Fit nothing until all is known that is shown, then once."""
        self._is_put_off = is_put_off
        if self._is_owed and not is_put_off:
            self.fit()

    @Slot()
    def fit(self) -> None:
        """Keep room for the sentence, the tallest formula and some of the listing, in any type."""
        self._is_owed = self._is_put_off
        if self._is_put_off:
            return
        line = round(1.25 * current_theme().text_px)
        self.sentence.setMinimumHeight(SENTENCE_LINES * line)
        told = 0 if self._is_alone else max(SENTENCE_LINES * line, self._longest) + 4
        step, details = told + self._tallest, VARIABLE_LINES * (line + 6)
        if self._is_alone and self.wants_listing():
            step = details = 0
        self._parts.activate()  # What has just come or gone above has moved the pane.
        above = self._step_pane.y() + step
        head = self.code.height_around
        seen = self.step.viewport().height() - above - 2 * self.rows.handleWidth() - head
        rows, lines = (
            self.listing.height_of(self._listing_lines, is_wrapped) for is_wrapped in (False, True)
        )
        code = max(rows, min(lines, seen - details))
        if code > seen:
            # In large type or a low window: it scrolls to the line of the step, which else would be out of sight.
            least = PRESENTED_LINES if seen < self.listing.height_of(LEAST_LINES, False) else LEAST_LINES
            code = max(self.listing.height_of(least, False), seen)
        for widget, height in (
            (self._step_pane, step),
            (self.listing, code),
            (self.code.editor, code),
            (self.code, code + head),
            (self.variables, details),
        ):
            if widget.minimumHeight() != height:
                widget.setMinimumHeight(height)
        self.rows.setMinimumHeight(self.rows.minimumSizeHint().height())
        if self.listing.height() > max(code, seen):
            code += head
            self.rows.setSizes([code, max(self.rows.height() - code - self.rows.handleWidth(), details)])

    def wants_listing(self) -> bool:
        """Return whether the listing goes before all else in front of a class: it is to be changed."""
        return self._is_presenting and not self._folds_listing

    def step_heights(self, width: int) -> tuple[int, int]:
        """Return the heights at which the step is read without scrolling in a width, and its most important part.

        That is the formula; in front of a class the listing, where it is to be changed.
        """
        line, inner = round(1.25 * current_theme().text_px), max(width - self._bar_width(), 1)
        formula = max(self._tallest, self.formula.heightForWidth(inner))
        told = max(SENTENCE_LINES * line, self.sentence.heightForWidth(inner))
        whole, part = self.tabBar().sizeHint().height() + told + 4 + formula, formula
        if self.wants_listing():
            least, most = (
                self.listing.height_of(PRESENTED_LINES, False),
                self.listing.height_of(LISTING_LINES),
            )
            part = least + self.code.height_around
            whole += most + self.code.height_around
        return whole, part

    def _bar_width(self) -> int:
        return self.step.verticalScrollBar().sizeHint().width()

    def show_part_alone(self, is_alone: bool) -> None:
        """Leave out all but the most important part for want of room, see `step_heights`, or show all again."""
        if is_alone == self._is_alone:
            return
        self._is_alone = is_alone
        self._show_parts()

    def show_prediction(self, is_shown: bool) -> None:
        """Ask in place of telling: above the sentence."""
        self.prediction.setVisible(is_shown)
        self.show_step()


# What is said after a step: sentence, line of the algorithm, formula, the value at the pixel, and what is
# asked.


REST_MILLISECONDS = 150
"""Steps that follow each other faster than this are not said: only the one that is reached."""


class StepNarrator(QObject):
    """Has a screen reader say what stands in the inspector now, and the value of the pinned or pointed pixel."""

    def __init__(
        self,
        cursor: Cursor,
        column: InspectorColumn,
        grid: PixelGrid,
        timeline: Timeline,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._cursor, self._column, self._grid, self._timeline = cursor, column, grid, timeline
        self._said = ("", "", "", "", "")
        """Stage, level, step, value and question that were said last."""
        self._rest = QTimer(self)
        self._rest.setSingleShot(True)
        self._rest.setInterval(REST_MILLISECONDS)
        self._rest.timeout.connect(self._say)

    def owe(self, moment: Moment) -> None:
        """Say what is shown as soon as nothing moves any more."""
        self._cursor = moment.cursor
        if QAccessible.isActive():
            self._rest.start()

    @Slot()
    def _say(self) -> None:
        """Say what differs from what was said last."""
        level = self._timeline.level_buttons[self._cursor.level].accessibleName()
        stage = f"Stage {stage_of(self._cursor.stage).short_title}"
        column, question = self._column, self._column.prediction.question
        texts = (column.sentence.text(), column.listing.accessibleDescription(), column.formula.spoken())
        step = ". ".join(text.rstrip(".") for text in texts if text)
        asked = question.text() if question.isVisible() else ""
        now = (stage, level, step, self._grid.spoken_description(), asked)
        new = [text for text, before in zip(now, self._said, strict=True) if text and text != before]
        self._said = now
        announce(column.sentence, ". ".join(new), is_urgent=step in new)
