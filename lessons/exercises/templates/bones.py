"""Bones: what one bone does to a vertex, and what two make of a joint."""

from lessons.exercises.drafting import by_rule
from lessons.exercises.numbers import Draws
from lessons.exercises.question import Draft, template


@template("bone-matrix", 1, "Where a bone takes a vertex", "transform", 2)
def draw_bone(draws: Draws) -> Draft:
    """A vertex that one bone turns by 90 degrees."""
    head = draws.whole(2, 6), draws.whole(0, 3)
    point = head[0] + draws.whole(1, 4), head[1] + draws.whole(-2, 2)
    asked = f"""A bone begins at the joint {head} and is turned by 90 degrees, counter-clockwise. A vertex hangs on
        it alone, at {point} in the rest pose. Where does the bone take it? Its matrix is pose times inverse bind.
        Hint: The inverse bind says where the vertex is seen from the joint.
        Hint: A turn by 90 degrees takes (x, y) to (-y, x). The pose then adds the joint.
        Hint: Seen from the joint, the vertex is at ({point[0]} - {head[0]}, {point[1]} - {head[1]})."""
    given = f"Joint: {head}\nVertex: {point}"
    return by_rule(asked, given, (point, head), ("no-inverse-bind", "pose-before-bind"), ("x", "y"))


@template("width-of-a-joint", 1, "How thin a bent joint gets", "transform", 2)
def draw_width(draws: Draws) -> Draft:
    """The width that a bent joint keeps."""
    degrees = draws.item((50, 60, 80, 90, 100, 140, 150))
    asked = f"""Linear blending bends a bar by {degrees} degrees. Where both bones have the weight 1/2, which
        percentage of its width is left?
        Hint: One bone leaves a vertex beside the joint, the other turns it by {degrees} degrees.
        Hint: Halfway between both places it lies on a chord: how far is the chord's middle from the joint?
        Hint: It is the cosine of half the angle, of {degrees} / 2 degrees."""
    mistakes = ("width-of-whole-angle", "width-in-proportion")
    return by_rule(asked, f"Angle: {degrees} degrees", (float(degrees),), mistakes, ("percent",))
