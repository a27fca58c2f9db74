"""Where two runs part, a sentence says in what, in the field's words or by the names that the variables have."""

import re

import numpy as np
import pytest

from app.pages.step.ab.pictures import DIFFERING, divergence_text
from core import Settings, trace
from core.edits.edit import Edit, apply_edit, original
from core.edits.editable import EDITABLE
from core.settings import with_method
from core.stages.declared import DECLARED
from core.study.divergence import diverge
from lessons.scenes import make_scene

CASES = {
    "fill": ("bounding-box", "shared-edge", "value > 0 or", "value >= 0 or", "coverage"),
    "interpolation": (
        "perspective",
        "intersecting",
        "value = ",
        "value = 0.5 * ",
        "the interpolated values and .*",
    ),
    "cull": ("back-normal", "cube", "product > 0", "product < 0", "which test drops it and the verdict"),
    "depth": ("z-16", "intersecting", "return", "return 0.5 *", "the stored depth and .*"),
    "line": ("bresenham", "segment", "D = 2 * dy - dx", "D = 2 * dy - dx + 9", "B has no step there"),
}
"""Part to method, scene, a change of its listing, and the words."""


@pytest.mark.parametrize("part", CASES)
def test_what_differs_first_is_named_in_words(part: str) -> None:
    of, name, old, new, words = CASES[part]
    scene, plain = make_scene(name), with_method(Settings(), EDITABLE[part].family, of)
    edited = apply_edit(plain, Edit(part, of, original(part, of).source.replace(old, new, 1)))
    runs = trace(scene, plain), trace(scene, edited)
    said = divergence_text(diverge(*runs), *runs)
    assert re.search(rf"(differ in |: )({words})\. Ctrl", said), said
    assert "_" not in said


def test_every_outcome_of_a_stage_has_words() -> None:
    assert {name for stage in DECLARED for name in stage.outcomes} <= DIFFERING.keys()


def test_a_depth_test_that_keeps_the_wrong_depth_parts_where_it_is_kept() -> None:
    scene, plain = make_scene("intersecting"), Settings(depth="z-float32")
    source = original("depth_test", "z-float32").source.replace(
        "return new if writes else old, True", "return old, True"
    )
    runs = trace(scene, plain), trace(scene, apply_edit(plain, Edit("depth_test", "z-float32", source)))
    found = diverge(*runs, by_outcome=True)
    kept = [run.stage("depth").columns["after"] for run in runs]
    assert (found.stage, found.rows[0]) == ("depth", int(np.flatnonzero(kept[0] != kept[1])[0]))
    assert "the depth that is kept" in divergence_text(found, *runs)
    # Where no outcome is compared, a buffer that differs is named all the same.
    assert "differs in the stage depth" in divergence_text(None, *runs)
