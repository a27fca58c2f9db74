"""Boxes of objects: which the view volume drops, which a ray opens, and how a tree is cut."""

from lessons.exercises.drafting import by_rule, one_of, several
from lessons.exercises.numbers import Draws, reject
from lessons.exercises.question import Draft, template
from lessons.mistakes.shelf import RULES


@template("box-outside-plane", 1, "A box and a plane", "cull", 2)
def draw_box_and_plane(draws: Draws) -> Draft:
    """The distance that decides whether a box is outside of a plane."""
    low = [draws.whole(-12, 6) for _ in range(2)]
    high = [coordinate + draws.whole(2, 10) for coordinate in low]
    normal = [draws.item((-5, -3, -2, 2, 3, 5)) for _ in range(2)]
    offset = draws.whole(-20, 20)
    arguments = (normal, offset, (low, high))
    reject(abs(RULES["nearest-corner-asked"].right(*arguments)[0]) < 30)
    given = (
        f"Box: x from {low[0]} to {high[0]}, y from {low[1]} to {high[1]}\n"
        f"Plane: distance d = {normal[0]} x {normal[1]:+d} y {offset:+d}"
    )
    asked = f"""Inside of a plane is where its distance d is 0 or more. Which distance has the one corner of the box
        that decides whether the whole box is outside?
        Hint: The box is outside only if all of its corners are.
        Hint: So the corner with the largest d decides.
        Hint: The factor of x is {normal[0]}, so it has x = {high[0] if normal[0] > 0 else low[0]}; likewise y."""
    return by_rule(asked, given, arguments, ("nearest-corner-asked",))


@template("box-around-view", 1, "Which boxes are dropped?", "cull", 2)
def draw_boxes_and_view(draws: Draws) -> Draft:
    """Boxes against two planes: around both, outside of one, across one."""
    right = draws.whole(2, 5)
    low, high, middle = (
        -right - draws.whole(1, 4),
        right + draws.whole(1, 4),
        draws.whole(1 - right, right - 1),
    )
    ends = draws.shuffled(((low, high), (low - draws.whole(1, 4), low), (high, high + 2), (middle, high)))
    planes = (((1, 0), right), ((-1, 0), right))
    rule = RULES["no-corner-inside"]
    chosen, wrong = (
        [k for k, (start, end) in enumerate(ends) if drops(planes, ((start, 0), (end, 1))) == (1,)]
        for drops in (rule.right, rule.wrong)
    )
    given = f"Planes: d = x + {right} (left) and d = -x + {right} (right)\nBoxes: y from 0 to 1"
    asked = f"""Inside of a plane is where d is 0 or more. Which of these boxes does culling of objects drop?
        Hint: Which corners of a box are outside of the left plane, where d is below 0?
        Hint: Is there one plane that all corners of the box are outside of?
        Hint: Where does the corner at x = {low} lie against each plane, and the one at x = {high}?"""
    options = [f"x from {start} to {end}" for start, end in ends]
    return several(asked, given, options, chosen, {rule.name: wrong})


@template("bvh-first-cut", 1, "The first cut of a BVH", "cull", 1)
def draw_first_cut(draws: Draws) -> Draft:
    """How many objects both parts get."""
    count = draws.whole(5, 9)
    centers = sorted({draws.whole(0, 12) for _ in range(count)} | {draws.whole(40, 90)})
    reject(len(centers) < 5)
    asked = f"""These are the centres of {len(centers)} boxes along the axis of their widest spread. A bounding volume
        hierarchy is cut in the middle of the objects. How many get into the first part, and how many into the
        second? The first one is the smaller where they differ.
        Hint: Is the space halved, or the list of objects?
        Hint: The list is cut in the middle, wherever the centres lie.
        Hint: Of {len(centers)}, the first part gets half, rounded down."""
    return by_rule(
        asked, f"Centres: {', '.join(map(str, centers))}", (centers,), ("space-halved",), ("first", "second")
    )


@template("octree-entries", 1, "Entries of an octree", "cull", 2)
def draw_entries(draws: Draws) -> Draft:
    """How many objects both halves of a cell list."""
    middle = draws.whole(8, 12)
    spans = [(low, low + draws.whole(1, 6)) for low in (draws.whole(0, 18) for _ in range(5))]
    reject(any(middle in span for span in spans))
    given = "\n".join(f"Object {k}: from {low} to {high}" for k, (low, high) in enumerate(spans))
    asked = f"""A cell of an octree is halved along x at {middle}. How many of these objects does the lower half list,
        and how many the upper one?
        Hint: What happens to an object that crosses the border?
        Hint: It is listed in both halves.
        Hint: The lower half lists all that begin at {middle} or before."""
    return by_rule(asked, given, (spans, middle), ("octant-of-centre",), ("lower", "upper"))


@template("ray-through-box", 1, "A ray through a box", "depth", 2)
def draw_ray_and_box(draws: Draws) -> Draft:
    """Where a ray enters a box, and where it leaves."""
    direction = (draws.item((1, 2)), draws.item((1, 2)))
    low = [draws.whole(1, 6) for _ in range(2)]
    high = [coordinate + draws.whole(1, 6) for coordinate in low]
    arguments = ((0, 0), direction, (low, high))
    given = (
        f"Ray: x = {direction[0]} t, y = {direction[1]} t\n"
        f"Box: x from {low[0]} to {high[0]}, y from {low[1]} to {high[1]}"
    )
    asked = f"""At which t is the ray between all planes of the box, and at which t is it so no longer? Write both, also
        where it leaves before it enters: then it misses the box.
        Hint: At which t does it come between the planes of x, and when does it leave them?
        Hint: It enters at the larger of both entries, and leaves at the smaller of both exits.
        Hint: It comes between the planes of x where {direction[0]} t = {low[0]}."""
    return by_rule(asked, given, arguments, ("slabs-joined",), ("enter", "leave"))


@template("nearest-hit-of-boxes", 1, "Which box has the nearest hit?", "depth", 1)
def draw_nearest(draws: Draws) -> Draft:
    """A box that begins nearer, with a hit that is farther."""
    starts = sorted({draws.whole(1, 9) for _ in range(3)})
    reject(len(starts) < 3)
    boxes = [(start, start + draws.whole(1, 12)) for start in starts]
    reject(len({hit for _, hit in boxes}) < len(boxes))
    rule = RULES["nearest-box-wins"]
    given = "\n".join(
        f"Box {k}: begins at t = {start}, its nearest hit at t = {hit}"
        for k, (start, hit) in enumerate(boxes)
    )
    asked = f"""A ray meets three boxes that overlap. Which box holds what is seen?
        Hint: Is it the box or the hit that is seen?
        Hint: After the hit in a box, which boxes may still hold a nearer one?
        Hint: After the hit of box 0 at t = {boxes[0][1]}: those that begin before it."""
    options = [f"box {k}" for k in range(len(boxes))]
    return one_of(asked, given, options, rule.right(boxes)[0], {rule.name: rule.wrong(boxes)[0]})
