"""How much light changes: bounds of affine interpolation and of light at vertices, against what is drawn."""

from dataclasses import replace

import numpy as np
import pytest

from core.pipeline import render
from core.records.arrays import Floats
from core.scene import Camera, DirectionalLight, Light, Material, Mesh, PointLight, Scene
from core.settings import Settings
from core.study import Tolerance, everything_on, plan
from core.study.accuracy.workloads import sphere_mesh, sphere_scene
from core.study.planner.bounds.bytes import times
from core.study.planner.bounds.interpolated_light import interpolated_light_error
from core.study.planner.bounds.light_changes import LightError
from core.study.planner.bounds.shading_bounds import shading_error
from core.study.planner.bounds.tried_light import light_error_at_samples
from core.study.planner.bounds.value_bounds import share_of_range
from core.study.planner.choices.costs import LectureOrder
from core.study.planner.scene_analysis.conservative_coverage import Touched, is_cut, touch
from core.study.planner.scene_analysis.sample_patterns import PATTERNS

LIGHTS = [DirectionalLight(np.array([0.3, -1.0, -0.4])), PointLight(np.array([1.5, 2.0, 2.0]))]
NEAR = Camera(np.array([0.3, 0.5, 1.6]), np.zeros(3), near=0.1)
SHINY = Material(ambient=0.1, diffuse=0.6, specular=0.5, shininess=24.0)


def near_ball(rings: int, light: Light, material: Material = SHINY) -> Scene:
    """Return a ball that is seen from so near that w changes much over its triangles."""
    whole = sphere_mesh(rings)
    mesh = Mesh(whole.positions, whole.triangles, whole.normals, material=material)
    return Scene((mesh,), NEAR, (light,), (72, 64))


def one_sample(scene: Scene) -> Settings:
    """Return everything on, but for one sample a pixel."""
    return replace(everything_on(scene), antialiasing="none")


def changes(scene: Scene, **cheaper: str) -> tuple[Floats, Floats]:
    """Return the triangles (F,) that are seen, and how far their colours (F, 3) are off."""
    exact, cheap = render(scene, one_sample(scene)), render(scene, replace(one_sample(scene), **cheaper))
    is_seen = exact.primitive >= 0
    return exact.primitive[is_seen], np.abs(exact.color - cheap.color)[is_seen][:, :3]


def by_triangle(touched: Touched, error: LightError, count: int) -> Floats:
    """Return the largest error (T, 3) of each triangle's pieces (P, 3)."""
    bound = np.zeros((count, 3))
    np.maximum.at(bound, touched.geometry.primitives.triangle, error.diffuse + error.specular)
    return bound


@pytest.mark.parametrize("light", LIGHTS, ids=["distant", "near"])
def test_affine_light_is_off_by_its_bound_at_most(light: Light) -> None:
    scene = near_ball(10, light)
    touched = touch(scene, everything_on(scene))
    error = interpolated_light_error(touched, scene, share_of_range(touched), "phong")
    bound = by_triangle(touched, error, len(scene.meshes[0].triangles))
    triangle, off = changes(scene, interpolation="affine")
    assert (off <= bound[triangle] + 1e-6).all()
    assert off.max() > 0.01


@pytest.mark.parametrize("light", LIGHTS, ids=["distant", "near"])
@pytest.mark.parametrize(
    ("family", "name"), [("interpolation", "affine"), ("shading", "gouraud"), ("shading", "flat")]
)
def test_light_that_is_tried_at_the_samples_is_what_is_drawn(family: str, name: str, light: Light) -> None:
    scene = replace(near_ball(6, light), camera=replace(NEAR, field_of_view=1.7))
    touched = touch(scene, everything_on(scene))
    assert not is_cut(touched).any()
    error = light_error_at_samples(touched, scene, np.arange(len(touched.pixel)), PATTERNS["none"], name)
    bound = np.zeros((len(scene.meshes[0].triangles), 3))
    np.maximum.at(
        bound, touched.geometry.primitives.triangle[touched.primitive], error.diffuse + error.specular
    )
    triangle, off = changes(scene, **{family: name})
    found = np.zeros_like(bound)
    np.maximum.at(found, triangle, off)
    assert (found <= bound + 1e-6).all()
    # Diffuse and specular light that are off opposite ways, or of a triangle that is hidden in part, are drawn closer.
    assert np.median((bound / np.maximum(found, 1e-9))[triangle]) < 1.5


@pytest.mark.parametrize("light", LIGHTS, ids=["distant", "near"])
@pytest.mark.parametrize("name", ["gouraud", "flat"])
@pytest.mark.parametrize("rings", [6, 24])
def test_light_of_vertices_and_faces_is_off_by_its_bound_at_most(name: str, light: Light, rings: int) -> None:
    scene = near_ball(rings, light)
    touched = touch(scene, one_sample(scene))
    error = shading_error(touched, scene, name)
    bound = by_triangle(touched, error, len(scene.meshes[0].triangles))
    triangle, off = changes(scene, shading=name)
    assert (off <= bound[triangle] + 1e-6).all()
    assert off.max() > 0.005


def test_the_bound_of_gouraud_falls_with_the_square_of_the_triangles() -> None:
    # The light does not set on the part of the ball that is seen.
    light = DirectionalLight(np.array([-0.3, -0.5, -1.6]))
    largest = []
    for rings in (24, 48, 96):
        scene = near_ball(rings, light)
        touched = touch(scene, one_sample(scene))
        error = shading_error(touched, scene, "gouraud")
        in_view = np.unique(touched.primitive[touched.facing[touched.primitive] > 0])
        largest.append(float((error.diffuse + error.specular)[in_view].max()))
    assert largest[0] / largest[1] == pytest.approx(4, rel=0.3)
    assert largest[1] / largest[2] == pytest.approx(4, rel=0.3)


def test_a_fine_tessellation_is_lit_at_its_vertices() -> None:
    material = Material(ambient=0.3, diffuse=0.5, specular=0.1, shininess=8.0)
    far = replace(NEAR, eye=np.array([0.3, 0.5, 3.0]))
    scenes = [replace(near_ball(rings, LIGHTS[0], material), camera=far) for rings in (8, 60)]
    found = [plan(scene, Tolerance(2), costs=LectureOrder()).settings.shading for scene in scenes]
    assert found == ["phong", "gouraud"]


def test_a_room_that_is_cut_by_the_view_is_bounded_by_its_whole_triangles() -> None:
    whole = sphere_mesh(8)
    material = Material(ambient=0.5, diffuse=0.3, specular=0.0)
    mesh = Mesh(5 * whole.positions, whole.triangles, whole.normals, material=material)
    camera = Camera(np.array([0.2, 0.1, 0.3]), np.array([1.0, 0.4, 0.5]), near=0.05)
    scene = Scene((mesh,), camera, (LIGHTS[0],), (48, 40))
    touched = touch(scene, one_sample(scene))
    error = shading_error(touched, scene, "gouraud")
    bound = by_triangle(touched, error, len(mesh.triangles))
    triangle, off = changes(scene, shading="gouraud")
    assert (off <= bound[triangle] + 1e-6).all()
    assert off.max() > 0.002
    assert bound[triangle].max() < 10 * off.max()


def test_a_bound_of_nothing_stays_nothing() -> None:
    scene = sphere_scene(6, 24)
    touched = touch(scene, everything_on(scene))
    none = np.zeros(len(touched.geometry.primitives))
    for shading in ("phong", "gouraud", "flat"):
        error = interpolated_light_error(touched, scene, none, shading)
        assert not (error.diffuse + error.specular).any()
    assert times(np.zeros(2), np.array([np.inf, 1.0])).tolist() == [0.0, 0.0]
