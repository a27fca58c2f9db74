import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QCheckBox

from widgets.basics.theme import DARK, LIGHT
from widgets.grid import layers
from widgets.grid.insets import OverlayLegend, swatch

MASK = np.ones((2, 2), np.bool_)
OVERLAYS: list[layers.Overlay] = [
    *[layers.MaskOverlay(mark.name, mark, MASK) for mark in layers.CellMark],
    layers.CountOverlay("overdraw", np.ones((2, 2), np.int32)),
    layers.BlockOverlay("blocks", np.array([[0, 0, 2, 2]]), (layers.BlockState.LEAF,)),
    layers.SpanOverlay("spans", np.array([[0, 0, 2]])),
    layers.SegmentOverlay("lines", np.zeros((2, 2, 2)), (0, 2)),
]


@pytest.fixture
def legend(qtbot) -> OverlayLegend:
    widget = OverlayLegend()
    qtbot.addWidget(widget)
    widget.show_overlays(OVERLAYS, frozenset({"TIE"}))
    widget.show()
    return widget


def box(legend: OverlayLegend, text: str) -> QCheckBox:
    return next(item for item in legend.findChildren(QCheckBox) if item.text() == text)


def test_it_lists_every_overlay_with_its_form_in_words(legend: OverlayLegend) -> None:
    boxes = legend.findChildren(QCheckBox)
    assert [item.text() for item in boxes] == [overlay.label for overlay in OVERLAYS]
    assert box(legend, "tie").isChecked()
    assert box(legend, "tie").toolTip() == "A ring"
    assert all(item.toolTip() for item in boxes)


def test_a_click_tells_the_keys_that_are_on(legend: OverlayLegend, qtbot) -> None:
    with qtbot.waitSignal(legend.overlays_changed) as changed:
        QTest.keyClick(box(legend, "overdraw"), Qt.Key.Key_Space)
    assert changed.args == [frozenset({"TIE", "overdraw"})]
    assert [overlay.key for overlay in legend.shown_overlays()] == ["TIE", "overdraw"]


def test_the_next_step_keeps_what_is_on(legend: OverlayLegend, qtbot) -> None:
    kept = box(legend, "tie")
    with qtbot.assertNotEmitted(legend.overlays_changed):
        legend.show_overlays(
            [layers.MaskOverlay(mark.name, mark, ~MASK) for mark in layers.CellMark]
            + OVERLAYS[len(layers.CellMark) :]
        )
    assert box(legend, "tie") is kept
    assert kept.isChecked()
    legend.show_overlays(OVERLAYS[:4])
    qtbot.waitUntil(lambda: len(legend.findChildren(QCheckBox)) == 4)
    assert legend.shown_keys() == frozenset()


@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])
def test_swatches_differ_even_in_grey(qapp, theme) -> None:
    pictures = [
        swatch(overlay, theme, 1.0).toImage().convertToFormat(QImage.Format.Format_Grayscale8)
        for overlay in OVERLAYS
    ]
    for index, picture in enumerate(pictures):
        assert all(picture != other for other in pictures[index + 1 :])
