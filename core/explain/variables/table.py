"""The variables of a step as rows of the table: in the order of the algorithm, internals left out."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from core.explain.number_bits import in_its_numbers
from core.explain.records import Value, Variable
from core.explain.step_values import ATTRIBUTES, key_fields
from core.explain.variable_text import GIVEN, VariableText
from core.explain.variables.depth import DEPTH_VARIABLES
from core.explain.variables.fragments import CORRECTED_VARIABLES, MIPMAP_VARIABLES
from core.explain.variables.line_clipping import CLIPPING_KINDS, CLIPPING_VARIABLES
from core.explain.variables.resolve import RESOLVE_VARIABLES
from core.trace import Explanation


def _given(label: str, meaning: str, spread: str = "") -> VariableText:
    return VariableText(label, meaning, GIVEN, spread)


_PIXEL = {
    "column": _given("column", "Column of the pixel, from the left; of n × n samples that of the sample."),
    "row": _given("row", "Row of the pixel, from the bottom; of n × n samples that of the sample."),
}
_SAMPLE = {
    "sample": _given("sample", "Which of the pixel's samples it is, counted from 0 at the lower left."),
    "sample_position": _given(
        "place in pixel", "Where the sample lies in the pixel, from its lower left corner."
    ),
}
"""Where a pixel has several samples."""
_CENTRE = {
    "x": _given("x", "x of the pixel's centre, in pixels."),
    "y": _given("y", "y of the pixel's centre, in pixels."),
}
_COEFFICIENTS = {
    name: _given(f"{name}#", meaning, "edges")
    for name, meaning in (
        ("a", "Change of the edge function with a pixel to the right."),
        ("b", "Change of the edge function with a pixel upwards."),
        ("c", "Value of the edge function at the window's origin."),
    )
}

LINE_VARIABLES: Mapping[str, VariableText] = {
    "first_end": VariableText("first end", "Where the line starts, as the method takes it."),
    "second_end": VariableText("second end", "Where it goes, as the method takes it."),
    "is_steep": VariableText("steep", "Whether y is the major axis: one pixel in every row."),
    "run": VariableText("run", "Length along the major axis."),
    "rise": VariableText("rise", "Length along the minor axis."),
    "slope": VariableText("slope", "Change of the minor coordinate with every step."),
    "intercept": VariableText("intercept", "Minor coordinate where the major one is 0."),
    "previous": VariableText("before", "Decision value of the pixel before."),
    "decision": VariableText("decision", "The number whose sign or rounding chooses the pixel."),
    "has_stepped": VariableText("stepped", "Whether the minor coordinate changed."),
    "is_tie": VariableText("tie", "Whether the line passes exactly between two pixels."),
    "exit_start": VariableText("leaves at start", "Whether the line leaves the diamond of its first pixel."),
    "exit_end": VariableText("leaves at end", "Whether the line leaves the diamond of its last pixel."),
    "length": VariableText("length", "Pixels of the span, or of the line."),
    "along": VariableText("along", "How far along the line the pixel's centre lies, in pixels."),
    "cosine": VariableText(
        "cosine", "By what a distance along the minor axis shrinks to that from the line."
    ),
    "share": VariableText("share", "Part of the pixel's column or row that the line spans."),
    "fraction": VariableText("fraction", "How far the line lies from the lower pixel to the upper one."),
    "line_distance": VariableText("distance", "Of the pixel's centre from the line, in pixels."),
    "entry": VariableText("entry", "Place in the filter's table: the distance in sixteenths of a pixel."),
    "filtered": VariableText("table value", "What the filter sees of the line at this distance."),
    "intensity": VariableText("intensity", "Share of the line's colour that the pixel gets."),
    "major": VariableText("major", "Coordinate along the major axis."),
    "minor": VariableText("minor", "Coordinate along the minor axis."),
    "index": VariableText("index", "Pixels of the line before this one."),
    "t": VariableText("t", "How far the pixel lies along the line: 0 at the first end, 1 at the second."),
}
"""Variables of lines (wireframes)."""


SPAN_VARIABLES: Mapping[str, VariableText] = {
    "corner_y": _given("y#", "y of the corner as coverage sees it, in pixels.", "edges"),
    "first_row": VariableText("first row", "Lowest row of pixel centres in the triangle and the raster."),
    "row_count": VariableText("rows", "Rows of pixel centres in the triangle and the raster."),
    "lane": VariableText("lane", "Place of the triangle among all, the tallest first."),
    "lane_count": VariableText("lanes", "Triangles that have rows.", "lane"),
    "level": _given("level", "Rows of the triangle below this one: all lanes go up level by level."),
    **{
        f"{name}_{k}": VariableText(f"{letter}{k}", meaning, edge=k)
        for k in range(3)
        for name, letter, meaning in (
            ("numerator", "N", "Numerator of the crossing, exact: the edge function at column 0."),
            ("quotient", "q", "Column at which the row crosses the edge: N over dy."),
        )
    },
    "left": VariableText("left bound", "The larger crossing of the edges on the left, in columns."),
    "left_guard": VariableText(
        "left guard", "Keeps rounding from deciding, and ties to their owner.", "left"
    ),
    "start": VariableText("start", "First column of the span."),
    "right": VariableText("right bound", "The smaller crossing of the edges on the right, in columns."),
    "right_guard": VariableText(
        "right guard", "Keeps rounding from deciding, and ties to their owner.", "right"
    ),
    "stop": VariableText("stop", "Column after the last of the span."),
    "place": VariableText("place", "Place of the span among all, the longest first; −1: none."),
    "span_count": VariableText("spans", "Spans of all triangles together.", "length"),
    "pass_number": VariableText(
        "pass", "Place of the pixel in its span: pass k draws the k-th of every span."
    ),
    "pass_size": VariableText("pixels in pass", "Spans that are long enough to have a pixel in this pass."),
    "drawn_before": VariableText("before this pass", "Pixels that earlier passes have drawn.", "rank"),
    "rank": VariableText("rank", "Place of the pixel in the order of execution, over all triangles."),
    "dx": _given(
        "dx#", "Way of the edge to the right: what the numerator grows by from row to row.", "edges"
    ),
    "dy": _given("dy#", "Way of the edge upwards: below 0 on the left side of the triangle.", "edges"),
}
"""Variables of the fill ``spans``; those of its spans are those of other fills too."""


TEXTS: Mapping[str, Mapping[str, VariableText]] = {
    "transform": {
        "vertex": _given("vertex", "Number of the vertex in the scene."),
        "corner": _given("corner", "Which corner of the triangle it is."),
        "before": _given("position before", "x, y, z, w in the space it comes from."),
        **{
            f"after_{axis}": VariableText(f"{axis} after", f"{axis} in the space it goes to.")
            for axis in "xyzw"
        },
        "width": _given("width", "Pixels of the picture from left to right."),
        "height": _given("height", "Pixels of the picture from bottom to top."),
    },
    "cull": {
        "w": VariableText("w#", "w of the corner: above 0 is in front of the eye.", spread="edges"),
        "plane": VariableText("plane", "Plane of the view volume."),
        "distances": VariableText(
            "distance #", "Distance of the corner, below 0 is outside.", spread="edges"
        ),
        "facing": VariableText("facing", "Twice the signed area, or the determinant: above 0 is the front."),
        "applies": VariableText("applies", "Whether the test drops the triangle."),
        "verdict": VariableText("verdict", "What becomes of the triangle."),
    },
    "clip": {
        "plane": VariableText("plane", "Plane that is clipped against."),
        "edge": _given("edge", "Number of the edge in the polygon as it comes to the plane."),
        "number": _given("corner", "Which corner of the triangle is divided."),
        "clip": _given("x, y, z, w", "Clip position of the corner."),
        "ndc": VariableText("x/w, y/w, z/w", "The corner divided by its w."),
        "start": VariableText("start", "Position of the edge's start."),
        "end": VariableText("end", "Position of the edge's end."),
        "start_distance": VariableText("start distance", "0 or more is inside the plane."),
        "end_distance": VariableText("end distance", "0 or more is inside the plane."),
        "t": VariableText("t", "Where the new corner lies, from the end that it is computed from (0)."),
        "corner": VariableText("new corner", "Position of the corner that the plane makes."),
    },
    "edges": {
        "corner": _given("number", "Number of the corner, and of the edge opposite to it."),
        "homogeneous": _given("homogeneous", "x, y and w in the window, before the division."),
        "window": VariableText("window", "Position in pixels, before snapping."),
        "snapped": VariableText("snapped", "Position on the lattice of 1/256 pixel, which coverage sees."),
        "rounded": VariableText("rounded", "x, y and w as the number format has them."),
        "doubled_area": VariableText("2 area", "Twice the signed area, or the determinant."),
        "start": VariableText("edge start", "Start of the edge as (x, y, w).", "a"),
        "finish": VariableText("edge end", "End of the edge as (x, y, w).", "a"),
        "a": VariableText("a", "Change of the edge function with a pixel to the right."),
        "b": VariableText("b", "Change of the edge function with a pixel upwards."),
        "c": VariableText("c", "Value of the edge function at the window's origin."),
        "owns_tie": VariableText("owns ties", "Whether a pixel centre on the edge belongs to the triangle."),
    },
    "bin": {
        "corners": VariableText("corner #", "Position that coverage sees, in pixels.", spread="edges"),
        "column": _given("first column", "First column of the box or block."),
        "column_end": _given("end column", "Column after the last."),
        "row": _given("first row", "First row of the box or block."),
        "row_end": _given("end row", "Row after the last."),
        "size": _given("size", "Pixels on a side of the block; 0 for a box."),
        "center": _given("centre offset", "Where a pixel's centre is, from its lower left corner."),
        "high": VariableText(
            "greatest E#", "Greatest value of the edge function in the block.", spread="edges"
        ),
        "low": VariableText("least E#", "Least value of the edge function in the block.", spread="edges"),
        "rejected_by": VariableText("rejected by", "Edge that has all of the block outside; −1: none."),
        "verdict": VariableText("verdict", "What becomes of the block."),
        **_COEFFICIENTS,
    },
    "raster": {
        **_PIXEL,
        **_SAMPLE,
        **SPAN_VARIABLES,
        **{
            f"before_{k}": _given(f"E{k} before", "Value at the neighbour that it is reached from.")
            for k in range(3)
        },
        **{
            f"value_{k}": VariableText(f"E{k} (snapped)", "Decision value: above 0 is inside.", edge=k)
            for k in range(3)
        },
        "covered": VariableText("covered", "Whether the pixel is drawn."),
        "tie": VariableText("on edge #", "Whether the centre lies exactly on the edge.", spread="edges"),
        "weights": VariableText(
            "weight # (unsnapped)",
            "Share of the corner, from the corners as they are; it may disagree with E by a hair.",
            "covered",
            "edges",
        ),
        "distance": VariableText(
            "distance #", "From the edge, in pixels; below 0 is outside.", "covered", "edges"
        ),
        **{
            f"crossing_{k}": VariableText(f"crossing {k}", "x where the row crosses the edge.", edge=k)
            for k in range(3)
        },
        **_CENTRE,
        **_COEFFICIENTS,
        "owns_tie": _given("owns ties on #", "Whether a centre exactly on the edge is inside.", "edges"),
        **CLIPPING_VARIABLES,
        **LINE_VARIABLES,
    },
    "interpolate": {
        **_PIXEL,
        **_SAMPLE,
        **_CENTRE,
        "numerators": VariableText("n#", "Edge function of the corners as they are.", spread="edges"),
        "total": VariableText("sum of n", "All three together."),
        "inverse_w": VariableText("1/w", "One over w at the pixel."),
        "weights": VariableText("weight # (unsnapped)", "Share of the corner.", spread="edges"),
        "corner_values": VariableText(
            "at corner #", "All values of the corner, in order.", "weights", "edges"
        ),
        **{name: VariableText(name.replace("_", " "), "Mixed by the weights.") for name in ATTRIBUTES},
        **_COEFFICIENTS,
        "corner_w": _given("w#", "w of the corner.", "edges"),
        "t": _given("t", "How far the pixel lies along the line: 0 at the first end, 1 at the second."),
        "end_w": _given("w of the ends", "w of the line's first and second end."),
        "parts": VariableText("parts", "Share of each end over its w."),
        "s": VariableText("s", "Share of the second end in the value."),
        **CORRECTED_VARIABLES,
    },
    "shade": {
        **_PIXEL,
        **_SAMPLE,
        "uv": _given("u, v", "Texture coordinates."),
        "texture_size": _given("texture size", "Texels from left to right and from bottom to top."),
        "texel_position": VariableText("texture place", "Texture coordinates counted in texels."),
        "texels": VariableText("texel #", "Column and row in the texture.", spread="parts"),
        "texel_colors": VariableText("texel colour #", "Linear red, green, blue, alpha.", spread="parts"),
        "mix": VariableText("fractions", "How far towards the right and the upper texels the place is."),
        "shares": VariableText("share #", "Share of the texel in the colour.", spread="parts"),
        **MIPMAP_VARIABLES,
        "texture_color": VariableText("texture colour", "Linear red, green, blue, alpha."),
        "albedo": VariableText("albedo", "Colour before lighting: linear red, green, blue, alpha."),
        "normal": VariableText("N", "Unit normal, in world space."),
        "to_eye": VariableText("V", "Unit vector to the eye, in world space."),
        "n_dot_l": VariableText("N·L, light #", "Cosine between normal and light.", spread="parts"),
        "n_dot_h": VariableText("N·H, light #", "Cosine between normal and halfway vector.", spread="parts"),
        "to_light": VariableText("L, light #", "Unit vector to the light.", "n_dot_l", "parts"),
        "half": VariableText("H, light #", "Unit vector halfway to the eye.", "n_dot_h", "parts"),
        "power": VariableText("highlight, light #", "Cosine to the power of the shininess.", spread="parts"),
        "diffuse_light": VariableText("diffuse light", "Ambient and diffuse light: red, green, blue."),
        "specular_light": VariableText("specular light", "Mirrored light: red, green, blue."),
        "color": VariableText("colour", "Colour of the fragment: linear red, green, blue, alpha."),
    },
    "depth": {
        **_PIXEL,
        **_SAMPLE,
        **DEPTH_VARIABLES,
    },
    "blend": {
        **_PIXEL,
        **_SAMPLE,
        "color": VariableText("shaded colour", "Linear red, green, blue and straight alpha, as shaded."),
        "intensity": VariableText("intensity", "Share of the line's colour that the pixel gets."),
        "source": VariableText("fragment colour", "Linear red, green, blue and straight alpha."),
        "before": VariableText("buffer before", "What the colour buffer held."),
        "after": VariableText("colour buffer", "What the colour buffer holds.", previous="before"),
    },
    "resolve": {
        **_PIXEL,
        **RESOLVE_VARIABLES,
    },
}
"""Variables of each stage in the order of the algorithm; what is not here stays hidden."""


_OF_LANE = frozenset({"corner_y", "first_row", "row_count", "lane", "lane_count"})
_OF_LANE_ROW = frozenset({f"{name}_{k}" for name in ("numerator", "quotient") for k in range(3)}) | {
    *("dx", "dy", "left", "left_guard", "right", "right_guard", "length", "span_count"),
}
_OF_PASS = frozenset({"pass_number", "pass_size", "drawn_before", "rank"})
_OF_SPANS = frozenset(SPAN_VARIABLES) - {"start", "stop"}
_BEFORE = frozenset({f"before_{k}" for k in range(3)})
_PLANE = frozenset({"origin", "across", "up"})
_OF_PIXEL = frozenset(_PIXEL)
_OF_CORNER = frozenset({"number", "clip"})

HIDDEN: Mapping[str, frozenset[str]] = {
    "clip.untouched": frozenset({"edge"}) | _OF_CORNER,
    **{f"clip.{case}": _OF_CORNER for case in ("in-in", "in-out", "out-in", "out-out")},
    **{f"clip.{kind}": frozenset({"edge"}) for kind in ("divided", "mirrored", "undefined")},
    "edges.orientation": frozenset({"corner", "homogeneous"}),
    "edges.determinant": frozenset({"corner", "homogeneous"}),
    "edges.inverse-edge": frozenset({"homogeneous"}),
    "bin.outer-box": frozenset({"size", "a", "b", "c"}),
    "edges.edge": frozenset({"homogeneous"}),
    "edges.anchored-edge": frozenset({"homogeneous"}),
    "bin.box": frozenset({"size", "a", "b", "c"}),
    "bin.behind": frozenset({"column", "column_end", "row", "row_end", "size", "center", "a", "b", "c"}),
    "bin.whole-image": frozenset({"size", "center", "a", "b", "c"}),
    "raster.test": _OF_SPANS | _BEFORE,
    "raster.step": _OF_SPANS,
    "raster.climb": _OF_SPANS,
    "raster.accept": _OF_SPANS,
    "raster.span": frozenset({"column", "x"}) | _OF_SPANS,
    "raster.line": frozenset({"column", "x", "y", "a", "b", "c", "owns_tie"}),
    "raster.lane": frozenset({"column", "row", "x", "y", "a", "b", "c", "owns_tie"}) | (_OF_SPANS - _OF_LANE),
    "raster.lane-row": frozenset({"column", "x", "a", "b", "c"}) | _OF_LANE | _OF_PASS,
    "raster.pass": (_OF_SPANS - _OF_PASS) | {"owns_tie"},
    **{f"raster.{kind}": _OF_PIXEL for kind in CLIPPING_KINDS},
    "depth.rounded": _PLANE,
    "depth.out-of-range": _PLANE,
    "depth.store": _PLANE,
}
"""Variables that rows of a kind have no use for."""


def step_variables(explanation: Explanation) -> tuple[Variable, ...]:
    """Return the rows of the table after a step: what is given, what is known by now, what has just changed.

    Variables that a later operation sets are left out until then.
    """
    stage, kind, _ = explanation.key.split(".", 2)
    hidden = HIDDEN.get(f"{stage}.{kind}", frozenset())
    values, known = explanation.values, explanation.known
    rows: list[Variable] = []
    for name, text in TEXTS.get(stage, {}).items():
        needed = name if text.after == "itself" else text.after
        if name not in values or name in hidden or (needed != GIVEN and needed not in known):
            continue
        is_changed = name in explanation.changed
        before: Any = values.get(text.previous)
        label, meaning = in_its_numbers(name, text.label, text.meaning, values)
        text = replace(text, label=label, meaning=meaning)
        rows += _rows(text, values[name], before if is_changed else values[name])
    return tuple(rows)


def _rows(text: VariableText, now: Any, before: Any) -> list[Variable]:
    """Return one row, or one for every element that gets its own."""
    if text.is_key:
        return _key_rows(text, int(now), None if before is None else int(before))
    if not text.spread:
        return [Variable(text.label, _value(now), _value(before), text.meaning, text.edge)]
    elements = np.asarray(now)
    earlier = [None] * len(elements) if before is None else list(np.asarray(before))
    is_of_edges = text.spread == "edges"
    return [
        Variable(
            text.label.replace("#", str(k)),
            _value(element),
            _value(earlier[k]),
            text.meaning,
            k if is_of_edges else None,
        )
        for k, element in enumerate(elements)
        if text.spread != "corners" or np.isfinite(element).all()
    ]


def _key_rows(text: VariableText, now: int, before: int | None) -> list[Variable]:
    """Return the two fields of a packed key: the depth, and the number of the triangle plus one."""
    depth, number = _digits(now)
    earlier_depth, earlier_number = _digits(before) if before is not None else (None, None)
    return [
        Variable(text.label, depth, earlier_depth, f"{text.meaning} Its upper bits, in hexadecimal."),
        Variable(f"{text.label}, number", number, earlier_number, "Its lower 24 bits, in hexadecimal."),
    ]


def _digits(key: int) -> tuple[str, str]:
    depth, number = key_fields(key)
    return depth.removeprefix("0x"), number.removeprefix("0x")


def _value(value: Any) -> Value:
    """Return a number, a word, or the numbers of an array as plain Python values."""
    if value is None or isinstance(value, str):
        return value
    array = np.asarray(value)
    if array.ndim == 0:
        found: Value = array.item()
        return found
    return tuple(float(element) for element in array.ravel())
