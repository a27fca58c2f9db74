"""Texts that users see are plain English: phrases that read as translated are kept out (words.md)."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

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
DOCSTRING = re.compile(r"""(?<=[\w.:)\]}])\s*\n[ ]*r?\"{3}.*?\"{3}[ ]*$""", re.DOTALL | re.MULTILINE)
"""A text that is a statement of its own, after whatever may end a statement but a text."""


def literals() -> Iterator[tuple[str, str]]:
    """Yield the place and the text of literals that are no docstrings, of files in which anything is banned."""
    for path in sorted(path for place in PLACES for path in (ROOT / place).rglob("*.py")):
        source = path.read_text(encoding="utf-8")
        if not BANNED.search(BETWEEN_PARTS.sub("", DOCSTRING.sub("\n", source))):
            continue  # To parse every file takes ten times as long.
        docstrings = set()
        for node in ast.walk(ast.parse(source)):  # a statement comes before what it consists of
            if isinstance(node, ast.Expr):
                docstrings.add(id(node.value))
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
