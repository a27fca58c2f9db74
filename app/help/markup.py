"""HTML of the pages of Help: escaped text, links, and words of the glossary as links."""

from collections.abc import Iterable
from dataclasses import dataclass
from html import escape

from lessons.glossary import find_terms


@dataclass(frozen=True)
class HelpPage:
    """One page."""

    title: str
    html: str
    """Its body, without the title."""


def link(address: str, text: str) -> str:
    """Return a link: ``help:`` shows another page, ``do:`` does something in the window."""
    return f'<a href="{escape(address)}">{escape(text)}</a>'


def linked(text: str, seen: set[str] | None = None) -> str:
    """Return plain text as HTML in which terms are links where they come first.

    ``seen``: keys of terms that get no link, with those that got one from now on.
    """
    parts, end, seen = [], 0, set() if seen is None else seen
    for first, last, term in find_terms(text):
        if term.key not in seen:
            seen.add(term.key)
            parts += [escape(text[end:first]), link(f"help:term/{term.key}", text[first:last])]
            end = last
    return "".join([*parts, escape(text[end:])])


def bullets(items: Iterable[str]) -> str:
    """Return pieces of HTML as a list; nothing if there are none."""
    rows = "".join(f"<li>{item}</li>" for item in items)
    return f"<ul>{rows}</ul>" if rows else ""


def facts(rows: Iterable[tuple[str, str]]) -> str:
    """Return names with pieces of HTML, one a paragraph as the pane may be narrow, without those that say nothing."""
    return "".join(f"<p><b>{escape(name)}</b>: {said}</p>" for name, said in rows if said)


def sentence(text: str) -> str:
    """Return words of the methods table as a sentence."""
    return f"{text[:1].upper()}{text[1:]}{'' if text.endswith('.') else '.'}"
