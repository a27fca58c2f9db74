"""The shaders to begin with: those of the slides word for word, and the others against the program's own shading."""

import pickle
from dataclasses import replace

import numpy as np
import pytest

from core import Settings, render
from core.shaders.presets import MINIMAL_FRAGMENT, PRESETS, TASK_VERTEX, preset_program
from lessons.scenes import make_scene

SPHERE = replace(make_scene("sphere"), size=(48, 48))


def _with(name, scene=SPHERE, **uniforms):
    program = preset_program(name, scene)
    values = program.values | {key: (float(value),) for key, value in uniforms.items()}
    return replace(scene, program=replace(program, uniforms=tuple(values.items())))


@pytest.mark.parametrize("name", PRESETS)
def test_a_preset_draws_the_scene(name):
    frame, plain = render(_with(name)), render(SPHERE)
    seen = plain.primitive >= 0
    assert np.isfinite(frame.color).all()
    if name not in ("task", "wave", "alpha-test"):
        np.testing.assert_array_equal(frame.primitive >= 0, seen)
    assert (frame.color[frame.primitive >= 0][:, 3] == 1).all()


def test_phong_in_glsl_is_the_built_in_one_whatever_light_material_and_camera():
    names = ("cube", "lit-floor", "near-plane", "sphere", "textured-floor", "z-fighting")
    scenes = [replace(make_scene(name), size=(24, 24)) for name in names]
    camera = replace(scenes[0].camera, projection="orthographic", view_height=4.0)
    for scene in (*scenes, replace(scenes[0], camera=camera)):
        ours = render(replace(scene, program=preset_program("phong", scene)))
        np.testing.assert_allclose(ours.color, render(scene).color, atol=2e-5)


def test_uniforms_follow_the_scene_until_they_are_set():
    floor = replace(make_scene("lit-floor"), size=(24, 18))
    program = preset_program("phong", floor)
    dark = replace(floor, lights=(replace(floor.lights[0], color=np.zeros(3)),))
    lit, unlit = (render(replace(scene, program=program)).color for scene in (floor, dark))
    assert lit.max() > 0.5 > 0.2 > unlit[..., :3].max()
    own = replace(program, uniforms=(("lightColor", (1.0, 1.0, 1.0)),))
    np.testing.assert_array_equal(render(replace(dark, program=own)).color, lit)


@pytest.mark.parametrize(
    ("preset", "shading"), [("phong", "phong"), ("gouraud", "gouraud"), ("flat", "flat")]
)
def test_shading_in_glsl_is_that_of_the_program(preset, shading):
    for scene in (SPHERE, replace(make_scene("cube"), size=(48, 48))):
        ours = render(_with(preset, scene)).color
        theirs = render(scene, Settings(shading=shading)).color
        # Flat shading of the program lights the centre of a triangle, dFdx and dFdy the point itself.
        assert np.abs(ours - theirs).max() < (0.06 if preset == "flat" else 2e-5)
        assert theirs.max() > 0.5


def test_discard_makes_holes_and_a_wave_moves_vertices():
    culled = Settings(cull="back")
    covered = (render(SPHERE).primitive >= 0).sum()
    assert 0.3 * covered < (render(_with("alpha-test"), culled).primitive >= 0).sum() < 0.9 * covered
    assert (render(_with("alpha-test", threshold=0.0), culled).primitive >= 0).sum() == covered
    moved, still = render(_with("wave", height=0.3)), render(_with("wave", height=0.0))
    assert not np.array_equal(moved.primitive, still.primitive)
    np.testing.assert_array_equal(still.color, render(_with("phong")).color)


def test_toon_shading_has_as_many_bands_as_asked():
    white = replace(SPHERE, meshes=(replace(SPHERE.meshes[0], colors=None),))
    frame = render(_with("toon", white, steps=3))
    assert len(np.unique(frame.color[frame.primitive >= 0][:, 0])) == 4


def test_a_program_goes_to_another_process_as_text():
    program = preset_program("phong", SPHERE)
    again = pickle.loads(pickle.dumps(program))
    assert again == program
    assert again.name == "Phong shading"


def test_the_slides_shaders_are_theirs_word_for_word():
    assert "out_frag_color = vec4(1.0, 1.0, 0.0, 1.0); // yellow" in MINIMAL_FRAGMENT
    assert "// TODO: set the vColor out to the color we recieved" in TASK_VERTEX
    with pytest.raises(ValueError, match="preset must be one of minimal, task, flat"):
        preset_program("metal", SPHERE)
