"""Weights, colours, depth and distance between the vertices of a triangle or the ends of an edge."""

from fractions import Fraction
from typing import Any

from core import Settings, render
from lessons.exercises.answers.fields import Numbers
from lessons.exercises.coding.triangles import edge_of
from lessons.exercises.drafting import by_rule, listed, numbers, place_text, table
from lessons.exercises.numbers import Draws, number_text, reject
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.coverage import corner_text, facing_text, twice_area
from lessons.exercises.templates.fragments import NAMES, attributes_at, triangle_and_pixel, weights_at
from lessons.mistakes.shelf import RULES, SHELF
from lessons.mistakes.transforms import dot
from lessons.small_scenes import triangle_scene

RGB = ("red", "green", "blue")
SIZE = (11, 9)


@template("weights-of-two-points", 1, "Weights inside and outside", "interpolate", 3)
def draw_two_points(draws: Draws) -> Draft:
    """A point inside, and one outside."""
    corners = [(Fraction(draws.whole(0, 9)), Fraction(draws.whole(0, 9))) for _ in range(3)]
    points = [(Fraction(draws.whole(0, 9)), Fraction(draws.whole(0, 9))) for _ in range(2)]
    reject(twice_area(corners) < 10)
    rows = [weights_at(corners, point) for point in points]
    reject(min(rows[0]) <= 0 or min(rows[1]) >= 0)
    turned = [[row[2], row[0], row[1]] for row in rows]
    given = (
        f"Vertices 0, 1, 2: {corner_text(corners)}\nP = {place_text(points[0])}, Q = {place_text(points[1])}"
    )
    asked = f"""What are alpha, beta and gamma of P and of Q? One lies inside of the triangle, the other one
        outside.
        Hint: Each weight is an area with a sign over the area of the triangle.
        Hint: alpha is the area of the point with vertices 1 and 2.
        Hint: Inside, all three are positive; the sum is 1 for every point.
        Hint: The area of the whole triangle is half of {facing_text(corners)}."""
    scene = triangle_scene([corners], (10, 10))
    return table(asked, given, NAMES, ("P", "Q"), rows, {"weights-permuted": turned}, scene=scene)


@template("color-at-pixel", 1, "A colour between three vertices", "interpolate", 3)
def draw_color(draws: Draws) -> Draft:
    """A colour between three vertices."""
    corners, pixel, weights = triangle_and_pixel(draws)
    colors = [[Fraction(draws.whole(0, 4), 4) for _ in RGB] for _ in range(3)]
    right = [dot(weights, channel) for channel in zip(*colors, strict=True)]
    scene = triangle_scene([corners], SIZE, attributes=[colors])
    wrong = {"weights-permuted": attributes_at(SHELF["weights-permuted"].draw(scene, Settings()), pixel)}
    given = listed("Vertex {k}: {}, colour {}", corners, map(tuple, colors))
    reds = [number_text(color[0]) for color in colors]
    asked = f"""What are red, green and blue at the centre (i + 1/2, j + 1/2) of pixel {pixel}? All w are 1.
        Hint: Find the three weights first.
        Hint: c = alpha c0 + beta c1 + gamma c2, channel by channel.
        Hint: red = alpha * {reds[0]} + beta * {reds[1]} + gamma * {reds[2]}; green and blue likewise."""
    return numbers(asked, given, right, wrong, RGB, scene=scene, pixel=pixel)


@template("sorted-attributes", 1, "Values of sorted vertices", "interpolate", 3)
def draw_sorted(draws: Draws) -> Draft:
    """A value after the vertices were sorted."""
    corners, pixel, weights = triangle_and_pixel(draws)
    q = [Fraction(draws.whole(0, 20)) for _ in range(3)]
    scene = triangle_scene([corners], SIZE, attributes=[[[value] for value in q]])
    wrong = {
        "attributes-not-sorted": attributes_at(SHELF["attributes-not-sorted"].draw(scene, Settings()), pixel)
    }
    given = listed("Vertex {k}: {}, q = {}", corners, q)
    asked = f"""A scanline fill sorts the vertices by y. What is the attribute q at the centre (i + 1/2, j +
        1/2) of pixel {pixel}? All w are 1.
        Hint: Which q belongs to the lowest vertex?
        Hint: Sort the vertices together with what they carry.
        Hint: q = alpha * {q[0]} + beta * {q[1]} + gamma * {q[2]}, each with the weight of its own vertex."""
    return numbers(asked, given, [dot(weights, q)], wrong, scene=scene, pixel=pixel)


@template("flat-value", 1, "The provoking vertex", "interpolate", 1)
def draw_flat(draws: Draws) -> Draft:
    """The provoking vertex."""
    corners, pixel, _ = triangle_and_pixel(draws)
    q = [Fraction(value) for value in draws.shuffled(range(10, 60))[:3]]
    provoking = draws.item(("first", "last"))
    settings = Settings(interpolation="flat", provoking=provoking)
    scene = triangle_scene([corners], SIZE, attributes=[[[value] for value in q]])
    right: Numbers = attributes_at(render(scene, settings), pixel)
    given = listed("Vertex {k}: {}, q = {}", corners, q)
    asked = f"""The attribute q is not interpolated (flat): the whole triangle has that of its {provoking}
        vertex. What is q at pixel {pixel}?
        Hint: Does the place in the triangle matter?
        Hint: Flat: the value of the provoking vertex is that of all pixels.
        Hint: Which of {", ".join(map(number_text, q))} stands at the {provoking} vertex of the list?"""
    whole = [Fraction(int(value)) for value in right]
    return numbers(asked, given, whole, scene=scene, settings=settings, pixel=pixel)


@template("edge-middle", 1, "The middle of an edge", "interpolate", 2)
def draw_edge_middle(draws: Draws) -> Draft:
    """Which point of an edge is at its middle in the window."""
    near, far = Fraction(draws.whole(1, 4)), Fraction(draws.whole(5, 12))
    right = near / (near + far)
    given = f"w = {near} at the near end, w = {far} at the far end."
    asked = f"""An edge runs away from the eye. Which share of its length in space, from the near end, lies
        before the point that is at the middle of its picture?
        Hint: Give the near end u = 0 and the far end u = 1, and interpolate u with perspective.
        Hint: u = ((u0/w0 + u1/w1)/2) / ((1/w0 + 1/w1)/2).
        Hint: u = (0/{near} + 1/{far}) / (1/{near} + 1/{far})."""
    wrong = {
        "affine-for-perspective": [Fraction(1, 2)],
        "not-divided-back": [1 / far / 2],
        "multiplied-by-w": [far / (near + far)],
    }
    return numbers(asked, given, [right], wrong)


@template("reciprocal-w", 3, "1/w along an edge", "interpolate", 1)
def draw_reciprocal(draws: Draws) -> Draft:
    """1/w between two ends."""
    w = [Fraction(draws.item((1, 2, 4, 5, 8, 10))) for _ in range(2)]
    t = Fraction(draws.whole(1, 7), 8)
    given = f"w = {w[0]} at t = 0, w = {w[1]} at t = 1.\nThe point: t = {number_text(t)}"
    asked = f"""What is 1/w at this point of an edge? t is its share of the way in the window.
        Hint: Which of w and 1/w is linear in the window?
        Hint: 1/w = (1 - t)/w0 + t/w1.
        Hint: (1 - {number_text(t)})/{w[0]} + {number_text(t)}/{w[1]}."""
    rule = RULES["distance-linear"]
    right, wrong = ([1 / distance(t, w)[0]] for distance in (rule.right, rule.wrong))
    return numbers(asked, given, right, {rule.name: wrong})


@template("attribute-plane", 1, "u/w over the window", "interpolate", 4)
def draw_plane(draws: Draws) -> Draft:
    """Coefficients of u/w over the window."""
    corners = [(Fraction(draws.whole(0, 6)), Fraction(draws.whole(0, 6))) for _ in range(3)]
    area = twice_area(corners)
    reject(area not in (4, 5, 8, 10, 16, 20))
    w, u = ([Fraction(draws.item(items)) for _ in range(3)] for items in ((1, 2, 4), (0, 2, 4, 8)))
    reject(len(set(u)) == 1)
    edges = [edge_of(corners[(k + 1) % 3], corners[(k + 2) % 3]) for k in range(3)]
    u_over_w = [a / b for a, b in zip(u, w, strict=True)]
    right = [dot(column, u_over_w) / area for column in zip(*edges, strict=True)]
    given = listed("Vertex {k}: (X, Y) = {}, w = {}, u = {}", corners, w, u)
    asked = f"""u/w is linear over the window: u/w = a X + b Y + c with the pixel coordinates X and Y. What
        are a, b and c? It has the right values at the three vertices.
        Hint: What is u/w at each vertex?
        Hint: Three equations, three unknowns; subtract one from the other two.
        Hint: Vertex 0: {u[0]}/{w[0]} = a * {corners[0][0]} + b * {corners[0][1]} + c; the other two
        likewise."""
    scene = triangle_scene([corners], (7, 7), w=[w])
    return numbers(asked, given, right, names=("a", "b", "c"), scene=scene)


def edge_shares(draws: Draws) -> tuple[Fraction, tuple[Any, ...]]:
    """Draw a place along an edge in the window, and the distances of its ends."""
    return Fraction(draws.whole(1, 7), 8), (Fraction(draws.whole(1, 3)), Fraction(draws.whole(5, 12)))


@template("depth-along-edge", 1, "Window depth along an edge", "interpolate", 2)
def draw_depth(draws: Draws) -> Draft:
    """Window depth along an edge."""
    t, distances = edge_shares(draws)
    depths = (Fraction(draws.whole(0, 4), 10), Fraction(draws.whole(6, 10), 10))
    ends = listed("End {k}: z = {}, w = {}", depths, distances)
    given = f"{ends}\nThe point: t = {number_text(t)}"
    asked = f"""What is the window depth z at this point of an edge? t is its share of the way in the window.
        Hint: Was z divided by w already?
        Hint: Window depth is linear in the window.
        Hint: (1 - {number_text(t)}) * {number_text(depths[0])} + {number_text(t)} *
        {number_text(depths[1])}."""
    return by_rule(asked, given, (t, depths, distances), ("depth-corrected-twice",))


@template("distance-along-edge", 1, "Distance along an edge", "interpolate", 2)
def draw_distance(draws: Draws) -> Draft:
    """The distance along an edge."""
    t, distances = edge_shares(draws)
    given = f"Distance {distances[0]} at t = 0, {distances[1]} at t = 1.\nThe point: t = {number_text(t)}"
    asked = f"""How far from the eye, along the view, is this point of an edge? t is its share of the way in
        the window.
        Hint: Is the distance linear in the window?
        Hint: Its reciprocal is.
        Hint: 1 / ((1 - {number_text(t)})/{distances[0]} + {number_text(t)}/{distances[1]})."""
    return by_rule(asked, given, (t, distances), ("distance-linear",))
