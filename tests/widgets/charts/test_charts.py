"""Charts and their legend: what the user does is told, what the program does is silent; axes keep the order."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QColor, QIcon, QImage, QPainter
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from tests.widgets.showing import shown
from widgets.basics.drawing import LabelPlaces
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import DARK, LIGHT, contrast
from widgets.experiments.chart import Chart
from widgets.experiments.chart_canvas import scale_of, time_text
from widgets.experiments.series import (
    SHAPES,
    ChartAxis,
    ChartEmpty,
    ChartLegend,
    ChartPicture,
    ChartSeries,
    SeriesIcon,
    series_color,
)

KEY, LEFT = Qt.Key, Qt.MouseButton.LeftButton
TIME, ERROR = ChartAxis("Time per line", "s"), ChartAxis("Misclassified pixels", "per million")


def one(key: str, number: int, x: float, y: float) -> ChartSeries:
    return ChartSeries(key, key.title(), number, np.array([x]), np.array([y]), np.array([[0.9 * x, 1.2 * x]]))


POINTS = (
    one("fast", 0, 1e-6, 500.0),
    one("middle", 1, 1e-5, 20.0),
    one("exact", 2, 1e-4, 0.0),
    one("beaten", 3, 1e-4, 500.0),
)
PICTURE = ChartPicture(TIME, ERROR, POINTS, ("fast", "middle", "exact"))


def told(widget: Chart | ChartLegend, action: Callable[[], object]) -> list[tuple[object, ...]]:
    """Return what a widget tells while something is done, signal by signal."""
    found: list[tuple[object, ...]] = []
    for name in ("series_hovered", "point_hovered", "series_left", "series_chosen", "point_chosen"):
        if hasattr(widget, name):
            getattr(widget, name).connect(lambda *args, name=name: found.append((name, *args)))
    action()
    return found


@pytest.fixture
def chart(qtbot: QtBot) -> Chart:
    made = shown(qtbot, Chart("Error against time"), 600, 400)
    made.show_picture(PICTURE)
    return made


@pytest.fixture(params=["chart", "legend"])
def pane(request: pytest.FixtureRequest, qtbot: QtBot) -> Chart | ChartLegend:
    if request.param == "chart":
        found: Chart = request.getfixturevalue("chart")
        return found
    made = shown(qtbot, ChartLegend(), 200, 300)
    made.show_series(POINTS, PICTURE.front)
    return made


def at(pane: Chart | ChartLegend, key: str) -> QPoint:
    if isinstance(pane, ChartLegend):
        return pane.visualItemRect(pane.item([s.key for s in POINTS].index(key))).center()
    place = pane.place_of(key)
    return place.toPoint()


def image_of(chart: Chart) -> QImage:
    image = QImage(chart.size(), QImage.Format.Format_RGB32)
    QWidget.render(chart, image, QPoint())
    return image


@pytest.mark.parametrize("held", ["NoModifier", "ControlModifier", "ShiftModifier"])
def test_a_click_and_enter_choose_and_ctrl_or_shift_adds(pane, held: str) -> None:
    modifier, adds = Qt.KeyboardModifier[held], held != "NoModifier"
    seen = told(pane, lambda: QTest.mouseClick(pane.viewport(), LEFT, modifier, at(pane, "exact")))
    assert ("series_chosen", "exact", adds) in seen
    pane.show_pointed("middle")
    seen = told(pane, lambda: QTest.keyClick(pane, KEY.Key_Return, modifier))
    assert seen[0] == ("series_chosen", "middle", adds)


def test_the_pointer_tells_what_it_is_on(pane) -> None:
    QTest.mouseMove(pane.viewport(), at(pane, "fast"))
    near = QPoint(5, -4)
    assert ("series_hovered", "middle") in told(
        pane, lambda: QTest.mouseMove(pane.viewport(), at(pane, "middle") + near)
    )
    if isinstance(pane, Chart):
        away = told(pane, lambda: QTest.mouseMove(pane.viewport(), at(pane, "middle") + QPoint(60, 40)))
        assert (away, pane.pointed) == ([("series_left",)], "")


def test_what_is_set_by_the_program_tells_nothing(pane) -> None:
    def show() -> None:
        pane.show_pointed("exact")
        pane.show_marks({"fast": "A"})
        pane.show_pointed("")
        if isinstance(pane, Chart):
            pane.show_pointed("exact")
            pane.show_picture(ChartPicture(TIME, ERROR, POINTS[:2]))

    assert told(pane, show) == []
    if isinstance(pane, Chart):
        assert pane.pointed == ""
    else:
        assert (pane.currentRow(), pane.item(0).text()) == (-1, "A: Fast")
        assert [row for row in range(4) if pane.item(row).font().bold()] == [0, 1, 2]


def test_arrows_reach_every_point_and_stop_at_the_ends(chart: Chart, pane) -> None:
    if isinstance(pane, ChartLegend):
        pane.show_pointed("fast")
        assert told(pane, lambda: QTest.keyClick(pane, KEY.Key_Down)) == [("series_hovered", "middle")]
        return
    keys = (KEY.Key_Right, KEY.Key_Right, KEY.Key_Down, KEY.Key_Right, KEY.Key_Up)
    seen = told(chart, lambda: [QTest.keyClick(chart, key) for key in keys])
    hovered = [key for name, key, *_ in seen if name == "series_hovered"]
    assert hovered == ["fast", "middle", "exact", "middle"], "the last of the row is the end"
    reached, waiting = set(), ["fast"]
    while waiting:
        key = waiting.pop()
        for arrow in (KEY.Key_Left, KEY.Key_Right, KEY.Key_Up, KEY.Key_Down) if key not in reached else ():
            chart.show_pointed(key)
            QTest.keyClick(chart, arrow)
            waiting.append(chart.pointed)
        reached.add(key)
    assert reached == {series.key for series in POINTS}


def test_a_click_beside_the_points_and_a_drag_choose_nothing(chart: Chart) -> None:
    def act() -> None:
        start = at(chart, "middle")
        QTest.mouseClick(chart.viewport(), LEFT, pos=start + QPoint(70, 40))
        QTest.mousePress(chart.viewport(), LEFT, pos=start)
        QTest.mouseRelease(chart.viewport(), LEFT, pos=start + QPoint(12, 0))

    assert not any(name.endswith("chosen") for name, *_ in told(chart, act))


def test_marks_stand_where_their_values_are_and_the_front_goes_through_its_own(
    chart: Chart, monkeypatch
) -> None:
    fast, middle, exact, beaten = (at(chart, series.key) for series in POINTS)
    assert fast.x() < middle.x() < exact.x() == beaten.x()
    assert fast.y() == beaten.y() < middle.y() < exact.y()
    image = image_of(chart)
    assert all(image.pixelColor(at(chart, s.key)) == QColor(series_color(s.number)) for s in POINTS)
    # Beside the last point, on its first choice of places, the line comes down.
    chart.show_picture(ChartPicture(TIME, ERROR, (*POINTS, one("near", 4, 8e-6, 100.0)), PICTURE.front))
    lines = chart.front_lines()
    on_line = {s.key: sum(line.contains(chart.place_of(s.key)) for line in lines) for s in POINTS}
    assert on_line == {"fast": 2, "middle": 2, "exact": 2, "beaten": 0}
    names, find = [], LabelPlaces.find
    monkeypatch.setattr(LabelPlaces, "find", lambda *args: names.append(find(*args)) or names[-1])
    image_of(chart)
    assert len(names) == 5
    assert not any(name.intersects(line) for name in names for line in lines)


def test_every_state_looks_different_and_comes_back(chart: Chart) -> None:
    looks = [image_of(chart)]
    for change in (
        lambda: chart.show_pointed("exact"),
        lambda: (chart.show_pointed(""), chart.show_marks({"exact": "A"})),
        lambda: (chart.show_marks({}), chart.show_picture(ChartEmpty("Press Measure."))),
        lambda: chart.show_picture(ChartEmpty("")),
    ):
        change()
        looks.append(image_of(chart))
    assert all(one != other for k, one in enumerate(looks) for other in looks[:k])
    assert chart.places() == []
    chart.show_picture(PICTURE)
    assert image_of(chart) == looks[0]


def test_a_zoom_stays_until_all_is_shown_again(chart: Chart) -> None:
    before = [at(chart, series.key) for series in POINTS]
    chart.view.scaleBy((0.2, 0.2))
    chart.show_picture(PICTURE)
    assert len(chart.places()) < len(POINTS), "new numbers leave the view as the user has put it"
    chart.fit()
    assert [at(chart, series.key) for series in POINTS] == before
    chart.view.scaleBy((0.9, 0.9))
    zoomed = at(chart, "exact")
    QTest.mouseDClick(chart.viewport(), LEFT, pos=zoomed)
    assert at(chart, "exact") == zoomed != before[2]
    QTest.mouseDClick(chart.viewport(), LEFT, pos=at(chart, "middle") + QPoint(60, 40))
    assert [at(chart, series.key) for series in POINTS] == before


def test_the_points_of_a_line_are_told_by_number_and_those_without_a_place_left_out(chart: Chart) -> None:
    line = ChartSeries("line", "Line", 0, np.array([1.0, 10, 100]), np.array([5.0, 0.0, np.nan]))
    chart.show_picture(ChartPicture(ChartAxis("Width"), ChartAxis("Severity"), (line,), is_named=False))
    assert [index for _, index, _ in chart.points()] == [0, 1]
    first, second = (chart.place_of("line", index).toPoint() for index in (0, 1))
    assert ("point_chosen", "line", 1) in told(
        chart, lambda: QTest.mouseClick(chart.viewport(), LEFT, pos=second)
    )
    seen = told(chart, lambda: [QTest.mouseMove(chart.viewport(), place) for place in (first, second)])
    assert seen.count(("series_hovered", "line")) <= 1, "another point of the same series"
    assert ("point_hovered", "line", 0) in seen


def test_twelve_are_named_the_pointed_chosen_and_front_ones_first(chart: Chart) -> None:
    series = tuple(one(f"m{k}", k, 1e-6 * (k + 1), 0.1 * (k + 1)) for k in range(30))
    chart.show_picture(ChartPicture(TIME, ERROR, series, ("m20", "m21")))
    chart.show_marks({"m25": "A"})
    chart.show_pointed("m29")
    named = [each.key for each in chart.named_series()]
    assert (named[:4], len(named)) == (["m29", "m25", "m20", "m21"], 12)


def test_series_differ_by_shape_and_can_be_read_as_text(qtbot: QtBot) -> None:
    masks = set()
    for number in range(len(SHAPES)):
        image = QImage(24, 24, QImage.Format.Format_Alpha8)
        image.fill(0)
        with QPainter(image) as painter:
            QIcon(SeriesIcon(number)).paint(painter, image.rect())
        masks.add(bytes(image.constBits()))
    assert len(masks) == 12
    assert len({series_color(number, LIGHT) for number in range(8)}) == 8
    assert (
        min(contrast(series_color(k, theme), theme.panel) for k in range(8) for theme in (LIGHT, DARK)) > 4.5
    )


def test_a_closed_chart_leaves_another_theme_alone(chart: Chart, qapp: QApplication) -> None:
    chart.close()
    apply_theme(qapp, DARK)
    apply_theme(qapp, LIGHT)
    assert chart.closed


@given(st.lists(st.floats(0, 1e300) | st.just(float("inf")), min_size=1, max_size=12))
def test_places_keep_the_order_inside_of_the_axis_and_labels_stand_at_their_values(
    values: list[float],
) -> None:
    array = np.array(sorted(values))
    scale = scale_of(array)
    places = scale.positions(array)
    assert (np.diff(places) >= 0).all()
    assert ((places >= scale.start) & (places <= scale.stop)).all()
    assert (scale.has_zero, scale.has_infinite) == (0 in values, float("inf") in values)
    assert scale.has_zero == (scale.start < scale.low)
    assert len(scale.separators) == scale.has_zero + scale.has_infinite
    zero, others = places[array == 0], places[array > 0]
    assert not len(zero) or not len(others) or zero.max() < scale.low < others.min()
    for position, text in scale.ticks(scale.start, scale.stop, ""):
        value = (
            {"0": 0.0, "∞": np.inf}.get(text)
            if text in "0∞"
            else float(text.replace(",", "").replace("−", "-"))
        )
        assert scale.positions(np.array([value]))[0] == pytest.approx(position)


def test_labels_by_the_number_of_decades_and_times_with_their_prefix() -> None:
    assert np.isnan(scale_of(np.array([1.0, np.nan, -1.0])).positions(np.array([np.nan, -1.0]))).all()
    few, many, times = (scale_of(np.array(ends)) for ends in ([1.0, 20.0], [1.0, 1e9], [1e-6, 1e-3]))
    assert [text for _, text in few.ticks(few.start, few.stop, "")] == ["1", "2", "5", "10", "20"]
    texts = [text for _, text in many.ticks(many.start, many.stop, "")]
    assert len(texts) <= 7
    assert "100" in texts
    assert "10 µs" in [text for _, text in times.ticks(times.start, times.stop, "s")]
    assert [time_text(seconds) for seconds in (2.5, 0.0015, 1e-7, 0)] == ["2.5 s", "1.5 ms", "100 ns", "0 s"]
