"""The main window: its layout, what every action does, and how it comes back as it was left."""

import sys
import traceback
from collections.abc import Callable
from pathlib import Path
from types import TracebackType

from PySide6.QtCore import QByteArray, QEvent, Qt, Slot
from PySide6.QtGui import QCloseEvent, QDragEnterEvent, QDropEvent, QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QApplication, QLabel, QMainWindow, QVBoxLayout, QWidget

from app.document import Document
from app.document_edits import DocumentEdits
from app.file_desk import FileDesk
from app.key_focus import has_use_for
from app.look import Look, the_application
from app.menus import Menus
from app.overlays import Overlays
from app.preferences import Preferences, preferences_folder, save_preferences, with_recent_file
from app.session import Session
from app.state_files import EXTENSION, StateFileError, save_state
from app.step_page import StepPage
from core.scene import ClipScene
from core.steps import Level
from widgets.message_bar import Message, MessageBar, MessageKind

HINT_MILLISECONDS = 8000
"""How long a hint stays in the status bar."""


class MainWindow(QMainWindow):
    """One session and the pages around it."""

    def __init__(self, document: Document, preferences: Preferences | None = None) -> None:
        super().__init__()
        self.preferences = preferences or Preferences()
        self.session = Session(document, self)
        self.page = StepPage(self.session, self)
        self.messages = MessageBar(self)
        self._has_mouse_focus = False
        central = self._lay_out()
        self.menus = Menus(self)
        self.menus.show_recent(self.preferences.recent_files)
        self.look = Look(self)
        self.edits = DocumentEdits(self.session, self)
        self.overlays = Overlays(self.page, central, self)
        self.files = FileDesk(self.page, self.messages, self)
        self.setAcceptDrops(True)
        self.setMinimumSize(900, 600)
        self._connect()
        self._show_document()

    # Layout.

    def _lay_out(self) -> QWidget:
        central = QWidget(self)
        layout = QVBoxLayout(central)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(self.messages)
        layout.addWidget(self.page, 1)
        self.setCentralWidget(central)
        self.messages.clear()
        self.pointed = QLabel(self)
        self.pointed.setContentsMargins(0, 0, 8, 0)
        self.statusBar().addPermanentWidget(self.pointed)
        self.statusBar().setSizeGripEnabled(False)
        return central

    def _connect(self) -> None:
        session, page, menus = self.session, self.page, self.menus
        session.document_changed.connect(self._show_document)
        session.history_changed.connect(self._show_history)
        session.hover_changed.connect(self._show_pointed)
        session.pin_changed.connect(self._show_pointed)
        session.cursor_changed.connect(self._show_pointed)
        session.edit_failed.connect(self._edit_failed)
        page.message_sent.connect(self.tell)
        page.edit_refused.connect(self._warn)
        page.timeline.speed_changed.connect(self._remember_speed)
        page.views.triangle_picked.connect(self.edits.focus_triangle)
        page.view_bar.currentChanged.connect(self._show_view)
        menus.action_chosen.connect(self.run_action)
        menus.scene_chosen.connect(self.files.open_path)
        menus.recent_chosen.connect(self.files.open_path)
        menus.raster_chosen.connect(self.edits.choose_raster)
        menus.theme_chosen.connect(self.look.set_theme)
        self.look.theme_changed.connect(self._remember_theme)
        self.edits.edit_refused.connect(self.refuse)
        self.edits.edit_pointless.connect(self._tell_pointless)
        self.files.message_sent.connect(self._show_message)
        self.files.file_used.connect(self._remember_file)
        self.files.progress.edit_cancelled.connect(self._edit_cancelled)
        self.messages.message_dismissed.connect(self.messages.clear)
        the_application().focusChanged.connect(self._focus_moved)

    # Actions by key and menu.

    @Slot(str)
    def run_action(self, name: str) -> None:
        """Do what the key of this name does."""
        stepping = self.page.stepping
        for prefix, handler in (("stage_", stepping.choose_stage), ("bookmark_", stepping.go_to_bookmark)):
            if name.startswith(prefix):
                handler(int(name.removeprefix(prefix)))
                return
        self._handlers()[name]()

    def _handlers(self) -> dict[str, Callable[[], object]]:
        """Return what the actions of ``app.keys.ACTIONS`` do, those with a number in their name excepted."""
        page, session, stepping = self.page, self.session, self.page.stepping
        return {
            "step_forward": lambda: stepping.step(1),
            "step_back": lambda: stepping.step(-1),
            "larger_forward": lambda: stepping.step_larger(1),
            "larger_back": lambda: stepping.step_larger(-1),
            "level_in": lambda: stepping.change_level(1),
            "level_out": lambda: stepping.change_level(-1),
            "go_first": lambda: stepping.go_to_end(-1),
            "go_last": lambda: stepping.go_to_end(1),
            "toggle_play": stepping.toggle_play,
            "faster": lambda: page.timeline.change_speed(1),
            "slower": lambda: page.timeline.change_speed(-1),
            "visited_back": session.go_back,
            "visited_forward": session.go_forward,
            "next_at_pin": lambda: stepping.run_to_pin(1),
            "previous_at_pin": lambda: stepping.run_to_pin(-1),
            "next_event": lambda: stepping.run_to_event(1),
            "previous_event": lambda: stepping.run_to_event(-1),
            "run_forward": lambda: stepping.run_to_breakpoint(1),
            "run_back": lambda: stepping.run_to_breakpoint(-1),
            "toggle_breakpoint": stepping.toggle_pixel_breakpoint,
            "edit_condition": self.overlays.ask_condition,
            "toggle_bookmark": stepping.toggle_bookmark,
            "next_stage": lambda: session.next_stage(1),
            "previous_stage": lambda: session.next_stage(-1),
            "pin_left": lambda: session.nudge_pin(-1, 0),
            "pin_right": lambda: session.nudge_pin(1, 0),
            "pin_up": lambda: session.nudge_pin(0, 1),
            "pin_down": lambda: session.nudge_pin(0, -1),
            "go_to_pixel": self.overlays.ask_pixel,
            "unpin": self.dismiss,
            "fit_view": page.grid.fit,
            "next_view": page.next_view,
            "compare": self.toggle_compare,
            "predict": self.toggle_predict,
            "toggle_theme": self.look.toggle_theme,
            "presenter": self.toggle_presenter,
            "show_keys": self.overlays.toggle_keys,
            "undo": session.undo,
            "redo": session.redo,
            "fit_region": self.edits.fit_region,
            "toggle_shared": self.edits.toggle_shared,
            "focus_all": self.edits.focus_all,
            "toggle_cleared": self.edits.toggle_cleared,
            "open_file": self.files.ask_file,
            "save_state": self.files.ask_save,
            "export_view": self.files.ask_export,
            "copy_view": self.files.copy_view,
            "quit": self.close,
        }

    @Slot(str)
    def tell(self, text: str, kind: MessageKind = MessageKind.INFORMATION, details: str = "") -> None:
        """Show a message where the window is looked at; it does not stop anything.

        What only informs goes to the status bar, so that the page does not move while one steps.
        """
        is_symbol = len(text.partition(" ")[0]) < 3
        text = text if is_symbol else text[:1].upper() + text[1:]
        if kind is MessageKind.INFORMATION and not details:
            self.statusBar().showMessage(text, HINT_MILLISECONDS)
        else:
            self.messages.show_message(Message(kind, text, details))

    @Slot(str)
    def _warn(self, text: str) -> None:
        self.tell(text, MessageKind.WARNING)

    @Slot(object)
    def _show_message(self, message: Message) -> None:
        self.tell(message.text, message.kind, message.details)

    @Slot(object)
    def refuse(self, error: Exception) -> None:
        """Say why an edit came to nothing."""
        self.tell(f"{error}", MessageKind.WARNING)
        self.page.scene.refresh()
        self._show_document()

    @Slot(object)
    def _edit_failed(self, error: Exception) -> None:
        if not isinstance(error, ValueError | MemoryError):
            raise error
        self.refuse(error)

    @Slot(str)
    def _tell_pointless(self, text: str) -> None:
        self.tell(text)
        self._show_document()

    @Slot()
    def _edit_cancelled(self) -> None:
        self.refuse(ValueError("The edit was cancelled; nothing has changed."))

    def dismiss(self) -> None:
        """Close what is open on top, stop what runs, or else take the pin away."""
        if self.overlays.close_top():
            return
        if self.files.progress.is_busy:
            self.files.progress.cancel()
        elif self.messages.isVisible():
            self.messages.clear()
        elif self.page.timeline.is_playing():
            self.page.timeline.show_playing(False)
        else:
            self.session.set_pin(None)

    def toggle_compare(self) -> None:
        """Show A | B | difference, or the pixels again."""
        self.page.show_view("pixels" if self.page.current_view() == "compare" else "compare")

    def toggle_predict(self) -> None:
        """Ask before showing, or stop asking."""
        is_on = not self.page.predicting.is_active
        self.page.set_predicting(is_on)
        self.menus.show_checked("predict", is_on)

    def toggle_presenter(self) -> None:
        """Fill the screen with large type, or go back to the window."""
        self.look.toggle_presenter()
        self.menus.show_checked("presenter", self.isFullScreen())

    # Showing the state.

    @Slot()
    def _show_view(self) -> None:
        self.menus.show_checked("compare", self.page.current_view() == "compare")

    @Slot()
    def _show_document(self) -> None:
        document = self.session.document
        self.setWindowTitle(f"{document.title} – Rasterscope" if document.title else "Rasterscope")
        shared = isinstance(document.scene, ClipScene) and document.scene.shared is not None
        self.menus.show_checked("toggle_shared", shared or not isinstance(document.scene, ClipScene))
        self.menus.show_checked("toggle_cleared", document.before == "cleared")
        self._show_history()
        self._show_pointed()

    @Slot()
    def _show_history(self) -> None:
        self.menus.show_enabled("undo", self.session.can_undo)
        self.menus.show_enabled("redo", self.session.can_redo)

    @Slot()
    def _show_pointed(self) -> None:
        pixel = self.session.hover or self.session.pin
        self.pointed.setText(
            f"pixel ({pixel[0]}, {pixel[1]})   {self.page.pointed_text(pixel)}" if pixel else ""
        )

    def report(self, kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        """Tell a mistake of the program in the window too; what is open is still there."""
        text = "".join(traceback.format_exception(kind, error, trace))
        print(text, file=sys.stderr)
        said = f"Something went wrong in the program ({kind.__name__}: {error}). What is open is as it was."
        self.messages.show_message(Message(MessageKind.ERROR, said, text))

    # Coming and going.

    def restore(self) -> None:
        """Put window and panes where they were left."""
        if geometry := self.preferences.geometry:
            self.restoreGeometry(QByteArray.fromBase64(geometry.encode("ascii")))
        self.page.restore_layout(self.preferences.layout)
        self.page.inspector.set_folded(self.preferences.folded_cards)
        self.page.timeline.show_speed(self.preferences.speed)
        self.session.set_level(Level(self.preferences.level))

    @Slot(float)
    def _remember_speed(self, speed: float) -> None:
        self.preferences = self.preferences.model_copy(update={"speed": speed})

    @Slot(str)
    def _remember_theme(self, name: str) -> None:
        self.preferences = self.preferences.model_copy(update={"theme": name})
        self.menus.show_theme(name)

    @Slot(str)
    def _remember_file(self, path: str) -> None:
        self.preferences = with_recent_file(self.preferences, path)
        self.menus.show_recent(self.preferences.recent_files)

    def closeEvent(self, event: QCloseEvent) -> None:
        """Remember window, panes and scene, end all work, then close."""
        self.page.timeline.show_playing(False)
        self.files.shut_down()
        self.session.tracing.shut_down()
        self.page.comparing.stop()
        self.page.views.stop()
        try:
            last = preferences_folder() / f"last{EXTENSION}"
            last.parent.mkdir(parents=True, exist_ok=True)
            save_state(str(last), self.files.state())
            self.preferences = self.preferences.model_copy(
                update={
                    "geometry": self.saveGeometry().toBase64().toStdString(),
                    "layout": self.page.layout_state(),
                    "last_state": str(last),
                    "folded_cards": self.page.inspector.folded(),
                    "level": int(self.session.cursor.level),
                }
            )
            save_preferences(self.preferences)
        except (OSError, StateFileError) as error:
            print(f"rasterscope: the window could not be remembered: {error}", file=sys.stderr)
        super().closeEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep inside what lies over the page."""
        super().resizeEvent(event)
        self.overlays.place()

    def event(self, event: QEvent) -> bool:
        """Leave a control that Tab has reached the keys it needs: Space presses a button, it does not play."""
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.ShortcutOverride:
            is_needed = not self._has_mouse_focus and has_use_for(self.focusWidget(), event)
            if is_needed:
                event.accept()
                return True
        return super().event(event)

    @Slot(QWidget, QWidget)
    def _focus_moved(self, before: QWidget | None, now: QWidget | None) -> None:
        """Remember whether the focus was given by a click: then the keys go on stepping."""
        if now is not None and now.window() is self:
            self._has_mouse_focus = QApplication.mouseButtons() != Qt.MouseButton.NoButton

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Take files."""
        if event.mimeData().hasUrls():
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        """Open the file that was dropped."""
        paths = [url.toLocalFile() for url in event.mimeData().urls() if url.isLocalFile()]
        if len(paths) > 1:
            self.tell(f"One file at a time: opening {Path(paths[0]).name}.")
        if paths:
            self.files.open_path(paths[0])
