"""Occluders: which boxes are surely hidden, and what a level of the pyramid keeps."""

from lessons.exercises.drafting import MARKS, by_rule, several
from lessons.exercises.numbers import Draws, reject
from lessons.exercises.question import Draft, template
from lessons.mistakes.occluders import hidden_boxes
from lessons.mistakes.shelf import RULES


@template("hidden-boxes", 1, "Hidden behind occluders", "cull", 2)
def draw_hidden_boxes(draws: Draws) -> Draft:
    """Which boxes lie behind all texels of their rectangles."""
    boxes = tuple(
        (near, near + draws.whole(1, 4), tuple(draws.whole(2, 9) for _ in range(draws.item((2, 4)))))
        for near in (draws.whole(3, 9) for _ in range(5))
    )
    names = ("compared-with-nearest-texel", "far-side-compared")
    right = hidden_boxes(boxes)
    wrong = {name: RULES[name].wrong(boxes) for name in names}
    reject(not all(0 < len(each) < 5 for each in wrong.values()))
    near, _, texels = boxes[0]
    asked = f"""The depth of some occluders is drawn, and these boxes are compared with it. Which of them are surely
        hidden? Greater is farther.
        Hint: A box is hidden only if no part of it can be seen.
        Hint: So its nearest depth must be farther than the farthest of its texels.
        Hint: For box {MARKS[0]}, compare {near} with {max(texels)}."""
    options = [
        f"{MARKS[place]}: depth {near} to {far}; its texels store {', '.join(map(str, texels))}"
        for place, (near, far, texels) in enumerate(boxes)
    ]
    return several(asked, "A pyramid of depths keeps the farthest.", options, right, wrong)


@template("pyramid-level", 1, "The next level of the pyramid", "cull", 1)
def draw_pyramid_level(draws: Draws) -> Draft:
    """What four texels keep of 4 x 4 depths."""
    depths = tuple(tuple(draws.whole(1, 9) for _ in range(4)) for _ in range(4))
    square = [depths[y][x] for y in (0, 1) for x in (0, 1)]
    asked = f"""These are the depths of the occluders, row 0 first; greater is farther. Boxes are dropped by a pyramid
        over them. What do the four texels of its next level keep? Give the two of rows 0 and 1 first.
        Hint: A box may be dropped only if it lies behind all that a texel stands for.
        Hint: So each texel keeps the farthest of its 2 x 2 depths.
        Hint: The first one keeps the farthest of {", ".join(map(str, square[:-1]))} and {square[-1]}."""
    given = "\n".join(f"Row {number}: {', '.join(map(str, row))}" for number, row in enumerate(depths))
    names = (
        "columns 0, 1; rows 0, 1",
        "columns 2, 3; rows 0, 1",
        "columns 0, 1; rows 2, 3",
        "columns 2, 3; rows 2, 3",
    )
    return by_rule(asked, given, (depths,), ("nearest-in-pyramid", "mean-in-pyramid"), names)
