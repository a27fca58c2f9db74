"""The variables of corrected affine interpolation and of mipmaps, as rows of the table."""

from collections.abc import Mapping

from core.explain.variable_text import VariableText

CORRECTED_VARIABLES: Mapping[str, VariableText] = {
    "row_ends": VariableText("row ends", "x where the triangle begins and ends in this row."),
    "interval": VariableText("n", "Columns between corrections.", "grid"),
    "grid": VariableText("grid", "x of the columns before and behind whose number is a multiple of n."),
    "anchor_x": VariableText("anchors", "x of the two places that are interpolated with perspective."),
    "fraction": VariableText("t", "How far the centre is from the left to the right anchor."),
    "anchor_weights": VariableText("weights, anchor #", "Perspective-correct weights.", spread="parts"),
}
"""Variables of affine interpolation that is corrected every n pixels."""


def _level_variables(name: str) -> dict[str, VariableText]:
    which = "finer" if name == "near" else "coarser"
    return {
        f"{name}_position": VariableText(f"{which}: place", "Texture coordinates in texels of this level."),
        f"{name}_texels": VariableText(f"{which}: texel #", "Column and row in the level.", spread="parts"),
        f"{name}_colors": VariableText(
            f"{which}: colour #", "Linear red, green, blue, alpha.", spread="parts"
        ),
        f"{name}_shares": VariableText(
            f"{which}: share #", "Share of the texel in the level's colour.", spread="parts"
        ),
        f"{name}_color": VariableText(f"{which}: colour", "What bilinear filtering gives in this level."),
    }


MIPMAP_VARIABLES: Mapping[str, VariableText] = {
    "slope_a": VariableText(
        "a#", "Change of the numerator n with a pixel to the right.", "uv_slopes", "edges"
    ),
    "slope_b": VariableText("b#", "Change of the numerator n with a pixel upwards.", "uv_slopes", "edges"),
    "slope_n": VariableText("n#", "Numerator of the corner's weight.", "uv_slopes", "edges"),
    "corner_uv": VariableText("u, v at corner #", "Texture coordinates there.", "uv_slopes", "edges"),
    "length": VariableText("length", "Pixels of the line along its major axis.", "uv_slopes"),
    "end_uv": VariableText("u, v at end #", "Texture coordinates there.", "uv_slopes", "parts"),
    "t": VariableText("t", "How far the pixel lies along the line.", "uv_slopes"),
    "end_w": VariableText("w of the ends", "w of the line's first and second end.", "uv_slopes"),
    "uv_slopes": VariableText("slopes", "Changes of u and v to the right, then of u and v upwards."),
    "lengths": VariableText("lengths", "Texels that a pixel to the right, and one up, leads on."),
    "lod": VariableText("λ", "Level of detail: logarithm to base 2 of the greater length."),
    "level": VariableText("level", "λ within the levels that there are."),
    "levels": VariableText("levels", "Numbers of the finer and the coarser level."),
    "level_sizes": VariableText("level sizes", "Width and height of both, in texels."),
    "level_fraction": VariableText("coarser share", "Share of the coarser level in the colour."),
    **_level_variables("near"),
    **_level_variables("far"),
}
"""Variables of texture filters that use mipmaps."""
