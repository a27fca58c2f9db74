"""Texts that users see are plain English: phrases that read as translated are kept out (words.md)."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

from core import STAGES
from core.explain import account, initial_sentence, question, stage_card, variables
from core.methods import table
from core.settings import families
from tests.core.explain.explained_steps import all_steps, traces

ROOT = Path(__file__).parents[1]
PLACES = ("app", "core", "lessons", "widgets")
BANNED = re.compile(
    r"\b(the one that|lets? go of|for what it is owed|in the place of|by what|goes? no further than|many a|told|says so"
    r"|as (it|they) (is|was|are|were)(?= (seen|given)|[.,;)]|$)|where it stands|what there is|a little more|may stay"
    r"|how manieth|very settings|is wanted"
    r"|looked at|by now|of before|handed on|with the shares|is no number|gets, gives)\b",
    re.IGNORECASE,
)
"""What no text says where it is not meant literally."""
BETWEEN_PARTS = re.compile(r"""["'](\s*(#.*)?\n)?\s*[rRfF]?["']""")
"""Where one part of a literal ends and the next begins."""


def literals() -> Iterator[tuple[str, str]]:
    """Yield the place and the text of literals that are no docstrings, of files in which anything is banned."""
    for path in sorted(path for place in PLACES for path in (ROOT / place).rglob("*.py")):
        source = path.read_text(encoding="utf-8")
        if not BANNED.search(BETWEEN_PARTS.sub("", source)):
            continue  # To parse every file takes ten times as long.
        tree = ast.parse(source)
        docstrings = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
        for node in ast.walk(tree):
            if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docstrings:
                yield f"{path.relative_to(ROOT)}:{node.lineno}", node.value


def documents() -> Iterator[tuple[str, str]]:
    """Yield the place and the text of every line of the documents outside their diffs."""
    for path in (ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").glob("*.md"))):
        text = re.sub(
            r"^```diff$.*?^```$", lambda diff: "\n" * diff[0].count("\n"), path.read_text(), flags=re.M | re.S
        )
        for number, line in enumerate(text.splitlines(), 1):
            yield f"{path.relative_to(ROOT)}:{number}", line


def test_no_document_has_a_banned_phrase() -> None:
    assert {place: line for place, line in documents() if BANNED.search(line)} == {}


def test_no_literal_has_a_banned_phrase() -> None:
    found = {place: text for place, text in literals() if BANNED.search(text)}
    assert found == {}


def explanations() -> Iterator[str]:
    """Yield the texts of steps, stages and methods, put together."""
    for explanation, triangle, pixel in all_steps()[::3]:
        yield account(explanation, triangle, pixel)[0]
        yield from (variable.meaning for variable in variables(explanation))
    for traced in (*traces()["scenes"][::5], *traces()["rare"][::5]):
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
    assert {text for text in explanations() if BANNED.search(text)} == set()
