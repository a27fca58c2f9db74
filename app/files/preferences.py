"""What the program remembers between two starts: a small JSON file in the user's configuration folder."""

import os
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from app.files.file_access import (
    make_folder,
    read_input,
    write_file,
)
from app.files.saved_records import field_problem
from app.files.state_models import TextSize
from app.files.user_folders import preferences_folder
from core.stages.declared import STAGES
from lessons.os_errors import os_error_reason

FILE_NAME = "preferences.json"
RECENT_LIMIT = 10
SIZE_LIMIT = 1 << 22
"""Most bytes of the file."""

Base64 = Annotated[str, Field(pattern=r"^[A-Za-z0-9+/]*={0,2}$")]


class Preferences(BaseModel):
    """Everything that is restored at the next start."""

    model_config = ConfigDict(strict=True, frozen=True, extra="ignore", allow_inf_nan=False, defer_build=True)

    recent_files: list[str] = []
    """Absolute paths, the last opened first."""
    folder: str = ""
    """Of the file that was chosen last."""
    theme: Literal["system", "light", "dark", "presenter"] = "system"
    text_size: TextSize = 0
    """Percent of the usual size of the text; 0: as large as the desktop's."""
    geometry: Base64 = ""
    """Place and size of the window, as Qt saves them, in base 64."""
    layout: dict[str, Base64] = {}
    """Sizes of panes by name, as Qt saves them, in base 64."""
    shown_panes: list[str] = ["inspector", "details", "navigator", "run"]
    """Panes of the Step page that are shown; the others are folded away."""
    folded_cards: list[str] = list(STAGES)
    """Stages whose card is folded."""
    page: str = "step"
    """Page that was shown last."""
    shows_start: bool = False
    """Whether the start page is shown although the last scene is restored."""
    shows_all_methods: bool = False
    """Whether the pane Methods shows those beyond a first course too."""
    level: Annotated[int, Field(ge=0, le=4)] = 3
    """Level of stepping, a ``core.records.steps.Level``."""
    speed: Annotated[float, Field(gt=0)] = 4.0
    """Steps per second while playing."""
    keys: dict[str, list[str]] = {}
    """Changed keys by the names of their actions, as Qt's portable texts."""
    has_character_keys: bool = True
    """Whether letters, digits and signs alone are keys."""


def with_recent_file(preferences: Preferences, path: str | Path) -> Preferences:
    """Return the preferences with ``path`` as the file opened last."""
    path = os.path.abspath(path)
    recent = [path, *(other for other in preferences.recent_files if other != path)]
    return preferences.model_copy(update={"recent_files": recent[:RECENT_LIMIT]})


def load_preferences() -> tuple[Preferences, str]:
    """Read the preferences.

    Returns
    -------
    Preferences
        Those of the file; the defaults where there is none or it is broken.
    str
        What to tell the user, empty if all is well. A broken file is kept under the ending ``.broken``.
    """
    try:
        path = preferences_folder() / FILE_NAME
        content = read_input(path, SIZE_LIMIT)
    except FileNotFoundError:
        return Preferences.model_construct(), ""  # No check is prepared where nothing is to be checked.
    except OSError as problem:
        reason = os_error_reason(problem)
        return Preferences(), f"The preferences cannot be read: {reason}. The defaults are used."
    try:
        return Preferences.model_validate_json(content), ""
    except ValidationError as problem:
        return Preferences(), _set_aside(path, field_problem(problem))


def _set_aside(path: Path, reason: str) -> str:
    """Rename a broken file and say so."""
    broken = path.with_name(path.name + ".broken")
    try:
        os.replace(path, broken)
    except OSError as problem:
        kept = f"it could not be set aside ({os_error_reason(problem)})"
    else:
        kept = f"it is kept as {broken.name}"
    return f"The preferences were broken: {reason}. The defaults are used; {kept}."


def save_preferences(preferences: Preferences) -> None:
    """Write the preferences, and the folder where it is missing; recent files of other windows stay.

    Raises OSError if that is not possible; the message is one sentence.
    """
    folder = preferences_folder()
    make_folder(folder)
    recent = dict.fromkeys([*preferences.recent_files, *_recent_of_others(folder)])
    preferences = preferences.model_copy(update={"recent_files": list(recent)[:RECENT_LIMIT]})
    write_file(folder / FILE_NAME, preferences.model_dump_json(indent=1).encode() + b"\n")


def _recent_of_others(folder: Path) -> list[str]:
    """Return the recent files that stand in the preferences now; another window may have saved them."""
    try:
        return Preferences.model_validate_json(read_input(folder / FILE_NAME, SIZE_LIMIT)).recent_files
    except (OSError, ValidationError):
        return []
