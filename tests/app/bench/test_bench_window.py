"""``rasterscope bench --window``: what it does in the window, and the figures that it writes."""

import csv
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from app.bench.report import this_machine
from app.bench.window import COLUMNS, csv_text, figures_of, opened_scene, table_text
from app.bench.window_script import Amount, Answer, Sample, Script, opened_window
from core import STAGES


def sample(milliseconds: float, action: str = "step", stage: str = "raster") -> Sample:
    seconds = milliseconds / 1000
    return Sample("cube", action, stage, "pixel", Answer(seconds, seconds / 2, seconds / 4, 0.003))


def test_figures_are_the_median_the_95th_percentile_and_the_longest() -> None:
    figures = figures_of(sample(time) for time in range(101))
    assert (figures.inputs, figures.median_ms, figures.p95_ms, figures.longest_ms) == (101, 50.0, 95.0, 100.0)
    assert (figures.processor_p95_ms, figures.stall_ms, figures.fixed_median_ms) == (47.5, 25.0, 3.0)


def test_the_table_has_every_action_in_every_stage_and_in_all() -> None:
    text = table_text([sample(10), sample(20, stage="depth"), sample(3, "hover")], (1280, 800))
    words = [line.split()[:4] for line in text.splitlines()[2:]]
    assert words == [
        ["step", "raster", "1", "10.0"],
        ["step", "depth", "1", "20.0"],
        ["step", "all", "2", "15.0"],
        ["hover", "all", "1", "3.0"],
    ]


def test_lessons_are_counted_in_fixed_work() -> None:
    text = table_text([sample(milliseconds, "lesson") for milliseconds in (6, 12, 60)], (1280, 800))
    # Half of each is the thread's own work, beside 3 ms of fixed work.
    assert text.endswith("next step of a lesson: 2.0 times the fixed work, 9.2 times at the 95th percentile")


def test_the_file_has_a_row_for_every_scene_action_stage_and_level() -> None:
    text = csv_text({(1280, 800): [sample(10), sample(30), sample(5, "hover")]}, this_machine(), "xcb")
    rows = list(csv.DictReader(text.splitlines()))
    assert tuple(rows[0]) == COLUMNS
    assert [(row["action"], row["inputs"], row["median_ms"], row["display"]) for row in rows] == [
        ("step", "2", "20.0", "xcb"),
        ("hover", "1", "5.0", "xcb"),
    ]


@pytest.mark.slow
def test_every_action_is_made_in_a_window_and_leaves_the_scene_unchanged(
    qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path))
    opened = opened_scene("cube")
    with opened_window(opened, (1280, 800)) as window:
        script = Script(window, "cube", Amount((0.4,), 2, 4))
        script.run()
        now = window.session.document
        assert (now.scene, now.settings) == (opened.document.scene, opened.document.settings)
    actions = {made.action for made in script.samples}
    assert actions == {"enter", "step", "scrub", "hover", "drag", "drop", "orbit", "lesson"}
    assert {made.stage for made in script.samples if made.action == "enter"} == set(STAGES)
    assert all(made.answer.wall >= 0 and made.answer.fixed > 0 for made in script.samples)
    assert list(tmp_path.iterdir()) == []
