"""The pass of a shadow map stands beside the picture, and opens at the texel that the pixel looks up."""

from dataclasses import replace

import numpy as np
import pytest

from app.session.document import STEPPED, open_document
from app.session.passes import (
    NO_PASS,
    looked_into,
    looked_up_texels,
    open_pass,
    passes_of,
    passes_to_open,
    shaded_row,
)
from app.session.session import Session
from app.views.occluder_view import OccludersBeside
from app.views.pass_view import PassBeside
from app.views.view_space import make_space, step_marks
from core import Settings, render
from core.stages.passes import drawn_depth
from lessons.scenes import make_scene

SHADOWED = replace(Settings(), shadow="map", map_size=16, fill="bounding-box")


def session_of(settings: Settings = SHADOWED) -> Session:
    scene = replace(make_scene("box-in-light"), size=(32, 24))
    return Session(open_document(scene, "Box in the light", settings=settings))


def test_the_map_stands_beside_shade_with_the_texel_of_the_pixel(qtbot):
    session = session_of()
    beside = PassBeside(session)
    qtbot.addWidget(beside.widget)
    stage = session.trace.stage("shade")
    row = int(np.flatnonzero(stage.columns["light_share"] == 0)[0])
    session.set_stage("shade")
    session.set_pin(tuple(stage.pixel[row].tolist()))
    beside.refresh(session.moment)
    at = shaded_row(session.moment)
    assert beside.is_wanted(session.moment)
    assert beside.grid.buffer().values.shape == (16, 16)
    assert looked_up_texels(session.moment, at, 0) == [tuple(stage.columns["lamp_texels"][at][0].tolist())]
    assert beside.grid.accessibleDescription() == f"Looked up: {looked_up_texels(session.moment, at, 0)[0]}."
    session.set_predicting(True)
    assert shaded_row(session.moment) == -1


def test_a_pass_opens_with_its_texel_pinned_and_undo_leads_back(qtbot):
    session = session_of()
    before = session.document
    session.set_stage("shade")
    session.go_to(7)
    stage = session.trace.stage("shade")
    session.set_pin(tuple(stage.pixel[5].tolist()))
    place = session.cursor, session.pin
    texel = stage.columns["lamp_texels"][shaded_row(session.moment)][0].tolist()
    open_pass(session)
    assert session.document.scene is passes_of(before)[0].scene
    assert (session.document.title, session.cursor.stage) == ("What light 0 sees", "depth")
    assert list(session.pin) == texel
    of_pass = session.cursor, session.pin
    session.undo()
    assert session.document is before
    assert (session.cursor, session.pin) == place, "undo leads back to the place that was left"
    session.redo()
    assert (session.cursor, session.pin) == of_pass


def mirror_session(**settings) -> Session:
    scene = replace(make_scene("mirror-cube"), size=(32, 24))
    chosen = Settings(environment="cube", environment_size=16, fill="bounding-box", **settings)
    return Session(open_document(scene, "Mirror", settings=chosen))


def test_a_mirror_shows_the_face_that_it_looks_into_and_opens_it_at_its_texel(qtbot):
    session = mirror_session(shadow="map")
    beside = PassBeside(session)
    qtbot.addWidget(beside.widget)
    stage = session.trace.stage("shade")
    session.set_stage("shade")
    rows = np.flatnonzero(stage.columns["mirror"] == 1)
    for face in np.unique(stage.columns["face"][rows]).tolist():
        row = int(rows[stage.columns["face"][rows] == face][-1])
        session.set_pin(tuple(stage.pixel[row].tolist()))
        at = shaded_row(session.moment)
        number = looked_into(session.moment, at)
        assert number == 1 + stage.columns["face"][at], "the shadow map is the first pass"
        texels = looked_up_texels(session.moment, at, number)
        assert texels == [tuple(texel) for texel in stage.columns["face_texels"][at].tolist()]
        beside.refresh(session.moment)
        planned = passes_of(session.document)[number]
        assert np.array_equal(beside.grid.buffer().values, render(planned.scene).color[..., :3])
        assert beside.grid.accessibleName() == f"Environment map: {planned.title}"
        assert passes_to_open(session.moment, session.pin) == [0, number]
    before = session.document
    open_pass(session)
    assert (session.document.scene, session.cursor.stage) == (planned.scene, "blend")
    assert session.pin == texels[0]
    session.undo()
    assert session.document is before


def test_beside_the_mirror_the_shadow_map_is_shown_or_the_first_face(qtbot):
    for settings, expected in (({"shadow": "map"}, "Shadow map"), ({}, "Environment map")):
        session = mirror_session(**settings)
        beside = PassBeside(session)
        qtbot.addWidget(beside.widget)
        session.set_stage("shade")
        session.set_pin((30, 1))
        beside.refresh(session.moment)
        assert beside.grid.accessibleName().startswith(expected)
        assert passes_to_open(session.moment, (30, 1)) == ([0] if settings else [])


def test_the_pyramid_stands_beside_cull_and_its_bottom_opens(qtbot):
    settings = Settings(object_culling="occlusion", hierarchy="none", occluders=1)
    session = Session(
        open_document(make_scene("boxes-behind-wall"), "Boxes behind a wall", settings=settings)
    )
    beside = OccludersBeside(session)
    qtbot.addWidget(beside.widget)
    session.set_stage("cull")
    space = make_space(session.trace.source.scene, session.trace.source.geometry.vertices)
    stage, before = session.trace.stage("cull"), session.document
    row = int(np.flatnonzero(stage.steps.kind == stage.steps.kinds.index("hidden-box"))[0])
    said, labels = [], []
    for position in range(int(stage.steps.starts[row]) + 1, int(stage.steps.starts[row + 1]) + 1):
        session.go_to(position)
        beside.refresh(session.moment)
        said.append((beside.grid.buffer().values.shape, beside.grid.accessibleDescription()))
        labels.append(step_marks(session.moment, space)[-1].label)
    assert not beside.grid.buffer().has_centres, "a texel of a level stands for several pixels"
    nothing = "No texel is compared."
    assert said[:3] == [((48, 64), nothing), ((48, 64), nothing), ((6, 8), nothing)]
    assert said[3:] == [((6, 8), "Compared with: (3, 2), (4, 2), (3, 3) and (4, 3).")] * 2
    assert labels == [*["node 2"] * 4, "node 2: hidden behind the occluders"], (
        "the verdict is told when it is made"
    )
    open_pass(session, [planned.name for planned in passes_of(before)].index("occluders"))
    assert (session.document.title, session.cursor.stage) == ("The occluders", "depth")
    assert len(session.document.scene.meshes) == 1
    session.undo()
    assert session.document is before
    session.set_stage("raster")
    assert not beside.is_wanted(session.moment)


def test_without_a_pass_there_is_a_sentence(qtbot):
    session = session_of(Settings(fill="bounding-box"))
    before = session.document
    with pytest.raises(ValueError, match=NO_PASS):
        open_pass(session)
    assert session.document is before
    assert not PassBeside(session).is_wanted(session.moment)


def test_a_large_map_is_stepped_around_the_texel(qtbot):
    session = session_of(replace(SHADOWED, map_size=1024))
    stage = session.trace.stage("shade")
    row = int(np.flatnonzero(stage.columns["light_share"] == 0)[0])
    session.set_pin(tuple(stage.pixel[row].tolist()))
    texel = looked_up_texels(session.moment, shaded_row(session.moment), 0)[0]
    open_pass(session)
    assert session.document.scene.size == (1024, 1024)
    assert session.pin == texel
    column, row = session.moment.place_of(texel)
    buffer = session.trace.stage("depth").state(session.trace.stage("depth").steps.count)["depth"]
    assert buffer[row, column] == np.float32(
        drawn_depth(passes_of(session_of(replace(SHADOWED, map_size=1024)).document)[0])[texel[1], texel[0]]
    )


def test_a_prepass_opens_too(qtbot):
    scene = make_scene("four-layers")
    session = Session(open_document(scene, "Layers", settings=replace(STEPPED, depth_test_time="prepass")))
    session.set_pin((3, 4))
    open_pass(session)
    assert (session.document.title, session.pin) == ("Depth alone", (3, 4))
    assert session.document.settings.depth_test_time == "late"
