"""Starting the window: what it shows first, how it looks, a picture of it, and the signals that end it."""

import os
import signal
import socket
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from time import monotonic
from types import FrameType
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QSize, QSocketNotifier, Qt, Signal, Slot
from PySide6.QtWidgets import QApplication

from app.background import Collecting, is_work_left
from app.export.views import export_widget
from app.files.file_access import FileWriteError
from app.files.open_any import Opened, open_any
from app.files.preferences import load_preferences
from app.files.saved_windows import EarlierWindow, WindowFile, earlier_windows, remove_oldest_windows
from app.files.user_folders import has_answers, preferences_folder
from app.pages.page_table import page_of_file
from app.session.document import with_settings
from app.usage import UsageError
from app.window.appearance import sized_theme, the_application
from app.window.main_window import MainWindow
from core.fast_path.workers.band_workers import BandWorkers
from core.records.words import sentences
from core.settings import Settings
from core.trace.run_to import START
from lessons.os_errors import problem_text
from lessons.run_place import RunPlace
from lessons.scenes import CATALOGUE
from widgets.basics.message_bar import Message, MessageKind
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import Theme

if TYPE_CHECKING:
    from app.window.unattended import PageContent


# Signals that end the program: SIGTERM, SIGHUP and Ctrl+C close the window, which saves what is open.


PATIENCE = 3.0
"""Seconds after the first signal in which others change nothing: longer than closing takes."""
NAMES = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
"""Not every system has all of them."""


class EndSignals(QObject):
    """Listens to the signals, and reports the first one; one that comes much later ends the program at once.

    Qt's event loop is not Python, and Python handles a signal only between two of its own instructions. So Python
    writes the number of the signal into a socket, and Qt wakes up when there is something to read in it.
    """

    received = Signal(int)
    """The number of a signal."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._first_at: float | None = None
        self._reader, self._writer = socket.socketpair()
        for end in (self._reader, self._writer):
            end.setblocking(False)
        self._notifier = QSocketNotifier(self._reader.fileno(), QSocketNotifier.Type.Read, self)
        self._notifier.activated.connect(self._read)
        signal.set_wakeup_fd(self._writer.fileno(), warn_on_full_buffer=False)
        for number in (getattr(signal, name) for name in NAMES if hasattr(signal, name)):
            # A program that was started to outlive its terminal, as by nohup, still does.
            if signal.getsignal(number) != signal.SIG_IGN:
                signal.signal(number, self._take)

    def stop(self) -> None:
        """Do not listen any more."""
        signal.set_wakeup_fd(-1)
        self._notifier.setEnabled(False)
        self._reader.close()
        self._writer.close()

    def _take(self, number: int, frame: FrameType | None) -> None:
        # Whoever ends a group of processes may well send two signals at once: the first is still being obeyed.
        if self._first_at is None:
            self._first_at = monotonic()
        elif monotonic() - self._first_at > PATIENCE:
            signal.signal(number, signal.SIG_DFL)
            signal.raise_signal(number)

    @Slot()
    def _read(self) -> None:
        self._notifier.setEnabled(False)
        self.received.emit(self._reader.recv(1)[0])


# What a window shows first: what was open last, and an offer to restore what a window left that was not
# closed.


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


# Starting the window: what it shows first, how it looks, and a picture of it without showing it.


PART_OF_SCREEN = 0.85
TITLE_ROOM = 40
"""Height that the window's title takes of the screen, in logical pixels."""


def theme_of(name: str, application: QApplication, text_size: int = 100) -> Theme:
    """Return the theme of a name, with text of a size in percent; ``system`` and 0 follow the desktop."""
    is_dark = name.endswith("dark")
    if name == "system":
        is_dark = application.styleHints().colorScheme() == Qt.ColorScheme.Dark
    return sized_theme("dark" if is_dark else "light", text_size)


def first_size(application: QApplication) -> QSize:
    """Return the size that the window has at first: most of the screen, and never more than it has."""
    screen = application.primaryScreen().availableSize()
    wanted = QSize(1280, 800).expandedTo(screen * PART_OF_SCREEN)
    return wanted.boundedTo(screen - QSize(0, TITLE_ROOM))


def run_window(target: str | None = None, allows_outside: bool = False) -> int:
    """Show the window until it is closed; return the exit code.

    Parameters
    ----------
    target : str, optional
        Mesh file, state file or built-in scene; what was open last by default. Where it cannot be opened, the window
        says so and shows what it would show without it.
    allows_outside : bool
        Whether files that it names may be read from outside its folder.
    """
    application = the_application()
    collecting = Collecting(application)
    application.setApplicationName("Rasterscope")
    preferences, warning = load_preferences()
    apply_theme(application, theme_of(preferences.theme, application, preferences.text_size))
    first = reopen(is_replaced=target is not None)
    window = MainWindow(first.opened.document, preferences)
    window.page.views.scene_presenter.draw_with(BandWorkers())
    window.files.show_opened(first.opened, window.session.trace)
    if has_answers():
        from app.window.kept_question import KeptQuestion  # Who answers no exercises does not wait for it.

        KeptQuestion(window.session, window.pages, window)
    window.resize(first_size(application))
    window.memory.restore(window)
    window.memory.autosave.begin(first.file, None if first.file else first.opened.document)
    application.commitDataRequest.connect(window.memory.autosave.ask)
    signals = EndSignals(window)
    signals.received.connect(window.end_by_signal)
    sys.excepthook = window.notices.report
    # Over a restored scene only where it is wanted.
    is_restored = first.opened.state is not None or first.message is not None
    shows_start = preferences.shows_start or not is_restored
    if target is None and shows_start:
        window.pages.show_page("start")  # Before the window is there: no other page is laid out for it.
    window.show()
    window.setFocus(Qt.FocusReason.OtherFocusReason)
    if warning:
        window.notices.warn(warning)
    if first.message is not None:
        window.offer(first.message, first.offered)
    if target is not None:
        window.open_first(target, allows_outside, shows_start)
    elif shows_start:
        window.pages.current.take_focus()
    code = application.exec()
    sys.excepthook = sys.__excepthook__
    window.close_anyway()
    signals.stop()
    if is_work_left():
        # Python would wait for its threads; everything is saved, and no result is wanted any more.
        for stream in (sys.stdout, sys.stderr):
            if stream is not None:
                stream.flush()
        os._exit(code)
    collecting.stop()
    return code


def grab_window(
    target: str,
    path: str,
    size: tuple[int, int] = (1280, 800),
    theme: str = "light",
    stage: str | None = None,
    step: int | None = None,
    view: str | None = None,
    choose: Callable[[Settings], Settings] | None = None,
    content: "PageContent | None" = None,
    allows_outside: bool = False,
) -> None:
    """Save a picture of the window, as it shows a file or a built-in scene, without showing it.

    Parameters
    ----------
    target : str
        A mesh, a state, the name of a built-in scene, or a saved study or atlas, which is shown on its page.
    stage : str, optional
        A stage of ``core.STAGES``; by default the one that a state file was saved at, or that a scene opens in.
    step : int, optional
        Position in the stage, in operations done; by default all of them, of a built-in scene without a ``stage`` and
        with its own settings those at which it opens.
    view : str, optional
        Main view, as ``pixels`` or ``scene``.
    choose : callable, optional
        Takes the document's settings and returns those that are shown.
    content : PageContent, optional
        Another page, and what it is filled with; by default the Step page, or that of a saved study or atlas.
    allows_outside : bool
        Whether files that it names may be read from outside its folder.

    Raises
    ------
    ValueError, OSError
        If the file cannot be opened, the picture not be written, or there is no such view, family or experiment.
    """
    application = the_application()
    apply_theme(application, theme_of(theme, application))
    is_saved = bool(page_of_file(target))
    opened = open_any(CATALOGUE[0].name if is_saved else target, allows_outside=allows_outside)
    document = opened.document
    if choose is not None:
        document = with_settings(document, choose(document.settings))
    is_whole = stage is not None or step is not None
    if opened.state is None and (is_whole or document.settings != opened.document.settings):
        is_whole, opened = True, replace(opened, place=RunPlace(opened.place.stage))
    window = MainWindow(document)
    state = None if opened.state is None else replace(opened.state, document=document)
    window.files.show_opened(replace(opened, document=document, state=state))
    if is_whole or (opened.state is None and opened.place.at == START):
        window.session.set_stage(stage or window.session.cursor.stage, step)
    if view is not None and view not in window.page.view_names():
        raise UsageError(f"view must be one of {', '.join(window.page.view_names())}, got {view}")
    if view is not None:
        window.page.show_view(view)
    window.resize(*size)
    window.setAttribute(Qt.WidgetAttribute.WA_DontShowOnScreen)
    window.show()
    if theme.startswith("presenter"):
        window.presenter.arrange()
    try:
        if is_saved or content is not None:
            _fill(window, target if is_saved else "", content)
        for _ in range(20):
            application.processEvents()
        window.page.settle()
        export_widget(window, path)
    finally:
        window.hide()
        for page in window.pages.made:
            page.stop()


def _fill(window: MainWindow, saved: str, content: "PageContent | None") -> None:
    """Show a saved study or atlas, or fill a page."""
    from app.window.unattended import (  # Imports all pages: not before one is opened.
        fill_page,
        open_saved,
    )

    if saved:
        open_saved(window, saved)
    elif content is not None:
        fill_page(window, content)
