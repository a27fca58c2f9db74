"""An edit: which listing a text stands for; and the settings that run it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from typing import TYPE_CHECKING, Any

from core.edits.editable import EDITABLE, Part, refusal
from core.families import suited
from core.methods import Method, ReplacedName, table
from core.records.listing import EditedListing, Listing, listing
from core.settings import Settings, no_effect, with_method

if TYPE_CHECKING:
    from core.edits.typed import Typed


@dataclass(frozen=True)
class Edit:
    """A text in place of the listing of one method."""

    part: str
    """A key of `EDITABLE`."""
    of: str
    """Name of the method whose listing is edited."""
    text: str
    name: str = ""
    """What the user calls it; empty: it has no name."""

    def __post_init__(self) -> None:
        if reason := refusal(self.part, self.of):
            raise ValueError(reason)

    @property
    def title(self) -> str:
        """What it is called in a sentence, as ``the edited line Bresenham, integers``."""
        part = EDITABLE[self.part]
        return f"the edited {part.noun} of {table.get(part.family, self.of).title}"

    def passed_over(self, settings: Settings, scene: Any) -> str:
        """Return why these settings, or this scene, would not run it, as a sentence; empty: they do."""
        part = EDITABLE[self.part]
        if scene is None:
            return part.passed_over(settings, None)
        reason = no_effect(settings, part.family, scene)
        return reason or part.passed_over(suited(settings, scene), scene)


def original(part: str, of: str) -> Listing:
    """Return the listing that is edited: below it stand those that it calls."""
    return _original(_function(part, of))


@cache
def _original(function: Callable[..., Any]) -> Listing:
    from core.edits.typed import with_called  # With the language of listings, as all that runs an edit.

    return replace(listing(function), source=with_called(function))


def _function(part: str, of: str) -> Callable[..., Any]:
    if reason := refusal(part, of):
        raise ValueError(reason)
    function = EDITABLE[part].function(table.get(EDITABLE[part].family, of))
    assert function is not None
    return function


def apply_edit(settings: Settings, edit: Edit) -> Settings:
    """Return settings that choose the method of an edit and run its text; other edits stay.

    Raises
    ------
    Problem
        For a text that cannot run: it is run on no lanes, through all branches.
    ValueError
        For settings that would never run it.
    """
    part, family = EDITABLE[edit.part], EDITABLE[edit.part].family
    _check(part, _typed(edit))
    others = [known for known in edits_of(settings) if known.part != edit.part]
    kept = [known for known in others if EDITABLE[known.part].family == family and known.of == edit.of]
    plain = with_method(settings, family, edit.of)
    method = replace(table.get(family, edit.of), title=f"{table.get(family, edit.of).title} (edited)")
    for known in (*kept, edit):
        method = _edited(method, known, EDITABLE[known.part])
    changed = plain.replaced(**{family: method})
    if reason := edit.passed_over(changed, None):
        raise ValueError(f"{edit.title} would not run: {reason[0].lower()}{reason[1:].rstrip('.')}")
    return changed


@lru_cache(64)
def _check(part: Part, typed: "Typed") -> None:
    """Raise `Problem` for a text that cannot run; one that can is checked once, as its loops may take long."""
    part.check(typed)


def _edited(method: Method, edit: Edit, part: Part) -> Method:
    return replace(part.made(method, _typed(edit)), edits=(*method.edits, edit))


def _typed(edit: Edit) -> "Typed":
    from core.edits.typed import Typed

    return Typed(_function(edit.part, edit.of), edit.text)


def edits_of(settings: Settings) -> tuple[Edit, ...]:
    """Return the edits that settings run."""
    return tuple(edit for method in settings.replacements.values() for edit in method.edits)


def edited_settings(settings: Settings, scene: Any, edits: Sequence[Edit]) -> tuple[Settings, Settings]:
    """Return settings with the methods that are edited as they are, and with all edits in their place.

    An edit that the scene would pass over sleeps where another one was made since. Raises ValueError (`Problem` with
    a place in the text) where a text cannot run, or the last one not here.
    """
    mine = other = settings
    for edit in edits:
        if edit is not edits[-1] and edit.passed_over(settings, scene):
            continue
        mine = with_method(mine, EDITABLE[edit.part].family, edit.of)
        other = apply_edit(other, edit)
    return mine, other


def without_edits(settings: Settings) -> Settings:
    """Return settings with the methods whose listings were edited; other replaced functions stay."""
    for family, method in settings.replacements.items():
        if method.edits:
            settings = with_method(settings, family, method.name)
    return settings


def place_of(shown: Listing, settings: Settings) -> tuple[str, str] | None:
    """Return part and method of an edit of a listing that is shown; ``None``: it cannot be edited."""
    right = shown.original.function if isinstance(shown, EditedListing) else shown.function
    for name, part in EDITABLE.items():
        chosen = getattr(settings, part.family)
        of = chosen.method.name if isinstance(chosen, ReplacedName) else chosen
        if not refusal(name, of) and _function(name, of) is right:
            return name, of
    return None
