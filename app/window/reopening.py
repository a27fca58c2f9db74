"""What a window shows first: what was open last, and an offer to restore what a window left that was not closed."""

from dataclasses import dataclass, replace

from app.files.file_writing import FileWriteError
from app.files.open_any import Opened, open_any
from app.files.user_folders import preferences_folder
from app.files.window_files import EarlierWindow, WindowFile, earlier_windows, remove_oldest_windows
from core.records.sentences import sentences
from lessons.os_errors import problem_text
from lessons.scenes import CATALOGUE
from widgets.basics.message_bar import Message, MessageKind


@dataclass(frozen=True, eq=False)
class Reopened:
    """What a window begins with."""

    opened: Opened
    file: WindowFile | None = None
    """The file that it came from, and is saved to; ``None``: it is only shown because there is nothing else."""
    message: Message | None = None
    """What the user is to know of it."""
    offered: str = ""
    """Path of the state that the message offers; empty: none."""


def reopen(is_replaced: bool = False) -> Reopened:
    """Return what was open last.

    Parameters
    ----------
    is_replaced : bool
        Something else is opened next: what is returned is not to be written over by it.
    """
    stand_in = Reopened(open_any(CATALOGUE[0].name))
    try:
        folder = preferences_folder()
        earlier = earlier_windows(folder)
        remove_oldest_windows(folder)
    except OSError as problem:
        return replace(stand_in, message=Message(MessageKind.WARNING, str(problem)))
    lost = next((each for each in earlier if not each.was_closed), None)
    if earlier and earlier[0].was_closed:
        stand_in = _opened_again(earlier[0], stand_in, is_replaced)
    return stand_in if lost is None else _with_offer(stand_in, lost)


def _opened_again(last: EarlierWindow, stand_in: Reopened, is_replaced: bool) -> Reopened:
    """Return the state of the last window, or the stand-in where it cannot be opened: then it stays for later."""
    try:
        opened = open_any(str(last.path))
        return Reopened(opened, None if is_replaced else WindowFile(last.path))
    except FileWriteError as problem:
        return Reopened(opened, message=Message(MessageKind.WARNING, str(problem)))
    except (OSError, ValueError, MemoryError) as problem:
        text = sentences(
            f"The last scene could not be opened again: {problem_text(problem)}",
            "It is kept: File, Earlier windows",
        )
        return replace(
            stand_in, message=Message(MessageKind.WARNING, text, action="Try again"), offered=str(last.path)
        )


def _with_offer(shown: Reopened, lost: EarlierWindow) -> Reopened:
    """Return what is shown with the offer to restore what a window left that was not closed."""
    text = f"Rasterscope ended without closing its window ({lost.title}, saved {lost.when})."
    return replace(
        shown, message=Message(MessageKind.WARNING, text, action="Restore"), offered=str(lost.path)
    )
