"""Shadow maps: which points are lit, and how much of the light arrives."""

from lessons.exercises.drafting import MARKS, by_rule, several
from lessons.exercises.numbers import Draws, reject
from lessons.exercises.question import Draft, template
from lessons.mistakes.shadows import lit_points, mean_of_comparisons, shadow_depths_averaged
from lessons.mistakes.shelf import RULES


@template("lit-by-map", 1, "Lit by a shadow map", "shade", 3)
def draw_lit_by_map(draws: Draws) -> Draft:
    """Which points a row of a shadow map lets be lit."""
    stored = tuple(draws.whole(3, 9) for _ in range(6))
    bias = draws.whole(1, 2)
    near = [(texel, stored[texel] + draws.whole(-bias, bias + 2)) for texel in draws.shuffled(range(6))[:4]]
    points = tuple(draws.shuffled([*near, (draws.item((-1, 6)), draws.whole(4, 12))]))
    names = ("shadow-bias-wrong-way", "shadow-outside-dark", "shadow-compared-backwards")
    right = lit_points(stored, bias, points)
    wrong = {name: RULES[name].wrong(stored, bias, points) for name in names}
    reject(not all(0 < len(each) < 5 for each in wrong.values()))
    texel, depth = next(point for point in points if 0 <= point[0] < 6)
    asked = f"""A row of a shadow map stores these depths from the light, for texels 0 to 5. Which points are lit?
        Greater is farther, and a point may lie behind the stored depth by the bias.
        Hint: A point is compared with the texel that it lies in.
        Hint: It is lit if its depth is no more than what the texel stores and the bias together. Outside of the map
        nothing is known to stand in its light.
        Hint: In texel {texel}, compare {depth} with {stored[texel]} + {bias}."""
    given = f"Stored: {', '.join(map(str, stored))}\nBias: {bias}"
    options = [f"{MARKS[place]}: texel {texel}, depth {depth}" for place, (texel, depth) in enumerate(points)]
    return several(asked, given, options, right, wrong)


@template("share-of-light", 1, "Share of the light", "shade", 2)
def draw_share_of_light(draws: Draws) -> Draft:
    """How much of the light arrives by the mean of four comparisons."""
    depth = draws.whole(4, 7)
    stored = tuple(draws.whole(1, 12) for _ in range(4))
    share = mean_of_comparisons(stored, depth)[0]
    reject(
        depth in stored
        or share in (0, 1)
        or share * 2 == 1
        or shadow_depths_averaged(stored, depth)[0] == 1 - share
    )
    first = "at least" if stored[0] >= depth else "less than"
    asked = f"""A point at the depth {depth} from the light lies among four texels of a shadow map. The bias is 0. What
        share of the light arrives, if the mean of four comparisons is taken (percentage-closer filtering)?
        Hint: Compare each texel by itself.
        Hint: A texel lets the light pass if it stores no less than {depth}.
        Hint: Count these texels, over four: {stored[0]} is {first} {depth}."""
    given = f"Stored: {', '.join(map(str, stored))}"
    return by_rule(
        asked, given, (stored, depth), ("shadow-depths-averaged", "shadow-share-hidden"), ("share",)
    )
