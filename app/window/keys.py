"""What a key is for, how it is shown, and which keys widgets have a use for themselves."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import TypeVar

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSpinBox,
    QComboBox,
    QRadioButton,
    QSplitterHandle,
    QTabBar,
    QWidget,
)


@dataclass(frozen=True)
class KeyAction:
    """Something a key does."""

    name: str
    """As ``step_forward``: links of Help, buttons and chosen keys have it."""
    keys: tuple[str, ...]
    """Qt's portable texts; the first is shown in menus."""
    title: str
    group: str
    """Heading on the ``?`` page."""
    menu: str = ""
    """Menu that it stands in; empty: none."""
    page: str = ""
    """The page on which it does something; empty: all of them."""
    ends_group: bool = field(default=False, kw_only=True)
    """Whether a line follows in the menu."""

    @property
    def is_checkable(self) -> bool:
        """Whether it switches something on and off."""
        return False


Row = TypeVar("Row", bound=KeyAction)


def on_page(page: str, *actions: Row) -> Iterator[Row]:
    """Yield actions as those of one page."""
    return (replace(action, page=page) for action in actions)


STEPPING, POINTING, STAGE_GROUP, RUNNING, VIEWING, EDITING, FILES, PAGES = (
    "Stepping",
    "Pixels",
    "Stages",
    "Run to",
    "View",
    "Edit",
    "Files",
    "Pages",
)
HELP = "Help"
LESSONS = "Lessons"
PRESENTING = "Presenting"
MEASURING = "Measuring"
EXPERIMENTS = "Experiments"
MAPS = "Maps"
CHARTS = "Charts"
PLANNING = "Planning"
ANSWERING = "Answering"

LOCAL_KEYS = (
    KeyAction("next_control", ("Tab", "Shift+Tab"), "Next, previous control", PAGES),
    KeyAction("next_button", ("Left", "Right"), "In a row of buttons: the neighbouring button", PAGES),
    KeyAction("move_border", ("Left", "Right", "Up", "Down"), "On a border between panes: move it", PAGES),
    KeyAction(
        "clicker_next",
        ("PgDown", "PgUp"),
        "Presenting: step forward, back; in a lesson: show the answer, then the next step; back likewise",
        PRESENTING,
    ),
    *on_page(
        "step",
        KeyAction(
            "clicker_start",
            ("F5",),
            "Presenting: start of the run; at the start, or in a lesson, open a lesson, scene or state",
            PRESENTING,
        ),
    ),
    KeyAction("clicker_black", ("B", "."), "Presenting: black screen, and back", PRESENTING),
    *on_page(
        "step",
        KeyAction("value_origin", ("Return",), "In Variables: go to the step that made the number", STEPPING),
        KeyAction(
            "go_to_row",
            ("Up", "Down"),
            "In Variables, Pixel history and the listing: go to the neighbouring row",
            STEPPING,
        ),
        KeyAction(
            "go_to_tab",
            ("Left", "Right"),
            "In a row of tabs: go to the neighbouring tab; in Variables: fold",
            STEPPING,
        ),
        KeyAction(
            "choose_chapter",
            ("Left", "Right", "Return"),
            "In the chapters: choose a stage and enter it",
            STEPPING,
        ),
        KeyAction(
            "leap",
            ("PgDown", "PgUp"),
            "In the chapters and the timeline, without a lesson: go on or back by a twentieth of the stage",
            STEPPING,
        ),
        KeyAction(
            "read_texel",
            ("Shift+Left", "Shift+Right", "Shift+Up", "Shift+Down"),
            "In the texture: read the next texel",
            POINTING,
        ),
    ),
    *on_page(
        "compare",
        KeyAction(
            "chart_go", ("Left", "Right", "Up", "Down"), "In a chart: go to the neighbouring point", CHARTS
        ),
        KeyAction(
            "chart_choose", ("Return",), "In a chart: open the point’s pictures, as a click does", CHARTS
        ),
        KeyAction(
            "picture_go",
            ("Left", "Right", "Up", "Down"),
            "In a picture: read the next pixel; with Shift the eighth",
            CHARTS,
        ),
        KeyAction(
            "chart_add", ("Shift+Return",), "In a chart: select a second point, as Ctrl+click does", CHARTS
        ),
    ),
    *on_page(
        "exercises",
        KeyAction(
            "mark_go",
            ("Left", "Right", "Up", "Down"),
            "On the picture: go to the neighbouring pixel",
            ANSWERING,
        ),
        KeyAction("mark_pixel", ("Space",), "On the picture: mark the pixel, or clear it", ANSWERING),
        KeyAction(
            "mark_paint",
            ("Shift+Left", "Shift+Right", "Shift+Up", "Shift+Down"),
            "On the picture: take the mark of this pixel along",
            ANSWERING,
        ),
        KeyAction("move_item", ("Alt+Up", "Alt+Down"), "In an order: move the chosen item", ANSWERING),
    ),
    *on_page(
        "stability",
        KeyAction("map_go", ("Left", "Right", "Up", "Down"), "In a map: go to the neighbouring cell", MAPS),
        KeyAction(
            "map_next",
            ("Tab",),
            "In a map: the same cell of the next map; Shift+Tab: of the previous map",
            MAPS,
        ),
        KeyAction("map_open", ("Return",), "In a map: open the chosen cell in the stepper", MAPS),
    ),
)
"""What a widget does by itself while it has the keyboard: for the page of keys only."""


def key_text(action: KeyAction) -> str:
    """Return the keys of an action as they are shown."""
    names = {"PgDown": "Page Down", "PgUp": "Page Up"}
    texts = []
    for key in action.keys:
        for short, long in names.items():
            key = key.replace(short, long)
        texts.append(key)
    return ", ".join(texts)


_PRESS = frozenset({Qt.Key.Key_Space})
_SIDEWAYS = frozenset({Qt.Key.Key_Left, Qt.Key.Key_Right})
_UP_DOWN = frozenset({Qt.Key.Key_Up, Qt.Key.Key_Down})
KEYS: tuple[tuple[type[QWidget], frozenset[Qt.Key]], ...] = (
    (QAbstractButton, _PRESS),
    (QComboBox, _PRESS),
    (QRadioButton, _UP_DOWN),
    (QAbstractSpinBox, _UP_DOWN),
    (QTabBar, _SIDEWAYS),
    (QSplitterHandle, _SIDEWAYS | _UP_DOWN),
)
"""Kinds of controls and the keys, without Ctrl and Alt, that they have a use for."""


def has_use_for(widget: QWidget | None, event: QKeyEvent) -> bool:
    """Return whether a control needs a key that is pressed while it has the focus."""
    if widget is None or event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier:
        return False
    return any(isinstance(widget, kind) and event.key() in keys for kind, keys in KEYS)
