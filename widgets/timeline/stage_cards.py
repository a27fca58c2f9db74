"""Stages as cards: the purpose, input and output of one, and the phases of a run side by side."""

from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QFrame, QGridLayout, QLabel, QScrollArea, QSizePolicy, QToolButton, QWidget

from core.explain.records import StageCard
from widgets.basics.controls import column_layout, set_role, text_label
from widgets.basics.theme import current_theme, theme_notifier

# The purpose, input and output of a stage, and the lecture it is from.


class StageCardView(QWidget):
    """Shows a `StageCard`; the title line folds it away."""

    card_folded = Signal(bool)
    """The user has folded (True) or opened (False) the card."""
    link_chosen = Signal(str)
    """A word of the card that is a link: its address."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "panel")
        self._is_folded = False
        self._card: StageCard | None = None
        self._markup: Callable[[str], str] | None = None
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.fold_button = QToolButton(self)
        self.fold_button.setProperty("flat", True)
        self.fold_button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.fold_button.setArrowType(Qt.ArrowType.DownArrow)
        self.fold_button.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.fold_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.fold_button.setToolTip("Show or hide the purpose, input and output of this stage")
        font = self.fold_button.font()
        font.setBold(True)
        self.fold_button.setFont(font)
        self.fold_button.setMinimumWidth(1)  # a narrow pane shortens the title
        self.fold_button.clicked.connect(self._fold)
        self._body = QWidget(self)
        grid = QGridLayout(self._body)
        grid.setContentsMargins(8, 0, 8, 8)
        grid.setHorizontalSpacing(12)
        grid.setVerticalSpacing(4)
        grid.setColumnStretch(1, 1)
        self._labels: list[QLabel] = []
        self._texts: list[QLabel] = []
        for row, name in enumerate(("Purpose", "Input", "Output", "Source")):
            label = text_label(name, self._body, role="muted")
            text = text_label("", self._body, name=name, wraps=True, is_selectable=True)
            text.setObjectName(name.lower())
            text.linkActivated.connect(self.link_chosen)
            grid.addWidget(label, row, 0, Qt.AlignmentFlag.AlignTop)
            grid.addWidget(text, row, 1)
            self._labels.append(label)
            self._texts.append(text)
        self._texts[3].setProperty("role", "muted")
        theme_notifier().theme_changed.connect(self._fill)
        layout = column_layout(self, 0)
        layout.addWidget(self.fold_button)
        layout.addWidget(self._body)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Maximum)
        self.show_card(None)

    @Slot(object)
    def show_card(self, card: StageCard | None) -> None:
        """Show the card of a stage, or the hint for an empty pane."""
        self._card = card
        self.fold_button.setText(card.title if card else "Stage card")
        self._fill()

    def set_markup(self, markup: Callable[[str], str]) -> None:
        """Show what the stage gets, gives and is for as the HTML that ``markup`` makes of it, with links."""
        self._markup = markup
        for text in self._texts[:3]:
            text.setTextInteractionFlags(Qt.TextInteractionFlag.TextBrowserInteraction)
        self._fill()

    @Slot()
    def _fill(self) -> None:
        """Write the texts; those of a folded card when it is opened: finding links takes a moment."""
        card = self._card
        if self._is_folded and self._markup is not None:
            return
        hint = "Choose a stage below to read its purpose, input and output."
        texts = (card.purpose, card.gets, card.gives, card.source) if card else (hint, "", "", "")
        set_role(self._texts[0], "" if card else "muted")
        for label, view, text in zip(self._labels, self._texts, texts, strict=True):
            is_marked = self._markup is not None and card is not None and view is not self._texts[3]
            view.setText(self._with_links(text) if is_marked else text)
            view.setVisible(bool(text))
            label.setVisible(bool(text) and card is not None)

    def _with_links(self, text: str) -> str:
        """Return marked text whose links have the colour of text: other colours mean something here."""
        assert self._markup is not None
        return self._markup(text).replace("<a ", f'<a style="color: {current_theme().text}" ')

    @Slot(bool)
    def show_folded(self, is_folded: bool) -> None:
        """Fold the card away or open it."""
        self._is_folded = is_folded
        self.fold_button.setArrowType(Qt.ArrowType.RightArrow if is_folded else Qt.ArrowType.DownArrow)
        self._body.setVisible(not is_folded)
        self._fill()

    def is_folded(self) -> bool:
        """Return whether only the title line is shown."""
        return self._is_folded

    @Slot()
    def _fold(self) -> None:
        self.show_folded(not self._is_folded)
        self.card_folded.emit(self._is_folded)


# The run as a few phases side by side: what goes into each, what comes out, and the stages in it.


WIDTH_IN_TYPE = 57
"""Width that the phases side by side need, in sizes of their type."""
_LEAST_PX = 11


@dataclass(frozen=True)
class Part:
    """One stage of a phase."""

    title: str
    counts: str
    """What goes in and comes out."""
    more: str = ""
    """The same in words, or why it is not needed or was inserted."""
    is_current: bool = False


@dataclass(frozen=True)
class PhaseCard:
    """One phase."""

    title: str
    incoming: str
    """How many of what go in, as ``24 vertices``."""
    takes: str
    """What they bring along."""
    outgoing: str
    gives: str
    parts: tuple[Part, ...]


class PhaseColumn(QFrame):
    """One phase from top to bottom: in, the stages, out."""

    part_chosen = Signal(int)
    """The user chooses a stage, by its place in the phase."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "panel")
        self._layout = column_layout(self, 4, (12, 12, 12, 12))
        self._title = text_label("", self, "title", wraps=True)
        self._texts: list[QLabel] = []
        self._layout.addWidget(self._title)
        self._in = self._end("In")
        self._buttons_box = column_layout(None, 2, (0, 8, 0, 8))
        self._layout.addLayout(self._buttons_box)
        self._out = self._end("Out")
        self._layout.addStretch(1)
        self.buttons: list[QToolButton] = []

    def _end(self, name: str) -> tuple[QLabel, QLabel]:
        """Return the count and the kind of what goes in or comes out."""
        self._layout.addWidget(text_label(name, self, "muted"))
        count, what = text_label("", self, "strong", wraps=True), text_label("", self, wraps=True)
        self._layout.addWidget(count)
        self._layout.addWidget(what)
        return count, what

    def show_card(self, card: PhaseCard) -> None:
        """Show a phase."""
        is_current = any(part.is_current for part in card.parts)
        self._title.setText(card.title)
        set_role(self, "kept" if is_current else "panel")
        for label, text in zip(
            (*self._in, *self._out), (card.incoming, card.takes, card.outgoing, card.gives), strict=True
        ):
            label.setText(text)
        self.setAccessibleName(f"{card.title}: {card.incoming} in, {card.outgoing} out")
        while len(self.buttons) < len(card.parts):
            button = QToolButton(self)
            button.setProperty("flat", True)
            button.setCheckable(True)
            button.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
            button.clicked.connect(self._choose)
            self.buttons.append(button)
            self._buttons_box.addWidget(button)
        for place, button in enumerate(self.buttons):
            button.setVisible(place < len(card.parts))
            if place < len(card.parts):
                part = card.parts[place]
                button.setText(f"{part.title}\n{part.counts}")
                button.setChecked(part.is_current)
                button.setToolTip("\n".join(text for text in (part.title, part.more) if text))
                button.setAccessibleName(f"Stage {part.title}: {part.more}")

    @Slot()
    def _choose(self) -> None:
        button = self.sender()
        assert isinstance(button, QToolButton)
        button.setChecked(not button.isChecked())  # Which stage is stepped is shown, not chosen here.
        self.part_chosen.emit(self.buttons.index(button))


class Phases(QScrollArea):
    """All phases in a row, with an arrow from each to the next."""

    stage_chosen = Signal(int)
    """The user chooses a stage, by its place in the run."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.columns: list[PhaseColumn] = []
        self._first: list[int] = []
        self._content = QWidget(self)
        self._grid = QGridLayout(self._content)
        self._grid.setContentsMargins(8, 8, 8, 8)
        self._grid.setSpacing(4)
        self.setWidget(self._content)
        self.setWidgetResizable(True)
        self.setFrameShape(QScrollArea.Shape.NoFrame)
        theme_notifier().theme_changed.connect(self._fit_type)

    @Slot(object)
    def show_cards(self, cards: Sequence[PhaseCard]) -> None:
        """Show the phases in order; there are as many each time."""
        for place in range(len(self.columns), len(cards)):
            if place:
                self._grid.addWidget(text_label("→", self._content, "title"), 0, 2 * place - 1)
            column = PhaseColumn(self._content)
            column.part_chosen.connect(self._choose)
            self._grid.addWidget(column, 0, 2 * place)
            self._grid.setColumnStretch(2 * place, 1)
            self.columns.append(column)
        first = 0
        self._first = []
        for column, card in zip(self.columns, cards, strict=True):
            column.show_card(card)
            self._first.append(first)
            first += len(card.parts)
        self._fit_type()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit the type to the width."""
        super().resizeEvent(event)
        self._fit_type()

    @Slot()
    def _fit_type(self) -> None:
        """Take the largest type, up to the theme's, in which the phases fit side by side and from top to bottom."""
        largest = min(max(self.width() // WIDTH_IN_TYPE, _LEAST_PX), current_theme().text_px)
        sizes = range(_LEAST_PX, largest + 1)
        self._set_type(largest)
        if self._needs_height() > self.height():
            self._set_type(sizes[max(bisect_right(sizes, self.height(), key=self._height_in) - 1, 0)])

    def _height_in(self, size: int) -> int:
        """Return the height that the phases need in a size of type."""
        self._set_type(size)
        return self._needs_height()

    def _needs_height(self) -> int:
        return self._grid.heightForWidth(self.width())

    def _set_type(self, size: int) -> None:
        title = round(size * current_theme().title_px / current_theme().text_px)
        style = (
            f"QLabel, QToolButton {{ font-size: {size}px; }} QLabel[role=title] {{ font-size: {title}px; }}"
        )
        if style != self._content.styleSheet():
            self._content.setStyleSheet(style)

    @Slot(int)
    def _choose(self, part: int) -> None:
        column = self.sender()
        assert isinstance(column, PhaseColumn)
        self.stage_chosen.emit(self._first[self.columns.index(column)] + part)
