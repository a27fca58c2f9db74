"""Ray casting: where rays meet triangles, compared in float64 and, where that cannot decide, exactly."""

import math

from core.explain.formulas import Chain, below, concludes, formula_of, named, slash
from core.explain.number_text import pair_text, spoken
from core.explain.records import Asked, choice
from core.explain.step_values import Said, StepValues, explains
from core.visibility.ray_casting import ROUNDING, UNDERFLOW

NEW, NEAREST = below("v", "new"), below("v", "nearest")


def measure(step: StepValues) -> str:
    """Return what decides which of two hits is nearer: the larger one is."""
    return "1/w" if step.flag("by_w") else "−z/w"


def nearer(step: StepValues) -> Asked:
    """Ask which of two triangles the ray meets first."""
    is_nearer, nearest = step.flag("passes"), step.whole("nearest")
    how = "nearer" if is_nearer else "not nearer"
    return choice(
        f"The ray of {step.the_pixel} has met {step.named_primitive(nearest)}. Is {step.name} nearer?",
        0 if is_nearer else 1,
        f"compared exactly, {step.name} is {how} than {step.named_primitive(nearest)}.",
    )


@explains("depth.*.hit")
def hit(step: StepValues) -> Said:
    """Where the ray meets the plane of a triangle, in the coordinates X = m/W and Y = n/H."""
    value, error = step.named("nearness", "v"), step.number("error")
    text = f"the ray meets {step.name} at {measure(step)} = {value}, within {spoken(error)}."
    if math.isinf(error):
        text = (
            f"the ray runs in the plane of {step.name}, or so nearly that float64 cannot locate the hit; "
            f"{value} stands for it."
        )
    a, b, c, d, m, n = (step.named(name, name) for name in "abcdmn")
    above = slash(a @ m, step.named("width", "W")) + slash(b @ n, step.named("height", "H")) + c
    return f"{step.pixel_name}: {text}", formula_of(value.equals(above / d))


@explains("depth.*.bound")
def bound(step: StepValues) -> Said:
    """How far rounding may have moved the hit."""
    error = step.named("error", "e")
    text = (
        f"rounding has moved this {measure(step)} by at most {error}: a share of the sizes of all its terms, "
        "numerator (n) and denominator (d)."
    )
    if math.isinf(error.value):
        text = "float64 cannot bound the rounding error of this hit."
    if math.isinf(error.value):
        return f"{step.pixel_name}: {text}"
    value, d = (abs(step.number(name)) for name in ("nearness", "d"))
    above, of_d = (named(below("e", name), of) for name, of in zip("nd", term_errors(step), strict=True))
    size = named("|v|", value)
    kept = (above + size @ of_d) / (named("|d|", d) - of_d)
    return f"{step.pixel_name}: {text}", formula_of(error.equals(kept + named("2^{-49}", ROUNDING) @ size))


def term_errors(step: StepValues) -> tuple[float, float]:
    """Return the bounds of the rounding in the numerator and in the denominator of a hit."""
    size_a, size_b, size_c, size_d = step.vector("sizes")
    x, y = step.number("m") / step.number("width"), step.number("n") / step.number("height")
    numerator = ROUNDING * (size_a * abs(x) + (size_b * abs(y) + size_c)) + UNDERFLOW
    return numerator, ROUNDING * size_d + UNDERFLOW


@explains("depth.ray-first.keep")
def first(step: StepValues) -> Said:
    """The first hit of a ray."""
    if not step.flag("writes"):
        return _not_kept(step, "nothing")
    return f"{step.pixel_name}: the ray has met nothing before, so {step.name} is the nearest so far."


@explains("depth.ray.compare", asks=nearer, decides=True)
def compared(step: StepValues) -> Said:
    """A hit that float64 tells from the nearest so far."""
    new, old, nearest = step.number("nearness"), step.number("nearest_nearness"), step.whole("nearest")
    shown, shown_old = pair_text(new, old)
    verdict, than = ("passes", "larger") if step.flag("passes") else ("fails", "smaller")
    text = (
        f"{step.pixel_name} {verdict}: its {measure(step)}, {shown}, is {than} than the {shown_old} of "
        f"{step.named_primitive(nearest)}, and by more than both errors together."
    )
    return text, formula_of(concludes("passes", verdict, named(NEW, new).compared(">", named(NEAREST, old))))


@explains("depth.ray-exact.doubt")
def doubted(step: StepValues) -> Said:
    """A hit that float64 cannot tell from the nearest so far."""
    errors = named(
        f"{below('e', 'new')} + {below('e', 'nearest')}", step.number("error") + step.number("nearest_error")
    )
    apart = named(f"|{NEW} - {NEAREST}|", abs(step.number("nearness") - step.number("nearest_nearness")))
    text = (
        f"{step.pixel_name}: {step.named_primitive(step.whole('nearest'))} is {apart} away in {measure(step)}, "
        f"within the errors of {errors}: float64 cannot decide."
    )
    if math.isinf(errors.value):
        text = f"{step.pixel_name}: float64 cannot locate one of the two hits, so it cannot decide."
    return text, formula_of(Chain((apart, errors), (r"\le",)))


@explains("depth.ray-exact.exact", asks=nearer, decides=True)
def exact(step: StepValues) -> Said:
    """The comparison in whole numbers."""
    sign, nearest = step.whole("sign"), step.named_primitive(step.whole("nearest"))
    verdict, word = ("passes", "nearer") if sign > 0 else ("fails", "farther")
    text = f"{verdict}: compared in whole numbers, without any error, it is {word} than {nearest}."
    if sign == 0:
        text = f"fails: in whole numbers it is exactly as near as {nearest}, and a tie keeps that."
    side = named(rf"\mathrm{{sign}}({NEW} - {NEAREST})", sign)
    return f"{step.pixel_name} {text}", formula_of(concludes("passes", verdict, side.compared(">")))


@explains("depth.ray|ray-exact.write")
def written(step: StepValues) -> Said:
    """Which triangle is the ray's nearest now."""
    if step.flag("passes") and not step.flag("writes"):
        return _not_kept(step, step.named_primitive(step.whole("nearest")))
    seen = step.triangle if step.flag("passes") else step.whole("nearest")
    verb = "is now" if step.flag("passes") else "is still"
    return f"{step.pixel_name}: {step.named_primitive(seen)} {verb} the nearest on the ray."


def _not_kept(step: StepValues, nearest: str) -> str:
    """A pale pixel of a line, which later hits are not compared with."""
    return (
        f"{step.pixel_name}: {nearest} stays the nearest on the ray, as the line covers less than half of this pixel "
        "and must not hide what is drawn there later."
    )
