"""What the window says without stopping anything: hints in the status bar, messages in the bar of messages."""

import sys
import traceback
from dataclasses import replace
from types import TracebackType

from PySide6.QtCore import QObject, Slot
from PySide6.QtWidgets import QStatusBar

from core.records.sentences import sentence_case
from widgets.basics.accessible import announce
from widgets.basics.message_bar import Message, MessageBar, MessageKind

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
