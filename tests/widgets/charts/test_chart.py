"""Charts: real movements, clicks and keys; marks differ by shape; names do not overlap."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QColor, QIcon, QImage, QPainter
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from tests.widgets.showing import shown
from widgets.basics.drawn_text import LabelPlaces
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import DARK, LIGHT, contrast
from widgets.charts.chart import Chart
from widgets.charts.records import ChartAxis, ChartEmpty, ChartPicture, ChartSeries
from widgets.charts.series_marks import SHAPES, SeriesIcon, series_color, series_shape

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


@pytest.fixture
def chart(qtbot: QtBot) -> Chart:
    made = shown(qtbot, Chart("Error against time"), 600, 400)
    made.show_picture(PICTURE)
    return made


def at(chart: Chart, key: str) -> QPoint:
    place = chart.place_of(key)
    assert place is not None
    return place.toPoint()


def image_of(chart: Chart) -> QImage:
    image = QImage(chart.size(), QImage.Format.Format_RGB32)
    QWidget.render(chart, image, QPoint())
    return image


def test_the_line_of_the_front_goes_through_its_points_and_no_name(chart: Chart, monkeypatch) -> None:
    # Beside the last point, on its first choice of places, the line comes down.
    chart.show_picture(ChartPicture(TIME, ERROR, (*POINTS, one("near", 4, 8e-6, 100.0)), PICTURE.front))
    lines = chart.front_lines()
    for key in ("fast", "middle", "exact"):
        place = chart.place_of(key)
        assert place is not None
        assert sum(line.contains(place) for line in lines) == 2
    beaten = chart.place_of("beaten")
    assert beaten is not None
    assert not any(line.contains(beaten) for line in lines)
    names = []
    find = LabelPlaces.find

    def noted(places, *args):
        names.append(find(places, *args))
        return names[-1]

    monkeypatch.setattr(LabelPlaces, "find", noted)
    image_of(chart)
    assert len(names) == 5
    assert not any(name.intersects(line) for name in names for line in lines)


def test_time_goes_right_error_goes_up_and_zero_is_below_all(chart: Chart) -> None:
    fast, middle, exact, beaten = (at(chart, key) for key in ("fast", "middle", "exact", "beaten"))
    assert fast.x() < middle.x() < exact.x() == beaten.x()
    assert fast.y() == beaten.y() < middle.y() < exact.y()
    assert all(chart.plot_area().contains(place) for _, place in chart.places())


def test_marks_are_painted_where_their_values_are(chart: Chart) -> None:
    image = image_of(chart)
    for series in POINTS:
        assert image.pixelColor(at(chart, series.key)) == QColor(series_color(series.number))


def test_the_pointer_finds_the_nearest_point(chart: Chart, qtbot: QtBot) -> None:
    with qtbot.waitSignal(chart.series_hovered) as hovered:
        QTest.mouseMove(chart.viewport(), at(chart, "middle") + QPoint(5, -4))
    assert hovered.args == ["middle"]
    with qtbot.waitSignal(chart.series_left):
        QTest.mouseMove(chart.viewport(), at(chart, "middle") + QPoint(60, 40))
    assert chart.pointed == ""


def test_a_click_chooses_and_ctrl_or_shift_adds(chart: Chart, qtbot: QtBot) -> None:
    for modifier, is_added in (
        (Qt.KeyboardModifier.NoModifier, False),
        (Qt.KeyboardModifier.ControlModifier, True),
        (Qt.KeyboardModifier.ShiftModifier, True),
    ):
        with qtbot.waitSignal(chart.series_chosen) as chosen:
            QTest.mouseClick(chart.viewport(), Qt.MouseButton.LeftButton, modifier, at(chart, "exact"))
        assert chosen.args == ["exact", is_added]


def test_a_click_beside_the_points_and_a_drag_choose_nothing(chart: Chart, qtbot: QtBot) -> None:
    with qtbot.assertNotEmitted(chart.series_chosen):
        QTest.mouseClick(
            chart.viewport(), Qt.MouseButton.LeftButton, pos=at(chart, "middle") + QPoint(70, 40)
        )
        start = at(chart, "middle")
        QTest.mousePress(chart.viewport(), Qt.MouseButton.LeftButton, pos=start)
        QTest.mouseRelease(chart.viewport(), Qt.MouseButton.LeftButton, pos=start + QPoint(12, 0))


def test_arrows_go_from_point_to_point_and_enter_chooses(chart: Chart, qtbot: QtBot) -> None:
    chart.setFocus()
    seen = []
    chart.series_hovered.connect(seen.append)
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Right, Qt.Key.Key_Down, Qt.Key.Key_Right, Qt.Key.Key_Up):
        QTest.keyClick(chart, key)
    assert seen == ["fast", "middle", "exact", "middle"], "the last point of the row is the end"
    with qtbot.waitSignal(chart.series_chosen) as chosen:
        QTest.keyClick(chart, Qt.Key.Key_Return, Qt.KeyboardModifier.ShiftModifier)
    assert chosen.args == ["middle", True]


def test_every_point_can_be_reached_by_arrows(chart: Chart) -> None:
    reached, waiting = set(), ["fast"]
    while waiting:
        key = waiting.pop()
        if key in reached:
            continue
        reached.add(key)
        for arrow in (Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Up, Qt.Key.Key_Down):
            chart.show_pointed(key)
            QTest.keyClick(chart, arrow)
            waiting.append(chart.pointed)
    assert reached == {series.key for series in POINTS}


def test_what_is_set_by_the_program_emits_nothing(chart: Chart, qtbot: QtBot) -> None:
    with qtbot.assertNotEmitted(chart.series_hovered), qtbot.assertNotEmitted(chart.series_chosen):
        chart.show_pointed("exact")
        chart.show_marks({"fast": "A"})
        chart.show_picture(ChartPicture(TIME, ERROR, POINTS[:2]))
    assert chart.pointed == ""


def test_pointed_and_chosen_points_are_ringed(chart: Chart) -> None:
    before = image_of(chart)
    chart.show_pointed("exact")
    pointed = image_of(chart)
    assert pointed != before
    chart.show_pointed("")
    chart.show_marks({"exact": "A"})
    assert image_of(chart) not in (before, pointed)


def test_the_wheel_zooms_and_fit_shows_all_again(chart: Chart) -> None:
    before = at(chart, "fast"), at(chart, "exact")
    chart.view.scaleBy((0.2, 0.2))
    assert len(chart.places()) < len(POINTS)
    chart.show_picture(PICTURE)
    assert len(chart.places()) < len(POINTS), "new numbers leave the view as the user has put it"
    chart.fit()
    assert (at(chart, "fast"), at(chart, "exact")) == before


def test_an_empty_chart_says_what_to_do(chart: Chart) -> None:
    full = image_of(chart)
    chart.show_picture(ChartEmpty("Press Measure."))
    assert chart.places() == []
    empty = image_of(chart)
    assert empty != full
    chart.show_picture(ChartEmpty(""))
    assert image_of(chart) != empty
    chart.show_picture(PICTURE)
    assert image_of(chart) == full


def test_lines_have_many_points_and_values_without_a_place_are_left_out(chart: Chart) -> None:
    line = ChartSeries("grows", "Grows", 0, np.array([1.0, 2, 4]), np.array([1e-6, np.nan, 4e-6]))
    chart.show_picture(ChartPicture(ChartAxis("Size", "pixels"), TIME, (line,)))
    assert len(chart.places()) == 2
    assert chart.place_of("grows", 1) is None


def test_shapes_tell_series_apart_without_colour(qtbot: QtBot) -> None:
    assert len({series_shape(number) for number in range(len(SHAPES))}) == len(SHAPES) == 12
    masks = set()
    for number in range(len(SHAPES)):
        image = QImage(24, 24, QImage.Format.Format_Alpha8)
        image.fill(0)
        with QPainter(image) as painter:
            QIcon(SeriesIcon(number)).paint(painter, image.rect())
        masks.add(bytes(image.constBits()))
    assert len(masks) == len(SHAPES)


@pytest.mark.parametrize("theme", [LIGHT, DARK])
def test_colours_of_series_are_readable_as_text(theme) -> None:
    assert min(contrast(series_color(number, theme), theme.panel) for number in range(8)) > 4.5


def test_a_closed_chart_leaves_another_theme_alone(chart: Chart, qapp: QApplication) -> None:
    chart.close()
    apply_theme(qapp, DARK)
    apply_theme(qapp, LIGHT)
    assert chart.closed


def test_a_point_of_a_line_is_told_with_its_number(chart: Chart, qtbot: QtBot) -> None:
    line = ChartSeries("line", "Line", 0, np.array([1.0, 10.0, 100.0]), np.array([5.0, 0.0, 2.0]))
    chart.show_picture(ChartPicture(ChartAxis("Width"), ChartAxis("Severity"), (line,), is_named=False))
    place = chart.place_of("line", 1)
    assert place is not None
    with qtbot.waitSignal(chart.point_hovered) as hovered:
        QTest.mouseMove(chart.viewport(), place.toPoint())
    assert hovered.args == ["line", 1]
    with qtbot.waitSignal(chart.point_chosen) as chosen:
        QTest.mouseClick(chart.viewport(), Qt.MouseButton.LeftButton, pos=place.toPoint())
    assert chosen.args == ["line", 1]
    chart.show_pointed("line", 0)
    assert chart.pointed == "line"


def test_twelve_are_named_the_pointed_chosen_and_front_ones_first(chart: Chart) -> None:
    series = tuple(one(f"m{k}", k, 1e-6 * (k + 1), 0.1 * (k + 1)) for k in range(30))
    axes = ChartAxis("Time", "s"), ChartAxis("Error", "px")
    chart.show_picture(ChartPicture(*axes, series, ("m20", "m21")))
    chart.show_marks({"m25": "A"})
    chart.show_pointed("m29")
    named = [each.key for each in chart.named_series()]
    assert named[:4] == ["m29", "m25", "m20", "m21"]
    assert len(named) == 12
