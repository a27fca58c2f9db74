"""What `core.settings.Settings` declares of each of its fields, once: menus, titles, command line and tests read it."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from core.scene import AnyScene

Reason = Callable[[Any, AnyScene | None], str]
"""Of settings and a scene: why a setting changes nothing with them, as a sentence; empty: it does."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SettingField:
    """What is known of any setting."""

    title: str
    """What a person reads in a panel."""
    taken_by: str = ""
    """The family whose chosen method decides, by its ``takes``, whether this setting matters; empty: it always does."""
    otherwise: str = ""
    """Why it does not matter, where the chosen method does not take it."""
    reason: Reason | None = None
    """Another reason why it does not matter."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Family(SettingField):
    """A family of methods, one of which a setting chooses."""

    stage: str
    """The stage that runs the method."""
    is_look: bool = False
    """Whether it chooses what is to be seen, not how well: references take it from the settings given."""
    classical: tuple[str, ...] = ()
    """Its methods that a first course teaches; empty: a first course does without the family."""
    asks: tuple[str, ...] = ()
    """Fields of `core.methods.Method` that every method of the family fills in, ``listing`` and ``operations``."""
    files: tuple[str, ...]
    """The modules of its first methods, in the order of the menus; others are found in the first one's folder."""


@dataclass(frozen=True, eq=False, kw_only=True)
class WholeNumber(SettingField):
    """A whole number from 1 on that some methods of a family take."""

    limit: int
    """Largest that it may be."""
    offered: tuple[int, ...]
    """Those in menus."""
    label: str
    """How a menu shows one, a format of the number."""


def choice(default: str, title: str, stage: str, *files: str, **applies: Any) -> Any:
    """Declare a field of settings that chooses a method; ``applies`` are further fields of `Family`."""
    return field(
        default=default, metadata={"field": Family(title=title, stage=stage, files=files, **applies)}
    )


def number_field(
    default: int, title: str, limit: int, offered: tuple[int, ...], label: str, **applies: Any
) -> Any:
    """Declare a field of settings that is a number; ``applies`` are further fields of `WholeNumber`."""
    number = WholeNumber(title=title, limit=limit, offered=offered, label=label, **applies)
    return field(default=default, metadata={"field": number})
