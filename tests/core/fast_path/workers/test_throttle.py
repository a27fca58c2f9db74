"""Sharing goes on for as long as it is faster, and is tried again after a while where it is not."""

from dataclasses import replace

from core.fast_path.workers.sharing import ALONE_FOR, EVIDENCE, Load, Pace

LOAD = Load(1000, 1_000_000, 600_000, 600_000)
HEAVY = replace(LOAD, color="deferred")


def run(pace: Pace, pictures: int, alone: float, shared: float, load: Load = LOAD) -> list[bool]:
    """Return which pictures were shared."""
    chosen = []
    for _ in range(pictures):
        chosen.append(pace.may_share)
        if chosen[-1]:
            pace.shared(shared, load)
        else:
            pace.alone(alone, load)
    return chosen


def test_after_a_few_pictures_alone_sharing_goes_on_while_it_is_faster() -> None:
    assert run(Pace(), 300, 0.02, 0.012) == [False] * EVIDENCE + [True] * (300 - EVIDENCE)


def test_where_sharing_is_slower_it_is_tried_less_and_less() -> None:
    chosen = run(Pace(), 2000, 0.02, 0.03)
    assert chosen[EVIDENCE : 2 * EVIDENCE] == [True] * EVIDENCE
    assert chosen[2 * EVIDENCE : 2 * EVIDENCE + ALONE_FOR] == [False] * ALONE_FOR
    assert chosen[2 * EVIDENCE + ALONE_FOR]
    assert sum(chosen) <= 8 * EVIDENCE


def test_sharing_comes_back_when_the_other_core_is_free_again() -> None:
    pace = Pace()
    run(pace, 60, 0.02, 0.03)
    assert run(pace, 200, 0.02, 0.012)[-1]


def test_sharing_ends_when_the_other_core_gets_work() -> None:
    pace = Pace()
    assert run(pace, 50, 0.02, 0.012)[-1]
    chosen = run(pace, 2 * EVIDENCE, 0.02, 0.03)
    assert not chosen[-1]


def test_one_slow_picture_is_no_reason() -> None:
    pace = Pace()
    run(pace, 50, 0.02, 0.012)
    assert all(run(pace, 2, 0.02, 0.5) + run(pace, 20, 0.02, 0.012))


def test_pictures_of_another_kind_are_timed_anew() -> None:
    pace = Pace()
    run(pace, 20, 0.02, 0.012)
    chosen = run(pace, 20, 0.08, 0.05, HEAVY)
    assert chosen[0]
    assert chosen[1 : 1 + EVIDENCE] == [False] * EVIDENCE
    assert chosen[-1]
