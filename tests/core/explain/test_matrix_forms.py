"""Zwicker's forms in numbers: the inverse beside its matrix, u/w and 1/w as planes, the scale of an edge function."""

import numpy as np

from core import Settings, trace
from core.explain import formula, sentence
from core.explain.latex import plain_text
from core.trace import StageTrace
from lessons.slides.scenes import ALL_SCENES


def last_of(stage: StageTrace, key: str) -> tuple[str, str, str]:
    """Return the sentence of the last operation with a key, and both lines of its formula."""
    for position in range(stage.steps.count, 0, -1):
        explanation = stage.explain(position)
        if explanation is not None and explanation.key == key:
            row, _ = stage.steps.row_at(position)
            made = formula(explanation)
            assert made is not None
            column, line = stage.pixel[row].tolist()
            said = sentence(explanation, int(stage.triangle[row]), (column, line))
            return said, made.symbolic, made.substituted
    raise AssertionError(f"no {key}")


def matrices(latex: str) -> list[list[list[str]]]:
    """Return the rows of the matrices of a line."""
    found = latex.split(r"\begin{pmatrix}")[1:]
    return [
        [[cell.strip() for cell in row.split("&")] for row in each.split(r"\end{pmatrix}")[0].split(r"\\")]
        for each in found
    ]


def test_the_inverse_stands_beside_its_matrix_with_all_three_columns() -> None:
    stage = trace(ALL_SCENES["zwicker-4x3"].make(), Settings(coverage="inverse")).stage("edges")
    said, _, numbers = last_of(stage, "edges.inverse-edge.c")
    corners, inverse, unit = (np.array(each, float) for each in matrices(numbers))
    assert corners.tolist() == [[0, 0, 1], [4, 0, 1], [0, 3, 1]]
    assert np.allclose(corners @ inverse, np.eye(3), atol=1e-3)
    assert unit.tolist() == np.eye(3).tolist()
    assert "α, β and γ: 1, 0, 0 and 0, 1, 0 and 0, 0, 1 at corners 0, 1 and 2." in said


def test_a_texture_coordinate_has_its_planes_in_symbols_and_numbers() -> None:
    stage = trace(ALL_SCENES["zwicker-perspective"].make(), Settings()).stage("interpolate")
    said, symbols, _ = last_of(stage, "interpolate.perspective.value-uv")
    assert "u/w = A_u · x + B_u · y + C_u" in plain_text(symbols)
    assert "1/w = A_w · x + B_w · y + C_w" in plain_text(symbols)
    assert "u/w over 1/w, which are A x + B y + C each" in said


def test_an_edge_function_says_on_which_scale_it_is() -> None:
    stage = trace(ALL_SCENES["zwicker-4x3"].make(), Settings(fill="bounding-box")).stage("raster")
    said, _, _ = last_of(stage, "raster.test.edge-0")
    assert said.endswith("at corner 0 it is 2A = 12.")
