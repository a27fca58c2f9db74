"""The pane of shaders: typing, what is wrong, presets, uniforms, undo."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QTextCursor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit

from app.files.open_any import Opened, open_any
from app.pages.step.grid_records import mask_overlays
from app.session.document import focus_on
from app.views.texture_footprint import texture_pictures
from app.window.main_window import MainWindow
from core.explain.steps import variables
from core.records.steps import Level
from core.shaders.presets import TASK_FRAGMENT

pytestmark = pytest.mark.shared_window


@pytest.fixture
def lab(window: MainWindow):
    """Return the window with the tutorial's task open, stepped in Shade, and its pane in sight."""
    window.session.open(open_any("lmu-shaders").document)
    window.session.set_stage("shade")
    window.page.show_panes(("inspector", "details", "shaders"))
    QTest.qWait(1)
    return window


def _program(window):
    return window.session.latest.scene.program


def _type(window, qtbot, stage, text):
    """Replace a source as a paste does, and wait until it was read."""
    editor = window.page.shader_pane.editor(stage)
    cursor = QTextCursor(editor.document())
    cursor.select(QTextCursor.SelectionType.Document)
    with qtbot.waitSignal(window.page.shader_pane.source_settled):
        cursor.insertText(text)
    window.page.settle()


def _choose(box, name):
    index = box.findData(name)
    box.setCurrentIndex(index)
    box.activated.emit(index)
    box.window().page.settle()


def test_what_is_typed_is_drawn_and_stepped(lab, qtbot):
    pane, changed = lab.page.shader_pane, TASK_FRAGMENT.replace("vec4(vColor, 1.0)", "vec4(vColor.bgr, 1.0)")
    assert pane.editor("fragment").toPlainText() == TASK_FRAGMENT
    before = lab.session.trace.source.surface.color
    _type(lab, qtbot, "fragment", changed)
    qtbot.waitUntil(lambda: lab.session.document.scene.program.fragment == changed)
    np.testing.assert_array_equal(lab.session.trace.source.surface.color[:, :3], before[:, 2::-1])
    assert pane.message == "Both shaders run."
    listed = lab.session.stage_trace.listings["statement"]
    assert listed.source == changed.rstrip("\n")
    assert lab.page.shader_pane._preset.currentData() == "own"

    # One entry of undo, which shows the old text again.
    lab.session.undo()
    qtbot.waitUntil(lambda: pane.editor("fragment").toPlainText() == TASK_FRAGMENT)
    assert lab.page.shader_pane._preset.currentData() == "task"


def test_a_mistake_leaves_the_picture_and_is_marked_at_its_place(lab, qtbot):
    pane, program = lab.page.shader_pane, _program(lab)
    wrong = TASK_FRAGMENT.replace("vec4(vColor", "vec4(vColr")
    _type(lab, qtbot, "fragment", wrong)
    assert _program(lab) == program
    assert pane.message == "Fragment shader, line 9: vColr is not declared: did you mean vColor?"
    editor = pane.editor("fragment")
    assert editor.accessibleDescription() == "Line 9: vColr is not declared: did you mean vColor?"
    (mark,) = editor.extraSelections()
    assert mark.cursor.selectedText() == "vColr"

    # Another edit of the document leaves what was typed.
    lab.session.set_setting("interpolation", "affine")
    QTest.qWait(1)
    assert editor.toPlainText() == wrong

    _type(lab, qtbot, "fragment", TASK_FRAGMENT)
    assert pane.message == "Both shaders run."
    assert editor.extraSelections() == []


@pytest.mark.slow
def test_an_endless_loop_is_refused_in_a_sentence(lab, qtbot):
    program = _program(lab)
    with qtbot.waitSignal(lab.page.shader_pane.source_settled):
        lab.page.shader_pane.editor("fragment").setPlainText(
            TASK_FRAGMENT.replace("void main() {", "void main() { while (true) { }")
        )
    lab.page.settle()
    said = lab.page.shader_pane.message
    assert said.startswith("Fragment shader, line 8: the loop goes on after 1,000 rounds"), said
    assert _program(lab) == program


def test_a_trial_runs_in_the_background_and_escape_stops_it(lab, qtbot):
    pane, program = lab.page.shader_pane, _program(lab)
    editor = pane.editor("fragment")
    with qtbot.waitSignal(pane.source_settled):
        editor.setPlainText(
            TASK_FRAGMENT.replace(
                "void main() {",
                "float f() { for (int i = 0; i < 900; i++) { for (int j = 0; j < 900; j++) { } } return 1.0; }"
                "void main() { if (f() < 0.0) discard;",
            )
        )
    assert lab.page.shading.is_working
    QTest.keyClick(editor, Qt.Key.Key_Escape)
    assert not lab.page.shading.is_working
    assert pane.message == "Stopped. The picture is that of the last shaders that ran."
    assert _program(lab) is program

    # What was typed stays, and another key tries it again; undo of the document ends the trial.
    assert "900" in editor.toPlainText()
    lab.session.set_setting("interpolation", "affine")
    with qtbot.waitSignal(pane.source_settled):
        editor.insertPlainText(" ")
    assert lab.page.shading.is_working
    assert lab.page.dismiss()
    assert not lab.page.shading.is_working


def test_shaders_are_taken_over_beside_what_is_open_by_then(lab, qtbot):
    changed = TASK_FRAGMENT.replace("vec4(vColor, 1.0)", "vec4(vColor.bgr, 1.0)")
    with qtbot.waitSignal(lab.page.shader_pane.source_settled):
        lab.page.shader_pane.editor("fragment").setPlainText(changed)
    lab.session.set_setting("interpolation", "affine")
    lab.page.settle()
    assert _program(lab).fragment == changed
    assert lab.session.document.settings.interpolation == "affine"


def test_a_preset_and_its_uniforms(lab, qtbot):
    pane = lab.page.shader_pane
    _choose(pane._preset, "toon")
    qtbot.waitUntil(lambda: _program(lab).name == "Toon shading")
    QTest.qWait(1)
    fields = {field.accessibleName(): field for field in pane.findChildren(QLineEdit) if not field.isHidden()}
    assert list(fields) == ["Uniform lightSource, vec4", "Uniform steps, float"]
    steps = fields["Uniform steps, float"]
    steps.setFocus()
    steps.selectAll()
    QTest.keyClicks(steps, "5")
    QTest.keyClick(steps, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: _program(lab).values["steps"] == (5.0,))
    pane.uniform_typed.emit("lightSource", "1, 2")
    assert pane.message == "lightSource needs 4 numbers, separated by commas, got 1, 2."

    # What is not typed is the scene's own light.
    light = fields["Uniform lightSource, vec4"]
    assert (light.text(), light.placeholderText()) == ("", "0, 0, -1, 0")
    pane.uniform_typed.emit("lightSource", "1, 0, 0, 0")
    qtbot.waitUntil(lambda: "lightSource" in _program(lab).values)
    pane.uniform_typed.emit("lightSource", "")
    qtbot.waitUntil(lambda: "lightSource" not in _program(lab).values)
    _choose(pane._preset, "")
    qtbot.waitUntil(lambda: _program(lab) is None)


@pytest.mark.slow
def test_other_shaders_leave_the_steps_at_their_pixel(lab, qtbot):
    session = lab.session
    session.set_stage("shade", 0)
    rows = session.stage_trace.rows_at_pixel(*session.stage_trace.pixel[len(session.stage_trace.pixel) // 2])
    session.go_to(session.stage_trace.steps.position_after(int(rows[-1])))
    at = tuple(session.stage_trace.pixel[session.moment.row])
    for preset in ("toon", "", "task"):
        _choose(lab.page.shader_pane._preset, preset)
        qtbot.waitUntil(lambda: not lab.page.shading.is_working)
        lab.page.settle()
        shade, row = session.stage_trace, session.moment.row
        assert tuple(shade.pixel[row]) == at
        assert row == shade.rows_at_pixel(*at)[-1]
    session.undo()
    assert tuple(session.stage_trace.pixel[session.moment.row]) == at


def test_lanes_together_are_stepped_from_the_same_statement_on(lab):
    session, pane = lab.session, lab.page.shader_pane
    session.go_to(101)
    row, before = session.moment.row, session.stage_trace
    _choose(pane._lanes, "together")
    now, at = session.stage_trace, session.moment.row
    assert session.document.lanes == "together"
    assert session.cursor.level == Level.GROUP
    for name in ("lane", "lane_step", "line"):
        assert now.columns[name][at] == before.columns[name][row]
    session.step(1)
    assert now.columns["live"][session.moment.row] == now.columns["lanes"][session.moment.row]
    assert variables(session.explanation)[0].name == "fragments that run"

    # The document remembers the order, and undo brings the other one back.
    session.undo()
    QTest.qWait(1)
    assert pane._lanes.currentData() == "one"


@pytest.mark.slow
def test_fragments_that_wait_or_were_discarded_are_marked(lab, qtbot):
    lab.session.open(focus_on(open_any("cube").document, 3))
    lab.session.set_stage("shade")
    QTest.qWait(1)
    _choose(lab.page.shader_pane._preset, "alpha-test")
    qtbot.waitUntil(lambda: _program(lab) is not None)
    marks = {overlay.label: overlay.mask for overlay in mask_overlays(lab.session.moment)}
    source, columns = lab.session.trace.source, lab.session.stage_trace.columns
    last = columns["line"].max()
    kept = columns["live"][columns["line"] == last][0]
    assert marks["discarded"].sum() == len(source.fragments) - kept > 0
    assert not marks["does not run this line"].any()
    lines = lab.page.listing.shares
    assert lines[last] == pytest.approx(kept / len(source.fragments))
    assert lines[min(lines)] == 1


@pytest.mark.slow
def test_methods_say_that_a_shader_lights_the_scene(lab):
    lab.page.show_panes(("methods", "inspector"))
    combo = lab.page.settings_panel.combo("shading")
    assert combo.currentText() == "Your shader"
    assert not combo.isEnabled()
    assert "own shaders" in combo.toolTip()
    _choose(lab.page.shader_pane._preset, "")
    assert combo.currentData() == "phong"
    assert combo.isEnabled()


def test_any_variable_of_both_shaders_is_shown_in_every_pixel(lab):
    page, session = lab.page, lab.session
    session.set_stage("shade")
    for name in ("vColor", "outColor"):
        page.variables.picture_requested.emit(name)
        assert page.grid.buffer().name == name
    session.set_stage("transform", 1)
    page.variables.picture_requested.emit("gl_Position")
    assert "No pixel has a value of gl_Position" in lab.statusBar().currentMessage()
    page.variables.picture_requested.emit("vColor")
    assert session.cursor.stage == "interpolate"
    assert page.grid.buffer().name == "out vColor"


def test_raw_shader_material_declares_nothing(lab):
    pane = lab.page.shader_pane
    _choose(pane._dialect, "raw-shader-material")
    assert "only ShaderMaterial declares it" in pane.message
    assert _program(lab).dialect == "shader-material"
    assert pane._dialect.currentData() == "shader-material"


def test_scenes_in_clip_space_have_no_shaders(lab):
    lab.session.open(open_any("fan").document)
    QTest.qWait(1)
    pane = lab.page.shader_pane
    assert pane.message.startswith("This scene is given in clip space.")
    _choose(pane._preset, "toon")
    assert pane._preset.currentData() == ""


def test_shaders_beside_the_built_in_shading_and_beside_others(lab, qtbot):
    lab.session.open(open_any("cube").document)
    lab.session.set_stage("shade")
    lab.page.show_panes(("inspector", "shaders"))
    pane = lab.page.shader_pane
    _choose(pane._preset, "phong")
    qtbot.waitUntil(lambda: _program(lab) is not None)
    _choose(pane._beside, "")
    comparing = lab.page.comparing
    qtbot.waitUntil(lambda: comparing.second is not None)
    assert comparing.other.shading == "phong"
    mine, other = (step.source.surface.color for step in (lab.session.trace, comparing.second.trace))
    np.testing.assert_allclose(mine, other, atol=1e-6)
    assert comparing.b.titles(lab.session.document) == ("Phong shading", "Built-in Phong shading")
    _choose(pane._beside, "toon")
    qtbot.waitUntil(lambda: comparing.b.title == "Toon shading" and comparing.second is not None)
    assert pane._beside.currentIndex() == 0
    qtbot.waitUntil(lambda: "cosine is the first variable that differs" in pane.message, timeout=10_000)


def _open(window, name):
    window.files.show_opened(open_any(name))
    window.page.settle()
    return window.statusBar().currentMessage()


def test_shaders_stay_on_another_scene_or_say_why_not(lab, qtbot):
    pane, session = lab.page.shader_pane, lab.session

    # A scene's own shaders are not those of the user.
    _open(lab, "cube")
    assert _program(lab) is None
    _choose(pane._preset, "toon")
    toon = _program(lab)
    assert _open(lab, "lit-floor").startswith("Your shaders stay")
    assert _program(lab) == toon
    assert session.document.title == "Lit floor"

    # They sleep where none run, and come back.
    assert _open(lab, "fan").startswith("Your shaders sleep")
    assert _open(lab, "sphere").startswith("Your shaders stay")
    assert _program(lab) == toon
    assert _open(lab, "lmu-shaders").startswith("This scene has shaders of its own")
    assert _program(lab).fragment == TASK_FRAGMENT
    _open(lab, "cube")
    assert _program(lab) is None

    # What does not run there is said, and the scene is drawn without it.
    _choose(pane._preset, "toon")
    endless = _program(lab).fragment.replace("vec3 N =", "while (vUv == vec2(0.0)) { }\n   vec3 N =")
    _type(lab, qtbot, "fragment", endless)
    assert _program(lab).fragment == endless
    said = _open(lab, "lit-floor")
    assert said.startswith(
        "Your shaders sleep: they do not run on this scene, which is drawn without them: fragment shader, "
    )
    assert "the loop goes on after 1,000 rounds" in said
    assert _program(lab) is None

    # Whoever takes shaders off has none on the next scene either.
    _open(lab, "cube")
    assert _program(lab).fragment == endless
    _choose(pane._preset, "")
    _open(lab, "sphere")
    assert _program(lab) is None


@pytest.mark.slow
def test_a_variable_without_a_value_is_told(lab, qtbot):
    lab.session.set_stage("shade")
    text = TASK_FRAGMENT.replace("outColor = vec4(", "vec3 k;\n   outColor = vec4(k + ")
    _type(lab, qtbot, "fragment", text)
    assert "Line 10 reads k before it has a value, for " in lab.page.shader_pane.message
    assert "read without a value" in [overlay.label for overlay in mask_overlays(lab.session.moment)]


@pytest.mark.slow
def test_a_mistake_of_the_shelf_is_named(lab, qtbot):
    swapped = (
        lab.page.shader_pane.editor("vertex")
        .toPlainText()
        .replace("vColor = color;", "vColor = color * 0.0;")
    )
    _type(lab, qtbot, "vertex", swapped)
    assert lab.page.shader_pane.message.startswith("Both shaders run. vColor never gets the vertex's colour.")


def test_a_text_that_does_not_run_is_kept_in_the_state(lab, qtbot):
    wrong = TASK_FRAGMENT.replace("vec4(vColor", "vec4(vColr")
    _type(lab, qtbot, "fragment", wrong)
    pane, said, kept = lab.page.shader_pane, lab.page.shader_pane.message, lab.files.state()
    assert kept.look.shader_drafts == {"fragment": wrong}
    _type(lab, qtbot, "fragment", TASK_FRAGMENT)
    assert lab.files.state().look.shader_drafts == {}
    lab.files.show_opened(Opened(kept.document, state=kept))
    lab.page.settle()
    assert pane.editor("fragment").toPlainText() == wrong
    assert pane.message == said == "Fragment shader, line 9: vColr is not declared: did you mean vColor?"
    assert _program(lab).fragment == TASK_FRAGMENT


@pytest.mark.slow
def test_undo_in_the_editor_goes_back_over_a_preset(lab, qtbot):
    pane, before = lab.page.shader_pane, _program(lab)
    _choose(pane._preset, "toon")
    assert _program(lab).fragment == pane.editor("fragment").toPlainText() != TASK_FRAGMENT
    for stage in ("vertex", "fragment"):
        pane.editor(stage).undo()
    qtbot.waitUntil(
        lambda: (_program(lab).vertex, _program(lab).fragment) == (before.vertex, before.fragment)
    )


@pytest.mark.slow
def test_what_darkens_the_middle_of_triangles_is_named(lab, qtbot):
    _open(lab, "sphere")
    _choose(lab.page.shader_pane._preset, "phong")
    text = _program(lab).fragment.replace("normalize(vNormal)", "vNormal")
    _type(lab, qtbot, "fragment", text)
    assert "interpolation shortens it between the vertices" in lab.page.shader_pane.message


@pytest.mark.slow
def test_a_textured_scene_is_stepped_by_shaders(lab):
    _choose(lab.page.shader_pane._preset, "")
    _open(lab, "textured-floor")
    _choose(lab.page.shader_pane._preset, "phong")
    assert "map, vUv" in _program(lab).fragment
    lab.session.set_stage("shade")
    lab.page.show_view("texture")
    lab.page.settle()
    pictures, why = texture_pictures(lab.session.moment)
    assert pictures == ()
    assert why.startswith("The scene's shaders choose")


def test_typing_has_an_undo_of_its_own(lab, qtbot):
    editor = lab.page.shader_pane.editor("fragment")
    editor.setFocus()
    editor.moveCursor(QTextCursor.MoveOperation.Start)
    with qtbot.waitSignal(lab.page.shader_pane.source_settled):
        QTest.keyClicks(editor, "xx")
    assert editor.toPlainText() == f"xx{TASK_FRAGMENT}"
    with qtbot.waitSignal(lab.page.shader_pane.source_settled):
        QTest.keyClick(editor, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert editor.toPlainText() == TASK_FRAGMENT
