"""Split and dice: sizes of micropolygons, where they are cut, and that shading comes before hiding."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Settings, render, trace
from core.explain.step_tables import step_table
from core.explain.steps import row_sentence
from core.framebuffer.display import to_display
from core.stages.before_matrices import before_matrices, tessellated
from core.tessellation.ball import balls
from core.tessellation.bezier import levels, shares
from core.tessellation.measured_dice import disc
from core.tessellation.reyes import GRID_SIDE, control_length, reyes
from core.tessellation.segments import MOST_HALVINGS
from lessons.curve_scenes import hill

CORNER = st.tuples(st.floats(0, 200), st.floats(0, 200), st.sampled_from((1.0, 2.0, 4.0)))


@given(
    st.lists(st.lists(CORNER, min_size=4, max_size=4), min_size=1, max_size=4),
    st.sampled_from((0.5, 2.0, 8.0)),
)
def test_no_micropolygon_is_longer_than_its_side(corners, side):
    control = np.array(corners)
    rows = np.concatenate([control[..., :2] * control[..., 2:], control[..., 2:]], axis=2)
    cut = reyes(rows, 1, side)
    assert cut.step[0] == 0
    assert cut.step[-1] == cut.steps
    assert (np.diff(cut.step) > 0).all()
    assert cut.steps & (cut.steps - 1) == 0, "all parts are halves of halves"
    steps = np.full(len(cut.step), cut.steps)
    for row in rows:
        points = levels(*shares(cut.step, steps), np.repeat(row[None], len(cut.step), axis=0))[-1][:, 0]
        sides = np.linalg.norm(np.diff(points[:, :2] / points[:, 2:], axis=0), axis=1)
        assert sides.max() <= side + 1e-9
    for test in cut.tests:
        if test["parts"]:
            assert test["piece_length"] <= GRID_SIDE or test["halvings"] == MOST_HALVINGS
            assert test["part_length"] <= side


def test_the_rows_say_how_each_line_was_split_and_diced():
    scene = hill()
    settings = Settings(tessellation="reyes", curve_tolerance=64)
    found = trace(scene, settings).stage("transform")
    parts = found.columns["parts"]
    rows = [row for row in range(found.steps.row_count) if found.kind_of(row) in ("cut-split", "cut-dice")]
    cuts = tessellated(scene, settings).cuts
    assert [int(parts[row]) for row in rows] == [int(test["parts"]) for cut in cuts for test in cut.tests]


def test_a_cut_names_its_part_once_and_fills_the_table_of_cuts():
    found = trace(hill(), Settings(tessellation="reyes", curve_tolerance=64), 0).stage("transform")
    row = next(row for row in range(found.steps.row_count) if found.kind_of(row) == "cut-dice")
    position = found.steps.position_after(row)
    assert row_sentence(found, position).count("along u") == 1
    table = step_table(found, position)
    assert table.rows[row] == "Patch 0, part 0 of 4 along u"
    assert [cell.text for cell in table.cells[row]] == ["14.69", "8 parts"]
    last = int(np.flatnonzero(found.steps.kind == found.steps.kinds.index("emit"))[0])
    assert step_table(found, found.steps.position_after(last)).title.endswith("level by level")


def test_hidden_points_are_shaded_too():
    settings = Settings(tessellation="reyes", curve_tolerance=64, shading="gouraud")
    one, two = (before_matrices(balls(count), settings) for count in (1, 2))
    assert sum(len(mesh.positions) for mesh in two.meshes) == 2 * sum(
        len(mesh.positions) for mesh in one.meshes
    )
    assert (render(one, settings).primitive == render(two, settings).primitive).all()


def test_the_colours_tend_to_those_of_light_at_every_pixel():
    exact = to_display(
        render(balls(1), Settings(tessellation="reyes", curve_tolerance=8)).color
    ).pixels.astype(int)
    errors = []
    for side in (64, 32, 16):
        settings = Settings(tessellation="reyes", curve_tolerance=side, shading="gouraud")
        shown = to_display(render(balls(1), settings).color).pixels.astype(int)
        errors.append(float(np.abs(shown - exact)[disc()].mean()))
    assert errors[0] > errors[1] > errors[2]


def test_control_length_behind_the_eye():
    rows = np.array([[[0.0, 0, 1], [3, 4, 1], [3, 4, -1], [6, 8, 1]]])
    assert control_length(rows) == np.inf
    assert control_length(-rows[:, :2]) == 0.0
    assert control_length(rows[:, :2]) == pytest.approx(5)
