"""Changing keys: takes the user's wishes, refuses what is taken, and tells who shows keys."""

from collections.abc import Sequence
from dataclasses import replace

from PySide6.QtCore import QObject, Signal, Slot
from PySide6.QtWidgets import QWidget

from app.window.key_choices import KeyChoices
from app.window.keys import KeyAction, key_text
from widgets.basics.key_editor import KeyEditor
from widgets.basics.key_help import KeyEntry


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
