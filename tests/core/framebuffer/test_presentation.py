"""Frame buffers and the screen, against a simulation of every 1/H of a millisecond that knows nothing of the rules."""

from fractions import Fraction
from math import ceil, lcm

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import Settings, trace
from core.framebuffer.flushing import Flush, copy_at_once, copy_by_pixel, copy_by_row
from core.framebuffer.presentation import (
    Buffering,
    available,
    drawn_time,
    events,
    picture_read,
    pictures_read,
    schedule,
    torn,
)
from core.framebuffer.traced_presentation import moved_pictures
from core.methods import table
from lessons.scenes import make_scene

SINGLE, DOUBLE, AT_ONCE, TRIPLE = (
    table.get("presentation", name).function() for name in ("single", "double", "double-at-once", "triple")
)
ROWS, WHOLE = Flush(), Flush(waits_for_picture=True)
TIMES = st.integers(1, 40)


def simulated(
    buffering: Buffering, flush: Flush, drawing: int, refresh: int, height: int, count: int
) -> np.ndarray:
    """Return (count, H) pictures by running screen and renderer beside each other, a 1/H of a millisecond a turn."""
    memory = [[0] * height for _ in range(buffering.buffer_count)]
    front, showing = 0, 0
    waiting: list[int] = []
    picture, done = 1, 0
    seen = np.zeros((count, height), int)
    for turn in range(count * refresh * height + 1):
        # The renderer has worked one turn more, unless it has no buffer.
        if turn:
            into = picture % buffering.buffer_count
            is_free = buffering.buffer_count == 1 or (
                into != front and into not in (p % len(memory) for p in waiting)
            )
            if is_free:
                done += 1
                if done % drawing == 0 and not flush.waits_for_picture:
                    memory[into][done // drawing - 1] = picture
                if done == drawing * height:
                    memory[into] = [picture] * height
                    waiting.append(picture)
                    picture, done = picture + 1, 0
        is_blank = turn > 0 and turn % (refresh * height) == 0
        if waiting and buffering.buffer_count > 1 and (is_blank or not buffering.waits_for_blank):
            showing = waiting.pop(0)
            front = showing % buffering.buffer_count
        elif buffering.buffer_count == 1:
            waiting.clear()
        if turn % refresh == 0 and turn < count * refresh * height:
            frame, line = divmod(turn // refresh, height)
            seen[frame, line] = memory[front][line]
    return seen


@settings(deadline=None, max_examples=60)
@given(TIMES, TIMES, st.integers(1, 5), st.sampled_from([SINGLE, DOUBLE, AT_ONCE, TRIPLE]), st.booleans())
def test_the_screen_shows_what_the_simulation_shows(
    drawing: int, refresh: int, height: int, buffering: Buffering, whole: bool
) -> None:
    count, flush = 6, WHOLE if whole else ROWS
    times = schedule(buffering, drawing, refresh, count * refresh)
    since = available(buffering, flush, times, height, drawing)
    found = pictures_read(since, count, refresh)
    assert np.array_equal(found, simulated(buffering, flush, drawing, refresh, height, count))
    for frame, line in ((1, 0), (count - 1, height - 1)):
        assert picture_read(frame, line, height, refresh, since[:, line].tolist())[1] == found[frame, line]


@settings(deadline=None, max_examples=60)
@given(TIMES, TIMES)
def test_rates_and_tearing_are_those_of_the_laws(drawing: int, refresh: int) -> None:
    whole = lcm(drawing, refresh)
    shown = schedule(DOUBLE, drawing, refresh, 9 * whole).shown
    assert set(np.diff(shown)[:-1].tolist()) == {refresh * ceil(drawing / refresh)}
    shown = schedule(TRIPLE, drawing, refresh, 40 * whole).shown
    rate = Fraction(int(np.searchsorted(shown, 39 * whole) - np.searchsorted(shown, 20 * whole)), 19 * whole)
    assert rate == min(Fraction(1, refresh), Fraction(1, drawing))
    for buffering in (DOUBLE, TRIPLE):
        since = available(buffering, ROWS, schedule(buffering, drawing, refresh, 9 * refresh), 4, drawing)
        assert not torn(pictures_read(since, 9, refresh)).any()
    height = 64  # A row takes less than any swap is away from a refresh.
    since = available(AT_ONCE, ROWS, schedule(AT_ONCE, drawing, refresh, whole), height, drawing)
    found = torn(pictures_read(since, whole // refresh, refresh))
    inside = {k * drawing // refresh for k in range(1, whole // drawing) if k * drawing % refresh}
    assert set(np.flatnonzero(found).tolist()) == inside
    assert bool(found.any()) == (drawing % refresh != 0)


def test_the_numbers_of_the_lecture() -> None:
    """20 ms a picture on a screen of 60 Hz, in thirds of a millisecond: 30 and 50 pictures a second, 2 of 3 torn."""
    drawing, refresh, second = 60, 50, 3000
    for buffering, rate in ((DOUBLE, 30), (TRIPLE, 50), (AT_ONCE, 50)):
        shown = schedule(buffering, drawing, refresh, 10 * second).shown
        assert np.searchsorted(shown, 6 * second) - np.searchsorted(shown, 5 * second) == rate
    since = available(AT_ONCE, ROWS, schedule(AT_ONCE, drawing, refresh, second), 48, drawing)
    assert torn(pictures_read(since, 60, refresh)).sum() == 40
    assert schedule(DOUBLE, 20, 16, 64).shown.tolist() == [0, 32, 64]
    assert schedule(TRIPLE, 20, 16, 61).shown.tolist() == [0, 32, 48, 64, 80]


@pytest.mark.parametrize("flush", table.names("flush"))
@pytest.mark.parametrize("name", ["single", "double", "double-at-once", "triple"])
def test_rows_fold_to_what_the_screen_shows(name: str, flush: str) -> None:
    scene, chosen = make_scene("two-buffers"), Settings(presentation=name, flush=flush)
    found = trace(scene, chosen).stage("resolve")
    plain = trace(scene, Settings()).stage("resolve")
    buffers = {track.name: track for track in found.buffers}
    picture = plain.buffers[0].at(plain.steps.row_count)
    assert np.array_equal(buffers["display"].at(found.steps.row_count), picture)
    buffering = table.get("presentation", name).function()
    way, height = table.get("flush", flush).function(), scene.size[1]
    happens, times = events(buffering, way, height, 20, 16)
    assert (np.diff(happens.time) >= 0).all()
    since = available(buffering, way, times, height, 20)
    read = pictures_read(since, 5, 16)[:-1]
    moved = moved_pictures(picture, len(times.begun))
    scans = np.flatnonzero(
        found.columns["line"] * (found.steps.kind == found.steps.kinds.index("scan")) == height - 1
    )
    for refresh, row in enumerate(scans.tolist()[:-1]):
        shown = buffers["screen"].at(row + 1)
        for line in range(height):
            assert np.array_equal(shown[height - 1 - line], moved[read[refresh, line], height - 1 - line])
    writes = {"by-row": height, "by-pixel": height * scene.size[0], "at-once": 1}[flush]
    assert found.columns["transfers"].max() == writes


@pytest.mark.parametrize("name", ["double", "double-at-once", "triple"])
def test_the_renderer_never_draws_into_the_front_buffer(name: str) -> None:
    found = trace(make_scene("two-buffers"), Settings(presentation=name)).stage("resolve")
    buffers = {track.name: track for track in found.buffers}
    swaps = np.flatnonzero(found.steps.kind == found.steps.kinds.index("swap"))
    for row in swaps.tolist():
        front = buffers[f"buffer {found.columns['buffer'][row]}"].at(row + 1)
        assert not np.array_equal(buffers["drawn into"].at(row + 1), front)


def test_listings_give_the_rows() -> None:
    found = trace(make_scene("two-buffers"), Settings(presentation="triple")).stage("resolve")
    for row in range(found.steps.row_count):
        kind, values = found.kind_of(row), found.variables(row)
        function = found.listings[kind].function
        if kind == "written":
            assert values["time"] == drawn_time(values["begun"], values["line"], values["height"], 20)
        if kind in ("wait", "swap"):
            before = schedule(TRIPLE, 20, 16, 90).shown[int(values["picture"]) - 1]
            assert values["blank"] == function(values["ready"], before, 16)


@settings(deadline=None, max_examples=20)
@given(st.integers(1, 5), st.integers(1, 5))
def test_every_way_of_flushing_copies_the_picture(width: int, height: int) -> None:
    picture = np.random.default_rng(width).bytes(4 * width * height)
    for name, copy in (("by-row", copy_by_row), ("by-pixel", copy_by_pixel), ("at-once", copy_at_once)):
        memory = bytearray(len(picture))
        count = copy(memory, picture, width)
        assert bytes(memory) == picture
        assert count == table.get("flush", name).function().transfers(height, width)
