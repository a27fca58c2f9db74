"""What is said of triangles, said of segments, points, polygons and patches of fragments, which go the same way."""

import re

_ANY = (
    (r", edge 0:", ":"),
    (r", outside the view, without area, or turned away", " and outside the view"),
    (r"not culled: its (front|back) faces the eye", "not culled"),
    (r"none of its edges is", "it is not"),
    (r"not on its outline: (\w)", r"\1"),
    (r"drawn for edge 2: ", "drawn: "),
    (r", the nearest\b", ""),
    (r"three weights", "weights"),
)
POLYGON = 4
"""Polygons of so many corners and more have the same words."""
_WORDS = {
    POLYGON: (
        (r"cut triangles at the view volume", "cut polygons at the clip window"),
        (r"makes every w positive.*", "leaves the part of every polygon that lies in the clip window."),
        (
            r"triangles in clip space, some of which cross a plane.*",
            "polygons and the clip window, in pixels.",
        ),
        (r"triangles wholly inside: each cut.*", "the rings of what is left of every polygon."),
        (
            r"extends the values of three corners over the triangle.*",
            "gives every pixel the colour of corner 0.",
        ),
        (
            r"three weights at every pixel, and the weighted sum of the corners' values",
            "the colour of every pixel",
        ),
        (r"decides by the sign of three edge functions at", "counts the edges to the left of"),
        (r"the edge functions and the pixels to test", "the rings of every polygon in the window"),
        (r"three vertices", "all vertices"),
        (r"three corners", "all corners"),
        (r"triangle", "polygon"),
    ),
    2: (
        *_ANY,
        (r"edge or untouched triangle", "segment"),
        (r"edges or untouched triangles", "segments"),
        (r"each cut one becomes a polygon, split into a fan", "of a cut one the part inside"),
        (r"(all )?three (vertices|corners)|all vertices", "both ends"),
        (r"vertices 1 and 2 are", "end 1 is"),
        (r"\ba corner", "an end"),
        (r"vertices", "ends"),
        (r"\ba vertex", "an end"),
        (r"vertex(?! \d+ of)", "end"),
        (r"edge 2 of triangle|triangle", "segment"),
        (r"(the )?edge 2\b", "the segment"),
        (r"edge", "segment"),
        (r"corner", "end"),
    ),
    0: (
        (r": it lies outside the bounding box[^.]*", ""),
        (r"triangles", "patches"),
        (r"a triangle's", "a patch's"),
        (r"triangle", "patch"),
        (r"tri\b", "patch"),
    ),
    1: (
        *_ANY,
        (r"edge or untouched triangle", "point"),
        (r"edges or untouched triangles", "points"),
        (r": each cut one becomes a polygon, split into a fan", ""),
        (r", one line\b", ""),
        (
            r"extends the values of three corners over the triangle.*",
            "gives each pixel the values of its point.",
        ),
        (r"(all )?three (vertices|corners) are|all vertices are|all of its corners (is|are)", "it is"),
        (r"\(distances", "(distance"),
        (r"vertices", "positions"),
        (r"vertex(?! \d+ of)", "position"),
        (r"which pixels a line has", "which pixel contains a point"),
        (
            r"edge 2 of triangle (\d+) begins and ends in (.*), so it has no length on the raster",
            r"point \1 lies in \2",
        ),
        (r"its centre lies at the first end of edge 2", "it contains the point"),
        (r"edge 2 of triangle|triangle", "point"),
        (r"(the )?edge 2\b", "the point"),
        (r"edge", "point"),
        (r"corner", "position"),
    ),
}
"""By the corners of a primitive, what is replaced by what."""


def _as_begun(found: re.Match[str], noun: str) -> str:
    """Return what replaces a match, with a capital where the match begins with one."""
    said = found.expand(noun)
    return said[:1].upper() + said[1:] if found[0][0].isupper() else said


def of_kind(text: str, corner_count: int) -> str:
    """Return a sentence about triangles as one about primitives of so many corners."""
    for pattern, noun in _WORDS.get(min(corner_count, POLYGON), ()):
        text = re.sub(
            pattern,
            lambda found, noun=noun: _as_begun(found, noun),  # type: ignore[misc]
            text,
            flags=re.IGNORECASE,
        )
    return text
