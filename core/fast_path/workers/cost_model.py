"""Whether more than one process is worth it: estimated from what the last picture held."""

from dataclasses import dataclass

from core.fast_path.record import Coloring, Picture, Visibility

TRIANGLE, PIXEL = 60e-9, 1e-9
"""Seconds for a triangle that is drawn, and for a pixel that is cleared and shown; measured on one core, as all that
follow, to within a factor of two."""
FRAGMENT: dict[Visibility, float] = {
    "layer": 6e-9,
    "packed-depth": 8e-9,
    "stacks": 60e-9,
    "frame": 250e-9,
    "supersampled": 8e-9,
    "multisampled": 8e-9,
}
"""Seconds for a covered pixel of a triangle, by ``Route.visibility``."""
COLOR: dict[Coloring, float] = {
    "palette": 1e-9,
    "corners": 8e-9,
    "texture": 25e-9,
    "lit": 60e-9,
    "deferred": 120e-9,
}
"""Seconds for the colour of a pixel, by ``Route.color``."""
COLORS_EVERY_FRAGMENT = ("stacks", "frame")
"""Here the colour is part of what a fragment takes."""
ASKING = 0.5e-3
"""Seconds that asking, waking and putting together take."""
LEAST_GAIN = 1e-3
"""Seconds that must be gained: less is not seen, and the other core has its own work."""


@dataclass(frozen=True)
class Load:
    """What a picture held of the work that bands divide; vertices and culling are every band's own work."""

    triangles: int
    """Those that are drawn."""
    pixels: int
    fragments: int
    """Covered pixels of all triangles."""
    visible: int
    """Pixels that something is seen at."""
    visibility: Visibility = "packed-depth"
    """As in ``Route``, which see; also ``color``."""
    color: Coloring = "corners"

    @property
    def seconds(self) -> float:
        """Estimated time of the work that bands divide, on one core."""
        color = 0.0 if self.visibility in COLORS_EVERY_FRAGMENT else COLOR[self.color]
        return (
            TRIANGLE * self.triangles
            + PIXEL * self.pixels
            + FRAGMENT[self.visibility] * self.fragments
            + color * self.visible
        )

    def gain(self, processes: int) -> float:
        """Estimated seconds gained by so many processes."""
        return self.seconds * (1 - 1 / processes) - ASKING

    def is_worth(self, processes: int) -> bool:
        """Return whether so many processes draw such a picture noticeably faster than one."""
        return self.gain(processes) >= LEAST_GAIN


def load_of(picture: Picture) -> Load:
    """Return what a picture held."""
    height, width, _ = picture.pixels.shape
    route = picture.route
    return Load(
        picture.statistics["edges"].outgoing,
        width * height,
        picture.statistics["raster"].outgoing,
        route.visible,
        route.visibility,
        route.color,
    )
