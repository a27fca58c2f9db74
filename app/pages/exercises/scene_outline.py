"""The outline of a question's scene on the grid: where its corners lie, and nothing of what is drawn."""

from dataclasses import replace

import numpy as np

from app.pages.step.grid_records import geometry_of
from app.session.cursor import Cursor
from app.session.document import STEPPED, Document, open_document
from app.session.moment import Step
from core.scene import AnyScene
from core.settings import DEFAULTS
from lessons.exercises.question import Draft
from widgets.grid.geometry import GridGeometry

NAMES = "ABCD"
"""As questions call several triangles, in the order of the scene."""
NAMED = range(2, len(NAMES) + 1)
"""How many triangles have names."""
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
    """Return the outlines of the scene; ``None``: it shows fragments, has none, or they are what is asked for."""
    if draft.scene is None or stage in HIDDEN:
        return None
    outline = scene_outline(draft.outlined or draft.scene)
    if _is_fragments(outline):
        return None
    names = NAMES[: len(outline.triangles)]
    if len(outline.triangles) in NAMED and all(f"{name}: " in draft.given for name in names):
        # None stands out: the question is about all of them.
        return replace(outline, focus=-1, names=tuple(names))
    return outline


def _is_fragments(outline: GridGeometry) -> bool:
    """Return whether each of several triangles lies in one pixel: it stands for a fragment, its shape says nothing."""
    pixels, corners = np.floor(outline.vertices[outline.triangles]), outline.triangles
    # All corners of a point are one.
    return len(corners) > 1 and bool(
        (corners[:, 0] != corners[:, 1]).all() and (pixels == pixels[:, :1]).all()
    )


def scene_outline(scene: AnyScene) -> GridGeometry:
    """Return the outlines of a scene as they are before culling: what is dropped may be what is asked for."""
    outlines = geometry_of(Step(open_document(scene, "").make_trace(), Cursor("cull")))
    return replace(outlines, draggable=False, snapped=None)
