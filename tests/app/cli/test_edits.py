"""``--edit PART=FILE``: a listing of one's own draws, is traced, and is told where it is wrong."""

import json
from argparse import ArgumentTypeError

import numpy as np
import pytest

from app.cli.arguments import SIZE_LIMIT, read_listing, size_from_text
from core import Settings, render
from core.edits.edit import Edit, apply_edit, original
from lessons.scenes import make_scene
from tests.app.cli.cli_runs import refused, run_program


@pytest.fixture
def listings(tmp_path):
    """Files of listings: an inside test that takes all ties, lines with a mistake, and some that cannot run."""
    test, line = original("fill", "bounding-box").source, original("line", "bresenham").source
    texts = {
        "test.py": test.replace("value > 0 or (value == 0 and owns_tie[k])", "value >= 0"),
        "broken.py": test.replace("for k in range(3):", "for k in range(3)"),
        "line.py": line.replace("if D >= 0:", "if D > 4:"),
        "endless.py": original("line", "bresenham-lecture").source.replace("x += sx", "x = x"),
        "long.py": "# a\n" * 9000,
    }
    for name, text in texts.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    (tmp_path / "bytes.py").write_bytes(b"\xff\xfe\x00")
    return tmp_path, texts


def test_render_draws_what_the_listing_says(listings):
    folder, texts = listings
    edit = f"fill={folder / 'test.py'}"
    out = folder / "buffers.npz"
    run = run_program("render", "shared-edge", "--set", "fill=bounding-box", "--edit", edit, "--buffers", out)
    assert (run.returncode, run.stderr) == (0, "")
    ours = render(
        make_scene("shared-edge"), apply_edit(Settings(), Edit("fill", "bounding-box", texts["test.py"]))
    )
    with np.load(out) as found:
        np.testing.assert_array_equal(found["primitive"], ours.primitive)
        assert not np.array_equal(found["primitive"], render(make_scene("shared-edge")).primitive)


def test_trace_steps_through_the_listing_with_its_own_lines(listings):
    folder, _ = listings
    run = run_program("trace", "segment", "--stage", "raster", "--edit", f"line={folder / 'line.py'}")
    assert (run.returncode, run.stderr) == (0, "")
    rows = json.loads(run.stdout)["rows"]
    done = [operation for row in rows for operation in row["operations"]]
    assert all(f"ine {each['line']}" in each["sentence"] for each in done)
    assert any("D" in each["formula"]["symbolic"] for each in done if each.get("formula"))


@pytest.mark.parametrize(
    ("code", "arguments", "words"),
    [
        (
            1,
            ("shared-edge", "--set", "fill=bounding-box", "--edit", "fill=broken.py"),
            "broken.py: line 4, column 20: a colon",
        ),
        (
            1,
            ("segment", "--set", "line=bresenham-lecture", "--edit", "line=endless.py"),
            "line 12, column 3: the loop",
        ),
        (1, ("shared-edge", "--edit", "line=line.py"), "would not run: only wireframes draw lines"),
        (1, ("segment", "--edit", "line=nowhere.py"), "no such file"),
        (1, ("segment", "--edit", "line=long.py"), "more than the limit"),
        (2, ("shared-edge", "--set", "fill=spans", "--edit", "fill=test.py"), "it tests no pixel"),
        (2, ("segment", "--edit", "line=bytes.py"), "is no text in UTF-8"),
        (2, ("segment", "--edit", "shade=line.py"), "what can be edited is one of line,"),
        (2, ("segment", "--edit", "line"), "must be PART=FILE"),
    ],
)
def test_what_cannot_run_is_told_in_one_line(listings, code, arguments, words):
    folder, _ = listings
    assert words in refused(code, "render", *arguments, "-o", folder / "out.png", cwd=folder)
    assert not (folder / "out.png").exists()


def test_a_listing_is_read_without_the_mark_of_its_encoding(tmp_path):
    (tmp_path / "a.py").write_bytes("def f():\n    return 1\n".encode("utf-8-sig"))
    assert read_listing(str(tmp_path / "a.py")) == "def f():\n    return 1\n"


def test_a_size_is_from_one_to_the_limit_each_way():
    for text in ("1x1", f"{SIZE_LIMIT}x1", f"1×{SIZE_LIMIT}"):
        assert max(size_from_text(text)) in (1, SIZE_LIMIT)
    for text in ("0x1", "1x0", f"{SIZE_LIMIT + 1}x1", f"1x{SIZE_LIMIT + 1}", "1x1x1"):
        with pytest.raises(ArgumentTypeError):
            size_from_text(text)
