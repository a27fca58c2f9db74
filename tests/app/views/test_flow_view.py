"""The pipeline in four stages: what goes in and out is what the traced picture has; a click steps a stage."""

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel
from pytestqt.qtbot import QtBot

from app.session.document import open_document
from app.session.session import Session
from app.views.stage_views import StageViews
from core.stages.declared import PHASES, STAGES
from lessons.scenes import make_scene
from tests.app.views.following import Following
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import LIGHT, PRESENTER, for_screen
from widgets.timeline.stage_cards import Phases


def shown(qtbot: QtBot, scene: str) -> tuple[Session, Phases, StageViews]:
    session = Session(open_document(make_scene(scene), scene))
    views = StageViews(session)
    Following(session, views)
    for _, _, widget in views.widgets:
        # Before the widgets: it would draw into them after the next change of the theme.
        qtbot.addWidget(widget, before_close_func=lambda _: views.deleteLater())
    views.show("flow")
    phases = next(widget for name, _, widget in views.widgets if name == "flow")
    assert isinstance(phases, Phases)
    return session, phases, views


def texts(phases: Phases) -> list[list[str]]:
    return [[label.text() for label in column.findChildren(QLabel)] for column in phases.columns]


def test_the_four_stages_are_those_of_the_lecture_and_have_all_eleven() -> None:
    assert [phase.title for phase in PHASES] == [
        "Vertex processing",
        "Clipping and rasterization",
        "Fragment processing",
        "Framebuffer processing",
    ]
    assert tuple(name for phase in PHASES for name in phase.stages) == STAGES


def test_what_comes_out_of_one_goes_into_the_next(qtbot: QtBot) -> None:
    session, phases, views = shown(qtbot, "near-plane")
    source = session.trace.source
    fragments = f"{len(source.fragments):,} fragments"
    ends = [(column[2], column[5]) for column in texts(phases)]
    assert ends == [
        ("3 vertices", "3 vertices"),
        ("1 triangle", fragments),
        (fragments, fragments),
        (fragments, "3,072 pixels"),
    ]
    views.stop()


def test_shared_vertices_count_once_and_segments_are_segments(qtbot: QtBot) -> None:
    _, phases, views = shown(qtbot, "segment")
    assert [column[2] for column in texts(phases)][:2] == ["2 vertices", "1 segment"]
    assert "clip space" in texts(phases)[0][3]
    views.stop()


def test_a_click_steps_the_stage_and_predicting_hides_the_numbers(qtbot: QtBot) -> None:
    session, phases, views = shown(qtbot, "single-triangle")
    session.set_stage("cull", 0)
    button = phases.columns[1].buttons[4]
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    assert session.cursor.stage == "raster"
    views.show("flow")
    assert button.isChecked()
    session.set_predicting(True)
    views.show("flow")
    assert not any(character.isdigit() for column in texts(phases) for text in column for character in text)
    assert not any(
        character.isdigit() for column in phases.columns for b in column.buttons for character in b.text()
    )
    views.stop()


def test_the_four_stages_stand_side_by_side_in_the_type_of_a_presenter(qtbot: QtBot) -> None:
    application = QApplication.instance()
    apply_theme(application, for_screen(PRESENTER, 720))
    try:
        _, phases, views = shown(qtbot, "cube")
        phases.resize(720, 680)
        phases.show()
        QApplication.processEvents()
        assert phases.widget().width() <= phases.viewport().width()
        views.stop()
    finally:
        apply_theme(application, LIGHT)
