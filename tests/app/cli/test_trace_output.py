"""A trace is written in pieces: with progress, the same for every size of piece, and never as half a file."""

import csv
import io
import json
import sys

import pytest

from app.cli import trace, trace_tables
from core import Settings
from core import trace as core_trace
from lessons.scenes import make_scene
from tests.app.cli.cli_runs import run_program

TRACED = ("trace", "shared-edge", "--triangle", "1", "--stage", "raster", "--size", "16x12")


class Terminal(io.StringIO):
    """A stream that counts as a terminal."""

    def isatty(self) -> bool:
        return True


def test_the_size_of_a_batch_does_not_show(monkeypatch):
    whole = run_program(*TRACED, "--format", "csv").stdout
    monkeypatch.setattr(trace_tables, "BATCH", 7)
    assert run_program(*TRACED, "--format", "csv").stdout == whole
    assert len(whole.splitlines()) > 20


@pytest.mark.parametrize("form", ["csv", "text", "json"])
def test_an_interrupt_leaves_the_earlier_file_whole(monkeypatch, tmp_path, form):
    path = tmp_path / "a.txt"
    path.write_text("earlier")
    monkeypatch.setattr(trace_tables, "BATCH", 7)
    written = []

    def parts(*arguments):
        for done in trace_tables.table_parts(*arguments):
            if len(written) == 5:
                raise KeyboardInterrupt
            written.append(done)
            yield done

    monkeypatch.setattr(trace, "table_parts", parts)
    run = run_program(*TRACED, "--format", form, "-o", path)
    assert (run.returncode, run.stdout, run.stderr) == (130, "", "")
    assert [found.name for found in tmp_path.iterdir()] == ["a.txt"]
    assert path.read_text() == "earlier"


def test_progress_is_shown_on_a_terminal_only(monkeypatch, tmp_path):
    monkeypatch.setattr(trace, "PAUSE", 0)
    monkeypatch.setattr(sys, "stderr", Terminal())
    trace.write_parts([(0, "names\n"), (50, "1\n"), (100, "2\n")], 100, str(tmp_path / "a.csv"))
    assert "\r\x1b[KWriting row 50 of 100 50 %" in sys.stderr.getvalue()
    assert sys.stderr.getvalue().endswith("\r\x1b[K")
    assert (tmp_path / "a.csv").read_text() == "names\n1\n2\n"
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    trace.write_parts([(50, "1\n")], 100, str(tmp_path / "a.csv"))
    assert sys.stderr.getvalue() == ""


def test_many_rows_with_sentences_are_announced(monkeypatch):
    monkeypatch.setattr(trace, "MANY_ROWS", 10)
    run = run_program(*TRACED, "--format", "json")
    (line,) = run.stderr.splitlines()
    assert line.startswith("rasterscope: ")
    assert line.endswith("csv and npz take seconds")
    assert len(json.loads(run.stdout)["rows"]) > 10
    assert run_program(*TRACED, "--format", "csv").stderr == ""


def test_a_table_names_the_first_triangle_too_and_leaves_out_none() -> None:
    stage = core_trace(make_scene("shared-edge"), Settings()).stage("raster")
    text = "".join(part for _, part in trace_tables.csv_parts(stage))
    rows = list(csv.DictReader(io.StringIO(text)))
    known = ["" if number < 0 else str(number) for number in stage.triangle.tolist()]
    assert [row["row_triangle"] for row in rows] == known
    assert {"0", "1"} <= set(known)
    pixels = [[row["pixel_column"], row["pixel_row"]] for row in rows]
    assert pixels == [["", ""] if min(at) < 0 else [*map(str, at)] for at in stage.pixel.tolist()]


def test_a_record_quotes_the_line_that_its_step_names_and_keeps_the_signs_of_infinities() -> None:
    stage = core_trace(make_scene("shared-edge"), Settings()).stage("raster")
    for position, done in trace_tables.explanations(stage, 0):
        made = next(o for o in trace_tables.row_record(stage, 0)["operations"] if o["position"] == position)
        assert made["code"] == done.listing.source.splitlines()[made["line"] - 1].strip()
    assert trace_tables.plain([float("inf"), float("-inf"), float("nan")]) == ["Infinity", "-Infinity", None]
