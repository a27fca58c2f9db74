"""A pass that is drawn before the picture: opened as a document of its own, at the texel that a fragment looks up."""

from dataclasses import replace

import numpy as np

from app.session.document import STEPPED, Document, open_document
from app.session.moment import Moment, Pixel
from app.session.session import Session
from core.records.passes import PlannedPass
from core.stages.passes import planned_passes

NO_PASS = "This picture needs no pass. Choose a shadow map in a scene with a directional light."


def passes_of(document: Document) -> tuple[PlannedPass, ...]:
    """Return what is drawn before the picture of a document."""
    return planned_passes(document.traced_scene, document.settings)


def pass_document(planned: PlannedPass) -> Document:
    """Return a pass as a document that can be stepped: its fill tests pixel by pixel, and draws the same."""
    return open_document(planned.scene, planned.title, settings=replace(planned.settings, fill=STEPPED.fill))


def looked_up_texels(moment: Moment, row: int) -> list[Pixel]:
    """Return the texels of the map that row ``row`` of Shade looks up, (column, row) each; none outside of the map."""
    columns = moment.trace.stage("shade").columns
    if row < 0 or "lamp_texels" not in columns:
        return []
    size, texels = int(columns["map_side"][row]), columns["lamp_texels"][row]
    is_inside = ((texels >= 0) & (texels < size)).all(axis=1)
    return [(int(column), int(line)) for column, line in texels[is_inside]]


def open_pass(session: Session) -> None:
    """Open the pass of the picture at its depth buffer, with the texel pinned that the pixel looks up.

    Undo leads back. ValueError where there is none.
    """
    moment = session.moment
    planned = passes_of(moment.document)
    if not planned:
        raise ValueError(NO_PASS)
    texels = looked_up_texels(moment, shaded_row(moment))
    session.open(pass_document(planned[0]))
    session.set_stage("depth")
    if texels and session.moment.has_pixel(texels[0]):
        session.set_pin(texels[0])


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
