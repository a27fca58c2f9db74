"""What is open, copied as TOML, opens the same again."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from core import Settings, render, trace
from core.edits.edit import Edit, original
from core.scene import ClipScene, Scene
from core.shaders.presets import preset_program
from lessons.course.catalogue import read_lesson
from lessons.course.copied import state_text
from lessons.course.state import States, changes_of_edits
from lessons.lectures.scenes import ALL_SCENES
from lessons.scene_edits import move_corner, set_value
from lessons.small_scenes import triangle_scene
from tests.lessons.course.lesson_texts import GOOD


def reopened(folder: Path, line: str):
    text = GOOD.replace('[state]\nstage = "raster"\nsettings = { fill = "bounding-box" }\n', "[state]\n")
    begin = text.index("state = { scene")
    path = folder / "copied.toml"
    path.write_text(text[:begin] + line + text[text.index("\n", begin) :])
    return States(read_lesson(path)).of_step(0)


def scenes():
    fan = ALL_SCENES["fan"]
    yield fan.title, fan.make(), {}
    yield fan.title, move_corner(fan.make(), 3, 1, (20.25, 30.5), (64, 48)), {"fill": "blocks"}
    yield fan.title, replace(fan.make(), size=(32, 24)), {"fill_rule": "inclusive"}
    depth = set_value(ALL_SCENES["shared-edge"].make(), "corner/0/1/w", 2.5, (64, 48))
    yield ALL_SCENES["shared-edge"].title, depth, {}
    floor = replace(ALL_SCENES["textured-floor"].make(), size=(64, 48))
    yield ALL_SCENES["textured-floor"].title, floor, {"interpolation": "affine"}
    yield ALL_SCENES["textured-floor"].title, set_value(floor, "camera/up/x", 0.05, (64, 48)), {}
    yield ALL_SCENES["near-plane"].title, ALL_SCENES["near-plane"].make(), {}
    yield ALL_SCENES["z-fighting"].title, ALL_SCENES["z-fighting"].make(), {"depth": "z-16"}
    yield ALL_SCENES["depth-table"].title, ALL_SCENES["depth-table"].make(), {}
    corners = [[(0.5, 0.5), (4.5, 0.5), (4.5, 4.5)]]
    yield "typed", triangle_scene(corners, (6, 6)), {}
    yield "typed", triangle_scene(corners, (6, 6), 0.25, [[1, 2, 4]], [[[0], [0.5], [1]]]), {}


@pytest.mark.parametrize(("title", "scene", "texts"), list(scenes()))
def test_what_is_copied_opens_the_same(
    tmp_path: Path, title: str, scene: ClipScene | Scene, texts: dict[str, str]
) -> None:
    settings = Settings(**texts)
    run = trace(scene, settings)
    for stage in ("raster", "depth"):
        steps = run.stage(stage).steps
        for position in {0, min(1, steps.count), steps.count // 3, steps.count // 2, steps.count}:
            line = state_text(run, settings, title, stage, position, pixel=(1, 2), buffer="")
            state = reopened(tmp_path, line)
            assert (state.stage, state.pixel, state.settings) == (stage, (1, 2), settings), line
            assert state.position(state.run) == position, line
    assert "0, 0, 0, 1" not in line  # Black is what corners have of which nothing is said.
    assert np.array_equal(render(state.scene, state.settings).color, render(scene, settings).color)


def test_a_and_b_are_copied(tmp_path: Path) -> None:
    fan = ALL_SCENES["fan"]
    run = trace(fan.make(), Settings())
    line = state_text(
        run, Settings(), fan.title, "raster", 0, other={"fill_rule": "inclusive"}, buffer="overdraw"
    )
    assert line == (
        'state = { scene = "fan", stage = "raster", buffer = "overdraw", other = { fill_rule = "inclusive" } }'
    )
    assert reopened(tmp_path, line).other == Settings(fill_rule="inclusive")


def test_what_no_lesson_can_name_is_refused() -> None:
    for name in ("sphere", "pentagram"):
        scene = ALL_SCENES[name].make()
        with pytest.raises(ValueError, match="only a built-in scene, or up to 64 triangles"):
            state_text(trace(replace(scene, size=(8, 6))), Settings(), "another title", "raster", 0)


def test_edited_listings_and_shaders_are_copied(tmp_path: Path) -> None:
    square = triangle_scene([[(0.5, 0.5), (4.5, 0.5), (4.5, 4.5)]], (6, 6))
    settings = Settings(fill="bounding-box")
    right = original("fill", "bounding-box").source
    for text in (
        right.replace("value > 0 or", "value >= 0 or"),
        right.replace("inside = []", ""),
        "def f(" + right,
    ):
        edits = (Edit("fill", "bounding-box", text),)
        (row,) = changes_of_edits(edits)
        assert right.replace(*row[1:]) == text
    edits = (Edit("fill", "bounding-box", right.replace("value > 0 or", "value >= 0 or")),)
    line = state_text(trace(square, settings), settings, "typed", "raster", 0, edits=edits)
    assert reopened(tmp_path, line).edits == edits
    sphere = replace(ALL_SCENES["sphere"].make(), size=(24, 16))
    program = preset_program("toon", sphere)
    for text in (program.fragment, program.fragment.replace("0.8 * band", "0.7 * band")):
        scene = replace(sphere, program=replace(program, fragment=text))
        line = state_text(trace(scene, Settings()), Settings(), "Sphere", "shade", 0)
        state = reopened(tmp_path, line)
        assert np.array_equal(render(state.scene).color, render(scene).color)
    for strange, said in (
        (replace(program, name=""), "only shaders that began with a preset"),
        (replace(program, uniforms=(("steps", (5.0,)),)), "uniforms"),
    ):
        with pytest.raises(ValueError, match=said):
            state_text(trace(replace(sphere, program=strange)), Settings(), "Sphere", "shade", 0)
