"""``rasterscope screenshot``: the window in a file, without a display."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

from app.atlas_export import atlas_json
from core.study.stability import Axis, experiments, stress
from tests.app.cli_runs import ROOT, refused, run_program

NO_DISPLAY = {"DISPLAY": "", "WAYLAND_DISPLAY": "", "QT_QPA_PLATFORM": ""}


def shot(folder, *arguments):
    run = run_program(
        "screenshot",
        *arguments,
        "-o",
        "window.png",
        cwd=folder,
        RASTERSCOPE_CONFIG=folder / "none",
        **NO_DISPLAY,
    )
    assert (run.returncode, run.stdout, run.stderr) == (0, "", "")
    assert os.listdir(folder) == ["window.png"], "a picture of the window must not change what it remembers"
    with Image.open(folder / "window.png") as image:
        return np.asarray(image.convert("RGB")).astype(int)


def test_the_window_has_the_size_and_the_theme(tmp_path):
    light = shot(tmp_path, "shared-edge", "--size", "1100x700")
    dark = shot(tmp_path, "shared-edge", "--size", "1100x700", "--theme", "dark")
    assert light.shape == dark.shape == (700, 1100, 3)
    assert light.mean() > 180
    assert dark.mean() < 90


def test_stage_step_and_view_are_those_that_were_asked_for(tmp_path):
    first = shot(tmp_path, "shared-edge", "--stage", "raster", "--step", "1")
    last = shot(tmp_path, "shared-edge", "--stage", "raster")
    space = shot(tmp_path, "shared-edge", "--stage", "raster", "--view", "pyramid")
    assert first.shape == last.shape == space.shape == (800, 1280, 3)
    assert (first != last).any(axis=2).mean() > 0.01
    assert (space != last).any(axis=2).mean() > 0.01


def test_methods_are_those_that_were_asked_for(tmp_path):
    plain = shot(tmp_path, "shared-edge", "--stage", "resolve")
    smooth = shot(tmp_path, "shared-edge", "--stage", "resolve", "--set", "antialiasing=ssaa-16")
    assert (plain != smooth).any(axis=2).mean() > 0.01


def test_pages_are_filled(tmp_path):
    step = shot(tmp_path, "shared-edge")
    lines = shot(
        tmp_path,
        "shared-edge",
        *["--page", "compare", "--show", "visibility", "--work", "cycle", "--rounds", "1"],
    )
    maps = shot(tmp_path, "shared-edge", *["--page", "stability", "--show", "painters-cycle"])
    plan = shot(tmp_path, "shared-edge", "--page", "plan")
    pictures = [step, lines, maps, plan]
    for number, first in enumerate(pictures):
        for second in pictures[:number]:
            assert (first != second).any(axis=2).mean() > 0.05


def test_what_is_behind_a_mark_is_opened(tmp_path):
    page = ["shared-edge", *["--page", "stability", "--show", "precision-dial"]]
    closed, opened = shot(tmp_path, *page), shot(tmp_path, *page, "--choose", "coverage=float32")
    lower = slice(560, 760), slice(290, 1280)
    assert (closed[lower] != opened[lower]).any(axis=2).mean() > 0.2


def test_a_saved_atlas_is_shown_as_it_is(tmp_path):
    axes = tuple(
        Axis(a.name, a.title, a.unit, a.values[:3], True) for a in experiments.get("slivers").info.axes
    )
    atlas = tmp_path / "maps" / "atlas.json"
    atlas.parent.mkdir()
    atlas.write_text(atlas_json(stress("slivers", axes=axes)))
    (tmp_path / "picture").mkdir()
    saved, step = shot(tmp_path / "picture", str(atlas)), shot(tmp_path / "picture", "shared-edge")
    assert (saved != step).any(axis=2).mean() > 0.05


@pytest.mark.parametrize(
    ("arguments", "wanted"),
    [
        (["cube", "--page", "plan", "--stage", "raster"], "--stage: it is for page step, got page plan"),
        (["cube", "--show", "slivers"], "--show: it is for page compare or stability, got page step"),
        (
            ["cube", "--page", "stability", "--work", "any"],
            "--work: it is for page compare, got page stability",
        ),
        (["cube", "--page", "plan", "--rounds", "2"], "--rounds: it is for page compare, got page plan"),
        (["cube", "--grow"], "--grow: it is for page compare, got page step"),
        (["cube", "--page", "compare", "--rounds", "0"], "must be a whole number from 1 to 1000, got 0"),
        (["study.json", "--step", "3"], "--step: it is for page step, got a saved study or atlas"),
        (["study.json", "--page", "step"], "a saved study or atlas has its own, got study.json"),
        (["cube", "--page", "lesson"], "invalid choice: 'lesson'"),
    ],
)
def test_options_of_another_page_are_wrong_usage(tmp_path, arguments, wanted):
    line = refused(2, "screenshot", *arguments, "-o", "a.png", cwd=tmp_path, **NO_DISPLAY)
    assert wanted in line


REFUSED = [
    (["cube", "-o", "a.png", "--page", "compare", "--show", "tea"], "family must be one of "),
    (
        ["cube", "-o", "a.png", "--page", "compare", "--show", "line", "--work", "x"],
        "work of line must be one",
    ),
    (
        ["cube", "-o", "a.png", "--page", "stability", "--show", "tea"],
        "experiment must be one of precision-dial",
    ),
    (["gone.json", "-o", "a.png"], "gone.json cannot be opened: there is no such file"),
    (["gone.obj", "-o", "a.png"], "there is no file gone.obj"),
    (["cube", "-o", "a.png", "--view", "upside-down"], "view must be one of pixels"),
    (["cube", "-o", "gone/a.png"], "cannot be written: there is no folder"),
]
ONE_AFTER_THE_OTHER = """
import json, sys
from app.cli import run_command_line
sys.exit(sum(run_command_line(["screenshot", *arguments]) for arguments in json.loads(sys.argv[1])))
"""


def test_what_cannot_be_done_is_one_line(tmp_path):
    """All in one process: to start one for each takes longer than all that they do."""
    environment = {**os.environ, **NO_DISPLAY, "PYTHONPATH": str(ROOT), "PYTHONWARNINGS": "error"}
    lines = json.dumps([arguments for arguments, _ in REFUSED])
    run = subprocess.run(
        [sys.executable, "-P", "-c", ONE_AFTER_THE_OTHER, lines],
        capture_output=True,
        encoding="utf-8",
        cwd=tmp_path,
        env=environment,
        timeout=120,
    )
    assert (run.returncode, run.stdout) == (len(REFUSED), ""), run.stderr
    told = run.stderr.splitlines()
    for line, (_, wanted) in zip(told, REFUSED, strict=True):
        assert line.startswith("rasterscope screenshot: ")
        assert wanted in line
    assert list(tmp_path.iterdir()) == []


def test_a_picture_that_cannot_be_made_ends_the_program_with_1(tmp_path):
    line = refused(1, "screenshot", "gone.obj", "-o", "a.png", cwd=tmp_path, **NO_DISPLAY)
    assert "there is no file gone.obj" in line
