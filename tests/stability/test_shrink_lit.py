"""The shrinker on lit meshes and on textures: what is right is found anew for a part of a sphere, strip or square."""

from dataclasses import replace

import numpy as np
import pytest

from core import ClipScene, Material, Settings, Texture, render
from core.shading.measured import HighlightCase, NormalsCase, flattened_tube, highlight_case, shining_sphere
from core.study.case_text import scene_text
from core.study.experiment import (
    LIT_MESHES,
    TEXTURED_TRIANGLES,
    camera_of,
    nearer_looks,
    with_smaller_texture,
)
from core.study.record import Outcome
from core.textures.measured import TextureCase, textured_square
from tests.stability.shrunk_tests import shrunk_of
from tests.stability.tube import evenly_lit


def test_numbers_of_what_is_left_are_short() -> None:
    small = shrunk_of("lost-highlight", "shading=gouraud", (8.0, 128.0)).scene
    (mesh,) = small.meshes
    assert (mesh.positions == np.round(mesh.positions, 2)).all()
    assert np.array_equal(mesh.positions, mesh.normals)
    assert (small.camera.eye == np.round(small.camera.eye, 2)).all()
    assert mesh.material.ambient == mesh.material.diffuse == 0
    textured = shrunk_of("minification", "texture_filter=nearest", (4.0, 0.0)).scene
    assert textured.texture.pixels.size <= 4
    assert set(textured.texture.pixels.ravel().tolist()) == {0.0, 1.0}
    assert (textured.attributes == np.rint(textured.attributes)).all()


# What is right.


def test_light_of_normals_that_turn_evenly_is_that_of_the_whole_strip_and_of_a_part() -> None:
    for angle, parts in ((90.0, 1), (180.0, 3)):
        scene = flattened_tube(angle, parts)
        _, wanted = NormalsCase(scene)._shown_and_wanted(render(scene, Settings()))
        assert wanted == pytest.approx(evenly_lit(angle), abs=1e-12)
    half = LIT_MESHES.take_apart(flattened_tube(180.0, 2))
    half = replace(half, elements=half.elements[:2])
    part = LIT_MESHES.put_together(half)
    _, wanted = NormalsCase(part)._shown_and_wanted(render(part, Settings()))
    assert wanted[:, :32] == pytest.approx(evenly_lit(180.0)[:, :32], abs=1e-12)
    assert not wanted[:, 33:].any()


def test_a_strip_with_other_normals_or_seen_from_behind_has_no_truth() -> None:
    scene = flattened_tube(90.0, 1)
    (mesh,) = scene.meshes
    tilted = replace(mesh, normals=mesh.normals + np.array([0, 0.1, 0]))
    with pytest.raises(ValueError, match="turned from the front about the upright"):
        NormalsCase(replace(scene, meshes=(tilted,)))
    with pytest.raises(ValueError, match="seen from the front"):
        NormalsCase(replace(scene, meshes=(replace(mesh, triangles=mesh.triangles[:, ::-1]),)))
    with pytest.raises(ValueError, match="expected one mesh with normals"):
        NormalsCase(replace(scene, meshes=(mesh, mesh)))


def test_a_highlight_counts_where_its_triangles_are_seen() -> None:
    scene = shining_sphere(16, 64.0, 0)
    whole = HighlightCase(scene)
    frame = render(scene, Settings())
    _, where = whole._shown_and_where(whole.start(Settings())())
    (mesh,) = scene.meshes
    lit = np.unique(frame.primitive[where])
    dark = np.setdiff1d(np.arange(len(mesh.triangles)), lit)
    of_some = replace(scene, meshes=(replace(mesh, triangles=mesh.triangles[lit]),))
    assert HighlightCase(of_some).run(Settings()).verdict.outcome == Outcome.RIGHT
    # Without the triangles on the highlight, those on the far side are seen there: they do not count.
    with pytest.raises(ValueError, match="the highlight must be seen on a triangle"):
        HighlightCase(replace(scene, meshes=(replace(mesh, triangles=mesh.triangles[dark]),))).run(Settings())


def test_what_is_no_part_of_a_shining_sphere_has_no_highlight() -> None:
    scene = shining_sphere(8, 64.0, 0)
    (mesh,) = scene.meshes
    larger = replace(mesh, positions=1.2 * mesh.positions, normals=1.2 * mesh.positions)
    with pytest.raises(ValueError, match=r"on the sphere of radius 1, got one 0\.2 off it"):
        HighlightCase(replace(scene, meshes=(larger,)))
    with pytest.raises(ValueError, match="the sphere must shine"):
        HighlightCase(replace(scene, meshes=(replace(mesh, material=Material(specular=0.0)),)))
    coarse = shining_sphere(2, 512.0, 0)
    with pytest.raises(ValueError, match="fine enough for light per pixel"):
        highlight_case(coarse)


def test_footprints_follow_from_the_corners_of_any_triangle() -> None:
    square = textured_square(3.0, 30.0, 1)
    whole = TextureCase(square)
    part = TextureCase(ClipScene(square.clip[1:], square.attributes[1:], square.size, square.texture))
    assert part.wanted == pytest.approx(whole.wanted, abs=1e-9)
    # Half of the square is left, but for the pixels that its side cuts.
    _, is_whole = part._shown_and_whole(part.start(Settings(antialiasing="ssaa-4"))())
    assert is_whole.sum() == (24 * 24 - 24) / 2


def test_textures_in_perspective_or_of_two_layouts_have_no_truth() -> None:
    square = textured_square(3.0, 30.0, 1)
    clip, values = square.clip.copy(), square.attributes.copy()
    clip[0, 0] *= 2
    with pytest.raises(ValueError, match="the same positive w"):
        TextureCase(ClipScene(clip, values, square.size, square.texture))
    values[0, 0] += 0.1
    with pytest.raises(ValueError, match="lie on all triangles alike"):
        TextureCase(ClipScene(square.clip, values, square.size, square.texture))
    away = ClipScene(square.clip + np.array([9.0, 0, 0, 0]), square.attributes, square.size, square.texture)
    with pytest.raises(ValueError, match="covered as a whole, none is"):
        TextureCase(away).run(Settings())


# In which ways it gets smaller.


def test_a_part_of_the_picture_of_an_orthographic_camera_is_the_very_same() -> None:
    scene = flattened_tube(170.0, 3)
    colors = render(scene, Settings()).color
    parts = list(nearer_looks(LIT_MESHES.take_apart(scene)))
    assert [each.size for each in parts] == [(32, 1), *3 * [(32, 3)], *3 * [(65, 1)]]
    for each, first in zip(parts[1:4], (0, 16, 33), strict=True):
        seen = render(LIT_MESHES.put_together(each), Settings()).color
        assert seen == pytest.approx(colors[:, first : first + 32], abs=1e-5)


def test_a_part_of_the_picture_of_a_perspective_camera_looks_there() -> None:
    scene = shining_sphere(8, 64.0, 0)
    parts = list(nearer_looks(LIT_MESHES.take_apart(scene)))
    lower = LIT_MESHES.put_together(parts[4])
    assert lower.size == (96, 48)
    # The middle of the lower half is where the camera looks now, and it sees half as high.
    assert np.tan(camera_of(parts[4]).field_of_view / 2) == pytest.approx(np.tan(np.pi / 8) / 2)
    seen, before = (render(each, Settings()).color[..., 3] for each in (lower, scene))
    assert seen.mean() == pytest.approx(before[:48].mean(), abs=0.08)


def test_only_one_lit_mesh_is_taken_apart() -> None:
    scene = flattened_tube(90.0, 1)
    with pytest.raises(ValueError, match="expected one mesh under one light"):
        LIT_MESHES.take_apart(replace(scene, lights=()))
    with pytest.raises(ValueError, match="expected a mesh with normals under a distant light"):
        LIT_MESHES.take_apart(replace(scene, meshes=(replace(scene.meshes[0], normals=None),)))
    with pytest.raises(ValueError, match="expected one mesh under one light"):
        scene_text(replace(scene, lights=()))


def test_half_a_texture_keeps_its_texels_where_they_are() -> None:
    texture = Texture(np.arange(8, dtype=np.float32).reshape(2, 4, 1))
    clip = np.array([[[-1.0, -1, 0, 1], [3, -1, 0, 1], [-1, 3, 0, 1]]])
    values = np.array([[[0.0, 0.0], [0.5, 0.0], [0.0, 0.5]]])
    parts = TEXTURED_TRIANGLES.take_apart(ClipScene(clip, values, (4, 4), texture))
    found = list(with_smaller_texture(parts))
    halves = [each.numbers["values"] for each in found]
    assert [each.numbers["texels"].shape for each in found] == [(1, 4, 1)] * 4 + [(2, 2, 1)] * 4 + [(2, 4, 1)]
    assert halves[4][..., 0].max() == 1.0
    assert halves[4][..., 1].max() == 0.5
    whole, half = (
        render(TEXTURED_TRIANGLES.put_together(each), Settings(texture_filter="nearest")).color[:2, :2]
        for each in (parts, found[4])
    )
    assert np.array_equal(whole, half)
    assert found[-1].numbers["texels"].ravel().tolist() == [0, 0, 0, 0, 1, 1, 1, 1]
    texels = [each.numbers["texels"].ravel().tolist() for each in TEXTURED_TRIANGLES.with_fewer_digits(parts)]
    assert [0, 0, 2, 3, 4, 5, 6, 7] in texels


def test_light_camera_and_background_that_are_not_the_usual_ones_stand_in_the_text() -> None:
    given = shining_sphere(6, 20.0, 0)
    (mesh,), (light,) = given.meshes, given.lights
    lit = replace(light, color=np.array([0.5, 0.75, 1.0]))
    camera = replace(given.camera, up=np.array([0.6, 0.8, 0.0]))
    background = np.array([0.1, 0.2, 0.3, 1.0])
    scene = LIT_MESHES.as_case(replace(given, lights=(lit,), camera=camera, background=background))
    names: dict = {"np": np}
    exec(f"from core import *\n{scene_text(scene)}", names)
    assert np.array_equal(render(names["scene"]).color, render(scene).color)
    colored = replace(mesh, colors=np.ones((len(mesh.positions), 4)))
    with pytest.raises(ValueError, match="in its own place and of one material"):
        LIT_MESHES.take_apart(replace(given, meshes=(colored,)))
