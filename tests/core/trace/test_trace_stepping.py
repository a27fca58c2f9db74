"""Stepping over traces: nested ends, forward and back on all levels, laziness, errors."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import STAGES, ClipScene, Settings, trace
from core.methods import table
from core.records.listing import Operation
from core.records.steps import Level, Steps, ends_of
from core.trace.stage_trace import MARKS, StageTrace
from tests.core.trace.trace_cases import EACH_METHOD, SCENES, name_of, settings_of, small_region
from tests.covering import in_turn

LEVELS = list(Level)
WITHOUT_LISTING = {
    *("clip.untouched.keep", "blend.opaque.write", "bin.whole-image.keep", "bin.behind.drop"),
    *("edges.homogeneous.keep", "edges.orientation.area"),
    *("cull.no-occluder.none", "cull.pyramid-bottom.drawn"),
}
"""Steps without a listing: nothing is done, what is there is kept, stored as it is, or drawn by a pass of its own."""


def traces_of(name: str, choice: dict[str, str]) -> list[StageTrace]:
    scene = SCENES[name]
    traced = trace(scene, settings_of(choice, scene), region=small_region(scene))
    return [traced.stage(stage) for stage in STAGES]


def positions_of(steps: Steps, count: int = 40) -> list[int]:
    """Return both ends and positions between them, on boundaries and off."""
    between = np.random.default_rng(steps.count).integers(0, steps.count + 1, count)
    return sorted({0, min(1, steps.count), max(steps.count - 1, 0), steps.count, *between.tolist()})


def check_ends(steps: Steps) -> None:
    rows = steps.row_count
    for ends in (steps.triangle_ends, steps.group_ends):
        assert ends[-1] == rows
        assert (np.diff(ends) > 0).all()
        assert rows == 0 or ends[0] > 0
    assert np.isin(steps.triangle_ends, steps.group_ends).all()
    assert (np.diff(steps.starts) > 0).all()
    for level, finer in pairwise(LEVELS):
        assert np.isin(steps.boundaries(level), steps.boundaries(finer)).all(), (level, finer)
    for level in LEVELS:
        boundaries = steps.boundaries(level)
        assert boundaries[0] == 0
        assert boundaries[-1] == steps.count
        assert len(boundaries) == 1 or (np.diff(boundaries) > 0).all()


def check_moves(steps: Steps, level: Level, position: int) -> None:
    boundaries = steps.boundaries(level)
    ahead, behind = steps.forward(position, level), steps.back(position, level)
    later, earlier = boundaries[boundaries > position], boundaries[boundaries < position]
    assert ahead == (later[0] if len(later) else steps.count)
    assert behind == (earlier[-1] if len(earlier) else 0)
    if position in boundaries:
        assert position == steps.count or steps.back(ahead, level) == position
        assert position == 0 or steps.forward(behind, level) == position


def check_explanations(found: StageTrace) -> None:
    """Check that explanations name variables that are known, and lines that exist."""
    kinds_seen = np.unique(found.steps.kind, return_index=True)[1]
    assert found.explain(0) is None
    for row in kinds_seen.tolist():
        kind = found.kind_of(row)
        for place, operation in enumerate(found.steps.operations[kind]):
            explained = found.explain(int(found.steps.starts[row]) + place + 1)
            assert explained.key == f"{found.stage}.{kind}.{operation.name}"
            assert set(explained.known) <= set(explained.values), explained.key
            assert set(explained.changed) <= set(explained.known), explained.key
            label = operation.label_at(found.columns, row)
            if explained.listing is None:
                assert explained.key in WITHOUT_LISTING
            elif label:
                assert explained.line == explained.listing.lines[label], (explained.key, label)
                lines = explained.listing.source.splitlines()
                assert lines[explained.line - 1].strip(), explained.key
            else:
                assert explained.line == 0, explained.key


def check_rows(steps: Steps, position: int) -> None:
    row, operation = steps.row_at(position)
    if position == 0:
        assert (row, operation) == (-1, -1)
        return
    assert steps.starts[row] + operation + 1 == position
    assert 0 <= operation < len(steps.operations[steps.kinds[steps.kind[row]]])
    is_whole = position == steps.position_after(row)
    assert steps.rows_done(position) == row + is_whole


@pytest.mark.parametrize(
    ("name", "choice"),
    in_turn(["clip", "lit", "textured-clip", "near-plane"], EACH_METHOD),
    ids=name_of,
)
def test_every_stage_steps_both_ways_and_is_explained(name, choice):
    for found in traces_of(name, choice):
        check_explanations(found)
        check_ends(found.steps)
        for position in positions_of(found.steps, 6):
            check_rows(found.steps, position)
            for level in LEVELS:
                check_moves(found.steps, level, position)


@pytest.mark.parametrize("name", list(SCENES))
def test_groups_and_triangles_end_where_their_keys_change(name):
    for found in traces_of(name, {}):
        ends = found.steps.triangle_ends
        if found.steps.row_count and found.stage != "resolve":
            assert np.array_equal(ends, ends_of(found.triangle)), found.stage


OPERATIONS = {"one": (Operation("a", "a"),), "three": tuple(Operation(name, name) for name in "abc")}


@st.composite
def any_steps(draw) -> Steps:
    kinds = draw(st.lists(st.integers(0, 1), max_size=12))
    triangles = np.sort(draw(st.lists(st.integers(0, 3), min_size=len(kinds), max_size=len(kinds))))
    groups = np.array(draw(st.lists(st.integers(0, 2), min_size=len(kinds), max_size=len(kinds))), np.int64)
    ends = ends_of(triangles), ends_of(triangles, groups)
    return Steps(tuple(OPERATIONS), np.array(kinds, np.int64), OPERATIONS, *ends)


@given(any_steps(), st.sampled_from(LEVELS))
def test_any_steps(steps, level):
    check_ends(steps) if steps.row_count else None
    for position in range(steps.count + 1):
        check_rows(steps, position)
        check_moves(steps, level, position)


def test_without_rows_there_is_nowhere_to_go():
    steps = Steps(("one",), np.empty(0, np.int64), OPERATIONS, ends_of(np.empty(0)), ends_of(np.empty(0)))
    for level in LEVELS:
        assert steps.boundaries(level).tolist() == [0]
        assert steps.forward(0, level) == steps.back(0, level) == 0
    assert steps.row_at(0) == (-1, -1)


def test_positions_of_a_small_case():
    steps = Steps(
        tuple(OPERATIONS), np.array([0, 1, 1, 0]), OPERATIONS, np.array([3, 4]), np.array([1, 3, 4])
    )
    assert steps.starts.tolist() == [0, 1, 4, 7, 8]
    assert [steps.boundaries(level).tolist() for level in LEVELS] == [
        [0, 8],
        [0, 7, 8],
        [0, 1, 7, 8],
        [0, 1, 4, 7, 8],
        list(range(9)),
    ]
    assert steps.row_at(3) == (1, 1)
    assert steps.rows_done(3) == 1
    assert steps.forward(3, Level.PIXEL) == 4
    assert steps.back(3, Level.PIXEL) == 1
    assert steps.back(3, Level.GROUP) == 1


@pytest.mark.parametrize("name", list(SCENES))
def test_columns_and_marks_have_a_value_a_row(name):
    scene = SCENES[name]
    bounds = np.array(scene.size)
    for found in traces_of(name, {"fill": "scanline"} if name == "lit" else {}):
        rows = found.steps.row_count
        for column, values in found.columns.items():
            assert len(values) == rows, (found.stage, column)
        assert found.triangle.shape == (rows,)
        assert found.pixel.shape == (rows, 2)
        assert (found.pixel < bounds).all()
        assert set(found.marks) <= set(MARKS)
        for mark, flags in found.marks.items():
            assert flags.shape == (rows,), (found.stage, mark)
            assert flags.dtype == bool, (found.stage, mark)
        for track in found.buffers:
            assert (np.diff(track.rows) >= 0).all(), (found.stage, track.name)
            assert len(track.rows) == len(track.places) == len(track.values)
            assert not len(track.rows) or track.rows[-1] < rows
        counts = found.summary(0, rows)
        assert 0 <= counts.pop("tested") <= rows
        assert counts.pop("samples") == int("sample" in found.columns)
        assert counts == {"rows": rows} | {mark: int(flags.sum()) for mark, flags in found.marks.items()}


@pytest.mark.parametrize("fill", table.names("fill"))
def test_marks_of_the_raster_agree_with_its_columns(fill):
    found = trace(SCENES["shared-edge"], Settings(fill=fill, fill_rule="shared-edge")).stage("raster")
    columns, marks = found.columns, found.marks
    rows = range(found.steps.row_count)
    tested = sum(found.summary(row, row + 1)["tested"] for row in rows)
    assert found.summary(0, len(rows))["tested"] == tested
    is_pixel = found.pixel[:, 1] >= 0
    assert np.array_equal(marks["covered"], columns["covered"])
    assert np.array_equal(marks["rejected"], is_pixel & ~columns["covered"])
    on_edge = (
        is_pixel & (columns["values"] == 0).any(axis=1) & (np.nan_to_num(columns["values"]) >= 0).all(axis=1)
    )
    assert np.array_equal(marks["tie"], on_edge)
    assert np.array_equal(marks["nan"], is_pixel & np.isnan(columns["values"]).any(axis=1))
    assert marks["tie"].any()
    assert marks["covered"].any()
    if fill not in ("scanline", "scanline-lecture", "spans"):
        assert marks["rejected"].any()


def test_marks_of_the_other_stages_agree_with_their_columns():
    found = {
        f.stage: f
        for f in traces_of("clip", {"cull": "back", "clipping": "sutherland-hodgman", "fill": "hierarchy"})
    }
    depth, cull, bins, clip = found["depth"], found["cull"], found["bin"], found["clip"]
    assert np.array_equal(depth.marks["depth-failed"], ~depth.columns["passes"])
    assert np.array_equal(depth.marks["covered"], depth.columns["passes"])
    assert depth.marks["depth-failed"].any()
    assert np.array_equal(cull.marks["covered"], cull.columns["verdict"] == "kept")
    assert np.array_equal(cull.marks["rejected"], cull.columns["applies"])
    is_block = bins.columns["node"] >= 0
    assert np.array_equal(bins.marks["rejected"], is_block & (bins.columns["verdict"] == "outside"))
    assert np.array_equal(bins.marks["covered"], is_block & (bins.columns["verdict"] == "inside"))
    kinds = np.array(clip.steps.kinds)[clip.steps.kind]
    assert np.array_equal(clip.marks["rejected"], kinds == "out-out")


def test_a_corner_at_w_0_is_marked_in_every_space_behind_the_division():
    scene = ClipScene([[[0, 1, 0, 0], [-1, -1, 0, 1], [1, -1, 0, 1]]], size=(4, 3))
    found = trace(scene).stage("transform")
    assert found.columns["vertex"].tolist() == [0, 0, 1, 1, 2, 2]
    assert found.marks["nan"].tolist() == [True, True, False, False, False, False]


@pytest.mark.parametrize(
    ("stage", "untouched"),
    [
        ("transform", {"_schedule", "tests", "fragments", "interpolated", "surface", "depths", "start"}),
        ("clip", {"_schedule", "tests", "fragments", "interpolated", "surface", "depths", "start"}),
        ("bin", {"tests", "fragments", "interpolated", "surface", "depths", "start"}),
        ("interpolate", {"surface", "depths", "depth_tests", "start"}),
        ("depth", {"interpolated", "surface"}),
    ],
)
def test_a_stage_that_nobody_asks_for_is_not_computed(stage, untouched):
    traced = trace(SCENES["clip"], Settings(), 2)
    assert not {"geometry", *untouched} & set(vars(traced.source))
    found = traced.stage(stage)
    assert not untouched & set(vars(traced.source))
    assert traced.stage(stage) is found


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"triangle": 10}, "triangle must be 0 to 9, got 10"),
        ({"triangle": -1}, "triangle must be 0 to 9, got -1"),
        ({"before": "later"}, "before must be earlier or cleared, got later"),
        ({"region": (12, 0, 3, 3)}, r"region must contain pixels of the 12x9 image, got \(12, 0, 3, 3\)"),
        ({"region": (3, 3, 0, 4)}, "region must contain pixels"),
        ({"region": (3, 3, -2, 4)}, "region must contain pixels"),
        ({"region": (-9, -9, 5, 5)}, "region must contain pixels"),
    ],
)
def test_errors(arguments, message):
    with pytest.raises(ValueError, match=message):
        trace(SCENES["clip"], Settings(), **arguments)


def test_a_stage_that_is_not_there():
    with pytest.raises(ValueError, match=r"stage must be one of transform, .*, got paint"):
        trace(SCENES["clip"]).stage("paint")


def test_a_scene_without_triangles_has_traces_without_rows():
    traced = trace(ClipScene(np.empty((0, 3, 4)), size=(4, 3)))
    for stage in STAGES[:-1]:
        found = traced.stage(stage)
        assert found.steps.row_count == 0, stage
        assert found.steps.count == 0
        assert found.explain(0) is None
        assert found.steps.forward(0, Level.TRIANGLE) == 0


@given(st.sampled_from(sorted(SCENES)), st.sampled_from(STAGES), st.data())
def test_what_is_known_grows_within_a_row(name, stage, data):
    scene = SCENES[name]
    found = trace(scene, Settings(), region=small_region(scene)).stage(stage)
    if not found.steps.row_count:
        return
    row = data.draw(st.integers(0, found.steps.row_count - 1))
    first, end = int(found.steps.starts[row]), int(found.steps.starts[row + 1])
    known = [set(found.explain(position).known) for position in range(first + 1, end + 1)]
    assert all(before <= after for before, after in pairwise(known))
