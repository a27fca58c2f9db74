"""The scenes of the lectures show the numbers of their slides, and step."""

import dataclasses

import numpy as np
import pytest

from app.files.open_any import open_any
from app.session.document import STEPPED
from core import Settings, render, trace
from core.explain.steps import account, formula, variables
from core.stages.declared import STAGES
from lessons.lectures.catalogue import printed_listing
from lessons.lectures.scenes import ALL_SCENES, LECTURE_SCENES, LECTURES

OF_LECTURES = [scene.name for scenes in LECTURE_SCENES.values() for scene in scenes]


def make(name):
    return ALL_SCENES[name].make()


def pixels(name, settings):
    rows, columns = np.nonzero(render(make(name), settings).cover_count)
    return sorted(zip(columns.tolist(), rows.tolist(), strict=True))


def test_every_lecture_has_scenes_with_a_name_and_a_sentence():
    assert list(LECTURE_SCENES) == list(LECTURES)
    assert len(ALL_SCENES) == len(set(ALL_SCENES)) > len(OF_LECTURES)
    for lecture, scenes in LECTURE_SCENES.items():
        for scene in scenes:
            assert scene.name.startswith(f"{lecture.lower()}-")
            assert scene.description.endswith(".")


@pytest.mark.parametrize("name", OF_LECTURES)
def test_it_opens_by_its_name_draws_and_steps(name):
    scene = open_any(name).document.scene
    frame = render(scene)
    assert frame.cover_count.any() or name in ("jubair-parallel", "jubair-rejected")
    traced = trace(scene, open_any(name).document.settings)
    assert all(traced.stage(stage) is not None for stage in STAGES)


def test_a_scene_opens_with_the_method_of_its_slide():
    opened = open_any("jubair-cyrus-beck").document
    assert opened.settings == dataclasses.replace(STEPPED, line_clipping="cyrus-beck")
    assert open_any("cube").document.settings == STEPPED
    rows = trace(opened.scene, opened.settings).stage("raster").columns["t_leave"]
    assert rows[np.isfinite(rows)][-1] == pytest.approx(7 / 9)


def test_lines_show_where_the_printed_listing_leaves_the_right_one():
    right, early = [(0, 0), (1, 0), (2, 1), (3, 1), (4, 2), (5, 2)], [(0, 0), (1, 1), (2, 1), (3, 2), (4, 2)]
    assert pixels("pellacini-line", Settings(line="midpoint")) == right
    assert pixels("pellacini-line", printed_listing("pellacini-bresenham").settings(Settings())) == early
    naive = printed_listing("lmu-naive").settings(Settings())
    assert (3, 2) in pixels("lmu-line", Settings(line="bresenham-lecture"))
    assert (3, 3) in pixels("lmu-line", naive)
    falling = printed_listing("lmu-falling").settings(Settings())
    assert (5, 2) in pixels("lmu-falling-line", Settings())
    assert (5, 2) not in pixels("lmu-falling-line", falling)


def test_a_buffer_of_inverse_w_is_cleared_to_0_and_says_so():
    """1/w is 0 at infinity; every formula and every variable of it is named 1/w, as on the slide."""
    opened = open_any("zwicker-z-buffer").document
    depth = trace(opened.scene, opened.settings).stage("depth")
    assert depth.columns["before"].min() == 0
    for position in (2, 3):
        step = depth.explain(position)
        shown = formula(step)
        assert shown is None or "z" not in shown.symbolic
        assert not [each.name for each in variables(step) if "z" in each.name]
    text, _ = account(depth.explain(2), 0, tuple(depth.pixel[0].tolist()))
    assert "8 is larger than the buffer's 0" in text
    assert opened.scene.table.cleared == 0


def test_triangles_have_the_pixels_of_their_slide():
    count = render(make("zwicker-shared-edge"), Settings()).cover_count
    assert (np.count_nonzero(count), count.max()) == (12, 1)
    assert render(make("lmu-three-js"), Settings(cull="back")).cover_count.any()
    assert not render(make("lmu-three-js"), Settings(cull="front")).cover_count.any()
    np.testing.assert_allclose(render(make("jubair-triangle")).color[0, 1, :3], [0.6875, 0.1875, 0.125])
    lit = render(make("lmu-scanline-triangle"), Settings(fill="scanline-lecture")).cover_count
    assert np.count_nonzero(lit.any(axis=1)) == 12
