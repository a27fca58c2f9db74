"""The document in which one method's run can be stepped, at the place that matters: all of a picture, or a part."""

from dataclasses import replace
from typing import TYPE_CHECKING

from app.session.document import TRACED_TOGETHER, Document, TeachingRaster, open_document
from core.trace import TraceSource

if TYPE_CHECKING:
    from core.study.accuracy.record import Opening  # As in app.pages.page_bar.

PART = (48, 36)
"""Columns and rows that are stepped around a pixel of a picture that is too large to be stepped as a whole."""


def document_at(opening: "Opening", title: str, triangle: int | None = None) -> Document:
    """Return a document in which the opening's pixel can be stepped.

    A picture that is too large to be stepped as a whole is stepped around the pixel, and of many triangles only one:
    ``triangle``, or else the one that is seen there.
    """
    document = open_document(opening.scene, title, settings=opening.settings)
    if opening.pixel is None:
        return document
    if document.raster.origin is not None or document.traced_scene.size != opening.scene.size:
        document = replace(document, raster=part_around(opening.scene.size, opening.pixel))
    if document.triangle_count > TRACED_TOGETHER:
        seen = _triangle_at(document, opening.pixel) if triangle is None else triangle
        document = replace(document, triangle=document.triangle if seen < 0 else seen)
    return document


def part_around(size: tuple[int, int], pixel: tuple[int, int]) -> TeachingRaster:
    """Return a raster around a pixel, inside of the picture."""
    columns, rows = min(PART[0], size[0]), min(PART[1], size[1])
    column = min(max(pixel[0] - columns // 2, 0), size[0] - columns)
    row = min(max(pixel[1] - rows // 2, 0), size[1] - rows)
    return TeachingRaster(columns, rows, (column, row))


def _triangle_at(document: Document, pixel: tuple[int, int]) -> int:
    """Return the triangle that is seen at a pixel, -1: none."""
    source = TraceSource(document.traced_scene, document.settings, None, document.region)
    first_column, first_row, end_column, end_row = source.raster.bounds
    if not (first_column <= pixel[0] < end_column and first_row <= pixel[1] < end_row):
        return -1
    return int(source.picture.primitive[pixel[1] - first_row, pixel[0] - first_column])
