"""Why a triangle has a fragment at a pixel or none, in words: boxes, blocks, edges, spans, samples, pieces."""

from collections.abc import Callable, Mapping, Sequence
from math import isclose, isfinite, isnan
from typing import Any

from core.coverage.snapping import SUBPIXELS
from core.coverage.told_edges import tie_reason
from core.explain.listed_code import tested_name
from core.explain.number_text import exact_text
from core.records.words import TRIANGLES, Nouns, counted, joined

# Why a triangle has a fragment at a pixel or none, in words: boxes, blocks, edges, spans and outlines.


Values = Mapping[str, Any]
Sentence = str | Callable[[Values], str]

EDITED_COVERED = "covered: the edited inside test returns true"
EDITED_OUTSIDE = "the edited inside test returns false"


def _pixels(distance: float) -> str:
    """Return a length in pixels; a very small one in 1/256 of a pixel too."""
    length = abs(distance)
    if not isfinite(length):
        return "an unknown distance"
    text = f"{exact_text(length)} px"
    if 0 < length < 0.25:
        text += f" ({exact_text(length * SUBPIXELS)}/{SUBPIXELS})"
    return text


def _missed(values: Values) -> str:
    """Return by how much which edge was missed."""
    if values.get("is_edited"):
        return EDITED_OUTSIDE
    if not isfinite(values["distance"]):
        return f"the pixel centre is outside edge {values['edge']}"
    text = f"the pixel centre is {_pixels(values['distance'])} beyond edge {values['edge']}"
    if not values["is_exact"] and abs(values["ulps"]) < 1000:
        text += f", {exact_text(abs(values['ulps']))} units in the last place"
    return text


def _tie(values: Values) -> str:
    if values.get("is_edited"):
        return EDITED_OUTSIDE
    return f"the pixel centre is exactly on {_owned(values, owns=False)}"


def _owned(values: Values, *, owns: bool) -> str:
    """Return the edges on which a centre lies and which the triangle owns, or does not, each with the rule."""
    return " and ".join(
        f"edge {k}, which the {values['drawn'].one} {'owns' if owns else 'does not own'} because "
        + tie_reason(values["a"][k], values["b"][k], owns, values["fill_rule"])
        for k in range(3)
        if values["ties"][k] and bool(values["owns_tie"][k]) == owns
    )


def _not_here(values: Values) -> str:
    """Return the nearest edge and its distance, or that the pixel was inside all edges."""
    if values["doubled_area"] == 0:
        return "it has no area"
    if values["inside"].all():
        return (
            EDITED_COVERED.partition(": ")[2]
            if values.get("is_edited")
            else "the pixel centre is inside all three edges"
        )
    return _tie(values) if values["value"] == 0 else _missed(values)


def _block(values: Values) -> str:
    column, row = values["block"]
    return f"block ({column}, {row}) of {values['block_size']} × {values['block_size']} pixels"


def _outside_block(values: Values) -> str:
    return f"{_block(values)} is rejected by edge {values['rejected_by']}; {_not_here(values)}"


def _outside_box(values: Values) -> str:
    column, row, column_end, row_end = values["box"]
    if column_end <= column or row_end <= row:
        return f"its bounding box contains no pixel centre of the image; {_not_here(values)}"
    return (
        f"outside its bounding box, columns {column} to {column_end - 1}, rows {row} to {row_end - 1};"
        f" {_not_here(values)}"
    )


def _span(values: Values) -> str:
    return f"columns {values['start']} to {values['stop'] - 1}"


def _missed_edge(values: Values) -> str:
    span = f"; the span of this row is {_span(values)}" if "start" in values else ""
    return _missed(values) + span


def _accepted(values: Values) -> str:
    if "start" in values:
        outside = _on_own_edges(values) if values["inside"].all() else f", although {_not_here(values)}"
        return f"covered: in the span of this row, {_span(values)}{outside}"
    return f"covered: {_block(values)} lies wholly inside{_on_own_edges(values)}"


def _on_own_edges(values: Values) -> str:
    """Return what must be said of a covered centre that lies on an edge."""
    if values.get("is_edited"):
        return ""
    return f"; the pixel centre is exactly on {_owned(values, owns=True)}" if values["ties"].any() else ""


def _crossed(values: Values) -> str:
    """Return how often a polygon's edges are crossed on the way to a pixel."""
    edges = counted(values["crossed"], "edge")
    return f"{edges}, winding number {values['winding']}," if values["rule"] == "non-zero" else edges


def _edge_margin(values: Values) -> str:
    if values.get("is_edited"):
        return EDITED_COVERED
    return f"covered: inside all three edges, {_pixels(values['distance'])} from edge {values['edge']}"


def _on_edge(values: Values) -> str:
    if values.get("is_edited"):
        return EDITED_COVERED
    return f"covered: the pixel centre is exactly on {_owned(values, owns=True)}"


def has_area(values: Values) -> bool:
    """Return whether what is drawn has edges and two faces: a segment and a point have neither."""
    return bool(values["drawn"].edge == "edge")


def _for_edge(values: Values) -> str:
    return f" for edge {values['edge']}" if has_area(values) else ""


def _chosen_by(values: Values) -> str:
    """Return the number that chose a pixel of a line, where the listing tests one, as the end of a sentence."""
    name = "" if values["is_point"] else tested_name(values["line"])
    if not name or isnan(values["decision"]):
        return ""
    way = "diagonal" if values["has_stepped"] else "straight"
    return f"; {name} = {exact_text(values['decision'])} chose the {way} step to it"


COVERAGE: dict[tuple[str, str], Sentence] = {
    ("bin", "no-area"): "it has no area on the 1/256-pixel grid",
    ("bin", "in-box"): "in its bounding box",
    ("bin", "whole-image"): "no bounding box: not all of its {corner}s can be projected",
    ("bin", "inside-block"): lambda v: f"{_block(v)} lies wholly inside",
    ("bin", "outside-block"): _outside_block,
    ("bin", "outside-box"): _outside_box,
    ("raster", "covered"): _edge_margin,
    ("raster", "covered-on-edge"): _on_edge,
    ("raster", "accepted"): _accepted,
    ("raster", "missed-edge"): _missed_edge,
    ("raster", "tie-not-owned"): _tie,
    ("raster", "undefined"): "an edge function is not a number here",
    ("raster", "outside-span"): lambda v: f"outside the span of this row, {_span(v)}; {_not_here(v)}",
    ("raster", "row-not-drawn"): lambda v: f"the fill as printed draws no span in this row; {_not_here(v)}",
    ("raster", "in-polygon"): lambda v: (
        f"covered, with {_crossed(v)} to the left; edge {v['edge']} is {_pixels(v['distance'])} away"
    ),
    ("raster", "outside-polygon"): lambda v: (
        f"the pixel centre is outside, with {_crossed(v)} to the left; "
        f"edge {v['edge']} is {_pixels(v['distance'])} away"
    ),
    ("raster", "clipped-polygon"): "clipped away: nothing of it lies in the clip window",
    ("raster", "on-outline"): lambda v: (
        f"drawn{_for_edge(v)}: the pixel centre is {_pixels(v['distance'])} from the exact line{_chosen_by(v)}"
    ),
    ("raster", "off-outline"): lambda v: (
        f"not on its outline: the pixel centre is {_pixels(v['distance'])} from edge {v['edge']}, the nearest"
        if has_area(v)
        else f"the pixel centre is {_pixels(v['distance'])} from the {v['drawn'].one}"
    ),
    ("raster", "no-outline"): lambda v: (
        f"{'none of its edges is' if has_area(v) else 'it is not'} drawn near the window"
    ),
}
"""Stage and key to the sentence, without capital and full stop."""


# The words of a pixel's history where a pixel has parts: several samples, or pieces of exact area.


MOST_NAMED = 4
"""Samples, or triangles with the largest pieces, that are named one by one."""

_OF_SAMPLE = {
    "no pixel centre": "no sample of this place",
    "the pixel centre": "the sample",
    "The pixel centre": "The sample",
    "the pixel is in": "the sample is in",
    "the pixel is outside": "the sample is outside",
    "this pixel": "this sample",
}
"""Words about a pixel's centre, and the same about a sample."""


def of_sample(text: str) -> str:
    """Return a sentence about a pixel's centre as one about a sample."""
    for of_center, of_one in _OF_SAMPLE.items():
        text = text.replace(of_center, of_one)
    return text


def samples_name(samples: Sequence[int]) -> str:
    """Return what samples are called: ``Sample 2``, ``Samples 0 and 3``, ``Samples 0, 1, 2 and 6 more``."""
    if len(samples) == 1:
        return f"Sample {samples[0]}"
    named = [str(sample) for sample in samples]
    if len(samples) > MOST_NAMED + 1:
        named = [*named[: MOST_NAMED - 1], f"{len(samples) - MOST_NAMED + 1} more"]
    return f"Samples {joined(named)}"


def samples_verdict(groups: Sequence[tuple[int, Sequence[int]]], count: int, drawn: Nouns = TRIANGLES) -> str:
    """Return the first line of a pixel of ``count`` samples: which of them show what.

    Parameters
    ----------
    groups : sequence of (int, sequence of int)
        A triangle, -1 for none, and the samples that show it.
    """
    parts: list[str] = []
    for triangle, samples in groups:
        what = f"{drawn.one} {triangle}" if triangle >= 0 else "none"
        number = f"all {count}" if len(samples) == count else f"{len(samples)} of {count}"
        parts.append(f"{number} samples show {what}" if not parts else f"{len(samples)} show {what}")
    text = ", ".join(parts)
    return f"{text[0].upper()}{text[1:]}."


def share_name(area: float) -> str:
    """Return how much of a pixel in words: ``all of the pixel``, ``almost all of``, ``0.25 of the pixel``."""
    if is_same(area, 1.0):
        return "all of the pixel"
    share = exact_text(area)
    return f"{'almost all' if share == '1' else share} of the pixel"


def is_same(first: float, second: float) -> bool:
    """Return whether two areas differ by no more than rounding, in pixels."""
    return isclose(first, second, rel_tol=0.0, abs_tol=1e-9)


def pieces_verdict(
    shown: Sequence[tuple[int, float]], background: float, is_blended: bool, drawn: Nouns = TRIANGLES
) -> str:
    """Return the first line of a pixel: which triangles are seen in how much of it.

    Parameters
    ----------
    shown : sequence of (int, float)
        Triangles that are seen and their areas, in pixels.
    background : float
        The area that shows none.
    is_blended : bool
        Whether triangles are transparent: the last one lies on others.
    """
    if not shown:
        return f"No {drawn.one} is visible in any part of the pixel."
    verb = "lies on top in" if is_blended else "is visible in"
    largest = sorted(shown, key=lambda each: -each[1])
    parts = [f"{drawn.one.capitalize()} {largest[0][0]} {verb} {share_name(largest[0][1])}"]
    parts += [f"{drawn.one} {triangle} in {exact_text(area)}" for triangle, area in largest[1:MOST_NAMED]]
    rest = largest[MOST_NAMED:]
    if rest:
        parts.append(f"{len(rest)} more in {exact_text(sum(area for _, area in rest))}")
    if not is_same(background, 0.0):
        parts.append(f"no {drawn.one} in {exact_text(background)}")
    return f"{', '.join(parts)}."


def piece_reason(area: float, passed: float, seen: float) -> str:
    """Return how much of the pixel a triangle covers, and what became of that, all in pixels.

    Parameters
    ----------
    area : float
        What lies inside its edges.
    passed : float
        What passed the depth test, when it was drawn.
    seen : float
        What is seen of it when everything is drawn.
    """
    covers = f"covers {share_name(area)}"
    if is_same(passed, 0.0):
        return f"{covers}, none of it passes the depth test"
    through = "" if is_same(passed, area) else f", {exact_text(passed)} of it passes the depth test"
    if is_same(seen, passed):
        return f"{covers}{through}"
    later = "none of it is visible" if is_same(seen, 0.0) else f"{exact_text(seen)} is visible"
    return f"{covers}{through}; {later} in the end"
