"""The formulas of mipmaps; vectors are shown in the component that matters most."""

import math
from collections.abc import Callable, Mapping

from core.explain.formulas.equation import Part, equation, linear, number_latex, signed_latex
from core.explain.formulas.frame import CHANNEL_LETTERS, outstanding
from core.explain.records import Formula
from core.explain.step_values import StepValues

_NAMES = ("u_x", "v_x", "u_y", "v_y")
"""The slopes: u_x is how u changes with a pixel to the right."""
_LOGARITHM = r"\log_{{2}}"
"""In double brackets, since a single 2 below a symbol has the colour of corner 2."""


def slopes(step: StepValues) -> Formula:
    """The largest of the four slopes."""
    values = step.vector("uv_slopes")
    k = outstanding(values)
    axis = k % 2
    letter = "uv"[axis]
    if step.has("length"):
        return _line_slope(step, k)
    if not step.has("slope_n"):
        return equation(*[part for name in _NAMES for part in (r"\quad", (name, 0.0))][1:])
    rises, coefficient = (step.vector("slope_a"), "a") if k < 2 else (step.vector("slope_b"), "b")
    here = step.vector("uv")[axis]
    corners = [row[axis] for row in step.rows("corner_uv")]
    total = sum(step.vector("slope_n"))
    symbols = " + ".join(rf"{coefficient}_{i} ({letter}_{i} - {letter})" for i in range(3))
    numbers = " + ".join(
        rf"{signed_latex(rises[i])} ({number_latex(corners[i])} - {signed_latex(here)})" for i in range(3)
    )
    fraction = rf"\frac{{{symbols}}}{{n}}", rf"\frac{{{numbers}}}{{{number_latex(total)}}}"
    return equation((_NAMES[k], values[k]), "=", fraction)


def _line_slope(step: StepValues, k: int) -> Formula:
    """The slope along a line: way of the value over length, corrected where w changes."""
    letter, axis = "uv"[k % 2], k % 2
    start, end = (row[axis] for row in step.rows("end_uv"))
    symbols = rf"{letter}_{{\mathrm{{end}}}} - {letter}_{{\mathrm{{start}}}}"
    numbers = rf"{number_latex(end)} - {signed_latex(start)}"
    below, below_numbers = "L", number_latex(step.number("length"))
    if step.has("end_w"):
        t, (first, second) = step.number("t"), step.vector("end_w")
        total = (1 - t) / first + t / second
        below += r" \, w_{\mathrm{start}} w_{\mathrm{end}} / w^2"
        factors = (first, second, total, total)
        below_numbers += "".join(rf" \cdot {signed_latex(value)}" for value in factors)
    values = step.vector("uv_slopes")
    fraction = rf"\frac{{{symbols}}}{{{below}}}", rf"\frac{{{numbers}}}{{{below_numbers}}}"
    return equation((_NAMES[k], values[k]), "=", fraction)


def level_of_detail(step: StepValues) -> Formula:
    """The longer of the two lengths, and its logarithm."""
    lengths, slope, size = step.vector("lengths"), step.vector("uv_slopes"), step.vector("texture_size")
    longer = 1 if lengths[1] > lengths[0] else 0
    name = "xy"[longer]
    terms = [
        rf"({signed_latex(slope[2 * longer + axis])} \cdot {number_latex(size[axis])})^2" for axis in range(2)
    ]
    return equation(
        (rf"\rho_{name}", lengths[longer]),
        "=",
        (rf"\sqrt{{(u_{name} W)^2 + (v_{name} H)^2}}", rf"\sqrt{{{' + '.join(terms)}}}"),
        r"\quad",
        (r"\lambda", step.number("lod")),
        "=",
        (
            rf"{_LOGARITHM} \max(\rho_x, \rho_y)",
            rf"{_LOGARITHM} \max({', '.join(map(number_latex, lengths))})",
        ),
    )


def levels(step: StepValues) -> Formula:
    """Lambda within the levels there are, and the level, or the two, that it names."""
    level, lod = step.number("level"), step.number("lod")
    first = step.vector("levels")[0]
    clamped: list[Part] = [
        ("l", level),
        "=",
        (
            r"\mathrm{clamp}(\lambda)",
            rf"\mathrm{{clamp}}({number_latex(lod)})" if math.isfinite(lod) else r"\mathrm{clamp}(\lambda)",
        ),
        r"\quad",
    ]
    if not step.has("far_color"):
        rounded = (
            r"\lceil l + \frac{1}{2} \rceil - 1",
            rf"\lceil {number_latex(level)} + \frac{{1}}{{2}} \rceil - 1",
        )
        return equation(*clamped, ("k", first), "=", rounded)
    return equation(
        *clamped,
        ("k", first),
        "=",
        (r"\lfloor l \rfloor", rf"\lfloor {number_latex(level)} \rfloor"),
        r"\quad",
        ("f", step.number("level_fraction")),
        "=",
        ("l", level),
        "-",
        ("k", first),
    )


def _level_color(step: StepValues, which: str) -> Formula:
    """The four texels of a level times their shares, in the channel that is strongest."""
    color, shares = step.vector(f"{which}_color"), step.vector(f"{which}_shares")
    channel = outstanding(color[:3])
    letter = CHANNEL_LETTERS[channel]
    names = ("bl", "br", "tl", "tr")
    terms = [(rf"s_{{\mathrm{{{name}}}}}", share) for name, share in zip(names, shares, strict=True)]
    units = [
        (rf"{letter}_{{\mathrm{{{name}}}}}", texel[channel])
        for name, texel in zip(names, step.rows(f"{which}_colors"), strict=True)
    ]
    return linear(rf"{letter}_{{\mathrm{{{which}}}}}", color[channel], terms, *units)


def near(step: StepValues) -> Formula:
    """The colour in the finer level."""
    return _level_color(step, "near")


def far(step: StepValues) -> Formula:
    """The colour in the coarser level."""
    return _level_color(step, "far")


def mix(step: StepValues) -> Formula:
    """The mix of both levels, in the channel that is strongest."""
    color, share = step.vector("texture_color"), step.number("level_fraction")
    channel = outstanding(color[:3])
    letter = CHANNEL_LETTERS[channel]
    units = [
        (rf"{letter}_{{\mathrm{{{name}}}}}", step.vector(f"{name}_color")[channel])
        for name in ("near", "far")
    ]
    return linear(letter, color[channel], [("(1 - f)", 1 - share), ("f", share)], *units)


_OPERATIONS: Mapping[str, Callable[[StepValues], Formula]] = {
    "slopes": slopes,
    "lod": level_of_detail,
    "levels": levels,
    "near": near,
    "far": far,
    "mix": mix,
}

FORMULAS: Mapping[str, Callable[[StepValues], Formula]] = {
    f"shade.{kind}.{name}": make
    for kind in ("textured", "textured-lit")
    for name, make in _OPERATIONS.items()
}
