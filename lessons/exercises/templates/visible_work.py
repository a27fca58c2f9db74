"""The work for hidden surfaces: what an early depth test shades, and what rays ask pixel by pixel."""

from lessons.exercises.drafting import by_rule
from lessons.exercises.numbers import Draws, reject
from lessons.exercises.question import Draft, template
from lessons.mistakes.visible_work import shaded_early


@template("early-shaded", 1, "Shaded with early z", "depth", 3)
def draw_early_shaded(draws: Draws) -> Draft:
    """Fragments of layers over the whole picture that are shaded with the early depth test."""
    depths = tuple(draws.shuffled(range(1, 10))[:6])
    width, height = draws.item((10, 20, 30)), draws.item((8, 10, 12))
    reject(not 1 < shaded_early(depths, 1)[0] < 6)
    asked = f"""Opaque layers with these depths are drawn in this order, each over the whole picture. Smaller is nearer,
        and the depth buffer begins at infinity. How many fragments are shaded in all, if depth is tested before
        shading (early z)?
        Hint: A fragment is shaded if it passes. All fragments of a layer do alike.
        Hint: Compare with the nearest depth so far, not with the last one.
        Hint: The first layer passes, with {width} * {height} fragments. The second is shaded only if
        {depths[1]} < {depths[0]}."""
    given = f"Picture: {width} x {height} pixels\nDepths: {', '.join(map(str, depths))}"
    mistakes = ("early-only-visible", "early-against-previous", "early-shades-all")
    return by_rule(asked, given, (depths, width * height), mistakes)


@template("after-prepass", 1, "Shaded after a prepass", "depth", 2)
def draw_after_prepass(draws: Draws) -> Draft:
    """Fragments of one pixel that are shaded after a prepass, and the depth tests that this takes."""
    depths = tuple(draws.shuffled(range(1, 10))[: draws.whole(4, 7)])
    asked = f"""{len(depths)} opaque fragments with these depths arrive at one pixel. A prepass draws depth alone. Then
        all is drawn again, and shaded where the depth equals what is left. How many fragments are shaded, and
        how many depth tests are there in both passes?
        Hint: The prepass leaves the smallest depth.
        Hint: In the second pass only the fragment with that depth passes.
        Hint: Each of the {len(depths)} fragments is tested in both passes."""
    given = f"Depths: {', '.join(map(str, depths))}"
    mistakes = ("prepass-then-less", "prepass-tested-once")
    return by_rule(asked, given, (depths,), mistakes, ("shaded", "depth tests"))


@template("ray-tests", 1, "What rays ask", "depth", 2)
def draw_ray_tests(draws: Draws) -> Draft:
    """How often rays ask each triangle, and all of them."""
    width, height = draws.item((4, 8, 16, 32)), draws.item((3, 6, 12, 24))
    triangles = draws.whole(2, 9)
    asked = f"""Rays are cast pixel by pixel, without a tree of boxes. No triangle is culled. By how many rays is each
        triangle asked, and how many tests of a ray with a triangle are there in all?
        Hint: There is one ray for each pixel.
        Hint: A ray knows the nearest hit only after it has asked all triangles.
        Hint: There are {width} * {height} rays."""
    given = f"Picture: {width} x {height} pixels\nTriangles: {triangles}"
    mistakes = ("ray-loops-swapped", "ray-asks-one")
    return by_rule(asked, given, (width, height, triangles), mistakes, ("rays that ask a triangle", "tests"))
