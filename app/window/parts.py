"""What a window is made of beside its pages: what it says, what lies over them, how parts reach each other."""

import sys
import traceback
from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import TracebackType

from PySide6.QtCore import QObject, Signal, Slot
from PySide6.QtWidgets import QMainWindow, QStatusBar, QWidget

from app.pages.page_bar import Pages
from app.pages.step.page import StepPage
from app.session.document_edits import DocumentEdits
from app.session.session import Session
from app.window.appearance import Appearance
from app.window.file_desk import ExportActions, FileActions
from app.window.keys import LOCAL_KEYS, KeyAction, KeyDesk, key_text
from app.window.menus import Menus
from core.records.words import nouns, sentence_case
from core.trace.conditions import variable_names
from widgets.basics.accessibility import announce
from widgets.basics.key_pages import KeyEntry, KeyHelp
from widgets.basics.message_bar import Message, MessageBar, MessageKind
from widgets.basics.prompts import AskBar, Entry, QuickChooser

# What the window says without stopping anything: hints in the status bar, messages in the bar of messages.


HINT_MILLISECONDS = 8000
"""How long a hint stays in the status bar."""


class Notices(QObject):
    """Puts what is to be said where it belongs."""

    def __init__(self, hints: QStatusBar, messages: MessageBar, parent: QObject) -> None:
        super().__init__(parent)
        self._hints, self._messages = hints, messages
        self._warned: tuple[QObject | None, Message | None] = None, None
        """Who sent the last message that stays, and the message."""
        self._refused: Message | None = None
        """Why the last edit of the scene was not taken."""

    @Slot(str)
    def tell(self, text: str, kind: MessageKind = MessageKind.INFORMATION, details: str = "") -> None:
        """Show a message; what only informs goes to the status bar, so that the page does not move while one steps."""
        text = sentence_case(text)
        if kind is MessageKind.INFORMATION and not details:
            self._hints.showMessage(text, HINT_MILLISECONDS)
            announce(self._hints, text)
        else:
            self._stay(Message(kind, text, details))

    def _stay(self, message: Message) -> None:
        self._warned = self.sender(), message
        self._messages.show_message(message)

    @Slot()
    def settle(self) -> None:
        """Take away what the sender has said before, if it is still shown: what was refused then has gone well now."""
        sender, message = self._warned
        if sender is self.sender():
            self._messages.take_back(message)

    @Slot(str)
    def warn(self, text: str) -> None:
        """Show a warning."""
        self.tell(text, MessageKind.WARNING)

    @Slot(str)
    def refuse(self, text: str) -> None:
        """Warn that an edit of the scene was not taken, until another one is."""
        self.warn(text)
        self._refused = self._warned[1]

    @Slot()
    def settle_edit(self) -> None:
        """Take the warning about a refused edit away: the scene has been edited since."""
        self._messages.take_back(self._refused)

    @Slot(object)
    def show_message(self, message: Message) -> None:
        """Show a message that is made already, in the bar of messages where it offers something."""
        if message.kind is MessageKind.INFORMATION:
            self.settle()
        if message.action:
            self._stay(replace(message, text=sentence_case(message.text)))
        else:
            self.tell(message.text, message.kind, message.details)

    @Slot(str)
    def end_hint(self, text: str) -> None:
        """Take a hint away that is true no longer, if it is still shown."""
        if self._hints.currentMessage() == sentence_case(text):
            self._hints.clearMessage()

    def report(self, kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        """Tell a mistake of the program in the window too; what is open is still there."""
        text = "".join(traceback.format_exception(kind, error, trace))
        print(text, file=sys.stderr)
        said = f"Something went wrong in the program ({kind.__name__}: {error}). The open scene is unchanged."
        self._messages.show_message(Message(MessageKind.ERROR, said, text))


# What lies over the page: the page of all keys, the list of scenes, the bar that asks for a pixel or a
# condition.


class Overlays(QObject):
    """Shows, places and closes the overlays, and takes what is typed into them."""

    triangle_requested = Signal(int)
    """The user wants this triangle in focus."""

    def __init__(self, page: StepPage, below: QWidget, window: QWidget, actions: Sequence[KeyAction]) -> None:
        """Lie in ``window``, inside of its part ``below``."""
        super().__init__(window)
        self._page, self._session, self._below = page, page.session, below
        self.key_help = KeyHelp(window)
        self.key_help.hide()
        self.key_help.closed.connect(self.key_help.hide)
        self.key_help.change_wanted.connect(self.change_keys)
        self.keys = KeyDesk(window, actions)
        self.scenes = QuickChooser("Open", "File…", "Open a mesh or a state from any folder", window)
        self.ask_bar = AskBar(window)
        self.ask_bar.text_entered.connect(self._take_answer)

    def show_page(self, name: str) -> None:
        """Show the keys of a page and those of all pages."""
        self.show_keys(name)
        self.ask_bar.hide()
        self.scenes.hide()

    def show_keys(self, name: str) -> None:
        """Show the keys as they are now on the page of keys."""
        table = self.keys.choices.table((*self.keys.actions, *LOCAL_KEYS))
        actions = [action for action in table if action.keys and action.page in ("", name)]
        self.key_help.show_keys([KeyEntry(a.group, key_text(a), a.title) for a in actions])

    def place(self) -> None:
        """Keep what lies over the page inside of it."""
        inside = self._below.geometry()
        for whole in (self.key_help, self.keys.editor, self.scenes):
            if whole.isVisible():
                whole.setGeometry(inside.adjusted(24, 24, -24, -24))
        if self.ask_bar.isVisible():
            width = min(inside.width() - 48, 720)
            height = max(self.ask_bar.heightForWidth(width), self.ask_bar.sizeHint().height())
            self.ask_bar.setGeometry(inside.center().x() - width // 2, inside.top() + 8, width, height)

    def all(self) -> tuple[QWidget, ...]:
        """Return all overlays, the topmost first."""
        return self.keys.editor, self.key_help, self.scenes, self.ask_bar

    def close_top(self) -> bool:
        """Close the overlay on top; return whether there was one."""
        for overlay in self.all():
            if overlay.isVisible():
                overlay.hide()
                return True
        return False

    def toggle_keys(self) -> None:
        """Show or hide the page of all keys."""
        self.key_help.setVisible(not self.key_help.isVisible())
        self.place()
        self.key_help.raise_()

    @Slot()
    def change_keys(self) -> None:
        """Show the page on which keys are changed."""
        self.key_help.hide()
        self.keys.editor.show()
        self.keys.show_table()
        self.place()
        self.keys.editor.raise_()

    def choose_scene(
        self, groups: Mapping[str, Sequence[Entry]], first: str, about: Mapping[str, str]
    ) -> None:
        """Offer what can be opened, beginning at the entry ``first``; ``about``: more to find entries by."""
        self.scenes.ask(groups, first, about)
        self.place()

    def ask_pixel(self) -> None:
        """Ask for a pixel to pin."""
        first_column, first_row, end_column, end_row = self._session.trace.source.raster.bounds
        hint = f"Column {first_column} to {end_column - 1}, row {first_row} to {end_row - 1}, as 12, 7."
        self._ask("pixel", "Go to pixel", hint)

    def ask_triangle(self) -> None:
        """Ask for a triangle to bring into focus."""
        title = f"Go to {nouns(self._session.document.scene.corner_count).one}"
        self._ask("triangle", title, f"Number 0 to {self._session.document.triangle_count - 1}.")

    def ask_condition(self) -> None:
        """Ask for the condition of a breakpoint."""
        names = ", ".join(variable_names(self._session.stage_trace))
        hint = f"F5 stops where the condition holds. Names: {names}. Leave it empty for no condition."
        self._ask("condition", "Break where", hint, self._page.stepping.breaks.condition)

    def ask_note(self) -> None:
        """Ask for the note of the bookmark at this step, which is made if there is none."""
        mark = self._page.stepping.bookmarks.here()
        hint = "Why this step is worth coming back to. Step, Bookmarks lists all notes."
        self._ask("note", "Bookmark note", hint, mark.note if mark else "")

    def _ask(self, name: str, label: str, hint: str, text: str = "") -> None:
        self.ask_bar.ask(name, label, hint, text)
        self.place()
        self.ask_bar.raise_()

    @Slot(str, str)
    def _take_answer(self, name: str, text: str) -> None:
        try:
            if name == "pixel":
                self._go_to_pixel(text)
            elif name == "triangle":
                self._go_to_triangle(text)
            elif name == "note":
                self._page.stepping.bookmarks.describe(text.strip())
            else:
                self._page.stepping.set_condition(text)
        except ValueError as error:
            self.ask_bar.show_problem(f"{error}")
            self.place()
        else:
            self.ask_bar.hide()
            self._page.grid.setFocus()

    def _go_to_triangle(self, text: str) -> None:
        last = self._session.document.triangle_count - 1
        if not text.strip().isdecimal() or int(text) > last:
            wanted = f"Enter a {nouns(self._session.document.scene.corner_count).one}'s number"
            raise ValueError(f"{wanted}, 0 to {last}; got “{text}”.")
        self.triangle_requested.emit(int(text))

    def _go_to_pixel(self, text: str) -> None:
        parts = text.replace(",", " ").split()
        if len(parts) != 2 or not all(part.isdecimal() for part in parts):
            raise ValueError(f"Enter column and row, such as 12, 7; got “{text}”.")
        pixel = int(parts[0]), int(parts[1])
        if not self._session.moment.has_pixel(pixel):
            raise ValueError(f"Pixel ({pixel[0]}, {pixel[1]}) is not in the raster.")
        self._session.set_pin(pixel)


# What a window is made of: its parts reach each other through it, and know no more of it than this.


class WindowParts(QMainWindow):
    """One session, the pages around it, and what is around the pages."""

    session: Session
    pages: Pages
    page: StepPage
    messages: MessageBar
    notices: Notices
    menus: Menus
    appearance: Appearance
    edits: DocumentEdits
    overlays: Overlays
    files: FileActions
    exports: ExportActions

    @abstractmethod
    def run_action(self, name: str) -> None:
        """Do an action of the table of actions."""

    @abstractmethod
    def open_path(self, path: str, allows_outside: bool = False) -> None:
        """Open a scene or a state, or what a page knows how to show, on that page."""

    @abstractmethod
    def show_printed(self, name: str) -> None:
        """Show the right method in A, and a listing as a slide prints it in B."""
