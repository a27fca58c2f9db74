"""The start page: what the program is, what to press, files to open, the lessons, and what was open last."""

import os
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QEvent, QObject, QPoint, Qt, QTimer, Slot
from PySide6.QtGui import QKeyEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSlider,
    QCheckBox,
    QLineEdit,
    QPushButton,
    QScrollArea,
    QWidget,
)

from app.background import Job
from app.pages.lessons.lesson_list import LessonsPresenter
from app.pages.page_bar import Page
from app.session.moment import Change
from app.session.session import Session
from core.fast_path.draw import draw_picture
from core.records.words import counted
from core.scene import AnyScene, Scene
from core.setting_texts import settings_from_texts
from lessons.lectures.scenes import ALL_SCENES, LECTURE_SCENES, LECTURES
from lessons.scene_edits import scene_digest
from lessons.scenes import CATALOGUE, BuiltInScene
from lessons.world_scenes import TEACHING_SIZE
from widgets.basics.accessibility import announce, give_focus
from widgets.basics.controls import button_with_tip, column_layout, keep_room, row_layout, text_label
from widgets.basics.image import display_image
from widgets.basics.theme import current_theme, theme_notifier
from widgets.lessons.lesson_list import LessonList
from widgets.scene.cards import PICTURE, SceneCards, SceneEntry

if TYPE_CHECKING:
    from app.files.preferences import Preferences


FIRST = CATALOGUE[0].name
WHAT = (
    "Why does a pixel have its colour? Rasterscope steps from triangles to pixels, "
    "through every stage of the pipeline, forwards and backwards."
)
PAINTED_MS = 20
"""Milliseconds from showing the page until it is painted, and nothing else has to be done first."""
MOST_RECENT = 6
HIDDEN = "Hidden while an exercise or a lesson asks about this scene"
"""What stands for the picture of a scene."""
NONE_FOUND = "No lesson and no scene has these words."
OF_MESH = 8
"""Size of the picture of a mesh, in those of the cards' unit: it is shown smaller, so that its edges are smooth."""
SCROLLS = {
    Qt.Key.Key_PageUp: QAbstractSlider.SliderAction.SliderPageStepSub,
    Qt.Key.Key_PageDown: QAbstractSlider.SliderAction.SliderPageStepAdd,
    Qt.Key.Key_Home: QAbstractSlider.SliderAction.SliderToMinimum,
    Qt.Key.Key_End: QAbstractSlider.SliderAction.SliderToMaximum,
}
"""What keys do to the scenes."""
SCROLL_STEP = 60
"""Pixels of a line that the wheel scrolls, three at a notch: a row of cards takes two notches."""
SIDE = 300
"""Width of the left column in pixels at a text size of 13."""


class StartPage(Page):
    """Left what to begin with, right the lessons and the scenes."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._job = Job(self, (), succeeded=self._show_picture)
        """Draws a picture."""
        self._painted = QTimer(self)
        """Runs until the page that is shown is painted."""
        self._painted.setSingleShot(True)
        self._painted.setInterval(PAINTED_MS)
        self._painted.timeout.connect(self._fill)
        self._moved = QTimer(self, singleShot=True)
        """Runs until other scenes are in sight."""
        self._moved.timeout.connect(self._draw_next)
        self.cards = SceneCards(self)
        groups = {"Scenes": CATALOGUE, **{LECTURES[name]: scenes for name, scenes in LECTURE_SCENES.items()}}
        self.cards.show_scenes(
            {title: [SceneEntry(s.name, s.title, s.card) for s in scenes] for title, scenes in groups.items()}
        )
        self.cards.scene_chosen.connect(self.open_requested)
        self.lesson_list = LessonList(self)
        self.search = QLineEdit(self, placeholderText="Find a lesson or a scene", clearButtonEnabled=True)
        self.search.setAccessibleName("Find a lesson or a scene")
        self.search.installEventFilter(self)
        self.search.textChanged.connect(self._find)
        self.search.returnPressed.connect(self._open_first)
        self.none_found = text_label(NONE_FOUND, self, role="muted")
        self.none_found.hide()
        self.cards.hide()  # Below the lessons, whose height is not known yet.
        self.lessons = LessonsPresenter(self.lesson_list, self)
        self.lessons.job.ended.connect(self._show_scenes)
        self.lessons.lesson_requested.connect(self.lesson_requested)
        self.lessons.place_changed.connect(self._show_place)
        self.lessons.refused.connect(self.edit_refused)
        self.lesson_button = button_with_tip("", "Open this lesson at its next step", self)
        self.lesson_button.clicked.connect(self.lessons.go_on)
        self.lesson_button.setProperty("role", "primary")
        self.lesson_button.hide()
        keep_room(self.lesson_button)  # Before it is known which lesson it begins.
        self.begin_button = button_with_tip(
            "Begin with one triangle", "Open the scene with one triangle", self
        )
        self.begin_button.clicked.connect(self._begin)
        self.open_button = self._action_button("Open a mesh or state…", "open_file", "Open a file (Ctrl+O)")
        self.guide_button = self._action_button(
            "Five-minute guide", "help_guide", "Learn the program step by step"
        )
        self.keys_button = self._action_button("All keys", "show_keys", "Everything that a key does (?)")
        self.always_box = QCheckBox("Show this page at every start", self)
        self.always_box.toggled.connect(self._choose_always)
        self.now_label = text_label("", self, wraps=True)
        self._recent = QWidget(self)
        self._recent_rows = column_layout(self._recent, 4)
        row = row_layout(self, 16, margins=(16, 8, 8, 8))
        self._panes = _scrolled("Begin", self), _scrolled("Lessons and scenes", self)
        self._side_pane, scenes = (QWidget(pane.viewport()) for pane in self._panes)
        for pane, content in zip(self._panes, (self._side_pane, scenes), strict=True):
            pane.setWidget(content)
        bar = self._panes[1].verticalScrollBar()
        for moved in (bar.valueChanged, bar.rangeChanged, self.lessons.job.ended):
            moved.connect(self._look)
        self._fill_side(self._side_pane)
        self._fill_scenes(scenes)
        row.addWidget(self._panes[0])
        row.addWidget(self._panes[1], 1)
        theme_notifier().theme_changed.connect(self._set_widths)
        session.changed.connect(self._follow)
        self._digests: dict[str, str] = {}
        """Of the scenes whose pictures are there, by name."""
        self._show_document()
        self.show_recent(())

    def _action_button(self, text: str, action: str, tip: str) -> QPushButton:
        button = button_with_tip(text, tip, self)
        button.setObjectName(action)
        button.clicked.connect(self._act)
        return button

    def _fill_side(self, side: QWidget) -> None:
        layout = column_layout(side, 8, margins=(0, 8, 12, 8))
        layout.addWidget(text_label("Rasterscope", side, role="title"))
        layout.addWidget(text_label(WHAT, side, wraps=True))
        layout.addSpacing(8)
        layout.addWidget(self.lesson_button)
        layout.addWidget(self.begin_button)
        layout.addWidget(self.now_label)
        layout.addSpacing(8)
        for button in (self.open_button, self.guide_button, self.keys_button):
            layout.addWidget(button)
        hint = "Or drop a file on the window: OBJ, PLY, STL, OFF, glTF, GLB, XYZ, DXF, or a lesson."
        layout.addWidget(text_label(hint, side, role="muted", wraps=True))
        layout.addSpacing(8)
        layout.addWidget(text_label("Recent files", side, role="strong"))
        layout.addWidget(self._recent)
        layout.addStretch(1)
        layout.addWidget(self.always_box)

    def _fill_scenes(self, pane: QWidget) -> None:
        layout = column_layout(pane, 8, margins=(0, 8, 8, 8))
        layout.addWidget(self.search)
        layout.addWidget(self.none_found)
        layout.addWidget(self.lesson_list)
        layout.addSpacing(8)
        layout.addWidget(self.cards)
        layout.addStretch(1)

    # What is shown.

    def show_preferences(self, preferences: "Preferences") -> None:
        """Show the recent files, and whether the page is wanted at every start."""
        self.show_recent(preferences.recent_files)
        self.always_box.setChecked(preferences.shows_start)

    def show_recent(self, paths: "tuple[str, ...] | list[str]") -> None:
        """Show the files that were open last, of those that can be had now."""
        for row in self._recent.findChildren(QWidget, options=Qt.FindChildOption.FindDirectChildrenOnly):
            row.hide()
            row.deleteLater()
            self._recent_rows.removeWidget(row)
        for path in [path for path in paths if os.path.isfile(path)][:MOST_RECENT]:
            button = button_with_tip(os.path.basename(path), path, self._recent)
            button.setObjectName(path)
            button.clicked.connect(self._open_recent)
            self._recent_rows.addWidget(button)
        if not self._recent_rows.count():
            self._recent_rows.addWidget(text_label("No files yet.", self._recent, role="muted"))

    @Slot()
    def _show_scenes(self) -> None:
        """Show the scenes where they stay: the lessons above them are there, or cannot be listed."""
        keep_room(self.lesson_button, False)
        self.cards.show()

    @Slot(str)
    def _find(self, text: str) -> None:
        """Show the lessons and scenes that have all words of a text."""
        words = text.casefold().split()
        count = self.lesson_list.show_only(words) + self.cards.show_only(words)
        self.none_found.setHidden(count > 0)
        announce(self.search, "" if not words else counted(count, "lesson or scene", "lessons and scenes"))

    @Slot()
    def _open_first(self) -> None:
        """Open the lesson or scene that was found: the one of this title, else one that begins so, else the first."""
        text = self.search.text().strip().casefold()
        cards = [card for card in (*self.lesson_list.cards, *self.cards.cards) if card.isVisible()]
        if text and cards:
            titles = {card: card.text().casefold() for card in cards}
            min(cards, key=lambda card: (titles[card] != text, not titles[card].startswith(text))).click()

    @Slot(Change)
    def _follow(self, what: Change) -> None:
        if Change.DOCUMENT in what:
            self._show_document()
        if Change.ASKED in what:
            self._hide_asked()
            self._show_document()

    def _show_document(self) -> None:
        title = self._session.document.title
        title = f"“{title}”" if title else "a scene"
        if self._session.is_asked_about:
            self.now_label.setText(f"Open now: a question about {title}. Press Right to go back to it.")
            return
        self.now_label.setText(f"Open now: {title}. Press Right for its next step, Left to go back.")

    @Slot()
    def _show_place(self) -> None:
        """Offer the lesson with which to begin, or in which to go on."""
        place, is_new = self.lessons.place, self.lesson_button.isHidden()
        self.lesson_button.setText("" if place is None else place.button)
        self.lesson_button.setVisible(place is not None)
        self._set_widths()
        if is_new and self.begin_button.hasFocus():
            self.take_focus()  # Return begins with the lesson.

    @property
    def is_drawing(self) -> bool:
        """Whether pictures are still being drawn, or lessons read."""
        is_due = self._painted.isActive() or self._moved.isActive()
        return is_due or self._job.is_running or self.lessons.job.is_running

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Give the left column the width that its text needs, if the scenes keep most of the page."""
        super().resizeEvent(event)
        self._set_widths()

    @Slot()
    def _set_widths(self) -> None:
        wanted = min(round(SIDE * current_theme().text_px / 13), self.width() * 2 // 5)
        self._panes[0].setFixedWidth(max(wanted, self._side_pane.minimumSizeHint().width()))

    def showEvent(self, event: QShowEvent) -> None:
        """Begin to read and to draw in the background, once the page is painted."""
        super().showEvent(event)
        self._painted.start()

    @Slot()
    def _fill(self) -> None:
        """List the lessons as they are now: the scenes come below them."""
        self.lessons.refresh()

    @Slot()
    def _look(self) -> None:
        self._moved.start()

    @Slot()
    def _draw_next(self) -> None:
        """Draw the picture that is missing nearest to what is in sight, one after the other."""
        if self.is_drawing or not self.isVisible():
            return
        pane = self._panes[1].viewport()
        name = self.cards.next_without_picture(self.cards.mapFrom(pane, QPoint()).y(), pane.height())
        if name:
            self._job.call(partial(drawn, ALL_SCENES[name]))

    @Slot(object)
    def _show_picture(self, picture: tuple[str, str, NDArray[np.uint8]]) -> None:
        name, self._digests[name], pixels = picture
        self._hide_asked()
        self.cards.show_picture(name, display_image(pixels))
        self._draw_next()

    def _hide_asked(self) -> None:
        """Hide the picture of a scene that an exercise or a lesson asks about."""
        asked = self._session.asked_scenes
        self.cards.hide_pictures({name for name, digest in self._digests.items() if digest in asked}, HIDDEN)

    # What is done.

    def step_on(self) -> None:
        """Go to the Step page, one step on; a question there is unchanged."""
        self.action_requested.emit("page_step")
        if not self._session.is_asked_about:
            self.action_requested.emit("step_forward")

    def begin_search(self) -> None:
        """Take the keyboard to the field that finds."""
        give_focus(self.search, Qt.FocusReason.ShortcutFocusReason)
        self.search.selectAll()

    def dismiss(self) -> bool:
        """Go back to the Step page."""
        self.action_requested.emit("page_step")
        return True

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Let Escape clear what is looked for, before it leaves the field."""
        is_escape = isinstance(event, QKeyEvent) and event.key() == Qt.Key.Key_Escape
        if not (is_escape and watched is self.search and self.search.text()):
            return False
        if event.type() == QEvent.Type.ShortcutOverride:
            event.accept()
        elif event.type() == QEvent.Type.KeyPress:
            self.search.clear()
        return True

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Press a button with Return; scroll the scenes, wherever the keyboard is."""
        focused, scroll = self.focusWidget(), SCROLLS.get(Qt.Key(event.key()))
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and isinstance(focused, QAbstractButton):
            focused.click()
        elif scroll is not None:
            self._panes[1].verticalScrollBar().triggerAction(scroll)
        else:
            super().keyPressEvent(event)

    @Slot(bool)
    def _choose_always(self, is_wanted: bool) -> None:
        self.preference_changed.emit("shows_start", is_wanted)

    @Slot()
    def _begin(self) -> None:
        self.open_requested.emit(FIRST)

    @Slot()
    def _act(self) -> None:
        self.action_requested.emit(self.sender().objectName())

    @Slot()
    def _open_recent(self) -> None:
        self.open_requested.emit(self.sender().objectName())

    def main_view(self) -> QWidget:
        """Return where the keyboard begins."""
        return self._panes[0]

    def focus_panes(self) -> list[QWidget]:
        """Return what F6 goes through after that."""
        return [self._panes[1]]

    def leave(self) -> None:
        """Draw no further: what is missing is drawn when the page is shown again."""
        self._painted.stop()
        self.lessons.rest.stop()
        self._job.cancel()

    def stop(self) -> None:
        """End drawing and reading."""
        self._painted.stop()
        self._moved.stop()
        self.lessons.rest.stop()
        super().stop()


def drawn(built_in: BuiltInScene) -> tuple[str, str, NDArray[np.uint8]]:
    """Return name, digest and picture of a built-in scene, as `picture_of`."""
    scene = built_in.make()
    return built_in.name, scene_digest(scene), picture_of(built_in, scene)


def picture_of(built_in: BuiltInScene, scene: AnyScene) -> NDArray[np.uint8]:
    """Return the picture of a built-in scene, (H, W, 4) uint8: a teaching raster unchanged, a mesh in more pixels."""
    if isinstance(scene, Scene) and scene.size != TEACHING_SIZE:
        scene = replace(scene, size=(OF_MESH * PICTURE.width(), OF_MESH * PICTURE.height()))
    return draw_picture(scene, settings_from_texts(built_in.settings)).pixels


class _Pane(QScrollArea):
    """A part of the page that scrolls where the window is too low; keys are left to the page."""

    def keyPressEvent(self, event: QKeyEvent) -> None:
        event.ignore()


def _scrolled(name: str, parent: QWidget) -> QScrollArea:
    """Return a part of the page, to be filled."""
    area = _Pane(parent)
    area.verticalScrollBar().setSingleStep(SCROLL_STEP)
    area.setWidgetResizable(True)
    area.setFrameShape(QScrollArea.Shape.NoFrame)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    area.setAccessibleName(name)
    return area
