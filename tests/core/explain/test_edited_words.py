"""A step of an edited listing is explained by its own lines: what they do, with which numbers, and what comes out."""

from itertools import pairwise

import numpy as np
import pytest

from core import Settings, trace
from core.edits.edit import Edit, apply_edit, original
from core.explain.latex import split_cells
from core.explain.steps import formula, load_subjects, sentence, variables
from core.records.listing import EditedListing
from core.trace.stage_trace import StageTrace
from lessons.scenes import make_scene

SHARED = "shared-edge"


def edited(scene: str, part: str, of: str, old: str, new: str, stage: str, **choices: str) -> StageTrace:
    """Trace a stage with one place of a listing changed."""
    text = original(part, of).source
    assert old in text
    settings = apply_edit(Settings(**choices), Edit(part, of, text.replace(old, new)))
    return trace(make_scene(scene), settings).stage(stage)


def test_the_numbers_of_a_step_are_those_of_the_trace():
    found = edited(SHARED, "fill", "bounding-box", "value > 0", "value > 5", "raster", fill="bounding-box")
    covered = found.columns["covered"]
    for row in np.flatnonzero(covered != (found.columns["values"] > 0).all(axis=1))[:2].tolist():
        position = int(found.steps.starts[row + 1])
        made = found.explain(position)
        held = {variable.name: variable.now for variable in variables(made)}
        assert [held[f"values[{k}]"] for k in range(3)] == found.columns["values"][row].tolist()
        assert sentence(made, 0, None).endswith(f"{'true' if covered[row] else 'false'}.")


def test_only_its_own_variables_are_shown_and_the_given_ones_last():
    found = edited("segment", "line", "bresenham", "D >= 0", "D > 0", "raster", line="bresenham")
    names = [variable.name for variable in variables(found.explain(found.steps.count))]
    assert names[:2] == ["column", "row"]
    assert {"D", "dx", "dy", "x", "y"} <= set(names)
    assert not {"slope", "run", "rise", "distance"} & set(names)
    assert names.index("D") < names.index("x0")


def test_a_line_steps_through_the_lines_that_ran_in_their_order():
    found = edited("segment", "line", "bresenham", "D >= 0", "D > 0", "raster", line="bresenham")
    first = [found.explain(position) for position in range(1, int(found.steps.starts[3]) + 1)]
    texts = [sentence(made, -1, None) for made in first]
    assert all(f"ine {made.line}" in text for made, text in zip(first, texts, strict=True))
    assert not any("does not run here" in text for text in texts)
    drawn = [text for text in texts if "into pixels" in text]
    pixels = found.pixel[:3].tolist()
    assert [text.split(" puts (")[1].split(", ")[:2] for text in drawn] == [
        [str(x), str(y)] for x, y in pixels
    ]


@pytest.mark.parametrize(
    ("scene", "part", "of", "old", "new", "stage", "choices"),
    [
        (
            SHARED,
            "interpolation",
            "affine",
            "n[k] / total",
            "n[k] / n[1]",
            "interpolate",
            {"interpolation": "affine"},
        ),
        ("intersecting", "depth_test", "z-float32", "new < old", "new <= old", "depth", {}),
        (SHARED, "blend", "over", "1 - alpha", "1", "blend", {"blend": "over"}),
        (SHARED, "fill_rule", "shared-edge", "a > 0", "a >= 0", "edges", {}),
        ("segment", "line", "dda", "0.5", "0.25", "raster", {"line": "dda"}),
    ],
)
def test_every_family_is_told_by_its_own_lines(scene, part, of, old, new, stage, choices):
    load_subjects()
    text = original(part, of).source
    if old not in text:
        pytest.fail(text)
    found = edited(scene, part, of, old, new, stage, **choices)
    seen = 0
    for position in range(1, min(found.steps.count, 200) + 1):
        made = found.explain(position)
        if not isinstance(made.listing, EditedListing) or not made.line:
            continue
        told = sentence(made, -1, None)
        assert "ine " in told
        assert "does not run here" not in told, (made.key, told)
        shown = formula(made)
        cells = [split_cells(line) for line in (shown.symbolic, shown.substituted)]
        assert len(cells[0]) == len(cells[1])
        seen += 1
    assert seen


def test_inputs_of_a_row_give_the_row():
    found = edited(SHARED, "interpolation", "perspective", "n[k] / total", "n[k] / n[0]", "interpolate")
    for start, _ in list(pairwise(found.steps.starts.tolist()))[:40:7]:
        made = found.explain(start + 3)
        held = {variable.name: variable.now for variable in variables(made)}
        row = found.steps.row_at(start + 3)[0]
        assert [held[f"weights[{k}]"] for k in range(3)] == found.columns["weights"][row].tolist()
