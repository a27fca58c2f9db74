"""Fills by testing: brute force over the image, bounding box, blocks, hierarchy of blocks, additions over the box.

Each returns the runs it looks at; all of them decide by the same rule and cover the same pixels.

References
----------
M. Zwicker, *Computergrafik*, lecture "Binning"; F. Pellacini, "brute force triangle rasterization".
"""

from dataclasses import replace

import numpy as np

from core.methods import method, table
from core.raster.binning import bound, one_level, runs_of_blocks, two_levels
from core.raster.edges.edge_functions import EdgeFunctions
from core.raster.fills.incremental import step_to
from core.raster.fills.traits import FillTraits
from core.raster.number_formats.number_format import number_format
from core.raster.pixel_runs import Boxes, Raster, Runs, rows_of

LEVEL_FACTOR = 4
"""Blocks on a side of a block of the upper level."""


@method(
    "fill",
    "bounding-box",
    "Bounding box",
    source="Zwicker 2016, Binning; Pellacini, brute force triangle rasterization",
    exact_for="every triangle",
)
def bounding_box(edges: EdgeFunctions, boxes: Boxes, raster: Raster, block_size: int) -> Runs:
    """Test every pixel of the box around the triangle."""
    return rows_of(boxes, np.arange(len(edges)))


@method(
    "fill",
    "hierarchy",
    "Hierarchy of blocks",
    source="Zwicker 2016, Further improvement; Greene 1996",
    exact_for="every triangle",
    takes=("block_size",),
    traits=FillTraits(group_label="Block"),
)
def hierarchy(edges: EdgeFunctions, boxes: Boxes, raster: Raster, block_size: int) -> Runs:
    """Look at blocks of blocks first, then at the blocks of those that the triangle's border crosses."""
    return runs_of_blocks(two_levels(edges, boxes, raster, block_size, LEVEL_FACTOR), boxes)


@method(
    "fill",
    "blocks",
    "Blocks of n x n pixels",
    source="Zwicker 2016, Improvement",
    exact_for="every triangle",
    takes=("block_size",),
    traits=FillTraits(group_label="Block"),
)
def blocks(edges: EdgeFunctions, boxes: Boxes, raster: Raster, block_size: int) -> Runs:
    """Discard or accept whole blocks, test the pixels of the others."""
    return runs_of_blocks(one_level(edges, boxes, raster, block_size), boxes)


@method(
    "fill",
    "brute-force",
    "Brute force",
    source="Zwicker 2016, Pixel inside/outside test; Jubair, Triangle Rasterization 3/7",
    exact_for="every triangle",
    traits=FillTraits(looks_everywhere=True),
)
def brute_force(edges: EdgeFunctions, boxes: Boxes, raster: Raster, block_size: int) -> Runs:
    """Test every pixel of the image for every triangle that has an area."""
    first_column, first_row, end_column, end_row = raster.bounds
    everywhere = Boxes(
        boxes.case, *(np.full(len(edges), n) for n in (first_column, first_row, end_column, end_row))
    )
    return rows_of(everywhere, np.flatnonzero(edges.doubled_area != 0))


@method(
    "fill",
    "incremental",
    "Bounding box, by additions",
    source="J. Pineda, A parallel algorithm for polygon rasterization, 1988",
    exact_for="numbers with exact sums: int64, exact, and snapped where every edge has an end in front of the "
    "eye",
    breaks_where="rounded sums (float64 not snapped, float32, float16, inverse): values drift along rows and "
    "columns",
)
def incremental(edges: EdgeFunctions, boxes: Boxes, raster: Raster, block_size: int) -> Runs:
    """Test every pixel of the box around the triangle, from the values of its neighbour."""
    runs = rows_of(boxes, np.arange(len(edges)))
    return replace(runs, stepping=step_to(edges, runs, raster))


def effective_fill(fill: str, coverage: str) -> str:
    """Return the fill that runs: ``bounding-box`` instead of spans that do not suit the numbers.

    Spans give the pixels of a test at every pixel only where values are monotone along a row, and are made for
    float64.
    """
    needs_float64 = "float64-edges" in table.get("fill", fill).needs
    return "bounding-box" if needs_float64 and not number_format(coverage).suits_spans else fill


__all__ = ["blocks", "bound", "bounding_box", "brute_force", "effective_fill", "hierarchy", "incremental"]
