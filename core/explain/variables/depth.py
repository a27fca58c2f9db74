"""The variables of the depth stage, in the order of the algorithm: rays, values of depth methods, test, packed keys."""

from collections.abc import Mapping

from core.explain.variable_text import GIVEN, VariableText

_MADE_FROM: Mapping[str, VariableText] = {
    "m": VariableText("m", "2 x − W: the ray's x/w is m/W.", "depth"),
    "n": VariableText("n", "2 y − H: the ray's y/w is n/H.", "depth"),
    "x": VariableText("x", "x of the pixel's centre, in pixels.", "depth"),
    "y": VariableText("y", "y of the pixel's centre, in pixels.", "depth"),
    "a": VariableText("a", "Change of the value with a step to the right.", "depth"),
    "b": VariableText("b", "Change of the value with a step upwards.", "depth"),
    "c": VariableText("c", "Value where both coordinates are 0.", "depth"),
    "d": VariableText("d", "Determinant of the corners' x, y and w.", "depth"),
    "t": VariableText(
        "t", "How far the pixel lies along the line: 0 at the first end, 1 at the second.", "depth"
    ),
    "ends": VariableText("at the ends", "Reversed z at both ends of the line.", "depth"),
    "scale": VariableText("steps", "What depth 1 is stored as, in whole numbers.", GIVEN),
    "near": VariableText("near", "w at which the logarithmic depth is 0.", GIVEN),
    "far": VariableText("far", "w at which the logarithmic depth is 1.", GIVEN),
}
"""What values are made from."""

_RAYS: Mapping[str, VariableText] = {
    "nearness": VariableText("nearness", "Where the ray meets the triangle: 1/w or −z/w, larger is nearer."),
    "error": VariableText("error", "Bound of its rounding error."),
    "nearest": VariableText(
        "nearest so far", "Number of the nearest triangle that the ray has met before; −1: none."
    ),
    "nearest_nearness": VariableText("its nearness", "Where the ray meets that one."),
    "nearest_error": VariableText("its error", "Bound of its rounding error."),
    "sign": VariableText("sign", "1: nearer than the nearest so far, −1: farther, 0: equally near."),
}
"""What rays compare."""

DEPTH_VARIABLES: Mapping[str, VariableText] = {
    "depth": VariableText("z", "Window depth: 0 is near, 1 is far."),
    **_MADE_FROM,
    **_RAYS,
    "value": VariableText("value", "What is stored in the place of z, before it is rounded."),
    "inverse_w": VariableText("1/w", "One over w at the pixel.", "stored"),
    "stored": VariableText("new value", "What the depth method stores of the fragment."),
    "number": VariableText("number", "Number of the triangle; its key holds one more.", "key"),
    "key": VariableText("key", "Depth above, number plus one below, in one whole number.", is_key=True),
    "before_key": VariableText("key before", "Key in the buffer; the lesser one stays.", is_key=True),
    "before": VariableText("buffer before", "What the depth buffer held."),
    "passes": VariableText("passes", "Whether the fragment is kept."),
    "after": VariableText("depth buffer", "What the depth buffer holds.", previous="before"),
    "after_key": VariableText(
        "key in buffer", "The lesser of both keys.", previous="before_key", is_key=True
    ),
    "origin": VariableText("origin", "Depth at column 0, row 0, in units of 2⁻³⁸.", "stored"),
    "across": VariableText("across", "Change of the depth with a column, in units of 2⁻³⁸.", "stored"),
    "up": VariableText("up", "Change of the depth with a row, in units of 2⁻³⁸.", "stored"),
}
"""Variables of the depth stage, but for the pixel's place."""
