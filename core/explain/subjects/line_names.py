"""What the numbers of a line are called: as in its listing, which swaps x and y of a steep line."""

from core.explain.listed_code import assigned_name, code_of, symbols
from core.explain.listed_code import tested as tested_by
from core.explain.step_values import StepValues
from core.explain.variable_text import VariableText, hides, shows
from core.methods import table
from core.raster.lines.traits import OFF, line_of_kind, line_traits, minor_name


def line_method(step: StepValues) -> str:
    """Return the line method of a row."""
    return line_of_kind(step.kind)


def is_swapped(step: StepValues) -> bool:
    """Return whether the listing has swapped x and y for a steep line."""
    line = line_method(step)
    is_steep = bool(step.explanation.values.get("is_steep", False))
    return is_steep and line in table.names("line") and line_traits(line).swaps_axes


MAJOR, MINOR = "x", "y"
"""Symbols, as in the listings, of the longer axis of the line and of the other: of a steep line x and y are swapped."""


def axes(step: StepValues) -> tuple[str, str]:
    """Return in words the longer axis of the line and the other: their symbols, and what they count if swapped."""
    return ("x (the row)", "y (the column)") if is_swapped(step) else (MAJOR, MINOR)


DECISIONS = {"rectangle": "a", "diamond-exit": f"{MINOR} − {MINOR} centre"}
"""Symbol of the number that chooses the pixel, where no test of the listing has it."""


def decision_name(step: StepValues) -> str:
    """Return the formula's symbol of the number that chooses the pixel: what is tested, or the line's y."""
    test = tested_by(code_of(step, "test"))
    return symbols(test.left) if test else DECISIONS.get(line_method(step), MINOR)


def sum_name(step: StepValues) -> str:
    """Return the symbol of the sum that a method adds up from pixel to pixel."""
    return assigned_name(code_of(step, "advance")) or MINOR


def _major_name(step: StepValues) -> str:
    return "row" if is_swapped(step) else MAJOR


def _minor_name(step: StepValues) -> str:
    line = line_method(step)
    if line not in table.names("line"):
        return MINOR
    return "column" if is_swapped(step) else minor_name(line)


for _line in table.names("line"):
    _kinds = table.get("line", _line).operations
    if any("minor" in done.sets for kind in _kinds.values() for done in kind):
        # The listing's own x and y are the pixel, one step after the other.
        hides(f"raster.{'|'.join(_kinds)}", ("column", "row"))
    hides(f"raster.{_line}{OFF}", ("column", "row"))
_X = "Pixel along the longer axis of the line."
_Y = "Pixel along the other axis."
_SUM = "The sum that decides, from pixel to pixel."
shows(
    "raster",
    {
        "major_before": VariableText(_major_name, _X),
        "major": VariableText(_major_name, _X),
        "minor_before": VariableText(_minor_name, _Y),
        "minor": VariableText(_minor_name, _Y),
        "sum_before": VariableText(sum_name, _SUM),
        "decision": VariableText(decision_name, "The number whose sign or rounding chooses the pixel."),
        "sum_corrected": VariableText(sum_name, _SUM),
        "sum_advanced": VariableText(sum_name, _SUM),
        "first_end": VariableText("first end", "Start of the line, as the method uses it."),
        "second_end": VariableText("second end", "End of the line, as the method uses it."),
        "is_steep": VariableText("steep", "Whether y is the major axis: one pixel in every row."),
        "dx": VariableText("dx", "Length along x, without sign; a steep line has x and y swapped."),
        "dy": VariableText("dy", "Length along y, without sign; a steep line has x and y swapped."),
        "sx": VariableText("sx", "The way along x, 1 or −1; a steep line has x and y swapped."),
        "sy": VariableText("sy", "What is added to y where it steps; a steep line has x and y swapped."),
        "slope": VariableText("m", "Slope: change of the minor coordinate with every step."),
        "intercept": VariableText("b", "Intercept: minor coordinate where the major one is 0."),
        "has_stepped": VariableText("stepped", "Whether the minor coordinate changed."),
        "is_tie": VariableText("tie", "Whether the line passes exactly between two pixels."),
        "exit_start": VariableText(
            "d₀", "How far the first end is through the diamond: below 0.5 is inside."
        ),
        "exit_end": VariableText(
            "d₁", "How far the second end is through the diamond: 0.5 or more is outside."
        ),
        "length": VariableText(
            lambda step: "n" if step.kind == "lane-row" else "L", "Length of the span or line, in pixels."
        ),
        "t": VariableText("t", "Position along the line: 0 at the first end, 1 at the second."),
    },
)
