"""Exact areas against polygons clipped in fractions, and the ideal line against its equation."""

from fractions import Fraction

import numpy as np
import pytest

from core.coverage.measured_exactly import area_in_pixels
from core.lines.drawing import draw_lines
from core.lines.measured import distance_from_line, line_areas, line_rectangles
from core.study.workloads import random_lines


def clipped_area(polygon, column: int, row: int) -> float:
    """Clip a polygon against the square of a pixel in fractions, side by side, and measure it (shoelace)."""
    points = [(Fraction(float(x)), Fraction(float(y))) for x, y in polygon]
    for axis, low, keeps_above in (
        (0, column, True),
        (0, column + 1, False),
        (1, row, True),
        (1, row + 1, False),
    ):
        kept = []
        for start, end in zip(points, points[1:] + points[:1], strict=True):
            inside = [(p[axis] >= low) == keeps_above or p[axis] == low for p in (start, end)]
            if inside[0]:
                kept.append(start)
            if inside[0] != inside[1] and start[axis] != end[axis]:
                t = (low - start[axis]) / (end[axis] - start[axis])
                kept.append(tuple(s + t * (e - s) for s, e in zip(start, end, strict=True)))
        points = kept
        if not points:
            return 0.0
    doubled = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(points, points[1:] + points[:1], strict=True))
    return float(doubled / 2)


def test_areas_are_those_of_clipped_polygons() -> None:
    polygon = np.array([[0.3, 0.2], [4.6, 1.1], [3.9, 4.4], [1.0, 3.7]])
    row, column = (index.ravel() for index in np.mgrid[0:5, 0:6])
    expected = [clipped_area(polygon, i, j) for i, j in zip(column.tolist(), row.tolist(), strict=True)]
    assert area_in_pixels(polygon, column, row) == pytest.approx(expected, abs=1e-14)
    assert sum(expected) == pytest.approx(11.95, abs=2)


@pytest.mark.parametrize("corners", [[[1, 1], [3, 1], [3, 2], [1, 2]], [[0, 0], [4, 0], [0, 4]]])
def test_sides_along_the_pixels_and_through_their_corners(corners) -> None:
    polygon = np.array(corners, float)
    row, column = (index.ravel() for index in np.mgrid[0:4, 0:4])
    expected = [clipped_area(polygon, i, j) for i, j in zip(column.tolist(), row.tolist(), strict=True)]
    assert area_in_pixels(polygon, column, row) == pytest.approx(expected, abs=1e-15)


def test_the_pixels_of_a_line_have_its_area() -> None:
    ends = random_lines((64, 64), 12, 20.0, 3, is_on_centers=False)
    owner, column, row, area = line_areas(ends, (64, 64))
    along = ends[:, 1] - ends[:, 0]
    inside = (line_rectangles(ends) >= 0).all(axis=(1, 2)) & (line_rectangles(ends) <= 64).all(axis=(1, 2))
    assert inside.any()
    lengths = np.hypot(*along.T)
    assert np.bincount(owner, area, 12)[inside] == pytest.approx(lengths[inside], abs=1e-9)
    some = slice(0, len(owner), 7)
    rectangles = line_rectangles(ends)
    expected = [
        clipped_area(rectangles[k], i, j)
        for k, i, j in zip(owner[some].tolist(), column[some].tolist(), row[some].tolist(), strict=True)
    ]
    assert area[some] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("line", ["bresenham", "midpoint", "diamond-exit"])
def test_distance_from_the_line_is_that_of_its_equation(line: str) -> None:
    ends = random_lines((64, 64), 9, 30.0, 8, is_on_centers=False)
    drawn = draw_lines(ends, 64, 64, line)
    column, row = drawn.pixels.T
    distance, step = distance_from_line(ends, drawn.owner, column, row, drawn.intensities)
    assert len(distance) == len(column)
    for value, place in zip(distance.tolist(), step.tolist(), strict=True):
        (x0, y0), (x1, y1) = [[Fraction(float(n)) for n in end] for end in ends[drawn.owner[place]]]
        x, y = Fraction(2 * int(column[place]) + 1, 2), Fraction(2 * int(row[place]) + 1, 2)
        if abs(y1 - y0) > abs(x1 - x0):
            x0, y0, x1, y1, x, y = y0, x0, y1, x1, y, x
        expected = abs(y - (y0 + (x - x0) * (y1 - y0) / (x1 - x0)))
        assert value == pytest.approx(float(expected), abs=1e-12)


def test_two_pixels_of_one_step_are_their_mean() -> None:
    ends = np.array([[[0.5, 1.0], [4.5, 1.0]]])
    column, row = np.array([1, 1]), np.array([0, 1])
    distance, _ = distance_from_line(ends, np.zeros(2, int), column, row, np.array([0.5, 0.5]))
    assert distance.tolist() == [0.0]
