"""Mirrors, told: the direction that leaves the mirror, where it looks or what its ray meets, and what is added."""

from core.culling.told import by_axes
from core.explain.formulas import formula_of, in_channel, named, outstanding
from core.explain.number_text import spoken, vector_text
from core.explain.records import Asked, choice
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, shows
from core.shading.environment import ABOVE, ACROSS, FACES
from core.shading.told import LIT, sum_of_light


@explains("shade.*.own-color")
def own_color(step: StepValues) -> Said:
    """The colour without what is mirrored."""
    color = vector_text(step.vector("own_color"))
    text = f"{step.pixel_name}: its own colour is {color}, {LIT}, before what it mirrors is added."
    return text, sum_of_light(step, "own_color")


def _incoming(step: StepValues) -> list[float]:
    return [0.0 - part for part in step.vector("to_eye")]


@explains("shade.*.cosine")
def cosine(step: StepValues) -> Said:
    """How much of the direction from the eye runs along the normal."""
    n, incoming, found = step.vector("normal"), _incoming(step), step.number("n_dot_i")
    side = "against the normal" if found < 0 else "along the normal" if found > 0 else "across the normal"
    text = f"{step.pixel_name}: the direction from the eye I = −V has N·I = {spoken(found)} and runs {side}."
    return text, formula_of(named(r"N \cdot I", found).equals(by_axes("N", n, "I", incoming)))


@explains("shade.*.reflect")
def reflected(step: StepValues) -> Said:
    """The direction that leaves the mirror; the formula has its largest component."""
    r, n, incoming = step.vector("reflected"), step.vector("normal"), _incoming(step)
    text = f"{step.pixel_name}: the mirrored direction R is {vector_text(r)}."
    k = outstanding(r)
    part = named(f"R_{'xyz'[k]}", r[k])
    along = named(r"(N \cdot I)", step.number("n_dot_i"))
    return text, formula_of(
        part.equals(named(f"I_{'xyz'[k]}", incoming[k]) - 2 * along * named(f"N_{'xyz'[k]}", n[k]))
    )


def which_face(step: StepValues) -> Asked | None:
    """Ask which of the six pictures is looked into."""
    r, face = step.vector("reflected"), step.whole("face")
    largest = max(abs(part) for part in r)
    if sum(abs(part) == largest for part in r) > 1 or not largest > 0:
        return None
    return choice(
        f"{step.pixel_name} mirrors along R = {vector_text(r)}. Which face of the map is looked into?",
        face,
        f"Without signs, {spoken(r[face // 2])} along {FACES[face][1]} is the largest component: face {FACES[face]}.",
        FACES,
    )


@explains("shade.*.face", asks=which_face, decides=True)
def face(step: StepValues) -> Said:
    """The face of the largest component."""
    r, found = step.vector("reflected"), step.whole("face")
    axis = "xyz"[found // 2]
    return (
        f"{step.pixel_name}: of R = {vector_text(r)}, {axis} is largest without its sign, and it is "
        f"{'negative' if found % 2 else 'positive'}: the face {FACES[found]}."
    )


@explains("shade.*.place")
def place(step: StepValues) -> Said:
    """Where the direction meets the face."""
    r, found, (u, v) = step.vector("reflected"), step.whole("face"), step.vector("face_place")
    size, ways = abs(r[found // 2]), (ACROSS[found], ABOVE[found])
    text = (
        f"{step.pixel_name}: the other two components over the largest give the place on the face, u = {spoken(u)} "
        f"and v = {spoken(v)}."
    )
    stated = [
        named(name, value).equals(
            (
                named(f"{'-' if sign < 0 else ''}R_{'xyz'[axis]}", sign * r[axis])
                / named(f"|R_{'xyz'[found // 2]}|", size)
                + 1
            )
            / 2
        )
        for name, value, (axis, sign) in zip("uv", (u, v), ways, strict=True)
    ]
    return text, formula_of(*stated)


@explains("shade.*.look-up")
def look_up(step: StepValues) -> Said:
    """What is seen along the mirrored direction."""
    seen = vector_text(step.vector("seen"))
    if step.has("face_texels"):
        column, row = step.rows("face_texels")[0]
        return (
            f"{step.pixel_name}: the four texels from ({column:.0f}, {row:.0f}) on of face {FACES[step.whole('face')]} "
            f"mix to {seen}: what the middle of the mirror sees along R."
        )
    if step.whole("met") < 0:
        return f"{step.pixel_name}: along R it sees the background, {seen}."
    return f"{step.pixel_name}: along R it sees triangle {step.whole('met')} in the colour {seen}."


@explains("shade.*.ray", decides=True)
def ray(step: StepValues) -> Said:
    """What the ray along the mirrored direction meets."""
    met = step.whole("met")
    if met < 0:
        return f"{step.pixel_name}: its ray along R meets no triangle."
    far = spoken(step.number("met_distance"))
    return f"{step.pixel_name}: its ray along R meets triangle {met} first, at the distance {far}."


@explains("shade.*.mirror")
def mirror(step: StepValues) -> Said:
    """The colour with what is mirrored."""
    color, own, seen = step.vector("color"), step.vector("own_color"), step.vector("seen")
    share = step.number("mirror_share")
    text = f"{step.pixel_name}: with {spoken(share)} of what it mirrors, its colour is {vector_text(color)}."
    channel = outstanding(color[:3])
    parts = in_channel("own", own, channel) + named("m", share) * in_channel("seen", seen, channel)
    return text, formula_of(in_channel("colour", color, channel).equals(parts))


shows(
    "shade",
    {
        "own_color": VariableText("own colour", "Colour before what is mirrored is added."),
        "n_dot_i": VariableText("N·I", "Cosine between the normal and the direction from the eye."),
        "reflected": VariableText("R", "Mirrored direction, in world space."),
        "face": VariableText("face", "Face of the map: 0 to 5 for +x, −x, +y, −y, +z, −z."),
        "face_place": VariableText("u, v on the face", "Place there, 0 to 1 across and up."),
        "face_shares": VariableText("share, texel #", "Share of a texel in what is seen.", spread="parts"),
        "met": VariableText("met", "The triangle that the ray meets first; -1: none."),
        "met_distance": VariableText("t", "How far away it is."),
        "seen": VariableText("seen", "What is seen along R: red, green, blue."),
        "mirror_share": VariableText("m", "Mirror share of the material."),
    },
)
