"""The Compare page as the tests use it: at quick work, measured, pointed at; and a study made by hand."""

from dataclasses import replace

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from app.pages.compare.page import ComparePage
from app.window.main_window import MainWindow
from core.settings import Settings
from core.study.record import Axis, ErrorMeasure, Point, Study, WorkKind

WRONG = "wrong-visible"


def compare_page(window: MainWindow) -> ComparePage:
    """Return the page at the quickest work there is: three triangles that overlap in a cycle."""
    window.pages.show_page("compare")
    found = window.pages.current
    found.show_named("visibility")
    found.choice.work = "cycle"
    found.choice.rounds = 2
    found.refresh()
    return found


def measured(page: ComparePage, qtbot: QtBot) -> Study:
    """Measure by the key and wait; then give each method twice the time of the one before, so that no marks meet."""
    QTest.keyClick(page.window(), Qt.Key.Key_F5)
    assert page.is_running
    qtbot.waitUntil(lambda: not page.is_running, timeout=60000)
    result = page.choice.result
    points = tuple(
        replace(point, seconds=0.001 * 2.0**number * np.ones_like(point.seconds))
        for number, point in enumerate(result.content.points)
    )
    study = replace(result.content, points=points)
    page.choice.result = replace(result, content=study)
    page.refresh()
    return study


def click(
    page: ComparePage, method: str, modifier: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier
) -> None:
    place = page.scatter.place_of(method)
    QTest.mouseClick(page.scatter.viewport(), Qt.MouseButton.LeftButton, modifier, place.toPoint())


def wait_for_pictures(page: ComparePage, qtbot: QtBot) -> None:
    qtbot.waitUntil(lambda: page.pictures.linked.grids[0].buffer() is not None, timeout=60000)


def hand_made(family: str = "line") -> Study:
    """Return a study with an exact method, a wrong one, one without the error, and one that refused."""
    length = Axis("length", "Length", "pixels", (4, 8), default=4, is_cost=True)

    def point(name: str, seconds: float, **others: object) -> Point:
        times = np.array([seconds, 1.1 * seconds, 1.3 * seconds])
        return Point(f"line={name}", name.title(), times, 10, **others)

    points = (
        point("bresenham", 1e-4, counts={"pixels drawn": 40}, errors={"far": 0.0, "area": 0.5}),
        point("dda", 2e-4, counts={"pixels drawn": 41}, errors={"far": 12.5, "area": 0.25}),
        point(
            "midpoint",
            3e-4,
            counts={"pixels drawn": 39},
            errors={"far": np.nan, "area": 0.125},
            reasons={"far": "It has no distance."},
        ),
        Point("line=wide", "Wide", refused="It takes whole numbers only."),
    )
    return Study(
        family,
        "Lines",
        WorkKind("any", "Any ends", "line", (length,)),
        {"length": 4.0},
        5,
        (ErrorMeasure("far", "Distance", "pixels"), ErrorMeasure("area", "Area", "")),
        points,
        {4.0: points, 8.0: tuple(replace(each, seconds=2 * each.seconds) for each in points)},
        {"processor": "A processor", "date": "2020-02-02"},
        Settings(depth="inverse-w"),
    )
