"""Whether more than one process is worth it: estimated from what the last picture held."""

from dataclasses import dataclass

from core.picture.record import Picture

TRIANGLE, PIXEL, FRAGMENT, SHADED, BUFFERED = 60e-9, 1e-9, 8e-9, 80e-9, 250e-9
"""Seconds for a triangle that is drawn, a pixel that is cleared and shown, a fragment that is compared by its word, a
pixel that is shaded after that, and a fragment that is drawn through all buffers; measured on one core, to within a
factor of two."""
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
    shaded: int
    """Pixels whose colour was worked out one by one."""
    buffered: int
    """Fragments that went through all buffers."""

    @property
    def seconds(self) -> float:
        """Estimated time of the work that bands divide, on one core."""
        return (
            TRIANGLE * self.triangles
            + PIXEL * self.pixels
            + FRAGMENT * self.fragments
            + SHADED * self.shaded
            + BUFFERED * self.buffered
        )

    def gain(self, processes: int) -> float:
        """Estimated seconds gained by so many processes."""
        return self.seconds * (1 - 1 / processes) - ASKING

    def is_worth(self, processes: int) -> bool:
        """Tell whether so many processes draw such a picture noticeably faster than one."""
        return self.gain(processes) >= LEAST_GAIN


def load_of(picture: Picture) -> Load:
    """Return what a picture held."""
    height, width, _ = picture.pixels.shape
    triangles, fragments = picture.statistics["edges"].outgoing, picture.statistics["raster"].outgoing
    route = picture.route
    if route.visibility == "frame":
        return Load(triangles, width * height, 0, 0, fragments)
    shaded = route.visible if route.color == "deferred" else 0
    return Load(triangles, width * height, fragments, shaded, 0)
