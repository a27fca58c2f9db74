"""How the work on a picture was shared, and what the bands say about the whole picture."""

from collections.abc import Sequence
from dataclasses import astuple, dataclass, replace

from core.fast_path.record import Route, Split
from core.records.frame import StageCount
from core.stages.declared import GEOMETRY_STAGES


@dataclass(frozen=True)
class BandTime:
    """Rows that one process drew."""

    first: int
    end: int
    seconds: float


@dataclass(frozen=True)
class Sharing:
    """How the work on the last picture was shared."""

    bands: tuple[BandTime, ...] = ()
    """The first was drawn by this process, the others by workers; empty: this process drew all."""
    reason: str = ""
    """Why this process drew all."""
    gain: float = 0.0
    """Seconds that sharing was estimated to gain, from the picture before."""

    @property
    def process_count(self) -> int:
        """Processes that drew."""
        return max(len(self.bands), 1)


def joined_counts(statistics: Sequence[dict[str, StageCount]]) -> dict[str, StageCount]:
    """Return the statistics of a picture out of those of its bands, the first of which this process drew.

    Notes
    -----
    Counts are those of the whole picture. Seconds are those of this process: the others ran at the same time.
    """
    counts = {stage: replace(count) for stage, count in statistics[0].items()}
    for stage, count in counts.items():
        if stage not in GEOMETRY_STAGES:
            count.incoming = sum(part[stage].incoming for part in statistics)
            count.outgoing = sum(part[stage].outgoing for part in statistics)
    # Each band clips its own triangles; one that reaches into two is clipped, and counted, twice.
    added = sum(part["clip"].outgoing - part["clip"].incoming for part in statistics)
    counts["clip"].outgoing = counts["clip"].incoming + added
    counts["edges"].incoming = counts["edges"].outgoing = counts["bin"].incoming = counts["clip"].outgoing
    return counts


def have_colors_of_whole(routes: Sequence[Route], plain_colors: bool) -> bool:
    """Return whether bands have the colours that one process gives the whole picture.

    Parameters
    ----------
    routes : sequence of Route
        Of all bands.
    plain_colors : bool
        Whether they were asked for colours of attributes and light at every pixel.

    Notes
    -----
    Which triangles have bytes is decided for each alone. Of the other cheaper colours, which are right where all
    triangles allow them, a scene has one kind at most, by what its vertices carry: the whole picture has them if all of
    its bands do. One colour a triangle is the same bytes whichever way it is worked out.
    """
    if not all(route.allowed for route in routes):
        # Parts of a supersampled picture choose for themselves.
        shown = {route.color for route in routes if route.visible}
        return not plain_colors and len(shown - {"palette"}) <= 1
    allowed = {route.allowed for route in routes} - {"palette"}
    return "deferred" in allowed if plain_colors else len(allowed) <= 1


def joined_route(routes: Sequence[Route]) -> Route:
    """Return the route of a picture out of those of its bands; a triangle in two bands went its way twice."""
    # A band that shows nothing says nothing of the others.
    shown = [route for route in routes if route.visible] or routes
    # A band in which nothing is hidden needs no depth; the picture does where one of its bands does.
    needed = next((route for route in shown if route.visibility != "layer"), shown[0])
    color = next((route.color for route in shown if route.color != "palette"), needed.color)
    visible = sum(route.visible for route in routes)
    splits = [route.split for route in routes if route.split is not None]
    total = Split(*(sum(ways) for ways in zip(*map(astuple, splits), strict=True))) if splits else None
    return replace(needed, color=color, split=total, visible=visible)
