import threading

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from app.views.scene_lines import SpaceLine, draw_space_lines, visible_part
from app.views.scene_picture import DrawnScene
from app.views.scene_worker import SceneWorker
from core.geometry.culling import plane_distances

PLAIN = DrawnScene(np.zeros((1, 1, 4), np.uint8), np.full((1, 1), -1), 0.0)


@given(arrays(np.float64, (3, 2, 4), elements=st.integers(-256, 256).map(lambda number: number / 64)))
def test_cut_segments_are_inside_and_on_their_segments(clip):
    cut, source = visible_part(clip)
    assert (plane_distances(cut) >= -1e-9).all()
    assert (cut[..., 3] > 0).all()
    for (start, end), k in zip(cut, source, strict=True):
        whole = clip[k, 1] - clip[k, 0]
        for point in (start, end):
            t = (point - clip[k, 0]) @ whole / max(whole @ whole, 1e-300)
            assert np.allclose(clip[k, 0] + t * whole, point, atol=1e-9)
    # What is dropped has no inside point among many (an end at w = 0 is the viewer's own eye: no line).
    for k in sorted(set(np.flatnonzero((clip[..., 3] != 0).all(axis=1)).tolist()) - set(source.tolist())):
        along = np.linspace(0, 1, 33)[:, None]
        assert not (plane_distances(clip[k, 0] + along * (clip[k, 1] - clip[k, 0])) > 1e-6).all(axis=1).any()


def test_hidden_parts_are_faint():
    pixels = np.zeros((5, 9, 4), np.uint8)
    inverse_w = np.zeros((5, 9), np.float32)
    inverse_w[:, 4:] = 2.0  # something at w = 0.5, nearer than the line at w = 1
    line = SpaceLine(np.array([[-1.0, 0, 0], [1, 0, 0]]), "text", hidden=0.25)
    draw_space_lines(pixels, inverse_w, (line,), np.eye(4), ["#ffffff"])
    assert pixels[2, 0:4, 0].tolist() == [255] * 4
    assert set(pixels[2, 5:, 0].tolist()) == {64}
    assert pixels[[0, 1, 3, 4]].max() == 0


def test_thick_lines_and_points_that_are_not_finite():
    pixels = np.zeros((6, 6, 4), np.uint8)
    points = np.array([[-0.9, -0.5, 0], [0.9, -0.5, 0], [np.nan, 0, 0], [1e300, 0, 0]])
    draw_space_lines(
        pixels, np.zeros((6, 6), np.float32), (SpaceLine(points, "text", 2),), np.eye(4), ["#0000ff"]
    )
    assert (pixels[..., 2] > 0).any(axis=1).tolist() == [False, True, True, False, False, False]
    draw_space_lines(pixels, np.zeros((6, 6), np.float32), (), np.eye(4), [])


def test_only_the_last_waiting_picture_is_drawn(qtbot):
    worker = SceneWorker()
    begun, go = threading.Event(), threading.Event()
    ran: list[str] = []

    def slow() -> DrawnScene:
        begun.set()
        go.wait(5)
        ran.append("first")
        return PLAIN

    def named(name: str):
        def draw() -> DrawnScene:
            ran.append(name)
            return PLAIN

        return draw

    told: list[int] = []
    worker.drawn.connect(lambda number, _: told.append(number))
    worker.start(slow)
    begun.wait(5)
    worker.start(named("second"))
    last = worker.start(named("third"))
    go.set()
    qtbot.waitUntil(lambda: last in told)
    assert ran == ["first", "third"]
    assert worker.latest == last
    worker.stop()


def test_a_failure_is_told_and_the_next_picture_is_drawn(qtbot):
    worker = SceneWorker()

    def fail() -> DrawnScene:
        raise MemoryError("no room")

    with qtbot.waitSignal(worker.failed) as told:
        worker.start(fail)
    assert "no room" in told.args[1]
    with qtbot.waitSignal(worker.drawn):
        worker.start(lambda: PLAIN)
    worker.stop()


@pytest.mark.parametrize("column", [0, 5, 9])
def test_a_coarse_picture_is_read_at_fine_pixels(column):
    drawn = DrawnScene(np.zeros((4, 10, 4), np.uint8), np.arange(10).reshape(2, 5), 0.0)
    assert drawn.triangle_at(column, 3) == 5 + column // 2
