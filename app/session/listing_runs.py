"""Runs of edited listings, and of listings as slides print them, as side B of A | B."""

from dataclasses import replace
from difflib import SequenceMatcher

import numpy as np

from app.session.document import Document
from core import Settings
from core.edits.edit import Edit, edited_settings, original, place_of
from core.edits.editable import EDITABLE, refusal
from core.methods import ReplacedName, table
from core.records.listing import EditedListing, Listing
from core.records.words import counted, joined
from core.settings import no_effect, with_method
from core.trace.stage_trace import StageTrace
from lessons.lectures.catalogue import PRINTED, printed_listing
from lessons.lectures.printed import ListedLines, PrintedListing

# A listing as a slide prints it as side B of A | B, beside the right method as side A.


SEGMENTS = "it draws segments: open one of the lecture's (File, Scenes of the lectures) or type one"


def runnable() -> tuple[PrintedListing, ...]:
    """Return the listings that run in the pipeline, in the order of the lectures."""
    return tuple(printed for printed in PRINTED if printed.method is not None or printed.registered)


def runnable_on(document: Document) -> tuple[PrintedListing, ...]:
    """Return those of them that run on the scene of a document."""

    def runs(printed: PrintedListing) -> bool:
        try:
            settings_as_printed(printed.name, document)
        except ValueError:
            return False
        return True

    return tuple(filter(runs, runnable()))


def title_as_printed(name: str) -> str:
    """Return what B is called while it runs a listing."""
    printed = printed_listing(name)
    return f"as printed: {printed.title} ({printed.lecture})"


def settings_as_printed(name: str, document: Document) -> tuple[Settings, Settings]:
    """Return the settings of a document with the right method, and with the listing in its place.

    Raises ValueError if the listing does not run in the pipeline, or not on this scene.
    """
    printed = printed_listing(name)
    if printed not in runnable():
        raise ValueError(f"{printed.title} ({printed.lecture}) does not run in the pipeline")
    settings = document.settings
    if printed.family == "fill":
        settings = replace(settings, polygon_mode="fill")
    mine = with_method(settings, printed.family, printed.right)
    if printed.beside is not None:
        mine = printed.beside.settings(mine)
    reason = no_effect(mine, printed.family, document.scene)
    if printed.family == "line" and document.scene.corner_count != 2:
        reason = SEGMENTS
    if reason:
        raise ValueError(f"{printed.title} ({printed.lecture}) cannot run here: {reason}")
    if printed.method is None:
        return mine, with_method(mine, printed.family, printed.registered)
    return mine, printed.settings(mine)


def without_printed(settings: Settings) -> Settings:
    """Return settings with methods of the table in place of listings that A runs beside one as printed."""
    for family, method in settings.replacements.items():
        if isinstance(method.function, ListedLines):
            settings = with_method(settings, family, method.name)
    return settings


def first_other_pixel(right: StageTrace, printed: StageTrace) -> tuple[tuple[int, int], str] | None:
    """Return the rows of both at the first step that draws another pixel, and what is said; ``None``: there is none."""
    mine, theirs = (stage.pixel[stage.marks["covered"]] for stage in (right, printed))
    rows = [np.flatnonzero(stage.marks["covered"]) for stage in (right, printed)]
    common = min(len(mine), len(theirs))
    differs = (mine[:common] != theirs[:common]).any(axis=1)
    step = int(np.argmax(differs)) if differs.any() else common
    if step == max(len(mine), len(theirs)) or not common:
        return None
    said = [
        f"draws ({', '.join(map(str, pixels[step].tolist()))})" if step < len(pixels) else "has ended"
        for pixels in (mine, theirs)
    ]
    at = [int(each[min(step, len(each) - 1)]) for each in rows]
    told = f"In the order of drawing, pixel {step + 1} is the first that differs: A {said[0]}, B {said[1]}."
    return (at[0], at[1]), told


# Edited listings as side B of A | B: what can be edited, the settings that run it, and how it is called.


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
