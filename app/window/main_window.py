"""The main window: its layout, what it connects, and what it shows of the session beside the page."""

from pathlib import Path

from PySide6.QtCore import QEvent, Qt, Slot
from PySide6.QtGui import QCloseEvent, QContextMenuEvent, QDragEnterEvent, QDropEvent, QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QLabel, QStatusBar

from app.background import ending_within
from app.files.preferences import Preferences
from app.files.user_folders import is_lesson_file
from app.help.pane import HelpPane
from app.pages.cover import COVERED
from app.pages.lessons.presenter import BEGINNING, WAY_BACK
from app.pages.page_bar import Page, Pages
from app.pages.page_table import PAGE_KINDS, StepOpening, page_of_file
from app.pages.step.page import StepPage
from app.session.document import Document
from app.session.document_edits import DocumentEdits
from app.session.moment import Change
from app.session.session import Session
from app.window.action import ActionWindow
from app.window.actions import ACTIONS, ACTIONS_BY_NAME
from app.window.appearance import Appearance, the_application
from app.window.file_desk import READ_OUTSIDE, ExportActions, FileActions
from app.window.focus_walk import FocusWalk
from app.window.keys import KeyChoices, has_use_for
from app.window.menus import AS_PRINTED, Menus
from app.window.parts import Notices, Overlays
from app.window.presenter import Presenter
from app.window.remembering import Remembering
from core.records.words import sentences
from widgets.basics.accessibility import install_roles
from widgets.basics.message_bar import Message, MessageBar, MessageKind

OF_VIEW = ("export_view", "copy_view", "print_view")
"""Actions that hand out what the page shows."""
BY_SIGNAL = 128
"""Exit code of a program that a signal has ended, less the signal's number."""
SECONDS_TO_END = 1.0
"""How long a window that closes waits for its work."""
SMALLEST = (800, 500)
"""Least size of the window: 1920 x 1080 pixels at 200 % leave 960 x 540, and a title."""
CLOSE_UNSAVED = "Close without saving"
"""The button that closes a window although what is open could not be saved."""


class MainWindow(ActionWindow):
    """One session and the pages around it."""

    def __init__(self, document: Document, preferences: Preferences | None = None) -> None:
        super().__init__()
        install_roles()
        self.session = Session(document, self)
        self.messages = MessageBar(self)
        self._hints = QStatusBar(self)
        self.pages = Pages(PAGE_KINDS, self.session, self._hints, self.messages, "step", self)
        step_page = self.pages.page("step")
        assert isinstance(step_page, StepPage)
        self.page = step_page
        self._raster = self.session.document.raster
        """The raster that is shown; a notice names the next one, in which pixels have other sizes and numbers."""
        self._closes_unsaved = self._starts_over = False
        self._offered = ""
        """Path of the state that the message bar offers to open."""
        self._lay_out()
        self.notices = Notices(self._hints, self.messages, self)
        self.menus = Menus(self, ACTIONS)
        self.appearance = Appearance(self)
        self.presenter = Presenter(self)
        self.edits = DocumentEdits(self.session, self)
        self.overlays = Overlays(self.page, self.pages, self, ACTIONS)
        self.help = HelpPane(self, _help_body)
        self.files = FileActions(self.page, self.pages, self.messages, self.appearance, self)
        self.exports = ExportActions(self.pages, self)
        self.memory = Remembering(self, preferences or Preferences())
        self.menus.show_recent(self.memory.preferences.recent_files)
        self.opening = StepOpening(self.session, self.page, self)
        self.focus_walk = FocusWalk(self, self.help)
        self.setAcceptDrops(True)
        self.setMinimumSize(*SMALLEST)
        self._connect()
        self._take_page(self.page)
        self._show_page("step")
        self._show_document()

    # Layout.

    def _lay_out(self) -> None:
        self.setCentralWidget(self.pages)
        self.messages.clear()
        self.pointed = QLabel(self)
        self.pointed.setContentsMargins(0, 0, 8, 0)
        self._hints.addPermanentWidget(self.pointed)
        self._hints.setSizeGripEnabled(False)

    def statusBar(self) -> QStatusBar:
        """Return the bar of hints; it stands beside the names of the pages, for the picture needs the room below."""
        return self._hints

    def _connect(self) -> None:
        session, page, menus, notices = self.session, self.page, self.menus, self.notices
        session.changed.connect(self._follow)
        self.pages.page_made.connect(self._take_page)
        self.pages.page_changed.connect(self._show_page)
        self.pages.cover.back_requested.connect(self._show_asker)
        self.pages.cover.leave_requested.connect(page.lessons.close)
        page.timeline.speed_changed.connect(self.memory.remember_speed)
        page.stepping.message_ended.connect(notices.end_hint)
        page.stepping.bookmarks.bookmarks_changed.connect(self._show_bookmarks)
        page.panes_changed.connect(self._show_checks)
        page.views.triangle_picked.connect(self.edits.focus_triangle)
        page.main_area.view_changed.connect(self._show_checks)
        menus.action_chosen.connect(self.run_action)
        menus.scene_chosen.connect(self.open_path)
        menus.recent_chosen.connect(self.open_path)
        menus.printed_chosen.connect(self.show_printed)
        menus.lesson_chosen.connect(page.lessons.open)
        menus.raster_chosen.connect(self.edits.choose_raster)
        menus.theme_chosen.connect(self.appearance.set_theme)
        self.presenter.presenting_changed.connect(self.help.put_aside)
        self.presenter.presenting_changed.connect(self._show_checks)
        self.appearance.theme_changed.connect(self.memory.remember_theme)
        self.appearance.theme_changed.connect(self.menus.show_theme)
        menus.text_size_chosen.connect(self.appearance.set_text_size)
        self.appearance.text_size_changed.connect(self.memory.remember_text_size)
        self.appearance.text_size_changed.connect(self.menus.show_text_size)
        self.opening.message_sent.connect(notices.show_message)
        self.opening.opened.connect(self._show_step)
        self.edits.edit_refused.connect(self._refuse)
        self.overlays.keys.keys_changed.connect(self._take_keys)
        self.overlays.keys.set_choices(self.memory.key_choices(ACTIONS))
        self.overlays.triangle_requested.connect(self.edits.focus_triangle)
        self.edits.edit_pointless.connect(self._tell_pointless)
        self.files.path_chosen.connect(self.open_path)
        self.overlays.scenes.chosen.connect(self._open_listed)
        self.overlays.scenes.other_wanted.connect(self.files.ask_file)
        self.files.message_sent.connect(notices.show_message)
        self.exports.message_sent.connect(notices.show_message)
        menus.scale_chosen.connect(self.exports.set_scale)
        self.files.file_used.connect(self.memory.remember_file)
        self.files.ended.connect(self._end_opening)
        self.memory.recent_changed.connect(self.menus.show_recent)
        self.memory.autosave.failed.connect(notices.warn)
        self.memory.autosave.recovered.connect(self._tell_saved_again)
        self.files.progress.edit_cancelled.connect(self.edits.cancel)
        self.messages.action_requested.connect(self._open_offered)

    # Actions by key and menu.

    @Slot(str)
    def run_action(self, name: str) -> None:
        """Do what the key of this name does."""
        action = ACTIONS_BY_NAME[name]
        is_of_page = action.page == self.pages.current_name or name in OF_VIEW
        if self.pages.is_covered and is_of_page:
            self.notices.tell(COVERED[self.session.asker])
        else:
            action.do(self)
        if action.is_checkable:
            self._show_checks()

    @Slot()
    def _show_checks(self) -> None:
        """Show in the menus what is on."""
        for action in ACTIONS:
            if action.is_on is not None:
                self.menus.show_checked(action.name, action.is_on(self))

    @Slot(object)
    def _refuse(self, error: Exception) -> None:
        """Say why an edit came to nothing, and show again what is there."""
        self.notices.refuse(f"{error}")
        self.page.scene.refresh(self.session.moment)
        self._show_document()

    @Slot(str)
    def _tell_pointless(self, text: str) -> None:
        self.notices.tell(text)
        self._show_document()

    @Slot(object)
    def _take_keys(self, choices: KeyChoices) -> None:
        """Let other keys do things, show them, and remember them."""
        self.menus.show_keys(choices)
        self.overlays.show_keys(self.pages.current_name)
        self.memory.remember_keys(choices)

    # Pages.

    @Slot(object)
    def _take_page(self, page: Page) -> None:
        """Listen to a page that has just been made, and give its panes the sizes that they had."""
        page.message_sent.connect(self.notices.tell)
        page.edit_refused.connect(self.notices.refuse if page is self.page else self.notices.warn)
        page.went_well.connect(self.notices.settle)
        page.step_requested.connect(self.opening.open_request)
        page.question_requested.connect(self._ask_question)
        page.action_requested.connect(self.run_action)
        page.open_requested.connect(self.open_path)
        page.help_requested.connect(self.help.show_page)
        page.link_requested.connect(self.help.follow)
        page.lesson_requested.connect(self._open_lesson)
        page.preference_changed.connect(self.memory.remember)
        self.memory.restore_page(page)

    @Slot(str)
    def _show_page(self, name: str) -> None:
        """Let the keys and menus be those of the page that is shown now."""
        self.menus.show_page(name)
        self._show_checks()
        self.overlays.show_page(name)
        self.pages.current.show_preferences(self.memory.preferences)
        self._show_pointed()
        lessons = self.page.lessons
        self.pages.current.show_way_back(lessons.is_open, lessons.asked_on(name))

    @Slot()
    def _show_step(self) -> None:
        self.pages.show_page("step")

    @Slot()
    def _show_asker(self) -> None:
        self.pages.show_page("step" if self.session.asker == "lesson" else "exercises")

    @Slot(str, int)
    def _open_lesson(self, name: str, step: int) -> None:
        """Open a lesson on the Step page, at one of its steps from 0."""
        self.pages.show_page("step")
        self.page.lessons.open(name, step or None)

    @Slot(str)
    def _ask_question(self, line: str) -> None:
        """Ask the question of a line on the Exercises page."""
        from app.pages.exercises.page import ExercisesPage  # As in app.pages.page_table.

        self.pages.show_page("exercises")
        page = self.pages.current
        assert isinstance(page, ExercisesPage)
        page.open_line(line)

    # Showing the state.

    @Slot(Change)
    def _follow(self, what: Change) -> None:
        if Change.DOCUMENT in what:
            self._show_document()
            self.notices.settle_edit()
        elif what & (Change.POINTING | Change.CURSOR):
            self._show_pointed()
        if what & (Change.DOCUMENT | Change.PREDICTING):
            self._show_checks()

    @Slot()
    def _show_document(self) -> None:
        document = self.session.document
        self.setWindowTitle(f"{document.title} – Rasterscope" if document.title else "Rasterscope")
        self.menus.show_kind(document.scene.corner_count)
        if document.raster != self._raster:
            self._raster = document.raster
            if not self.page.lessons.is_open:  # There every step may have another one.
                self.notices.tell(f"Raster: {document.raster.label.lower()}.")
        self._show_pointed()

    @Slot()
    def _show_bookmarks(self) -> None:
        bookmarks = self.page.stepping.bookmarks
        self.menus.show_bookmarks([bookmarks.text(index) for index in range(len(bookmarks.marks))])

    @Slot()
    def _show_pointed(self) -> None:
        is_stepping = self.pages.current is self.page
        pixel = (self.session.hover or self.session.pin) if is_stepping else None
        self.pointed.setText(
            f"pixel ({pixel[0]}, {pixel[1]})   {self.page.pointed_text(pixel)}" if pixel else ""
        )

    # Coming and going.

    def offer(self, message: Message, path: str) -> None:
        """Show a message until it is dismissed; its action opens a state."""
        self._offered = path
        self.messages.stand(message)

    @Slot(object)
    def _open_offered(self, message: Message) -> None:
        if message.action == READ_OUTSIDE:
            self.open_path(self.files.target, allows_outside=True)
        elif message.action == CLOSE_UNSAVED:
            self.close_anyway()
        else:
            self.open_path(self._offered)

    @Slot(int)
    def end_by_signal(self, number: int) -> None:
        """Close, and end the program with the exit code that a shell has for a program ended by this signal."""
        self.close_anyway()
        the_application().exit(BY_SIGNAL + number)

    def close_anyway(self) -> None:
        """Close, also where what is open cannot be saved: that is one line on stderr then."""
        self._closes_unsaved = True
        self.close()

    def _tell_unsaved(self, reason: str) -> None:
        text = sentences(
            f"The window stays open: what is open could not be saved for the next start: {reason}",
            "Make room and close again, or save it elsewhere (Ctrl+S)",
        )
        self.messages.show_message(Message(MessageKind.ERROR, text, action=CLOSE_UNSAVED))

    @Slot()
    def _tell_saved_again(self) -> None:
        self.messages.show_message(Message(MessageKind.INFORMATION, "What is open is saved again."))

    def closeEvent(self, event: QCloseEvent) -> None:
        """Remember window, panes and scene, end all work, then close; stay open where the scene cannot be saved."""
        self.presenter.leave()
        with ending_within(SECONDS_TO_END):
            unsaved = self.memory.save_open(self._closes_unsaved)
            if unsaved and not self._closes_unsaved:
                event.ignore()
                self._tell_unsaved(unsaved)
                return
            self.memory.save_preferences(self)
            for page in self.pages.made:
                page.stop()
            self.files.shut_down()
            self.opening.shut_down()
            self.session.tracing.shut_down()
        super().closeEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep inside what lies over the page."""
        super().resizeEvent(event)
        self.overlays.place()
        self.presenter.place()

    def focusNextPrevChild(self, is_next: bool) -> bool:
        """Let Tab and Shift+Tab go the same way, forth and back."""
        return self.focus_walk.go(is_forward=is_next)

    def event(self, event: QEvent) -> bool:
        """Leave a control that Tab has reached the keys it needs: Space presses a button, it does not play."""
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.ShortcutOverride:
            is_needed = not self.focus_walk.is_by_mouse and has_use_for(self.focusWidget(), event)
            if is_needed:
                event.accept()
                return True
        return super().event(event)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Ask what the terms of a text are: a widget without a menu of its own leaves the click to the window."""
        is_by_key = event.reason() == QContextMenuEvent.Reason.Keyboard
        widget = self.focusWidget() if is_by_key else self.childAt(event.pos())
        event.setAccepted(self.help.open_menu(event.globalPos(), widget))

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Take files: they are read, so none may be moved, which some desktops propose."""
        if event.mimeData().hasUrls():
            event.setDropAction(Qt.DropAction.CopyAction)
            event.accept()

    def dropEvent(self, event: QDropEvent) -> None:
        """Open the file that was dropped."""
        event.setDropAction(Qt.DropAction.CopyAction)
        event.accept()
        paths = [url.toLocalFile() for url in event.mimeData().urls() if url.isLocalFile()]
        if len(paths) > 1:
            self.notices.tell(f"One file at a time: opening {Path(paths[0]).name}.")
        if paths:
            self.open_path(paths[0])

    @Slot(str)
    def show_printed(self, name: str) -> None:
        """Show the right method in A, and a listing as a slide prints it in B, where they first differ."""
        self.pages.show_page("step")
        try:
            self.page.comparing.show_printed(name)
        except ValueError as error:
            self._refuse(error)
            return
        self.page.show_view("compare")

    @Slot(str)
    def open_path(self, path: str, allows_outside: bool = False) -> None:
        """Open a scene or a state, or what a page knows how to show, on that page.

        ``allows_outside``: files that it names may be read from outside its folder.
        """
        name = page_of_file(path)
        if is_lesson_file(path):
            self.pages.show_page("step")
            self.page.lessons.open_path(path)
        elif name:
            self.pages.show_page(name)
            self.pages.current.open_path(path)
        else:
            self.files.open_path(path, allows_outside)

    @Slot(str)
    def _open_listed(self, name: str) -> None:
        """Open an entry of the list: a place in a lesson, a printed listing, or what else has a path or a name."""
        if name in (WAY_BACK, BEGINNING):
            self.pages.show_page("step")
            self.page.lessons.open_path(name)
        elif name.startswith(AS_PRINTED):
            self.show_printed(name.removeprefix(AS_PRINTED))
        else:
            self.open_path(name)

    def open_first(self, path: str, allows_outside: bool, shows_start: bool) -> None:
        """Open what the program was started with; ``shows_start``: the start page where that cannot be opened."""
        self.pages.show_page("step")  # whatever page was shown last; a saved study or atlas goes to its own
        self._starts_over = shows_start
        self.open_path(path, allows_outside)

    @Slot(bool)
    def _end_opening(self, is_shown: bool) -> None:
        """Leave the start page for what was opened there; what could not be opened leaves it, or leads to it.

        Presenting, any page is left for what was opened: nobody sees the bar of pages.
        """
        if is_shown and (self.pages.current_name == "start" or self.presenter.is_presenting):
            self.pages.show_page("step")
        elif not is_shown and self._starts_over:
            self.pages.show_page("start")
        self._starts_over = False


def _help_body(address: str) -> tuple[str, str]:
    """Return title and HTML of a page of Help."""
    from app.help.library import page  # All methods and studies come along: not before Help is wanted.

    made = page(address)
    return made.title, made.html
