"""Times that hold on a busy machine: intervals, who is told apart, rounds until the order is stable. No real clock."""

from collections.abc import Callable, Iterator
from itertools import combinations, count

import numpy as np
import pytest

from core.settings import Settings
from core.study import record, speed_accuracy
from core.study.family import Assignment, Candidate, StudyFamily, Task
from core.study.speed_accuracy import measure
from tests.core.study.accuracy.order_agreement import kendall_tau

NAMES = ("last-drawn", "painters", "z-buffer", "ray-casting")
WRONG = record.ErrorMeasure("wrong", "Wrong", "")


def point(name: str, seconds: list[float], wrong: float = 0.0) -> record.Point:
    return record.Point(name, name, np.array(seconds), 1, {}, {"wrong": wrong})


class FakeTask(Task):
    """Work whose blocks take what a function of the method and the block's number says."""

    unit_count = 1

    def __init__(self, seconds: Callable[[str, int], float]) -> None:
        self._seconds = seconds
        self._runs: dict[str, Iterator[int]] = {name: count(-1) for name in NAMES}

    def start(self, settings: Settings) -> Callable[[], str]:
        return lambda: settings.visibility

    def seconds(self, made: str, elapsed: float) -> float:
        return self._seconds(made, next(self._runs[made]))

    def counts(self, settings: Settings, made: str) -> dict[str, int]:
        return {}

    def judge(self, settings: Settings, made: str) -> record.Judgement:
        return record.judged({"wrong": 0.0})

    def pictures(self, settings: Settings, made: str):
        raise NotImplementedError


def timed(monkeypatch: pytest.MonkeyPatch, seconds: Callable[[str, int], float], **options) -> record.Study:
    """Measure four methods whose blocks take the seconds of a function."""

    class Four(StudyFamily):
        def candidates(self, base: Settings) -> tuple[Candidate, ...]:
            return tuple(Candidate(f"visibility={name}", name) for name in NAMES)

    kind = record.WorkKind("work", "Work", "frame")

    def make(assignment: Assignment) -> FakeTask:
        return FakeTask(seconds)

    monkeypatch.setattr(
        speed_accuracy, "study_family", lambda _: Four("four", "Four", (), (kind,), (WRONG,), make)
    )
    monkeypatch.setattr("core.study.family.BLOCK", 0.0)  # One run is a block.
    return measure("four", **options)


def true_time(name: str) -> float:
    return 0.001 * 1.5 ** NAMES.index(name)


def test_an_interval_of_the_median_leaves_out_as_many_runs_as_chance_allows() -> None:
    # The true median lies outside the second and the eighth of nine runs with chance 2 (1 + 9) / 2^9 = 0.039.
    assert record.median_interval(np.arange(9.0)) == (1, 7)
    assert record.median_interval(np.arange(6.0)) == (0, 5)
    assert record.median_interval(np.arange(3.0)) == (0, 2)
    low, high = record.median_interval(np.arange(100.0))
    assert (low, high) == (39, 60)


def test_methods_share_ranks_where_intervals_overlap() -> None:
    fast, slow = point("fast", [1.0] * 9), point("slow", [2.0] * 9)
    wide = point("wide", [1.05, 1.1, 1.2, 1.3, 1.5, 1.8, 2.0, 2.1, 2.2])
    assert record.ranks((slow, fast)) == {"fast": (1, 1), "slow": (2, 2)}
    assert record.ranks((slow, fast, wide)) == {"fast": (1, 1), "wide": (2, 3), "slow": (2, 3)}


def test_few_runs_tell_only_large_differences_apart() -> None:
    assert record.ranks((point("a", [1.0]), point("b", [1.25]))) == {"a": (1, 2), "b": (1, 2)}
    assert record.ranks((point("a", [1.0]), point("b", [1.4]))) == {"a": (1, 1), "b": (2, 2)}


def test_the_front_does_not_part_what_is_not_told_apart() -> None:
    blurred = [1.0, 1.1, 1.2, 1.3, 1.5, 1.8, 2.0, 2.1, 2.2]
    exact, rough = point("exact", blurred, 0.0), point("rough", [value * 0.99 for value in blurred], 5.0)
    # A hair faster in the median, but not for sure, and worse: no reason to take it.
    assert record.pareto_front((rough, exact), "wrong") == (exact,)
    surely = point("surely", [0.1] * 9, 5.0)
    assert record.pareto_front((surely, rough, exact), "wrong") == (surely, exact)


def test_steady_times_take_no_more_than_the_rounds(monkeypatch: pytest.MonkeyPatch) -> None:
    study = timed(monkeypatch, lambda name, _: true_time(name), rounds=9)
    assert [len(each.seconds) for each in study.points] == [9] * 4
    assert list(record.ranks(study.points).values()) == [(1, 1), (2, 2), (3, 3), (4, 4)]


def busy(name: str, block: int) -> float:
    """Return the time beside a process that takes the processor in the first blocks of two methods."""
    is_hit = block < 6 and name in ("last-drawn", "z-buffer")
    return true_time(name) * (3.0 if is_hit else 1.0 + 0.01 * (block % 3))


def test_a_busy_machine_takes_more_rounds_and_ends_in_the_same_order(monkeypatch: pytest.MonkeyPatch) -> None:
    quiet = timed(monkeypatch, lambda name, _: true_time(name), rounds=9)
    fractions: list[float] = []
    loud = timed(monkeypatch, busy, rounds=9, progress=lambda fraction, _: fractions.append(fraction))
    assert all(len(each.seconds) > 9 for each in loud.points)
    assert fractions == sorted(fractions)
    assert record.ranks(loud.points) == record.ranks(quiet.points)
    assert kendall_tau(quiet.points, loud.points) == 1
    assert [each.least for each in loud.points] == [each.least for each in quiet.points]


def test_an_order_that_never_settles_is_left_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    def wild(name: str, block: int) -> float:
        number = NAMES.index(name)
        return 0.001 * float(np.random.default_rng([number, block + 1]).lognormal(0.5 * number, 2.0))

    study = timed(monkeypatch, wild, rounds=9)
    assert {len(each.seconds) for each in study.points} == {9 * speed_accuracy.MOST_TIMES}
    assert max(last - first for first, last in record.ranks(study.points).values()) > 0


def test_few_rounds_are_not_extended(monkeypatch: pytest.MonkeyPatch) -> None:
    study = timed(monkeypatch, busy, rounds=3)
    assert [len(each.seconds) for each in study.points] == [3] * 4


def test_agreement_counts_only_pairs_that_are_apart_in_both_runs() -> None:
    first = tuple(point(name, [true_time(name)] * 9) for name in NAMES)
    assert kendall_tau(first, first) == 1
    backwards = tuple(
        point(name, [true_time(other)] * 9) for name, other in zip(NAMES, NAMES[::-1], strict=True)
    )
    assert kendall_tau(first, backwards) == -1
    swapped = (point(NAMES[0], [true_time(NAMES[1])] * 9), point(NAMES[1], [true_time(NAMES[0])] * 9))
    pairs = len(list(combinations(NAMES, 2)))
    assert kendall_tau(first, swapped + first[2:]) == pytest.approx((pairs - 2) / pairs)
    vague = tuple(point(name, [true_time(name), 0.0001, 0.1] * 3) for name in NAMES)
    assert np.isnan(kendall_tau(first, vague))


def test_the_study_notes_how_busy_the_machine_was(monkeypatch: pytest.MonkeyPatch) -> None:
    study = timed(monkeypatch, lambda name, _: true_time(name), rounds=1, machine={"processor": "P"})
    assert study.machine["processor"] == "P"
    assert "processor" in study.machine["load"]
