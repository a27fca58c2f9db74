"""What a key is for, how it is shown, which keys widgets have a use for themselves, and the user's own choices."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeVar

from PySide6.QtCore import QObject, Qt, Signal, Slot
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSpinBox,
    QComboBox,
    QRadioButton,
    QSplitterHandle,
    QTabBar,
    QWidget,
)

from widgets.basics.key_pages import KeyEditor, KeyEntry

# What a key is for, how it is shown, and which keys widgets have a use for themselves.


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


STEPPING = "Stepping"
POINTING = "Pixels"
STAGE_GROUP = "Stages"
RUNNING = "Run to"
VIEWING = "View"
EDITING = "Edit"
FILES = "Files"
PAGES = "Pages"
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
            "Presenting: start of the run; there, on Start, or in a lesson, open a lesson, scene or state",
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
            "page_text",
            ("PgDown", "PgUp"),
            "While a listing or a shader is typed: a page down or up in it; presenting a lesson: the clicker’s",
            EDITING,
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


# Which keys the user has: those of the table, but for what is changed or turned off.


@dataclass(frozen=True)
class KeyChoices:
    """Changed keys by the names of their actions, and whether characters alone are keys."""

    changed: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    has_characters: bool = True
    """Whether letters, digits and signs do something without Ctrl or Alt."""

    def keys_of(self, action: KeyAction) -> tuple[str, ...]:
        """Return the keys of an action, as Qt's portable texts."""
        keys = self.changed.get(action.name, action.keys)
        return keys if self.has_characters else tuple(key for key in keys if not is_character(key))

    def table(self, actions: Iterable[KeyAction]) -> list[KeyAction]:
        """Return actions with the keys that they have now."""
        return [replace(action, keys=self.keys_of(action)) for action in actions]

    def with_keys(
        self, action: KeyAction, keys: tuple[str, ...], actions: Iterable[KeyAction]
    ) -> "KeyChoices":
        """Return the choices with other keys for one of the actions.

        Raises ValueError if one of them is the key of another action on the same page; the message is a sentence.
        """
        wanted = {portable(key): key for key in keys}
        for other in actions:
            meets = other.name != action.name and (
                other.page == action.page or not (other.page and action.page)
            )
            taken = wanted.keys() & {portable(key) for key in self.keys_of(other)} if meets else set()
            for key in taken:
                raise ValueError(f"{wanted[key]} is the key for “{other.title}”. Change that key first.")
        changed = {name: value for name, value in self.changed.items() if name != action.name}
        if keys != action.keys:
            changed[action.name] = keys
        return replace(self, changed=changed)


def portable(key: str) -> str:
    """Return one spelling of a key, as Qt has it."""
    return QKeySequence(key).toString(QKeySequence.SequenceFormat.PortableText)


def is_character(key: str) -> bool:
    """Return whether a key is a letter, digit or sign without Ctrl and Alt, which speech input types by the way."""
    return len(key.removeprefix("Shift+")) == 1


def choices_from(
    changed: Mapping[str, Iterable[str]], has_characters: bool, actions: Sequence[KeyAction]
) -> KeyChoices:
    """Return the choices that were saved, less actions that there are no more, and keys that are taken."""
    wanted = {
        action: tuple(filter(portable, changed[action.name])) for action in actions if action.name in changed
    }
    choices = KeyChoices({action.name: () for action in wanted}, has_characters)
    for action, keys in wanted.items():
        try:
            choices = choices.with_keys(action, keys, actions)
        except ValueError:
            kept = {name: value for name, value in choices.changed.items() if name != action.name}
            choices = replace(choices, changed=kept)
    return choices


# Changing keys: takes the user's wishes, refuses what is taken, and tells who shows keys.


class KeyDesk(QObject):
    """Holds the keys of a window and the page on which they are changed."""

    keys_changed = Signal(object)
    """The `KeyChoices` that hold now."""

    def __init__(self, window: QWidget, actions: Sequence[KeyAction]) -> None:
        super().__init__(window)
        self.actions = actions
        self.choices = KeyChoices()
        self.editor = KeyEditor(window)
        self.editor.hide()
        self.editor.closed.connect(self.editor.hide)
        self.editor.key_wanted.connect(self._take)
        self.editor.default_wanted.connect(self._restore)
        self.editor.characters_wanted.connect(self._allow_characters)

    def set_choices(self, choices: KeyChoices) -> None:
        """Let other keys hold, and tell."""
        if choices != self.choices:
            self.choices = choices
            self.keys_changed.emit(choices)
        self.show_table()

    def show_table(self) -> None:
        """Show the present keys on the page, if it is open."""
        if self.editor.isVisible():
            table = self.choices.table(self.actions)
            entries = [
                KeyEntry(f"{a.page.capitalize()}: {a.group}" if a.page else a.group, key_text(a), a.title)
                for a in table
            ]
            self.editor.show_keys(entries, self.choices.has_characters)

    @Slot(int, str)
    def _take(self, place: int, key: str) -> None:
        self._change(place, (key,) if key else ())

    @Slot(int)
    def _restore(self, place: int) -> None:
        self._change(place, self.actions[place].keys)

    def _change(self, place: int, keys: tuple[str, ...]) -> None:
        action = self.actions[place]
        try:
            self.set_choices(self.choices.with_keys(action, keys, self.actions))
        except ValueError as error:
            self.editor.show_note(f"{error}", is_problem=True)
        else:
            self.editor.show_note(f"{action.title}: {', '.join(keys) or 'no key'}")

    @Slot(bool)
    def _allow_characters(self, is_allowed: bool) -> None:
        self.set_choices(replace(self.choices, has_characters=is_allowed))
