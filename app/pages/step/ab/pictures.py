"""What A | B shows of two runs at their steps: each one's buffer and step, and where the buffers differ."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from app.pages.step.grid_records import buffers_of, mask_overlays
from app.pages.step.step_mark import step_mark
from app.pages.step.steps_ahead import sentence_at
from app.session.moment import Step
from core.records.arrays import Flags
from widgets.grid.buffer import GridBuffer, number_text
from widgets.grid.compare_view import Side
from widgets.grid.geometry import GridGeometry
from widgets.grid.overlay import Mark, MaskOverlay
from widgets.inspector.listing import ListingText

OTHER = "read them at a pixel, or choose a buffer that both share."
SHOWN_MARKS = ("rejected", "tie", "nan", "failed")
"""Marks of rows done that lie over the pictures."""


def buffers_at(step: Step) -> dict[str, GridBuffer]:
    """Return the buffers of a run by name."""
    return {buffer.name: buffer for buffer in buffers_of(step)}


def first_comparable(buffers: Sequence[Mapping[str, GridBuffer]]) -> str:
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
    side: Side, step: Step, geometry: GridGeometry, buffers: Mapping[str, GridBuffer], wanted: GridBuffer
) -> Side:
    """Return a side with its picture at a step, in the buffer ``wanted``, and with what its last step did."""
    buffer = buffers.get(wanted.name)
    is_done = step.is_stage_done and step.steps.count > 0
    is_vain = buffer is not None and is_done and _is_empty(buffer)
    return replace(
        side,
        place=side.place + ("; it gives no pixel a value" if is_vain else ""),
        sentence=sentence_at(step),
        buffer=buffer,
        reason="" if buffer else f"{side.name} has no buffer “{wanted.label}” in this stage.",
        overlays=tuple(overlay for overlay in mask_overlays(step) if overlay.key in SHOWN_MARKS),
        geometry=geometry,
        step=step_mark(step),
    )


def with_listing(side: Side, step: Step) -> Side:
    """Return a side with the listing of its last step, and the line that has just run."""
    done = step.explanation
    if done is None or done.listing is None:
        return side
    listing = ListingText(done.listing.name, done.listing.source, done.listing.purpose)
    return replace(side, listing=listing, line=done.line)


def _is_empty(buffer: GridBuffer) -> bool:
    if buffer.kind == "bool":
        return not buffer.values.any()
    return buffer.known is not None and not buffer.known.any()


def nothing(said: str) -> Side:
    """Return the place of a difference that there is not, with what is said there."""
    return Side("Difference", "Difference", sentence=said, reason=said)


def compare(first: Side, second: Side) -> tuple[Side, Side, Side]:
    """Return two sides, in one range of values, with their difference, B minus A; of colours the largest channel."""
    a, b = first.buffer, second.buffer
    if a is None or b is None:
        return first, second, nothing("There is nothing to compare: one side is blank.")
    if a.values.shape != b.values.shape:
        return first, second, nothing("The two buffers have different numbers of channels.")
    if not _hold_the_same(a, b):
        return first, second, nothing(f"“{a.label}” holds other numbers in A and in B: {OTHER}")
    if a.kind in ("scalar", "signed"):
        scale = _common_range(a, b)
        a, b = replace(a, range=scale), replace(b, range=scale)
        first, second = replace(first, buffer=a), replace(second, buffer=b)
    ours, theirs = a.values.astype(float), b.values.astype(float)
    with np.errstate(invalid="ignore"):
        # Two infinities are equal, and not a number apart.
        amount = np.where(ours == theirs, 0.0, theirs - ours)
    changed = (ours != theirs) & ~(np.isnan(ours) & np.isnan(theirs))
    if amount.ndim == 3:
        changed = changed.any(axis=2)
        largest = np.abs(np.nan_to_num(amount)).argmax(axis=2)
        amount = np.take_along_axis(amount, largest[..., None], axis=2)[..., 0]
    known, others_known = _known(a), _known(b)
    is_choice = a.kind in ("ids", "bool")
    in_a, in_b = (_has(buffer) for buffer in (a, b)) if is_choice else (known, others_known)
    # A pixel that one run has found outside, and the other has not reached, is in neither.
    differs = (in_a != in_b) | (changed & in_a & in_b)
    said = f"{np.count_nonzero(differs):,} of {differs.size:,} pixels differ"
    if is_choice:
        if (in_a != in_b).any():
            only = np.count_nonzero(in_a & ~in_b), np.count_nonzero(in_b & ~in_a)
            said += f"; {only[0]:,} only in A, {only[1]:,} only in B"
        shown = GridBuffer("difference", differs.astype(float), "bool", origin=a.origin)
    else:
        both, one = known & others_known, known != others_known
        if (differs & both).any():
            said += f"; largest difference {number_text(float(np.nanmax(np.abs(amount[differs & both]))))}"
        if one.any():
            said += f"; {np.count_nonzero(one):,} reached by one of them only"
        shown = GridBuffer("difference", amount, "signed", origin=a.origin, known=both)
    difference = Side(
        "Difference",
        f"Difference, {a.label}",
        sentence=f"{said}.",
        buffer=shown,
        # The colours show what both have reached.
        overlays=() if is_choice else (MaskOverlay("difference", Mark.DIFFERENCE, one),),
        geometry=first.geometry,
    )
    return first, second, difference


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
