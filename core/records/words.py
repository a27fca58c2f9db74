"""How sentences are put together: counts and lists, where a sentence begins, and what is drawn by its name."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

# Counts and lists as sentences write them.


def joined(words: Sequence[str]) -> str:
    """Join words as speech does: ``a``, ``a and b``, ``a, b and c``."""
    if len(words) < 2:
        return "".join(words)
    return f"{', '.join(words[:-1])} and {words[-1]}"


def noun_of(count: int, noun: str, plural: str = "") -> str:
    """Return the noun that follows a count: ``pixel`` or ``pixels``."""
    return noun if count == 1 else plural or f"{noun}s"


def counted(count: int, noun: str, plural: str = "") -> str:
    """Write a count and its noun: ``1 pixel``, ``2 pixels``."""
    return f"{count:,} {noun_of(count, noun, plural)}"


def piece_name(one: str, number: int, piece: int) -> str:
    """Return what a piece is called: ``triangle 1`` as a whole (0), or ``piece 2 of triangle 1``."""
    return f"piece {piece} of {one} {number}" if piece > 0 else f"{one} {number}"


def numbered(noun: str, numbers: Sequence[int]) -> str:
    """Write a noun and the numbers of what it means: ``edge 0``, ``edges 0 and 2``."""
    return f"{noun_of(len(numbers), noun)} {joined([str(number) for number in numbers])}"


# How messages are put together from what others say: where a sentence begins with a capital and where it
# ends.


ENDS = (".", "!", "?", "…")
"""What a sentence ends with."""


def capitalized(text: str) -> str:
    """Return a text that a sentence begins with."""
    return text[:1].upper() + text[1:]


def sentence_case(text: str) -> str:
    """Return a text with a capital at its beginning, unless it begins with a symbol or the name of a file.

    ``nothing is there`` becomes ``Nothing is there``; ``E0 is 3`` and ``teapot.obj has no faces`` stay as they are,
    since a name that is written otherwise is another name.
    """
    first = text.partition(" ")[0]
    is_symbol = len(first) < 3
    is_file_name = "." in first.rstrip(".,;:")
    return text if is_symbol or is_file_name else text[:1].upper() + text[1:]


def sentences(*parts: object) -> str:
    """Return parts as sentences that follow each other, each with a full stop where it has no end of its own."""
    texts = [str(part).strip() for part in parts]
    return " ".join(text if text.endswith(ENDS) else f"{text}." for text in texts if text)


# What is drawn has a name: triangles, segments, points, polygons, and patches of fragments, by their
# corners.


@dataclass(frozen=True)
class Nouns:
    """What sentences call a primitive and its parts."""

    one: str = "triangle"
    edge: str = "edge"
    """What a line belongs to."""
    corner: str = "corner"
    vertex: str = "vertex"
    vertices: str = "vertices"
    all_vertices: str = "all vertices are"
    three_vertices: str = "all three vertices are"

    @property
    def many(self) -> str:
        """Several of them."""
        return f"{self.one}{'es' if self.one == 'patch' else 's'}"

    @property
    def a_corner(self) -> str:
        """One of its corners."""
        return f"an {self.corner}" if self.corner == "end" else f"a {self.corner}"

    @property
    def a_vertex(self) -> str:
        """One of its vertices."""
        return f"an {self.vertex}" if self.vertex == "end" else f"a {self.vertex}"

    def text(self, template: str) -> str:
        """Return a text with what is drawn at ``{one}``, ``{many}``, ``{a_corner}`` ...; ``{One}`` has a capital."""
        names = (
            *("one", "many", "edge", "corner", "a_corner", "vertex", "a_vertex"),
            *("vertices", "three_vertices"),
        )
        words = {name: getattr(self, name) for name in names}
        return template.format(
            **words, **{name.capitalize(): word.capitalize() for name, word in words.items()}
        )


TRIANGLES = Nouns()
POLYGONS = Nouns("polygon", three_vertices="all vertices are")
POLYGON = 4
"""Polygons of so many corners and more have the same words."""
_NOUNS = {
    0: Nouns("patch"),
    1: Nouns("point", "point", "position", "position", "positions", *["it is"] * 2),
    2: Nouns("segment", "segment", "end", "end", "ends", *["both ends are"] * 2),
    3: TRIANGLES,
}


def nouns(corner_count: int) -> Nouns:
    """Return the names of primitives of so many corners."""
    return _NOUNS.get(corner_count, POLYGONS)


def has_words(words: Iterable[str], *texts: str) -> bool:
    """Return whether each word that is looked for, in small letters, stands in one of the texts."""
    found = " ".join(texts).casefold()
    return all(word in found for word in words)
