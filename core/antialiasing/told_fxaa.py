"""FXAA, told step by step: contrast of luma, direction of the edge, its ends, and how far a colour is moved."""

from core.explain.formulas import (
    CHANNEL_LETTERS,
    HALF,
    Named,
    call,
    concludes,
    formula_of,
    in_channel,
    named,
    total,
)
from core.explain.number_text import remainder_note, spoken, vector_text
from core.explain.records import Asked, choice
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, shows
from core.records.terms import Term, term
from core.records.words import counted

COMPASS = ("sw", "s", "se", "w", "m", "e", "nw", "n", "ne")
"""Names of the 3 x 3 pixels, from the lower left; m is the pixel itself."""
WHERE = {(True, 1): "above", (True, -1): "below", (False, 1): "to the right", (False, -1): "to the left"}
"""Where the other side of an edge is: whether the edge is horizontal, and its side."""


def _lumas(step: StepValues) -> dict[str, Named]:
    """Return the lumas of the 3 x 3 pixels."""
    return {
        name: named(f"L_{{{name}}}", value)
        for name, value in zip(COMPASS, step.vector("around"), strict=True)
    }


def _bend(lumas: dict[str, Named], *lines: str) -> Term:
    """Return the sum of second differences over three lines of pixels, the middle one twice."""
    sizes = [call("abs", lumas[a] - 2 * lumas[b] + lumas[c]) for a, b, c in (line.split() for line in lines)]
    return sizes[0] + 2 * sizes[1] + sizes[2]


def _where(step: StepValues) -> str:
    return WHERE[step.flag("is_horizontal"), step.whole("side")]


def is_edge(step: StepValues) -> Asked:
    """Ask whether an edge passes."""
    contrast, least = spoken(step.number("contrast")), spoken(step.number("threshold"))
    is_there = step.kind == "smoothed"
    return choice(
        f"At {step.the_pixel} and its four neighbours luma ranges over {contrast}. "
        f"An edge has at least {least}. Is one here?",
        0 if is_there else 1,
        f"the range {contrast} is {'at least' if is_there else 'less than'} {least}.",
    )


@explains("resolve.kept|smoothed.contrast", asks=is_edge, decides=True)
def contrast(step: StepValues) -> Said:
    """The range of luma among the pixel and its four neighbours, and what an edge must have."""
    lumas, found = _lumas(step), step.named("contrast", "C")
    five = [lumas[name] for name in "nswem"]
    least = step.named("threshold", r"C_{\mathrm{least}}")
    text = f"the largest and the smallest luma of it and its four neighbours differ by {found}: "
    if step.kind == "kept":
        text += f"less than {least}, so there is no edge, and its colour stays."
    else:
        text += f"at least {least}, so an edge passes here."
    asked = concludes("edge", "edge" if step.kind == "smoothed" else "no edge", found.compared(r"\ge", least))
    return f"{step.pixel_name}: {text}", formula_of(
        found.equals(call("max", *five) - call("min", *five)), asked
    )


@explains("resolve.smoothed.rows")
def bend_across_rows(step: StepValues) -> Said:
    """How much luma bends from row to row."""
    found = step.named("along_row", r"B_{\mathrm{row}}")
    text = f"from row to row luma bends by {found}: much across an edge that runs along the row."
    return f"{step.pixel_name}: {text}", formula_of(
        found.equals(_bend(_lumas(step), "sw w nw", "s m n", "se e ne"))
    )


@explains("resolve.smoothed.columns")
def bend_across_columns(step: StepValues) -> Said:
    """How much luma bends from column to column."""
    found = step.named("along_column", r"B_{\mathrm{col}}")
    text = f"from column to column luma bends by {found}: much across an edge that runs along the column."
    return f"{step.pixel_name}: {text}", formula_of(
        found.equals(_bend(_lumas(step), "sw s se", "w m e", "nw n ne"))
    )


@explains("resolve.smoothed.direction", decides=True)
def direction(step: StepValues) -> Said:
    """Across the edge luma bends more."""
    row = step.named("along_row", r"B_{\mathrm{row}}")
    column = step.named("along_column", r"B_{\mathrm{col}}")
    way = "rows" if step.flag("is_horizontal") else "columns"
    along = "row" if step.flag("is_horizontal") else "column"
    text = f"luma bends more across {way}, so the edge runs along the {along}."
    if row.value == column.value:
        text = "luma bends as much across rows as across columns; the edge is taken to run along the row."
    found = "along the row" if step.flag("is_horizontal") else "along the column"
    return f"{step.pixel_name}: {text}", formula_of(
        concludes("along the row", found, row.compared(r"\ge", column))
    )


@explains("resolve.smoothed.side", decides=True)
def side(step: StepValues) -> Said:
    """On which side luma differs more."""
    lumas = _lumas(step)
    before, after = ("s", "n") if step.flag("is_horizontal") else ("w", "e")
    sizes = [abs(lumas[name].value - lumas["m"].value) for name in (before, after)]
    one, two = (named(f"d_{{{name}}}", size) for name, size in zip((before, after), sizes, strict=True))
    names = ("below", "above") if step.flag("is_horizontal") else ("on the left", "on the right")
    text = (
        f"the pixel {names[0]} differs in luma by {one}, the one {names[1]} by {two}: the other side of the edge "
        f"lies {_where(step)}."
    )
    return f"{step.pixel_name}: {text}", formula_of(
        *(d.equals(call("abs", lumas[name] - lumas["m"])) for d, name in ((one, before), (two, after))),
        one.compared(r"\ge", two),
    )


@explains("resolve.smoothed.pair")
def pair(step: StepValues) -> Said:
    """The mean luma of both sides, and the step between them."""
    lumas = _lumas(step)
    name = {"above": "n", "below": "s", "to the right": "e", "to the left": "w"}[_where(step)]
    p, d = step.named("pair", "p"), step.named("step", "d")
    text = f"across the edge lumas step by {d}, and {p} is the mean of both sides."
    return f"{step.pixel_name}: {text}", formula_of(
        p.equals((lumas["m"] + lumas[name]) / 2), d.equals(call("abs", lumas[name] - lumas["m"]))
    )


@explains("resolve.smoothed.back|forth")
def walk(step: StepValues) -> Said:
    """After how many pixels the mean of both sides has left that at the pixel."""
    way = step.operation
    count, means = step.whole(f"steps_{way}"), step.vector(way)
    p, d, mean = step.named("pair", "p"), step.named("step", "d"), named(f"v_{{{count}}}", means[count - 1])
    has_ended = abs(mean.value - p.value) >= d.value / 4
    words = {True: {"back": "to the left", "forth": "to the right"}, False: {"back": "down", "forth": "up"}}
    where = words[step.flag("is_horizontal")][way]
    text = f"{counted(count, 'pixel')} {where} the mean of both sides is {mean}: "
    text += "the edge ends there." if has_ended else "the edge goes on, and is not followed any farther."
    gap = named(f"g_{{{count}}}", abs(mean.value - p.value))
    return f"{step.pixel_name}: {text}", formula_of(
        gap.equals(call("abs", mean - p)), gap.compared(r"\ge", named("d / 4", d.value / 4))
    )


@explains("resolve.smoothed.edge")
def edge(step: StepValues) -> Said:
    """How far the nearer end moves the colour."""
    k = step.named("steps_back", "k")
    j = step.named("steps_forth", "j")
    offset = step.named("edge_offset", "e")
    near = min(k.value, j.value)
    if offset.value == 0 and k.value == j.value:
        text = f"both ends are {counted(int(near), 'pixel')} away: in the middle of a stair nothing moves."
    elif offset.value == 0:
        text = "at the nearer end both sides turn to its own colour, so it stays: the stair is on the other side."
        return f"{step.pixel_name}: {text}", formula_of(offset.equals(0))
    else:
        whole = spoken(k.value + j.value)
        text = f"the nearer end is {spoken(near)} of {whole} pixels away, and moves it by {offset} pixel."
    return f"{step.pixel_name}: {text}", formula_of(offset.equals(HALF - call("min", k, j) / (k + j)))


@explains("resolve.smoothed.detail")
def detail(step: StepValues) -> Said:
    """How far the 3 x 3 pixels around move the colour."""
    lumas, found, offset = _lumas(step), step.named("contrast", "C"), step.named("detail_offset", "q")
    sides, corners = (
        total([lumas[name] for name in names]) for names in (("s", "w", "e", "n"), ("sw", "se", "nw", "ne"))
    )
    values = step.vector("around")
    mean = named("a", (2 * sum(values[k] for k in (1, 3, 5, 7)) + sum(values[k] for k in (0, 2, 6, 8))) / 12)
    share = named("s", min(abs(mean.value - lumas["m"].value) / found.value, 1.0))
    text = (
        f"the pixels around have a mean luma of {mean}, from which it differs by {share} of the range; "
        f"detail of one pixel moves it by {offset} pixel."
    )
    return f"{step.pixel_name}: {text}", formula_of(
        mean.equals((2 * sides + corners) / 12),
        share.equals(call("min", call("abs", mean - lumas["m"]) / found, 1)),
        offset.equals(term(3) / 4 * (3 * share**2 - 2 * share**3) ** 2),
    )


@explains("resolve.smoothed.offset")
def offset(step: StepValues) -> Said:
    """The larger of both."""
    found = step.named("offset", "o")
    text = f"its colour moves by {found} pixel towards the one {_where(step)}."
    if found.value == 0:
        text = "neither moves it: its colour stays."
    both = step.named("edge_offset", "e"), step.named("detail_offset", "q")
    return f"{step.pixel_name}: {text}", formula_of(found.equals(call("max", *both)))


@explains("resolve.smoothed.blend")
def blend(step: StepValues) -> Said:
    """A mixture of the colours on both sides of the edge."""
    own, other, mixed = step.vector("encoded"), step.vector("other"), step.vector("mixed")
    channel = max(range(3), key=lambda k: abs(other[k] - own[k]))
    letter, o = CHANNEL_LETTERS[channel], step.named("offset", "o")
    text = f"with {o} of the colour across the edge it shows {vector_text(mixed[:3])}{remainder_note(mixed[:3])}."
    s, t, m = (
        named(f"{name}_{letter}", color[channel]) for name, color in (("s", own), ("t", other), ("m", mixed))
    )
    return f"{step.pixel_name}: {text}", formula_of(m.equals((1 - o) * s + o * t))


@explains("resolve.smoothed.round")
def rounded(step: StepValues) -> Said:
    """Display bytes."""
    *color, alpha = stored = step.vector("bytes")
    mixed = step.vector("mixed")
    channel = max(range(3), key=lambda k: mixed[k])
    text = f"{step.pixel_name} is displayed as the bytes {vector_text(color)}, with alpha {spoken(alpha)}."
    m = named(f"m_{CHANNEL_LETTERS[channel]}", mixed[channel])
    return text, formula_of(in_channel("byte", stored, channel).equals(call("floor", 255 * m + HALF)))


shows(
    "resolve",
    {
        "contrast": VariableText("C", "Range of luma among the pixel and its four neighbours."),
        "along_row": VariableText("B row", "How much luma bends across rows."),
        "along_column": VariableText("B col", "How much luma bends across columns."),
        "is_horizontal": VariableText("horizontal", "Whether the edge runs along the row."),
        "side": VariableText(
            "side", "Where the other side is: 1 above or to the right, −1 below or to the left."
        ),
        "pair": VariableText("p", "Mean luma of both sides of the edge at the pixel."),
        "step": VariableText("d", "Step of luma across the edge."),
        "steps_back": VariableText("k", "Pixels walked to the left, or down."),
        "steps_forth": VariableText("j", "Pixels walked to the right, or up."),
        "edge_offset": VariableText("e", "How far the nearer end moves the colour, in pixels."),
        "detail_offset": VariableText("q", "How far the 3×3 pixels around move it, in pixels."),
        "offset": VariableText("o", "How far the colour moves towards the other side, in pixels."),
        "other": VariableText(
            "t (across)", "sRGB red, green, blue, and alpha across the edge.", after="mixed"
        ),
        "mixed": VariableText("m (mixed)", "sRGB red, green, blue, and alpha of the mixture."),
    },
)
