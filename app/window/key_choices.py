"""Which keys the user has: those of the table, but for what is changed or turned off."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from PySide6.QtGui import QKeySequence

from app.window.keys import KeyAction


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
