"""Files of earlier versions of the program open with all that they held."""

import json
from dataclasses import asdict
from pathlib import Path

import pytest

from app.files.atlas_files import load_atlas
from app.files.state_files import load_state
from app.files.state_models import Breakpoints, Look
from app.files.study_files import load_study
from core.pipeline import render

EARLIER = Path(__file__).parent / "earlier"
NEWER = {"polygon_clipping": "none", "polygon_fill": "even-odd"}
"""What settings of families have that are younger than the files: their defaults."""


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
    assert state.breakpoints.model_dump(mode="json") == written["breakpoints"]
    assert state.look.model_dump(mode="json", exclude_defaults=True) == written["look"]


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
