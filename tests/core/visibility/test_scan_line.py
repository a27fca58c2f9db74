"""Scan-line visible surfaces: the picture of ray casting, bit for bit; what is compared, and how rarely."""

from dataclasses import replace
from functools import cmp_to_key
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Settings, render, trace
from core.coverage.fills import Fragments
from core.coverage.pixel_runs import Raster
from core.explain.step_tables import step_table
from core.methods import table
from core.pipeline import draw
from core.pixel_history import why
from core.trace.source import TraceSource
from core.visibility.ray_casting import RayPlanes
from core.visibility.scan_line import ALONE, HALVED, PAIR, SAME, ScanLines, Spans, draw_rows, find_spans
from lessons.scenes import make_scene
from tests.core.strategies import ANY_TRIANGLES, REGIONS, clip_of_window
from tests.core.trace.trace_cases import SCENES

RAYS, LINES = Settings(visibility="ray-casting"), Settings(visibility="scan-line")
BUFFERS = ("color", "depth", "primitive", "attributes", "cover_count")


def assert_alike(scene, settings: Settings = LINES, region=None) -> None:
    """Every buffer of the scan-line picture equals the one that ray casting draws."""
    frames = [
        render(scene, chosen) if region is None else draw(scene, chosen, Raster(*scene.size, 0.5, region))
        for chosen in (settings, replace(settings, visibility="ray-casting"))
    ]
    for name in BUFFERS:
        assert np.array_equal(*(getattr(frame, name) for frame in frames), equal_nan=True), name


def scan_lines(scene, settings: Settings = LINES, **chosen) -> ScanLines:
    """Return what the method decides of a scene."""
    return trace(scene, settings, **chosen).source.exact_tests


def crowd(count: int, size: tuple[int, int], seed: int = 0) -> np.ndarray:
    """Return random triangles (T, 3, 4) at many depths, many of which cross."""
    generator = np.random.default_rng(seed)
    points = generator.uniform(0, 1, (count, 1, 2)) * size + generator.normal(0, 0.4, (count, 3, 2)) * size
    z = generator.uniform(-1, 1, (count, 3))
    return clip_of_window(points, size, generator.uniform(1, 4, (count, 3)), z)


@given(
    ANY_TRIANGLES,
    st.sampled_from(["half", "integer"]),
    st.sampled_from(["homogeneous", "sutherland-hodgman"]),
)
def test_the_picture_is_that_of_ray_casting(case, center: str, clipping: str) -> None:
    clip, size = case
    settings = replace(LINES, cull="none", pixel_center=center, clipping=clipping)
    assert_alike(ClipScene(clip, size=size), settings)


@given(st.integers(1, 12), st.integers(0, 2**32 - 1), REGIONS)
def test_crossing_triangles_and_parts_of_a_picture(count: int, seed: int, region) -> None:
    scene = ClipScene(crowd(count, (13, 9), seed), size=(13, 9))
    assert_alike(scene)
    assert_alike(scene, region=region)


@pytest.mark.parametrize("antialiasing", ["ssaa-4", "msaa-4", "area"])
def test_samples_in_other_places_and_areas(antialiasing: str) -> None:
    scene = ClipScene(crowd(9, (13, 9)), size=(13, 9))
    assert_alike(scene, replace(LINES, antialiasing=antialiasing))


@pytest.mark.parametrize("name", SCENES)
def test_every_kind_of_scene(name: str) -> None:
    # Segments and points, polygons, meshes, textures, shaders that discard, tables of depths.
    assert_alike(SCENES[name])


def test_outlines_are_compared_pixel_by_pixel() -> None:
    scene = ClipScene(crowd(9, (13, 9)), size=(13, 9))
    for line in ("bresenham", "wu"):
        assert_alike(scene, replace(LINES, polygon_mode="wireframe", line=line))


@given(st.integers(1, 8), st.integers(0, 2**32 - 1))
def test_a_part_of_a_scene_is_drawn_over_the_picture_before(count: int, seed: int) -> None:
    scene = ClipScene(crowd(count, (9, 7), seed), size=(9, 7))
    for triangle in range(count):
        lines = scan_lines(scene, triangle=triangle)
        rays = trace(scene, RAYS, triangle=triangle).source.depth_tests
        fragment = trace(scene, LINES, triangle=triangle).source.depths[1]
        assert np.array_equal(lines.passes, rays.passes[fragment])


def test_what_breaks_programs_draws_what_there_is() -> None:
    # None, one without area, one pixel, triangles of one plane: ties keep the first one drawn.
    size = (8, 5)
    plane = [[(0, 0), (20, 0), (0, 20)], [(8, 5), (-9, 5), (8, -9)], [(0, 0), (20, 0), (0, 20)]]
    flat = [[(0, 0), (4, 4), (8, 8)]]
    dot = [[(2, 2), (3.2, 2), (2, 3.2)]]
    assert (render(ClipScene(np.empty((0, 3, 4)), size=size), LINES).primitive == -1).all()
    assert (render(ClipScene(clip_of_window(flat, size), size=size), LINES).primitive == -1).all()
    assert_alike(ClipScene(clip_of_window(dot, size), size=size))
    frame = render(ClipScene(clip_of_window(plane, size), size=size), replace(LINES, cull="none"))
    assert (frame.primitive[frame.primitive >= 0] == 0).sum() > 0
    assert_alike(ClipScene(clip_of_window(plane, size), size=size), replace(LINES, cull="none"))


@given(st.integers(1, 12), st.integers(0, 2**32 - 1))
def test_segments_tile_what_is_covered_and_their_ends_decide(count: int, seed: int) -> None:
    lines = scan_lines(
        ClipScene(crowd(count, (13, 9), seed), size=(13, 9)), replace(LINES, cull="none"), triangle=None
    )
    spans, segments = lines.spans, lines.segments
    ends = {
        (int(row), int(end))
        for side in (spans.left, spans.right)
        for row, end in zip(spans.row, side, strict=True)
    }
    times = np.zeros((9, 13), int)
    for part in range(len(segments)):
        row, left, right = (int(values[part]) for values in (segments.row, segments.left, segments.right))
        live = segments.live[segments.live_start[part] : segments.live_start[part + 1]]
        if segments.depth[part] == 0:
            assert {(row, left), (row, right)} <= ends
            assert not any((row, column) in ends for column in range(left + 1, right))
        assert (spans.row[live] == row).all()
        assert (spans.left[live] <= left).all()
        assert (spans.right[live] >= right).all()
        assert (segments.verdict[part] == ALONE) == (len(live) == 1)
        first, last = segments.nearest[part]
        assert (first == last) == (segments.verdict[part] in (ALONE, SAME))
        assert (segments.verdict[part] == PAIR) <= (right - left == 2)
        if segments.verdict[part] != HALVED:
            times[row, left:right] += 1
    covered = render(ClipScene(crowd(count, (13, 9), seed), size=(13, 9)), replace(LINES, cull="none"))
    assert np.array_equal(times, covered.cover_count > 0)
    places = list(zip(segments.row, segments.left, -segments.right, strict=True))
    assert places == sorted(places), "each before its halves"


def test_a_span_ends_where_the_next_pixel_is_missing_or_of_something_else() -> None:
    # Columns 0 1 . 3 of row 0 and column 4 of row 1 are primitive 0; columns 4 and 5 of row 0 are primitive 1. Before
    # there was triangle 7 in columns 1 and 3 of row 0.
    column, row = np.array([[0, 1, 3, 4, 4, 5], [0, 0, 0, 1, 0, 0]])
    primitive = np.array([0, 0, 0, 0, 1, 1])
    initial = np.full(12, -1)
    initial[[1, 3]] = 7
    fragments = Fragments(primitive, column, row)
    case = SimpleNamespace(
        triangle=primitive + 2, pixel=6 * row + column, initial=initial, fragments=fragments
    )
    spans = find_spans(case)
    found = sorted(zip(spans.row, spans.left, spans.right, spans.triangle, spans.primitive, strict=True))
    assert found == [
        (0, 0, 2, 2, 0),
        (0, 1, 2, 7, -1),
        (0, 3, 4, 2, 0),
        (0, 3, 4, 7, -1),
        (0, 4, 6, 3, 1),
        (1, 4, 5, 2, 0),
    ]


def spans_of(spans: Spans) -> dict[int, dict[int, tuple[int, int]]]:
    """Return by triangle and row where it begins and ends."""
    found: dict[int, dict[int, tuple[int, int]]] = {t: {} for t in sorted(set(spans.triangle.tolist()))}
    for row, left, right, t in zip(spans.row, spans.left, spans.right, spans.triangle, strict=True):
        found[int(t)][int(row)] = (int(left), int(right))
    return found


@given(st.integers(1, 9), st.integers(0, 2**32 - 1))
def test_the_listing_draws_the_picture(count: int, seed: int) -> None:
    scene, settings = ClipScene(crowd(count, (13, 9), seed), size=(13, 9)), replace(LINES, cull="none")
    lines = scan_lines(scene, settings)

    def nearest(live: list[int], column: int, row: int) -> list[int]:
        return back_to_front(lines.planes, live, column, row)[-1:]

    seen = np.full((9, 13), -1)
    for row, left, right, t in draw_rows(spans_of(lines.spans), range(9), nearest):
        assert (seen[row, left:right] == -1).all()
        seen[row, left:right] = t
    assert np.array_equal(seen, render(scene, settings).primitive)


def back_to_front(planes: RayPlanes, live: list[int], column: int, row: int) -> list[int]:
    """Sort triangles at a pixel's centre, by exact comparisons alone; of equal ones the first drawn lies on top."""
    m, n = planes.rays(np.array([column]), np.array([row]), 0.5)

    def compare(one: int, other: int) -> int:
        return planes.compare(one, other, m.tolist(), n.tolist())[0] or other - one

    return sorted(live, key=cmp_to_key(compare))


BLENDED = replace(LINES, cull="none", blend="over")


def flat_crowd(count: int, size: tuple[int, int], seed: int) -> ClipScene:
    """Return a crowd, each triangle of one colour and alpha, some twice: their layers are equally near."""
    generator = np.random.default_rng(seed)
    clip = crowd(count, size, seed)
    clip = clip[generator.integers(0, count, count)] if seed % 2 else clip
    color = np.repeat(generator.choice([0.25, 0.5, 1.0], (count, 1, 4)), 3, axis=1)
    return ClipScene(clip, color, size)


@given(st.integers(1, 9), st.integers(0, 2**32 - 1), st.sampled_from(["over", "additive"]), st.booleans())
def test_blended_layers_are_those_of_a_sorted_stack(count: int, seed: int, blend: str, is_msaa: bool) -> None:
    scene, settings = flat_crowd(count, (13, 9), seed), replace(BLENDED, blend=blend)
    lines, rule = scan_lines(scene, settings), table.get("blend", blend).function
    frame = render(scene, settings)
    expected = np.tile(scene.background.astype(np.float32), (9, 13, 1))
    stacks: dict[tuple[int, int], list[int]] = {}
    for t, rows in spans_of(lines.spans).items():
        for row, (left, right) in rows.items():
            for column in range(left, right):
                stacks.setdefault((row, column), []).append(t)
    for (row, column), live in stacks.items():
        order = back_to_front(lines.planes, live, column, row)
        for t in order:
            color = scene.attributes[t, :1].astype(np.float64)
            expected[row, column] = rule(color, expected[row, column][None])[0]
        assert frame.primitive[row, column] == order[-1]
    assert np.allclose(frame.color, expected, rtol=1e-6, atol=1e-6)
    opaque = render(scene, replace(settings, blend="opaque"))
    assert np.array_equal(frame.depth, opaque.depth)
    assert np.array_equal(frame.primitive, opaque.primitive)

    # The rows of a trace give the same, and so does each pixel's history; several samples, too.
    chosen = replace(settings, antialiasing="msaa-4" if is_msaa else "none")
    found = trace(scene, chosen)
    frame = render(scene, chosen)
    color = found.stage("resolve" if is_msaa else "blend").buffers
    assert any(np.array_equal(track.at(10**6).reshape(frame.color.shape), frame.color) for track in color)
    if not is_msaa:
        ends = {track.name: track.at(10**6) for track in found.stage("depth").buffers}
        assert np.array_equal(ends["depth"], frame.depth)
        assert np.array_equal(ends["primitive"], frame.primitive)
        last = why(TraceSource(scene, settings), 6, 4).fragments
        passed = [event.after for event in last if not event.is_rejected]
        if passed:
            assert np.array_equal(passed[-1].color, frame.color[4, 6])
            assert passed[-1].triangle == frame.primitive[4, 6]


@given(st.integers(1, 9), st.integers(0, 2**32 - 1))
def test_the_listing_draws_layers(count: int, seed: int) -> None:
    scene = flat_crowd(count, (13, 9), seed)
    lines = scan_lines(scene, BLENDED)

    def order(live: list[int], column: int, row: int) -> list[int]:
        return back_to_front(lines.planes, live, column, row)

    layers: dict[tuple[int, int], list[int]] = {}
    for row, left, right, t in draw_rows(spans_of(lines.spans), range(9), order):
        for column in range(left, right):
            layers.setdefault((row, column), []).append(t)
    found = trace(scene, BLENDED).stage("blend")
    drawn: dict[tuple[int, int], list[int]] = {}
    for (column, row), t in zip(found.pixel.tolist(), found.triangle.tolist(), strict=True):
        drawn.setdefault((row, column), []).append(t)
    assert layers == drawn


@given(st.integers(2, 8), st.integers(0, 2**32 - 1))
def test_one_blended_triangle_lies_over_the_picture_before_where_it_is_nearest(count: int, seed: int) -> None:
    scene = flat_crowd(count, (9, 7), seed)
    last = count - 1
    found = trace(scene, BLENDED, last).stage("blend")
    nearest = render(scene, BLENDED).primitive == last
    drawn = np.zeros((7, 9), bool)
    drawn[found.pixel[:, 1], found.pixel[:, 0]] = True
    assert np.array_equal(drawn, nearest)


def test_only_halving_computes_more_depths_than_a_depth_buffer_tests() -> None:
    settings = replace(LINES, cull="none")
    scene = make_scene("intersecting")
    segments = scan_lines(scene, settings).segments
    assert (segments.evaluations, int((segments.verdict == HALVED).sum())) == (628, 71)
    assert render(scene, settings).statistics["depth"].incoming == 2060
    for count in (4, 40, 150):
        lines = scan_lines(ClipScene(crowd(count, (24, 16)), size=(24, 16)), settings)
        is_halved = lines.segments.verdict == HALVED
        of_halved = (lines.segments.compared_ends * lines.segments.live_count)[is_halved].sum()
        assert lines.segments.evaluations - of_halved <= len(lines.passes)


@pytest.mark.slow
def test_a_hundred_thousand_triangles() -> None:
    generator = np.random.default_rng(0)
    points = generator.uniform(0, 1, (100_000, 1, 2)) * (320, 240) + generator.normal(0, 2, (100_000, 3, 2))
    z = generator.uniform(-1, 1, (100_000, 3))
    assert_alike(ClipScene(clip_of_window(points, (320, 240), 1.0, z), size=(320, 240)))


def test_the_active_list_has_the_spans_of_its_row_and_what_is_known_at_both_ends() -> None:
    found = trace(make_scene("intersecting"), replace(LINES, cull="none")).stage("depth")
    halved = np.flatnonzero(found.steps.kind == found.steps.kinds.index("scan-halve"))
    for row in halved[::9].tolist():
        table = step_table(found, found.steps.position_after(row))
        of_row = (found.columns["row"] == found.columns["row"][row]) & (
            found.steps.kind == found.steps.kinds.index("scan-span")
        )
        assert table.rows == tuple(map(str, found.triangle[of_row].tolist()))
        for end, seen in ((3, "first"), (4, "last")):
            near = [
                -np.inf if line[end] is None else float(line[end].full.replace("−", "-"))
                for line in table.cells
            ]
            assert table.rows[int(np.argmax(near))] == str(found.columns[seen][row])


@pytest.mark.parametrize("clip", [np.empty((0, 3, 4)), clip_of_window([[(0, 0), (4, 4), (8, 8)]], (8, 5))])
def test_nothing_to_draw_has_no_rows(clip) -> None:
    found = trace(ClipScene(clip, size=(8, 5)), LINES).stage("depth")
    assert found.steps.row_count == 0
    assert step_table(found, 0) is None
