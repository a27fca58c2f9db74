"""Wireframes of lines with intensities: blended over what is there, depth stored by the stronger pixels only."""

import numpy as np
import pytest

from core import ClipScene, Settings, draw_picture, draw_triangles, render, trace
from core.depth.depth import depth_test
from core.depth.fixed_depth import rounded_depth_test
from core.framebuffer.display import to_display
from core.lines.drawing import draw_lines
from core.lines.line_method import has_intensities
from core.lines.wireframe_fragments import WRITTEN_INTENSITY, run_rightwards
from core.methods import table
from core.pixel_history import why
from core.resolved import resolve
from core.trace.source import TraceSource
from lessons.assembled_scenes import assembled
from lessons.scenes import make_scene
from tests.core.strategies import clip_of_window
from tests.covering import in_turns, is_everything

SMOOTH = [line for line in table.names("line") if has_intensities(line)]
SIZE = (16, 12)
CORNERS = [(2.25, 1.5), (13.5, 4.75), (5.5, 10.25)]
WHITE = np.ones((1, 3, 4))


def wireframe(line: str, **choices) -> Settings:
    return Settings(**{"polygon_mode": "wireframe", "line": line, **choices})


def drawn(corners, line: str, depth=0.0, values=WHITE, **choices):
    """Draw outlines of triangles given by window positions, each at a depth, on black."""
    clip = clip_of_window(corners, SIZE)
    clip[..., 2] = np.broadcast_to(np.reshape(depth, (-1, 1)), clip.shape[:2])
    values = np.broadcast_to(values, (len(clip), 3, 4))
    return draw_triangles(clip, *SIZE, attributes=values, settings=wireframe(line, **choices))


def edges_of(corners) -> np.ndarray:
    """The three edges of a triangle, as wireframes draw them: from left to right."""
    points = np.array(corners)
    return np.array([sorted(map(tuple, points[[k, (k + 1) % 3]].tolist())) for k in range(3)])


def blend_of(settings: Settings) -> tuple[str, str]:
    return resolve(settings).blend_name, resolve(settings).blend_inserted_for


@pytest.mark.parametrize("line", SMOOTH)
def test_intensities_blend_white_edges_over_black(line):
    frame = drawn([CORNERS], line)
    pixels, shown, _ = draw_lines(edges_of(CORNERS), *SIZE, line=line)
    # Over black, one white fragment after the other leaves 1 - (1 - i)(1 - j); where depth is stored, the first stays.
    wanted, depth_stored = np.zeros(SIZE[::-1]), np.zeros(SIZE[::-1], bool)
    for (column, row), intensity in zip(pixels.tolist(), shown.tolist(), strict=True):
        if depth_stored[row, column]:
            continue
        wanted[row, column] = intensity + wanted[row, column] * (1 - intensity)
        depth_stored[row, column] = intensity >= WRITTEN_INTENSITY
    np.testing.assert_allclose(frame.color[..., 0], wanted, atol=1e-6)
    assert np.array_equal(frame.primitive >= 0, depth_stored)
    assert np.array_equal(frame.depth < 1, depth_stored)
    assert ((frame.color[..., 0] > 0) & ~depth_stored).any()


def test_opaque_is_replaced_where_the_lines_need_it_and_nowhere_else():
    assert blend_of(wireframe("wu")) == ("over", "wu")
    assert blend_of(wireframe("gupta-sproull")) == ("over", "gupta-sproull")
    assert blend_of(wireframe("wu", blend="over")) == ("over", "")
    assert blend_of(wireframe("bresenham")) == ("opaque", "")
    assert blend_of(Settings(line="wu")) == ("opaque", "")


@pytest.mark.parametrize("line", SMOOTH)
def test_the_inserted_blending_is_told_and_is_over(line):
    inserted, chosen = drawn([CORNERS], line), drawn([CORNERS], line, blend="over")
    assert inserted.statistics["blend"].note == line
    assert chosen.statistics["blend"].note == ""
    assert drawn([CORNERS], "bresenham").statistics["blend"].note == ""
    assert inserted.color.tobytes() == chosen.color.tobytes()


@pytest.mark.parametrize("line", SMOOTH)
def test_the_intensity_scales_alpha(line):
    half = np.ones((1, 3, 4)) * [1, 1, 1, 0.5]
    whole, thin = drawn([CORNERS], line), drawn([CORNERS], line, values=half)
    # Where only one fragment is.
    one = whole.cover_count == 1
    assert one.sum() > 10
    np.testing.assert_allclose(thin.color[one][:, 3], whole.color[one][:, 3] / 2, atol=1e-6)


@pytest.mark.parametrize("visibility", ["z-buffer", "ray-casting"])
@pytest.mark.parametrize("line", SMOOTH)
def test_a_pale_pixel_in_front_does_not_hide_a_line_behind(line, visibility):
    # A level red line, 0.2 above the centres of row 5; then a green one behind it, upright.
    red, green = np.ones((3, 1)) * [1.0, 0, 0, 1], np.ones((3, 1)) * [0.0, 1, 0, 1]
    front, behind = [(-9.0, 5.7), (40.0, 5.7), (15.0, 40.0)], [(7.6, -9.0), (7.6, 40.0), (40.0, 15.0)]
    frame = drawn(
        [front, behind], line, depth=[-0.5, 0.5], values=np.array([red, green]), visibility=visibility
    )
    # Row 5 has most of the red line and hides the green one; row 6 has little of it, and shows it.
    assert frame.color[5, 7, 0] > 0.7
    assert frame.color[5, 7, 1] == 0
    assert frame.primitive[5, 7] == 0
    assert 0 < frame.color[6, 7, 0] < 0.2
    assert frame.color[6, 7, 1] > 0.7
    assert frame.primitive[6, 7] == 1


@pytest.mark.parametrize("line", SMOOTH)
def test_a_line_in_front_drawn_later_covers(line):
    red, green = np.ones((3, 1)) * [1.0, 0, 0, 1], np.ones((3, 1)) * [0.0, 1, 0, 1]
    level, upright = [(-9.0, 5.5), (40.0, 5.5), (15.0, 40.0)], [(7.5, -9.0), (7.5, 40.0), (40.0, 15.0)]
    frame = drawn([upright, level], line, depth=[0.5, -0.5], values=np.array([green, red]))
    assert frame.color[5, 7, 0] > 0.7
    assert frame.primitive[5, 7] == 1


@in_turns(line=SMOOTH, name=["cube", "sphere"])
def test_an_edge_that_two_triangles_share_is_the_same_twice(line, name):
    # The stronger pixels of the second one never pass: they tie with the first, bit for bit.
    scene = make_scene(name)
    source = TraceSource(scene, wireframe(line))
    outlines = source.geometry.outlines
    fragments, tests = source.fragments, source.depth_tests
    ends = np.sort(outlines.window.reshape(-1, 4).round(9), axis=1)
    _, edge, count = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
    assert (count == 2).sum() > 10
    of_fragment = edge.ravel()[fragments.segment]
    key = np.stack([of_fragment, fragments.column, fragments.row], axis=1)
    _, first, again = np.unique(key, axis=0, return_index=True, return_inverse=True)
    later = np.arange(len(key)) != first[again.ravel()]
    strong = fragments.intensity >= WRITTEN_INTENSITY
    assert (later & strong).sum() > 50
    twin = first[again.ravel()]
    assert np.array_equal(fragments.intensity[later], fragments.intensity[twin[later]])
    assert np.array_equal(source.depths[2][later], source.depths[2][twin[later]])
    assert not tests.passes[later & strong].any()


def test_segments_run_to_the_right_and_keep_their_ends():
    source = TraceSource(make_scene("cube"), wireframe("bresenham"))
    outlines = source.geometry.outlines
    ordered = run_rightwards(outlines)
    way = ordered.window[:, 1] - ordered.window[:, 0]
    assert ((way[:, 0] > 0) | ((way[:, 0] == 0) & (way[:, 1] >= 0))).all()
    swapped = (ordered.window != outlines.window).any(axis=(1, 2))
    assert swapped.any()
    assert not swapped.all()
    for name in ("window", "w", "depth", "shares", "window_shares"):
        before, after = getattr(outlines, name), getattr(ordered, name)
        assert np.array_equal(
            np.where(swapped.reshape(-1, *[1] * (before.ndim - 1)), before[:, ::-1], before), after
        )


@in_turns(line=SMOOTH, depth=table.names("depth"), blend=table.names("blend"))
def test_rows_give_the_picture_with_every_depth_and_blend_method(line, depth, blend):
    scene = make_scene("cube")
    settings = wireframe(line, depth=depth, blend=blend)
    frame, traced = render(scene, settings), trace(scene, settings)
    depths, blends = (traced.stage(stage) for stage in ("depth", "blend"))
    assert depths.state(depths.steps.count)["depth"].tobytes() == frame.depth.tobytes()
    assert np.array_equal(depths.state(depths.steps.count)["primitive"], frame.primitive)
    c = depths.columns
    assert (c["passes"] & ~c["writes"]).any()
    for row in range(depths.steps.row_count):
        writes, passes = bool(c["writes"][row]), bool(c["passes"][row])
        if "key" in c:
            found = rounded_depth_test(
                c["depth"][row], int(c["number"][row]), int(c["before_key"][row]), writes
            )
            assert found == (c["after_key"][row], passes)
        else:
            is_larger = bool(c["larger_is_nearer"][row])
            found = depth_test(c["stored"][row], c["before"][row], is_larger, writes)
            assert found == (c["after"][row], passes)
    assert blends.state(blends.steps.count)["color"].tobytes() == frame.color.tobytes()
    assert np.array_equal(
        blends.columns["source"][:, 3], blends.columns["color"][:, 3] * blends.columns["intensity"]
    )


@pytest.mark.parametrize("line", SMOOTH)
def test_the_bytes_of_the_screen_are_those_of_the_picture(line):
    scene, settings = make_scene("cube"), wireframe(line)
    assert np.array_equal(
        draw_picture(scene, settings).pixels, to_display(render(scene, settings).color).pixels
    )


@pytest.mark.parametrize("line", SMOOTH)
def test_the_history_of_a_pixel_ends_with_its_colour(line):
    clip = clip_of_window([CORNERS, [(2.0, 9.0), (14.0, 2.0), (14.5, 9.5)]], SIZE)
    scene = ClipScene(clip, np.ones((2, 3, 4)) * [1, 0.5, 0.25, 0.75], SIZE)
    settings = wireframe(line)
    frame = render(scene, settings)
    keys = set()
    step = 1 if is_everything() else 3
    for row, column in np.argwhere(frame.cover_count > 0)[::step].tolist():
        history = why(TraceSource(scene, settings), column, row)
        last = [event.after for event in history.events if event.after is not None][-1]
        assert np.array_equal(last.color, frame.color[row, column])
        assert last.triangle == frame.primitive[row, column]
        keys.add(history.verdict.key)
        why(TraceSource(scene, settings), column, row, 0)
    assert "seen" in keys
    assert "blended" in keys


@pytest.mark.parametrize("line_clipping", table.names("line_clipping"))
@pytest.mark.parametrize("line", ["wu", "gupta-sproull"])
@pytest.mark.parametrize("y", [-0.3, 8.3, 0.2])
def test_a_line_beside_the_raster_gives_its_pale_pixels(line: str, line_clipping: str, y: float) -> None:
    scene = assembled("segments", [1.5, 9.5], [y, y], (12, 8))
    settings = Settings(line=line, line_clipping=line_clipping)
    drawn = draw_lines([[[1.5, y], [9.5, y]]], 12, 8, line).pixels
    wanted = np.zeros((8, 12), int)
    np.add.at(wanted, tuple(drawn.T[::-1]), 1)
    assert wanted.any()
    assert np.array_equal(render(scene, settings).cover_count, wanted)
    found = trace(scene, settings)
    pixels = found.stage("raster").pixel
    assert np.array_equal(pixels[pixels[:, 0] >= 0], drawn)
    assert found.stage("cull").columns["verdict"][-1] == "kept"
