"""What A | B shows of two runs at their cursors: each one's buffer and step, and where the buffers differ."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from app.pages.step.grid_presenter import OUTLINING
from app.pages.step.grid_records import buffers_of, geometry_of, mask_overlays
from app.pages.step.step_mark import step_mark
from app.pages.step.steps_ahead import sentence_at
from app.session.cursor import Cursor
from app.session.moment import Step
from core import STAGES, Trace
from core.records.arrays import Flags
from widgets.grid.buffer import GridBuffer, number_text
from widgets.grid.compare_view import Comparison, Side
from widgets.grid.geometry import GridGeometry
from widgets.grid.overlay import Mark, MaskOverlay
from widgets.inspector.listing import ListingText

OTHER = "read them at a pixel, or choose a buffer that both share."
SHOWN_MARKS = ("rejected", "tie", "nan", "failed")
"""Marks of rows done that lie over the pictures."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Place(Step):
    """Where one of two runs is that are stepped together."""

    done: int | None = None
    """Steps of the level that are done; ``None``: they are not counted."""
    step_count: int = 0
    """Steps of the level that there are."""
    waits: bool = False
    """Whether only the other run has steps left."""


class Outlines:
    """The triangles of two runs, made anew only where they change."""

    def __init__(self) -> None:
        self._known: dict[tuple[Trace, str, int], GridGeometry] = {}

    def of(self, place: Place) -> GridGeometry:
        """Return those of a run at its place."""
        cursor = place.cursor if place.cursor.stage in OUTLINING else Cursor(STAGES[-1])
        key = place.trace, cursor.stage, cursor.position
        if key not in self._known:
            if len(self._known) > 2:
                self._known.clear()
            self._known[key] = geometry_of(replace(place, cursor=cursor))
        return self._known[key]


def buffers_at(place: Place) -> dict[str, GridBuffer]:
    """Return the buffers of a run by name."""
    return {buffer.name: buffer for buffer in buffers_of(place)}


def first_comparable(buffers: Sequence[dict[str, GridBuffer]]) -> str:
    """Return the name of the first buffer that holds the same in all runs, or else of the first one."""
    first, *others = buffers
    for name, buffer in first.items():
        if all(name in other and _hold_the_same(buffer, other[name]) for other in others):
            return name
    return next(iter(first))


def _hold_the_same(a: GridBuffer, b: GridBuffer) -> bool:
    """Return whether it is not other numbers for the same thing, as 16 bits and 1/w for a depth."""
    return a.kind != "scalar" or (a.unit, a.description) == (b.unit, b.description)


def side_of(
    name: str,
    settings: str,
    place: Place,
    geometry: GridGeometry,
    buffer: GridBuffer | None,
    wanted: str,
    has_listing: bool = False,
) -> Side:
    """Return one picture: ``name`` is A or B, ``settings`` what it draws with, ``wanted`` the buffer compared.

    With ``has_listing``, its listing comes along, with the line that has just run.
    """
    counted = "" if place.done is None else f"step {place.done:,} of {place.step_count:,}"
    if place.waits:
        end = "all its steps are done" if place.done else "its first step comes later"
        counted = f"{name} waits: {end} ({counted})"
    elif place.done == place.step_count == 0:
        counted = "no steps in this stage"
    reason = "" if buffer is not None else f"{name} has no buffer “{wanted}” in this stage."
    if buffer is not None and place.step_count and place.done == place.step_count and _is_empty(buffer):
        counted += "; it gives no pixel a value"
    explanation = place.explanation if has_listing else None
    listing = None if explanation is None else explanation.listing
    return Side(
        name=name,
        title=f"{name}: {settings}",
        place=counted,
        sentence=sentence_at(place),
        buffer=buffer,
        reason=reason,
        overlays=tuple(overlay for overlay in mask_overlays(place) if overlay.key in SHOWN_MARKS),
        geometry=geometry,
        step=step_mark(place),
        listing=None if listing is None else ListingText(listing.name, listing.source, listing.purpose),
        line=explanation.line if explanation is not None else 0,
    )


def _is_empty(buffer: GridBuffer) -> bool:
    if buffer.kind == "bool":
        return not buffer.values.any()
    return buffer.known is not None and not buffer.known.any()


def compare(first: Side, second: Side) -> Comparison:
    """Return two sides with their difference, B minus A; of colours the largest channel."""
    a, b = first.buffer, second.buffer
    if a is None or b is None:
        return Comparison(first, second, None, "There is nothing to compare: one side is blank.")
    if a.values.shape != b.values.shape:
        return Comparison(first, second, None, "The two buffers have different numbers of channels.")
    if not _hold_the_same(a, b):
        return Comparison(first, second, None, f"“{a.label}” holds other numbers in A and in B: {OTHER}")
    if a.kind in ("scalar", "signed"):
        scale = _common_range(a, b)
        a, b = replace(a, range=scale), replace(b, range=scale)
        first, second = replace(first, buffer=a), replace(second, buffer=b)
    with np.errstate(invalid="ignore"):
        # Two infinities are equal, and not a number apart.
        amount = np.where(a.values == b.values, 0.0, b.values.astype(float) - a.values.astype(float))
        changed = (a.values != b.values) & ~(np.isnan(amount) & ~_is_one_nan(a, b))
    if amount.ndim == 3:
        changed = changed.any(axis=2)
        largest = np.abs(np.nan_to_num(amount)).argmax(axis=2)
        amount = np.take_along_axis(amount, largest[..., None], axis=2)[..., 0]
    ours, theirs = _known(a), _known(b)
    is_choice = a.kind in ("ids", "bool")
    in_a, in_b = (_has(buffer) for buffer in (a, b)) if is_choice else (ours, theirs)
    # A pixel that one run has found outside, and the other has not reached, is in neither.
    differs = (in_a != in_b) | (changed & in_a & in_b)
    count = int(np.count_nonzero(differs))
    summary = f"{count:,} of {differs.size:,} pixels differ"
    if is_choice:
        if (in_a != in_b).any():
            only = np.count_nonzero(in_a & ~in_b), np.count_nonzero(in_b & ~in_a)
            summary += f"; {only[0]:,} only in A, {only[1]:,} only in B"
        amount = differs.astype(float)
    else:
        both = differs & ours & theirs
        if both.any():
            summary += f"; largest difference {number_text(float(np.nanmax(np.abs(amount[both]))))}"
        if (ours != theirs).any():
            summary += f"; {np.count_nonzero(ours != theirs):,} reached by one of them only"
    difference = GridBuffer(
        "difference",
        amount,
        "bool" if is_choice else "signed",
        origin=a.origin,
        known=None if is_choice else ours & theirs,
    )
    # What both have reached is told by the colours.
    marks = () if is_choice else (MaskOverlay("difference", Mark.DIFFERENCE, ours != theirs),)
    return Comparison(first, second, difference, summary + ".", marks)


def _is_one_nan(a: GridBuffer, b: GridBuffer) -> Flags:
    """Return where one of two values is not a number and the other one is."""
    found: Flags = np.isnan(a.values.astype(float)) != np.isnan(b.values.astype(float))
    return found


def _known(buffer: GridBuffer) -> Flags:
    return np.ones(buffer.values.shape[:2], bool) if buffer.known is None else buffer.known


def _has(buffer: GridBuffer) -> Flags:
    """Return which pixels are covered, or belong to a triangle."""
    held = buffer.values.reshape(*buffer.values.shape[:2], -1)[..., 0].astype(float)
    found: Flags = (held >= 0 if buffer.kind == "ids" else held != 0) & _known(buffer)
    return found


def _common_range(a: GridBuffer, b: GridBuffer) -> tuple[float, float] | None:
    """Return the range in which both are shown."""
    if a.range is None or b.range is None:
        values = np.concatenate([a.values[_known(a)].ravel(), b.values[_known(b)].ravel()]).astype(float)
        values = values[np.isfinite(values)]
        return (float(values.min()), float(values.max())) if values.size else None
    return min(a.range[0], b.range[0]), max(a.range[1], b.range[1])
