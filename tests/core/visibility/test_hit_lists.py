"""Lists of hits: opaque they are the z-buffer, blended the exact order from back to front, in any drawing order."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Settings, draw_picture, render, trace
from core.framebuffer.blending import resolve_from_front
from core.framebuffer.display import to_display
from core.methods import table
from core.pixel_history import why
from core.records.arrays import Floats
from core.trace.source import TraceSource
from core.visibility.hit_lists import HIT_BYTES, HitLists, list_hits
from lessons.scenes import make_scene
from tests.core.pixel_history.test_why_picture import check_pixels
from tests.core.strategies import clip_of_window
from tests.core.trace.trace_cases import SCENES

LISTS = Settings(visibility="hit-lists", cull="none")
BLENDED = replace(LISTS, blend="over", interpolation="flat")
SIZE = (11, 8)


def flat_panes(count: int, seed: int) -> ClipScene:
    """Return triangles each of one depth, colour and alpha, some equally deep: alpha 0, 1/4, 1/2, 1."""
    generator = np.random.default_rng(seed)
    window = generator.integers(-32, 256, (count, 3, 2)) / 16
    depth = np.repeat(generator.integers(0, 9, (count, 1)) / 8, 3, axis=1)
    color = np.append(
        generator.integers(0, 9, (count, 3)) / 8, generator.choice([0, 0.25, 0.5, 1], (count, 1)), axis=1
    )
    background = np.array([0.25, 0.5, 0.75, 1])
    clip = clip_of_window(window, SIZE, 1.0, 2 * depth - 1)
    return ClipScene(clip, np.repeat(color[:, None], 3, axis=1), SIZE, background=background)


def lists_of(scene: ClipScene, settings: Settings) -> tuple[TraceSource, HitLists]:
    source = TraceSource(scene, settings)
    assert isinstance(source.exact_tests, HitLists)
    return source, source.exact_tests


@pytest.mark.parametrize("antialiasing", ["none", "msaa-4", "ssaa-4"])
@pytest.mark.parametrize("depth", table.names("depth"))
def test_opaque_they_are_the_z_buffer_bit_for_bit(depth: str, antialiasing: str) -> None:
    settings = replace(LISTS, depth=depth, antialiasing=antialiasing)
    for name in ("clip",):
        lists, tested = (
            render(SCENES[name], replace(settings, visibility=v)) for v in ("hit-lists", "z-buffer")
        )
        for buffer in ("color", "depth", "primitive", "cover_count", "attributes"):
            assert np.array_equal(getattr(lists, buffer), getattr(tested, buffer), equal_nan=True), buffer


def test_micropolygons_are_triangles_as_any_others() -> None:
    ball, diced = make_scene("diced-ball"), replace(LISTS, tessellation="reyes", curve_tolerance=64)
    assert np.array_equal(
        *(render(ball, replace(diced, visibility=v)).color for v in ("hit-lists", "z-buffer"))
    )
    # Nothing is culled: each pixel hits the front and the back, and a few of the outline more.
    _, lists = lists_of(ball, diced)
    assert lists.work["longest list"] == int(render(ball, diced).cover_count.max())


@given(st.integers(1, 9), st.integers(0, 2**32 - 1))
def test_blended_it_is_over_from_back_to_front_in_rational_numbers(count: int, seed: int) -> None:
    scene = flat_panes(count, seed)
    frame = render(scene, BLENDED)
    flat = [ClipScene(clip[None] * [1, 1, 0, 1], size=SIZE) for clip in scene.clip]
    cover = [render(alone, replace(LISTS, visibility="last-drawn")).primitive == 0 for alone in flat]
    depth = (scene.clip[:, 0, 2] + 1) / 2
    # Of equally deep ones the first drawn lies on top, and depth 1 is no nearer than the cleared buffer.
    order = [k for k in np.lexsort((-np.arange(count), -depth)).tolist() if depth[k] < 1]
    colors = [[Fraction(float(c)) for c in scene.attributes[k, 0]] for k in range(count)]
    for row in range(SIZE[1]):
        for column in range(SIZE[0]):
            there, front = [Fraction(float(c)) for c in scene.background], -1
            for k in order:
                if cover[k][row, column]:
                    *own, alpha = colors[k]
                    there = [a * alpha + b * (1 - alpha) for a, b in zip([*own, 1], there, strict=True)]
                    front = k
            assert np.array_equal(frame.color[row, column], np.array(there, float).astype(np.float32))
            assert frame.primitive[row, column] == front
            assert frame.depth[row, column] == (1 if front < 0 else np.float32(depth[front]))


@given(st.integers(1, 9), st.integers(0, 2**32 - 1))
def test_the_drawing_order_does_not_matter(count: int, seed: int) -> None:
    scene = flat_panes(count, seed)
    # Each at a depth of its own: equally deep ones go by the order.
    clip = scene.clip.copy()
    clip[..., 2] = (np.arange(count) / count)[:, None]
    turned = np.random.default_rng(seed).permutation(count)
    one, other = (
        render(ClipScene(clip[order], scene.attributes[order], SIZE), BLENDED).color
        for order in (np.arange(count), turned)
    )
    assert np.array_equal(one, other)


REYES = {"tessellation": "reyes", "curve_tolerance": 128, "shading": "gouraud"}


@pytest.mark.parametrize(("name", "chosen"), [("crossing-glass", {}), ("clip", {}), ("folded-glass", REYES)])
def test_blended_it_is_the_picture_of_scan_lines(name: str, chosen: dict[str, object]) -> None:
    scene, settings = SCENES.get(name) or make_scene(name), replace(BLENDED, **chosen)
    lists, lines = (render(scene, replace(settings, visibility=v)) for v in ("hit-lists", "scan-line"))
    assert np.allclose(lists.color, lines.color, atol=1e-6)
    assert np.array_equal(lists.primitive, lines.primitive)


@given(st.integers(1, 6), st.integers(0, 2**32 - 1), st.sampled_from(["opaque", "over", "additive"]))
def test_rows_fold_to_the_picture_and_histories_end_with_it(count: int, seed: int, blend: str) -> None:
    scene, settings = flat_panes(count, seed), replace(LISTS, blend=blend)
    frame, traced = render(scene, settings), trace(scene, settings)
    for stage, buffers in (("depth", ("depth", "primitive")), ("blend", ("color",))):
        found = traced.stage(stage)
        state = found.state(found.steps.count)
        assert all(np.array_equal(state[name], getattr(frame, name)) for name in buffers)
    column, row = seed % SIZE[0], seed // 64 % SIZE[1]
    after = [event.after for event in why(traced.source, column, row).events if event.after is not None]
    assert np.array_equal(after[-1].color, frame.color[row, column])
    assert after[-1].triangle == frame.primitive[row, column]


@given(st.integers(1, 9), st.integers(0, 2**32 - 1))
def test_both_listings_give_the_picture(count: int, seed: int) -> None:
    scene = flat_panes(count, seed)
    source, lists = lists_of(scene, BLENDED)
    _, keeps, stored = source.depths
    kept = np.flatnonzero(keeps)
    assert lists.work == {
        "hits listed": len(lists.listed),
        "longest list": int(lists.length.max(initial=0)),
        "bytes of lists": HIT_BYTES * len(lists.listed),
    }
    frame, place = render(scene, BLENDED), source.place
    for pixel in np.unique(place):
        hits = [(float(stored[k]), int(k)) for k in kept if place[k] == pixel]
        listed = list_hits(hits, 1.0, False, True)
        assert list_hits(hits, 1.0, False, False) == listed[:1]
        own = [k for k in kept[lists.listed].tolist() if place[k] == pixel]
        assert [k for _, k in listed] == own
        colors: Floats = source.surface.color[own]
        resolved = resolve_from_front(colors.tolist(), scene.background.tolist())
        assert resolved == frame.color.reshape(-1, 4)[pixel].tolist()


def test_the_fast_picture_has_all_hits_of_a_list() -> None:
    scene = make_scene("crossing-glass")
    for blend in table.names("blend"):
        settings = replace(LISTS, blend=blend)
        shown = to_display(render(scene, settings).color).pixels
        assert np.array_equal(draw_picture(scene, settings).pixels, shown), blend


def test_pale_pixels_of_lines_are_sorted_too_and_hide_nothing() -> None:
    settings = replace(LISTS, polygon_mode="wireframe", line="wu")
    frame, picture = render(SCENES["clip"], settings), draw_picture(SCENES["clip"], settings)
    traced = trace(SCENES["clip"], settings)
    for stage, name in (("depth", "depth"), ("depth", "primitive"), ("blend", "color")):
        found = traced.stage(stage)
        assert np.array_equal(found.state(found.steps.count)[name], getattr(frame, name))
    assert picture.route.visibility == "frame"


def test_lines_of_one_triangle_stand_in_a_history_as_the_list_sorts_them() -> None:
    scene = SCENES["clip"]
    pixels = [(column, row) for row in range(scene.size[1]) for column in range(scene.size[0])]
    check_pixels(scene, replace(LISTS, polygon_mode="wireframe", blend="additive"), pixels)


def test_a_triangle_alone_is_resolved_over_those_before_it() -> None:
    scene = make_scene("crossing-glass")
    for before in ("earlier", "cleared"):
        found = trace(scene, BLENDED, 1, (24, 24, 16, 4), before=before).stage("blend")
        assert found.steps.row_count > 0
        assert np.isfinite(found.state(found.steps.count)["color"]).all()
