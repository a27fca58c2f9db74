"""Where the stepping is, and where a step, a jump or another run takes it."""

from dataclasses import dataclass, replace

import numpy as np

from core import STAGES, Trace
from core.explain.stage_texts import skipped_because
from core.records.steps import Level
from core.scene import AnyScene
from core.trace.stage_trace import StageTrace
from lessons.run_place import RunPlace


@dataclass(frozen=True)
class Cursor:
    """Where the stepping is: operations of a stage that are done, and how large a step is."""

    stage: str = "raster"
    position: int = 0
    level: Level = Level.PIXEL


def stage_for(scene: AnyScene, stage: str) -> str:
    """Return a stage, or the next one that a scene goes through, if it skips this one."""
    later = STAGES[STAGES.index(stage) :]
    return next(name for name in later if not skipped_because(name, scene.corner_count))


def cursor_for(scene: AnyScene, cursor: Cursor) -> Cursor:
    """Return the cursor, or the start of the next stage, if a scene skips the present one."""
    stage = stage_for(scene, cursor.stage)
    return cursor if stage == cursor.stage else replace(cursor, stage=stage, position=0)


def cursor_at(place: RunPlace, trace: Trace, level: Level) -> Cursor:
    """Return the cursor at a place, or at the start of the next stage, if the scene skips the place's own.

    ``level`` holds where the place has none.

    Raises ValueError where nothing of its name happens.
    """
    stage = stage_for(trace.source.scene, place.stage)
    return Cursor(stage, place.position(trace) if stage == place.stage else 0, place.level or level)


def placed(cursor: Cursor, trace: Trace, position: int | None, stage: str = "") -> Cursor:
    """Return a cursor at a position of its stage or another one, or the nearest there is; ``None``: at the end."""
    stage = stage or cursor.stage
    count = trace.stage(stage).steps.count
    return replace(cursor, stage=stage, position=count if position is None else min(max(position, 0), count))


def kept_at_pixel(cursor: Cursor, before: StageTrace, row: int, trace: Trace) -> Cursor:
    """Return a cursor at the triangle and pixel that a row of the stage was about, where shaders are stepped.

    It is after as many rows of the pixel as before, or after its last one where it was after that. Without shaders, or
    where nothing is about the pixel any more, the cursor stays at its position.
    """
    now = trace.stage(cursor.stage)
    if row < 0 or now is before or not any("statement" in stage.steps.kinds for stage in (before, now)):
        return placed(cursor, trace, cursor.position)
    mine, theirs = (
        np.flatnonzero(
            (stage.triangle == before.triangle[row]) & (stage.pixel == before.pixel[row]).all(axis=1)
        )
        for stage in (before, now)
    )
    if not len(theirs):
        return placed(cursor, trace, cursor.position)
    number = len(theirs) - 1 if row == mine[-1] else min(int(np.searchsorted(mine, row)), len(theirs) - 1)
    return replace(cursor, position=now.steps.position_after(int(theirs[number])))


def stepped(cursor: Cursor, trace: Trace, direction: int, level: Level) -> Cursor:
    """Return a cursor one step on (1) or back (-1), from the end of a stage in the next one that the scene has."""
    steps = trace.stage(cursor.stage).steps
    position = (steps.forward if direction > 0 else steps.back)(cursor.position, level)
    if position != cursor.position:
        return replace(cursor, position=position)
    index = STAGES.index(cursor.stage) + direction
    while 0 <= index < len(STAGES) and skipped_because(STAGES[index], trace.source.scene.corner_count):
        index += direction
    if not 0 <= index < len(STAGES):
        return cursor
    return placed(cursor, trace, 0 if direction > 0 else None, STAGES[index])
