"""State files: what is open, and where the stepping is, saved so that it opens unchanged, and those of a folder.

A state names the mesh file or built-in scene that its meshes come from and takes from there every array that
is still the same; edited arrays, cameras, lights and triangles given in clip space stand in the file itself.
What the source holds is checked by fingerprints: a mesh file that has changed since is refused.
"""

import json
import re
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from app.files.file_access import write_file
from app.files.mesh_formats.reading import Report
from app.files.saved_records import SavedRecordError, read_record
from app.files.state_arrays import array_record
from app.files.state_models import (
    MIGRATIONS,
    VERSION,
    Bookmark,
    Breakpoints,
    EditRecord,
    Look,
    RasterRecord,
    StateRecord,
)
from app.files.state_scenes import (
    Keep,
    OutsideSourceError,
    StateFileError,
    in_field,
    scene_from_record,
    scene_record,
)
from app.session.document import Document, TeachingRaster
from core.lines.line_method import line_of_kind
from core.scene import AnyScene
from core.setting_texts import settings_from_texts, settings_record
from core.settings import Settings
from core.stages.needs import check_edits, check_needs
from core.trace.conditions import parse_condition
from core.trace.stage_trace import StageTrace

# Positions in state files of earlier versions: rows of traces had fewer operations then.


FEWER = {
    **dict.fromkeys(("clip.sh-in-out", "clip.wa-crossing", "depth.ray-first"), 2),
    **dict.fromkeys(("clip.wa-ring", "clip.wa-close", "raster.table-level"), 1),
    **dict.fromkeys(("clip.sh-out-in", "depth.ray", "raster.table-edge", "raster.outcodes-cut"), 3),
    **dict.fromkeys((f"raster.{part}" for part in ("top", "top-first", "bottom", "bottom-first")), 2),
    **{"cull.back-stored-normal": 5, "depth.ray-exact": 4, "raster.lane": 2, "raster.active-inside": 2},
    **dict.fromkeys((f"raster.bresenham{name}" for name in ("", "-float", "-lecture")), 3),
    **dict.fromkeys(("raster.dda", "raster.dda-float32", "raster.midpoint", "raster.rectangle"), 3),
    **{"raster.diamond-exit": 3, "raster.wu": 4, "raster.gupta-sproull": 5},
    **dict.fromkeys((f"raster.{name}-start" for name in ("dda", "dda-float32", "midpoint", "rectangle")), 5),
    **{"raster.diamond-exit-start": 4, "raster.wu-start": 6, "raster.gupta-sproull-start": 8},
}
"""Kind of row to its operations in version 2, where they were others; those of a line stand for its other kinds."""
ADDED = {
    "interpolate": frozenset({"factor", "grid"}),
    "shade": frozenset({"lengths", "level", "fraction", "fractions", "power", "specular"}),
}
"""Stage to operations that version 2 did not have in any kind of row."""


def position_now(stage: StageTrace, position: int) -> int:
    """Return the position of a stage's trace that a position of version 2 is: in the same row, or at its end."""
    steps, added = stage.steps, ADDED.get(stage.stage, frozenset())
    counts = np.array([len(steps.operations[kind]) for kind in steps.kinds])
    for number, kind in enumerate(steps.kinds):
        names = [operation.name for operation in steps.operations[kind]]
        counts[number] -= sum(name in added for name in names)
        line = line_of_kind(kind)
        known = (f"{stage.stage}.{name}" for name in (kind, line))
        counts[number] = next((FEWER[name] for name in known if name in FEWER), counts[number])
    starts = np.concatenate([[0], np.cumsum(counts[steps.kind])])
    row = int(np.searchsorted(starts, position, "right")) - 1
    if row >= steps.row_count:
        return steps.count
    first, end = (int(start) for start in steps.starts[row : row + 2])
    return min(first + position - int(starts[row]), end)


# State files: what is open, and where the stepping is, saved so that it opens unchanged.

EXTENSION = ".rasterscope"
SIZE_LIMIT = 1 << 30
"""Largest state file in bytes."""
LINE_LENGTH = 100
"""Characters of a line of a state file, as far as its numbers allow."""


@dataclass(frozen=True, eq=False)
class State:
    """What a state file keeps."""

    document: Document
    stage: str = "raster"
    position: int = 0
    """Operations of the stage that are done."""
    level: int = 3
    """A ``core.records.steps.Level``."""
    pin: tuple[int, int] | None = None
    """Column and row of the pinned pixel."""
    bookmarks: Sequence[Bookmark] = ()
    breakpoints: Breakpoints = field(default_factory=Breakpoints)
    look: Look = field(default_factory=Look)


def save_state(path: str | Path, state: State, keep: Keep = array_record) -> None:
    """Write a state file.

    Parameters
    ----------
    path : str or Path
        The ending is not added.
    keep : callable, optional
        Makes the record of a mesh's array that has no source; by default it stands in the file.

    Raises
    ------
    OSError
        If it cannot be written; what stood there stays. The message is one sentence.
    StateFileError
        If a function of the settings was replaced.
    """
    path = Path(path)
    document = state.document
    with in_field("settings"):
        settings, edits = _settings_and_edits(document)
    record = StateRecord(
        program="rasterscope",
        version=VERSION,
        title=document.title,
        scene=scene_record(document.scene, document.path, path.resolve().parent, keep),
        settings=settings,
        edits=edits,
        raster=RasterRecord(
            columns=document.raster.columns, rows=document.raster.rows, origin=document.raster.origin
        ),
        triangle=document.triangle,
        before=document.before,
        lanes=document.lanes,
        stage=state.stage,
        position=state.position,
        level=state.level,
        pin=state.pin,
        bookmarks=list(state.bookmarks),
        breakpoints=state.breakpoints,
        look=state.look,
    )
    text = readable_json(record.model_dump(mode="json", exclude_defaults=True))
    write_file(path, text.encode() + b"\n")


def load_state(
    path: str | Path,
    progress: Report | None = None,
    is_cancelled: Callable[[], bool] | None = None,
    allows_outside: bool = False,
) -> tuple[State, tuple[str, ...]]:
    """Open a state file.

    Parameters
    ----------
    progress, is_cancelled : callable, optional
        For the mesh file that the state names, as in ``app.files.mesh_files.open_mesh``.
    allows_outside : bool
        Whether files that it names may be read from outside its folder; those of a state that this program has
        written on this machine may be.

    Returns
    -------
    State
    tuple of str
        Warnings of the mesh file.

    Raises
    ------
    StateFileError
        If it cannot be opened; the message is one sentence that names the field.
    OpeningCancelledError
        If ``is_cancelled()``.
    """
    path = Path(path)
    try:
        record = read_record(
            path,
            StateRecord,
            "rasterscope",
            "a state file",
            VERSION,
            limit=SIZE_LIMIT,
            union="scene",
            migrations=MIGRATIONS,
        )
        scene, mesh_path, warnings = scene_from_record(
            record.scene, path.resolve(), progress, is_cancelled, allows_outside
        )
        state = _state(record, scene, mesh_path)
        notes = (*edit_notes(state.document.settings), *draft_notes(state.look, state.document.settings))
        return without_stray_pin(state, (*warnings, *notes))
    except OutsideSourceError as problem:
        raise OutsideSourceError(f"{path.name} cannot be opened: {problem}") from problem
    except (SavedRecordError, StateFileError) as problem:
        raise StateFileError(f"{path.name} cannot be opened: {problem}") from problem
    except MemoryError as problem:
        raise StateFileError(f"{path.name} cannot be opened: there is not enough memory for it") from problem


def edit_notes(settings: Settings) -> tuple[str, ...]:
    """Return what is said when a state opens that runs edited listings."""
    if not settings.replacements:
        return ()
    from core.edits.edit import edits_of

    return tuple(
        f"This runs a listing that was edited{f', “{edit.name}”' if edit.name else ''}: "
        f"{edit.title.removeprefix('the edited ')}."
        for edit in edits_of(settings)
    )


def draft_notes(look: Look, settings: Settings) -> tuple[str, ...]:
    """Return what is said when a state opens that keeps texts that do not run."""
    if not look.drafts:
        return ()
    from core.edits.edit import Edit, apply_edit
    from core.lanes.problem import LISTING
    from core.lanes.run import bounded

    notes = []
    for draft in look.drafts:
        edit, reason = Edit(**dict(draft)), "it has not been run yet"
        try:
            with bounded(LISTING.seconds / len(look.drafts)):
                apply_edit(settings, edit)
        except ValueError as error:
            reason = str(error)
        kept = f"A text that does not run is kept for the {edit.title.removeprefix('the edited ')}"
        notes.append(f"{kept}: {reason}. Edit opens it.")
    return tuple(notes)


def check_drafts(look: Look) -> None:
    """Raise ValueError for a text of a listing that cannot be edited."""
    if look.drafts:
        from core.edits.edit import Edit

        for draft in look.drafts:
            Edit(**dict(draft))


def _settings_and_edits(document: Document) -> tuple[dict[str, str | int], list[EditRecord]]:
    """Return what is kept of settings, and of the listings that they or side B run edited, where they run."""
    if not document.edits and not document.settings.replacements:
        return settings_record(document.settings), []
    from app.session.listing_runs import settings_as_edited  # Few states need the evaluator.
    from app.session.printed_runs import without_printed
    from core.edits.edit import edits_of, without_edits

    other = document.settings
    with suppress(ValueError):  # Where they run no more, A | B has said why.
        other = settings_as_edited(document)[1]
    plain = without_printed(without_edits(other))
    return settings_record(plain), [EditRecord(**vars(edit)) for edit in edits_of(other)]


def _edited(settings: Settings, edits: Sequence[EditRecord]) -> Settings:
    """Return settings that run edited listings, of methods that they choose."""
    if not edits:
        return settings
    from core.edits.edit import Edit, apply_edit
    from core.edits.editable import EDITABLE

    for edit in edits:
        if getattr(settings, EDITABLE[edit.part].family if edit.part in EDITABLE else "line") != edit.of:
            raise ValueError(f"{edit.part} of {edit.of} is not the method that settings choose")
        settings = apply_edit(settings, Edit(**dict(edit)))
    return settings


def _state(record: StateRecord, scene: AnyScene, mesh_path: str) -> State:
    """Return the state of a record, or say which field does not fit."""
    with in_field("settings"):
        settings = settings_from_texts({name: str(value) for name, value in record.settings.items()})
        check_needs(scene, settings)
    with in_field("edits"):
        settings = _edited(settings, record.edits)
        check_edits(scene, settings)
    with in_field("look.drafts"):
        check_drafts(record.look)
    with in_field("look.other"):
        settings_from_texts({name: str(value) for name, value in record.look.other.items()})
    if record.breakpoints.condition:
        with in_field("breakpoints.condition"):
            parse_condition(record.breakpoints.condition)
    with in_field("raster"):
        raster = TeachingRaster(record.raster.columns, record.raster.rows, record.raster.origin)
    document = Document(
        scene=scene,
        raster=raster,
        settings=settings,
        triangle=record.triangle,
        before=record.before,
        lanes=record.lanes,
        title=record.title,
        path=mesh_path,
    )
    if record.look.printed:
        from app.session.printed_runs import settings_as_printed  # Few states need the listings.

        with in_field("look.printed"):
            mine, _ = settings_as_printed(record.look.printed, document)
            document = replace(document, settings=mine)
    with in_field("triangle and raster"):
        document.make_trace()
    position, bookmarks = record.position, tuple(record.bookmarks)
    if record.counted_by < VERSION:
        run = document.make_trace()
        position = position_now(run.stage(record.stage), position)
        bookmarks = tuple(
            mark.model_copy(update={"position": position_now(run.stage(mark.stage), mark.position)})
            for mark in bookmarks
        )
    return State(
        document=document,
        stage=record.stage,
        position=position,
        level=record.level,
        pin=record.pin,
        bookmarks=bookmarks,
        breakpoints=record.breakpoints,
        look=record.look,
    )


def without_stray_pin(state: State, warnings: tuple[str, ...]) -> tuple[State, tuple[str, ...]]:
    """Return the state and the warnings; a pin beside the traced raster is taken away, with a warning."""
    if state.pin is None:
        return state, warnings
    column, row = state.pin
    first_column, first_row, end_column, end_row = state.document.make_trace().source.raster.bounds
    if first_column <= column < end_column and first_row <= row < end_row:
        return state, warnings
    text = f"The pinned pixel ({column}, {row}) is not in the raster: nothing is pinned."
    return replace(state, pin=None), (*warnings, text)


def readable_json(value: Any, indent: str = "") -> str:
    """Return JSON with one line for each field, and for each row of numbers."""
    inner = indent + " "
    short = json.dumps(value, allow_nan=False, ensure_ascii=False)
    if not isinstance(value, dict | list) or not value or len(indent + short) <= LINE_LENGTH:
        return short
    if isinstance(value, dict):
        parts = [f"{json.dumps(k, ensure_ascii=False)}: {readable_json(v, inner)}" for k, v in value.items()]
        return "{\n" + ",\n".join(inner + part for part in parts) + f"\n{indent}}}"
    if not any(isinstance(part, dict | list) for part in value):
        return short
    return "[\n" + ",\n".join(inner + readable_json(part, inner) for part in value) + f"\n{indent}]"


# The states of a folder, one after the other: what a lecture goes through.


def states_beside(path: str) -> list[str]:
    """Return the paths of all states in the folder of a state; numbers in names count: 2 comes before 10.

    Raises OSError where the folder cannot be listed.
    """
    found = [file for file in Path(path).parent.iterdir() if file.suffix.lower() == EXTENSION]
    return [str(file) for file in sorted(found, key=_natural)]


def neighbour_of(path: str, states: list[str], direction: int) -> int | None:
    """Return the place of the next state (1) or of the one before (-1), also of one that is gone; ``None``: none."""
    here = _natural(Path(path))
    if direction > 0:
        return next((k for k, state in enumerate(states) if _natural(Path(state)) > here), None)
    return next((k for k in reversed(range(len(states))) if _natural(Path(states[k])) < here), None)


def _natural(path: Path) -> tuple[list[tuple[int, str]], str]:
    """Return what a file is sorted by: its words and numbers, and where these are alike its name."""
    parts = re.findall(r"\d+|\D+", path.stem.casefold())
    return [(int(part), "") if part.isdecimal() else (-1, part) for part in parts], path.name
