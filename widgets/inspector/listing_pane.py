"""The listing's pane: the algorithm as it is read or edited, which version is shown, and what is said of the edit."""

from dataclasses import dataclass

from PySide6.QtCore import QEvent, QObject, Qt, Signal, Slot
from PySide6.QtGui import QAction, QKeyEvent, QResizeEvent, QTextDocumentFragment
from PySide6.QtWidgets import QLineEdit, QMenu, QSizePolicy, QStackedWidget, QTabBar, QToolButton, QWidget

from core.lanes.problem import NAME_LENGTH
from widgets.basics.accessibility import announce
from widgets.basics.controls import LEAST_TARGET, ElidedLabel, column_layout, row_layout, set_role, text_label
from widgets.basics.theme import current_theme, theme_notifier
from widgets.inspector.listing import ListingView
from widgets.inspector.listing_editor import ListingEditor

A, B = 0, 1
HEAD_HEIGHT = 1.85
"""Height of the head, in heights of the text."""
UNNAMED = "mine"
TAB_LETTERS = 16
"""Letters of a name that a tab shows at most."""
EDIT_TIP = "Change a line: side B draws at once what your version draws (F2)"


@dataclass(frozen=True)
class PaneHead:
    """What the head of the pane offers."""

    is_shown: bool = False
    """Whether some listing of the stage can be edited."""
    refusal: str = ""
    """Why the listing that is shown cannot be edited; empty: it can."""
    is_edited: bool = False
    """Whether there is an edited version of it."""
    note: str = ""
    """How many lines are changed, or where else a listing is edited."""
    resets: str = ""
    """What Reset takes back, in words; empty: nothing is edited."""
    name: str = ""
    """What the user calls the edited version; empty: it has no name."""


class ListingPane(QWidget):
    """A listing under its head: tabs A and B where it is edited, Edit and Reset; below it one sentence on the edit."""

    edit_requested = Signal(int)
    """The user wants to edit, from a line (from 1) on; 0: wherever."""
    reset_requested = Signal()
    """The user wants the listing as it was."""
    side_chosen = Signal(int)
    """The user wants to see `A` or `B`."""
    link_clicked = Signal(str)
    """The user has clicked a link of the sentence."""
    name_given = Signal(str)
    """The user has named the edited version; empty: it has no name any more."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._head = PaneHead()
        self._message_room: tuple[bool, int] = True, 0
        """Whether the sentence is hidden, and its height, when the column was told."""
        self.listing, self.editor = ListingView(self), ListingEditor(self)
        self.sides = QTabBar(self, drawBase=False, expanding=False)
        self.sides.setAccessibleName("Version of the listing")
        self.sides.addTab("A")
        self.sides.addTab(f"B: {UNNAMED}")
        self.sides.setTabToolTip(A, "The method as it is")
        self.sides.setTabToolTip(B, "Your version. Double-click: give it a name")
        self.sides.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.note = ElidedLabel(self)
        self.note.setProperty("role", "muted")
        self.name_field = QLineEdit(self, maxLength=NAME_LENGTH, placeholderText="Name of your version")
        self.name_field.setAccessibleName("Name of your version")
        self.name_field.hide()
        self.edit_button, self.reset_button = QToolButton(self), QToolButton(self)
        for button, text, tip in ((self.edit_button, "Edit", EDIT_TIP), (self.reset_button, "Reset", "")):
            button.setText(text)
            button.setToolTip(tip)
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.edit_button.setCheckable(True)
        self.message = text_label("", self, wraps=True)
        self.message.setTextFormat(Qt.TextFormat.RichText)
        self.message.setTextInteractionFlags(
            Qt.TextInteractionFlag.TextSelectableByMouse | Qt.TextInteractionFlag.LinksAccessibleByMouse
        )
        self.message.hide()
        self.stack = QStackedWidget(self)
        for view in (self.listing, self.editor):
            self.stack.addWidget(view)
        # A text that is typed must not make the pane wider or higher.
        self.stack.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Expanding)
        self.head = QWidget(self)
        row = row_layout(self.head, spacing=4, margins=(0, 0, 4, 0))
        row.addWidget(self.sides)
        row.addWidget(self.note, 1)
        row.addWidget(self.name_field, 1)
        row.addWidget(self.reset_button)
        row.addWidget(self.edit_button)
        layout = column_layout(self, 0)
        layout.addWidget(self.head)
        layout.addWidget(self.stack, 1)
        layout.addWidget(self.message)
        self.edit_button.clicked.connect(self._toggle)
        self.reset_button.clicked.connect(self.reset_requested)
        self.sides.tabBarClicked.connect(self.side_chosen)
        self.sides.currentChanged.connect(self._choose_side)
        self.sides.tabBarDoubleClicked.connect(self._name_side)
        self.name_field.returnPressed.connect(self._take_name)
        self.name_field.editingFinished.connect(self._end_naming)
        self.name_field.installEventFilter(self)
        self.message.linkActivated.connect(self.link_clicked)
        self.listing.menu_opened.connect(self._add_to_menu)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self._follow_theme()
        self.show_head(PaneHead())

    @property
    def is_editing(self) -> bool:
        """Whether the editor is shown."""
        return self.stack.currentWidget() is self.editor

    @property
    def height_around(self) -> int:
        """Height of the head, and of the sentence below."""
        head = self.head.minimumHeight() if self._head.is_shown else 0
        return head + (0 if self.message.isHidden() else self.message.height())

    def show_head(self, head: PaneHead) -> None:
        """Offer what can be done with the listing that is shown."""
        was_shown = self._head.is_shown
        self._head = head
        self.head.setVisible(head.is_shown)
        self.sides.setVisible(head.is_edited)
        self.sides.setTabText(B, f"B: {self._short(head.name) or UNNAMED}")
        self.reset_button.setVisible(bool(head.resets))
        self.reset_button.setToolTip(f"Take back {head.resets}")
        self.note.setText(head.note)
        self.edit_button.setVisible(not head.refusal)
        if was_shown != head.is_shown:
            self.listing.room_changed.emit()

    def _short(self, name: str) -> str:
        room = self.fontMetrics().averageCharWidth() * TAB_LETTERS
        # In a tab, & would underline the next letter.
        return self.fontMetrics().elidedText(name, Qt.TextElideMode.ElideRight, room).replace("&", "&&")

    @Slot()
    def ask_name(self) -> None:
        """Let the user name the edited version, in the head."""
        if self._head.is_edited:
            self.name_field.setText(self._head.name)
            self.note.hide()
            self.name_field.show()
            self.name_field.selectAll()
            self.name_field.setFocus(Qt.FocusReason.OtherFocusReason)

    @Slot(int)
    def _name_side(self, side: int) -> None:
        if side == B:
            self.ask_name()

    @Slot()
    def _take_name(self) -> None:
        self.name_given.emit(self.name_field.text().strip())

    @Slot()
    def _end_naming(self) -> None:
        if self.name_field.hasFocus():
            (self.editor if self.is_editing else self.listing).setFocus(Qt.FocusReason.OtherFocusReason)
        self.name_field.hide()
        self.note.show()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Let Escape leave the field of the name, and no shortcut of the window take its keys."""
        if watched is self.name_field and isinstance(event, QKeyEvent) and event.key() == Qt.Key.Key_Escape:
            if event.type() == QEvent.Type.ShortcutOverride:
                event.accept()
            elif event.type() == QEvent.Type.KeyPress:
                self._end_naming()
            return True
        return super().eventFilter(watched, event)

    def show_side(self, side: int) -> None:
        """Show that the listing is that of `A` or `B`."""
        self.sides.blockSignals(True)
        self.sides.setCurrentIndex(side)
        self.sides.blockSignals(False)

    def show_message(self, text: str, *, is_problem: bool = False) -> None:
        """Say one sentence, HTML, below the listing; empty: none. A problem is read out with the editor."""
        self.message.setText(text)
        set_role(self.message, "bad" if is_problem else "muted")
        self.message.setVisible(bool(text))
        self._fit_message()
        said = QTextDocumentFragment.fromHtml(text).toPlainText()
        self.editor.setAccessibleDescription(said if is_problem else "")
        if is_problem:
            announce(self.editor, said)

    def _fit_message(self) -> None:
        """Give the sentence the height that it needs, and the listing the rest."""
        self.message.setFixedHeight(max(self.message.heightForWidth(max(self.width(), 1)), 0))
        if (self.message.isHidden(), self.message.height()) != self._message_room:
            self._message_room = self.message.isHidden(), self.message.height()
            self.listing.room_changed.emit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Break the sentence anew in another width."""
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self._fit_message()

    def begin_editing(self, text: str, line: int) -> None:
        """Put the editor in the place of the listing, on a line (from 1)."""
        self.stack.setCurrentWidget(self.editor)
        self.edit_button.setChecked(True)
        self.editor.begin(text, line)

    def end_editing(self) -> None:
        """Put the listing back in the place of the editor; the edit stays."""
        had_focus = self.editor.hasFocus()
        self.edit_button.setChecked(False)
        self.stack.setCurrentWidget(self.listing)
        if had_focus:
            self.listing.setFocus(Qt.FocusReason.OtherFocusReason)

    @Slot()
    def _toggle(self) -> None:
        if self.is_editing:
            self.edit_button.setChecked(True)
            self.editor.left.emit()
        else:
            self.edit_button.setChecked(False)
            self.edit_requested.emit(0)

    @Slot(int)
    def _choose_side(self, side: int) -> None:
        self.side_chosen.emit(side)

    @Slot(object, int)
    def _add_to_menu(self, menu: QMenu, line: int) -> None:
        """Offer the edit of a line in the menu of the listing, or say why it is not offered."""
        menu.addSeparator()
        head = self._head
        text = f"Edit line {line}" if line else "Edit"
        edit = QAction(head.refusal or text, menu, enabled=not head.refusal)
        edit.triggered.connect(lambda: self.edit_requested.emit(line))
        menu.addAction(edit)
        if head.is_edited:
            menu.addAction("Name your version …", self.ask_name)
        if head.resets:
            menu.addAction(f"Take back {head.resets}", self.reset_requested.emit)

    @Slot()
    def _follow_theme(self) -> None:
        """Be as low as what is clicked may be: the listing needs the room."""
        self.head.setFixedHeight(max(LEAST_TARGET, round(HEAD_HEIGHT * current_theme().text_px)))
