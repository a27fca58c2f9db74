"""What is drawn has a name: triangles, segments, points, polygons, and patches of fragments, by their corners."""

from dataclasses import dataclass


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
            "one",
            "many",
            "edge",
            "corner",
            "a_corner",
            "vertex",
            "a_vertex",
            "vertices",
            "three_vertices",
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
