import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication, QScrollArea, QScrollBar, QToolButton

from tests.widgets.showing import shown
from widgets.basics.settings_panel import Setting, SettingChoice, SettingsPanel


def settings(fill: str = "blocks", line_refusal: str = "polygons are filled") -> list[Setting]:
    fills = (
        SettingChoice("spans", "Spans", "all triangles at once"),
        SettingChoice("blocks", "Blocks"),
        SettingChoice("scanline", "Scanline", refusal="some w <= 0"),
    )
    lines = (SettingChoice("bresenham", "Bresenham"), SettingChoice("dda", "DDA"))
    return [
        Setting("fill", "Fill", fills, fill, group="Raster"),
        Setting("line", "Lines", lines, "bresenham", line_refusal),
    ]


@pytest.fixture
def panel(qtbot) -> SettingsPanel:
    result = SettingsPanel()
    result.show_settings(settings())
    return shown(qtbot, result)


def test_a_choice_by_key_is_handed_on_once(qtbot, panel) -> None:
    seen = []
    panel.setting_chosen.connect(lambda family, value: seen.append((family, value)))
    combo = panel.combo("fill")
    combo.setFocus()
    qtbot.keyClick(combo, Qt.Key.Key_Up)
    assert seen == [("fill", "spans")]


def test_setting_by_code_emits_nothing(panel) -> None:
    seen = []
    panel.setting_chosen.connect(lambda family, value: seen.append((family, value)))
    panel.show_settings(settings("spans"))
    assert panel.combo("fill").currentText() == "Spans"
    assert seen == []


def test_a_choice_that_was_refused_goes_back_to_the_present_one(qtbot, panel) -> None:
    combo = panel.combo("fill")
    combo.setFocus()
    qtbot.keyClick(combo, Qt.Key.Key_Up)
    assert combo.currentText() == "Spans"
    panel.show_settings(settings())
    assert combo.currentText() == "Blocks"


def test_what_has_not_changed_is_not_made_anew(panel) -> None:
    fill, line = panel.combo("fill").model(), panel.combo("line").model()
    panel.show_settings(settings(line_refusal=""))
    assert panel.combo("fill").model() is fill
    assert panel.combo("line").model() is not line


def test_what_cannot_be_chosen_is_off_and_says_why(qtbot, panel) -> None:
    model = panel.combo("fill").model()
    item = model.item(2)
    assert not item.isEnabled()
    assert "some w <= 0" in item.toolTip()
    assert not panel.combo("line").isEnabled()
    assert "polygons are filled" in panel.combo("line").toolTip()
    combo = panel.combo("fill")
    combo.setFocus()
    qtbot.keyClick(combo, Qt.Key.Key_Down)
    assert combo.currentText() == "Blocks"


def test_a_wheel_over_the_panel_changes_nothing(panel) -> None:
    combo = panel.combo("fill")
    place = QPointF(5.0, 5.0)
    event = QWheelEvent(
        place,
        QPointF(combo.mapToGlobal(place.toPoint())),
        QPoint(),
        QPoint(0, 120),
        Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(combo, event)
    assert combo.currentText() == "Blocks"


def test_controls_stay_while_the_families_stay(panel) -> None:
    combo = panel.combo("fill")
    panel.show_settings(settings("spans", ""))
    assert panel.combo("fill") is combo
    assert panel.combo("line").isEnabled()
    panel.show_settings(settings()[:1])
    with pytest.raises(KeyError):
        panel.combo("line")


def test_names_for_screen_readers(panel) -> None:
    assert panel.combo("fill").accessibleName() == "Fill"


def test_more_unfolds_the_other_families_and_methods(qtbot, panel) -> None:
    fills = (
        SettingChoice("spans", "Spans", is_more=True),
        SettingChoice("blocks", "Blocks"),
        SettingChoice("exact", "Exact", is_more=True),
    )
    wraps = (SettingChoice("repeat", "Repeat", is_more=True), SettingChoice("clamp", "Clamp", is_more=True))
    panel.show_settings(
        [
            Setting("fill", "Fill", fills, "spans", group="Raster"),
            Setting("wrap", "Wrap", wraps, "repeat", group="Fragments", is_more=True),
        ]
    )
    fill, wrap = panel.combo("fill"), panel.combo("wrap")

    def offered() -> list[str]:
        return [fill.itemText(place) for place in range(fill.count())]

    # The method in use is always offered.
    assert offered() == ["Spans", "Blocks"]
    assert wrap.isHidden()
    panel.more_button.setFocus()
    qtbot.keyClick(panel.more_button, Qt.Key.Key_Space)
    assert offered() == ["Spans", "Blocks", "Exact"]
    assert (wrap.isHidden(), wrap.count(), panel.more_button.text()) == (False, 2, "Fewer methods")
    panel.show_more(False)
    assert (offered(), wrap.isHidden()) == (["Spans", "Blocks"], True)


def test_the_button_of_a_row_asks_what_its_choice_is(qtbot, panel) -> None:
    with qtbot.waitSignal(panel.reference_requested) as asked:
        panel.findChildren(QToolButton, "fill")[0].click()
    assert asked.args == ["fill", "blocks"]


def test_a_row_that_a_task_is_about_is_listed_and_in_sight_also_with_its_default(qtbot) -> None:
    area = QScrollArea(widgetResizable=True)
    panel = SettingsPanel()
    area.setWidget(panel)
    area.resize(300, 150)
    rows = [Setting(f"row {place}", "Row", (SettingChoice("a", "A"),), "a") for place in range(12)]
    ways = (SettingChoice("opaque", "Opaque"), SettingChoice("added", "Added", is_more=True))
    blending = Setting("blend", "Blending", ways, "opaque", is_more=True)
    shown(qtbot, area)
    panel.show_wanted({"blend": "added"})
    panel.show_settings([*rows, blending])  # what is asked for may be known before the rows are
    combo = panel.combo("blend")
    qtbot.waitUntil(lambda: not combo.visibleRegion().isEmpty())
    assert (combo.isHidden(), combo.count()) == (False, 2)
    area.verticalScrollBar().triggerAction(QScrollBar.SliderAction.SliderToMinimum)
    panel.show_more(True)
    assert combo.visibleRegion().isEmpty()  # whoever scrolls is left alone
    panel.show_more(False)
    panel.show_wanted({})
    assert (combo.isHidden(), combo.count()) == (True, 1)
