"""The harness, with the core, Pillow and toy libraries: checks, turns, tables, files."""

import csv
import gc
import io
from types import ModuleType
from xml.etree import ElementTree

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

from app.bench import ours, pillow_peer, run
from app.bench.harness import LIBRARIES, SHORT_CALLS, Result, run_workload, time_in_turn
from app.bench.records import Contender, Prepared, TypedPicture, UnavailableError, random_triangles
from app.bench.report import GOALS, SHARED_GOALS, Goal, foot_text, goal_of, result_text, this_machine
from app.bench.run import chart_svg, results_text
from app.bench.workloads import WORKLOADS, Workload

SMALL = Workload("B", "a few triangles", lambda: random_triangles(1, 40, (40, 30), 40.0))
"""Has the name of a workload with goals."""


def toy(name: str, prepare, less: str = "") -> ModuleType:
    """Return a library that draws whatever ``prepare`` says."""
    module = ModuleType(name)
    module.LIBRARY, module.DISTRIBUTION = name, "toy-that-is-not-installed"
    module.contender = lambda work: Contender(name, "compiled", prepare, less)
    return module


def black(_) -> Prepared:
    return Prepared(lambda: np.zeros((30, 40, 3), np.uint8), lambda: "draws nothing")


def absent(_) -> Prepared:
    raise ModuleNotFoundError("No module named 'absent'")


def broken(_) -> Prepared:
    raise UnavailableError("no picture\ntoday")


def forgetful(_) -> Prepared:
    """Draw once; later calls return the same memory without drawing."""
    pixels = np.full((30, 40, 3), 7, np.uint8)
    return Prepared(lambda: pixels)


def ignore(_: str) -> None:
    """Want no notes."""


@pytest.fixture(scope="module")
def result() -> Result:
    toys = [
        toy("black", black, "everything"),
        toy("absent", absent),
        toy("broken", broken),
        toy("forgetful", forgetful),
    ]
    return run_workload(SMALL, [ours, pillow_peer, *toys], 2, ignore)


def test_contenders_are_checked_and_timed(result: Result) -> None:
    entries = {entry.contender.library: entry for entry in result.entries}
    assert list(entries) == ["Rasterscope", "Pillow", "black"]
    assert result.ours is entries["Rasterscope"]
    assert entries["Rasterscope"].difference.is_none
    assert entries["black"].difference.covered == result.counts.pixels
    for entry in entries.values():
        times = entry.times
        assert 2 <= times.count <= 2 * SHORT_CALLS  # fewer where one takes long
        assert 0 < times.least <= times.lower_quartile <= times.median <= times.upper_quartile


def test_who_is_missing_is_told_with_the_reason(result: Result) -> None:
    reasons = {missing.library: missing.reason for missing in result.missing}
    assert reasons == {
        "absent": "not installed (No module named 'absent')",
        "broken": "no picture today",
        "forgetful": "while it was timed it drew another picture",
    }


def test_table_has_every_contender_and_what_it_does_less(result: Result) -> None:
    text = result_text(result)
    assert text.startswith("B  a few triangles: 40 x 30, 1,395 fragments, 40 primitives, ")
    for words in ("Rasterscope", "no depth, sorting not timed", "everything", "1.3", "did not take part"):
        assert words in text
    assert "black: toy-that-is-not-installed (not installed), draws nothing" in foot_text([result])


def test_csv_stands_alone(result: Result) -> None:
    rows = list(csv.DictReader(io.StringIO(results_text([result], this_machine(), 2))))
    assert len(rows) == 6
    by_library = {row["library"]: row for row in rows}
    pillow = by_library["Pillow"]
    ratio = float(pillow["median_ms"]) / float(by_library["Rasterscope"]["median_ms"])
    assert float(pillow["times_ours"]) == pytest.approx(ratio, rel=0.01)
    assert (pillow["prototype"], pillow["rounds"], pillow["fragments"]) == (
        "1.3",
        "2",
        str(result.counts.fragments),
    )
    assert by_library["broken"]["missing"] == "no picture today"


def test_benchmark_writes_table_and_chart(qtbot: QtBot, tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.setattr(run, "LIBRARIES", (ours, pillow_peer, toy("black", black, "everything")))
    assert run.run_benchmark([SMALL], 1, tmp_path) == 0
    assert "a few triangles" in capsys.readouterr().out
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "benchmark.csv",
        "benchmark.png",
        "benchmark.svg",
    ]
    drawing = ElementTree.parse(tmp_path / "benchmark.svg").getroot()
    words = [element.text for element in drawing.iter("{http://www.w3.org/2000/svg}text")]
    assert {"B", "a few triangles", "Pillow", "black"} <= set(words)
    assert (tmp_path / "benchmark.png").read_bytes().startswith(b"\x89PNG")


def test_a_wrong_picture_of_ours_is_an_error(capsys) -> None:
    wrong = toy("wrong", black)
    wrong.contender = lambda work: Contender("wrong", "ours", black)
    result = run_workload(SMALL, [wrong, pillow_peer], 1, ignore)
    assert run.verdict([result]) == 1
    drawing = chart_svg([result], this_machine())
    assert "did not draw the reference: B." in drawing
    assert "Pillow" not in drawing
    assert run.verdict([run_workload(SMALL, [toy("absent", absent)], 1, ignore)]) == 1
    assert capsys.readouterr().err == "Rasterscope did not draw the reference on: B\n" * 2


def test_calls_take_turns_and_the_collector_rests() -> None:
    order: list[str] = []
    collected: list[bool] = []

    def call(name: str):
        return lambda: (order.append(name), collected.append(gc.isenabled()))

    times = time_in_turn({"a": call("a"), "b": call("b")}, 2)
    runs = 1 + SHORT_CALLS
    assert order == ["a"] * runs + ["b"] * runs + ["b"] * runs + ["a"] * runs
    assert not any(collected)
    assert gc.isenabled()
    assert times["a"].count == 2 * SHORT_CALLS


@pytest.mark.parametrize("part", ["fill", "line", "shaders"])
def test_a_typed_text_draws_the_picture_of_the_rule(part: str) -> None:
    workload = Workload("text", "a text", lambda: TypedPicture(part, (40, 30)))
    result = run_workload(workload, LIBRARIES, 1, ignore)
    assert [entry.contender.library for entry in result.entries] == ["Rasterscope", "Edited text"]
    assert all(entry.difference.is_none for entry in result.entries)
    assert result.counts.fragments > 100
    assert not result.missing


def test_goals_name_workloads_and_libraries_that_there_are() -> None:
    names = {workload.name for workload in WORKLOADS}
    libraries = {library.LIBRARY for library in LIBRARIES}
    assert {workload for workload, _ in GOALS} <= names
    assert {library for _, library in GOALS} <= libraries


@pytest.mark.parametrize(("ratio", "verdict"), [(2.0, "goal"), (1.2, "prototype"), (1.0, "below")])
def test_verdict(ratio: float, verdict: str) -> None:
    assert Goal(2.0, (1.1, 1.4)).verdict(ratio) == verdict


def test_there_is_no_goal_against_a_graphics_card() -> None:
    assert goal_of("B", "OpenGL", "llvmpipe (LLVM 15)") == GOALS["B", "OpenGL"]
    assert goal_of("B", "OpenGL", "Some Card") is None


def test_two_processes_have_goals_of_their_own() -> None:
    assert goal_of("D", "OpenGL", "llvmpipe (LLVM 15)", is_shared=True) == SHARED_GOALS["D", "OpenGL"]
    assert goal_of("D", "OpenGL", "Some Card", is_shared=True) is None
    assert goal_of("D", "VTK", "", is_shared=True) is None
