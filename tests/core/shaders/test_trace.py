"""Shaders stepped: the rows of Transform and Shade, their words and variables, and buffers of any variable."""

from dataclasses import replace
from importlib import import_module

import numpy as np
import pytest

from core import Settings, render, trace
from core.explain.steps import sentence, variables
from core.records.steps import Level
from core.shaders.presets import TASK_FRAGMENT, TASK_VERTEX
from core.shaders.told import statements_summary
from core.transform.traced import spaces_reached
from tests.core.shaders.scenes import BRANCHES, square_scene, tutorial_scene


def _sentences(stage, rows, column=0, line=0):
    return [sentence(stage.explain(int(stage.steps.starts[row]) + 1), 0, (column, line)) for row in rows]


def test_a_triangle_out_of_sight_has_a_stage_without_rows():
    scene = tutorial_scene(size=(24, 18))
    vertex = scene.program.vertex.replace("projectionMatrix * ", "")
    scene = replace(scene, program=replace(scene.program, vertex=vertex))
    assert not render(scene).cover_count.any()
    assert trace(scene, Settings()).stage("shade").steps.row_count == 0


def test_folding_all_rows_gives_the_picture():
    for scene in (tutorial_scene(size=(24, 18)), square_scene(BRANCHES)):
        frame, stage = render(scene), trace(scene, Settings()).stage("shade")
        color = next(track for track in stage.buffers if track.name == "fragment color")
        folded = color.at(stage.steps.row_count)
        seen = frame.primitive >= 0
        np.testing.assert_array_equal(np.isfinite(folded[..., 0]), seen)
        np.testing.assert_array_equal(np.float32(folded[seen]), frame.color[seen])
        assert np.isnan(color.at(0)).all()


def test_the_rows_of_a_lane_are_the_statements_of_its_own_run():
    stage = trace(square_scene(BRANCHES), Settings()).stage("shade")
    for row in range(0, stage.steps.row_count, 7):
        step = stage.step_at(row)
        assert step.line == stage.columns["line"][row]
        own = np.atleast_1d(np.array([] if step.value is None else step.value, float))
        found = stage.columns["result"][row]
        np.testing.assert_array_equal(found[: len(own)], own)
        assert np.isnan(found[len(own) :]).all()


def test_a_statement_and_a_fragment_are_levels():
    stage = trace(square_scene(BRANCHES), Settings(), 0).stage("shade")
    lane = stage.columns["lane"]
    ends = stage.steps.starts[np.flatnonzero(np.append(lane[1:] != lane[:-1], True)) + 1]
    np.testing.assert_array_equal(stage.steps.boundaries(Level.GROUP), [0, *ends])
    assert len(stage.steps.boundaries(Level.PIXEL)) == stage.steps.row_count + 1


def test_the_variables_are_those_of_the_shader():
    stage = trace(square_scene(BRANCHES), Settings(), 0).stage("shade")
    row = int(stage.rows_at_pixel(3, 0)[1])
    shown = {v.name: v for v in variables(stage.explain(int(stage.steps.starts[row]) + 1))}
    assert shown["p"].now == (-0.0625, -0.4375)
    assert shown["r"].now == pytest.approx(0.8839, abs=1e-4)
    assert shown["r"].is_changed()
    assert not shown["p"].is_changed()
    assert "k" not in shown


def test_any_variable_is_a_buffer():
    stage = trace(square_scene(BRANCHES), Settings()).stage("shade")
    names = [track.name for track in stage.buffers]
    assert names == ["fragment color", "lanes together", "p.x", "p.y", "r", "k", "i", "c", "vUv.x", "vUv.y"]
    given = stage.buffers[names.index("vUv.x")]
    np.testing.assert_allclose(given.at(stage.steps.row_count)[3], (np.arange(8) + 0.5) / 8)
    radius = stage.buffers[names.index("r")].at(stage.steps.row_count)
    u = (np.arange(8) + 0.5) / 8 - 0.5
    np.testing.assert_allclose(radius, 2 * np.hypot(*np.meshgrid(u, u)), rtol=1e-6)


def test_a_variable_that_is_read_before_it_has_a_value_is_marked_in_its_lanes():
    body = """
float k;
vec3 v;
v.x = 1.0;
for (int i = 0; i < 2; i++) { if (vUv.x > 0.5) k += 1.0; }
float m = k + v.x;
float last = m;
c = vec4(last);
"""
    for lanes in ("one", "together"):
        stage = trace(square_scene(body), Settings(), 0, lanes=lanes).stage("shade")
        rows = np.flatnonzero(stage.extra["unset"])
        read = {
            int(line): stage.columns["column"][rows[stage.columns["line"][rows] == line]]
            for line in stage.columns["line"][rows]
        }
        # In the right half k is read by its first += only, in the left half where m is computed.
        assert sorted(read) == [11, 12]
        assert read[11].min() == 4
        assert read[12].max() == 3
        assert len(read[11]) + len(read[12]) == len(np.unique(stage.columns["lane"]))
    said = _sentences(stage, rows[:1])[0]
    assert said.endswith("k: read before it has a value. GLSL leaves it open, here it is 0.")


def test_a_larger_step_counts_statements_and_lanes():
    for lanes, level, said in (
        (
            "together",
            Level.GROUP,
            "Line 8 runs for 36 of 36 fragments of triangle 0 together: vec2 p = vUv - 0.5;",
        ),
        ("one", Level.GROUP, "Triangle 0: 4 statements of 1 fragment."),
        ("one", Level.STAGE, "Whole stage: 444 statements of 36 fragments."),
    ):
        stage = trace(square_scene(BRANCHES), Settings(), 0, lanes=lanes).stage("shade")
        row = stage.steps.rows_done(stage.steps.forward(0, level)) - 1
        assert statements_summary(stage, 0, row, level) == said
    stage = trace(tutorial_scene(), Settings(), 0).stage("transform")
    assert statements_summary(stage, 2, 3, Level.GROUP).startswith("Triangle 0: a vertex is divided by w")


def test_the_vertex_shader_is_stepped_before_the_division():
    stage = trace(tutorial_scene(), Settings(), 0).stage("transform")
    kinds = [stage.kind_of(row) for row in range(stage.steps.row_count)]
    assert kinds == ["statement", "statement", "divide", "viewport"] * 3
    assert stage.columns["vertex"].tolist() == [0] * 4 + [2] * 4 + [1] * 4
    said = _sentences(stage, [0, 1, 2])
    assert said[0].startswith(
        "Line 8: gl_Position = projectionMatrix · modelViewMatrix · vec4(position.x · 1.5, "
    )
    assert "vec4(−5 · 1.5, −3 · 0.5, −10 · 2, 1)" in said[0]
    assert said[1] == "Line 16: vColor = color = (0.2, 0.6, 1)."
    assert said[2].startswith("Vertex 0 of triangle 0: its NDC x is −0.679")


def test_the_listing_is_the_students_own_source():
    traced = trace(tutorial_scene(size=(24, 18)), Settings(), 0)
    for name, source in (("transform", TASK_VERTEX), ("shade", TASK_FRAGMENT)):
        listed = traced.stage(name).listings["statement"]
        assert listed.source == source.rstrip("\n")
        assert listed.lines["1"] == 1


def test_too_many_lane_steps_are_refused(monkeypatch):
    monkeypatch.setattr(import_module("core.shaders.traced"), "LANE_STEP_LIMIT", 100)
    with pytest.raises(ValueError, match="too many to step: trace one triangle, or a region"):
        trace(square_scene(BRANCHES), Settings()).stage("shade")


def test_lanes_together_are_the_same_rows_statement_by_statement():
    for scene in (square_scene(BRANCHES), tutorial_scene(size=(24, 18))):
        for name in ("transform", "shade"):
            one, together = (
                trace(scene, Settings(), lanes=lanes).stage(name) for lanes in ("one", "together")
            )
            lane = one.extra["corners"] if name == "transform" else one.columns["lane"]
            theirs = together.extra["corners"] if name == "transform" else together.columns["lane"]
            order = np.argsort(theirs, kind="stable")
            np.testing.assert_array_equal(theirs[order], lane)
            for column, values in one.columns.items():
                np.testing.assert_array_equal(together.columns[column][order], values, err_msg=column)
            for track, other in zip(one.buffers, together.buffers, strict=True):
                np.testing.assert_array_equal(
                    track.at(one.steps.row_count), other.at(one.steps.row_count), err_msg=track.name
                )
            begin = 0
            for end in together.steps.group_ends:
                groups = {
                    (together.triangle[row], together.columns["lane_number"][row])
                    for row in range(begin, end)
                }
                assert len(groups) == 1
                if together.kind_of(begin) == "statement":
                    assert (together.columns["live"][begin:end] == end - begin).all()
                begin = end


def test_lanes_that_run_wait_and_were_discarded_are_all_of_the_triangle():
    stage = trace(square_scene(BRANCHES), Settings(), lanes="together").stage("shade")
    seen = set()
    for end in stage.steps.group_ends:
        row = int(end) - 1
        waiting, discarded = stage.waiting_at(row)
        same = stage.triangle == stage.triangle[row]
        live = stage.columns["lane"][
            same & (stage.columns["lane_number"] == stage.columns["lane_number"][row])
        ]
        lanes = np.concatenate([live, waiting, discarded])
        assert sorted(lanes.tolist()) == np.unique(stage.columns["lane"][same]).tolist()
        assert len(live) == stage.columns["live"][row]
        seen.add((len(waiting) > 0, len(discarded) > 0))
    assert seen == {(False, False), (True, False), (False, True), (True, True)}


def test_a_corner_is_in_clip_space_behind_its_last_statement():
    for lanes, halfway in (("one", [5, 0, 0]), ("together", [5, 3, 3])):
        traced = trace(tutorial_scene(), Settings(), lanes=lanes)
        steps = traced.stage("transform").steps
        kinds = [steps.kinds[kind] for kind in steps.kind]
        first = steps.position_after(kinds.index("viewport"))
        assert spaces_reached(traced, "transform", 0).tolist() == [[0, 0, 0]]
        assert spaces_reached(traced, "transform", first).tolist() == [halfway]
        assert spaces_reached(traced, "transform", steps.count).tolist() == [[5, 5, 5]]
