"""A pass that is drawn before the picture: opened as a document of its own, at the texel that a fragment looks up."""

from dataclasses import replace

import numpy as np

from app.session.document import STEPPED, Document, document_at
from app.session.moment import Moment, Pixel
from app.session.session import Session
from core.families import mirrors_of
from core.records.passes import PlannedPass
from core.shading.environment import FACES
from core.stages.passes import planned_passes

NO_PASS = (
    "This picture needs no pass: choose shadows or reflections by a map, a prepass, or culling by occluders."
)
OF_THE_SAME_PIXELS = ("prepass", "occluders")
"""Passes of the picture's own size: a pixel is looked up at its own place."""


def passes_of(document: Document) -> tuple[PlannedPass, ...]:
    """Return what is drawn before the picture of a document."""
    return planned_passes(document.traced_scene, document.settings)


def pass_document(planned: PlannedPass, pixel: Pixel | None = None) -> Document:
    """Return a pass as a document that can be stepped, a large one around a pixel.

    Its fill tests pixel by pixel, and draws the same.
    """
    from core.study.record import Opening  # Studies are wanted long after the start.

    settings = replace(planned.settings, fill=STEPPED.fill)
    return document_at(Opening(planned.scene, settings, "depth", pixel), planned.title)


def looked_into(moment: Moment, row: int) -> int:
    """Return which of `passes_of` a row of Shade looks into: a mirror its face, others the shadow map; -1: none."""
    planned = passes_of(moment.document)
    names = [each.name for each in planned]
    if "environment" in names and row >= 0:
        columns = moment.trace.stage("shade").columns
        number = int(columns["mirror"][row]) if "mirror" in columns else -1
        if number >= 0:
            mirrors = mirrors_of(moment.trace.source.scene)
            face = len(FACES) * mirrors.index(number) + int(columns["face"][row])
            return names.index("environment") + face
    return names.index("shadow-map") if "shadow-map" in names else -1


def looked_up_texels(moment: Moment, row: int, number: int) -> list[Pixel]:
    """Return the texels (column, row) of pass ``number`` that row ``row`` of Shade looks up; none outside of it."""
    columns, planned = moment.trace.stage("shade").columns, passes_of(moment.document)
    name = {"shadow-map": "lamp_texels", "environment": "face_texels"}.get(planned[number].name, "")
    is_other = planned[number].name == "environment" and looked_into(moment, row) != number
    if row < 0 or name not in columns or is_other:
        return []
    size, texels = planned[number].scene.size[0], columns[name][row]
    is_inside = ((texels >= 0) & (texels < size)).all(axis=1)
    return [(int(column), int(line)) for column, line in texels[is_inside]]


def passes_to_open(moment: Moment, pixel: Pixel) -> list[int]:
    """Return which of `passes_of` are offered at a pixel: of six faces the one that it looks into."""
    planned = passes_of(moment.document)
    if all(each.name != "environment" for each in planned):
        return list(range(len(planned)))
    into = looked_into(moment, row_at(moment, pixel))
    return [number for number, each in enumerate(planned) if number == into or each.name != "environment"]


def open_pass(session: Session, number: int | None = None) -> None:
    """Open a pass of the picture, with the texel pinned that the pixel looks up, or its own place.

    ``None``: the pass that the pixel looks into, or the first. A map is opened where what it stores is made: depths at
    the depth test, colours at Blend. Undo leads back. ValueError where there is none.
    """
    moment = session.moment
    planned, row = passes_of(moment.document), shaded_row(moment)
    if not planned:
        raise ValueError(NO_PASS)
    number = max(looked_into(moment, row), 0) if number is None else number
    chosen, pixel = planned[number], moment.pin
    if chosen.name not in OF_THE_SAME_PIXELS:
        pixel = next(iter(looked_up_texels(moment, row, number)), None)
    session.open(pass_document(chosen, pixel))
    session.set_stage("blend" if chosen.name == "environment" else "depth")
    if pixel is not None and session.moment.has_pixel(pixel):
        session.set_pin(pixel)


def shaded_row(moment: Moment) -> int:
    """Return the row of Shade of the pixel that is pinned, hovered or stepped; -1: none, or it is to be predicted."""
    if moment.is_predicting:
        return -1
    if moment.pin is None and moment.hover is None and moment.cursor.stage == "shade":
        return moment.row
    pixel = moment.pin or moment.hover or moment.pixel
    return -1 if pixel is None else row_at(moment, pixel)


def row_at(moment: Moment, pixel: Pixel) -> int:
    """Return the row of Shade of a pixel, that of the triangle at hand if it has one, else the last; -1: none."""
    stage = moment.trace.stage("shade")
    rows = np.flatnonzero((stage.pixel == pixel).all(axis=1))
    own = rows[stage.triangle[rows] == moment.triangle]
    return int((own if len(own) else rows)[-1]) if len(rows) else -1
