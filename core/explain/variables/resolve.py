"""The variables of the resolve stage, in the order of the algorithm: cuts of exact areas, samples, display bytes."""

from collections.abc import Mapping

from core.explain.variable_text import VariableText

_CUTS: Mapping[str, VariableText] = {
    "edge": VariableText("edge", "Which edge of the triangle cuts."),
    "a": VariableText("a", "Change of the edge function with a pixel to the right."),
    "b": VariableText("b", "Change of the edge function with a pixel upwards."),
    "value": VariableText("E at centre", "Value of the edge function at the pixel's centre."),
    "before": VariableText(
        "corner #", "Corner of the polygon that is cut, x and y from the pixel's centre.", spread="corners"
    ),
    "corner_distance": VariableText(
        "E at corner #", "Edge function at the corner: positive is inside.", spread="corners"
    ),
    "polygon": VariableText(
        "left corner #", "Corner of what is left, x and y from the pixel's centre.", spread="corners"
    ),
    "corner_count": VariableText("corners left", "Corners of what is left; 0: nothing that has an area."),
    "piece_area": VariableText("area", "Of what is left, in pixels."),
    "primitive": VariableText("number drawn", "Which of the drawn triangles, pieces counted apart, it is."),
    "part_area": VariableText(
        "part #",
        "How much of the pixel a triangle, or the background, shows by now; 0: there is none.",
        spread="parts",
    ),
    "part_primitive": VariableText(
        "part # shows", "Number of the drawn triangle that it is; −1: the background.", spread="parts"
    ),
    "untold_cuts": VariableText(
        "cuts left out",
        "How often a triangle cuts a pixel here: too often to be stepped through. Those of one triangle, or of a "
        "smaller part of the picture, are.",
    ),
    "seen_area": VariableText("in front", "Area of it that is in front of what was there before."),
    "covered_area": VariableText("covered", "Area of the pixel that shows any triangle by now."),
}

RESOLVE_VARIABLES: Mapping[str, VariableText] = {
    **_CUTS,
    "samples": VariableText(
        "colour #", "Linear red, green, blue, alpha of the sample or piece.", spread="parts"
    ),
    "sample_weights": VariableText(
        "weight #", "What the sample weighs, or the area of the piece.", spread="parts"
    ),
    "linear": VariableText("linear", "Linear red, green, blue, alpha of the colour buffer."),
    "clipped": VariableText("cut off", "Red, green, blue between 0 and 1."),
    "encoded": VariableText("sRGB", "Red, green, blue on the sRGB curve."),
    "bytes": VariableText("bytes", "Red, green, blue, alpha from 0 to 255."),
}
