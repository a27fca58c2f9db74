"""The outline of a question's scene on the grid: where its corners lie, and nothing of what is drawn."""

from dataclasses import replace

from app.pages.step.grid_records import geometry_of
from app.session.document import STEPPED, Document, open_document
from core.settings import DEFAULTS
from lessons.exercises.question import Draft
from widgets.grid.geometry import GridGeometry

HIDDEN = ("transform",)
"""Stages whose questions ask where the corners lie."""


def document_of(draft: Draft, title: str) -> Document:
    """Return the document in which the question's scene is stepped, with the plainest fill where none is asked for."""
    assert draft.scene is not None
    settings = draft.settings
    if settings.fill == DEFAULTS.fill:
        settings = replace(settings, fill=STEPPED.fill)
    return open_document(draft.scene, title, settings=settings)


def outline_of(draft: Draft, stage: str) -> GridGeometry | None:
    """Return the outlines of the scene; ``None``: there is none, or it is what is asked for."""
    if draft.scene is None or stage in HIDDEN:
        return None
    document = document_of(draft, "")
    outlines = geometry_of(document, document.make_trace())
    return replace(outlines, draggable=False, snapped=None)
