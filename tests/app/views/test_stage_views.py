from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from app.session.document import focus_on, open_document
from app.session.session import Session
from app.views.companions import PyramidView
from app.views.pointed_pixel import shown_triangle
from app.views.scene3d_presenter import ASKED, DRAWING
from app.views.scene_picture import fractions
from app.views.stage_views import StageViews
from app.views.texture_footprint import no_texture_reason
from app.views.view_space import fitted_home, make_space, step_marks, thinned, viewed_scene, viewing_camera
from core import Settings, render
from core.fast_path.workers.band_workers import BandWorkers
from core.transform.vertex_stage import transform_vertices
from lessons.scenes import make_scene
from tests.app.views.following import Following
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import DARK, LIGHT

LEFT, NONE = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier


@pytest.fixture
def show(qtbot):
    made: list[StageViews] = []

    def make(name: str, scene: str, triangle: int | None = None, **settings: str):
        document = open_document(make_scene(scene), scene, settings=Settings(**settings))
        if triangle is not None:
            document = focus_on(document, triangle)
        session = Session(document)
        views = StageViews(session)
        Following(session, views)
        made.append(views)
        for _, _, widget in views.widgets:
            qtbot.addWidget(widget)
        widget = {key: view for key, _, view in views.widgets}[name]
        widget.resize(420, 320)
        widget.show()
        qtbot.waitExposed(widget)
        rested(qtbot, views)
        return session, views, widget

    yield make
    for views in made:
        views.stop()
        views.deleteLater()


def rested(qtbot, views: StageViews) -> None:
    """Wait until the 3D view shows the newest picture."""
    qtbot.waitUntil(lambda: not views.is_drawing)


def drag(widget, start: QPoint, end: QPoint) -> None:
    QTest.mousePress(widget, LEFT, NONE, start)
    QTest.mouseMove(widget, (start + end) / 2)
    QTest.mouseMove(widget, end)
    QTest.mouseRelease(widget, LEFT, NONE, end)


def handle_place(widget, index: int) -> QPoint:
    place = next(place for handle, place in widget._placed_handles() if handle.index == index)
    return place.toPoint()


def test_the_views_are_in_order(show):
    _, views, _ = show("clip", "single-triangle")
    assert [(name, title) for name, title, _ in views.widgets] == [
        ("scene", "3D scene"),
        ("clip", "Clip space"),
        ("pyramid", "(x, y, w)"),
        ("texture", "Texture"),
        ("flow", "Flow"),
    ]


def test_turning_with_the_mouse_changes_the_picture(show, qtbot):
    _, views, widget = show("scene", "cube")
    before = widget.picture().pixels.copy()
    drag(widget, QPoint(40, 40), QPoint(120, 60))
    rested(qtbot, views)
    assert not np.array_equal(widget.picture().pixels, before)
    assert views.scene_presenter.drawn.shot.orbit == widget.orbit()


@pytest.mark.parametrize("scene", ["cube", "shared-edge", "torus"])
def test_a_click_picks_what_the_core_sees_there(show, qtbot, scene):
    _session, views, widget = show("scene", scene)
    presenter = views.scene_presenter
    size, space = widget.picture_size(), presenter.space
    viewed, pieces = viewed_scene(
        space, space.scene, viewing_camera(space, widget.orbit()), size, np.zeros(4)
    )
    primitive = render(viewed).primitive
    primitive = primitive if pieces is None else np.where(primitive < 0, -1, pieces[primitive])
    rows, columns = np.nonzero(primitive >= 0)
    handles = [(h.x * size[0], h.y * size[1]) for h in widget.picture().handles]
    tried = 0
    for k in range(0, len(rows), max(len(rows) // 12, 1)):
        column, row = int(columns[k]), int(rows[k])
        if any(abs(x - column) + abs(y - row) < 30 for x, y in handles):
            continue
        with qtbot.waitSignal(views.triangle_picked) as told:
            QTest.mouseClick(widget, LEFT, NONE, QPoint(column, size[1] - 1 - row))
        assert told.args == [primitive[row, column]]
        tried += 1
    assert tried > 3


def test_a_click_on_nothing_picks_nothing(show, qtbot):
    _, views, widget = show("scene", "cube")
    with qtbot.assertNotEmitted(views.triangle_picked):
        QTest.mouseClick(widget, LEFT, NONE, QPoint(3, 3))


def test_dragging_a_vertex_of_a_mesh_moves_it_and_can_be_undone(show, qtbot):
    session, views, widget = show("scene", "cube", 3)
    scene = session.document.scene
    orbit, size = widget.orbit(), widget.picture_size()
    matrix = views.scene_presenter.drawn.matrix
    start = handle_place(widget, 1)
    drag(widget, start, start + QPoint(20, -12))
    moved = session.document.scene
    vertex = int(scene.meshes[0].triangles[3, 1])
    changed = (moved.meshes[0].positions != scene.meshes[0].positions).any(axis=1)
    assert np.flatnonzero(changed).tolist() == [vertex]
    assert moved.size == scene.size
    points = np.stack([scene.meshes[0].positions[vertex], moved.meshes[0].positions[vertex]])
    before, after = fractions(matrix, points)
    assert (after - before) * size == pytest.approx([20, 12], abs=1e-6)
    # In the plane that faces the viewer: as far away as before.
    assert orbit.axes()[2] @ (points[1] - points[0]) == pytest.approx(0, abs=1e-9)
    assert widget.orbit() == orbit
    session.undo()
    assert session.document.scene is scene
    assert not session.can_undo


def test_dragging_a_typed_corner_keeps_its_w_and_moves_what_is_shared(show):
    session, _views, widget = show("scene", "shared-edge", 0)
    scene = session.document.scene
    start = handle_place(widget, 0)
    drag(widget, start, start + QPoint(-15, 10))
    moved = session.document.scene
    assert not np.array_equal(moved.clip[0, 0], scene.clip[0, 0])
    assert moved.clip[0, 0, 3] == scene.clip[0, 0, 3]
    together = scene.shared == scene.shared[0, 0]
    assert (moved.clip[together] == moved.clip[0, 0]).all()
    assert np.array_equal(moved.clip[~together], scene.clip[~together])
    session.undo()
    assert session.document.scene is scene


def test_escape_takes_a_drag_back(show):
    session, _, widget = show("scene", "single-triangle")
    document = session.document
    start = handle_place(widget, 2)
    QTest.mousePress(widget, LEFT, NONE, start)
    QTest.mouseMove(widget, start + QPoint(10, 10))
    QTest.mouseMove(widget, start + QPoint(30, 20))
    assert not np.allclose(session.document.scene.clip, document.scene.clip)
    QTest.keyClick(widget, Qt.Key.Key_Escape)
    assert session.document is document
    assert not session.can_undo


def test_a_corner_behind_the_eye_has_no_handle_in_the_box(show):
    session, _, widget = show("scene", "single-triangle")
    clip = session.document.scene.clip.copy()
    clip[0, 1, 3] = -0.5
    session.edit(replace(session.document, scene=replace(session.document.scene, clip=clip)))
    assert [handle.index for handle in widget.picture().handles] == [0, 2]
    assert np.isfinite(widget.picture().pixels).all()


def test_hover_and_pin_are_marked_with_their_rays(show):
    session, _views, widget = show("scene", "cube")
    source = session.trace.source
    column, row = int(source.fragments.column[50]), int(source.fragments.row[50])
    session.set_pin((column, row))
    session.set_hover((0, 0))
    marks = widget.picture().marks
    assert [mark.label for mark in marks] == [f"pixel ({column}, {row})", "pixel (0, 0)"]
    assert [mark.shape for mark in marks] == ["ring", "cross"]
    session.set_pin(None)
    session.set_hover(None)
    assert widget.picture().marks == ()


def test_a_ray_ends_on_the_surface_that_is_seen(show):
    from app.views.pointed_pixel import pixel_ray

    session, views, _ = show("scene", "cube")
    source, space = session.trace.source, views.scene_presenter.space
    rows, columns = np.nonzero(source.picture.primitive >= 0)
    first_column, first_row, _, _ = source.raster.bounds
    for k in range(0, len(rows), 60):
        ray, is_hit = pixel_ray(source, space, int(columns[k]) + first_column, int(rows[k]) + first_row)
        assert is_hit
        assert np.abs(ray[1]).max() == pytest.approx(1.0, abs=1e-6)


def test_only_the_visible_view_is_drawn(show, qtbot):
    session, views, clip = show("clip", "single-triangle")
    others = [widget for name, _, widget in views.widgets if name in ("pyramid", "texture")]
    session.set_pin((20, 20))
    assert clip.diagram() is not None
    assert others[0].diagram() is None
    others[0].show()
    qtbot.waitExposed(others[0])
    assert "(20, 20)" in others[0].diagram().caption


def test_views_follow_the_session(show):
    session, _, widget = show("clip", "near-plane", clipping="sutherland-hodgman")
    session.set_stage("clip", 0)
    first = widget.diagram()
    session.step(1)
    assert widget.diagram() is not first
    session.set_stage("transform")
    assert "Before the first plane" in widget.diagram().caption


def test_what_does_not_apply_says_why(show):
    session, views, widget = show("texture", "single-triangle")
    assert widget.pictures() == ()
    assert widget.accessibleDescription() == no_texture_reason(session.moment, shown_triangle(session.moment))
    with pytest.raises(ValueError, match="view must be one of"):
        views.show("nothing")


def test_show_brings_a_hidden_view_up_to_date(show):
    _, views, _ = show("clip", "textured-floor")
    texture = views.widgets[3][2]
    assert texture.pictures() == ()
    views.show("texture")
    assert len(texture.pictures()) == 1


@pytest.mark.parametrize("name", ["torus", "intersecting", "textured-floor"])
def test_thinned_scenes_keep_the_numbers_of_their_triangles(name):
    scene = make_scene(name)
    vertices = transform_vertices(scene)
    total = len(vertices.corners)
    few, numbers = thinned(scene, max(total // 7, 1))
    fewer = transform_vertices(few)
    assert len(numbers) == len(fewer.corners) <= max(total // 7, 1)
    assert np.array_equal(fewer.clip[fewer.corners], vertices.clip[vertices.corners[numbers]])


def test_every_picture_is_whole_and_as_large_as_the_view(show, qtbot):
    _, views, widget = show("scene", "knot")
    presenter = views.scene_presenter
    for _ in range(3):
        drag(widget, QPoint(30, 30), QPoint(60, 40))
        rested(qtbot, views)
        figures = presenter.drawn.figures
        assert figures.triangle_count == presenter._session.document.triangle_count
        assert figures.size == widget.picture_size()
        assert widget.picture().pixels.shape[1::-1] == figures.size


def test_the_corner_tells_what_a_frame_took(show, qtbot):
    _, views, widget = show("scene", "torus")
    for k in range(4):
        drag(widget, QPoint(30, 30), QPoint(60 + k, 40))
        rested(qtbot, views)
        widget.repaint()
    figures = views.scene_presenter.drawn.figures
    text = f"{figures.size[0]} × {figures.size[1]} · {figures.triangle_count:,} triangles"
    qtbot.waitUntil(lambda: "frames/s" in widget.corner().text() and text in widget.corner().text())
    assert widget.corner().isVisible()


def test_workers_that_are_given_draw_and_end_with_the_views(show, qtbot):
    _, views, widget = show("scene", "torus")
    first = views.scene_presenter.drawn
    assert first.figures.sharing.process_count == 1
    workers = BandWorkers(2, always=True)
    views.scene_presenter.draw_with(workers)
    assert workers.start(), workers.failure
    drag(widget, QPoint(30, 30), QPoint(60, 40))
    rested(qtbot, views)
    figures = views.scene_presenter.drawn.figures
    assert figures.sharing.process_count == 2
    qtbot.waitUntil(lambda: "Drawn by 2 processes: rows 0 to" in widget.corner().toolTip())
    views.stop()
    assert workers.pids == ()
    assert not workers.start(), "they are closed"


def test_no_process_is_started_by_itself(show, qtbot):
    _, views, widget = show("scene", "knot")
    views.scene_presenter.choose_size("1920x1080")
    for _ in range(3):
        drag(widget, QPoint(30, 30), QPoint(60, 40))
        rested(qtbot, views)
    assert views.scene_presenter.drawn.figures.sharing.reason == "only one process is allowed"


def test_a_chosen_size_is_drawn_whatever_the_size_of_the_view(show, qtbot):
    session, views, widget = show("scene", "torus")
    own = widget.picture_size()
    for name, size in (("1920x1080", (1920, 1080)), ("scene", session.document.scene.size), ("view", own)):
        action = next(action for action in widget.corner().menu().actions() if action.data() == name)
        action.trigger()
        assert action.isChecked()
        rested(qtbot, views)
        assert views.scene_presenter.drawn.figures.size == size


def test_all_of_the_space_stays_in_sight_at_another_size_until_it_is_turned(show, qtbot):
    _, views, widget = show("scene", "cube")
    home = widget.orbit()
    views.scene_presenter.choose_size("1920x1080")
    assert widget.orbit() == fitted_home(views.scene_presenter.space, 1920 / 1080)
    widget.resize(300, 500)
    views.scene_presenter.choose_size("view")
    assert widget.orbit().extent > home.extent
    drag(widget, QPoint(30, 30), QPoint(60, 40))
    turned = widget.orbit()
    views.scene_presenter.choose_size("1024x1024")
    assert widget.orbit() == turned
    rested(qtbot, views)


def test_a_view_that_has_grown_unseen_is_drawn_again(show, qtbot):
    _, views, widget = show("scene", "cube")
    widget.hide()
    widget.resize(500, 400)
    widget.show()
    qtbot.waitUntil(lambda: views.scene_presenter.drawn.figures.size == widget.picture_size())


def test_the_wheel_goes_all_the_way_to_what_is_under_the_pointer(show, qtbot):
    _, views, widget = show("scene", "torus", 500)
    space, shot = views.scene_presenter.space, views.scene_presenter.drawn.shot
    # A place of the picture where something is seen, and the point there.
    x, y = next((h.x, h.y) for h in widget.picture().handles)
    place = QPointF(x * shot.size[0], (1 - y) * shot.size[1]) / widget.devicePixelRatioF()
    for _ in range(60):
        event = QWheelEvent(
            place,
            widget.mapToGlobal(place),
            QPoint(),
            QPoint(0, 120),
            Qt.MouseButton.NoButton,
            NONE,
            Qt.ScrollPhase.NoScrollPhase,
            False,
        )
        QApplication.sendEvent(widget, event)
        rested(qtbot, views)
    eye = widget.orbit().eye(viewing_camera(space, widget.orbit()).field_of_view)
    world = space.corners(500)
    assert np.linalg.norm(world - eye, axis=1).min() < 0.01 * space.radius


def test_another_theme_keeps_the_orbit(show, qtbot):
    _, views, widget = show("scene", "cube")
    drag(widget, QPoint(30, 30), QPoint(60, 40))
    orbit = widget.orbit()
    widget.hide()
    apply_theme(QApplication.instance(), DARK)
    apply_theme(QApplication.instance(), LIGHT)
    widget.show()
    rested(qtbot, views)
    assert widget.orbit() == orbit
    assert views.scene_presenter.drawn.shot.theme == LIGHT


def test_looking_at_the_focus_fills_the_view_with_it(show, qtbot):
    _, views, widget = show("scene", "torus", 700)
    views.look_at_focus()
    rested(qtbot, views)
    places = np.array([(handle.x, handle.y) for handle in widget.picture().handles])
    assert ((places > 0) & (places < 1)).all()
    assert np.ptp(places, axis=0).max() > 0.2


def test_a_mark_of_culling_tells_nothing_before_its_step(show):
    session, _, _ = show("scene", "cube", cull="back-normal")
    session.set_stage("cull", 0)
    space = make_space(session.document.traced_scene, session.trace.source.geometry.vertices)
    steps, told = session.stage_trace.steps, []
    for position in range(1, int(steps.triangle_ends[1]) + 20):
        session.go_to(position)
        row, done = steps.row_at(position)
        kind = session.stage_trace.kind_of(row)
        labels = [mark.label for mark in step_marks(session.moment, space) if "N · V" in mark.label]
        told.append((kind, done, bool(labels)))
    assert {(kind, done) for kind, done, is_told in told if is_told and kind == "back-normal"} == {
        ("back-normal", 2),
        ("back-normal", 3),
    }
    assert not any(is_told for kind, _, is_told in told if kind in ("behind", "plane", "degenerate"))


def test_points_stay_in_sight_until_they_are_dropped(show):
    session, _, _ = show("scene", "points")
    space = make_space(session.document.traced_scene, session.trace.source.geometry.vertices)
    counts = []
    for stage, position in (("cull", 0), ("cull", None), ("raster", 0)):
        session.set_stage(stage, position)
        counts.append(sum(mark.shape == "disc" for mark in step_marks(session.moment, space)))
    assert counts == [5, 4, 4]
    session.set_stage("cull", 1)
    assert [mark.shape for mark in step_marks(session.moment, space) if mark.ink == "accent"][-1] == "ring"


def test_the_places_in_the_window_are_hidden_while_they_are_predicted(qapp):
    """The pyramid has the grid of the window: before the last step of Transform it would tell them."""
    session = Session(open_document(make_scene("single-triangle"), ""))
    view = PyramidView(session)
    shown = []
    for is_predicting, position in (
        (False, 0),
        (True, 0),
        (True, session.trace.stage("transform").steps.count),
    ):
        session.set_stage("transform", position)
        session.set_predicting(is_predicting)
        view.refresh(session.moment)
        shown.append(view.widget.diagram() is not None)
    assert shown == [True, False, True]


def test_the_picture_is_hidden_from_shading_on_while_its_scene_is_asked_about(show, qtbot):
    """Seen from outside it tells colours, and from the camera what is nearest; before that it tells the question."""
    session, views, widget = show("scene", "intersecting")
    assert widget.picture() is not None
    session.set_stage("depth", 0)
    session.set_asked("digest", is_open=True)
    assert widget.picture() is None
    assert widget.accessibleDescription() == widget.empty_text == ASKED
    widget.set_orbit(replace(widget.orbit(), azimuth=1.0))
    widget.view_changed.emit(widget.orbit())
    assert not views.is_drawing
    session.set_stage("interpolate", 0)
    rested(qtbot, views)
    assert widget.picture() is not None
    session.set_stage("shade", 0)
    assert widget.picture() is None
    session.set_asked("", is_open=False)
    assert widget.empty_text == DRAWING
    rested(qtbot, views)
    assert widget.picture() is not None
