"""Sentences of a few steps whose numbers were worked out by hand."""

import re

import numpy as np
import pytest

from core import ClipScene, Settings, trace
from core.antialiasing import traced_areas
from core.explain.steps import formula, sentence
from lessons.scenes import make_scene

# The triangle with window corners (1, 1), (7, 1), (1, 7) on 8 x 8 pixels, by hand:
# E0 = -6 x - 6 y + 48 (right edge), E1 = 6 x - 6 (left edge), E2 = 6 y - 6 (level bottom edge).


AREA = Settings(antialiasing="area")


def test_cuts_that_are_left_out_are_said_to_be(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(traced_areas, "MOST_NUMBERS", 1)
    found = trace(ClipScene([[[-1, -1, 0, 1], [1, -1, 0, 1], [-1, 1, 0, 1]]], size=(1, 1)), AREA).stage(
        "resolve"
    )
    explained = found.explain(1)
    assert explained is not None
    assert sentence(explained, -1, (0, 0)) == (
        "Pixel (0, 0): edges cut it into 2 pieces, and triangles cover 0.5 of its area; to step through the cuts, "
        "trace one triangle or a smaller part of the picture."
    )


def test_a_shared_vertex_has_its_number_in_the_triangle_and_that_in_the_scene() -> None:
    """As its disc is labelled: the second triangle of a quad has corner 1 at the quad's vertex 2."""
    traced = trace(make_scene("textured-floor"), Settings()).stage("transform")
    row = int(np.flatnonzero(traced.columns["corner"] != traced.columns["vertex"])[0])
    corner, vertex = (int(traced.columns[name][row]) for name in ("corner", "vertex"))
    explanation, triangle = traced.explain(int(traced.steps.starts[row]) + 1), int(traced.triangle[row])
    assert explanation is not None
    said = sentence(explanation, triangle, None)
    assert said.startswith(f"Vertex {corner} of triangle {triangle} (vertex {vertex} of the scene): ")


def test_the_matrix_of_corners_times_a_column_of_its_inverse() -> None:
    """One for the corner of the edge function, and zero for the others."""
    settings = Settings(fill="bounding-box", coverage="inverse")
    traced = trace(make_scene("single-triangle"), settings).stage("edges")
    steps = [traced.explain(position) for position in range(1, traced.steps.count + 1)]
    last = [e for e in steps if e is not None and e.key == "edges.inverse-edge.c"]
    for k, explanation in enumerate(last):
        made = formula(explanation)
        parts = ([row.split(" & ") for row in rows] for rows in matrices(made.substituted))
        corners, columns, unit = (np.array(part, float) for part in parts)
        wanted = np.eye(3)[:, [k]] if k < 2 else np.eye(3)
        assert np.allclose(corners @ columns, wanted, atol=0.03)
        assert np.array_equal(unit, wanted)
    assert len(last) == 3


def matrices(latex: str) -> list[list[str]]:
    """Return the rows of every matrix in a formula."""
    found = re.findall(r"\\begin\{pmatrix\} (.*?) \\end\{pmatrix\}", latex)
    return [part.split(r" \\ ") for part in found]
