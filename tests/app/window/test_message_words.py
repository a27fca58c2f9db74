"""Messages from parts that others say: capitals and full stops."""

import pytest

from core.records.words import sentence_case, sentences


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("nothing is there", "Nothing is there"),
        ("teapot.obj has no faces", "teapot.obj has no faces"),
        ("bad.obj, line 3: a face names vertex 9", "bad.obj, line 3: a face names vertex 9"),
        ("stopped. It went on", "Stopped. It went on"),
        ("w is 0 at a corner", "w is 0 at a corner"),
        ("", ""),
    ],
)
def test_a_sentence_begins_with_a_capital_but_a_name_stays_as_it_is(text: str, shown: str) -> None:
    assert sentence_case(text) == shown


def test_sentences_are_kept_apart() -> None:
    assert sentences(ValueError("no faces"), "The scene stays") == "no faces. The scene stays."
    assert sentences("Why?", "It is so.") == "Why? It is so."
    assert sentences("", "It is so") == "It is so."
