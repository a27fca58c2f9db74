"""A pass that is drawn before the picture: opened as a document of its own, at the texel that a fragment looks up."""

from dataclasses import replace

import numpy as np

from app.session.document import STEPPED, Document, document_at
from app.session.moment import Moment, Pixel
from app.session.session import Session
from core.records.passes import PlannedPass
from core.stages.passes import planned_passes
from core.study.record import Opening

NO_PASS = "This picture needs no pass: choose a shadow map, or a depth test with a prepass."


def passes_of(document: Document) -> tuple[PlannedPass, ...]:
    """Return what is drawn before the picture of a document."""
    return planned_passes(document.traced_scene, document.settings)


def pass_document(planned: PlannedPass, pixel: Pixel | None = None) -> Document:
    """Return a pass as a document that can be stepped, a large one around a pixel.

    Its fill tests pixel by pixel, and draws the same.
    """
    settings = replace(planned.settings, fill=STEPPED.fill)
    return document_at(Opening(planned.scene, settings, "depth", pixel), planned.title)


def looked_up_texels(moment: Moment, row: int) -> list[Pixel]:
    """Return the texels of the map that row ``row`` of Shade looks up, (column, row) each; none outside of the map."""
    columns = moment.trace.stage("shade").columns
    if row < 0 or "lamp_texels" not in columns:
        return []
    size, texels = int(columns["map_side"][row]), columns["lamp_texels"][row]
    is_inside = ((texels >= 0) & (texels < size)).all(axis=1)
    return [(int(column), int(line)) for column, line in texels[is_inside]]


def open_pass(session: Session, number: int = 0) -> None:
    """Open a pass of the picture at its depth buffer, with the texel pinned that the pixel looks up, or its own place.

    Undo leads back. ValueError where there is none.
    """
    moment = session.moment
    planned = passes_of(moment.document)
    if not planned:
        raise ValueError(NO_PASS)
    chosen, pixel = planned[number], moment.pin
    if chosen.name == "shadow-map":
        pixel = next(iter(looked_up_texels(moment, shaded_row(moment))), None)
    session.open(pass_document(chosen, pixel))
    session.set_stage("depth")
    if pixel is not None and session.moment.has_pixel(pixel):
        session.set_pin(pixel)


def shaded_row(moment: Moment) -> int:
    """Return the row of Shade of the pixel that is pinned, hovered or stepped; -1: none, or it is to be predicted."""
    if moment.is_predicting:
        return -1
    if moment.pin is None and moment.hover is None and moment.cursor.stage == "shade":
        return moment.row
    pixel = moment.pin or moment.hover or moment.pixel
    if pixel is None:
        return -1
    stage = moment.trace.stage("shade")
    rows = np.flatnonzero((stage.pixel == pixel).all(axis=1))
    own = rows[stage.triangle[rows] == moment.triangle]
    return int((own if len(own) else rows)[-1]) if len(rows) else -1
