from collections.abc import Iterator
from dataclasses import FrozenInstanceError

import pytest
from PySide6.QtCore import QObject
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import (
    QAbstractItemView,
    QApplication,
    QCheckBox,
    QTableWidget,
    QTreeWidget,
    QTreeWidgetItem,
)

from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import (
    DARK,
    LIGHT,
    THEMES,
    Theme,
    contrast,
    current_theme,
    text_font,
    theme_notifier,
)


@pytest.fixture
def styled(qapp: QApplication) -> Iterator[QApplication]:
    before = (qapp.styleSheet(), qapp.palette(), qapp.font(), current_theme())
    yield qapp
    qapp.setStyleSheet(before[0])
    qapp.setPalette(before[1])
    qapp.setFont(before[2])
    theme_notifier().theme = before[3]


class Listener(QObject):
    def __init__(self) -> None:
        super().__init__()
        self.heard: list[str] = []

    def hear(self, theme: Theme) -> None:
        self.heard.append(theme.name)


@pytest.mark.parametrize("theme", THEMES, ids=[theme.name for theme in THEMES])
def test_text_is_readable_on_every_background(theme: Theme) -> None:
    backgrounds = (theme.window, theme.panel, theme.raised)
    texts = (theme.text, theme.muted_text, theme.accent_text, theme.good, theme.bad, *theme.vertex_text)
    for background in backgrounds:
        for text in texts:
            assert contrast(text, background) >= 4.5, (text, background)
    assert contrast(theme.text, theme.selection) >= 4.5
    assert contrast(theme.text, theme.hidden) >= 4.5


@pytest.mark.parametrize("theme", THEMES, ids=[theme.name for theme in THEMES])
def test_controls_and_focus_stand_out(theme: Theme) -> None:
    for background in (theme.window, theme.panel, theme.raised):
        assert contrast(theme.outline, background) >= 2.9
        assert contrast(theme.focus, background) >= 4.5


@pytest.mark.parametrize("theme", THEMES, ids=[theme.name for theme in THEMES])
def test_one_colour_is_one_thing(theme: Theme) -> None:
    assert theme.vertex == ("#0072B2", "#E69F00", "#009E73")
    accent = QColor(theme.accent).hueF()
    for other in (*theme.vertex, theme.covered, theme.rejected, theme.tie, theme.good, theme.bad):
        apart = abs(QColor(other).hueF() - accent)
        assert min(apart, 1 - apart) > 0.06, other


def test_black_on_white_has_the_highest_contrast() -> None:
    assert contrast("#000000", "#ffffff") == pytest.approx(21.0)
    assert contrast("#777777", "#777777") == pytest.approx(1.0)


def test_a_theme_cannot_be_changed() -> None:
    with pytest.raises(FrozenInstanceError):
        LIGHT.text = "#ff0000"


def test_applying_sets_palette_and_tells_once(styled: QApplication) -> None:
    listener = Listener()
    theme_notifier().theme_changed.connect(listener.hear)
    apply_theme(styled, DARK)
    apply_theme(styled, DARK)
    assert listener.heard == ["dark"]
    assert current_theme() is DARK
    assert styled.palette().color(QPalette.ColorRole.Window).name() == DARK.window
    assert "$" not in styled.styleSheet()
    theme_notifier().theme_changed.disconnect(listener.hear)


def test_a_checked_box_shows_its_tick(styled: QApplication, qtbot) -> None:
    apply_theme(styled, LIGHT)
    box = QCheckBox("covered")
    qtbot.addWidget(box)
    box.show()
    before = box.grab().toImage()
    box.setChecked(True)
    assert box.grab().toImage() != before


def test_figures_are_tabular(qapp: QApplication) -> None:
    font = text_font(LIGHT)
    assert font.pixelSize() == 13
    assert text_font(LIGHT, 9).pixelSize() == 9


@pytest.mark.parametrize("kind", [QTableWidget, QTreeWidget])
def test_no_row_covers_the_frame_of_the_focus(
    styled: QApplication, qtbot, kind: type[QAbstractItemView]
) -> None:
    apply_theme(styled, LIGHT)
    view = kind()
    qtbot.addWidget(view)
    view.setAlternatingRowColors(True)
    if isinstance(view, QTableWidget):
        view.setRowCount(3)
        view.setColumnCount(1)
    else:
        view.addTopLevelItems([QTreeWidgetItem(["a row"]) for _ in range(3)])
    view.show()
    view.setFocus()
    qtbot.waitUntil(view.hasFocus)
    picture = view.grab().toImage()
    sides = {
        picture.pixelColor(x, y).name() for x in (0, picture.width() - 1) for y in range(picture.height())
    }
    assert sides == {LIGHT.focus}
