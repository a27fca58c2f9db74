"""The order of drawing: a walk through a tree of planes, cuts, and sorting with a corner behind the eye."""

from lessons.exercises.answers.choices import OrderAnswer
from lessons.exercises.drafting import by_rule, drafted, listed, words
from lessons.exercises.numbers import Draws, reject
from lessons.exercises.question import Draft, template
from lessons.mistakes.planes import Node
from lessons.mistakes.shelf import RULES

NAMES = tuple("ABCDE")


def _tree(draws: Draws, names: list[str]) -> Node | None:
    """Return a tree of these names, the first one its root, or ``None`` for no name."""
    if not names:
        return None
    first, *others = names
    front = draws.whole(0, len(others))
    return Node(first, draws.whole(0, 1) == 1, _tree(draws, others[:front]), _tree(draws, others[front:]))


def _lines(node: Node) -> list[str]:
    """Return one line for each node, the root first: its halves, and the side of the eye."""
    halves = ", ".join(
        f"{side} half: {half.name if half else 'nothing'}"
        for side, half in (("front", node.front), ("back", node.back))
    )
    lines = [f"{node.name}: {halves}; the eye is {'in front' if node.eye_in_front else 'behind'}"]
    for half in (node.front, node.back):
        lines += _lines(half) if half else []
    return lines


@template("tree-order", 1, "Walk a tree of planes", "depth", 2)
def draw_walk(draws: Draws) -> Draft:
    """The order in which a tree of planes is painted."""
    tree = _tree(draws, list(NAMES))
    assert tree is not None
    reject(tree.front is None or tree.back is None)
    rule = RULES["front-and-back-swapped"]
    order = rule.right(tree)
    far = tree.back if tree.eye_in_front else tree.front
    assert far is not None
    asked = f"""A BSP tree holds five triangles; a half is named by the node that it begins with. In which
        order are they painted, first to last?
        Hint: Which half of a node can hide nothing of the other half?
        Hint: Paint the half without the eye, then the node, then the half with the eye. Do the same in each
        half.
        Hint: The eye is {"in front of" if tree.eye_in_front else "behind"} A: all of the half of {far.name} comes
        before A."""
    wrong = {rule.name: tuple(order.index(name) for name in rule.wrong(tree))}
    return drafted(asked, "\n".join(_lines(tree)), OrderAnswer(order, draws.shuffled(NAMES)), wrong)


@template("pieces-of-a-cut", 1, "Pieces of a cut", "depth", 2)
def draw_cut(draws: Draws) -> Draft:
    """How many triangles a plane makes of one."""
    distances = tuple(draws.whole(-4, 4) for _ in range(3))
    reject(0 not in distances or len(set(distances)) < 3)
    d = ", ".join(f"d{k} = {value}" for k, value in enumerate(distances))
    touching = distances.index(0)
    asked = f"""A plane of a BSP tree meets a triangle, whose corners lie at these distances from it, positive
        on its front side. How many triangles lie on the front and on the back side then? A polygon of four
        corners is two triangles.
        Hint: A side is cut only where its two ends have different signs.
        Hint: A corner with distance 0 lies in the plane: no cut is needed there.
        Hint: With {d}, corner {touching} belongs to both sides. Count the corners on each: three make one
        triangle, four make two, and fewer make none."""
    return by_rule(asked, d, (distances,), ("corner-in-plane-cuts",), ("front", "back"))


@template("sorted-behind-the-eye", 1, "Sort with a corner behind the eye", "depth", 2)
def draw_sort(draws: Draws) -> Draft:
    """An order by the mean distance, where one corner lies behind the eye."""
    near, far = 1, draws.item((5, 10))
    names = NAMES[:3]
    corners = [tuple(draws.whole(2, 4) for _ in range(3)) for _ in names]
    which = draws.whole(0, 2)
    corners[which] = (*corners[which][:2], -draws.whole(1, 2))
    rule = RULES["sorted-after-division"]
    order, after = (find(corners, near, far) for find in (rule.right, rule.wrong))
    reject(len({sum(each) for each in corners}) < len(names))
    given = listed("{}: distances {}", names, corners)
    asked = f"""A painter's algorithm sorts by the mean distance of the corners along the view (w), which is
        negative behind the eye. In which order are these triangles painted, first to last?
        Hint: The farthest mean is painted first.
        Hint: Take the mean of w itself, not of the depth after the division by w.
        Hint: Add the distances of {names[which]} with their signs: {words(corners[which])}."""
    options = tuple(names[k] for k in order)
    wrong = {rule.name: tuple(order.index(k) for k in after)}
    return drafted(asked, given, OrderAnswer(options, draws.shuffled(names)), wrong)
