"""Where two shaders part ways, and what is said of it."""

from dataclasses import replace

import numpy as np
import pytest

from app.pages.step.ab.pictures import ROUNDED, divergence_text
from core import Settings, trace
from core.shaders.presets import preset_program
from core.study.divergence import diverge
from lessons.scenes import make_scene

FLOOR = replace(make_scene("lit-floor"), size=(24, 18))
PHONG = preset_program("phong", FLOOR)


def _traced(stage="", old="", new=""):
    """Return a trace of the Phong shaders with an edit; without a stage, of the built-in shading."""
    program = replace(PHONG, **{stage: getattr(PHONG, stage).replace(old, new)}) if stage else None
    return trace(replace(FLOOR, program=program), Settings())


@pytest.mark.parametrize(
    ("stage", "old", "new", "variable", "said"),
    [
        (
            "fragment",
            "dot(N, L)",
            "0.5 * dot(N, L)",
            "cosine",
            "There, cosine is the first variable that differs: ",
        ),
        ("fragment", "normalize(vNormal)", "2.0 * vNormal", "N", "in A (line 29) and "),
        (
            "fragment",
            "vec4(light, 1.0)",
            "vec4(light.rrr, 0.5)",
            "outColor",
            "in B (line 35). Ctrl+[ goes back.",
        ),
        (
            "vertex",
            "normalMatrix * normal",
            "normal",
            "vNormal",
            "At vertex 0 of triangle 0, vNormal is the first",
        ),
    ],
)
def test_the_first_variable_that_differs_is_named_with_the_pixel_of_the_colour(
    stage, old, new, variable, said
):
    first, second = _traced("fragment"), _traced(stage, old, new)
    found = diverge(first, second, by_outcome=True, since="transform")
    assert (found.variable, found.stage) == (variable, "shade" if stage == "fragment" else "transform")
    for run, row in zip((first, second), found.rows, strict=True):
        assert run.stage(found.stage).columns["line"][row] == found.lines[0]
    text = divergence_text(found, first, second)
    assert said in text

    # The pixel is the first one, in drawing order, of another colour.
    colors = [run.source.surface.color for run in (first, second)]
    k = int(np.flatnonzero((colors[0] != colors[1]).any(axis=1))[0])
    fragments = first.source.fragments
    assert f"The colour differs first at pixel ({fragments.column[k]}, {fragments.row[k]})." in text


def test_a_shader_and_the_built_in_shading_differ_by_more_than_rounding_or_not():
    assert (
        divergence_text(
            diverge(_traced("fragment"), _traced(), by_outcome=True), _traced("fragment"), _traced()
        )
        == ROUNDED
    )
    wrong = _traced("fragment", "dot(N, L)", "0.5 * dot(N, L)")
    found = diverge(wrong, _traced(), by_outcome=True)
    assert (found.stage, found.names) == ("shade", ("color",))
    assert "A and B differ in the colour." in divergence_text(found, wrong, _traced())


def test_the_same_values_by_other_statements_are_no_difference():
    other = _traced("fragment", "vec3 V =", "float unused = 1.0;\n   vec3 V =")
    assert diverge(_traced("fragment"), other, by_outcome=True) is None
