"""The main window: menus, pages, opening and saving, and how it comes back as it was left."""

import sys
import traceback
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import TracebackType

from PySide6.QtCore import QByteArray, QEvent, Qt, QTimer, Slot
from PySide6.QtGui import (
    QAction,
    QActionGroup,
    QCloseEvent,
    QDragEnterEvent,
    QDropEvent,
    QKeyEvent,
    QKeySequence,
    QResizeEvent,
)
from PySide6.QtWidgets import (
    QApplication,
    QFileDialog,
    QLabel,
    QMainWindow,
    QMenu,
    QVBoxLayout,
    QWidget,
)

from app.document import (
    TEACHING_SIZES,
    Document,
    fit_region,
    focus_on,
    same_view,
)
from app.export import copy_widget, export_widget
from app.key_focus import has_use_for
from app.keys import ACTIONS, KeyAction, key_text
from app.mesh_files import EXTENSIONS, OpeningCancelledError
from app.open_any import Opened, open_any
from app.preferences import (
    Preferences,
    preferences_folder,
    save_preferences,
    with_recent_file,
)
from app.scene_edits import join_shared, split_shared
from app.session import Session
from app.state_files import EXTENSION, State, StateFileError, save_state
from app.step_page import StepPage
from app.stepping_presenter import Bookmark
from app.tracing import trace_now
from app.workers import Job, Progress
from core import Trace
from core.conditions import variable_names
from core.scene import ClipScene
from core.steps import Level
from lessons.scenes import CATALOGUE
from widgets.ask_bar import AskBar
from widgets.key_help import KeyEntry, KeyHelp
from widgets.message_bar import Message, MessageBar, MessageKind
from widgets.message_bar import Progress as ProgressRecord
from widgets.theme import DARK, LIGHT, PRESENTER, apply_theme, current_theme

MENUS = ("File", "Edit", "Step", "Stage", "Raster", "View", "Help")
THEMES = {"light": LIGHT, "dark": DARK, "presenter": PRESENTER}
PROGRESS_AFTER = 300
"""Milliseconds before the progress of opening a file is shown."""
HINT_MILLISECONDS = 8000
"""How long a hint stays in the status bar."""


def the_application() -> QApplication:
    """Return the application of this process, made at the first call."""
    found = QApplication.instance()
    return found if isinstance(found, QApplication) else QApplication(["rasterscope"])


class MainWindow(QMainWindow):
    """One session and the pages around it."""

    def __init__(self, document: Document, preferences: Preferences | None = None) -> None:
        super().__init__()
        self.preferences = preferences or Preferences()
        self.session = Session(document, self)
        self.page = StepPage(self.session, self)
        self.messages = MessageBar(self)
        self.key_help = KeyHelp(self)
        self.key_help.hide()
        self.ask_bar = AskBar(self)
        self.job = Job(self)
        self._slow = QTimer(self)
        self._slow.setSingleShot(True)
        self._slow.setInterval(PROGRESS_AFTER)
        self._doing = ""
        self.actions_by_name: dict[str, QAction] = {}
        self.setAcceptDrops(True)
        self.setMinimumSize(900, 600)
        self._has_mouse_focus = False
        self._theme_before = ""
        self._lay_out()
        self._make_menus()
        self._connect()
        self._show_document()

    # Layout.

    def _lay_out(self) -> None:
        self._central = central = QWidget(self)
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

    def _make_menus(self) -> None:
        menus = {title: self.menuBar().addMenu(f"&{title}") for title in MENUS}
        self.recent_menu = QMenu("Open &recent", self)
        self.scene_menu = QMenu("Built-in &scenes", self)
        for action in ACTIONS:
            made = self._make_action(action)
            if action.menu:
                menus[action.menu].addAction(made)
            else:
                self.addAction(made)
            if action.name == "open_file":
                menus["File"].addMenu(self.recent_menu)
                menus["File"].addMenu(self.scene_menu)
            if action.name in ("save_state", "copy_view", "redo", "visited_forward", "next_view", "predict"):
                menus[action.menu].addSeparator()
        for scene in CATALOGUE:
            made = self.scene_menu.addAction(scene.title)
            made.setStatusTip(scene.description)
            made.setToolTip(scene.description)
            made.setData(scene.name)
        self.scene_menu.setToolTipsVisible(True)
        self.scene_menu.triggered.connect(self._open_scene)
        self.recent_menu.triggered.connect(self._open_recent)
        self.recent_menu.aboutToShow.connect(self._fill_recent)
        self._make_raster_menu(menus["Raster"])
        self._make_theme_menu(menus["View"])

    def _make_raster_menu(self, menu: QMenu) -> None:
        sizes = menu.addMenu("Whole view at")
        for columns, rows in TEACHING_SIZES:
            made = sizes.addAction(f"{columns} × {rows}")
            made.setData((columns, rows))
        sizes.triggered.connect(self._choose_raster)

    def _make_theme_menu(self, menu: QMenu) -> None:
        themes = menu.addMenu("Theme")
        group = QActionGroup(self)
        for name in THEMES:
            made = themes.addAction({"presenter": "Presenter (large type)"}.get(name, name.capitalize()))
            made.setCheckable(True)
            made.setData(name)
            made.setChecked(THEMES[name] == current_theme())
            group.addAction(made)
        themes.triggered.connect(self._choose_theme)
        self.theme_group = group

    def _make_action(self, entry: KeyAction) -> QAction:
        made = QAction(entry.title, self)
        made.setShortcuts([QKeySequence(key) for key in entry.keys])
        made.setCheckable(entry.is_checkable)
        made.setData(entry.name)
        if entry.keys:
            made.setToolTip(f"{entry.title} ({key_text(entry)})")
        made.triggered.connect(self._run_action)
        self.actions_by_name[entry.name] = made
        return made

    def _connect(self) -> None:
        self.session.document_changed.connect(self._show_document)
        self.session.history_changed.connect(self._show_history)
        self.session.hover_changed.connect(self._show_pointed)
        self.session.pin_changed.connect(self._show_pointed)
        self.session.cursor_changed.connect(self._show_pointed)
        self.page.message_sent.connect(self.tell)
        self.page.edit_refused.connect(self._warn)
        self.session.edit_failed.connect(self._edit_failed)
        self.session.tracing.busy_changed.connect(self._show_busy)
        self.ask_bar.text_entered.connect(self._take_answer)
        self.page.timeline.speed_changed.connect(self._remember_speed)
        self.page.views.triangle_picked.connect(self.focus_triangle)
        self.key_help.closed.connect(self.key_help.hide)
        self.key_help.show_keys([KeyEntry(a.group, key_text(a), a.title) for a in ACTIONS if a.keys])
        self.messages.message_dismissed.connect(self.messages.clear)
        self.messages.cancel_requested.connect(self._cancel_work)
        self.job.progressed.connect(self._progress)
        self.job.succeeded.connect(self._opened)
        self.job.failed.connect(self._not_opened)
        self.job.ended.connect(self._job_ended)
        self._slow.timeout.connect(self._show_slow)
        self.page.view_bar.currentChanged.connect(self._show_view)
        the_application().focusChanged.connect(self._focus_moved)

    # Actions by key and menu.

    @Slot()
    def _run_action(self) -> None:
        action = self.sender()
        assert isinstance(action, QAction)
        self.run_action(action.data())

    def run_action(self, name: str) -> None:
        """Do what the key of this name does."""
        page, session, stepping = self.page, self.session, self.page.stepping
        for prefix, handler in (("stage_", stepping.choose_stage), ("bookmark_", stepping.go_to_bookmark)):
            if name.startswith(prefix):
                handler(int(name.removeprefix(prefix)))
                return
        handlers = {
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
            "edit_condition": self.ask_condition,
            "toggle_bookmark": stepping.toggle_bookmark,
            "next_stage": lambda: session.next_stage(1),
            "previous_stage": lambda: session.next_stage(-1),
            "pin_left": lambda: session.nudge_pin(-1, 0),
            "pin_right": lambda: session.nudge_pin(1, 0),
            "pin_up": lambda: session.nudge_pin(0, 1),
            "pin_down": lambda: session.nudge_pin(0, -1),
            "go_to_pixel": self.ask_pixel,
            "unpin": self.dismiss,
            "fit_view": page.grid.fit,
            "next_view": page.next_view,
            "compare": self.toggle_compare,
            "predict": self.toggle_predict,
            "toggle_theme": self.toggle_theme,
            "presenter": self.toggle_presenter,
            "show_keys": self.show_keys,
            "undo": session.undo,
            "redo": session.redo,
            "fit_region": self.fit_region,
            "toggle_shared": self.toggle_shared,
            "focus_all": self.focus_all,
            "toggle_cleared": self.toggle_cleared,
            "open_file": self.ask_file,
            "save_state": self.ask_save,
            "export_view": self.ask_export,
            "copy_view": lambda: copy_widget(self.page.main_view()),
            "quit": self.close,
        }
        handlers[name]()

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

    def refuse(self, error: Exception) -> None:
        """Say why an edit came to nothing."""
        self.tell(f"{error}", MessageKind.WARNING)
        self.page.scene.refresh()
        self._show_document()

    def edit(self, document: Document) -> None:
        """Take over an edited document, or say why that is not possible."""
        try:
            self.session.edit(document)
        except ValueError as error:
            self.refuse(error)

    def dismiss(self) -> None:
        """Close what is open on top, stop what runs, or else take the pin away."""
        if self.key_help.isVisible():
            self.key_help.hide()
        elif self.ask_bar.isVisible():
            self.ask_bar.hide()
        elif self.job.is_running or self.session.tracing.is_busy:
            self._cancel_work()
        elif self.messages.isVisible():
            self.messages.clear()
        elif self.page.timeline.is_playing():
            self.page.timeline.show_playing(False)
        else:
            self.session.set_pin(None)

    def show_keys(self) -> None:
        """Show or hide the page of all keys."""
        self.key_help.setVisible(not self.key_help.isVisible())
        self._place_overlays()
        self.key_help.raise_()

    def toggle_compare(self) -> None:
        """Show A | B | difference, or the pixels again."""
        self.page.show_view("pixels" if self.page.current_view() == "compare" else "compare")

    def toggle_predict(self) -> None:
        """Ask before showing, or stop asking."""
        is_on = not self.page.predicting.is_active
        self.page.set_predicting(is_on)
        self.actions_by_name["predict"].setChecked(is_on)

    def toggle_theme(self) -> None:
        """Change between light and dark."""
        self.set_theme("light" if current_theme() == DARK else "dark")

    def toggle_presenter(self) -> None:
        """Fill the screen with large type, or go back to the window."""
        if self.isFullScreen():
            self.showNormal()
            self.set_theme(self._theme_before or "light")
        else:
            self._theme_before = next(name for name in THEMES if THEMES[name] == current_theme())
            self.showFullScreen()
            self.set_theme("presenter")
        self.actions_by_name["presenter"].setChecked(self.isFullScreen())

    def set_theme(self, name: str) -> None:
        """Show the window in a theme by its name."""
        application = the_application()
        apply_theme(application, THEMES[name])
        self.preferences = self.preferences.model_copy(update={"theme": name})
        for action in self.theme_group.actions():
            action.setChecked(action.data() == name)

    def toggle_shared(self) -> None:
        """Let corners at one place move together, or each by itself."""
        document = self.session.document
        scene = document.scene
        if not isinstance(scene, ClipScene):
            self.tell("Vertices of a mesh are always shared by its triangles.")
            self._show_document()
            return
        edited = split_shared(scene) if scene.shared is not None else join_shared(scene)
        self.edit(replace(document, scene=edited))

    def fit_region(self) -> None:
        """Show the smallest raster around the triangle in focus."""
        document = self.session.document
        if document.triangle is None and document.triangle_count == 1:
            document = replace(document, triangle=0)
        self.edit(fit_region(document))

    def focus_all(self) -> None:
        """Step all triangles instead of the one in focus."""
        document = self.session.document
        self.edit(replace(document, triangle=None, raster=same_view(document.scene, 64, 48)))

    @Slot(int)
    def focus_triangle(self, triangle: int) -> None:
        """Bring a triangle into focus."""
        self.edit(focus_on(self.session.document, triangle))

    def toggle_cleared(self) -> None:
        """Start from cleared buffers, or as the earlier triangles left them."""
        document = self.session.document
        before = "earlier" if document.before == "cleared" else "cleared"
        self.edit(replace(document, before=before))

    @Slot(QAction)
    def _choose_raster(self, action: QAction) -> None:
        document = self.session.document
        columns, rows = action.data()
        self.edit(replace(document, raster=same_view(document.scene, columns, rows)))

    @Slot(QAction)
    def _choose_theme(self, action: QAction) -> None:
        self.set_theme(action.data())

    def ask_pixel(self) -> None:
        """Ask for a pixel to pin."""
        first_column, first_row, end_column, end_row = self.session.trace.source.raster.bounds
        hint = f"Column {first_column} to {end_column - 1}, row {first_row} to {end_row - 1}, as 12, 7."
        self._ask("pixel", "Go to pixel", hint)

    def ask_condition(self) -> None:
        """Ask for the condition of a breakpoint."""
        names = ", ".join(variable_names(self.session.stage_trace))
        hint = f"F5 stops where it holds. Names here: {names}. Leave it empty to stop nowhere."
        self._ask("condition", "Break where", hint, self.page.stepping.condition)

    def _ask(self, name: str, label: str, hint: str, text: str = "") -> None:
        self.ask_bar.ask(name, label, hint, text)
        self._place_overlays()
        self.ask_bar.raise_()

    @Slot(str, str)
    def _take_answer(self, name: str, text: str) -> None:
        try:
            if name == "pixel":
                self._go_to_pixel(text)
            else:
                self.page.stepping.set_condition(text)
        except ValueError as error:
            self.ask_bar.show_problem(f"{error}")
            self._place_overlays()
        else:
            self.ask_bar.hide()
            self.page.grid.setFocus()

    def _go_to_pixel(self, text: str) -> None:
        parts = text.replace(",", " ").split()
        if len(parts) != 2 or not all(part.isdecimal() for part in parts):
            raise ValueError(f"Wanted column and row, as 12, 7; got “{text}”.")
        pixel = int(parts[0]), int(parts[1])
        if not self.session.has_pixel(pixel):
            raise ValueError(f"Pixel ({pixel[0]}, {pixel[1]}) is not in the raster.")
        self.session.set_pin(pixel)

    # Opening and saving.

    def ask_file(self) -> None:
        """Ask for a mesh or state file and open it."""
        endings = " ".join(f"*{ending}" for ending in (*EXTENSIONS, EXTENSION))
        folder = str(Path(self.session.document.path).parent) if self.session.document.path else ""
        path, _ = QFileDialog.getOpenFileName(
            self, "Open", folder, f"Meshes and states ({endings});;All files (*)"
        )
        if path:
            self.open_path(path)

    def open_path(self, target: str) -> None:
        """Open a mesh, a state or a built-in scene off the GUI thread; the open scene stays until it is there."""
        self._doing = f"Opening {Path(target).name}"

        def work(progress: Progress, is_cancelled: Callable[[], bool]) -> tuple[Opened, Trace]:
            opened = open_any(target, progress, is_cancelled)
            stage = opened.state.stage if opened.state else "raster"
            return opened, trace_now(opened.document, stage)

        self._slow.start()
        self.job.start(work)

    @Slot(object, str)
    def _progress(self, fraction: float | None, doing: str) -> None:
        self._doing = doing or self._doing
        if not self._slow.isActive():
            done = 0 if fraction is None else round(fraction * 100)
            self.messages.show_progress(ProgressRecord(self._doing, done, 0 if fraction is None else 100))

    @Slot()
    def _show_slow(self) -> None:
        if self.job.is_running or self.session.tracing.is_busy:
            self.messages.show_progress(ProgressRecord(self._doing, 0, 0))

    @Slot(str)
    def _show_busy(self, doing: str) -> None:
        """Show that an edit is being traced, if that takes a moment."""
        self._doing = doing
        if doing:
            self._slow.start()
        elif not self.job.is_running:
            self._job_ended()

    @Slot()
    def _cancel_work(self) -> None:
        if self.session.tracing.is_busy:
            self.session.tracing.cancel()
            self.refuse(ValueError("The edit was cancelled; nothing has changed."))
        if self.job.is_running:
            self.job.cancel()
            self.tell("Opening was cancelled; nothing has changed.")

    @Slot(object)
    def _edit_failed(self, error: Exception) -> None:
        if not isinstance(error, ValueError | MemoryError):
            raise error
        self.refuse(error)

    @Slot()
    def _job_ended(self) -> None:
        self._slow.stop()
        self.messages.show_progress(None)

    @Slot(object)
    def _opened(self, result: tuple[Opened, Trace]) -> None:
        opened, trace = result
        self.show_opened(opened, trace)
        self.messages.clear()
        if opened.warnings:
            self.tell(opened.warnings[0], MessageKind.WARNING, "\n".join(opened.warnings[1:]))
        if opened.document.path:
            self._remember_file(opened.document.path)

    def show_opened(self, opened: Opened, trace: Trace | None = None) -> None:
        """Show what was opened: a scene from its start, a state where it was left."""
        self.page.timeline.show_playing(False)
        self.session.open(opened.document, trace)
        self.page.stepping.forget_places()
        state = opened.state
        if state is None:
            self.session.set_stage("raster", 0)
            return
        self.page.stepping.set_bookmarks([Bookmark(stage, position) for stage, position in state.bookmarks])
        self.session.set_level(Level(state.level))
        self.session.set_stage(state.stage, state.position)
        self.session.set_pin(state.pin)
        self.page.show_view(state.view)

    @Slot(object)
    def _not_opened(self, error: Exception) -> None:
        if isinstance(error, OpeningCancelledError):
            self.tell("Opening was cancelled; nothing has changed.")
        elif isinstance(error, ValueError | OSError | MemoryError):
            self.tell(f"{error} The open scene stays as it was.", MessageKind.ERROR)
        else:
            raise error

    @Slot(QAction)
    def _open_scene(self, action: QAction) -> None:
        name = action.data()
        self.open_path(name)

    @Slot(QAction)
    def _open_recent(self, action: QAction) -> None:
        if action.data():
            self.open_path(action.data())

    @Slot()
    def _fill_recent(self) -> None:
        self.recent_menu.clear()
        for path in self.preferences.recent_files:
            self.recent_menu.addAction(path).setData(path)
        if self.recent_menu.isEmpty():
            self.recent_menu.addAction("No files yet").setEnabled(False)

    def _remember_file(self, path: str) -> None:
        self.preferences = with_recent_file(self.preferences, path)

    def state(self) -> State:
        """Return what a state file keeps."""
        cursor = self.session.cursor
        return State(
            document=self.session.document,
            stage=cursor.stage,
            position=cursor.position,
            level=int(cursor.level),
            pin=self.session.pin,
            bookmarks=[(mark.stage, mark.position) for mark in self.page.stepping.bookmarks],
            view=self.page.current_view(),
        )

    def ask_save(self) -> None:
        """Ask where the state is to be saved, and save it."""
        path, _ = QFileDialog.getSaveFileName(
            self, "Save state", f"state{EXTENSION}", f"States (*{EXTENSION})"
        )
        if path:
            self.save_to(path)

    def save_to(self, path: str) -> None:
        """Save the state to a file."""
        try:
            save_state(path, self.state())
        except (OSError, StateFileError) as error:
            self.tell(f"The state was not saved: {error}", MessageKind.ERROR)
        else:
            self._remember_file(path)
            self.tell(f"Saved {Path(path).name}.")

    def ask_export(self) -> None:
        """Ask where the current view is to go, and export it."""
        kinds = "PNG picture (*.png);;SVG drawing (*.svg);;PDF page (*.pdf)"
        path, _ = QFileDialog.getSaveFileName(self, "Export view", "view.png", kinds)
        if path:
            self.export_to(path)

    def export_to(self, path: str) -> None:
        """Export the current view by the ending of the file."""
        try:
            export_widget(self.page.main_view(), path)
        except (OSError, ValueError) as error:
            self.tell(f"The view was not exported: {error}", MessageKind.ERROR)
        else:
            self.tell(f"Exported {Path(path).name}.")

    # Showing the state.

    @Slot()
    def _show_view(self) -> None:
        self.actions_by_name["compare"].setChecked(self.page.current_view() == "compare")

    @Slot()
    def _show_document(self) -> None:
        document = self.session.document
        self.setWindowTitle(f"{document.title} – Rasterscope" if document.title else "Rasterscope")
        shared = isinstance(document.scene, ClipScene) and document.scene.shared is not None
        self.actions_by_name["toggle_shared"].setChecked(shared or not isinstance(document.scene, ClipScene))
        self.actions_by_name["toggle_cleared"].setChecked(document.before == "cleared")
        self._show_history()
        self._show_pointed()

    @Slot()
    def _show_history(self) -> None:
        self.actions_by_name["undo"].setEnabled(self.session.can_undo)
        self.actions_by_name["redo"].setEnabled(self.session.can_redo)

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
        geometry = self.preferences.geometry
        if geometry:
            self.restoreGeometry(QByteArray.fromBase64(geometry.encode("ascii")))
        self.page.restore_layout(self.preferences.layout)
        self.page.inspector.set_folded(self.preferences.folded_cards)
        self.page.timeline.show_speed(self.preferences.speed)
        self.session.set_level(Level(self.preferences.level))

    @Slot(float)
    def _remember_speed(self, speed: float) -> None:
        self.preferences = self.preferences.model_copy(update={"speed": speed})

    def closeEvent(self, event: QCloseEvent) -> None:
        """Remember window, panes and scene, end all work, then close."""
        self.page.timeline.show_playing(False)
        self.job.shut_down()
        self.session.tracing.shut_down()
        self.page.comparing.stop()
        self.page.views.stop()
        try:
            last = preferences_folder() / f"last{EXTENSION}"
            last.parent.mkdir(parents=True, exist_ok=True)
            save_state(str(last), self.state())
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
        """Keep the page of keys inside."""
        super().resizeEvent(event)
        self._place_overlays()

    def _place_overlays(self) -> None:
        """Keep what lies over the page inside of it."""
        inside = self._central.geometry()
        if self.key_help.isVisible():
            self.key_help.setGeometry(inside.adjusted(24, 24, -24, -24))
        if self.ask_bar.isVisible():
            width = min(inside.width() - 48, 720)
            height = max(self.ask_bar.heightForWidth(width), self.ask_bar.sizeHint().height())
            self.ask_bar.setGeometry(inside.center().x() - width // 2, inside.top() + 8, width, height)

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
            self.open_path(paths[0])
