"""Of a segment or point nothing is said that only a triangle has."""

import re

import pytest

from core import STAGES, Settings, trace
from core.explain.latex import plain_text
from core.explain.steps import formula, sentence, variables
from core.lines.drawing import point_listing
from lessons.scenes import make_scene
from tests.core.explain.explained_steps import steps_of


@pytest.mark.parametrize("interpolation", ["perspective", "affine", "flat"])
@pytest.mark.parametrize(("name", "corners"), [("segment", 2), ("points", 1)])
def test_no_corner_is_named_that_is_not_there(name: str, corners: int, interpolation: str) -> None:
    traced = trace(make_scene(name), Settings(interpolation=interpolation))
    # A 2 below a symbol, or at the end of a name, is a third corner.
    missing = re.compile(rf"(?<![\d.(−-])[^\W\d]+(?:_| )?[{corners}-2]\b|_[{corners}-2]\b|third")
    for explanation, _, _ in steps_of(traced):
        made = formula(explanation)
        said = [variable.name for variable in variables(explanation)]
        said += [made.symbolic] if made is not None and explanation.key.startswith("interpolate") else []
        assert not [text for text in said if missing.search(text)], explanation.key
    for stage in STAGES:
        assert not [track.name for track in traced.stage(stage).buffers if missing.search(track.name)]


def test_a_value_along_an_edge_is_that_of_its_ends() -> None:
    """In the colours of the corners between which the edge runs: edge 1 from corner 2 to corner 0."""
    traced = trace(make_scene("single-triangle"), Settings(polygon_mode="wireframe")).stage("interpolate")
    row = int((traced.columns["edge"] == 1).argmax()) + 1
    explanation = traced.explain(traced.steps.position_after(row))
    assert explanation is not None
    made = formula(explanation)
    assert re.fullmatch(r". = \(1 − s\) · (.)_0 \+ s · \1_1", plain_text(made.symbolic)), made.symbolic
    assert re.findall(r"\\vertex\{(\d)\}", made.symbolic) == ["2", "0"]


@pytest.mark.parametrize("line", ["bresenham", "midpoint", "wu"])
@pytest.mark.parametrize("pixel_center", ["half", "integer"])
def test_a_point_has_its_pixel_and_no_decision_of_a_line(line: str, pixel_center: str) -> None:
    stage = trace(make_scene("points"), Settings(line=line, pixel_center=pixel_center)).stage("raster")
    center = stage.constants["center"]
    for row, pixel in enumerate(stage.pixel.tolist()):
        x, y = stage.columns["window_start"][row].tolist()
        assert point_listing(x, y, center) == [tuple(pixel)]
        for position in range(int(stage.steps.starts[row]) + 1, int(stage.steps.starts[row + 1]) + 1):
            made = stage.explain(position)
            assert made is not None
            text = sentence(made, int(stage.triangle[row]), (pixel[0], pixel[1]))
            assert f"oint {stage.triangle[row]} " in text or f"point {stage.triangle[row]}." in text
            assert not {"D", "dx", "m", "y", "first end"} & {variable.name for variable in variables(made)}
    assert stage.kind_of(0) == "point"
