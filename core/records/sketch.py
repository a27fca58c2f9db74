"""Points and outlines in a plane: what somebody would sketch beside a question about matrices."""

from dataclasses import dataclass

Place = tuple[float, float]
"""x and y."""
LEAST_REACH = 4.0


@dataclass(frozen=True)
class Sketch:
    """A plane with both axes, x to the right and y up."""

    points: tuple[tuple[str, Place], ...] = ()
    """Each with its name."""
    outlines: tuple[tuple[Place, ...], ...] = ()
    """Closed; of two places, a segment."""

    @property
    def reach(self) -> float:
        """How far the farthest coordinate is from an axis; at least as far as questions like to go."""
        places = [place for _, place in self.points] + [
            place for outline in self.outlines for place in outline
        ]
        return max([LEAST_REACH, *(abs(c) for place in places for c in place)])

    def with_point(self, name: str, place: Place) -> "Sketch":
        """Return the sketch with one more point."""
        return Sketch((*self.points, (name, place)), self.outlines)

    @property
    def text(self) -> str:
        """What is drawn, in words."""
        said = [f"{name} at ({x:.4g}, {y:.4g})" for name, (x, y) in self.points]
        said += [" to ".join(f"({x:.4g}, {y:.4g})" for x, y in outline) for outline in self.outlines]
        return "; ".join(["a plane with both axes", *said])
