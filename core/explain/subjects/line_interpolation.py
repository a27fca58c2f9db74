"""Interpolation along lines: the weights of both ends."""

from core.explain.digits import number_latex, spoken
from core.explain.equation import (
    beside,
    equation,
    fraction,
    linear,
)
from core.explain.records import Asked, number
from core.explain.rows import Said, explains
from core.explain.step_values import StepValues
from core.explain.variable_text import VariableText, given, shows


@explains("interpolate.line-perspective.parts")
def parts(step: StepValues) -> Said:
    """Both ends' parts of 1/w."""
    t, w, (start, end) = step.number("t"), step.vector("end_w"), step.vector("parts")
    text = (
        f"{step.fragment_name}: at t = {spoken(t)} between ends with w = {spoken(w[0])} and w = {spoken(w[1])}, "
        f"the first end gives {spoken(start)} of 1/w and the second {spoken(end)}."
    )
    first = fraction(("1 - t", f"1 - {number_latex(t)}"), (step.of_end("w", 0), w[0]))
    second = fraction(("t", t), (step.of_end("w", 1), w[1]))
    return text, equation(*beside([("p_0", start), "=", first], [("p_1", end), "=", second]))


@explains("interpolate.line-perspective.total")
def total(step: StepValues) -> Said:
    """1/w along the line."""
    (start, end), whole = step.vector("parts"), step.number("total")
    text = f"{step.fragment_name}: both parts add up to 1/w = {spoken(whole)}."
    return text, linear(r"\frac{1}{w}", whole, [("p_0", start), ("p_1", end)])


def second_weight(step: StepValues) -> Asked | None:
    """Ask for the weight of the second end."""
    s = step.number("s")
    return number(f"What is s, the weight of the second end, at {step.the_pixel}?", s, f"s is {spoken(s)}.")


@explains("interpolate.*.weight", asks=second_weight, decides=True)
def weight(step: StepValues) -> Said:
    """The weights of the ends."""
    s, is_affine = step.number("s"), step.kind == "line-affine"
    how = "its place along the line in the window" if is_affine else "the second part over 1/w"
    text = f"{step.fragment_name}: the second end has weight {spoken(s)}, {how}, and the first end {spoken(1 - s)}."
    if is_affine:
        return text, equation(("s", s), "=", ("t", step.number("t")))
    return text, equation(
        ("s", s), "=", fraction(("p_1", step.vector("parts")[1]), ("1/w", step.number("total")))
    )


shows(
    "interpolate",
    {
        "t": given("t", "Position along the line: 0 at the first end, 1 at the second."),
        "end_w": given("w of the ends", "w of the line's first and second end."),
        "parts": VariableText("p₀, p₁", "Weight of each end over its w."),
        "s": VariableText("s", "Weight of the second end in the value."),
        "end_values": VariableText("at end #", "All values at the line's end, in order.", "s", "parts"),
    },
)
