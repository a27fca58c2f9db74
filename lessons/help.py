"""Help: the terms of the field in plain English, where they stand in a text, and guides with links that do it."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

# The glossary: the terms of the field in plain English, and where they stand in a text.


FOLDER = Path(__file__).with_name("help")
"""The texts of the guide and of the glossary."""


@dataclass(frozen=True)
class Term:
    """One entry."""

    name: str
    text: str
    """One to three sentences."""
    also: tuple[str, ...] = ()
    """Other spellings and short forms; one with a capital is only meant where it is spelled so."""

    @property
    def key(self) -> str:
        """Its name in an address, as ``depth-buffer``."""
        return re.sub(r"\W+", "-", self.name.lower()).strip("-")


@cache
def glossary() -> Mapping[str, Term]:
    """Return all terms by key, in alphabetical order."""
    import tomllib  # Not before a term is asked for: the window opens sooner.

    rows = tomllib.loads((FOLDER / "glossary.toml").read_text(encoding="utf-8"))["term"]
    found = [Term(row["name"], row["text"], tuple(row.get("also", ()))) for row in rows]
    return {term.key: term for term in sorted(found, key=lambda term: term.name.lower())}


@cache
def _forms() -> tuple[Mapping[str, Term], re.Pattern[str]]:
    """Return the term of every form, and a pattern that finds the longest form at a place, also in the plural."""
    forms = {form: term for term in glossary().values() for form in (term.name, *term.also)}
    longest_first = sorted(forms, key=len, reverse=True)
    parts = [re.escape(form) if form != form.lower() else f"(?i:{re.escape(form)})" for form in longest_first]
    return forms, re.compile(rf"(?<![\w-])({'|'.join(parts)})(?:s|es)?(?![\w-])")


def find_terms(text: str) -> Iterator[tuple[int, int, Term]]:
    """Yield the terms of a text in order: first and end character, and the term."""
    forms, pattern = _forms()
    for match in pattern.finditer(text):
        form = match[1]
        yield match.start(), match.end(), forms.get(form) or forms[form.lower()]


# The guides of Help: what to do, step by step, with links that do it.


@dataclass(frozen=True)
class GuideStep:
    """One step."""

    title: str
    text: str
    """``{name}`` stands for the key of an action."""
    links: Mapping[str, str]
    """What the step runs, as ``do:stage/raster``, by what the link says."""
    listing: str = ""
    """A file that the step shows; empty: none."""


@cache
def guide(name: str = "guide") -> tuple[GuideStep, ...]:
    """Return the steps of a guide in order: the one of five minutes, ``change_line`` or ``own_exercise``."""
    import tomllib  # As the glossary.

    def text(file: str) -> str:
        return (FOLDER / file).read_text(encoding="utf-8")

    return tuple(
        GuideStep(row["title"], row["text"], row["links"], text(row["file"]) if "file" in row else "")
        for row in tomllib.loads(text(f"{name}.toml"))["step"]
    )
