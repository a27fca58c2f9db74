"""The history of a pixel ends in what the picture shows, and its numbers are those of the traces."""

from dataclasses import replace
from time import process_time

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Scene, Settings, render, trace
from core.lines.line_method import has_intensities
from core.methods import table
from core.pixel_history import why
from core.pixel_history.events import FROM_FRONT
from core.pixel_history.fragments import PixelHistory
from core.settings import families
from core.trace import scene_triangle_count
from core.trace.source import TraceSource
from lessons.scenes import make_scene
from tests.core.strategies import ANY_TRIANGLES, BLOCK_SIZES
from tests.core.trace.trace_cases import CASES, EACH_METHOD, MIXES, SCENES, name_of, settings_of, small_scene
from tests.covering import in_turn, is_everything

PIXEL_LIMIT = 6


def some_pixels(scene: ClipScene | Scene, count: int = PIXEL_LIMIT) -> list[tuple[int, int]]:
    """Return pixels all over the image, the corners among them."""
    width, height = scene.size
    generator = np.random.default_rng(width * height)
    inner = zip(
        generator.integers(0, width, count).tolist(),
        generator.integers(0, height, count).tolist(),
        strict=True,
    )
    return [(0, 0), (width - 1, height - 1), *inner]


def check_story(history: PixelHistory, final_triangle: int, has_pale_pixels: bool) -> None:
    """Check that events follow from each other and that the verdict says what the last state says.

    Pale pixels of lines with intensities are blended, but leave depth and triangle as they are. A list of hits begins
    with what is seen, all else ends with it. Mixing pictures or smoothing edges comes last, and is no part of it.
    """
    assert [event.kind for event in history.events[:2]] == ["initial", "clear"]
    state = history.events[1].after
    passed, from_front = [], False
    for event in history.events[2:]:
        if event.kind == "resolve":
            assert event is history.events[-1]
            assert event.before is state
            continue
        if event.kind != "fragment":
            assert event.is_rejected
            assert event.before is event.out is event.after is None
            continue
        assert event.before is state
        assert (event.after is state) == event.is_rejected
        assert event.out.triangle == event.triangle
        state = event.after
        if not event.is_rejected:
            passed.append(event.triangle)
            from_front |= event.reason.key in FROM_FRONT
    shown = passed[0 if from_front else -1] if passed else -1
    last = history.events[-1]
    assert history.final is (last.after if last.kind == "resolve" else state)
    assert final_triangle == state.triangle
    if has_pale_pixels:
        assert final_triangle in (-1, *passed)
    else:
        assert final_triangle == shown
    if history.triangle is None:
        keys = ("nothing-near", "all-missed", "all-rejected")
        if passed:
            keys = ("seen", "seen-in-front", "from-front") if from_front else ("seen", "seen-over", "blended")
        assert history.verdict.key in keys
        if passed:
            assert history.verdict.values["triangle"] == shown


def check_pixels(scene: ClipScene | Scene, settings: Settings, pixels: list[tuple[int, int]]) -> None:
    # Of several samples and of areas it is the history of the centre.
    at_centers = replace(settings, antialiasing="none")
    frame, source = render(scene, at_centers), TraceSource(scene, settings)
    drawn = source.settings
    is_mixed = drawn.antialiasing in ("fxaa", "temporal")
    mixed = render(scene, settings) if is_mixed else frame
    has_pale_pixels = drawn.polygon_mode == "wireframe" and has_intensities(drawn.line)
    for column, row in pixels:
        history = why(source, column, row)
        at = row, column
        check_story(history, int(frame.primitive[at]), has_pale_pixels)
        assert history.final.color.tobytes() == mixed.color[at].tobytes(), (column, row)
        drawn_color = history.events[-1].before.color if is_mixed else history.final.color
        assert drawn_color.tobytes() == frame.color[at].tobytes(), (column, row)
        assert frame.depth.dtype.type(history.final.depth) == frame.depth[at], (column, row)
        assert history.cover_count == frame.cover_count[at], (column, row)
        listed = {event.triangle for event in history.events} - {-1}
        assert len(listed) + sum(history.counts.values()) == scene_triangle_count(source.scene)


@pytest.mark.parametrize("line", ["wu", "gupta-sproull"])
def test_smoothed_lines_under_ray_casting(line):
    scene = SCENES["textured-clip"]
    settings = Settings(polygon_mode="wireframe", line=line, visibility="ray-casting")
    check_pixels(scene, settings, some_pixels(scene))


@pytest.mark.parametrize(
    ("name", "choice"), CASES if is_everything() else in_turn(SCENES, EACH_METHOD), ids=name_of
)
def test_history_ends_in_the_picture(name, choice):
    scene = SCENES[name]
    check_pixels(scene, settings_of(choice, scene), some_pixels(scene))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "choice"),
    in_turn(["clip", "lit", "textured-clip"], [{"fill": "hierarchy", "block_size": 2}, *MIXES]),
    ids=name_of,
)
def test_history_of_every_pixel(name, choice):
    scene = SCENES[name]
    width, height = scene.size
    pixels = [(column, row) for row in range(height) for column in range(width)]
    check_pixels(scene, settings_of(choice, scene), pixels)


@pytest.mark.parametrize("name", ["sphere", "torus", "knot"])
def test_meshes(name):
    scene = small_scene(name)
    check_pixels(scene, Settings(cull="back", fill="blocks"), some_pixels(scene))
    check_pixels(scene, Settings(visibility="painters", blend="over", shading="flat"), some_pixels(scene, 4))


ANY_SETTINGS = st.builds(
    Settings,
    **{family: st.sampled_from(table.names(family)) for family in families()},
    block_size=BLOCK_SIZES,
)


@st.composite
def any_case(draw) -> tuple[ClipScene, Settings, tuple[int, int]]:
    clip, size = draw(ANY_TRIANGLES)
    value = st.sampled_from([0.0, 0.25, 0.5, 1.0])
    values = draw(st.lists(value, min_size=12 * len(clip), max_size=12 * len(clip)))
    pixel = draw(st.integers(0, size[0] - 1)), draw(st.integers(0, size[1] - 1))
    return ClipScene(clip, np.reshape(values, (len(clip), 3, 4)), size), draw(ANY_SETTINGS), pixel


@given(any_case())
def test_any_pixel_of_any_triangles(case):
    scene, settings, pixel = case
    check_pixels(scene, settings, [pixel])


@given(any_case(), st.data())
def test_any_triangle_at_any_pixel(case, data):
    scene, settings, (column, row) = case
    triangle = data.draw(st.integers(0, len(scene.clip) - 1))
    history = why(TraceSource(scene, settings), column, row, triangle)
    own = [event for event in history.events if event.triangle == triangle]
    covering = [event for event in own if event.kind == "fragment"]
    assert len(own) >= 1
    passed = [event for event in covering if not event.is_rejected]
    absent = history.verdict.key == "triangle-absent"
    assert absent == (not covering)
    assert (history.verdict.key == "triangle-rejected") == (bool(covering) and not passed)
    if absent and own[0].kind == "missed":
        values = own[0].reason.values
        assert {"edge", "distance", "values"} <= set(values)
        # Inside all edges and yet left out: an outline or the printed fill does that, or there is no area.
        if values["inside"].all() and settings.polygon_mode == "fill":
            assert settings.fill == "scanline-lecture" or values["doubled_area"] == 0


@pytest.mark.parametrize(
    ("name", "choice"), in_turn(["clip", "lit", "textured-clip"], EACH_METHOD), ids=name_of
)
def test_numbers_are_those_of_the_traces(name, choice):
    scene = SCENES[name]
    settings = replace(settings_of(choice, scene), antialiasing="none")
    traced = trace(scene, settings)
    stages = {stage: traced.stage(stage) for stage in ("raster", "interpolate", "shade", "depth", "blend")}
    for column, row in some_pixels(scene):
        history = why(traced.source, column, row)
        rows = {stage: found.rows_at_pixel(column, row) for stage, found in stages.items()}
        # A triangle that a ray misses has a row, and no fragment; so has a box.
        depth = stages["depth"]
        missed = [
            row
            for row in rows["depth"].tolist()
            if depth.kind_of(row) == "ray-missed" or depth.triangle[row] < 0
        ]
        rows["depth"] = np.setdiff1d(rows["depth"], missed)
        fragments = history.fragments
        # Rows of spans, and rays in a tree, are told by the triangle that is seen in the end.
        exact = traced.source.exact_tests
        is_each = exact is None or not exact.told()[1]
        if is_each:
            assert [e.triangle for e in fragments] == stages["depth"].triangle[rows["depth"]].tolist()
        tests = stages["raster"].columns
        for tested in rows["raster"].tolist():
            primitive = int(tests["primitive"][tested])
            event = next((e for e in history.events if e.primitive == primitive), None)
            link = event and event.link("raster")
            if link and settings.polygon_mode == "fill":
                assert np.array_equal(link.values["values"], tests["values"][tested])
                assert np.array_equal(link.values["distances"], tests["distance"][tested])
                assert (event.kind == "fragment") == tests["covered"][tested]
        passed = [event for event in fragments if not event.is_rejected]
        for k, event in enumerate(fragments):
            weights, depth = stages["interpolate"].columns["weights"], stages["depth"].columns
            assert np.array_equal(
                event.link("interpolate").values["weights"], weights[rows["interpolate"][k]]
            )
            shaded = rows["shade"][k]
            is_shaded = stages["shade"].kind_of(shaded) != "skipped"
            assert is_shaded == (event.link("shade").key == "color")
            if is_shaded:
                color = stages["shade"].columns["color"][shaded]
                assert np.array_equal(event.link("shade").values["color"], color)
            for key in ("depth", "stored", "before", "inverse_w") if is_each else ():
                found, wanted = event.link("depth").values[key], depth[key][rows["depth"][k]]
                assert found == wanted or (np.isnan(found) and np.isnan(wanted)), key
            if is_each:
                assert event.is_rejected == (not depth["passes"][rows["depth"][k]])
        blend = stages["blend"].columns
        assert len(passed) == len(rows["blend"])
        for event, blended in zip(passed, rows["blend"].tolist(), strict=True):
            assert event.before.color.tobytes() == blend["before"][blended].tobytes()
            assert event.after.color.tobytes() == blend["after"][blended].tobytes()


def test_a_pixel_of_twenty_thousand_triangles_is_answered_at_once():
    scene = make_scene("knot")
    source = TraceSource(scene, Settings(cull="back"))
    seconds = []
    assert len(source.geometry.assembled) == 20_000
    for column, row in ((256, 180), (300, 300), (200, 256), (256, 256), (10, 10)):
        start = process_time()
        why(source, column, row)
        seconds.append(process_time() - start)
    assert min(seconds) < 0.5


def test_the_geometry_of_the_whole_scene_is_kept_while_one_triangle_is_traced(monkeypatch):
    scene = SCENES["clip"]
    first = why(TraceSource(scene, Settings(), 3), 5, 4)
    with monkeypatch.context() as patch:
        patch.setattr("core.pixel_history.candidates.process_geometry", None)
        again = why(TraceSource(scene, Settings(), 7, before="cleared"), 5, 4)
    assert [e.reason.key for e in again.events] == [e.reason.key for e in first.events]
    other = why(TraceSource(scene, Settings(cull="back"), 7), 5, 4)
    assert "culled" in {event.kind for event in other.events}


def test_a_history_does_not_depend_on_what_is_traced():
    scene = SCENES["clip"]
    whole = why(TraceSource(scene, Settings()), 6, 4)
    part = why(TraceSource(scene, Settings(), 2, (0, 0, 3, 3), "cleared"), 6, 4)
    assert [e.reason.key for e in whole.events] == [e.reason.key for e in part.events]
    assert whole.final.color.tobytes() == part.final.color.tobytes()
