"""How many samples a pixel has, where they lie, and how they are drawn: the methods of antialiasing.

Positions are from the pixel's lower left corner, x to the right and y up, 0 to 1. Those of four samples (the rotated
grid) are multiples of 1/8 pixel and so of the 1/256 that corners are snapped to: moving the corners by the way from a
sample to the pixel's centre is exact, and the coverage of the moved corners at the centre is the coverage of the
sample, by the very arithmetic of the edge functions and spans.

References
----------
OpenGL 4.6 (core profile), 14.3.1 "Multisampling"; Direct3D 11, "Standard multisample quality patterns" (4 samples).
LMU, *Computer Graphics 1*, tutorial 5, "Super Sampling Antialiasing (SSAA)", which takes MSAA for one kind of it, 2020.
M. I. Jubair, *Computer Graphics*, "Anti-aliasing": box filtering by supersampling.
"""

from dataclasses import dataclass

import numpy as np

from core.methods import method
from core.records.arrays import Floats, read_only

CENTER = read_only(np.array([[0.5, 0.5]]))
"""(1, 2) the one sample of a picture without antialiasing."""
ROTATED_GRID = read_only(np.array([[0.375, 0.125], [0.875, 0.375], [0.125, 0.625], [0.625, 0.875]]))
"""(4, 2) the four samples of graphics cards: each alone in its row, its column and its quarter of the pixel."""


@dataclass(frozen=True, eq=False)
class Sampling:
    """The samples of a pixel; ``core.pipeline.draw`` draws them.

    Examples
    --------
    >>> from core.resolved import resolve
    >>> from core.settings import Settings
    >>> sampling = resolve(Settings(antialiasing="ssaa-n", samples_across=3)).sampling
    >>> sampling.side, sampling.count
    (3, 9)
    """

    position: Floats
    """(S, 2) float64, where they lie. Exact areas are of no samples: theirs is the centre, which the buffers beside
    the colour are of."""
    side: int = 0
    """Samples on a side of a pixel, each shaded, as pixels of a finer picture; 0: they are not drawn so."""
    is_area: bool = False
    """Whether pixels are cut into the pieces that edges make of them."""
    is_filtered: bool = False
    """Whether edges are smoothed when the picture is finished."""
    is_temporal: bool = False
    """Whether the picture is mixed with those before it."""

    @property
    def is_plain(self) -> bool:
        """Whether a pixel has one sample, and its colour is that of the sample."""
        return len(self.position) == 1 and not (
            self.side or self.is_area or self.is_filtered or self.is_temporal
        )

    @property
    def count(self) -> int:
        """S."""
        return len(self.position)


def grid_positions(side: int) -> Floats:
    """Return the centres (S, 2) float64 of ``side`` x ``side`` equal squares, row by row from the lower left.

    Examples
    --------
    >>> grid_positions(2).tolist()
    [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]]
    """
    along = (np.arange(side) + 0.5) / side
    x, y = np.meshgrid(along, along)
    return read_only(np.column_stack([x.ravel(), y.ravel()]))


@method(
    "antialiasing",
    "none",
    "None (one sample)",
    source="Zwicker 2016, Pixel inside/outside test; LMU 2020, Point Aliasing",
    exact_for="edges along pixel borders",
    breaks_where="every other edge: staircases. Details between pixel centres are lost",
)
def one_sample(samples_across: int) -> Sampling:
    """Take one sample, the pixel's centre."""
    return Sampling(CENTER)


@method(
    "antialiasing",
    "ssaa-4",
    "Supersampling, 2 x 2 samples",
    source="LMU 2020, Super Sampling Antialiasing; Jubair, Anti-aliasing",
    exact_for="area in steps of 1/4 pixel, shading included",
    breaks_where="nearly horizontal or vertical edges: only two steps a pixel. Lines and points: they are one "
    "sample wide, and fade. Four times the work",
    takes=("resolve_filter",),
)
def supersample_by_2(samples_across: int) -> Sampling:
    """Take 2 x 2 samples a pixel."""
    return Sampling(grid_positions(2), side=2)


@method(
    "antialiasing",
    "ssaa-16",
    "Supersampling, 4 x 4 samples",
    source="LMU 2020, Super Sampling Antialiasing; Jubair, Anti-aliasing",
    exact_for="area in steps of 1/16 pixel, shading included",
    breaks_where="nearly horizontal or vertical edges: only four steps a pixel. Lines and points: they are one "
    "sample wide, and fade. Sixteen times the work",
    takes=("resolve_filter",),
)
def supersample_by_4(samples_across: int) -> Sampling:
    """Take 4 x 4 samples a pixel."""
    return Sampling(grid_positions(4), side=4)


@method(
    "antialiasing",
    "ssaa-n",
    "Supersampling, n x n samples",
    source="LMU 2020, Super Sampling Antialiasing; Jubair, Anti-aliasing",
    exact_for="area in steps of 1/n^2 pixel, shading included (n is samples_across)",
    breaks_where="nearly horizontal or vertical edges: only n steps a pixel. Lines and points: they are one "
    "sample wide, and fade. n^2 times the work",
    takes=("resolve_filter", "samples_across"),
)
def supersample_by_n(samples_across: int) -> Sampling:
    """Take ``samples_across`` x ``samples_across`` samples a pixel; one alone is the centre."""
    return Sampling(grid_positions(samples_across), side=samples_across if samples_across > 1 else 0)


@method(
    "antialiasing",
    "area",
    "Exact area",
    source="Catmull 1978; Carpenter 1984, The A-buffer",
    exact_for="edges, overlaps and intersections of opaque triangles, and colours that change linearly",
    breaks_where="textures, highlights and perspective within a piece: each piece has one colour",
)
def exact_area(samples_across: int) -> Sampling:
    """Cut pixels into pieces (`core.antialiasing.exact_area`)."""
    return Sampling(CENTER, is_area=True)


@method(
    "antialiasing",
    "msaa-4",
    "Multisampling, 4 samples",
    source="OpenGL 4.6, 14.3.1 Multisampling; LMU 2020, Super Sampling Antialiasing",
    exact_for="edges, with area in steps of 1/4 pixel",
    breaks_where="details inside triangles (textures, highlights), and colours extrapolated beyond an edge",
    takes=("resolve_filter",),
)
def multisample(samples_across: int) -> Sampling:
    """Take four samples a pixel, shaded together at its centre."""
    return Sampling(ROTATED_GRID)


@method(
    "antialiasing",
    "fxaa",
    "FXAA (edges found in the picture)",
    source="Lottes 2009, FXAA; LMU, the antialiasing of many video games",
    exact_for="pictures of one colour, which it leaves alone; close on long edges that are nearly level or upright",
    breaks_where="detail of one pixel fades; what no pixel centre has hit stays lost; text and patterns blur",
)
def fast_approximate(samples_across: int) -> Sampling:
    """Take one sample, and smooth the edges of the finished picture (`core.antialiasing.fxaa`)."""
    return Sampling(CENTER, is_filtered=True)


@method(
    "antialiasing",
    "temporal",
    "Temporal (mixed with the pictures before)",
    source="Karis 2014, High quality temporal supersampling; LMU, the antialiasing of many video games (TXAA, 2012)",
    exact_for="scenes at rest: supersampling by one sample a picture, shading included",
    breaks_where="what moves: ghosts, or thin details that flicker where clamped. Lines and points: their pixels stay",
    takes=("history", "pictures", "blend_share"),
)
def temporal(samples_across: int) -> Sampling:
    """Take one sample in each picture, and mix it with those before (`core.antialiasing.temporal`)."""
    return Sampling(CENTER, is_temporal=True)
