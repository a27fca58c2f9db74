"""The best size of blocks is found by experiment: the fastest of those measured, and those not told apart from it."""

from dataclasses import replace

import numpy as np

from app.pages.compare.charts import growth_of, numbers_of
from app.pages.words import best_sentences, with_unit
from core.study.families import study_family
from core.study.record import Point, Study, best_values
from tests.core.study.accuracy.untimed_runs import run

WORK = study_family("fill").work("block-size")


def timed(method: str, title: str, seconds: float) -> Point:
    return Point(method, title, seconds * np.linspace(1.0, 1.01, 9), unit_count=1)


def measured() -> Study:
    """Return a study in which blocks are fastest at 8, hardly slower at 16, and boxes do not care."""
    times = {2: 4.0, 4: 2.0, 8: 1.0, 16: 1.002, 32: 3.0}
    growth = {
        value: (timed("fill=blocks", "Blocks", time), timed("fill=bounding-box", "Box", 2.0))
        for value, time in times.items()
    }
    return Study(
        *("fill", "Fills", WORK, {"block-size": 8.0, "size": 64.0}, 0, study_family("fill").measures),
        *(growth[8], growth),
    )


def test_the_best_size_is_the_fastest_and_equals_are_named() -> None:
    (best,) = best_values(measured())
    assert (best.method, best.value, best.others) == ("fill=blocks", 8, (16,))
    assert best_sentences(measured()) == [
        "Blocks: fastest at block size 8 pixels; the difference at 16 is within the noise.",
        "This depends on the machine, and on the size of the triangles.",
    ]


def test_a_unit_that_is_a_fraction_takes_the_number_above_it() -> None:
    assert [with_unit("8", unit) for unit in ("", "pixels", "1/16 px")] == ["8", "8 pixels", "8/16 px"]


def test_the_chart_marks_it() -> None:
    study = measured()
    found = growth_of(study, "time", numbers_of(study.points))
    assert [(series.key, series.best) for series in found.series] == [
        ("fill=blocks", 2),
        ("fill=bounding-box", -1),
    ]


def test_other_works_have_no_best_value() -> None:
    assert best_values(replace(measured(), work=study_family("fill").work("triangles"))) == ()


def test_the_dial_turns_the_size_of_the_blocks() -> None:
    only = {"fill=blocks", "fill=bounding-box"}
    small, large = (run("fill", "block-size", only=only, **{"block-size": n}) for n in (2, 64))
    assert small["blocks"].counts["blocks tested"] > 10 * large["blocks"].counts["blocks tested"]
    assert small["blocks"].counts["pixels tested"] < large["blocks"].counts["pixels tested"]
    assert small["bounding-box"].counts == large["bounding-box"].counts
    assert small["blocks"].errors["misclassified"] == large["blocks"].errors["misclassified"] == 0
