"""Lines of which some draw their last pixel: those that were cut there, and those that no other line goes on from."""

from dataclasses import fields, replace

import numpy as np

from core.raster.lines.drawing import draw_segments
from core.raster.lines.records import LinePixels, LineSteps, check_segments
from core.raster.pixel_runs import Raster
from core.records.arrays import Flags, Floats, Integers, read_only


def draw_cut_lines(segments: Floats, draws_last: Flags, raster: Raster, line: str) -> LinePixels:
    """Find the pixels of segments (L, 2, 2) as ``draw_lines`` does, with the last one where ``draws_last`` (L,).

    Notes
    -----
    An outline leaves out the last pixel of each edge because the next edge begins there. No edge begins where the
    border of the raster cut one, and none where a segment by itself ends.
    """
    whole = check_segments(segments, raster.width, raster.height, raster.center)
    if not draws_last.any():
        return draw_segments(whole, line, last_pixel=False)
    of_part = [np.flatnonzero(~draws_last), np.flatnonzero(draws_last)]
    parts = [
        draw_segments(replace(whole, ends=whole.ends[index]), line, last_pixel)
        for last_pixel, index in zip((False, True), of_part, strict=True)
    ]
    owner = np.concatenate([index.take(part.owner) for index, part in zip(of_part, parts, strict=True)])
    order = np.argsort(owner, kind="stable")
    pixels = np.concatenate([part.pixels for part in parts]).take(order, axis=0)
    intensities = np.concatenate([part.intensities for part in parts]).take(order)
    return LinePixels(
        read_only(pixels), read_only(intensities), read_only(owner.take(order)), lambda: _join(parts, order)
    )


def _join(parts: list[LinePixels], order: Integers) -> LineSteps:
    """Return the numbers of the pixels of all parts, in the order of the segments."""
    return LineSteps(
        *(
            read_only(np.concatenate([getattr(part.steps, field.name) for part in parts]).take(order))
            for field in fields(LineSteps)
        )
    )
