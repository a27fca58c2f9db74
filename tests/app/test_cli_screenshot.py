"""``rasterscope screenshot``: the window in a file, without a display."""

import os

import numpy as np
import pytest
from PIL import Image

from tests.app.cli_runs import refused, run_program

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


@pytest.mark.parametrize(
    ("arguments", "wanted"),
    [
        (["gone.obj", "-o", "a.png"], "there is no file gone.obj"),
        (["cube", "-o", "a.png", "--view", "upside-down"], "view must be one of pixels"),
        (["cube", "-o", "gone/a.png"], "cannot be written: there is no folder"),
    ],
)
def test_what_cannot_be_done_is_one_line(tmp_path, arguments, wanted):
    line = refused(1, "screenshot", *arguments, cwd=tmp_path, **NO_DISPLAY)
    assert line.startswith("rasterscope screenshot: ")
    assert wanted in line
    assert list(tmp_path.iterdir()) == []
