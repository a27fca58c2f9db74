"""The menus and their actions, made from the one table of keys, and what they open without a dialog."""

import os
from collections.abc import Iterable, Sequence
from contextlib import suppress
from pathlib import Path

from PySide6.QtCore import QObject, Signal, Slot
from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QMainWindow, QMenu

from app.files.file_access import shown_name
from app.files.saved_windows import earlier_windows
from app.files.user_folders import preferences_folder
from app.session.document import TEACHING_SIZES, Document
from app.window.appearance import DESK_THEMES, TEXT_SIZES
from app.window.file_desk import SCALES
from app.window.keys import KeyAction, KeyChoices, key_text
from core.records.words import nouns
from lessons.lectures.scenes import LECTURE_SCENES, LECTURES
from lessons.scenes import CATALOGUE, BuiltInScene
from widgets.basics.theme import current_theme

# What can be opened without a dialog: lessons, states of a folder, files that were open, built-in scenes.


AS_PRINTED = "printed/"
"""What the names of entries begin with that show a listing as a slide prints it."""
Entry = tuple[str, str]
"""What is opened, and its title."""


def scene_groups(
    states: Sequence[str], recent: Iterable[str], lessons: Sequence[Entry] = ()
) -> dict[str, list[Entry]]:
    """Return what can be opened by headings: ``states`` of one folder, recent files that are still there, scenes.

    ``lessons`` come first.
    """
    others = [path for path in recent if path not in states and os.path.isfile(path)]
    groups = {"Recent files": _files(others), "Scenes": _scenes(CATALOGUE)}
    groups |= {LECTURES[name]: _scenes(scenes) for name, scenes in LECTURE_SCENES.items()}
    if states:
        titled = [(path, shown_name(Path(path).stem)) for path in states]
        groups = {f"States in {shown_name(Path(states[0]).parent.name)}": titled, **groups}
    return {"Lessons": [*lessons], **groups} if lessons else groups


def printed_group(document: Document) -> dict[str, list[Entry]]:
    """Return the listings as slides print them that run on the open scene, under one heading; empty: none does."""
    from app.session.printed_runs import runnable_on  # Wanted by few, long after the start.

    entries = [(f"{AS_PRINTED}{it.name}", f"{it.lecture}: {it.title}") for it in runnable_on(document)]
    return {"As printed, beside the right method": entries} if entries else {}


def scenes_about() -> dict[str, str]:
    """Return what each built-in scene is about, by its name."""
    scenes = [*CATALOGUE, *(scene for of in LECTURE_SCENES.values() for scene in of)]
    return {scene.name: scene.description for scene in scenes}


def _files(paths: Iterable[str]) -> list[Entry]:
    return [(path, shown_name(Path(path).name)) for path in paths]


def _scenes(scenes: Iterable[BuiltInScene]) -> list[Entry]:
    return [(scene.name, scene.title) for scene in scenes]


def next_entry(groups: dict[str, list[Entry]], shown: str) -> str:
    """Return what comes after the entry that is shown, in the same group; or else the first of all."""
    for entries in groups.values():
        names = [name for name, _ in entries]
        if shown in names:
            return names[min(names.index(shown) + 1, len(names) - 1)]
    return next((entries[0][0] for entries in groups.values() if entries), "")


# The menus and their actions, made from the one table of keys.


MENUS = (
    *("File", "Edit", "Step", "Stage", "Lesson", "Raster", "Compare", "Stability", "Plan", "Exercises"),
    *("View", "View/Panes", "View/Pages", "Help"),
)
"""Menus, and after a stroke those within one: each stands where its first entry would."""


class Menus(QObject):
    """Fills the menu bar of a window, holds its actions, and reports what was chosen."""

    action_chosen = Signal(str)
    """Name of an action of ``app.window.actions.ACTIONS``, by key or menu."""
    scene_chosen = Signal(str)
    """Name of a built-in scene."""
    recent_chosen = Signal(str)
    """Path of a file."""
    printed_chosen = Signal(str)
    """Name of a listing as a slide prints it."""
    lesson_chosen = Signal(str)
    """Name of a lesson."""
    raster_chosen = Signal(int, int)
    """Columns and rows for the whole view."""
    theme_chosen = Signal(str)
    text_size_chosen = Signal(int)
    """Percent; 0: as large as the desktop's text."""
    scale_chosen = Signal(int)
    """Pixels of an exported picture to one of the screen's."""

    def __init__(self, window: QMainWindow, table: Sequence[KeyAction]) -> None:
        super().__init__(window)
        self._table = table
        self.actions_by_name: dict[str, QAction] = {}
        self.recent_menu = QMenu("Open &recent", window)
        self.earlier_menu = QMenu("Earlier &windows", window)
        self.scene_menu = QMenu("Built-in &scenes", window)
        self.lecture_menu = QMenu("Scenes of the &lectures", window)
        self.printed_menu = QMenu("As &printed, beside the right method", window)
        self.lesson_menu = QMenu("&Open lesson", window)
        self.scale_group = QActionGroup(self)
        self.bookmark_menu = QMenu("Boo&kmarks", window)
        self.theme_group, self.text_size_group = QActionGroup(self), QActionGroup(self)
        bar, outer = window.menuBar(), [title for title in MENUS if "/" not in title]
        menus = {title: bar.addMenu(f"&{title}") for title in outer}
        self._menus = menus
        for entry in self._table:
            made = self._make_action(entry, window)
            # Its key works while the menu bar is out of sight, too.
            window.addAction(made)
            if entry.menu:
                if entry.menu not in menus:
                    parent, title = entry.menu.split("/")
                    menus[entry.menu] = menus[parent].addMenu(title)
                menus[entry.menu].addAction(made)
            if entry.name == "open_file":
                menus["File"].addMenu(self.recent_menu)
                menus["File"].addMenu(self.earlier_menu)
                menus["File"].addMenu(self.scene_menu)
                menus["File"].addMenu(self.lecture_menu)
            if entry.name == "export_caption":
                self._add_scales(menus["File"])
            if entry.name == "note_bookmark":
                menus["Step"].addMenu(self.bookmark_menu)
            if entry.ends_group:
                menus[entry.menu].addSeparator()
        self._fill_scenes()
        self._add_rasters(menus["Raster"])
        menus["Raster"].addMenu(self.printed_menu)
        self.printed_menu.setToolTipsVisible(True)
        self.printed_menu.aboutToShow.connect(self._fill_printed)
        self.printed_menu.triggered.connect(self._choose_printed)
        menus["Lesson"].addMenu(self.lesson_menu)
        self.lesson_menu.aboutToShow.connect(self._fill_lessons)
        self.lesson_menu.triggered.connect(self._choose_lesson)
        self._add_themes(menus["View"])
        self._add_text_sizes(menus["View"])
        for menu in (self.recent_menu, self.earlier_menu):
            menu.triggered.connect(self._choose_recent)
        self.earlier_menu.aboutToShow.connect(self._fill_earlier)
        self.show_recent(())
        self.show_bookmarks(())

    def _make_action(self, entry: KeyAction, window: QMainWindow) -> QAction:
        made = QAction(entry.title, window, checkable=entry.is_checkable)
        made.setData(entry.name)
        _give_keys(made, entry)
        made.triggered.connect(self._choose_action)
        self.actions_by_name[entry.name] = made
        return made

    def _fill_scenes(self) -> None:
        self._fill_scene_menu(self.scene_menu, CATALOGUE)
        for lecture, scenes in LECTURE_SCENES.items():
            self._fill_scene_menu(self.lecture_menu.addMenu(lecture), scenes)

    def _fill_scene_menu(self, menu: QMenu, scenes: tuple[BuiltInScene, ...]) -> None:
        for scene in scenes:
            made = menu.addAction(scene.title)
            made.setStatusTip(scene.card)
            made.setToolTip(scene.card)
            made.setData(scene.name)
        menu.setToolTipsVisible(True)
        menu.triggered.connect(self._choose_scene)

    def _add_rasters(self, menu: QMenu) -> None:
        sizes = menu.addMenu("Whole view at")
        for columns, rows in TEACHING_SIZES:
            made = sizes.addAction(f"{columns} × {rows}")
            made.setData((columns, rows))
        sizes.triggered.connect(self._choose_raster)

    @Slot()
    def _fill_printed(self) -> None:
        """List the listings when they are first asked for: the window opens without them."""
        if self.printed_menu.actions():
            return
        from app.session.printed_runs import runnable

        for printed in runnable():
            made = self.printed_menu.addAction(f"{printed.lecture}: {printed.title}")
            made.setToolTip(printed.slide)
            made.setStatusTip(f"A | B: the right method beside the listing as printed on “{printed.slide}”")
            made.setData(printed.name)

    @Slot()
    def _fill_lessons(self) -> None:
        """List the lessons as they are now: those of own folders may have changed."""
        from app.files.user_folders import whole_course

        self.lesson_menu.clear()
        with suppress(OSError):
            for lesson in whole_course().lessons.values():
                made = self.lesson_menu.addAction(lesson.title)
                made.setToolTip(lesson.question)
                made.setStatusTip(lesson.question)
                made.setData(lesson.name)
        if self.lesson_menu.isEmpty():
            self.lesson_menu.addAction("No lessons can be read").setEnabled(False)

    @Slot(QAction)
    def _choose_lesson(self, action: QAction) -> None:
        self.lesson_chosen.emit(action.data())

    @Slot(QAction)
    def _choose_printed(self, action: QAction) -> None:
        self.printed_chosen.emit(action.data())

    def _add_scales(self, menu: QMenu) -> None:
        scales = menu.addMenu("Picture scale")
        for scale in SCALES:
            made = scales.addAction(f"{scale} ×" if scale > 1 else "1 ×, as on the screen")
            made.setCheckable(True)
            made.setData(scale)
            made.setChecked(scale == 1)
            self.scale_group.addAction(made)
        scales.triggered.connect(self._choose_scale)

    def _add_themes(self, menu: QMenu) -> None:
        themes = menu.addMenu("Theme")
        for name in DESK_THEMES:
            made = themes.addAction(name.capitalize())
            made.setCheckable(True)
            made.setData(name)
            made.setChecked(current_theme().name == name)
            self.theme_group.addAction(made)
        themes.triggered.connect(self._choose_theme)

    def _add_text_sizes(self, menu: QMenu) -> None:
        sizes = menu.addMenu("Text size")
        for percent in (0, *TEXT_SIZES):
            made = sizes.addAction(f"{percent} %" if percent else "As the desktop")
            made.setCheckable(True)
            made.setData(percent)
            self.text_size_group.addAction(made)
        sizes.triggered.connect(self._choose_text_size)

    # Showing.

    def show_checked(self, name: str, is_checked: bool) -> None:
        """Show whether what an action switches is on."""
        self.actions_by_name[name].setChecked(is_checked)

    def show_kind(self, corner_count: int) -> None:
        """Name triangles, segments or points: primitives of so many corners."""
        one = nouns(corner_count).one
        for entry in self._table:
            if "triangle" in entry.title:
                many = entry.title.replace("triangles", nouns(corner_count).many)
                self.actions_by_name[entry.name].setText(many.replace("triangle", one))

    def show_keys(self, choices: KeyChoices) -> None:
        """Let the actions have other keys."""
        for entry in choices.table(self._table):
            _give_keys(self.actions_by_name[entry.name], entry)

    def show_page(self, name: str) -> None:
        """Offer the actions of a page and those of all pages; the others' keys are free for what is on the page."""
        for entry in self._table:
            if entry.page:
                self.actions_by_name[entry.name].setEnabled(entry.page == name)
        for title, menu in self._menus.items():
            pages = {entry.page for entry in self._table if entry.menu == title}
            menu.menuAction().setVisible(bool(pages & {"", name}))

    @Slot(object)
    def show_recent(self, paths: Sequence[str]) -> None:
        """Show the files that were open last, of those that can be had now."""
        self.recent_menu.clear()
        for path in filter(os.path.isfile, paths):
            self.recent_menu.addAction(path).setData(path)
        if self.recent_menu.isEmpty():
            self.recent_menu.addAction("No files yet").setEnabled(False)

    def show_bookmarks(self, texts: Sequence[str]) -> None:
        """Offer the bookmarks, in the order of their keys."""
        self.bookmark_menu.clear()
        for index, text in enumerate(texts):
            action = self.actions_by_name[f"bookmark_{index}"]
            action.setText(text)
            self.bookmark_menu.addAction(action)
        if not texts:
            self.bookmark_menu.addAction("No bookmarks yet").setEnabled(False)

    @Slot()
    def _fill_earlier(self) -> None:
        """Show what earlier windows left."""
        self.earlier_menu.clear()
        with suppress(OSError):
            for earlier in earlier_windows(preferences_folder()):
                made = self.earlier_menu.addAction(f"{earlier.title}, saved {earlier.when}")
                made.setData(str(earlier.path))
        if self.earlier_menu.isEmpty():
            self.earlier_menu.addAction("No earlier windows").setEnabled(False)

    @Slot(str)
    def show_theme(self, name: str) -> None:
        """Show which theme is on."""
        for action in self.theme_group.actions():
            action.setChecked(action.data() == name)

    @Slot(int)
    def show_text_size(self, percent: int) -> None:
        """Show which size the text has."""
        for action in self.text_size_group.actions():
            action.setChecked(action.data() == percent)

    # What was chosen.

    @Slot()
    def _choose_action(self) -> None:
        action = self.sender()
        assert isinstance(action, QAction)
        self.action_chosen.emit(action.data())

    @Slot(QAction)
    def _choose_scene(self, action: QAction) -> None:
        self.scene_chosen.emit(action.data())

    @Slot(QAction)
    def _choose_recent(self, action: QAction) -> None:
        if action.data():
            self.recent_chosen.emit(action.data())

    @Slot(QAction)
    def _choose_raster(self, action: QAction) -> None:
        columns, rows = action.data()
        self.raster_chosen.emit(columns, rows)

    @Slot(QAction)
    def _choose_scale(self, action: QAction) -> None:
        self.scale_chosen.emit(action.data())

    @Slot(QAction)
    def _choose_theme(self, action: QAction) -> None:
        self.theme_chosen.emit(action.data())

    @Slot(QAction)
    def _choose_text_size(self, action: QAction) -> None:
        self.text_size_chosen.emit(action.data())


def _give_keys(made: QAction, entry: KeyAction) -> None:
    made.setShortcuts([QKeySequence(key) for key in entry.keys])
    made.setToolTip(f"{entry.title} ({key_text(entry)})" if entry.keys else entry.title)
