"""Every operation that a tracer declares has a row; every question has the right answer."""

import re

import numpy as np
import pytest

from core import STAGES, Settings
from core.explain.step_values import ROWS, explains, row_key
from core.explain.steps import load_subjects, question, row_of
from core.methods import table
from lessons.lectures.catalogue import PRINTED
from tests.core.explain.explained_steps import all_steps, fewest_traces, line_trace, traces
from tests.covering import is_everything


def declared_keys() -> set[str]:
    """Return the keys of all operations that the traces declare, whether or not a row does them."""
    found = set()
    for traced in (*traces()["scenes"].values(), *traces()["rare"].values()):
        for name in STAGES:
            for kind, operations in traced.stage(name).steps.operations.items():
                found |= {row_key(f"{name}.{kind}.{operation.name}") for operation in operations}
    for method in (printed.method for printed in PRINTED if printed.method is not None):
        for kind, operations in method.operations.items():
            found |= {row_key(f"raster.{kind}.{operation.name}") for operation in operations}
    return found


def test_every_operation_has_a_row_and_every_row_an_operation() -> None:
    declared = declared_keys()
    assert {key for key in declared if row_of(key) is None} == set(), "operations without a row"
    used = {key if key in ROWS else re.sub(r"\.[^.]+\.", ".*.", key, count=1) for key in declared}
    assert set(ROWS) - used == set(), "rows of operations that no stage does"


def test_a_key_has_one_row() -> None:
    load_subjects()
    with pytest.raises(ValueError, match=r"depth\.\*\.compare has a row already, in core.depth.told"):
        explains("depth.*.compare")(lambda step: "")


def answer_of_transform(values: dict) -> float:
    """Of a piece whether it stays one, of a bound the number of pieces, else x after the step."""
    if values.get("halvings", -1) >= 0:
        return values["parts"] != 0 if "parts" in values else 1 - values["is_flat"]
    return values["count"] if values.get("count", -1) >= 0 else values["after"][0]


def answer_of_depth(values: dict) -> float:
    """Of a hit that is appended how long its list is; else whether a box is opened, or a fragment kept."""
    if values.get("place") == -1 and values["length"] > 0:
        return values["length"]
    return 1 - values["is_opened" if values.get("is_box") else "passes"]


ANSWERS = {
    "transform": answer_of_transform,
    "edges": lambda values: values["a"],
    "bin": lambda values: {"outside": 0, "inside": 1}.get(values["verdict"], 2),
    "raster": lambda values: 1 - values["covered"],
    "interpolate": lambda values: values["weights"][0] if "s" not in values else values["s"],
    "depth": answer_of_depth,
    "blend": lambda values: values["after"][0],
    "resolve": lambda values: (
        values["bytes"][0] if values["column"] >= 0 else values["above"] == values["picture"]
    ),
}
"""What is right, by stage, from the numbers of the row."""
OF_THE_ORDER = {
    "swap": lambda values: values["distance"] <= values["other_distance"],
    "place": lambda values: values["distance"] <= values["other_distance"],
    "walk": lambda values: values["plane"][2] < 0,
} | {side: lambda values, place=place: place for place, side in enumerate(("on", "front", "back", "cut"))}
"""The same by kind, for the rows of the drawing order before those of the depth test."""


def test_questions_are_finished_and_have_the_right_answer() -> None:
    asked_about = set()
    for traced in fewest_traces():
        for name in STAGES:
            stage = traced.stage(name)
            for row in range(0, stage.steps.row_count, 1 + stage.steps.row_count // 6):
                asked = question(stage, row)
                if asked is None:
                    continue
                asked_about.add(name)
                assert asked.text.endswith("?"), asked
                assert re.fullmatch(r".*[^.]\.", asked.reveal), asked
                assert not re.search(r"nan|None|array|-\d|_", asked.text + asked.reveal), asked
                values = stage.variables(row)
                if name == "depth" and stage.pixel[row, 0] < 0:
                    assert asked.answer == OF_THE_ORDER[stage.kind_of(row)](values), (asked, values)
                elif stage.kind_of(row) == "list-front":
                    assert asked.answer == stage.triangle[row]
                elif name in ANSWERS and not {"has_stepped", "is_inside", "threshold"} & {*values}:
                    assert asked.answer == float(np.asarray(ANSWERS[name](values))), (asked, values)
                assert not asked.choices or asked.answer in range(len(asked.choices)), asked
    assert asked_about == set(STAGES)


@pytest.mark.parametrize("line", table.names("line"))
def test_every_pixel_of_a_line_asks_for_what_decides_it(line: str) -> None:
    stage = line_trace(Settings(polygon_mode="wireframe", line=line)).stage("raster")
    answers = set()
    for row in range(stage.steps.row_count):
        asked, values = question(stage, row), stage.variables(row)
        is_first, line_of_row = stage.kind_of(row).endswith("-start"), values["minor"]
        if asked is None:
            assert (line, is_first) == ("bresenham-float", True)  # Its first e is 0.
            continue
        wanted = {
            "rectangle": abs(values["decision"]),
            "wu": values["intensity"],
            "gupta-sproull": values.get("entry"),
        }.get(line, line_of_row)
        if line.startswith("bresenham"):
            wanted = 2 * values["rise"] - values["run"] if is_first else 1 - values["has_stepped"]
            assert bool(asked.choices) != is_first
        assert asked.answer == wanted
        answers.add(asked.answer)
    assert len(answers) > 1


def test_every_kind_of_row_that_decides_can_be_asked_about() -> None:
    load_subjects()
    kinds = {key.rpartition(".")[0] for key, row in ROWS.items() if row.decides}
    asking = {key.rpartition(".")[0] for key, row in ROWS.items() if row.asks is not None}
    assert kinds - asking == set()


UNMARKED = {
    *("depth.discarded.discard", "depth.tree-hidden.hide"),
    *("edges.homogeneous.keep", "edges.orientation.area", "edges.snapped.window"),
    *("clip.untouched.keep", "bin.whole-image.keep"),
    *("shade.lit.albedo", "shade.mirror.albedo", "shade.textured-lit.interpolated"),
    *("depth.cell.depth", "depth.store.depth"),
    *("cull.no-occluder.none", "cull.pyramid-bottom.drawn"),
    *("resolve.mixed.history", "resolve.limited.history"),
    *(f"blend.{kind}.source" for kind in ("over", "additive", "line-over", "line-additive")),
}
"""Operations that no line of a listing does: what they do is to copy, or to take what is known already."""


def test_every_operation_marks_a_line_but_those_that_copy() -> None:
    unmarked = {explanation.key for explanation, _, _ in all_steps() if not explanation.line}
    missing = UNMARKED - unmarked if is_everything() else set()
    assert (unmarked - UNMARKED, missing) == (set(), set())
