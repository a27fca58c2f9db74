"""The inspector's column: the step in words, formula, listing and variables, and the pixel's history."""

from PySide6.QtCore import Qt, Slot
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QFrame, QLabel, QScrollArea, QSizePolicy, QTabWidget, QWidget

from app.session.moment import Moment
from widgets.basics.controls import column_layout
from widgets.basics.pane_splitter import PaneSplitter
from widgets.basics.theme import current_theme, theme_notifier
from widgets.inspector.formula_view import FormulaView
from widgets.inspector.history_view import PixelHistory
from widgets.inspector.listing import ListingView
from widgets.inspector.prediction import PredictionView
from widgets.inspector.variables import VariablesView
from widgets.timeline.stage_card import StageCardView

LISTING_LINES, PRESENTED_LINES = 10, 4
"""Lines of the listing that are seen whole, and the same while presenting: the formula goes before it."""
SENTENCE_LINES, FORMULA_LINES = 3, 6.5
"""Height of the sentence, and of the formula, in which two fractions stand one below the other, in lines of text."""
DETAIL_LINES = 7
"""Height of variables and history, in lines, for which the listing wraps onto fewer rows."""


class InspectorColumn(QScrollArea):
    """Everything about the step just done, one below the other; it scrolls where the window is low.

    What it says changes its own parts only: the column keeps its width, and so the picture its place.
    """

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._listing_lines = LISTING_LINES
        self.card, self.formula, self.listing = StageCardView(self), FormulaView(self), ListingView(self)
        self.variables, self.history = VariablesView(self), PixelHistory(self)
        self.prediction = PredictionView(self)
        self.prediction.hide()
        self.sentence = QLabel(self)
        self.sentence.setWordWrap(True)
        self.sentence.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.sentence.setProperty("role", "sentence")
        self.sentence.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        self.sentence.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        self.sentence.setAccessibleDescription("What the step did")
        self._step_pane = QWidget(self)
        layout = column_layout(self._step_pane, 4)
        for widget in (self.sentence, self.formula):
            layout.addWidget(widget)
        layout.addStretch(1)
        self.detail_tabs = QTabWidget(self)
        self.detail_tabs.setDocumentMode(True)
        self.detail_tabs.tabBar().setDrawBase(False)
        self.detail_tabs.addTab(self.variables, "Variables")
        self.detail_tabs.addTab(self.history, "Pixel history")
        self.rows = PaneSplitter(Qt.Orientation.Vertical, self)
        for part in (self.listing, self.detail_tabs):
            self.rows.addWidget(part)
        self.rows.setChildrenCollapsible(False)
        self.rows.setStretchFactor(1, 1)
        content = QWidget(self)
        self._parts = column_layout(content, 4)
        for pane in (self.card, self.prediction, self._step_pane):
            self._parts.addWidget(pane)
        self._parts.addWidget(self.rows, 1)
        self.setWidget(content)
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.listing.room_changed.connect(self.fit)
        theme_notifier().theme_changed.connect(self.fit)
        self.fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Give the listing what room there is now; beside a bar or without one, everything is as wide."""
        super().resizeEvent(event)
        bar = self.verticalScrollBar()
        self._parts.setContentsMargins(0, 0, 0 if bar.isVisible() else bar.sizeHint().width(), 0)
        self.fit()

    def set_presenting(self, is_presenting: bool) -> None:
        """Leave out the stage's card, or bring it back."""
        self.card.setVisible(not is_presenting)
        self._listing_lines = PRESENTED_LINES if is_presenting else LISTING_LINES
        self.fit()

    @Slot()
    def fit(self) -> None:
        """Keep room for sentence, formula and some of the listing, in any type, whatever the present step has."""
        line = round(1.25 * current_theme().text_px)
        self.sentence.setMinimumHeight(SENTENCE_LINES * line)
        step, details = round((SENTENCE_LINES + FORMULA_LINES) * line), DETAIL_LINES * (line + 6)
        self._parts.activate()  # What has just come or gone above has moved the pane.
        above = self._step_pane.y() + step
        seen = self.viewport().height() - above - 2 * self.rows.handleWidth()
        rows, lines = (
            self.listing.height_of(self._listing_lines, is_wrapped) for is_wrapped in (False, True)
        )
        code = max(rows, min(lines, seen - details))
        if code > seen:
            # In large type or a low window: it scrolls to the line of the step, which else would be out of sight.
            code = max(self.listing.height_of(PRESENTED_LINES, False), seen)
        for widget, height in ((self._step_pane, step), (self.listing, code), (self.detail_tabs, details)):
            if widget.minimumHeight() != height:
                widget.setMinimumHeight(height)
        if self.listing.height() > max(code, seen):
            self.rows.setSizes([code, max(self.rows.height() - code - self.rows.handleWidth(), details)])

    def show_history(self, moment: Moment) -> None:
        """Bring the history of a pixel forward when one is pinned."""
        if moment.pin is not None and not moment.is_predicting:
            self.detail_tabs.setCurrentWidget(self.history)

    def show_prediction(self, is_shown: bool) -> None:
        """Ask in place of telling: above the sentence."""
        self.prediction.setVisible(is_shown)
