"""Ray casting: where rays meet triangles, compared in float64 and, where that cannot decide, exactly."""

import math

from core.explain.digits import number_latex, signed_latex, spoken
from core.explain.equation import conclusion, equation, fraction, relation
from core.explain.number_text import pair_text
from core.explain.records import Asked, choice
from core.explain.rows import Said, explains
from core.explain.step_values import StepValues

_NEW, _NEAREST = r"v_{\mathrm{new}}", r"v_{\mathrm{nearest}}"


def _measure(step: StepValues) -> str:
    """Return what decides which of two hits is nearer: the larger one is."""
    return "1/w" if step.flag("by_w") else "−z/w"


def nearer(step: StepValues) -> Asked:
    """Ask which of two triangles the ray meets first."""
    is_nearer, nearest = step.flag("passes"), step.whole("nearest")
    how = "nearer" if is_nearer else "not nearer"
    return choice(
        f"The ray of {step.the_pixel} has met triangle {nearest}. Is triangle {step.triangle} nearer?",
        0 if is_nearer else 1,
        f"compared exactly, triangle {step.triangle} is {how} than triangle {nearest}.",
    )


@explains("depth.*.hit")
def hit(step: StepValues) -> Said:
    """Where the ray meets the plane of a triangle, in the coordinates X = m/W and Y = n/H."""
    value, error = step.number("nearness"), step.number("error")
    text = f"the ray meets triangle {step.triangle} at {_measure(step)} = {spoken(value)}, within {spoken(error)}."
    if math.isinf(error):
        text = (
            f"the ray runs in the plane of triangle {step.triangle}, or so nearly that float64 cannot locate the hit; "
            f"{spoken(value)} stands for it."
        )
    a, b, c, d = (step.number(name) for name in "abcd")
    m, n = (number_latex(step.number(name)) for name in "mn")
    above = rf"{signed_latex(a)} \cdot {m} / W + {signed_latex(b)} \cdot {n} / H + {signed_latex(c)}"
    quotient = fraction((r"a \, m / W + b \, n / H + c", above), ("d", d))
    return f"{step.pixel_name}: {text}", equation(("v", value), "=", quotient)


@explains("depth.*.bound")
def bound(step: StepValues) -> Said:
    """How far rounding may have moved the hit."""
    error = step.number("error")
    text = f"rounding has moved this {_measure(step)} by at most {spoken(error)}."
    if math.isinf(error):
        text = "float64 cannot bound the rounding error of this hit."
    return f"{step.pixel_name}: {text}", equation(("e", error))


@explains("depth.ray-first.keep")
def first(step: StepValues) -> Said:
    """The first hit of a ray."""
    if not step.flag("writes"):
        return _not_kept(step, "nothing")
    return f"{step.pixel_name}: the ray has met nothing before, so triangle {step.triangle} is the nearest so far."


@explains("depth.ray.compare", asks=nearer, decides=True)
def compared(step: StepValues) -> Said:
    """A hit that float64 tells from the nearest so far."""
    new, old, nearest = step.number("nearness"), step.number("nearest_nearness"), step.whole("nearest")
    shown, shown_old = pair_text(new, old)
    verdict, than = ("passes", "larger") if step.flag("passes") else ("fails", "smaller")
    text = (
        f"{step.pixel_name} {verdict}: {_measure(step)} {shown} is {than} than {shown_old} of triangle {nearest}, "
        "and by more than both errors together."
    )
    done = conclusion("passes", verdict)
    return text, equation((_NEW, new), (">", relation(new, old)), (_NEAREST, old), *done)


@explains("depth.ray-exact.doubt")
def doubted(step: StepValues) -> Said:
    """A hit that float64 cannot tell from the nearest so far."""
    errors = step.number("error") + step.number("nearest_error")
    apart = abs(step.number("nearness") - step.number("nearest_nearness"))
    text = (
        f"{step.pixel_name}: triangle {step.whole('nearest')} is {spoken(apart)} away in {_measure(step)}, "
        f"within the errors of {spoken(errors)}: float64 cannot decide."
    )
    if math.isinf(errors):
        text = f"{step.pixel_name}: float64 cannot locate one of the two hits, so it cannot decide."
    return text, equation(
        (f"|{_NEW} - {_NEAREST}|", apart), r"\le", (r"e_{\mathrm{new}} + e_{\mathrm{nearest}}", errors)
    )


@explains("depth.ray-exact.exact", asks=nearer, decides=True)
def exact(step: StepValues) -> Said:
    """The comparison in whole numbers."""
    sign, nearest = step.whole("sign"), f"triangle {step.whole('nearest')}"
    verdict, word = ("passes", "nearer") if sign > 0 else ("fails", "farther")
    text = f"{verdict}: compared in whole numbers, without any error, it is {word} than {nearest}."
    if sign == 0:
        text = f"fails: in whole numbers it is exactly as near as {nearest}, and a tie keeps that."
    return f"{step.pixel_name} {text}", equation(
        (rf"\mathrm{{sign}}({_NEW} - {_NEAREST})", float(sign)),
        (">", relation(sign)),
        "0",
        *conclusion("passes", verdict),
    )


@explains("depth.ray|ray-exact.write")
def written(step: StepValues) -> Said:
    """Which triangle is the ray's nearest now."""
    if step.flag("passes") and not step.flag("writes"):
        return _not_kept(step, f"triangle {step.whole('nearest')}")
    seen = step.triangle if step.flag("passes") else step.whole("nearest")
    verb = "is now" if step.flag("passes") else "is still"
    return f"{step.pixel_name}: triangle {seen} {verb} the nearest on the ray."


def _not_kept(step: StepValues, nearest: str) -> str:
    """A pale pixel of a line, which later hits are not compared with."""
    return (
        f"{step.pixel_name}: {nearest} stays the nearest on the ray, as the line covers less than half of this pixel "
        "and must not hide what is drawn there later."
    )
