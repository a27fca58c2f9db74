"""Kept attributes: computed once, without holding up other instances."""

from dataclasses import dataclass
from threading import Event, Thread

import pytest

from core.records.arrays import cached_property

LONG = 30.0
"""Seconds; nobody waits that long if nothing is wrong."""


@dataclass(frozen=True, eq=False)
class Record:
    started: Event
    may_end: Event

    @cached_property
    def answer(self) -> object:
        """What is asked for."""
        self.started.set()
        assert self.may_end.wait(LONG)
        return object()


class Other(Record):
    @cached_property
    def answer(self) -> object:
        """What is asked for, again."""
        return [super().answer]


def ready() -> tuple[Event, Event]:
    may_end = Event()
    may_end.set()
    return Event(), may_end


def test_it_is_computed_once() -> None:
    record = Record(*ready())
    assert record.answer is record.answer
    assert vars(record)["answer"] is record.answer


def test_what_a_subclass_computes_stays() -> None:
    record = Other(*ready())
    assert isinstance(record.answer, list)
    assert record.answer is record.answer


def test_what_fails_is_computed_again() -> None:
    tries = []

    class Failing:
        @cached_property
        def answer(self) -> int:
            tries.append(len(tries))
            if len(tries) < 2:
                raise ValueError("not yet")
            return 5

    failing = Failing()
    with pytest.raises(ValueError, match="not yet"):
        _ = failing.answer
    assert failing.answer == 5


def test_another_instance_does_not_wait() -> None:
    slow = Record(Event(), Event())
    thread = Thread(target=lambda: slow.answer)
    thread.start()
    try:
        assert slow.started.wait(LONG)
        other = Record(*ready())
        asked = Thread(target=lambda: other.answer, daemon=True)
        asked.start()
        asked.join(LONG / 3)
        assert not asked.is_alive()
    finally:
        slow.may_end.set()
        thread.join()


def test_the_class_has_the_words() -> None:
    assert Record.answer.__doc__ == "What is asked for."
