"""Mistakes in typing: each is told at its line, in a sentence that says what is wrong and mostly what to write."""

import re

import pytest

from core import Settings, render
from core.edits import Edit, apply_edit, original
from core.lanes.problem import Problem
from lessons.scenes import make_scene

OF = {
    "line": "bresenham-lecture",
    "fill": "bounding-box",
    "fill_rule": "shared-edge",
    "depth_test": "z-float32",
    "interpolation": "perspective",
    "blend": "over",
}
PYTHONS_OWN = re.compile(
    r"invalid syntax|Error|Traceback|unexpected|EOF|None|object|ndarray|numpy", re.IGNORECASE
)
"""Words that no beginner should have to understand."""

BROKEN = [
    ("fill", "for k in range(3):", "for k in range(3)", 4, "a colon is missing at the end of this line"),
    ("fill", "for k in range(3):", "for k in range(4):", 5, "index 3 is outside of 0 to 2"),
    ("fill", "value = a[k] * x", "value = a[k] * X", 5, "X has no value: did you mean x?"),
    ("fill", "values.append(value)", "valus.append(value)", 6, "valus has no value: did you mean values?"),
    (
        "fill",
        "values.append(value)",
        "values.add(value)",
        6,
        ".add is not in the language of listings: a list has .append(value)",
    ),
    ("fill", "values.append(value)", "values.append(value", 6, "the bracket ( is never closed"),
    (
        "fill",
        "  return values, all(inside)",
        "",
        1,
        "covers never returns anything: its last line must be return ...",
    ),
    (
        "fill",
        "return values, all(inside)",
        "return inside",
        8,
        "return must give the three values, and whether the pixel is covered: here it gives 3 values",
    ),
    (
        "fill",
        "return values, all(inside)",
        "return values, inside",
        8,
        "return must give the three values, and whether the pixel is covered: true or false, not a list",
    ),
    (
        "fill",
        "return values, all(inside)",
        "return values, 0",
        8,
        "return must give the three values, and whether the pixel is covered: true or false, not a whole number",
    ),
    (
        "fill",
        "return values, all(inside)",
        "return all(inside)",
        8,
        "return must give the three values, and whether the pixel is covered: here it gives 1 value",
    ),
    ("fill", "values = []", "values = ", 2, "something is missing at the end of this line"),
    ("fill", "values = []", "values = 0", 6, ".append needs a list, not a whole number"),
    ("fill", "value > 0 or", "value > 0 ||", 7, "write and, or"),
    (
        "fill",
        "value > 0 or (value == 0 and",
        "value > 0 or (value = 0 and",
        7,
        "= stores a value; to compare write ==",
    ),
    (
        "fill",
        "value > 0 or",
        "value or",
        7,
        "a condition must be true or false, not a number: compare it, as x != 0",
    ),
    ("fill", "all(inside)", "al(inside)", 8, "there is no function al: did you mean all?"),
    ("fill", "    values.append(value)", "   values.append(value)", 6, "this bracket was never opened"),
    (
        "fill",
        "def covers(a, b, c, owns_tie, x, y):",
        "def covers(a, b, c, owns_tie, x):",
        1,
        "covers is given 6 values (a, b, c, owns_tie, x, y), and takes 5",
    ),
    (
        "fill",
        "def covers(a, b, c, owns_tie, x, y):",
        "def covers(a, b, c, owns_tie, x, y)",
        1,
        "a colon is missing at the end of this line",
    ),
    (
        "fill",
        "def covers(a, b, c, owns_tie, x, y):",
        "",
        2,
        "this line begins further left or right than the others of its block",
    ),
    ("fill", "a[k] * x", "a[k] x", 5, "an operator or a comma is missing here"),
    ("fill", "a[k] * x", "ak * x", 5, "ak has no value: did you mean a?"),
    ("fill", "a[k] * x", "a * x", 5, "a list * a number is not possible"),
    ("fill", "bool(", "boolean(", 7, "there is no function boolean: did you mean bool?"),
    ("line", "if D > 0:", "if D => 0:", 14, "write >= or <="),
    (
        "line",
        "if D > 0:",
        "if D:",
        14,
        "a condition must be true or false, not a whole number: compare it, as x != 0",
    ),
    ("line", "if D > 0:", "if D > 0 then", 14, "a colon is missing at the end of this line"),
    ("line", "if D > 0:", "if d > 0:", 14, "d has no value: did you mean D?"),
    ("line", "if D > 0:", "if (D > 0:", 14, "the bracket ( is never closed"),
    ("line", "x += sx", "x++", 18, "write += 1 or -= 1"),
    ("line", "x += sx", "x = x", 12, "the loop goes on after 112 rounds: does it ever end?"),
    (
        "line",
        "x += sx",
        "x == x + sx",
        18,
        "this line changes nothing: == compares, to store a value write =",
    ),
    ("line", "x += sx", "x += s", 18, "s has no value"),
    (
        "line",
        "D = 2 * dy - dx",
        "D = 2dy - dx",
        10,
        "this cannot be read: names begin with a letter, numbers without a 0 in front",
    ),
    ("line", "D = 2 * dy - dx", "D = 2 * dy - ", 10, "something is missing at the end of this line"),
    ("line", "D = 2 * dy - dx", "2 * dy - dx = D", 10, "= stores a value; to compare write =="),
    (
        "line",
        "D = 2 * dy - dx",
        "D = 2 * dy - dx;;",
        10,
        "no ; { } here: a line ends by itself, and blocks are indented",
    ),
    (
        "line",
        "D = 2 * dy - dx",
        "int D = 2 * dy - dx",
        10,
        "a variable has no type in front of it: it begins with name = value",
    ),
    ("line", "D = 2 * dy - dx", "D := 2 * dy - dx", 10, "write = to store a value"),
    ("line", "D = 2 * dy - dx", "D = 2 × dy − dx", 10, "this character is not in the language of listings"),
    ("line", "y += sy", "y += 0.5", 13, "the x and y of a pixel must be whole numbers"),
    ("line", "y += sy", "yy += sy", 15, "yy has no value: did you mean y0?"),
    (
        "line",
        "while x <= x1:",
        "while x1:",
        12,
        "a condition must be true or false, not a whole number: compare it, as x != 0",
    ),
    (
        "line",
        "while x <= x1:",
        "while x < = x1:",
        12,
        "write <=, >=, == and != without a blank between the two signs",
    ),
    (
        "line",
        "while x <= x1:",
        "for x in x0..x1:",
        12,
        "write range(first, end) for numbers one after the other",
    ),
    (
        "line",
        "while x <= x1:",
        "for x in x1:",
        12,
        "a whole number has no elements: a loop over numbers takes range(first, end)",
    ),
    (
        "line",
        "pixels.append((y, x, D) if is_steep else (x, y, D))",
        "pixels.append(x, y)",
        13,
        ".append takes one value: put brackets around several, as .append((x, y))",
    ),
    (
        "line",
        "pixels.append((y, x, D) if is_steep else (x, y, D))",
        "pixels.append(x)",
        13,
        "a pixel of the list must be (x, y) or (x, y, decision)",
    ),
    (
        "line",
        "pixels.append((y, x, D) if is_steep else (x, y, D))",
        "pixels.append((y, x) if is_steep else (x, y, D))",
        13,
        "this gives 2 values here and 3 elsewhere",
    ),
    ("line", "x, y = x0, y0", "x, y = x0", 9, "2 names on the left of =, 1 value on its right"),
    ("line", "x, y = x0, y0", "x, y = x0, y0, 0", 9, "2 names on the left of =, 3 values on its right"),
    ("line", "return pixels", "return pixel", 19, "pixel has no value: did you mean pixels?"),
    ("line", "return pixels", "return D", 19, "return must give the list of pixels, not a whole number"),
    (
        "line",
        "  return pixels",
        "return pixels",
        19,
        "a listing is one function: nothing stands outside of it",
    ),
    (
        "line",
        "dx, dy = x1 - x0, abs(y1 - y0)",
        "dx, dy = x1 - x0, Math.abs(y1 - y0)",
        7,
        ".abs is not in the language of listings",
    ),
    (
        "line",
        "dx, dy = x1 - x0, abs(y1 - y0)",
        "dx, dy = x1 - x0, abs(y1, y0)",
        7,
        "abs takes 1 value, got 2",
    ),
    (
        "fill_rule",
        "  if a != 0:\n    return a > 0",
        "  if a != 0:\n  return a > 0",
        3,
        "the lines that belong to the line above must stand further right",
    ),
    ("fill_rule", "if a != 0:", "if a <> 0:", 2, "write != for unequal"),
    ("fill_rule", "if a != 0:", "if !a:", 2, "write not"),
    (
        "fill_rule",
        "if a != 0:",
        "if not a:",
        2,
        "a condition must be true or false, not a number: compare it, as x != 0",
    ),
    (
        "fill_rule",
        "return b > 0",
        "return b",
        4,
        "return must give whether the edge owns the pixel centre: true or false, not a number",
    ),
    ("fill_rule", "  return b > 0", "  else if b > 0:\n    return True", 4, "write elif"),
    (
        "fill_rule",
        "  return b > 0",
        "",
        2,
        "owns may end here without return: its last line must be return ...",
    ),
    ("interpolation", "n[k] / total for", "n[k] / totl for", 4, "totl has no value: did you mean total?"),
    (
        "interpolation",
        "return weights, total, value",
        "return weights, value",
        6,
        "return must give the weights of the three corners, their sum, and the value: here it gives 2 values",
    ),
    (
        "interpolation",
        "return weights, total, value",
        "return value",
        6,
        "return must give the weights of the three corners, their sum, and the value: here it gives 1 value",
    ),
    ("interpolation", "total = n[0] + n[1] + n[2]", "total = sum(n) / len(m)", 3, "m has no value"),
    ("interpolation", "total = n[0] + n[1] + n[2]", "total = n", 4, "a number / a list is not possible"),
    ("depth_test", "if not nearer:", "if not nearer = True:", 3, "= stores a value; to compare write =="),
    ("depth_test", "return old, False", "return False", 5, "this gives 2 values here and 1 elsewhere"),
    ("depth_test", "return old, False", "return old False", 4, "an operator or a comma is missing here"),
    (
        "depth_test",
        "new > old if larger_is_nearer else new < old",
        "new > old if larger_is_nearer",
        2,
        "else is missing: one value if a condition else another",
    ),
    (
        "blend",
        "*color, alpha = source",
        "color, alpha = source",
        2,
        "2 names on the left of =, 4 values on its right",
    ),
    (
        "blend",
        "result.append(alpha + destination[3] * (1 - alpha))",
        "",
        5,
        "return must give four numbers: here it gives 3 values",
    ),
    ("blend", "destination[3]", "destination[4]", 4, "index 4 is outside of 0 to 3"),
    ("blend", "alpha + destination[3]", "alpha + destination", 4, "a list * a number is not possible"),
    (
        "blend",
        "result.append(",
        "result.push(",
        4,
        ".push is not in the language of listings: a list has .append(value)",
    ),
    (
        "blend",
        "[np.float32(value) for value in result]",
        "np.array(result)",
        5,
        ".array is not in the language of listings",
    ),
]
"""Part, what stands there, what is typed, and the line and the sentence that are told."""


def draw(part: str, text: str) -> None:
    """Apply an edit, and draw a scene with it."""
    settings = apply_edit(Settings(), Edit(part, OF[part], text))
    render(make_scene("segment" if part == "line" else "shared-edge"), settings)


def test_there_are_sixty_of_them_and_more():
    assert len(BROKEN) >= 60


@pytest.mark.parametrize(("part", "old", "new", "line", "sentence"), BROKEN)
def test_a_broken_edit_is_told_at_its_line(part, old, new, line, sentence):
    text = original(part, OF[part]).source.replace(old, new, 1)
    with pytest.raises(Problem) as caught:
        draw(part, text)
    problem = caught.value
    assert (problem.line, problem.sentence) == (line, sentence)
    assert 1 <= problem.column <= len(text.splitlines()[problem.line - 1]) + 1
    assert str(problem) == f"line {line}, column {problem.column}: {sentence}"
    assert not PYTHONS_OWN.search(sentence)
