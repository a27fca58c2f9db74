import time

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QColor, QWheelEvent
from PySide6.QtWidgets import QApplication

from core.records.steps import Level
from tests.widgets.showing import shown
from widgets.basics.drawing import Mark
from widgets.basics.theme import current_theme
from widgets.timeline.bar import TimelineBar
from widgets.timeline.run_picture import TimelineRun, column_counts, flag_height, lane_height
from widgets.timeline.transport import SPEEDS, Timeline

RUN = TimelineRun(
    512,
    {
        Mark.COVERED: np.arange(0, 100, dtype=np.int64),
        Mark.REJECTED: np.arange(100, 300, dtype=np.int64),
        Mark.TIE: np.array([133], dtype=np.int64),
        Mark.NAN: np.array([400], dtype=np.int64),
        Mark.PINNED: np.array([133, 300], dtype=np.int64),
    },
)


@pytest.fixture
def timeline(qtbot) -> Timeline:
    result = Timeline()
    result.show_run(RUN)
    result.show_position(134)
    return shown(qtbot, result, 1200, 110)


@pytest.fixture
def bar(qtbot) -> TimelineBar:
    result = TimelineBar()
    result.show_run(RUN)
    return shown(qtbot, result, 1000, 80)


def wheel(widget: TimelineBar, x: float, turns: int, modifiers=Qt.KeyboardModifier.NoModifier) -> None:
    place = QPointF(x, 30.0)
    event = QWheelEvent(
        place,
        QPointF(widget.mapToGlobal(place.toPoint())),
        QPoint(),
        QPoint(0, 120 * turns),
        Qt.MouseButton.NoButton,
        modifiers,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(widget, event)


def test_marks_are_counted_per_column() -> None:
    steps = np.array([0, 1, 2, 5, 9], dtype=np.int64)
    assert column_counts(steps, 0.0, 10.0, 5).tolist() == [2, 1, 1, 0, 1]
    assert column_counts(steps, 4.0, 8.0, 2).tolist() == [1, 0]


def test_a_click_on_a_step_asks_for_the_position_after_it(qtbot, bar) -> None:
    seen = []
    bar.position_requested.connect(seen.append)
    qtbot.mouseClick(bar, Qt.MouseButton.LeftButton, pos=QPoint(round(bar.x_of(200.5)), 30))
    assert seen == [201]
    qtbot.mouseClick(bar, Qt.MouseButton.LeftButton, pos=QPoint(bar.width() - 1, 30))
    assert seen[-1] == 512


def test_dragging_scrubs_and_each_position_is_asked_for_once(qtbot, bar) -> None:
    seen = []

    def follow(position: int) -> None:
        seen.append(position)
        bar.show_position(position)

    bar.position_requested.connect(follow)
    qtbot.mousePress(bar, Qt.MouseButton.LeftButton, pos=QPoint(round(bar.x_of(10.5)), 30))
    for step in (20.5, 20.5, 30.5, 5.5):
        qtbot.mouseMove(bar, QPoint(round(bar.x_of(step)), 30))
    qtbot.mouseRelease(bar, Qt.MouseButton.LeftButton, pos=QPoint(round(bar.x_of(5.5)), 30))
    assert seen == [11, 21, 31, 6]


def test_the_wheel_zooms_about_the_mouse_and_a_double_click_shows_all(qtbot, bar) -> None:
    x = bar.x_of(200.0)
    wheel(bar, x, 5)
    first, last = bar.visible_stretch()
    assert last - first < 512 * 0.4
    assert bar.x_of(200.0) == pytest.approx(x, abs=1.0)
    wheel(bar, x, -1, Qt.KeyboardModifier.ShiftModifier)
    assert bar.visible_stretch()[0] > first
    qtbot.mouseDClick(bar, Qt.MouseButton.LeftButton, pos=QPoint(500, 30))
    assert bar.visible_stretch() == (0.0, 512.0)


def test_zooming_stays_inside_the_run(bar) -> None:
    for _ in range(60):
        wheel(bar, 300.0, 3)
    first, last = bar.visible_stretch()
    assert last - first == pytest.approx(8.0)
    for _ in range(60):
        wheel(bar, 300.0, -3)
    assert bar.visible_stretch() == (0.0, 512.0)


def test_the_view_moves_by_an_eighth_of_itself(bar) -> None:
    for direction in (1, -1):
        bar.show_everything()
        bar.zoom(0.25, (bar.x_of(0) + bar.x_of(512)) / 2)
        first, last = bar.visible_stretch()
        bar.move_view(direction)
        moved = direction * (last - first) / 8
        assert bar.visible_stretch() == pytest.approx((first + moved, last + moved))


def test_the_view_follows_the_position(bar) -> None:
    bar.zoom(0.05, bar.x_of(10.0))
    bar.show_position(400)
    first, last = bar.visible_stretch()
    assert first <= 400 <= last


def test_each_outcome_has_its_own_lane_and_colour(bar) -> None:
    picture = bar.grab().toImage()
    theme = current_theme()
    side = lane_height()
    for number, (color, step) in enumerate(((theme.covered, 50.5), (theme.rejected, 200.5))):
        y = flag_height() + number * side + side // 2
        assert picture.pixelColor(round(bar.x_of(step)), y) == QColor(color)
        assert picture.pixelColor(round(bar.x_of(450.0)), y) == QColor(theme.canvas)


def test_keys_step_jump_and_zoom(qtbot, bar) -> None:
    seen = []
    bar.position_requested.connect(seen.append)
    bar.show_position(10)
    bar.setFocus()
    for key in (Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Home, Qt.Key.Key_End):
        qtbot.keyClick(bar, key)
    assert seen == [9, 11, 0, 512]
    qtbot.keyClick(bar, Qt.Key.Key_Plus)
    assert bar.visible_stretch()[1] - bar.visible_stretch()[0] == 256.0


def test_a_million_positions_paint_fast(qtbot) -> None:
    count = 1_000_000
    kinds = np.random.default_rng(1).integers(0, 3, count)
    marks = {Mark.COVERED: np.flatnonzero(kinds == 0), Mark.REJECTED: np.flatnonzero(kinds == 1)}
    bar = TimelineBar()
    bar.show_run(TimelineRun(count, {**marks, Mark.PINNED: np.arange(0, count, 50, dtype=np.int64)}))
    shown(qtbot, bar, 1280, 80)
    bar.grab()
    start = time.process_time()
    for _ in range(20):
        bar.zoom(0.9, 600.0)
        bar.repaint()
    assert (time.process_time() - start) / 20 < 0.2


def test_the_buttons_ask_for_steps_and_ends(qtbot, timeline) -> None:
    steps, ends = [], []
    timeline.step_requested.connect(steps.append)
    timeline.ends_requested.connect(ends.append)
    for button in (
        timeline.back_button,
        timeline.forward_button,
        timeline.first_button,
        timeline.last_button,
    ):
        qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    assert (steps, ends) == ([-1, 1], [-1, 1])


def test_at_the_ends_the_buttons_are_off(timeline) -> None:
    timeline.show_position(0)
    assert not timeline.back_button.isEnabled()
    assert timeline.forward_button.isEnabled()
    timeline.show_position(512)
    assert timeline.back_button.isEnabled()
    assert not timeline.play_button.isEnabled()


def test_playing_asks_for_steps_in_time_and_stops_at_the_end(qtbot, timeline) -> None:
    steps = []
    position = [509]

    def follow(direction: int) -> None:
        steps.append(direction)
        position[0] += direction
        timeline.show_position(position[0])

    timeline.step_requested.connect(follow)
    timeline.show_speed(60.0)
    timeline.show_position(509)
    qtbot.mouseClick(timeline.play_button, Qt.MouseButton.LeftButton)
    assert timeline.play_button.accessibleName() == "Pause"
    qtbot.waitUntil(lambda: position[0] == 512)
    assert steps == [1, 1, 1]
    assert not timeline.is_playing()
    assert timeline.play_button.accessibleName() == "Play"


def test_levels_are_chosen_by_click_and_named_by_the_stage(qtbot, timeline) -> None:
    seen = []
    timeline.level_chosen.connect(seen.append)
    qtbot.mouseClick(timeline.level_buttons[Level.GROUP], Qt.MouseButton.LeftButton)
    qtbot.mouseClick(timeline.level_buttons[Level.GROUP], Qt.MouseButton.LeftButton)
    assert seen == [Level.GROUP]
    timeline.show_level(Level.OPERATION)
    assert timeline.level_buttons[Level.OPERATION].isChecked()
    assert not timeline.level_buttons[Level.GROUP].isChecked()
    timeline.show_level_names({Level.GROUP: "Clip plane"})
    assert timeline.level_buttons[Level.GROUP].text() == "Clip plane"
    assert timeline.level_buttons[Level.PIXEL].text() == "Pixel"
    assert seen == [Level.GROUP]


def test_a_typed_position_is_asked_for(qtbot, timeline) -> None:
    seen = []
    timeline.position_requested.connect(seen.append)
    assert timeline.position_box.text() == "134"
    assert timeline.count_label.text() == "/ 512"
    timeline.position_box.setFocus()
    timeline.position_box.selectAll()
    qtbot.keyClicks(timeline.position_box, "9999")
    qtbot.keyClick(timeline.position_box, Qt.Key.Key_Return)
    assert seen == [512]
    timeline.position_box.selectAll()
    qtbot.keyClicks(timeline.position_box, "x")
    qtbot.keyClick(timeline.position_box, Qt.Key.Key_Return)
    assert seen == [512]
    assert timeline.position_box.text() == "134"


def test_speed_changes_by_key_and_code(timeline) -> None:
    seen = []
    timeline.speed_changed.connect(seen.append)
    timeline.show_speed(10.0)
    assert seen == []
    assert timeline.clock.interval() == 100
    timeline.change_speed(1)
    assert seen == [30.0]
    timeline.change_speed(99)
    assert seen[-1] == SPEEDS[-1]


def test_nothing_is_emitted_when_set_by_code(timeline) -> None:
    seen = []
    for signal in (timeline.position_requested, timeline.step_requested, timeline.level_chosen):
        signal.connect(seen.append)
    timeline.show_run(TimelineRun(10))
    timeline.show_position(3)
    timeline.show_level(Level.STAGE)
    assert seen == []
    assert timeline.position_box.text() == "3"


def test_every_control_has_a_name_and_a_tooltip(timeline) -> None:
    controls = [
        timeline.first_button,
        timeline.back_button,
        timeline.play_button,
        timeline.forward_button,
        timeline.last_button,
        timeline.position_box,
        timeline.speed_box,
        *timeline.level_buttons.values(),
    ]
    assert all(control.accessibleName() and control.toolTip() for control in controls)


def test_a_button_that_cannot_be_used_says_why_until_it_can(timeline) -> None:
    timeline.show_run(TimelineRun(4))
    for position, unusable in ((0, (0, 1)), (2, ()), (4, (2, 3, 4)), (3, ())):
        timeline.show_position(position)
        for place, button in enumerate(timeline.transport_buttons()):
            assert button.isEnabled() == (place not in unusable)
            assert ("\n" in button.toolTip()) == (place in unusable), button.toolTip()
