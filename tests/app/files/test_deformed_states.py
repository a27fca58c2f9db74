"""States keep bones and shapes, and refuse those that do not fit."""

from pathlib import Path

import numpy as np
import pytest

from app.files.state_arrays import with_deformation
from app.files.state_files import State, load_state, save_state
from app.session.document import open_document
from core import render
from lessons.scene_edits import move_corner, set_value
from lessons.scenes import make_scene


@pytest.mark.parametrize(
    ("name", "path", "value"),
    [("bent-bar", "bone/0/1/angle", 120.0), ("blended-bar", "shape/0/0/weight", 0.25)],
)
def test_an_edited_deformation_is_kept(tmp_path: Path, name: str, path: str, value: float) -> None:
    scene = set_value(make_scene(name), path, value, (64, 48))
    save_state(tmp_path / "kept.rasterscope", State(open_document(scene, name)))
    state, warnings = load_state(tmp_path / "kept.rasterscope")
    kept, before = state.document.scene.meshes[0].deformation, scene.meshes[0].deformation
    assert warnings == ()
    for field, values in vars(before).items():
        assert np.array_equal(getattr(kept, field), values)
    assert np.array_equal(render(state.document.scene).color, render(scene).color)
    assert not np.array_equal(render(scene).color, render(make_scene(name)).color)


def test_arrays_that_do_not_fit_are_refused() -> None:
    held = make_scene("bent-bar").meshes[0].deformation
    arrays = {f"skin_{name}": values for name, values in vars(held).items()}
    with pytest.raises(ValueError, match="a skin needs all and only the arrays weights, heads"):
        with_deformation({name: values for name, values in arrays.items() if name != "skin_axes"})
    with pytest.raises(ValueError, match="a skin needs all and only"):
        with_deformation(arrays | {"blend_targets": np.zeros((1, 18, 3))})


def test_a_corner_that_bones_place_is_not_dragged() -> None:

    with pytest.raises(ValueError, match="bones or shapes place this vertex"):
        move_corner(make_scene("bent-bar"), 0, 0, (3.0, 3.0), (64, 48))
    with pytest.raises(ValueError, match="must be finite"):
        set_value(make_scene("bent-bar"), "bone/0/0/angle", float("nan"), (64, 48))
