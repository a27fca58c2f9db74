"""Opening whatever a user names: a built-in scene, a mesh file or a state file."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from app.files.file_access import OutsideWarning, shown_name
from app.files.mesh_files import open_mesh
from app.files.mesh_formats.reading import MeshFileError, Report
from app.files.state_arrays import remember_file
from app.files.state_files import EXTENSION, State, load_state
from app.session.document import STEPPED, Document, check_drawing, focus_on, open_document, shortened
from app.session.memory import MemoryBoundError
from core.scene import AnyScene, Scene
from core.setting_texts import settings_from_texts
from lessons.lectures.scenes import ALL_SCENES
from lessons.run_place import FIRST_STEP, RunPlace


@dataclass(frozen=True, eq=False)
class Opened:
    """What came of opening something."""

    document: Document
    warnings: tuple[str, ...] = ()
    """One sentence for each thing that a file names and that could not be had."""
    state: State | None = None
    """Where a state file was left; ``None``: not a state file. ``state.document`` is ``document``."""
    path: str = ""
    """The file that was opened, absolute; empty: a built-in scene."""
    place: RunPlace = FIRST_STEP
    """Where it is entered, unless ``state`` says it: of a file the start, of a built-in scene what it is about."""

    @property
    def left_outside(self) -> tuple[str, ...]:
        """The warnings about files that were not read because they lie outside the folder of their mesh."""
        return tuple(text for text in self.warnings if isinstance(text, OutsideWarning))


def open_any(
    target: str,
    progress: Report | None = None,
    is_cancelled: Callable[[], bool] | None = None,
    allows_outside: bool = False,
) -> Opened:
    """Open a built-in scene by its name, a state file by its ending, or else a mesh file.

    Parameters
    ----------
    target : str
        A built-in scene goes before a file of the same name (which opens as ``./name``).
    progress, is_cancelled : callable, optional
        As in ``app.files.mesh_files.open_mesh``.
    allows_outside : bool
        Whether files that it names may be read from outside its folder.

    Raises
    ------
    ValueError
        If it cannot be opened; the message is one sentence. Its kinds are MeshFileError and StateFileError.
    OpeningCancelledError
        If ``is_cancelled()``.
    """
    built_in = ALL_SCENES.get(target)
    if built_in is not None:
        settings = settings_from_texts(built_in.settings, STEPPED)
        document = open_document(built_in.make(), built_in.title, settings=settings)
        if built_in.opens.triangle is not None:
            document = focus_on(document, built_in.opens.triangle)
        return Opened(document, place=built_in.opens)
    path = Path(target)
    if not target or (not path.suffix and not path.exists()):
        known = ", ".join(ALL_SCENES)
        raise MeshFileError(
            f"there is no file and no built-in scene named '{target}'; the built-in scenes are {known}"
        )
    path = path.absolute()
    if path.suffix.lower() == EXTENSION:
        state, warnings = load_state(path, progress, is_cancelled, allows_outside)
        check_memory(path, state.document.scene)
        document, why = shortened(state.document)
        if why:
            state, warnings = replace(state, document=document), (*warnings, why)
        return Opened(document, warnings, state, str(path))
    opened = open_mesh(target, progress, is_cancelled, allows_outside=allows_outside)
    check_memory(path, opened.scene)
    if isinstance(opened.scene, Scene):
        remember_file(path, opened.scene.meshes, allows_outside)
    return Opened(
        open_document(opened.scene, shown_name(path.stem), str(path)), opened.warnings, None, str(path)
    )


def check_memory(path: Path, scene: AnyScene) -> None:
    """Raise MeshFileError for a file whose scene may not fit into the memory that is free."""
    try:
        check_drawing(scene)
    except MemoryBoundError as problem:
        raise MeshFileError(f"{path.name} is too large: {problem}") from problem
