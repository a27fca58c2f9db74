"""The 3D view leaves out back faces that cannot be seen, and draws them where they can."""

from dataclasses import replace

import numpy as np
import pytest

from app.session.document import open_document
from app.views.scene_picture import FEWEST, DrawnScene, HiddenBacks, SceneShot, draw_scene
from app.views.view_space import make_space, viewing_camera
from core import Camera, Scene
from core.fast_path.workers.band_workers import BandWorkers
from core.transform.vertex_stage import transform_vertices
from lessons.scenes import make_scene
from lessons.shapes import cube, torus
from widgets.basics.theme import LIGHT
from widgets.space.orbit import fitted


def scene_with(mesh) -> Scene:
    made = make_scene("torus")
    return replace(made, meshes=(mesh,))


def shot_of(scene: Scene) -> SceneShot:
    document = open_document(scene, "a scene")
    space = make_space(scene, transform_vertices(scene))
    orbit = fitted(space.home, space.center, space.radius, 4 / 3)
    return SceneShot(space, scene, None, document.settings, orbit, (240, 180), None, 1.0, LIGHT)


def drawn_twice(shot: SceneShot, backs: HiddenBacks) -> tuple[DrawnScene, DrawnScene]:
    first, second = (draw_scene(shot, BandWorkers(1), backs) for _ in range(2))
    return first, second


def test_the_second_picture_of_a_solid_has_half_the_triangles_and_the_same_pixels():
    first, second = drawn_twice(shot_of(scene_with(torus())), HiddenBacks())
    assert not first.figures.are_backs_hidden
    assert second.figures.are_backs_hidden
    lanes = [drawn.figures.route.split.lanes for drawn in (first, second)]
    assert lanes[1] < 0.6 * lanes[0]
    assert np.count_nonzero((first.pixels != second.pixels).any(axis=-1)) == 0


def test_an_open_mesh_keeps_its_back_faces():
    mesh = torus()
    opened = replace(mesh, triangles=mesh.triangles[40:].copy(), faces=None)
    first, second = drawn_twice(shot_of(scene_with(opened)), HiddenBacks())
    assert not second.figures.are_backs_hidden
    assert np.array_equal(first.pixels, second.pixels)


def test_a_solid_that_is_cut_open_by_the_near_plane_keeps_its_back_faces():
    shot, backs = shot_of(scene_with(torus())), HiddenBacks()
    drawn_twice(shot, backs)
    camera = viewing_camera(shot.space, shot.orbit)
    scene = replace(shot.scene, camera=camera)
    assert backs.are_hidden(scene)
    towards = camera.target - camera.eye
    distance = float(np.linalg.norm(towards))
    assert not backs.are_hidden(replace(scene, camera=replace(camera, near=distance, far=2 * distance)))
    inside = Camera(np.array([0.8, 0.0, 0.0]), np.zeros(3), near=1e-3, far=10.0)
    assert not backs.are_hidden(replace(scene, camera=inside))


def test_a_mesh_that_is_edited_is_looked_at_when_it_stays():
    backs = HiddenBacks()
    scene = scene_with(torus())
    for _ in range(3):
        mesh = replace(scene.meshes[0], positions=scene.meshes[0].positions * 1.01)
        scene = replace(scene, meshes=(mesh,))
        assert not backs.are_hidden(scene)
    assert backs.are_hidden(scene)


@pytest.mark.parametrize("kind", ["few triangles", "clip space"])
def test_what_is_not_worth_it_is_not_looked_at(kind, monkeypatch):
    scene = scene_with(cube()) if kind == "few triangles" else make_scene("shared-edge")
    monkeypatch.setattr("app.views.scene_picture.is_solid", None)
    backs = HiddenBacks()
    assert len(cube().triangles) < FEWEST
    assert not backs.are_hidden(scene)
    assert not backs.are_hidden(scene)
