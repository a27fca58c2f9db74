import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QToolButton

from tests.widgets.showing import shown
from widgets.scene.outline import OutlineGroup, OutlineRow, OutlineValue, SceneOutline


def groups(x: float = 2.25) -> tuple[OutlineGroup, ...]:
    vertex = OutlineRow("tri0/v0", "Vertex 0", (OutlineValue("x", x), OutlineValue("y", 1.5)), 0)
    field = OutlineRow("camera/fov", "Field of view", (OutlineValue("degrees", 60.0, 1.0, 179.0),))
    mesh = OutlineRow("mesh0", "teapot", (), None, "6,320 triangles")
    return (OutlineGroup("camera", "Camera", (field,)), OutlineGroup("tri0", "Triangle 0", (vertex, mesh)))


@pytest.fixture
def outline(qtbot) -> SceneOutline:
    result = SceneOutline()
    result.show_groups(groups())
    return shown(qtbot, result, 304, 360)


def type_value(qtbot, outline: SceneOutline, path: str, text: str) -> None:
    edit = outline.field(path).edit
    edit.setFocus()
    edit.selectAll()
    qtbot.keyClicks(edit, text)
    qtbot.keyClick(edit, Qt.Key.Key_Return)


def test_a_typed_value_is_handed_on_with_its_path(qtbot, outline) -> None:
    seen = []
    outline.value_edited.connect(lambda path, value: seen.append((path, value)))
    type_value(qtbot, outline, "tri0/v0/y", "7/2")
    assert seen == [("tri0/v0/y", 3.5)]


def test_a_value_out_of_range_is_refused_in_place(qtbot, outline) -> None:
    seen = []
    outline.value_edited.connect(lambda path, value: seen.append((path, value)))
    type_value(qtbot, outline, "camera/fov/degrees", "180")
    assert seen == []
    assert "between 1 and 179" in outline.field("camera/fov/degrees").edit.toolTip()


def test_numbers_follow_a_drag_without_new_fields_and_without_signals(outline) -> None:
    seen = []
    outline.value_edited.connect(lambda path, value: seen.append((path, value)))
    field = outline.field("tri0/v0/x")
    outline.show_groups(groups(9.0))
    assert outline.field("tri0/v0/x") is field
    assert field.edit.text() == "9"
    assert seen == []


def test_a_click_on_a_label_selects_its_row(qtbot, outline) -> None:
    seen = []
    outline.row_selected.connect(seen.append)
    qtbot.mouseClick(outline._labels["mesh0"], Qt.MouseButton.LeftButton)
    assert seen == ["mesh0"]
    outline.show_selection("tri0/v0")
    assert outline.selected_path() == "tri0/v0"
    assert seen == ["mesh0"]


def test_going_into_a_field_selects_its_row_and_keys_select_a_label(qtbot, outline) -> None:
    seen = []
    outline.row_selected.connect(seen.append)
    qtbot.mouseClick(outline.field("tri0/v0/x").edit, Qt.MouseButton.LeftButton)
    outline._labels["mesh0"].setFocus()
    qtbot.keyClick(outline._labels["mesh0"], Qt.Key.Key_Space)
    assert seen == ["tri0/v0", "mesh0"]


def test_a_group_folds(qtbot, outline) -> None:
    heading = outline.findChild(QToolButton, "camera")
    qtbot.mouseClick(heading, Qt.MouseButton.LeftButton)
    assert not outline.field("camera/fov/degrees").isVisible()
    qtbot.mouseClick(heading, Qt.MouseButton.LeftButton)
    assert outline.field("camera/fov/degrees").isVisible()


def test_every_field_has_a_name(outline) -> None:
    assert outline.field("tri0/v0/x").edit.accessibleName() == "Vertex 0 x"


def test_four_numbers_fit_the_wanted_width(qtbot) -> None:
    values = tuple(OutlineValue(name, -12.345) for name in ("x", "y", "depth", "w"))
    outline = SceneOutline()
    outline.show_groups((OutlineGroup("t", "Triangle 0", (OutlineRow("t/v0", "Vertex 0", values, 0),)),))
    shown(qtbot, outline, outline.sizeHint())
    assert outline.horizontalScrollBar().maximum() == 0


def test_an_empty_outline_says_what_it_is_for(outline) -> None:
    outline.show_groups(())
    assert outline.widget() is not None
    with pytest.raises(KeyError):
        outline.field("tri0/v0/x")


def test_a_long_title_does_not_push_the_numbers_out_of_sight(outline) -> None:
    group = OutlineGroup("scene", "Bresenham, integers and DDA, slope added per column, first divergence", ())
    outline.show_groups((group, *groups()))
    assert outline.widget().minimumSizeHint().width() <= outline.width()


def test_several_numbers_typed_in_one_field_fill_the_row(qtbot, outline) -> None:
    seen = []
    outline.values_edited.connect(seen.append)
    type_value(qtbot, outline, "tri0/v0/x", "7/2, 4,5")
    assert seen == [{"tri0/v0/x": 3.5, "tri0/v0/y": 4.5}]
    type_value(qtbot, outline, "tri0/v0/y", "1; 2")
    assert "expected 1 number, got 2" in outline.field("tri0/v0/y").edit.toolTip()
    assert len(seen) == 1


def test_a_box_is_checked_and_follows_without_a_signal(qtbot, outline) -> None:
    def with_flag(is_on: bool) -> tuple[OutlineGroup, ...]:
        flag = OutlineRow("light/0/shadow", "casts shadow", (OutlineValue("on", is_on, is_flag=True),))
        return (OutlineGroup("light", "Light", (flag,)),)

    seen, chosen = [], []
    outline.value_edited.connect(lambda path, value: seen.append((path, value)))
    outline.row_selected.connect(chosen.append)
    outline.show_groups(with_flag(True))
    box = outline.flag("light/0/shadow/on")
    assert box.isChecked()
    assert box.accessibleName() == "casts shadow"
    box.setFocus()
    qtbot.keyClick(box, Qt.Key.Key_Space)
    assert seen == [("light/0/shadow/on", 0.0)]
    assert chosen == ["light/0/shadow"]
    outline.show_groups(with_flag(True))
    assert outline.flag("light/0/shadow/on") is box
    assert box.isChecked()
    assert len(seen) == 1
