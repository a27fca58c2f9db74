"""The formulas of interpolation, texturing and shading.

Vectors are shown in the component that matters most; their other components follow the same law.
"""

from collections.abc import Callable, Mapping, Sequence

from core.explain.formulas import corrected as formulas_corrected
from core.explain.formulas import mipmaps as formulas_mipmaps
from core.explain.formulas import packed as formulas_packed
from core.explain.formulas.equation import (
    DIGITS,
    Part,
    equation,
    linear,
    linear_digits,
    linear_parts,
    number_latex,
    signed_latex,
    vector_latex,
)
from core.explain.formulas.frame import CHANNEL_LETTERS, channel_symbol, outstanding
from core.explain.records import Formula
from core.explain.step_values import StepValues, component_names


def _row(symbols: Sequence[str], values: Sequence[float]) -> list[Part]:
    parts: list[Part] = []
    for symbol, value in zip(symbols, values, strict=True):
        parts += [r"\quad"] if parts else []
        parts.append((symbol, value))
    return parts


def numerators(step: StepValues) -> Formula:
    """The unsnapped edge functions at the pixel."""
    values = step.vector("numerators")
    if not step.has("a", "b", "c", *(["corner_w"] if step.kind == "affine" else [])):
        return equation(*_row([f"n_{k}" for k in range(3)], values))
    parts: list[Part] = []
    digits = DIGITS
    for k in range(3):
        parts += [r"\quad"] if parts else []
        coefficients = [(f"{name}_{k}", step.vector(name)[k]) for name in "abc"]
        units = ("x", step.number("x")), ("y", step.number("y"))
        if step.kind == "affine":
            w = step.vector("corner_w")[k]
            symbols = rf"(a_{k} x + b_{k} y + c_{k})"
            inner = " + ".join(
                rf"{signed_latex(value)} \cdot {number_latex(unit)}"
                for (_, value), (_, unit) in zip(coefficients, units, strict=False)
            )
            sum_text = f"({inner} + {signed_latex(coefficients[2][1])})"
            parts += [(f"n_{k}", values[k]), "=", (symbols, sum_text), r"\cdot", (f"w_{k}", w)]
        else:
            parts += linear_parts(f"n_{k}", values[k], coefficients, *units)
            digits = max(digits, linear_digits(values[k], coefficients, *units))
    return equation(*parts, digits=digits)


def total(step: StepValues) -> Formula:
    """The sum of the three."""
    values = step.vector("numerators")
    return linear("n", step.number("total"), [(f"n_{k}", values[k]) for k in range(3)])


def weights(step: StepValues) -> Formula:
    """The shares of the corners."""
    values = step.vector("weights")
    if step.kind == "flat":
        return equation(*_row([rf"\lambda_{k}" for k in range(3)], values))
    parts: list[Part] = []
    whole = number_latex(step.number("total"))
    for k, part in enumerate(step.vector("numerators")):
        parts += [r"\quad"] if parts else []
        fraction = (rf"\vertex{{{k}}}{{\frac{{n_{k}}}{{n}}}}", rf"\frac{{{number_latex(part)}}}{{{whole}}}")
        parts += [(rf"\lambda_{k}", values[k]), "=", fraction]
    return equation(*parts)


def attribute(step: StepValues) -> Formula:
    """The component of an interpolated value in which the corners differ most."""
    name = step.operation.removeprefix("value-")
    values, corners, shares = step.vector(name), step.corner_values(name), step.vector("weights")
    spread = [max(column) - min(column) for column in zip(*corners, strict=True)]
    k = outstanding(spread if any(spread) else values[:3])
    letter = component_names(name, len(values))[k][0]
    terms = [(rf"\lambda_{i}", shares[i]) for i in range(3)]
    units = [(f"{letter}_{i}", corners[i][k]) for i in range(3)]
    return linear(letter, values[k], terms, *units)


def texel_position(step: StepValues) -> Formula:
    """Texture coordinates times the size of the texture."""
    position = step.vector("texel_position")
    if not step.has("uv", "texture_size"):
        return equation(
            ("x", position[0]), "=", r"u \cdot W", r"\quad", ("y", position[1]), "=", r"v \cdot H"
        )
    uv, size = step.vector("uv"), step.vector("texture_size")
    first: list[Part] = [("x", position[0]), "=", ("u", uv[0]), r"\cdot", ("W", size[0])]
    second: list[Part] = [("y", position[1]), "=", ("v", uv[1]), r"\cdot", ("H", size[1])]
    return equation(*first, r"\quad", *second)


def texels(step: StepValues) -> Formula:
    """The texel that contains the place, or the lower left one of the four around it."""
    found, position = step.rows("texels"), step.vector("texel_position")
    half = r" - \frac{1}{2}" if len(found) > 1 else ""
    parts: list[Part] = []
    for k, (name, axis) in enumerate((("i", "x"), ("j", "y"))):
        parts += [r"\quad"] if parts else []
        symbols = rf"\mathrm{{wrap}} \lfloor {axis}{half} \rfloor"
        numbers = rf"\mathrm{{wrap}} \lfloor {number_latex(position[k])}{half} \rfloor"
        parts += [(name, found[0][k]), "=", (symbols, numbers)]
    return equation(*parts)


def filtered(step: StepValues) -> Formula:
    """The texels times their shares, in the channel that is strongest."""
    color, shares, colors = step.vector("texture_color"), step.vector("shares"), step.rows("texel_colors")
    channel = outstanding(color[:3])
    letter = CHANNEL_LETTERS[channel]
    if len(shares) == 1:
        return equation(
            (letter, color[channel]), "=", (rf"{letter}_{{\mathrm{{texel}}}}", colors[0][channel])
        )
    names = ("bl", "br", "tl", "tr")
    terms = [(rf"s_{{\mathrm{{{name}}}}}", share) for name, share in zip(names, shares, strict=True)]
    units = [
        (rf"{letter}_{{\mathrm{{{name}}}}}", texel[channel])
        for name, texel in zip(names, colors, strict=True)
    ]
    return linear(letter, color[channel], terms, *units)


def albedo(step: StepValues) -> Formula | None:
    """Texture colour times interpolated colour; without a texture it is the interpolated colour itself."""
    if not step.kind.startswith("textured"):
        return None
    values, texture = step.vector("albedo"), step.vector("texture_color")
    channel = outstanding(values[:3])
    parts: list[Part] = [
        (channel_symbol("albedo", channel), values[channel]),
        "=",
        (channel_symbol("texture", channel), texture[channel]),
    ]
    if step.has("vertex_color"):
        parts += [r"\cdot", (channel_symbol("colour", channel), step.vector("vertex_color")[channel])]
    else:
        parts += [r"\cdot", channel_symbol("colour", channel)]
    return equation(*parts)


def normal(step: StepValues) -> Formula:
    """The normal made unit length."""
    return equation(
        ("N", vector_latex(step.vector("normal"))),
        "=",
        r"\frac{n}{|n|}",
        r"\quad",
        ("V", vector_latex(step.vector("to_eye"))),
    )


def _dot(
    symbol: str, other: str, value: float, first: Sequence[float], second: Sequence[float]
) -> list[Part]:
    products = " + ".join(
        rf"{signed_latex(a)} \cdot {signed_latex(b)}" for a, b in zip(first, second, strict=True)
    )
    return [(rf"{symbol} \cdot {other}", value), "=", (rf"{symbol}^T {other}", products)]


def cosines(step: StepValues) -> Formula | None:
    """The cosines of every light."""
    parts: list[Part] = []
    for light, (n_dot_l, n_dot_h) in enumerate(
        zip(step.vector("n_dot_l"), step.vector("n_dot_h"), strict=True)
    ):
        parts += [r"\quad"] if parts else []
        if step.has("to_light", "half"):
            n = step.vector("normal")
            parts += _dot("N", "L", n_dot_l, n, step.rows("to_light")[light])
            parts.append(r"\quad")
            parts += _dot("N", "H", n_dot_h, n, step.rows("half")[light])
        else:
            parts += _row([r"N \cdot L", r"N \cdot H"], [n_dot_l, n_dot_h])
    return equation(*parts) if parts else None


def light_sums(step: StepValues) -> Formula:
    """The sum of the diffuse light, in the channel that is strongest."""
    diffuse = step.vector("diffuse_light")
    channel = outstanding(diffuse)
    parts: list[Part] = [(channel_symbol("diffuse", channel), diffuse[channel]), "="]
    n_dot_l = step.vector("n_dot_l")
    if not step.has("ambient", "diffuse", "light_colors"):
        law = r"k_{\mathrm{ambient}} + k_{\mathrm{diffuse}} \sum \max(N \cdot L, 0) \, l"
        return equation(*parts, law if n_dot_l else r"k_{\mathrm{ambient}}")
    parts.append((r"k_{\mathrm{ambient}}", step.number("ambient")))
    for light, cosine in enumerate(n_dot_l):
        colour = step.rows("light_colors")[light][channel]
        parts += ["+", (r"k_{\mathrm{diffuse}}", step.number("diffuse")), r"\cdot"]
        parts += [
            (r"\max(N \cdot L, 0)", max(cosine, 0.0)),
            r"\cdot",
            (rf"l_{{{CHANNEL_LETTERS[channel]}}}", colour),
        ]
    return equation(*parts)


def interpolated_light(step: StepValues) -> Formula:
    """Light that was computed before."""
    diffuse, specular = step.vector("diffuse_light"), step.vector("specular_light")
    channel = outstanding(diffuse)
    names = [channel_symbol(name, channel) for name in ("diffuse", "specular")]
    return equation(*_row(names, [diffuse[channel], specular[channel]]))


def product(step: StepValues) -> Formula:
    """Albedo times diffuse light plus specular light, in the channel that is strongest."""
    color = step.vector("color")
    channel = outstanding(color[:3])
    of_channel = {name: step.vector(name)[channel] for name in ("albedo", "diffuse_light", "specular_light")}
    return equation(
        (channel_symbol("colour", channel), color[channel]),
        "=",
        (channel_symbol("albedo", channel), of_channel["albedo"]),
        r"\cdot",
        (channel_symbol("diffuse", channel), of_channel["diffuse_light"]),
        "+",
        (channel_symbol("specular", channel), of_channel["specular_light"]),
    )


_MIXES = ("perspective", "affine")
_TEXTURED: Mapping[str, Callable[[StepValues], Formula | None]] = {
    "position": texel_position,
    "texels": texels,
    "filter": filtered,
}
_LIT: Mapping[str, Callable[[StepValues], Formula | None]] = {
    "albedo": albedo,
    "interpolated": interpolated_light,
    "normal": normal,
    "cosines": cosines,
    "sums": light_sums,
    "product": product,
}

FORMULAS: Mapping[str, Callable[[StepValues], Formula | None]] = {
    **{f"interpolate.{kind}.numerators": numerators for kind in _MIXES},
    **{f"interpolate.{kind}.total": total for kind in _MIXES},
    **{f"interpolate.{kind}.weights": weights for kind in (*_MIXES, "flat")},
    **{f"interpolate.{kind}.value": attribute for kind in (*_MIXES, "affine-n", "flat")},
    **formulas_corrected.FORMULAS,
    **formulas_mipmaps.FORMULAS,
    **{
        f"shade.{kind}.{name}": make
        for kind in ("textured", "textured-lit")
        for name, make in _TEXTURED.items()
    },
    **{f"shade.{kind}.{name}": make for kind in ("lit", "textured-lit") for name, make in _LIT.items()},
    "shade.textured.albedo": albedo,
    **formulas_packed.FORMULAS,
}
