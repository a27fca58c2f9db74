"""Primitives from vertices: written-out strips and fans, exact areas of polygons, and what is refused."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import render
from core.transform import assembly

SQUARE = [[0.0, 0], [4, 0], [4, 4], [0, 4]]
ARROW = [[0.0, 0], [4, 2], [0, 4], [1, 2]]
COMB = [[0.0, 0], [5, 0], [5, 4], [4, 1], [3, 4], [2, 1], [1, 4], [0, 1]]
FLAT = [[0.0, 0], [2, 0], [4, 0], [4, 4], [2, 4], [0, 4], [0, 2]]


def doubled_area(points: list) -> Fraction:
    pairs = zip(points, [*points[1:], points[0]], strict=True)
    return sum(Fraction(a[0]) * Fraction(b[1]) - Fraction(a[1]) * Fraction(b[0]) for a, b in pairs)


def test_strips_fans_and_quads_are_those_of_opengl() -> None:
    assert assembly.line_strip(4).tolist() == [[0, 1], [1, 2], [2, 3]]
    assert assembly.line_loop(3).tolist() == [[0, 1], [1, 2], [2, 0]]
    assert assembly.triangle_strip(6).tolist() == [[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 5]]
    assert assembly.triangle_fan(5).tolist() == [[0, 1, 2], [0, 2, 3], [0, 3, 4]]
    assert assembly.quads(8).tolist() == [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]


@pytest.mark.parametrize("corners", [SQUARE, ARROW, COMB, FLAT])
@pytest.mark.parametrize("step", [1, -1])
def test_the_triangles_of_a_polygon_have_its_area_and_its_winding(corners: list, step: int) -> None:
    corners = corners[::step]
    whole = doubled_area(corners)
    parts = [doubled_area([corners[k] for k in triangle]) for triangle in assembly.polygon(corners).tolist()]
    assert sum(parts) == whole
    assert all(part * whole >= 0 for part in parts)


@given(st.lists(st.tuples(st.integers(1, 9), st.integers(0, 1)), min_size=3, max_size=12))
def test_a_star_is_filled_exactly_once(radii: list) -> None:
    """Corners around a centre at rising angles make a simple polygon, however far each is."""
    angles = np.linspace(0, 2 * np.pi, len(radii), endpoint=False)
    corners = (
        np.array([r for r, _ in radii])[:, None] * np.stack([np.cos(angles), np.sin(angles)], 1)
    ).tolist()
    parts = [doubled_area([corners[k] for k in triangle]) for triangle in assembly.polygon(corners).tolist()]
    assert len(parts) == len(corners) - 2
    assert sum(parts) == doubled_area(corners)
    assert min(parts) >= 0


@pytest.mark.parametrize("name", assembly.ASSEMBLIES)
def test_shared_vertices_draw_no_pixel_twice(name: str) -> None:
    if name == "triangles":
        return
    corners = np.array(ARROW if name in ("polygon", "line-loop") else SQUARE)
    if name == "triangle-strip":
        corners = corners[[0, 1, 3, 2]]
    clip = np.concatenate([corners / 2 - 1, np.zeros((4, 1)), np.ones((4, 1))], axis=1)
    scene = assembly.assemble(name, clip, np.eye(4), size=(8, 8))
    assert scene.shared is not None
    frame = render(scene)
    assert frame.cover_count.max() == 1
    if name in ("triangle-strip", "triangle-fan", "quads"):
        assert (frame.cover_count == 1).all()


@pytest.mark.parametrize(
    ("corners", "message"),
    [
        ([[0, 0], [2, 2], [2, 0], [0, 2]], "must not cross or touch itself, but side 0 meets side 2"),
        ([[0, 0], [4, 0], [2, 0]], "must not cross or touch itself"),
        ([[0, 0], [4, 0], [4, 4], [2, 0], [0, 4]], "must not cross or touch itself"),
        ([[0, 0], [0, 0], [4, 4]], "no two equal corners in turn"),
        ([[0, 0], [4, 4]], "a polygon needs at least 3 vertices, got 2"),
    ],
)
def test_a_polygon_that_is_not_simple_is_refused(corners: list, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        assembly.polygon(corners)


@pytest.mark.parametrize(
    ("name", "clip", "message"),
    [
        ("line-strip", np.ones((1, 4)), "a line strip needs at least 2 vertices, got 1"),
        ("quads", np.ones((6, 4)), "the number of vertices must be a multiple of 4, got 6"),
        ("polygon", [[0, 0, 0, 1], [1, 0, 0, 1], [0, 1, 0, 0]], "a polygon needs all w above 0"),
        ("segments", np.ones((3, 4)), "the number of vertices must be a multiple of 2, got 3"),
        ("star", np.ones((3, 4)), "name must be one of points, segments"),
    ],
)
def test_what_cannot_be_assembled_is_refused(name: str, clip: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        assembly.assemble(name, clip)
