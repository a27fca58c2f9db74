"""The purpose, input and output of a stage, and the lecture it is from."""

from collections.abc import Callable

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtWidgets import QGridLayout, QLabel, QSizePolicy, QToolButton, QWidget

from core.explain.records import StageCard
from widgets.basics.controls import column_layout
from widgets.basics.labels import set_role, text_label
from widgets.basics.theme import current_theme, theme_notifier


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
