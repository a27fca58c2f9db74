"""Interpolation along lines: the weights of both ends."""

from core.explain.digits import spoken
from core.explain.formulas import formula_of, named
from core.explain.records import Asked, number
from core.explain.rows import Said, explains
from core.explain.step_values import StepValues
from core.explain.variable_text import VariableText, given, shows


@explains("interpolate.line-perspective.parts")
def parts(step: StepValues) -> Said:
    """Both ends' parts of 1/w."""
    t, (start, end) = step.named("t", "t"), map(named, ("p_0", "p_1"), step.vector("parts"))
    first, second = (named(step.of_end("w", k), w) for k, w in enumerate(step.vector("end_w")))
    text = (
        f"{step.fragment_name}: at t = {t} between ends with w = {first} and w = {second}, "
        f"the first end gives {start} of 1/w and the second {end}."
    )
    return text, formula_of(start.equals((1 - t) / first), end.equals(t / second))


@explains("interpolate.line-perspective.total")
def total(step: StepValues) -> Said:
    """1/w along the line."""
    (start, end), whole = (
        map(named, ("p_0", "p_1"), step.vector("parts")),
        step.named("total", r"\frac{1}{w}"),
    )
    text = f"{step.fragment_name}: both parts add up to 1/w = {whole}."
    return text, formula_of(whole.equals(start + end))


def second_weight(step: StepValues) -> Asked | None:
    """Ask for the weight of the second end."""
    s = step.number("s")
    return number(f"What is s, the weight of the second end, at {step.the_pixel}?", s, f"s is {spoken(s)}.")


@explains("interpolate.*.weight", asks=second_weight, decides=True)
def weight(step: StepValues) -> Said:
    """The weights of the ends."""
    s, is_affine = step.named("s", "s"), step.kind == "line-affine"
    how = "its place along the line in the window" if is_affine else "the second part over 1/w"
    text = f"{step.fragment_name}: the second end has weight {s}, {how}, and the first end {spoken(1 - s.value)}."
    if is_affine:
        return text, formula_of(s.equals(step.named("t", "t")))
    return text, formula_of(s.equals(named("p_1", step.vector("parts")[1]) / step.named("total", "1/w")))


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
