"""State files: what is open, and where the stepping is, saved so that it opens as it was.

A state names the mesh file or built-in scene that its meshes come from and takes from there every array that
is still the same; edited arrays, cameras, lights and triangles given in clip space stand in the file itself.
What the source holds is checked by fingerprints: a mesh file that has changed since is refused.
"""

import json
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from app.document import Document, TeachingRaster
from app.field_problems import field_problem
from app.file_writing import whole_file
from app.mesh_formats import Report
from app.state_models import VERSION, BookmarkRecord, RasterRecord, StateRecord, dump
from app.state_scenes import StateFileError, scene_from_record, scene_record
from core import STAGES, Settings
from core.pipeline import check_needs
from core.settings import settings_from_texts

__all__ = ["EXTENSION", "State", "StateFileError", "load_state", "save_state"]

EXTENSION = ".rasterscope"
SIZE_LIMIT = 1 << 30
"""Largest state file in bytes."""


@dataclass(frozen=True, eq=False)
class State:
    """What a state file keeps."""

    document: Document
    stage: str = "raster"
    position: int = 0
    """Operations of the stage that are done."""
    level: int = 3
    """A ``core.steps.Level``."""
    pin: tuple[int, int] | None = None
    """Column and row of the pinned pixel."""
    bookmarks: Sequence[tuple[str, int]] = ()
    """Stage and position of every bookmark."""
    view: str = "pixels"
    """Name of the main view."""


def save_state(path: str | Path, state: State) -> None:
    """Write a state file.

    Parameters
    ----------
    path : str or Path
        The ending is not added.
    state : State

    Raises
    ------
    OSError
        If it cannot be written; what stood there stays. The message is one sentence.
    """
    path = Path(path)
    document = state.document
    scene, source_path = scene_record(document.scene, document.path, path.absolute().parent)
    record = StateRecord(
        program="rasterscope",
        version=VERSION,
        title=document.title,
        scene=scene,
        settings={name: getattr(document.settings, name) for name in Settings.__dataclass_fields__},
        raster=RasterRecord(
            columns=document.raster.columns, rows=document.raster.rows, origin=document.raster.origin
        ),
        triangle=document.triangle,
        before=document.before,
        stage=state.stage,
        position=state.position,
        level=state.level,
        pin=state.pin,
        bookmarks=[BookmarkRecord(stage=stage, position=position) for stage, position in state.bookmarks],
        view=state.view,
    )
    text = json.dumps(dump(record), indent=1, allow_nan=False)
    with whole_file(path) as file:
        file.write(text.encode() + b"\n")
