"""Every mistake of the shelf of shaders changes the picture, and is recognised by it, however it is written."""

from dataclasses import replace

import numpy as np
import pytest

from core import Settings, render
from core.shaders.presets import preset_program
from lessons.lectures.scenes import scene_named
from lessons.mistakes.shaders import SHELF, recognised, wrong_program
from lessons.scenes import make_scene


def scene_for(mistake):
    if mistake.preset == "task":
        return replace(scene_named("lmu-shaders").make(), program=None)
    return replace(make_scene("sphere"), size=(40, 40))


@pytest.mark.parametrize("mistake", SHELF, ids=[mistake.name for mistake in SHELF])
def test_a_mistake_is_seen_and_named(mistake):
    scene = scene_for(mistake)
    right, wrong = preset_program(mistake.preset, scene), wrong_program(mistake, scene)
    assert wrong != right
    pictures = [render(replace(scene, program=program)).color for program in (right, wrong)]
    assert np.abs(pictures[0] - pictures[1]).max() > 0.01
    assert recognised(right, scene, Settings()) is None
    assert recognised(wrong, scene, Settings()) == mistake
    assert mistake.says.endswith(".")


def test_another_way_to_write_it_is_recognised():
    scene = scene_for(SHELF[0])
    program = preset_program("phong", scene)
    longer = program.fragment.replace("vec3 N = normalize(vNormal);", "vec3 n = vNormal; vec3 N = n * 1.0;")
    assert recognised(replace(program, fragment=longer), scene, Settings()).name == "normal-not-unit"
    unit = program.fragment.replace("normalize(vNormal)", "vNormal / length(vNormal)")
    assert recognised(replace(program, fragment=unit), scene, Settings()) is None
    assert recognised(replace(program, name=""), scene, Settings()) is None
