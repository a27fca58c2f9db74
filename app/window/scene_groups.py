"""What can be opened without a dialog: lessons, states of a folder, files that were open, built-in scenes."""

import os
from collections.abc import Iterable, Sequence
from pathlib import Path

from app.files.file_names import shown_name
from app.session.document import Document
from lessons.scenes import CATALOGUE, BuiltInScene
from lessons.slides.scenes import LECTURE_SCENES, LECTURES

AS_PRINTED = "printed/"
"""What the names of entries begin with that show a listing as a slide prints it."""
Entry = tuple[str, str]
"""What is opened, and its title."""


def scene_groups(
    states: Sequence[str], recent: Iterable[str], lessons: Sequence[Entry] = ()
) -> dict[str, list[Entry]]:
    """Return what can be opened by headings: ``states`` of one folder, recent files that are still there, scenes.

    ``lessons`` come first.
    """
    others = [path for path in recent if path not in states and os.path.isfile(path)]
    groups = {"Recent files": _files(others), "Scenes": _scenes(CATALOGUE)}
    groups |= {LECTURES[name]: _scenes(scenes) for name, scenes in LECTURE_SCENES.items()}
    if states:
        titled = [(path, shown_name(Path(path).stem)) for path in states]
        groups = {f"States in {shown_name(Path(states[0]).parent.name)}": titled, **groups}
    return {"Lessons": [*lessons], **groups} if lessons else groups


def printed_group(document: Document) -> dict[str, list[Entry]]:
    """Return the listings as slides print them that run on the open scene, under one heading; empty: none does."""
    from app.session.printed_run import runnable_on  # Wanted by few, long after the start.

    entries = [(f"{AS_PRINTED}{it.name}", f"{it.lecture}: {it.title}") for it in runnable_on(document)]
    return {"As printed, beside the right method": entries} if entries else {}


def scenes_about() -> dict[str, str]:
    """Return what each built-in scene is about, by its name."""
    scenes = [*CATALOGUE, *(scene for of in LECTURE_SCENES.values() for scene in of)]
    return {scene.name: scene.description for scene in scenes}


def _files(paths: Iterable[str]) -> list[Entry]:
    return [(path, shown_name(Path(path).name)) for path in paths]


def _scenes(scenes: Iterable[BuiltInScene]) -> list[Entry]:
    return [(scene.name, scene.title) for scene in scenes]


def next_entry(groups: dict[str, list[Entry]], shown: str) -> str:
    """Return what comes after the entry that is shown, in the same group; or else the first of all."""
    for entries in groups.values():
        names = [name for name, _ in entries]
        if shown in names:
            return names[min(names.index(shown) + 1, len(names) - 1)]
    return next((entries[0][0] for entries in groups.values() if entries), "")
