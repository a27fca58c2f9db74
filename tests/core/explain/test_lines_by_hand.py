"""Sentences and formulas of lines whose numbers were worked out by hand, for every way to choose pixels."""

import pytest

from core import Settings
from core.explain import formula, sentence, variables
from tests.core.explain.explained_steps import line_trace


def said(line: str, key: str, place: int = 0) -> tuple[str, str, str]:
    """Return a sentence and both lines of the formula of the triangle on pixel centres."""
    raster = line_trace(Settings(polygon_mode="wireframe", line=line)).stage("raster")
    found = [raster.explain(position) for position in range(1, raster.steps.count + 1)]
    explanation = [each for each in found if each is not None and each.key == key][place]
    made = formula(explanation)
    assert made is not None
    return sentence(explanation, 0, None), made.symbolic, made.substituted


@pytest.mark.parametrize(
    ("line", "operation", "place", "wanted"),
    [
        (
            "bresenham",
            "-start.octant",
            0,
            "Edge 2 of triangle 0 runs from pixel (1, 1) to pixel (9, 3): it is longer in x, so it is drawn "
            "column by column.",
        ),
        (
            "bresenham",
            "-start.lengths",
            0,
            "The line goes 8 pixels along x and 2 along y.",
        ),
        (
            "bresenham",
            "-start.directions",
            1,
            "From the first end to the second, x (the row) grows by 1, and y (the column) falls by 1 where it steps.",
        ),
        ("bresenham", "-start.first-sum", 0, "The first D is 2 · dy − dx = −4."),
        ("bresenham", ".test", 0, "D is −4, below 0, so y stays."),
        (
            "bresenham",
            "-step.test",
            0,
            "D is 0, a tie: the line passes exactly between two pixels, and by this version's rule y steps.",
        ),
        (
            "bresenham-lecture",
            ".test",
            1,
            "D is 0, a tie: the line passes exactly between two pixels, and by this version's rule y stays.",
        ),
        (
            "bresenham",
            "-step.step",
            0,
            "Both pixels are equally near the line, and by this version's rule y steps to 2.",
        ),
        ("bresenham-lecture", "-step.step", 0, "The next pixel is nearer to the line, so y steps to 2."),
        ("bresenham", ".advance", 0, "Adding 2 · dy = 4 makes D = 0."),
        ("bresenham", "-step.correct", 0, "Subtracting 2 · dx = 16 makes D = −16."),
        ("bresenham", ".next", 0, "The next pixel is at x = 2."),
        (
            "bresenham-float",
            ".test",
            1,
            "The value of e + m is 0.5, a tie: the line passes exactly between two pixels, and by this version's rule "
            "y stays.",
        ),
        ("bresenham-float", "-step.correct", 0, "Subtracting 1 makes e = −0.5."),
        (
            "bresenham",
            ".plot",
            0,
            "Pixel (2, 1) is drawn: its centre is at t = 0.125 of edge 2 of triangle 0, 0.25 px below the line.",
        ),
        (
            "bresenham",
            ".plot",
            2,
            "Pixel (5, 2) is drawn: its centre lies at t = 0.5 of edge 2 of triangle 0.",
        ),
        (
            "bresenham",
            "-start.plot",
            0,
            "Pixel (1, 1) is drawn: its centre lies at the first end of edge 2 of triangle 0.",
        ),
        ("midpoint", ".evaluate", 0, "At x = 2 the line has y = 1.25, with pixel centres at whole numbers."),
        ("midpoint", ".round", 0, "The nearest pixel centre to y = 1.25 is at 1."),
        (
            "midpoint",
            ".round",
            1,
            "The value y = 1.5 lies exactly between two pixel centres: halves round up, to 2.",
        ),
        ("dda", ".advance", 0, "Adding m · sx = 0.25 makes y = 1.25."),
        (
            "wu",
            "-start.share",
            0,
            "The line ends in this column and spans 0.5 of it, which scales the intensities.",
        ),
        ("wu", ".share", 0, "The line spans the whole column."),
        ("wu", ".column", 0, "The next column is x = 2."),
        ("wu", ".fraction", 0, "The line passes 0.25 of the way from y = 1 to y = 2."),
        ("wu", ".pixel", 0, "Pixel (2, 1) is below the line."),
        ("wu", ".divide", 0, "Pixel (2, 1) gets the intensity 1 − 0.25 = 0.75."),
        ("wu", "-beside.divide", 1, "Pixel (2, 2) gets the intensity 0.25."),
        (
            "gupta-sproull",
            ".distance",
            0,
            "The centre of pixel (2, 1) is 0.25 from the line along y, which gives a distance of 0.2425 px.",
        ),
        (
            "gupta-sproull",
            ".entry",
            0,
            "The nearest entry of the filter's table is at 4 sixteenths of a pixel.",
        ),
        ("gupta-sproull", ".look-up", 0, "There the filter's table has 0.7032."),
        (
            "gupta-sproull",
            ".filter",
            0,
            "Pixel (2, 1) gets the intensity 0.7032, the value of the table.",
        ),
        ("gupta-sproull", "-beside.pixel", 2, "Pixel (2, 2) is the next one above."),
        (
            "rectangle",
            "-start.length",
            0,
            "The ends, snapped to 1/256 pixel, are 8 and 2 apart along the axes, so the rectangle is 8.246 px long and "
            "reaches half a pixel to either side.",
        ),
        (
            "rectangle",
            ".across",
            0,
            "The centre of pixel (2, 1) is 0.2425 px to the right of the line, not more than 0.5, so it is between the "
            "rectangle's long sides.",
        ),
        (
            "diamond-exit",
            ".round",
            0,
            "Pixel (2, 1) is the nearest in this column: the line passes 0.25 px above its centre.",
        ),
    ],
)
def test_hand_computed_sentences(line: str, operation: str, place: int, wanted: str) -> None:
    assert said(line, f"raster.{line}{operation}", place)[0] == wanted


def test_hand_computed_formulas() -> None:
    _, symbols, numbers = said("bresenham", "raster.bresenham.plot")
    assert symbols == r"t & = & \frac{x - x_0}{x_1 - x_0}"
    assert numbers == r"0.125 & = & \frac{2.5 - 1.5}{9.5 - 1.5}"
    _, symbols, numbers = said("dda", "raster.dda.advance")
    assert symbols == r"y & = & y_{\mathrm{before}} & + & m & \cdot & sx"
    assert numbers == r"1.25 & = & 1 & + & 0.25 & \cdot & 1"
    _, symbols, numbers = said("bresenham", "raster.bresenham-step.correct")
    assert symbols == r"D & = & D_{\mathrm{before}} & - & 2 & \cdot & dx"
    assert numbers == r"-16 & = & 0 & - & 2 & \cdot & 8"
    _, _, numbers = said("bresenham-lecture", "raster.bresenham-lecture.test", 1)
    assert numbers == r"0 & = & 0 & \Rightarrow & \text{stay}"


def test_a_steep_line_speaks_as_its_listing_that_swaps_x_and_y() -> None:
    raster = line_trace(Settings(polygon_mode="wireframe", line="bresenham")).stage("raster")
    found = [raster.explain(position) for position in range(1, raster.steps.count + 1)]
    steep = [each for each in found if each is not None and each.values["is_steep"]]
    start = next(each for each in steep if each.key == "raster.bresenham-start.octant")
    assert sentence(start, 0, None).endswith(
        "it is longer in y, so x and y are swapped and it is drawn row by row."
    )
    first = next(each for each in steep if each.key == "raster.bresenham-start.first-sum")
    run, rise = first.values["run"], first.values["rise"]
    made = formula(first)
    assert made is not None
    assert made.symbolic == r"D & = & 2 & \cdot & dy & - & dx"
    assert made.substituted == rf"{2 * rise - run:.0f} & = & 2 & \cdot & {rise:.0f} & - & {run:.0f}"
    named = {variable.name: variable.now for variable in variables(first)}
    assert (named["dx"], named["dy"]) == (run, rise)
    moved = next(each for each in steep if each.key == "raster.bresenham-step.step")
    assert f"so y (the column) steps to {moved.values['minor']:.0f}." in sentence(moved, 0, None)
