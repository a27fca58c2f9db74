"""Traces of clipped wireframes: the rows give the picture, the listings give the rows, every edge has its steps."""

from collections import Counter
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Settings, render, trace
from core.lines.line_method import line_traits
from core.lines.traced import CLIP_KINDS
from core.methods import table
from core.records.steps import Level
from core.trace.stage_trace import StageTrace
from tests.core.strategies import ANY_TRIANGLES, clip_of_window
from tests.core.trace.executed_rows import Ran, lines_that_run
from tests.core.trace.test_line_trace import check_fold, check_values
from tests.core.trace.trace_cases import SCENES, small_region

CLIPPERS = table.names("line_clipping")[1:]
SIZE = (12, 9)
CORNERS = [(-3.5, 4.5), (7.5, -2.5), (16.5, 7.0)]
"""A triangle that leaves a raster of `SIZE` on the left, at the bottom and on the right."""


def clipped_wireframe(clipper: str, **choices) -> Settings:
    return Settings(**{"polygon_mode": "wireframe", "line_clipping": clipper, **choices})


def is_clip_row(found: StageTrace) -> np.ndarray:
    return np.isin(np.array(found.steps.kinds)[found.steps.kind], list(CLIP_KINDS))


@given(
    ANY_TRIANGLES,
    st.sampled_from(CLIPPERS),
    st.sampled_from(table.names("pixel_center")),
    st.sampled_from(["perspective", "affine"]),
    st.sampled_from([1.0, 1e5]),
)
def test_any_triangles(case, clipper, pixel_center, interpolation, scale):
    clip, size = case
    values = np.linspace(0, 1, clip.size).reshape(clip.shape)
    scene = ClipScene(clip * np.array([scale, 1, 1, 1]), values, size)
    settings = clipped_wireframe(
        clipper, pixel_center=pixel_center, interpolation=interpolation, blend="over"
    )
    traced = trace(scene, settings)
    check_fold(traced, 0, 0, *size)
    check_listings(traced.stage("raster"), traced.source)
    check_values(traced.stage("interpolate"), interpolation)


def check_listings(found: StageTrace, source) -> None:
    """Run the clipper's listing on every edge, and the line's listing on what is left of it."""
    clip = source.geometry.outline_clip
    lines, whole, c = clip.lines, clip.whole, found.columns
    window, rows = lines.window, np.flatnonzero(is_clip_row(found))
    assert set(c["segment"][rows].tolist()) == set(range(len(whole)))
    for segment in range(len(whole)):
        own = rows[c["segment"][rows] == segment]
        with lines_that_run() as ran:
            left, seen = listed(found.method, source.settings.line_clipping, whole.window[segment], window)
        check_marks_of_borders(found, own, ran)
        assert bool(left) == bool(lines.is_kept[segment])
        if left:
            assert np.array_equal(np.asarray(left, float), lines.segments[segment])
        check_numbers(found, own, seen)
        check_pixels(found, np.flatnonzero(c["segment"] == segment), lines, segment, source)


def check_marks_of_borders(found: StageTrace, own: np.ndarray, ran: Ran) -> None:
    """Check that each marked line ran as often as rows mark it; one that is marked at every border may stand before."""
    marked: Counter[int] = Counter()
    for row in own.tolist():
        start, end = found.steps.starts[row : row + 2].tolist()
        made = [found.explain(position) for position in range(start + 1, end + 1)]
        marked.update(explanation.line for explanation in made)
        code = made[0].listing.function.__code__
    ((lines,),) = [calls for function, calls in ran.items() if function is code]
    listing = made[0].listing
    for name in ("enter", "leave", "outside", "parallel", "empty", "accept", "reject", "edge", "move", "t"):
        line = listing.lines.get(name, 0)
        if marked[line]:
            assert lines.count(line) >= marked[line], (name, listing.source.splitlines()[line - 1])
            assert name not in ("enter", "leave") or lines.count(line) == marked[line], name


def listed(method: str, clipper: str, segment, window):
    listing = table.get("line_clipping", clipper).listing
    ends = segment.ravel().tolist()
    if clipper in ("cohen-sutherland", "liang-barsky"):
        return listing(*ends, *window.borders)
    if clipper == "exact":
        normals = [[Fraction(value) for value in normal] for normal in window.normals.tolist()]
        return listing(ends[:2], ends[2:], normals, window.points.tolist())
    return listing(*segment, window.normals, window.points, clipper == "cyrus-beck-lecture")


def check_numbers(found: StageTrace, own: np.ndarray, seen) -> None:
    c = found.columns
    if "approach" in c:
        edges = own[~np.isnan(c["approach"][own])]
        numbers = np.stack(
            [c[name][edges] for name in ("approach", "room", "crossing_t", "t_enter", "t_leave")], 1
        )
        assert np.array_equal(numbers, np.reshape(seen, (-1, 5)), equal_nan=True)
        return
    edge = [["left", "right", "bottom", "top"].index(name) if name else -1 for name in c["border"][own]]
    listed = zip(c["code_start"][own], c["code_end"][own], edge, c["moved_end"][own], strict=True)
    assert list(listed) == [tuple(made[:4]) for made in seen]
    moved = [made[4:] for made in seen if len(made) > 4]
    assert np.array_equal(c["moved_to"][own][: len(moved)], np.reshape(moved, (-1, 2)))


def check_pixels(found: StageTrace, own: np.ndarray, lines, segment: int, source) -> None:
    c, line = found.columns, source.settings.line
    pixels = own[found.pixel[own, 0] >= 0]
    if not lines.is_kept[segment]:
        assert not len(pixels)
        return
    if not len(pixels):
        return
    ends = [*c["first_end"][pixels[0]], *c["second_end"][pixels[0]]]
    ends = [int(end) for end in ends] if line_traits(line).takes_pixels else ends
    chosen = table.get("line", line).listing(*ends, bool(lines.cut_by[segment, 1] >= 0))
    left, bottom, right, top = source.raster.bounds
    inside = [(x, y) for x, y, _ in chosen if left <= x < right and bottom <= y < top]
    assert inside == list(zip(c["column"][pixels], c["row"][pixels], strict=True))


@pytest.mark.parametrize("clipper", CLIPPERS)
@pytest.mark.parametrize("name", ["clip", "lit", "near-plane"])
def test_the_listings_executed_give_the_rows(name, clipper):
    traced = trace(SCENES[name], clipped_wireframe(clipper))
    assert is_clip_row(traced.stage("raster")).any()
    check_listings(traced.stage("raster"), traced.source)


@pytest.mark.parametrize("clipper", CLIPPERS)
def test_every_edge_is_clipped_before_its_pixels_are_drawn(clipper):
    scene = ClipScene(clip_of_window([CORNERS], SIZE), size=SIZE)
    found = trace(scene, clipped_wireframe(clipper)).stage("raster")
    steps, is_clip, segment = found.steps, is_clip_row(found), found.columns["segment"]
    assert len(steps.group_ends) == 3
    assert segment.tolist() == sorted(segment.tolist())
    for first, end in pairwise([0, *steps.group_ends]):
        of_group = is_clip[first:end]
        assert of_group[0]
        assert (np.diff(of_group.astype(int)) <= 0).all()
    assert set(found.columns["edge"].tolist()) == {0, 1, 2}
    assert (found.pixel[is_clip] == -1).all()


@pytest.mark.parametrize("clipper", CLIPPERS)
def test_every_step_names_a_line_and_numbers_that_there_are(clipper):
    found = trace(SCENES["clip"], clipped_wireframe(clipper)).stage("raster")
    for position in range(1, found.steps.count + 1):
        explanation = found.explain(position)
        assert explanation.listing is not None
        assert explanation.line > 0, explanation.key
        for name in explanation.changed:
            value = explanation.values[name]
            assert value != "" if isinstance(value, str) else np.isfinite(np.asarray(value, float)).all(), (
                name
            )
    for level in Level:
        boundaries = found.steps.boundaries(level).tolist()
        for before, after in pairwise(boundaries):
            assert found.steps.forward(before, level) == after
            assert found.steps.back(after, level) == before


@pytest.mark.parametrize("clipper", CLIPPERS)
def test_bounds_only_narrow(clipper):
    found = trace(SCENES["lit"], clipped_wireframe(clipper)).stage("raster")
    c = found.columns
    if clipper == "cohen-sutherland":
        cuts = c["moved_end"] >= 0
        assert cuts.any()
        assert (c["code_start"][cuts] | c["code_end"][cuts] > 0).all()
        return
    kinds = np.array(found.steps.kinds)[found.steps.kind]
    entries, exits = kinds == "clip-enter", kinds == "clip-leave"
    assert np.array_equal(c["t_enter"][entries], np.maximum(c["bound_before"], c["crossing_t"])[entries])
    assert np.array_equal(c["t_leave"][exits], np.minimum(c["bound_before"], c["crossing_t"])[exits])
    assert entries.any()


def test_a_region_is_stepped_with_the_window_of_the_whole_picture():
    scene = SCENES["clip"]
    settings = clipped_wireframe("liang-barsky")
    whole, part = trace(scene, settings), trace(scene, settings, region=small_region(scene))
    for traced in (whole, part):
        width, height = scene.size
        assert traced.source.geometry.outline_clip.lines.window.borders == (0, 0, width, height)
    rows = [is_clip_row(t.stage("raster")).sum() for t in (whole, part)]
    assert rows[0] == rows[1] > 0
    assert render(scene, settings).cover_count.any()
