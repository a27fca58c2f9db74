"""Runs of listings as slides print them, as side B of A | B, beside the right method as side A."""

from dataclasses import replace

import numpy as np

from app.session.document import Document
from core import Settings
from core.settings import no_effect, with_method
from core.trace.stage_trace import StageTrace
from lessons.lectures.catalogue import PRINTED, printed_listing
from lessons.lectures.printed import ListedLines, PrintedListing

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
