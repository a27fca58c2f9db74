"""What is said while the fill looks at pixels: one sentence for every key."""

import math
from collections.abc import Callable, Mapping

from core.explain.number_text import counted, joined, spoken, vector_text
from core.explain.sentences import spans as sentences_spans
from core.explain.sentences.edges import tie_reason
from core.explain.sentences.numbers import number_format
from core.explain.step_values import StepValues

SNAP_DISTANCE = 1 / 256
"""Pixels by which snapping can at most turn a decision."""


def pixel_name(step: StepValues) -> str:
    """Say which pixel."""
    return step.pixel_name


def _distance(step: StepValues, edge: int) -> str:
    """Return a distance from an edge with its unit, or nothing where the edge is no line."""
    distance = step.vector("distance")[edge]
    return f"{spoken(distance)} px" if math.isfinite(distance) else ""


def edge_value(step: StepValues) -> str:
    """One edge function at one pixel."""
    k = int(step.operation.removeprefix("edge-"))
    value = step.number(f"value_{k}")
    centre = vector_text([step.number("x"), step.number("y")])
    text = f"{pixel_name(step)}: E{k} is {spoken(value)} at its centre {centre}"
    away = _distance(step, k)
    if math.isnan(value):
        return f"{text}, which is no number, so it is outside edge {k}."
    if value > 0:
        return f"{text}, so it is inside edge {k}{f', {away} away' if away else ''}."
    if value < 0:
        return f"{text}, so it is outside edge {k}{f' ({away})' if away else ''}."
    owns = step.flags("owns_tie")[k]
    reason = tie_reason(step.vector("a")[k], step.vector("b")[k], owns, step.fill_rule(k))
    return f"{text}: it lies exactly on edge {k}, which this triangle {_owns(owns)} because {reason}."


def _owns(owns: bool) -> str:
    return "owns" if owns else "does not own"


def decision(step: StepValues) -> str:
    """Covered or not, and why."""
    values, owns = step.vector("values"), step.flags("owns_tie")
    a, b = step.vector("a"), step.vector("b")
    ties = [k for k in range(3) if values[k] == 0]
    lies_on = {
        k: f"exactly on edge {k}, which this triangle {_owns(owns[k])} because "
        f"{tie_reason(a[k], b[k], owns[k], step.fill_rule(k))}"
        for k in ties
    }
    if step.flag("covered"):
        if ties:
            on_edges = joined([lies_on[k] for k in ties])
            return f"{pixel_name(step)} is covered: its centre lies {on_edges}{_apart(step)}."
        distances = step.vector("distance")
        nearest = min(range(3), key=lambda k: distances[k] if math.isfinite(distances[k]) else math.inf)
        away = f"{_distance(step, nearest)} away, " if _distance(step, nearest) else ""
        value = spoken(values[nearest])
        return (
            f"{pixel_name(step)} is covered: it is inside all three edges, the nearest is edge {nearest} "
            f"({away}E{nearest} = {value}){_apart(step)}."
        )
    reasons = []
    for k in range(3):
        value = spoken(values[k])
        if values[k] < 0:
            away = (
                f"is {_distance(step, k)} away (E{k} = {value})"
                if _distance(step, k)
                else f"has E{k} = {value}"
            )
            reasons.append(f"edge {k} {away}")
        elif math.isnan(values[k]):
            reasons.append(f"E{k} is {value}, no number")
    unowned = [lies_on[k] for k in ties if not owns[k]]
    if not reasons:
        return f"{pixel_name(step)} is not covered: its centre lies {joined(unowned)}{_apart(step)}."
    reasons += [f"it lies {text}" for text in unowned]
    return f"{pixel_name(step)} is outside: {joined(reasons)}{_apart(step)}."


def disagreeing_edges(step: StepValues) -> list[int]:
    """Return the edges whose snapped decision and unsnapped weight differ in sign, by snapping alone."""
    values, weights, distance = (step.vector(name) for name in ("values", "weights", "distance"))
    return [
        k
        for k in range(3)
        if abs(distance[k]) <= SNAP_DISTANCE and (values[k] < 0 < weights[k] or weights[k] < 0 <= values[k])
    ]


def _apart(step: StepValues) -> str:
    texts = [
        f"E{k} ({number_format(step)}) decides, though weight {k} (unsnapped) is {spoken(step.vector('weights')[k])}"
        for k in disagreeing_edges(step)
    ]
    return f"; {joined(texts)}" if texts else ""


def accepted(step: StepValues) -> str:
    """A pixel that is covered without a test."""
    is_block = all(math.isnan(step.number(f"crossing_{k}")) for k in range(3))
    what = "its block is inside as a whole" if is_block else f"it is in the span of row {step.whole('row')}"
    values, owns = step.vector("values"), step.flags("owns_tie")
    outside = [k for k in range(3) if not (values[k] > 0 or (values[k] == 0 and owns[k]))]
    text = f"{pixel_name(step)} is covered without a test of its own: {what}"
    if outside:
        listed = joined([f"E{k} = {spoken(values[k])}" for k in outside])
        text += f"; its own test would leave it out ({listed})"
    return text + "."


def span_edge(step: StepValues) -> str:
    """Where a row crosses an edge."""
    k = int(step.operation.removeprefix("edge-"))
    a, crossing, row = step.vector("a")[k], step.number(f"crossing_{k}"), step.whole("row")
    if a == 0:
        value = step.vector("b")[k] * step.number("y") + step.vector("c")[k]
        is_inside = value > 0 or (value == 0 and step.flags("owns_tie")[k])
        return (
            f"Row {row} runs along edge {k}, which has all of it {'inside' if is_inside else 'outside'} "
            f"(E{k} = {spoken(value)})."
        )
    verb = "enters" if a > 0 else "leaves"
    limit = "begins" if a > 0 else "ends"
    where = f"at x = {spoken(crossing)}"
    return f"Row {row} {verb} through edge {k} {where}: the span {limit} there, or farther inside."


def span(step: StepValues) -> str:
    """The columns of a span."""
    start, stop, row = step.whole("start"), step.whole("stop"), step.whole("row")
    if stop <= start:
        return f"Row {row} of triangle {step.triangle} has no pixel centre inside all three edges."
    columns = f"column {start}" if stop == start + 1 else f"columns {start} to {stop - 1}"
    return f"Row {row} of triangle {step.triangle} is covered in {columns}: {counted(stop - start, 'pixel')}."


def line_ends(step: StepValues) -> str:
    """The two sides of the printed scanline fill."""
    ends = joined([spoken(step.number(f"crossing_{k}")) for k in range(2)])
    return f"Row {step.whole('row')}: adding up the inverse slopes puts the two sides at x = {ends}."


def line_rounded(step: StepValues) -> str:
    """The columns that the printed scanline fill draws."""
    start, stop, row = step.whole("start"), step.whole("stop"), step.whole("row")
    if stop <= start:
        return f"Row {row}: rounded, both sides lie outside the raster, so nothing is drawn."
    columns = f"column {start}" if stop == start + 1 else f"columns {start} to {stop - 1}"
    return (
        f"Row {row}: the sides are rounded and both ends drawn, {columns}: {counted(stop - start, 'pixel')}."
    )


SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    **{f"raster.test.edge-{k}": edge_value for k in range(3)},
    "raster.test.decide": decision,
    "raster.accept.accept": accepted,
    **{f"raster.span.edge-{k}": span_edge for k in range(3)},
    "raster.span.span": span,
    "raster.line.ends": line_ends,
    "raster.line.round": line_rounded,
    **{f"raster.{kind}.decide": decision for kind in ("step", "climb")},
    **sentences_spans.SENTENCES,
}
