"""Explanations are plain English: none has a phrase that reads as translated."""

from collections.abc import Iterator

from core import STAGES
from core.explain.stage_texts import initial_sentence, stage_card
from core.explain.steps import question
from core.methods import table
from core.settings import families
from tests.core.explain.explained_steps import all_said, fewest_traces
from tests.test_plain_words import BANNED, faults


def explanations() -> Iterator[str]:
    """Yield the texts of steps, stages and methods, put together."""
    for _, text, _, _, found in all_said():
        yield text
        yield from (variable.meaning for variable in found)
    for traced in fewest_traces():
        for name in STAGES:
            stage = traced.stage(name)
            asked = question(stage, stage.steps.row_count // 2) if stage.steps.row_count else None
            yield from (asked.text, asked.reveal) if asked is not None else ()
    for name in STAGES:
        card = stage_card(name)
        yield from (initial_sentence(name), card.title, card.gets, card.gives, card.purpose)
    for family in families():
        for name in table.names(family):
            method = table.get(family, name)
            yield from (method.title, method.exact_for, method.breaks_where)


def test_no_explanation_has_a_banned_phrase() -> None:
    assert {text for text in {*explanations()} if BANNED.search(text) or faults(text)} == set()
