"""What is said from snapping to binning: one sentence for every key."""

import math
from collections.abc import Callable, Mapping

from core.explain.number_text import counted, joined, position_text, spoken, vector_text
from core.explain.step_values import StepValues

SNAP_LIMIT = 2**16
"""Corners farther from the window's origin than this, in pixels, are not snapped."""
WHOLE_NUMBERS = ("fixed-24.8", "int64")
"""Number formats that have no place for every corner."""
ROUNDING = 1e-9
"""Pixels below which a corner that moves is said to stay."""


def projected(step: StepValues) -> str:
    """A corner in the window, before snapping."""
    x, y, w = step.vector("homogeneous")
    place = vector_text(step.vector("window"))
    return (
        f"Corner {step.whole('corner')} of triangle {step.triangle} stands at {place} in the window: "
        f"{spoken(x)} and {spoken(y)}, each divided by w = {spoken(w)}."
    )


def snapped(step: StepValues) -> str:
    """A corner on the lattice."""
    window, lattice = step.vector("window"), step.vector("snapped")
    name = f"Corner {step.whole('corner')} of triangle {step.triangle}"
    place = position_text(lattice)
    moved = math.hypot(*(a - b for a, b in zip(lattice, window, strict=True)))
    if moved < ROUNDING:
        return f"{name} stays at {place}: that is on the lattice of 1/256 pixel."
    return f"{name} is snapped to the nearest 1/256 pixel, {place}, which moves it by {spoken(moved)} px."


def homogeneous(step: StepValues) -> str:
    """A corner that is not snapped, and why."""
    w = step.vector("homogeneous")[2]
    form = step.text("number_format")
    if form in WHOLE_NUMBERS:
        return (
            f"Corner {step.whole('corner')} of triangle {step.triangle} has no place in {form}, as it is behind the "
            f"eye or too far away, so the triangle is not drawn: (x, y, w) = {vector_text(step.vector('homogeneous'))}."
        )
    if not w > 0:
        reason = f"its w is {spoken(w)}, not above 0"
    elif form == "snapped" and any(abs(value) > SNAP_LIMIT for value in step.vector("window")):
        reason = f"it stands more than {SNAP_LIMIT:,} pixels away"
    else:
        reason = "this coverage method does not snap"
    return (
        f"Corner {step.whole('corner')} of triangle {step.triangle} keeps its homogeneous position "
        f"(x, y, w) = {vector_text(step.vector('homogeneous'))}: {reason}."
    )


def orientation(step: StepValues) -> str:
    """The sign of the area."""
    value = step.number("doubled_area")
    is_area = step.flag("is_projected") and all(map(math.isfinite, step.vector("snapped")))
    name = "Twice the signed area" if is_area else "The determinant of the (x, y, w) matrix"
    text = f"{name} of triangle {step.triangle} is {spoken(value)}"
    if value > 0:
        return f"{text}, above 0: its edge functions are positive inside as they are."
    if value < 0:
        return f"{text}, below 0: its edge functions are turned over, so that inside is positive."
    return f"{text}: nothing is drawn."


def coefficient(step: StepValues) -> str:
    """One coefficient of an edge function."""
    k = step.whole("edge")
    value = step.number(step.operation)
    ends = f"from corner {(k + 1) % 3} to corner {(k + 2) % 3}"
    name = f"Edge {k} ({ends}): {step.operation} is {spoken(value)}"
    if step.operation == "c":
        return f"{name}, the value of E{k} at the window's origin."
    way = "pixel to the right" if step.operation == "a" else "pixel upwards"
    if value == 0:
        return f"{name}, so E{k} stays the same with every {way}."
    change = f"{'grows' if value > 0 else 'falls'} by {spoken(abs(value))}"
    return f"{name}, so E{k} {change} with every {way}."


def tie_reason(a: float, b: float, owns: bool, rule: str) -> str:
    """Say why a triangle owns the pixel centres on an edge, or does not."""
    if rule == "inclusive":
        return "the inclusive rule counts every edge as inside"
    if rule == "exclusive":
        return "the exclusive rule counts no edge as inside"
    if a != 0:
        return "it is a left edge" if owns else "it is a right edge"
    return "it is a level bottom edge" if owns else "it is a level top edge"


def tie(step: StepValues) -> str:
    """Whether the triangle owns the pixel centres on an edge."""
    k, a, b, owns = step.whole("edge"), step.number("a"), step.number("b"), step.flag("owns_tie")
    reason = tie_reason(a, b, owns, step.fill_rule(0))
    verb = "belongs" if owns else "does not belong"
    return f"A pixel centre exactly on edge {k} {verb} to triangle {step.triangle}: {reason}."


def box_low(step: StepValues) -> str:
    """The lower left corner of the bounding box."""
    column, row = step.whole("column"), step.whole("row")
    x, y = zip(*step.rows("corners"), strict=True)
    center = step.number("center")
    is_limited = column != math.ceil(min(x) - center) or row != math.ceil(min(y) - center)
    centre = f"the first pixel centre{' of the raster' if is_limited else ''}"
    return (
        f"The box of triangle {step.triangle} begins at column {column} and row {row}: {centre} "
        f"at or beyond its least x, {spoken(min(x))}, and its least y, {spoken(min(y))}."
    )


def box_high(step: StepValues) -> str:
    """The upper right corner of the bounding box."""
    columns = step.whole("column_end") - step.whole("column")
    rows = step.whole("row_end") - step.whole("row")
    if columns <= 0 or rows <= 0:
        return f"The box is empty: triangle {step.triangle} can cover no pixel centre of the raster."
    return (
        f"The box ends with column {step.whole('column_end') - 1} and row {step.whole('row_end') - 1}, so "
        f"{columns} × {rows} = {counted(columns * rows, 'pixel')} may be covered."
    )


def bin_behind(step: StepValues) -> str:
    """No corner in front of the eye."""
    return (
        f"Triangle {step.triangle} is behind the eye, as no corner has w above 0, and no pixel is looked at."
    )


def whole_image(step: StepValues) -> str:
    """Some corner cannot be projected."""
    columns = step.whole("column_end") - step.whole("column")
    rows = step.whole("row_end") - step.whole("row")
    beginning = f"Not every corner of triangle {step.triangle} has a snapped place in the window"
    if columns <= 0 or rows <= 0:
        return f"{beginning}, and it has no area, so no pixel is looked at."
    pixels = f"{columns} × {rows} = {counted(columns * rows, 'pixel')}"
    return f"{beginning}, so no box bounds it and all {pixels} may be covered."


def block_name(step: StepValues) -> str:
    """Say which block."""
    size = step.whole("size")
    return f"block at column {step.whole('column')}, row {step.whole('row')} ({size} × {size} pixels)"


def _bounds(step: StepValues, name: str) -> str:
    return joined([f"E{k} = {spoken(value)}" for k, value in enumerate(step.vector(name))])


def block_high(step: StepValues) -> str:
    """Greatest values of the edge functions in a block."""
    text = f"In the {block_name(step)} the greatest values are {_bounds(step, 'high')}"
    edge = step.whole("rejected_by")
    return f"{text}{f', so edge {edge} has all of it outside' if edge >= 0 else ''}."


def block_low(step: StepValues) -> str:
    """Least values of the edge functions in a block."""
    return f"In the {block_name(step)} the least values are {_bounds(step, 'low')}."


def block_verdict(step: StepValues) -> str:
    """What becomes of a block."""
    name = block_name(step)
    verdict, edge = step.text("verdict"), step.whole("rejected_by")
    if verdict == "outside":
        high = spoken(step.vector("high")[edge])
        return f"The {name} is rejected by edge {edge}: even its greatest E{edge} there, {high}, is outside."
    if verdict == "inside":
        return f"The {name} is accepted as a whole: even the least value of every edge function is inside."
    open_edges = joined([str(k) for k, low in enumerate(step.vector("low")) if not low > 0])
    crossed = (
        f"edge{'s' if len(open_edges) > 1 else ''} {open_edges} may cross it" if open_edges else "unclear"
    )
    if verdict == "split":
        return f"The {name} is neither in nor out ({crossed}), so it is split into smaller blocks."
    return f"The {name} is neither in nor out ({crossed}), so its pixels are tested one by one."


SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    "edges.snapped.window": projected,
    "edges.snapped.snap": snapped,
    "edges.homogeneous.keep": homogeneous,
    "edges.orientation.area": orientation,
    "edges.edge.a": coefficient,
    "edges.edge.b": coefficient,
    "edges.edge.c": coefficient,
    "edges.edge.tie": tie,
    **{f"edges.anchored-edge.{name}": coefficient for name in "abc"},
    "edges.anchored-edge.tie": tie,
    "edges.inverse-edge.tie": tie,
    "bin.box.low": box_low,
    "bin.box.high": box_high,
    "bin.behind.drop": bin_behind,
    "bin.whole-image.keep": whole_image,
    "bin.block.high": block_high,
    "bin.block.low": block_low,
    "bin.block.verdict": block_verdict,
}
