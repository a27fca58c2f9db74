"""Fresh random cases, drawn by the OpenGL of this machine and by the core; skipped where there is none."""

import os
import subprocess
import sys
from contextlib import ExitStack
from pathlib import Path

import numpy as np
import pytest

from app.cli.opengl_check import describe, run_opengl_check
from app.opengl_check.cases import Case, OpenGLMissingError, OpenGLRenderer, clip_positions
from app.opengl_check.compare import compare
from app.opengl_check.families import FAMILIES, make_case
from app.opengl_check.shaders import SHADERS
from tests.covering import is_everything
from tests.oracle.record_cases import read_case, write_case

ROOT = Path(__file__).resolve().parents[2]
SEED = 20
COUNT = 12 if is_everything() else 6


@pytest.fixture(scope="module")
def renderer():
    with ExitStack() as stack:
        try:
            opened = stack.enter_context(OpenGLRenderer())
        except OpenGLMissingError as error:
            pytest.skip(str(error))
        yield opened


def run_python(code, **environment):
    return subprocess.run(
        [sys.executable, "-X", "dev", "-W", "error", "-c", code],
        cwd=ROOT,
        env=os.environ | environment,
        capture_output=True,
        text=True,
        timeout=120,
    )


@pytest.mark.parametrize("family", list(FAMILIES))
def test_family_is_the_same(renderer, family):
    for number in range(COUNT):
        case = make_case(family, SEED, number)
        picture = renderer.draw(case)
        for fill in ("hierarchy", "spans"):
            result = compare(case, picture, fill)
            assert result.agrees, f"case {number} of {family}, {fill}: {describe(result)}"


def test_left_and_bottom_edges_are_inclusive(renderer):
    """A square between pixel centres has the centres on its left and bottom edge, not those on the others."""
    corners = np.array([[1.5, 1.5], [4.5, 1.5], [4.5, 3.5], [1.5, 3.5]])
    clip = clip_positions(corners, 0.5, 1, (6, 5))[[[0, 1, 2], [0, 2, 3]]]
    picture = renderer.draw(Case("shared", clip, np.ones((2, 3, 3), np.float32), (6, 5)))
    drawn = ["".join(".#"[seen] for seen in row) for row in (picture.primitive >= 0).tolist()[::-1]]
    assert drawn == ["......", "......", ".###..", ".###..", "......"]


def test_an_edge_through_the_eye_is_the_same(renderer):
    """Aimed from its snapped end at the corner behind the eye, it turned by 444 pixels."""
    corners = [
        [-0.8425715, -0.8410074, 0, 1],
        [0.84418344, 0.8421102, 0, -1],
        [-1.2836984, -0.19621398, 0, 1],
    ]
    case = Case("any-w", np.array([corners], np.float32), np.ones((1, 3, 3), np.float32), (512, 512))
    result = compare(case, renderer.draw(case))
    assert result.unexplained == 0
    assert len(result.differing) < 10


def test_depth_is_stored_in_float32(renderer):
    depth = 0.123456789
    clip = clip_positions(np.array([[[0.0, 0], [9, 0], [0, 9]]]), depth, 1, (4, 4))
    case = Case("depth", clip, np.ones((1, 3, 3), np.float32), (4, 4), depth_test=True)
    assert renderer.draw(case).depth[0, 0] == pytest.approx(depth, abs=6e-8)


def test_renderers_do_not_disturb_each_other(renderer):
    case = make_case("mesh", SEED, 0, 40)
    expected = renderer.draw(case)
    for _ in range(10):
        with OpenGLRenderer() as other:
            assert np.array_equal(other.draw(case).color, expected.color)
            assert np.array_equal(renderer.draw(case).depth, expected.depth)
    assert np.array_equal(renderer.draw(case).primitive, expected.primitive)


def test_a_recorded_case_comes_back_as_it_was(renderer, tmp_path):
    case = make_case("bilinear", SEED, 1, 40)
    picture = renderer.draw(case)
    write_case(tmp_path / "case.npz", case, picture, renderer.name)
    read, read_picture = read_case(tmp_path / "case.npz")
    for name in ("clip", "attributes"):
        assert np.array_equal(getattr(read, name), getattr(case, name))
    for name in ("color", "depth", "primitive"):
        assert np.array_equal(getattr(read_picture, name), getattr(picture, name))
    assert read.settings() == case.settings()
    assert (read.size, read.guard, read.family) == (case.size, case.guard, case.family)
    assert np.array_equal(renderer.draw(read).color, picture.color)


@pytest.mark.parametrize(
    "chosen", [list(FAMILIES)[:2], pytest.param([*FAMILIES, SHADERS], marks=pytest.mark.slow)]
)
def test_command_writes_a_line_for_every_family(renderer, chosen):
    lines = []
    assert run_opengl_check(chosen if len(chosen) == 2 else None, 1, SEED, lines.append) == 0
    assert renderer.name in lines[0]
    assert [line.split()[0] for line in lines[2:-2]] == chosen
    assert all(line.endswith("  agrees") for line in lines[2:-2])
    assert lines[-1] == "All families agree within the tolerances."


@pytest.mark.usefixtures("renderer")
@pytest.mark.slow
def test_process_that_used_opengl_ends_well():
    code = (
        "from app.cli.opengl_check import run_opengl_check as run; raise SystemExit(run(['mesh'], count=2))"
    )
    result = run_python(code)
    assert (result.returncode, result.stderr) == (0, "")
    assert result.stdout.splitlines()[-1] == "All families agree within the tolerances."


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"families": ["triangles"]}, "family must be one of single, "),
        ({"count": 0}, "count must be at least 1, got 0"),
        ({"seed": -1}, "seed must be at least 0, got -1"),
    ],
)
def test_wrong_arguments_are_one_line(capsys, arguments, sentence):
    assert run_opengl_check(**arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(f"rasterscope opengl-check: {sentence}")
    assert err.count("\n") == 1


def test_missing_moderngl_is_one_line(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "moderngl", None)
    assert run_opengl_check() == 1
    err = capsys.readouterr().err
    assert err.startswith(
        "rasterscope opengl-check: the comparison with OpenGL needs moderngl (pip install moderngl)"
    )
    assert err.count("\n") == 1


@pytest.mark.skipif(
    sys.platform != "linux", reason="only on Linux the library's name can be set from outside"
)
@pytest.mark.slow
def test_missing_opengl_is_one_line():
    pytest.importorskip("moderngl")
    code = "from app.cli.opengl_check import run_opengl_check as run; raise SystemExit(run())"
    result = run_python(code, GLCONTEXT_LINUX_LIBEGL="libEGL-that-is-not-there.so")
    assert result.returncode == 1
    assert result.stdout == ""
    assert result.stderr.startswith("rasterscope opengl-check: OpenGL 3.3 could not be started: ")
    assert result.stderr.count("\n") == 1


def test_a_seed_makes_the_same_cases_again():
    for family in FAMILIES:
        first, again, other = (make_case(family, *which) for which in ((3, 5), (3, 5), (3, 6)))
        assert np.array_equal(first.clip, again.clip)
        assert np.array_equal(first.attributes, again.attributes)
        assert not np.array_equal(first.clip, other.clip)


def test_guard_needs_an_even_raster():
    case = make_case("single", SEED, 0)
    with pytest.raises(ValueError, match=r"size must be even for a guard of 2, got \(5, 4\)"):
        Case("single", case.clip, case.attributes, (5, 4), guard=2)
