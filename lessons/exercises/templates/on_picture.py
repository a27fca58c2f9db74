"""One question on the picture for each stage: which pixels."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from fractions import Fraction
from math import floor

import numpy as np

from core import Settings, Texture, render
from core.records.arrays import Flags
from core.records.frame import Frame
from core.scene import ClipScene
from lessons.exercises.answers.marked import PixelAnswer, Pixels
from lessons.exercises.coding.triangles import edge_of
from lessons.exercises.drafting import drafted, factor_text, listed, pictured, seen_pixels, window_text
from lessons.exercises.numbers import Draws, number_text, reject
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.coverage import RULE, Corner, corner_text, facing_text, row_hint, twice_area
from lessons.mistakes.shelf import SHELF
from lessons.mistakes.twin import in_window
from lessons.small_scenes import rectangle_corners, triangle_scene

SIZE = (12, 9)
HALF = Fraction(1, 2)
LEAST = 24
"""Twice the area of a triangle that is not small."""
WINDOW = window_text(SIZE)


def marked(is_marked: Flags) -> Pixels:
    """Return the pixels that are set in an array of rows and columns."""
    return frozenset((column, row) for row, column in np.argwhere(is_marked).tolist())


def ask_pixels(
    asked: str,
    given: Iterable[str],
    right: Pixels,
    wrong: Mapping[str, Pixels],
    scene: ClipScene,
    settings: Settings,
) -> Draft:
    """Ask for pixels."""
    answer = PixelAnswer(SIZE, right)
    return drafted(asked, "\n".join([WINDOW, *given]), answer, wrong, scene, settings)


def halves(draws: Draws) -> list[Corner]:
    """Draw a counter-clockwise triangle with corners on half pixels."""
    corners = [(draws.step(HALF, Fraction(11), HALF), draws.step(HALF, Fraction(8), HALF)) for _ in range(3)]
    return corners if twice_area(corners) > 0 else corners[::-1]


@template("vertex-pixels", 2, "Pixels of the vertices", "transform", 2)
def draw_vertices(draws: Draws) -> Draft:
    """Pixels of three vertices given in NDC."""
    ndc = [(Fraction(draws.whole(-11, 11), 12), Fraction(draws.whole(-8, 8), 9)) for _ in range(3)]
    places = [((x + 1) * SIZE[0] / 2, (y + 1) * SIZE[1] / 2) for x, y in ndc]
    reject(any(c.denominator == 1 for place in places for c in place) or abs(twice_area(places)) < 8)
    scene = triangle_scene([places], SIZE)

    def pixels(of: ClipScene) -> Pixels:
        return frozenset((floor(x), floor(y)) for x, y in in_window(of)[0].tolist())

    wrong = {name: pixels(SHELF[name].change_scene(scene)) for name in ("y-down", "window-one-less")}
    exchanged = frozenset((j, i) for i, j in pixels(scene))
    if max(row for _, row in exchanged) < SIZE[1] and exchanged != pixels(scene):
        wrong["rows-and-columns"] = exchanged
    asked = f"""In which pixels do these vertices lie? Pixel (i, j) reaches from i to i + 1 and from j to j +
        1.
        Hint: NDC run from -1 to 1 over the window.
        Hint: (x + 1) W/2 and (y + 1) H/2, then cut off the fraction.
        Hint: The column of vertex 0: floor(({factor_text(ndc[0][0])} + 1) * {SIZE[0]}/2)."""
    given = [listed("Vertex {k} in NDC: {}", ndc)]
    return ask_pixels(asked, given, pixels(scene), wrong, scene, Settings())


@template("front-pixels", 2, "Pixels of front faces", "cull", 3)
def draw_culled(draws: Draws) -> Draft:
    """What is left of two triangles when back faces are culled."""
    triangles = [
        [(6 * k + draws.whole(0, 10) * HALF, draws.whole(0, 16) * HALF) for _ in range(3)] for k in range(2)
    ]
    areas = [twice_area(corners) for corners in triangles]
    reject(areas[0] * areas[1] >= 0 or min(map(abs, areas)) < 9)
    scene, settings = triangle_scene(triangles, SIZE), Settings(cull="back")
    names = ("facing-exchanged", "corner-for-center")
    asked = f"""Back faces are culled: counter-clockwise is the front. Which pixels are drawn? {RULE}
        Hint: Go round each triangle in its order.
        Hint: Only one of the two is drawn.
        Hint: For triangle 0: {facing_text(triangles[0])}; is it positive?"""
    given = listed("Triangle {k}: {}", triangles)
    return pictured(asked, given, scene, names, settings)


@template("pixels-beyond-near", 3, "Pixels beyond the near plane", "clip", 3)
def draw_clipped(draws: Draws) -> Draft:
    """What the near plane leaves of a triangle."""
    corners, border = halves(draws), draws.whole(3, 8)
    reject(twice_area(corners) < LEAST)
    # Depth is linear over the window: 0 at the border, and 1 at twelve pixels to the right of it.
    depth = [[(float(x) - border) / 12 for x, _ in corners]]
    scene = triangle_scene([corners], SIZE, depth=depth)
    settings = Settings(clipping="sutherland-hodgman")

    def seen(of: Settings) -> tuple[Pixels, dict[str, Pixels]]:
        names = ("corner-for-center", "all-edges-inclusive")
        wrong = {name: seen_pixels(SHELF[name].draw(scene, of)) for name in names}
        return seen_pixels(render(scene, of)), wrong

    right, wrong = seen(settings)
    # New corners are snapped, which may turn an edge away from centres that lie on it: without them none is.
    is_snapped = (right, wrong) != seen(Settings())
    reject(is_snapped or right == seen_pixels(render(replace(scene, clip=scene.clip * [1, 1, 0, 1]))))
    given = [f"Triangle: {corner_text(corners)}", f"Window depth at (x, y): (x - {border}) / {SIZE[0]}"]
    asked = f"""Window depth is 0 at the near plane. What lies in front of it is clipped. Which pixels are
        drawn? {RULE}
        Hint: Where is the depth 0?
        Hint: The near plane cuts the triangle along a vertical line.
        Hint: (x - {border}) / {SIZE[0]} = 0: which side of this x has centres with a positive depth?"""
    return ask_pixels(asked, given, right, wrong, scene, settings)


@template("inner-side", 2, "The inner side of an edge", "edges", 3)
def draw_side(draws: Draws) -> Draft:
    """The inner side of one edge."""
    corners = halves(draws)
    reject(twice_area(corners) < LEAST)
    a, b, c = edge_of(corners[0], corners[1])

    def inner(shift: Fraction, owns: bool) -> Pixels:
        values = {
            (i, j): a * (i + shift) + b * (j + shift) + c for i in range(SIZE[0]) for j in range(SIZE[1])
        }
        return frozenset(pixel for pixel, value in values.items() if value > 0 or (owns and value == 0))

    owns = a > 0 or (a == 0 and b > 0)
    wrong = {"corner-for-center": inner(Fraction(0), owns)}
    other = "all-edges-exclusive" if owns else "all-edges-inclusive"
    wrong[other] = inner(HALF, not owns)
    (x0, y0), (x1, y1) = (map(factor_text, corner) for corner in corners[:2])
    asked = f"""Which pixels are inside of the edge from vertex 0 to vertex 1? Inside is where E > 0 at the
        centre (i + 1/2, j + 1/2), on the left of the edge; where E = 0, a step to the right, then up,
        decides.
        Hint: Draw the line of the edge across the whole window.
        Hint: E = (y0 - y1)(x - x0) + (x1 - x0)(y - y0).
        Hint: E = ({y0} - {y1})(x - {x0}) + ({x1} - {x0})(y - {y0}); where it is 0, move the centre a little
        to the right."""
    scene = triangle_scene([corners], SIZE)
    given = [f"Vertices 0, 1, 2: {corner_text(corners)}"]
    return ask_pixels(asked, given, inner(HALF, owns), wrong, scene, Settings())


@template("box-pixels", 3, "Pixels in the bounding box", "bin", 3)
def draw_box(draws: Draws) -> Draft:
    """Pixels of a bounding box."""
    corners = [(Fraction(draws.whole(2, 118), 10), Fraction(draws.whole(2, 88), 10)) for _ in range(3)]
    reject(abs(twice_area(corners)) < 20 or any(c % 1 == HALF for place in corners for c in place))
    low, high = (
        np.array([float(pick(c[axis] for c in corners)) for axis in range(2)]) for pick in (min, max)
    )

    def box(first: np.ndarray, end: np.ndarray) -> Pixels:
        return frozenset(
            (i, j) for i in range(int(first[0]), int(end[0])) for j in range(int(first[1]), int(end[1]))
        )

    right = box(np.ceil(low - 0.5), np.floor(high - 0.5) + 1)
    wrong = {"box-truncated": box(np.floor(low), np.floor(high))}
    least, greatest = (number_text(pick(x for x, _ in corners)) for pick in (min, max))
    asked = f"""Which pixels does a fill by bounding box test? A pixel belongs to the box of the triangle
        where its centre (i + 1/2, j + 1/2) does.
        Hint: The box reaches from the least to the greatest x and y.
        Hint: Look at centres, not at whole pixels.
        Hint: Columns: {least} <= i + 1/2 <= {greatest}; rows likewise."""
    scene, settings = triangle_scene([corners], SIZE), Settings(fill="bounding-box")
    return ask_pixels(asked, [f"Triangle: {corner_text(corners)}"], right, wrong, scene, settings)


@template("below-half", 3, "Where u is below 1/2", "interpolate", 4)
def draw_below_half(draws: Draws) -> Draft:
    """Where an attribute is below 1/2, with perspective."""
    left, right = draws.whole(0, 3) + HALF, draws.whole(8, 11) + HALF
    low, high = draws.whole(0, 2) + HALF, draws.whole(6, 8) + HALF
    w_of = {left: draws.whole(1, 3), right: draws.whole(2, 6)}
    # Else u is 1/2 in the middle of a column.
    reject((w_of[left] * (right - left) / (w_of[left] + w_of[right])).denominator == 1)
    corners = rectangle_corners(float(left), float(low), float(right), float(high))
    w = [[w_of[Fraction(x)] for x, _ in triangle] for triangle in corners]
    u = [[[float(x > left)] for x, _ in triangle] for triangle in corners]
    scene = triangle_scene(corners, SIZE, w=w, attributes=u)

    def below(frame: Frame) -> Pixels:
        return marked((frame.primitive >= 0) & (frame.attributes[..., 0] < 0.5))

    names = ("affine-for-perspective", "not-divided-back", "multiplied-by-w")
    first, last = number_text(left), number_text(right)
    given = [
        f"Left side: x = {first}, w = {w_of[left]}. Right side: x = {last}, w = {w_of[right]}.",
        f"It reaches from y = {number_text(low)} to y = {number_text(high)}.",
    ]
    asked = f"""A rectangle carries u from 0 at its left side to 1 at its right side, in perspective. At which
        of its pixels is u below 1/2? {RULE}
        Hint: Which side is nearer?
        Hint: u/w and 1/w are linear in the window.
        Hint: x = {first} + s ({last} - {first}), where (s/{w_of[right]}) / ((1 - s)/{w_of[left]} +
        s/{w_of[right]}) = 1/2: find s."""
    return pictured(asked, "\n".join(given), scene, names, read=below)


@template("texel-pixels", 2, "Pixels of dark texels", "shade", 3)
def draw_texels(draws: Draws) -> Draft:
    """Pixels that show a dark texel."""
    texels = np.array([[draws.whole(0, 1) for _ in range(3)] for _ in range(3)], float)
    across = draws.whole(1, 2)
    reject(not 2 <= texels.sum() <= 7)
    corners = rectangle_corners(0, 0, *map(float, SIZE))
    uv = np.array(corners) / SIZE * [across, 1]
    scene = triangle_scene(corners, SIZE, attributes=uv)
    scene = replace(scene, texture=Texture(np.repeat(texels[..., None], 3, axis=2).astype(np.float32)))
    settings = Settings(texture_filter="nearest")

    def dark(frame: Frame) -> Pixels:
        return marked(frame.color[..., 0] < 0.5)

    names = ("texture-upside-down", "window-for-uv") if across > 1 else ("texture-upside-down",)
    rows = [
        f"Row {j} of texels: {', '.join(('dark', 'light')[int(c)] for c in texels[j])}" for j in (2, 1, 0)
    ]
    given = [f"u runs from 0 to {across} across the window, v from 0 to 1 upwards.", *rows]
    asked = f"""A rectangle over the whole window shows this texture by the nearest texel; beyond u = 1 it
        starts again. Which pixels show a dark texel? (u, v) = (0, 0) is the lower left corner of texture and
        window.
        Hint: How many pixels wide and high is a texel in the window?
        Hint: The lowest row of texels is in the lowest rows.
        Hint: {SIZE[0]} pixels show {across} textures side by side, {SIZE[1]} pixels one: divide by the texels
        of a row."""
    return pictured(asked, "\n".join(given), scene, names, settings, dark)


@template("nearer-pixels", 2, "Pixels of the nearer triangle", "depth", 4)
def draw_nearer(draws: Draws) -> Draft:
    """Pixels of a triangle that runs through another one."""
    triangles = [halves(draws), halves(draws)]
    border = draws.whole(3, 9)
    reject(min(map(twice_area, triangles)) < LEAST)
    depth = [[0.5] * 3, [0.5 + (float(x) - border) / 40 for x, _ in triangles[1]]]
    scene = triangle_scene(triangles, SIZE, depth=depth)
    names = ("farther-wins", "no-depth-test", "corner-for-center")
    wrong = {name: seen_pixels(SHELF[name].draw(scene, Settings()), 1) for name in names}
    right = seen_pixels(render(scene), 1)
    given = [
        f"Triangle 0: {corner_text(triangles[0])}, depth 1/2",
        f"Triangle 1: {corner_text(triangles[1])}, depth 1/2 + (x - {border}) / 40 at (x, y)",
    ]
    asked = f"""Triangle 0 is drawn first, then triangle 1. Which pixels show triangle 1? Smaller depths are
        nearer. {RULE}
        Hint: Where do both cover the same pixels?
        Hint: On which side of a vertical line is triangle 1 nearer?
        Hint: (x - {border}) / 40 is negative there: then compare the centres of both triangles, row by
        row."""
    return ask_pixels(asked, given, right, wrong, scene, Settings())


@template("blended-twice", 2, "Pixels that are blended twice", "blend", 3)
def draw_overlap(draws: Draws) -> Draft:
    """Pixels that are blended twice."""
    first, second = halves(draws), halves(draws)
    reject(min(twice_area(first), twice_area(second)) < LEAST)
    glass = [[(1.0, 1.0, 1.0, 0.5)] * 3] * 2
    scene = triangle_scene([first, second], SIZE, attributes=glass)
    settings = Settings(blend="over", visibility="last-drawn")

    def twice(frame: Frame) -> Pixels:
        return marked(frame.cover_count == 2)

    names = ("all-edges-inclusive", "corner-for-center")
    given = listed("Pane {k}: {}", [first, second])
    asked = f"""Two panes of glass are blended with over, whatever their depth. Which pixels show both? {RULE}
        Hint: Find the pixels of each pane.
        Hint: Which belong to both?
        Hint: {row_hint(first)} (pane 0). Which columns do both panes cover in a row?"""
    return pictured(asked, given, scene, names, settings, twice)


@template("grey-pixels", 1, "Pixels between black and white", "resolve", 4)
def draw_mixed(draws: Draws) -> Draft:
    """Pixels of which only some samples are covered."""
    corners = [(Fraction(draws.whole(0, 48), 4), Fraction(draws.whole(0, 36), 4)) for _ in range(3)]
    reject(twice_area(corners) < 30)
    white = [[(1.0, 1.0, 1.0, 1.0)] * 3]
    scene = triangle_scene([corners], SIZE, attributes=white)
    scene = replace(scene, background=np.array([0.0, 0.0, 0.0, 1.0]))
    settings = Settings(antialiasing="ssaa-4")

    def grey(frame: Frame) -> Pixels:
        return marked((frame.color[..., 0] > 0.01) & (frame.color[..., 0] < 0.99))

    asked = f"""A white triangle is drawn over black with 2 x 2 samples a pixel, at 1/4 and 3/4 of its width
        and height. Which pixels are neither black nor white? A sample on an edge belongs to left edges and to
        level bottom edges.
        Hint: Follow the edges.
        Hint: A pixel is grey if an edge runs between its samples.
        Hint: {row_hint(corners, "j + 1/4")}: which samples i + 1/4 and i + 3/4 lie inside, and which at y = j
        + 3/4?"""
    return pictured(asked, f"Triangle: {corner_text(corners)}", scene, (), settings, grey)
