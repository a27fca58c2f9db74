"""Mirrors: where the eye's ray goes on, which face of an environment map it meets, and where."""

from fractions import Fraction

from core.shading.environment import FACES
from lessons.exercises.drafting import by_rule, factor_text, one_of, place_text
from lessons.exercises.numbers import Draws, reject
from lessons.exercises.question import Draft, template
from lessons.mistakes.reflections import face_of
from lessons.mistakes.shelf import RULES

NORMAL = Fraction(3, 5), Fraction(4, 5), Fraction(0)
"""A unit normal of fractions, in some order and with some signs."""
WHOLE_LENGTHS = ((2, 3, 6), (1, 4, 8), (2, 6, 9), (3, 4, 12))
"""Directions of whole length, their largest component last."""


@template("mirrored-direction", 1, "The mirrored direction", "shade", 3)
def draw_mirrored(draws: Draws) -> Draft:
    """R = I - 2 (N . I) N, with a unit normal of fractions."""
    normal = tuple(draws.item((1, -1)) * part for part in draws.shuffled(NORMAL))
    incoming = tuple(draws.whole(-9, 9) for _ in range(3))
    along = sum(i * n for i, n in zip(incoming, normal, strict=True))
    reject(along >= 0 or along.denominator > 1 or 0 in incoming)
    products = " + ".join(
        f"{factor_text(n)} * {factor_text(i)}" for n, i in zip(normal, incoming, strict=True) if n
    )
    asked = f"""The direction I comes from the eye and meets a mirror with the unit normal N. In which direction R does
        it go on?
        Hint: R = I - 2 (N · I) N.
        Hint: N · I is negative: I runs against the normal.
        Hint: N · I = {products}."""
    given = f"I = {place_text(incoming)}\nN = {place_text(normal)}"
    names = ("reflection-sign", "reflection-once", "reflection-of-view")
    return by_rule(asked, given, (incoming, normal), names, ("R_x", "R_y", "R_z"))


@template("face-of-cube", 1, "The face that a direction meets", "shade", 2)
def draw_face(draws: Draws) -> Draft:
    """The face of the largest component without its sign."""
    sizes = draws.shuffled(range(1, 9))[:3]
    direction = tuple(draws.item((1, -1)) * size for size in sizes)
    names = ("face-by-signed-largest", "face-by-smallest")
    right = face_of(direction)
    wrong = {name: RULES[name].wrong(direction) for name in names}
    size = max(sizes)
    asked = f"""A mirror looks along R into six pictures, each of 90 degrees. Which face does R meet?
        Hint: R meets the face that it runs along most.
        Hint: Compare the components without their signs.
        Hint: {size} is the largest size. Its sign says which of two faces it is."""
    return one_of(asked, f"R = {place_text(direction)}", FACES, right, wrong)


@template("place-on-face", 1, "The place on a face", "shade", 3)
def draw_place(draws: Draws) -> Draft:
    """The other two components over the largest."""
    *others, largest = draws.item(WHOLE_LENGTHS)
    up, across = (draws.item((1, -1)) * part for part in draws.shuffled(others))
    direction = (largest, up, across)
    asked = f"""R meets the face +x of an environment map. There, z runs to the right and y runs up. Where on the face
        is it looked up? u runs from 0 at the left to 1 at the right, v from 0 below to 1 above.
        Hint: Divide the other two components by the size of the largest: that runs from -1 to 1.
        Hint: Add 1, and halve.
        Hint: u = ({across} / {largest} + 1) / 2."""
    names = ("place-not-divided", "place-from-middle", "place-by-length")
    return by_rule(asked, f"R = {place_text(direction)}", (across, up, largest), names, ("u", "v"))
