"""Rows of several samples a pixel: each is about its pixel and its sample, in drawing order."""

import numpy as np
import pytest

from core import Settings, render, trace
from core.antialiasing import traced_areas
from core.coverage.edges import covers
from tests.core.trace.trace_cases import SCENES

SAMPLED = {"msaa-4": 4, "ssaa-4": 4, "ssaa-16": 16, "ssaa-n": 9}


def track(traced, stage, name):
    found = traced.stage(stage)
    return next(t for t in found.buffers if t.name == name).at(found.steps.row_count)


@pytest.mark.parametrize("fill", ["spans", "bounding-box", "blocks"])
@pytest.mark.parametrize("antialiasing", list(SAMPLED))
def test_every_row_says_its_pixel_and_sample(antialiasing, fill):
    scene = SCENES["clip"]
    traced = trace(scene, Settings(antialiasing=antialiasing, fill=fill))
    covered = render(scene, Settings(antialiasing=antialiasing, visibility="last-drawn")).samples.cover_count
    found = traced.stage("depth")
    counts = np.zeros(covered.shape, int)
    column, row = found.pixel.T
    kept = traced.stage("depth").columns["depth"]
    in_range = np.isfinite(kept) & (found.steps.kind == found.steps.kinds.index("test"))
    np.add.at(counts, (found.columns["sample"][in_range], row[in_range], column[in_range]), 1)
    assert np.array_equal(counts, covered)


def test_edge_functions_of_a_sample_are_evaluated_at_its_place():
    traced = trace(SCENES["shared-edge"], Settings(antialiasing="msaa-4", fill="bounding-box"))
    found, edges = traced.stage("raster"), traced.source.geometry.edges
    c = found.columns
    for k in range(0, found.steps.row_count, 7):
        values, inside = covers(*(c[name][k] for name in ("a", "b", "c", "owns_tie", "x", "y")))
        assert values == c["values"][k].tolist()
        assert inside == c["covered"][k]
        place = np.array([c["x"][k] - c["column"][k], c["y"][k] - c["row"][k]])
        assert np.array_equal(place, c["sample_position"][k])
        assert np.array_equal(c["c"][k], edges.c[c["primitive"][k]])


@pytest.mark.parametrize("antialiasing", list(SAMPLED))
def test_covered_samples_are_counted(antialiasing):
    traced = trace(SCENES["single-triangle"], Settings(antialiasing=antialiasing))
    frame = render(SCENES["single-triangle"], Settings(antialiasing=antialiasing))
    wanted = (frame.samples.primitive >= 0).sum(axis=0)
    found = np.nan_to_num(track(traced, "raster", "samples"))
    assert np.array_equal(found, wanted)
    assert np.count_nonzero((wanted > 0) & (wanted < SAMPLED[antialiasing])) > 0


def test_triangles_are_stepped_one_after_another_and_their_samples_in_turn():
    found = trace(SCENES["shared-edge"], Settings(antialiasing="msaa-4")).stage("raster")
    key = found.triangle * 10 + np.maximum(found.columns["sample"], 0)
    assert (np.diff(found.triangle) >= 0).all()
    assert len(found.steps.triangle_ends) == 2
    assert np.unique(key[found.columns["sample"] >= 0]).tolist() == [0, 1, 2, 3, 10, 11, 12, 13]


def test_resolving_shows_what_each_sample_shows():
    scene, settings = SCENES["intersecting"], Settings(antialiasing="msaa-4")
    found, frame = trace(scene, settings).stage("resolve"), render(scene, settings)
    triangles = found.columns["sample_triangle"].T.reshape(4, *frame.primitive.shape)
    assert np.array_equal(triangles, frame.samples.primitive)
    summed = trace(scene, Settings(antialiasing="area")).stage("resolve")
    areas = summed.columns["sample_weights"][summed.steps.kind == summed.steps.kinds.index("areas")]
    assert np.abs(areas.sum(axis=1) - 1).max() <= 1e-12
    assert ((areas > 0).sum(axis=1) > 2).any()


def test_cuts_that_would_fill_the_memory_are_left_out_and_that_is_said(monkeypatch):
    scene, settings = SCENES["intersecting"], Settings(antialiasing="area")
    told = trace(scene, settings).stage("resolve")
    sums = told.steps.kind == told.steps.kinds.index("areas")
    pair_count = np.count_nonzero(told.steps.kind == told.steps.kinds.index("piece"))
    monkeypatch.setattr(traced_areas, "MOST_NUMBERS", 1000)
    left = trace(scene, settings).stage("resolve")
    assert left.steps.kinds == ("areas",)
    assert left.constants["untold_cuts"] == pair_count
    assert np.array_equal(left.columns["samples"], told.columns["samples"][sums])
    # One triangle in few pixels has few.
    focused = trace(scene, settings, triangle=0, region=(8, 8, 2, 2)).stage("resolve")
    assert "piece" in focused.steps.kinds
    assert "untold_cuts" not in focused.constants


def test_a_primitive_has_one_area_in_a_pixel_however_it_was_cut():
    found = trace(SCENES["intersecting"], Settings(antialiasing="area")).stage("resolve")
    pieces = np.flatnonzero(found.steps.kind == found.steps.kinds.index("piece"))
    areas, shown = (found.columns[name][pieces] for name in ("part_area", "part_primitive"))
    np.testing.assert_allclose(areas.sum(axis=1), 1, atol=1e-12)
    for row_areas, row_shown in zip(areas, shown, strict=True):
        there = row_shown[row_areas > 0]
        assert len(set(there.tolist())) == len(there)


def test_spans_are_counted_for_each_sample():
    """Found at random: with four samples a span was number 4 of 4, counted among those of the first sample."""
    found = trace(SCENES["clip"], Settings(antialiasing="msaa-4")).stage("raster")
    c, rows = found.columns, found.steps.kind == found.steps.kinds.index("lane-row")
    assert len(np.unique(c["span_count"][rows])) > 1
    assert (c["place"][rows] < c["span_count"][rows]).all()
    assert (c["lane"][rows] < found.variables(int(np.flatnonzero(rows)[0]))["lane_count"]).all()


def test_a_step_of_a_sample_knows_what_its_line_is_given():
    """Without it a line of several samples computed with NaN: "Subtracting 2 · dx = NaN makes D = −14"."""
    line = {"polygon_mode": "wireframe"}
    whole, sampled = (
        trace(SCENES["shared-edge"], Settings(**line, antialiasing=name)).stage("raster")
        for name in ("none", "msaa-4")
    )
    for kind, names in whole.given.items():
        assert set(names) <= set(sampled.given[kind])
    assert any(whole.given.values())
