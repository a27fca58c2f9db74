"""State files: what is saved opens as it was."""

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.files.file_access import FileWriteError
from app.files.open_any import open_any
from app.files.state_arrays import READABLE_COUNT, array_record
from app.files.state_files import EXTENSION, State, load_state, readable_json, save_state
from app.files.state_scenes import StateFileError
from app.session.document import open_document
from lessons.scenes import make_scene, scene_names
from tests.app.files.states import again, assert_same, characters, states
from tests.covering import every_nth


@given(states())
def test_loading_gives_the_same_picture_and_the_same_step(tmp_path_factory, state):
    with np.errstate(all="ignore"):
        assert_same(state, again(tmp_path_factory.mktemp("state"), state))


@pytest.mark.parametrize("name", every_nth(scene_names(), 5))
def test_a_built_in_scene_is_named_not_copied(tmp_path, name):
    document = open_any(name).document
    assert_same(State(document), again(tmp_path, State(document)))
    assert (tmp_path / f"state{EXTENSION}").stat().st_size < 8000


def test_a_built_in_scene_with_a_moved_vertex_keeps_the_rest_by_name(tmp_path):
    document = open_any("torus").document
    mesh = document.scene.meshes[0]
    positions = mesh.positions.copy()
    positions[7] += 0.125
    scene = replace(document.scene, meshes=(replace(mesh, positions=positions),))
    state = State(replace(document, scene=scene))
    assert_same(state, again(tmp_path, state))
    record = json.loads((tmp_path / f"state{EXTENSION}").read_text())
    (saved,) = record["scene"]["meshes"]
    assert record["scene"]["source"] == {"built_in": "torus"}
    assert set(saved["arrays"]) == {"positions"}
    assert "triangles" in saved["from_source"]


@pytest.mark.parametrize("name", ["line-strip", "points"])
def test_the_kind_of_primitives_is_kept_and_checked(tmp_path, name):
    path = tmp_path / f"state{EXTENSION}"
    document = open_any(name).document
    assert_same(State(document), again(tmp_path, State(document)))
    record = json.loads(path.read_text())
    assert record["scene"]["primitives"] == document.scene.kind
    for kind, message in (("lines", "scene.primitives must be"), ("triangles", r"clip must be \(T, 3, 4\)")):
        record["scene"]["primitives"] = kind
        path.write_text(json.dumps(record))
        with pytest.raises(StateFileError, match=message):
            load_state(path)


@pytest.mark.parametrize("region", [(-1.0, -1.0, 0.0, 0.0), ((-1.0, -1.0), (1.0, -1.0), (0.0, 1.0))])
def test_the_clip_window_of_lines_is_kept(tmp_path, region):
    document = open_any("segment").document
    scene = replace(document.scene, clip_region=region)
    state = State(replace(document, scene=scene))
    assert_same(state, again(tmp_path, state))


def test_saving_where_it_is_not_possible_leaves_the_old_file(tmp_path):
    state = State(open_any("cube").document)
    with pytest.raises(FileWriteError, match="there is no folder"):
        save_state(tmp_path / "gone" / "a.rasterscope", state)
    path = tmp_path / "a.rasterscope"
    save_state(path, state)
    before = path.read_bytes()
    with pytest.raises(ValueError, match="position"):
        save_state(path, replace(state, position=-1))
    assert path.read_bytes() == before
    assert [found.name for found in tmp_path.iterdir()] == ["a.rasterscope"]


def test_the_file_can_be_read_by_people(tmp_path):
    again(tmp_path, State(open_any("single-triangle").document))
    lines = (tmp_path / f"state{EXTENSION}").read_text().splitlines()
    assert ' "version": 3,' in lines
    assert '  "fill_rule": "shared-edge",' in lines
    assert max(map(len, lines)) < 200
    assert len(lines) < 85


@given(
    st.recursive(
        st.none() | st.booleans() | st.integers() | st.text(characters),
        lambda v: st.lists(v) | st.dictionaries(st.text(characters), v),
    )
)
def test_readable_json_is_json(value):
    assert json.loads(readable_json(value)) == value


def test_a_pin_beside_the_raster_is_taken_away_with_a_warning(tmp_path):
    path = tmp_path / "state.rasterscope"
    document = open_document(make_scene("single-triangle"), "Single triangle")
    save_state(path, State(document, pin=(9999, 3)))
    state, warnings = load_state(path)
    assert state.pin is None
    assert warnings == ("The pinned pixel (9999, 3) is not in the raster: nothing is pinned.",)


def test_short_arrays_are_written_to_be_read_and_long_ones_packed():
    for count, is_read in ((READABLE_COUNT, True), (READABLE_COUNT + 1, False)):
        record = array_record(np.arange(float(count)))
        assert (record.rows is not None, record.zlib is not None) == (is_read, not is_read)
