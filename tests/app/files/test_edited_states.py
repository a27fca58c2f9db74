"""Edited listings in state files: kept as text, opened with a note, and never run where they cannot."""

import json
import re
from dataclasses import replace

import pytest

from app.files.state_files import EXTENSION, State, load_state, save_state
from app.files.state_models import DraftRecord, Look
from app.files.state_scenes import StateFileError
from app.session.document import Document, TeachingRaster
from core import Settings, render
from core.edits.edit import Edit, apply_edit, edits_of, original
from lessons.mistakes.twin import frame_bytes
from lessons.scenes import make_scene

LINE = Edit("line", "bresenham", original("line", "bresenham").source.replace("D >= 0", "D > 4"))


@pytest.fixture
def state():
    """A state that runs two edits."""
    scene = make_scene("line-strip")
    blend = Edit("blend", "over", original("blend", "over").source.replace("1 - alpha", "0.5", 1))
    settings = apply_edit(apply_edit(Settings(), LINE), blend)
    return State(Document(scene, TeachingRaster(*scene.size), settings=settings))


def test_an_edit_is_saved_as_text_and_opened_with_a_note(state, tmp_path):
    path = tmp_path / f"state{EXTENSION}"
    save_state(path, state)
    loaded, notes = load_state(path)
    assert loaded.document.settings == state.document.settings
    assert len(edits_of(loaded.document.settings)) == 2
    scene = state.document.scene
    assert frame_bytes(render(scene, loaded.document.settings)) == frame_bytes(
        render(scene, state.document.settings)
    )
    assert notes == (
        "This runs a listing that was edited: listing of Bresenham, integers.",
        "This runs a listing that was edited: listing of Over.",
    )
    kept = json.loads(path.read_text(encoding="utf-8"))
    assert kept["edits"][0] == {"part": "line", "of": "bresenham", "text": LINE.text}
    assert kept["settings"]["line"] == "bresenham"


def test_a_state_without_edits_has_no_field_for_them(state, tmp_path):
    path = tmp_path / f"state{EXTENSION}"
    save_state(path, replace(state, document=replace(state.document, settings=Settings())))
    assert "edits" not in json.loads(path.read_text(encoding="utf-8"))
    assert load_state(path)[1] == ()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"text": "def f(:"}, "edits: line 1, column 6"),
        ({"text": "import os\n"}, "edits: line 1, column 1: a listing is one function"),
        ({"text": LINE.text.replace("x += sx", "x += __import__('os')")}, "there is no function __import__"),
        ({"text": "x" * 6001}, "edits.0.text"),
        ({"of": "dda"}, "line of dda is not the method that settings choose"),
        ({"part": "shade"}, "is not the method that settings choose|one of line"),
        ({"more": 1}, "edits.0.more is not a known field"),
    ],
)
def test_an_edit_that_cannot_run_is_refused_with_its_field(state, tmp_path, change, words):
    path = tmp_path / f"state{EXTENSION}"
    save_state(path, state)
    kept = json.loads(path.read_text(encoding="utf-8"))
    kept["edits"][0] |= change
    path.write_text(json.dumps(kept), encoding="utf-8")
    with pytest.raises(StateFileError, match=words):
        load_state(path)


def test_an_edit_that_the_scene_passes_over_is_refused(tmp_path):
    scene = make_scene("shared-edge")
    path = tmp_path / f"state{EXTENSION}"
    save_state(path, State(Document(scene, TeachingRaster(8, 8), settings=apply_edit(Settings(), LINE))))
    with pytest.raises(StateFileError, match=r"edits: .*would not run: only wireframes draw lines"):
        load_state(path)


def test_texts_that_do_not_run_are_kept_with_their_message(state, tmp_path):
    drafts = [
        DraftRecord(part="line", of="dda", text="def f(:"),
        DraftRecord(part="fill", of="bounding-box", text="x" * 7000),
        DraftRecord(part="blend", of="over", text=original("blend", "over").source),
    ]
    path = tmp_path / f"state{EXTENSION}"
    save_state(path, replace(state, look=Look(drafts=drafts)))
    loaded, notes = load_state(path)
    assert loaded.look.drafts == drafts
    said = [note for note in notes if note.startswith("A text that does not run is kept for the ")]
    for note, words in zip(
        said, ("DDA, .*never closed", "6,000 characters.*7,000", "has not been run yet"), strict=True
    ):
        assert re.search(words + r"\. Edit opens it\.$", note), note
    kept = json.loads(path.read_text(encoding="utf-8"))
    kept["look"]["drafts"][0] |= {"part": "depth", "of": "fixed-38"}
    path.write_text(json.dumps(kept), encoding="utf-8")
    with pytest.raises(StateFileError, match=r"look\.drafts: It compares whole numbers"):
        load_state(path)


def test_an_endless_edit_opens_and_tells_when_it_runs(tmp_path):
    scene = make_scene("segment")
    endless = Edit(
        "line", "bresenham-lecture", original("line", "bresenham-lecture").source.replace("x += sx", "x = x")
    )
    path = tmp_path / f"state{EXTENSION}"
    save_state(
        path, State(Document(scene, TeachingRaster(*scene.size), settings=apply_edit(Settings(), endless)))
    )
    loaded, _ = load_state(path)
    with pytest.raises(ValueError, match="does it ever end"):
        render(scene, loaded.document.settings)
