"""Files of earlier versions of the program open with all that they held."""

import json
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest

from app.files.open_any import open_any
from app.files.state_files import State, load_state, save_state
from app.files.state_models import Bookmark, Breakpoints, Look
from app.pages.compare.study_files import load_study
from app.pages.stability.atlas_files import load_atlas
from core import Settings
from core.coverage.edges import covers
from core.pipeline import render
from core.records.listing import listing

EARLIER = Path(__file__).parent / "earlier"
NEWER = asdict(Settings())
"""What settings have that are younger than the files: their defaults."""


@pytest.mark.parametrize(
    ("name", "triangles"),
    [("edited-cube", 12), ("typed-clip", 2), ("marked-torus", 4096), ("noted-torus", 4096)],
)
def test_a_state_opens_and_draws(name: str, triangles: int) -> None:
    written = json.loads((EARLIER / f"{name}.rasterscope").read_text(encoding="utf-8"))
    state, warnings = load_state(EARLIER / f"{name}.rasterscope")
    assert warnings == ()
    assert asdict(state.document.settings) == NEWER | written["settings"]
    frame = render(state.document.scene, state.document.settings)
    assert frame.statistics["transform"].incoming == triangles
    assert (frame.primitive >= 0).any()


def test_version_1_keeps_step_pin_bookmarks_and_view() -> None:
    state, _ = load_state(EARLIER / "marked-torus.rasterscope")
    assert (state.stage, state.position, state.level, state.pin) == ("depth", 7, 4, (247, 253))
    assert [(mark.stage, mark.position, mark.note) for mark in state.bookmarks] == [
        ("raster", 40, ""),
        ("depth", 7, ""),
    ]
    assert state.look == Look(view="compare")
    assert state.breakpoints == Breakpoints()


def test_version_2_keeps_marks_notes_and_look() -> None:
    written = json.loads((EARLIER / "noted-torus.rasterscope").read_text(encoding="utf-8"))
    state, _ = load_state(EARLIER / "noted-torus.rasterscope")
    assert [mark.note for mark in state.bookmarks] == ["the first tie", ""]
    # The line that computes an edge function; its number counted the docstring.
    assert state.breakpoints.model_dump(mode="json") == written["breakpoints"] | {"lines": [["covers", 5]]}
    assert listing(covers).source.splitlines()[4].strip().startswith("value = ")
    assert state.look.model_dump(mode="json", exclude_defaults=True) == written["look"]


def test_a_step_of_version_2_opens_in_its_row(tmp_path: Path) -> None:
    """A row of a printed span had two operations, and has three or four; a pixel of it has one."""
    document = open_any("single-triangle").document
    document = replace(document, settings=Settings(fill="scanline-lecture"))
    stage = document.make_trace().stage("raster")
    row = int(np.flatnonzero(stage.steps.kind == stage.steps.kinds.index("top"))[2])
    counts = [1 if stage.kind_of(k) == "accept" else 2 for k in range(row)]
    path = tmp_path / "state.rasterscope"
    save_state(
        path, State(document, "raster", sum(counts) + 1, bookmarks=[Bookmark(stage="raster", position=0)])
    )
    written = json.loads(path.read_text(encoding="utf-8"))
    path.write_text(json.dumps(written | {"version": 2}), encoding="utf-8")
    state, _ = load_state(path)
    assert stage.steps.row_at(state.position) == (row, 0)
    assert state.bookmarks[0].position == 0
    save_state(path, state)
    assert load_state(path)[0].position == state.position


def test_a_study_opens() -> None:
    written = json.loads((EARLIER / "study-cull-closed.json").read_text(encoding="utf-8"))
    study = load_study(EARLIER / "study-cull-closed.json")
    assert [point.title for point in study.points] == [point["title"] for point in written["points"]]
    assert asdict(study.settings) == NEWER | written["settings"]


def test_an_atlas_opens() -> None:
    written = json.loads((EARLIER / "stress-precision-dial.json").read_text(encoding="utf-8"))
    atlas = load_atlas(EARLIER / "stress-precision-dial.json")
    assert [found.method for found in atlas.maps] == [found["method"] for found in written["maps"]]
    assert [found.outcome.tolist() for found in atlas.maps] == [found["outcome"] for found in written["maps"]]
