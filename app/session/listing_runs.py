"""Runs of edited listings as side B of A | B: what can be edited, the settings that run it, and how it is called."""

from dataclasses import replace
from difflib import SequenceMatcher

from app.session.document import Document
from core import Settings
from core.edits.edit import Edit, edited_settings, original, place_of
from core.edits.editable import EDITABLE, refusal
from core.methods import ReplacedName, table
from core.records.listing import EditedListing, Listing
from core.records.words import counted, joined

NOT_EDITABLE = "This listing cannot be edited: it is a fixed part of the pipeline."


def method_of(edit: Edit) -> str:
    """Return the title of the method whose listing is edited."""
    return table.get(EDITABLE[edit.part].family, edit.of).title


def title_as_edited(edits: tuple[Edit, ...]) -> str:
    """Return what B is called while it runs edited listings."""
    names = joined([f"“{edit.name}”" for edit in edits if edit.name])
    return f"my version{' ' * bool(names)}{names}: {', '.join(dict.fromkeys(map(method_of, edits)))}"


def settings_as_edited(document: Document) -> tuple[Settings, Settings]:
    """Return the settings of a document with the methods as they are, and with its edited listings in their place.

    Raises ValueError as `core.edits.edited_settings`.
    """
    return edited_settings(document.settings, document.scene, document.edits)


def with_edit(document: Document, edit: Edit) -> Document:
    """Return a document whose side B runs an edit, too; a text that is the listing again is no edit."""
    others = tuple(known for known in document.edits if known.part != edit.part)
    is_original = edit.text.strip("\n") == original(edit.part, edit.of).source.strip("\n")
    return replace(document, edits=others if is_original else (*others, edit))


def without_edit(document: Document, part: str) -> Document:
    """Return a document whose side B runs a listing as it is."""
    return replace(document, edits=tuple(known for known in document.edits if known.part != part))


def named(document: Document, place: tuple[str, str], name: str) -> Document:
    """Return a document in which the edit of a part and method has a name."""
    edits = (replace(edit, name=name) if (edit.part, edit.of) == place else edit for edit in document.edits)
    return replace(document, edits=tuple(edits))


def edit_of(document: Document, place: tuple[str, str] | None) -> Edit | None:
    """Return the edit of a part and method that a document has."""
    return next((edit for edit in document.edits if (edit.part, edit.of) == place), None)


def edited_place(listing: Listing | None, document: Document) -> tuple[str, str] | None:
    """Return part and method of an edit of a listing that is shown; ``None``: it cannot be edited."""
    if listing is None:
        return None
    for edit in document.edits:
        right = original(edit.part, edit.of)
        shown = listing.original if isinstance(listing, EditedListing) else listing
        if shown.function is right.function:
            return edit.part, edit.of
    return place_of(listing, document.settings)


def why_not(listing: Listing | None, stage: str, document: Document) -> str:
    """Return why a listing of a stage cannot be edited, as a sentence; empty: it can."""
    if listing is None or edited_place(listing, document) is not None:
        return ""
    for name, part in EDITABLE.items():
        chosen = getattr(document.settings, part.family)
        of = chosen.method.name if isinstance(chosen, ReplacedName) else str(chosen)
        reason = refusal(name, of) if part.stage == stage else ""
        if reason:
            return reason
    return NOT_EDITABLE


def changed_lines(old: str, new: str) -> tuple[frozenset[int], frozenset[int]]:
    """Return the lines, from 1, that differ: of the old text, and of the new one."""
    before, after = old.strip("\n").splitlines(), new.strip("\n").splitlines()
    found: tuple[set[int], set[int]] = set(), set()
    for tag, first, end, new_first, new_end in SequenceMatcher(None, before, after, False).get_opcodes():
        if tag != "equal":
            found[0].update(range(first + 1, end + 1))
            found[1].update(range(new_first + 1, new_end + 1))
    return frozenset(found[0]), frozenset(found[1])


def changed_text(old: str, new: str) -> str:
    """Return how many lines of a listing are changed, or gone."""
    gone, changed = changed_lines(old, new)
    if changed:
        return f"{counted(len(changed), 'line')} changed"
    return f"{counted(len(gone), 'line')} taken out" if gone else ""
