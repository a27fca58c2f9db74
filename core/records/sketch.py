"""Points and outlines in a plane or in space: what somebody would sketch beside a question."""

from dataclasses import dataclass

Place = tuple[float, ...]
"""x and y, and z in space."""
LEAST_REACH = 4.0


@dataclass(frozen=True)
class Sketch:
    """A plane with both axes, x to the right and y up; or space, with z towards the viewer."""

    points: tuple[tuple[str, Place], ...] = ()
    """Each with its name."""
    outlines: tuple[tuple[Place, ...], ...] = ()
    """Closed; of two places, a segment."""

    @property
    def is_space(self) -> bool:
        """Whether the places have a z."""
        return any(len(place) == 3 for _, place in self.points)

    @property
    def reach(self) -> float:
        """How far the farthest coordinate is from an axis; in a plane at least as far as questions like to go."""
        places = [place for _, place in self.points] + [
            place for outline in self.outlines for place in outline
        ]
        return max([1.0 if self.is_space else LEAST_REACH, *(abs(c) for place in places for c in place)])

    def with_point(self, name: str, place: Place) -> "Sketch":
        """Return the sketch with one more point."""
        return Sketch((*self.points, (name, place)), self.outlines)

    @property
    def text(self) -> str:
        """What is drawn, in words."""
        said = [f"{name} at {_text(place)}" for name, place in self.points]
        said += [" to ".join(map(_text, outline)) for outline in self.outlines]
        return "; ".join(["space with three axes" if self.is_space else "a plane with both axes", *said])


def _text(place: Place) -> str:
    return f"({', '.join(f'{c:.4g}' for c in place)})"
