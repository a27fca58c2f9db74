"""``rasterscope screenshot``: the window in a file, without a display."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

from app.pages.stability.atlas_files import atlas_json
from core.study.record import Axis
from core.study.stability import experiments, stress
from tests.app.cli.cli_runs import ROOT, refused

NO_DISPLAY = {"DISPLAY": "", "WAYLAND_DISPLAY": "", "QT_QPA_PLATFORM": ""}


LINES = ["--page", "compare", "--show", "visibility", "--work", "cycle", "--rounds", "1"]
DIAL = ["--page", "stability", "--show", "precision-dial"]
SHOTS = {
    "dark": ["shared-edge", "--size", "1100x700", "--theme", "dark"],
    "first": ["shared-edge", "--stage", "raster", "--step", "1"],
    "plain": ["shared-edge", "--stage", "resolve"],
    "smooth": ["shared-edge", "--stage", "resolve", "--set", "antialiasing=ssaa-16"],
    "saved": ["../maps/atlas.json"],
}
"""Name of a picture of the window to what it shows."""
PAGES = {
    "space": ["shared-edge", "--stage", "raster", "--show", "pyramid"],
    "last": ["shared-edge"],
    "lines": ["shared-edge", *LINES],
    "plan": ["shared-edge", "--page", "plan"],
    "closed": ["shared-edge", *DIAL],
    "opened": ["shared-edge", *DIAL, "--choose", "coverage=float32"],
}
"""The same of other pages, which are measured, planned and mapped first."""
ONE_AFTER_THE_OTHER = """
import json, sys
from app.cli.commands import run_command_line
sys.exit(sum(run_command_line(["screenshot", *arguments]) for arguments in json.loads(sys.argv[1])))
"""


def run_all(folder, commands):
    """Run the command with all these arguments in one process: to start one for each takes longer than the rest."""
    environment = {
        **os.environ,
        **NO_DISPLAY,
        "PYTHONPATH": str(ROOT),
        "PYTHONWARNINGS": "error",
        "RASTERSCOPE_CONFIG": str(folder / "none"),
    }
    return subprocess.run(
        [sys.executable, "-P", "-c", ONE_AFTER_THE_OTHER, json.dumps(commands)],
        capture_output=True,
        encoding="utf-8",
        cwd=folder,
        env=environment,
        timeout=300,
    )


def pictures_in(folder, wanted):
    """Make pictures of the window, and return them by name, (h, w, 3)."""
    (folder / "maps").mkdir()
    axes = tuple(
        Axis(a.name, a.title, a.unit, a.values[:3], True) for a in experiments.get("slivers").info.axes
    )
    (folder / "maps" / "atlas.json").write_text(atlas_json(stress("slivers", axes=axes)))
    shots = folder / "shots"
    shots.mkdir()
    run = run_all(shots, [[*arguments, "-o", f"{name}.png"] for name, arguments in wanted.items()])
    assert (run.returncode, run.stdout, run.stderr) == (0, "", "")
    written = {f"{name}.png" for name in wanted}
    assert set(os.listdir(shots)) == written, "a picture must not change what the window remembers"
    found = {}
    for name in wanted:
        with Image.open(shots / f"{name}.png") as image:
            found[name] = np.asarray(image.convert("RGB")).astype(int)
    return found


def differs(first, second):
    """Return the part of the pixels of two pictures that differ."""
    return (first != second).any(axis=2).mean()


def test_pictures_made_without_a_display_show_what_was_asked_for(tmp_path):
    """One test, so that one worker makes the pictures once."""
    pictures = pictures_in(tmp_path, SHOTS)

    assert pictures["dark"].shape == (700, 1100, 3)
    assert pictures["dark"].mean() < 90
    assert pictures["plain"].mean() > 180

    # Stage, step, view and method.
    plain = pictures["plain"]
    for name in ("first", "smooth"):
        assert pictures[name].shape == plain.shape == (800, 1280, 3)
        assert differs(pictures[name], plain) > 0.01, name

    assert differs(pictures["saved"], plain) > 0.05


@pytest.mark.slow
def test_pages_are_filled_and_what_is_behind_a_mark_is_opened(tmp_path):
    pictures = pictures_in(tmp_path, PAGES)
    pages = [pictures[name] for name in ("space", "last", "lines", "closed", "plan")]
    for number, page in enumerate(pages):
        for other in pages[:number]:
            assert differs(page, other) > 0.05
    lower = slice(560, 760), slice(290, 1280)
    assert differs(pictures["closed"][lower], pictures["opened"][lower]) > 0.2


@pytest.mark.parametrize(
    ("arguments", "wanted"),
    [
        (["cube", "--page", "plan", "--stage", "raster"], "--stage: it is for page step, got page plan"),
        (
            ["cube", "--show", "slivers"],
            "view must be one of pixels, scene, clip, pyramid, texture, flow, compare, got slivers",
        ),
        (
            ["cube", "--page", "plan", "--show", "x"],
            "--show: it is for page step or compare or stability or exercises, got page plan",
        ),
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
    assert wanted in refused(2, "screenshot", *arguments, "-o", "a.png", cwd=tmp_path)


@pytest.mark.parametrize("name", ["gone.json", "gone.obj"])
def test_what_is_not_there_is_one_line(tmp_path, name):
    line = refused(1, "screenshot", name, "-o", "a.png", cwd=tmp_path)
    assert line.startswith("rasterscope screenshot: ")
    assert f"there is no file {name}" in line
    assert list(tmp_path.iterdir()) == []
