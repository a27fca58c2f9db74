"""Texts that users see are plain English: phrases that read as translated are kept out (words.md)."""

import ast
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
PLACES = ("app", "core", "lessons", "widgets")
BANNED = re.compile(
    r"\b(the one that|lets? go of|for what it is owed|in the place of|by what|goes? no further than|many a|says so"
    r"|(?<![.`/])told(?=[ ,;.])"
    r"|as (it|they) (is|was|are|were)(?= (seen|given)|[.,;)]|$)|where it stands|what there is|a little more|may stay"
    r"|how manieth|very settings|is wanted"
    r"|looked at|by now|of before|handed on|with the shares|is no number|gets, gives)\b",
    re.IGNORECASE,
)
"""What no text says where it is not meant literally."""
FAULTS = re.compile(
    r", the nearest is\b|\bhands on\b|\bwhich sign has\b|\barrows go, space\b|\bearn points, less\b"
    r"|\bdrawn divided by\b|\bshows as a line with\b|\bstill nearest to the line\b|\bone row or block\b|\bq over p\b",
    re.IGNORECASE,
)
"""Faults of English that were found on the screen."""
VERB = (
    r"(?:is|are|was|were|has|have|needs|lies|does|goes|runs|shows|stays|keeps|draws|covers|may|can|must|will)"
)
SPLICED = re.compile(rf", (?:it|they|this|he|she|you|the \w+) {VERB}\b")
SPLICE = re.compile(rf"(?:^|[.:;?!]\s|\n)([^.:;?!,\n]*?\b{VERB}\b[^.:;?!\n]*?){SPLICED.pattern}")
"""Two main clauses with only a comma between them, unless a word of `JOINS` stands before it."""
JOINS = re.compile(
    r"\b(?:if|where|as|since|when|while|with|after|before|because|unless|once|until|although|though|without|whatever"
    r"|whichever|wherever|whether|so|and|but|or|that|which|who|what|how|than|for|farther)\b",
    re.IGNORECASE,
)
BETWEEN_PARTS = re.compile(r"""["'](\s*(#.*)?\n)?\s*[rRfF]?["']""")
"""Where one part of a literal ends and the next begins."""
DOCSTRING = re.compile(r"""(?<=[\w.:)\]}])\s*\n[ ]*r?\"{3}.*?\"{3}[ ]*$""", re.DOTALL | re.MULTILINE)
"""A text that is a statement of its own, after whatever may end a statement but a text."""


def faults(text: str) -> list[str]:
    """Return what is no English in a text: known faults and comma splices."""
    spliced = [found[0] for found in SPLICE.finditer(text) if not JOINS.search(found[1])]
    return [*FAULTS.findall(text), *spliced]


def literals() -> Iterator[tuple[str, str]]:
    """Yield the place and the text of literals that are no docstrings, of files that may have what none should."""
    # In small letters, and without \b before them: else a pattern is tried at every character.
    patterns = (BANNED.pattern, FAULTS.pattern.replace(r"\b", ""), SPLICED.pattern)
    assert "".join(patterns).islower()
    suspicious = [re.compile(pattern) for pattern in patterns]
    for path in sorted(path for place in PLACES for path in (ROOT / place).rglob("*.py")):
        source = path.read_text(encoding="utf-8")
        text = BETWEEN_PARTS.sub("", DOCSTRING.sub("\n", source)).lower()
        if not any(each.search(text) for each in suspicious):
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


def test_no_literal_has_a_banned_phrase_a_comma_splice_or_another_fault() -> None:
    found = {place: [*faults(text), *map(str, BANNED.findall(text))] for place, text in literals()}
    assert {place: said for place, said in found.items() if said} == {}


def strings(value: object) -> Iterator[str]:
    """Yield the texts of a TOML value."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict | list):
        for each in value.values() if isinstance(value, dict) else value:
            yield from strings(each)


def test_no_toml_text_has_a_fault_or_a_banned_phrase() -> None:
    found = {}
    for path in sorted(path for place in PLACES for path in (ROOT / place).rglob("*.toml")):
        for text in strings(tomllib.loads(path.read_text(encoding="utf-8"))):
            # An exercise with another text is another question: its answers could not be judged again.
            banned = [] if "templates" in path.parts else [match[0] for match in BANNED.finditer(text)]
            if said := [*faults(text), *banned]:
                found[f"{path.relative_to(ROOT)}: {text[:60]}"] = said
    assert found == {}


def test_faults_are_found() -> None:
    assert faults("It is inside all three edges, the nearest is edge 1.")
    assert faults("A face needs 3 corners, it has 2.")
    assert not faults("Where w is below 0, it is mirrored.")
    assert not faults("It is 3 px from the nearest, edge 1.")
