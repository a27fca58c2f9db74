"""What A | B shows and says of two runs: each one's buffer and step, where the buffers differ, and the runs first."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from app.pages.step.grid_overlays import step_mark
from app.pages.step.grid_presenter import OUTLINING
from app.pages.step.grid_records import LANE_MARKS, buffers_of, mask_overlays
from app.pages.step.inspector_presenter import sentence_at
from app.session.moment import Cursor, Step
from core import STAGES, Trace
from core.explain.steps import variables
from core.records.arrays import Flags
from core.records.words import joined
from widgets.grid.compare_view import Side
from widgets.grid.geometry import GridGeometry
from widgets.grid.layers import CellMark, GridBuffer, MaskOverlay, Overlay, number_text
from widgets.grid.marks import StepMark
from widgets.inspector.listing import ListingText

if TYPE_CHECKING:
    from core.study.divergence import Divergence  # Looked for long after the window is open.


@dataclass(frozen=True, eq=False)
class Seen:
    """What a grid shows of a run."""

    buffers: Mapping[str, GridBuffer]
    overlays: tuple[Overlay, ...]
    geometry: GridGeometry
    mark: StepMark


Look = Callable[[Trace, Cursor], Seen]
"""Returns what a grid shows of a run where it is."""
Outlines = Callable[[Trace, Cursor], GridGeometry]
"""Returns the triangles of a run."""
NAMED = 3
"""Things in which A and B differ that a sentence names at most."""
OTHER = "read them at a pixel, or choose a buffer that both share."
ALIKE = "A and B do the same in every stage."
ROUNDED = (
    "A and B draw the same but for rounding: shaders compute with 32 bits, the built-in shading with 64."
)
REORDERED = "A and B give the same results; only the order of their steps differs."
ORDERED_STAGES = ("bin", "raster", "depth")
"""Stages in which methods may do the same in another order."""
SHOWS_MORE = {"coverage": "overdraw"}
"""By buffer, another one that shows the same difference, and pixels that are drawn again."""
SEEN_FIRST = "screen"
"""What is compared before all else where pictures are presented: it is what one sees of both."""
SHOWN_MARKS = ("rejected", "tie", "nan", "failed", *LANE_MARKS)
"""Marks of rows done that lie over the pictures."""


def pictured(
    sides: Sequence[Side], steps: Sequence[Step], look: Look, wanted: str, has_listings: bool
) -> tuple[list[GridBuffer], str, tuple[Side, Side, Side]]:
    """Return the buffers that there are, which is shown, and sides with their pictures and their difference.

    A side without a step keeps its reason. ``wanted`` is the name of the buffer that is shown if there is one; with
    ``has_listings`` the listing of each last step is shown, and the line that has just run.
    """
    seen = [look(step.trace, step.cursor) for step in steps]
    known = {name: buffer for each in reversed(seen) for name, buffer in each.buffers.items()}
    shown = wanted if wanted in known else _first_comparable([each.buffers for each in seen])
    found = [
        replace(
            _side_of(side, step, each, shown, has_listings),
            reason=f"{side.name} has no buffer “{known[shown].label}” in this stage.",
        )
        for side, step, each in zip(sides, steps, seen, strict=False)
    ]
    pictures = compare(*found) if len(found) == 2 else (found[0], sides[1], nothing(sides[1].reason))
    return list(known.values()), shown, pictures


def _first_comparable(buffers: Sequence[Mapping[str, GridBuffer]]) -> str:
    """Return the name of the first buffer that holds the same in all runs, or else of the first one."""
    first, *others = buffers
    for name, buffer in sorted(first.items(), key=_is_seen_later):
        if all(name in other and _hold_the_same(buffer, other[name]) for other in others):
            return name
    return next(iter(first))


def _is_seen_later(named: tuple[str, object]) -> bool:
    return named[0] != SEEN_FIRST


def differing_buffer(first: Step, second: Step) -> str:
    """Return the name of the first buffer that differs once the stage is done, or one that shows more; empty: none."""
    ends = (replace(each, cursor=replace(each.cursor, position=each.steps.count)) for each in (first, second))
    mine, theirs = ({buffer.name: buffer for buffer in buffers_of(end)} for end in ends)
    counts = {
        name: _unlike_count(buffer, theirs[name])
        for name, buffer in mine.items()
        if name in theirs and _hold_the_same(buffer, theirs[name])
    }
    found = next((name for name, count in sorted(counts.items(), key=_is_seen_later) if count), "")
    more = SHOWS_MORE.get(found, "")
    return more if counts.get(more, 0) > counts.get(found, 0) else found


def _unlike_count(a: GridBuffer, b: GridBuffer) -> int:
    # What one of both has not reached is no number there.
    mine, theirs = (each.values.astype(float) for each in (a, b))
    mine[~_known(a)] = theirs[~_known(b)] = np.nan
    if mine.shape != theirs.shape:
        return 0
    differs = (mine != theirs) & ~(np.isnan(mine) & np.isnan(theirs))
    return int(np.count_nonzero(differs.reshape(*differs.shape[:2], -1).any(axis=2)))


def _hold_the_same(a: GridBuffer, b: GridBuffer) -> bool:
    """Return whether it is not other numbers for the same thing, as 16 bits and 1/w for a depth."""
    return a.kind != "scalar" or (a.unit, a.description) == (b.unit, b.description)


def seen_of(outlines: Outlines, trace: Trace, cursor: Cursor) -> Seen:
    """Return what a grid shows of a run where it is."""
    step = Step(trace, cursor)
    return Seen(
        {buffer.name: buffer for buffer in buffers_of(step)},
        tuple(overlay for overlay in mask_overlays(step) if overlay.key in SHOWN_MARKS),
        outlines(trace, cursor if cursor.stage in OUTLINING else Cursor(STAGES[-1])),
        step_mark(step),
    )


def _side_of(side: Side, step: Step, seen: Seen, shown: str, has_listing: bool) -> Side:
    buffer = seen.buffers.get(shown)
    is_vain = buffer is not None and step.is_stage_done and step.steps.count > 0 and _is_empty(buffer)
    done = step.explanation if has_listing else None
    listing = None if done is None else done.listing
    return replace(
        side,
        place=side.place + ("; it gives no pixel a value" if is_vain else ""),
        sentence=sentence_at(step),
        buffer=buffer,
        overlays=seen.overlays,
        geometry=seen.geometry,
        pixel_center=step.trace.source.settings.pixel_center,
        step=seen.mark,
        listing=None if listing is None else ListingText(listing.name, listing.source, listing.purpose),
        line=0 if done is None else done.line,
    )


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
        overlays=() if is_choice else (MaskOverlay("difference", CellMark.DIFFERENCE, one),),
        # No outlines: where both differ in few pixels, these lie along edges.
        pixel_center=first.pixel_center,
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


DIFFERING = {
    "applies": "which test drops it",
    "verdict": "the verdict",
    "drops": "the verdict",
    "weights": "the weights",
    "color": "the colour",
    "albedo": "the albedo",
    "texture_color": "the texture's colour",
    "diffuse_light": "the diffuse light",
    "specular_light": "the specular light",
    "decision": "the number that decides",
    "kept_start": "the end that is left",
    "kept_end": "the end that is left",
    "covered": "coverage",
    "values": "the interpolated values",
    "passes": "the result of the depth test",
    "stored": "the stored depth",
    "after": "the colour after blending",
    "bytes": "the displayed bytes",
}
"""Words for variables in which two runs can differ first."""
AFTER = {"transform": "the vertex's place in the window", "depth": "the depth that is kept"}
"""Words for what comes out of a stage, where it is no colour."""


def _words_of(found: "Divergence", first: Trace) -> list[str]:
    """Return what differs, in words or by the name that it has among the variables of A."""
    run, row = first.stage(found.stage), found.rows[0]
    assert row is not None
    done = run.explain(run.steps.position_after(row))
    shown = () if done is None else variables(done)
    known = DIFFERING | ({"after": AFTER[found.stage]} if found.stage in AFTER else {})
    words = []
    for name in found.names:
        ours, theirs = (np.atleast_1d(values[name]) for values in found.values)
        own = [
            each.name
            for each in shown
            if each.column == name
            and (each.element is None or not np.array_equal(ours[each.element], theirs[each.element]))
        ]
        words += [known[name]] if name in known else own
    return list(dict.fromkeys(words))[:NAMED] or ["a number that the variables do not show"]


def divergence_text(found: "Divergence | None", first: Trace, second: Trace) -> str:
    """Return in words where two runs differ first."""
    from core.study.divergence import has_one_shader, is_same_schedule

    if found is None and has_one_shader(first, second):
        return ROUNDED
    if found is None:
        is_same_order = all(
            is_same_schedule(first.stage(stage), second.stage(stage)) for stage in ORDERED_STAGES
        )
        return _alike_text(first, second) if is_same_order else REORDERED
    if found.variable:
        return _shader_text(found, first, second)
    where = f"pixel {found.pixel}" if found.pixel is not None else f"triangle {found.triangle}"
    nodes, row = first.stage(found.stage).columns.get("node"), found.rows[0]
    if found.triangle < 0 and nodes is not None and row is not None:
        where = f"node {nodes[row]} of the tree"
    if None in found.rows:
        said = f"{'AB'[found.rows.index(None)]} has no step there"
    else:
        said = f"A and B differ in {joined(_words_of(found, first))}"
    return f"First divergence, at {where}: {said}. Ctrl+[ goes back."


def _alike_text(first: Trace, second: Trace) -> str:
    """Return that two runs do the same, or the first buffer that still differs once its stage is done."""
    for stage in STAGES:
        mine, theirs = (Step(run, Cursor(stage, run.stage(stage).steps.count)) for run in (first, second))
        if name := differing_buffer(mine, theirs):
            label = next(buffer.label for buffer in buffers_of(mine) if buffer.name == name)
            return f"No step decides otherwise in B, but “{label}” differs in the stage {stage}."
    return ALIKE


def _shader_text(found: "Divergence", first: Trace, second: Trace) -> str:
    """Return in words which variable of two shaders differs first, and where a colour does."""
    from core.lanes.terms import shown
    from core.study.divergence import stage_divergence

    name = found.variable
    texts = [shown(each[name]).replace("[", "(").replace("]", ")") for each in found.values]
    if texts[0] == texts[1]:
        texts = [
            f"({', '.join(f'{float(part):.9g}' for part in np.ravel(each[name]))})".replace("-", "−")
            for each in found.values
        ]
    values = " and ".join(
        f"{text} in {side} (line {line})" for text, side, line in zip(texts, "AB", found.lines, strict=True)
    )
    shade = (
        found
        if found.stage == "shade"
        else stage_divergence(first.stage("shade"), second.stage("shade"), True)
    )
    if shade is None:
        color = "No colour differs."
    else:
        color = f"The colour differs first at pixel {shade.pixel}."
    row = found.rows[0]
    assert row is not None
    vertex = first.stage(found.stage).columns.get("vertex")
    where = "There" if vertex is None else f"At vertex {vertex[row]} of triangle {found.triangle}"
    said = f"{where}, {name} is the first variable that differs: {values}."
    parts = (color, said) if found.stage == "shade" else (said, color)
    return f"{' '.join(parts)} Ctrl+[ goes back."
