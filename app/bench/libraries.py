"""The libraries that take part, each a module with ``LIBRARY``, ``DISTRIBUTION`` and ``contender(work)``."""

from importlib.metadata import PackageNotFoundError, version
from types import ModuleType

from app.bench import (
    cold_start,
    matplotlib_peer,
    numba_peer,
    opencv_peer,
    opengl_peer,
    ours,
    ours_child,
    ours_shared,
    pillow_peer,
    skimage_peer,
    trimesh_peer,
    typed_text,
    vtk_peer,
)
from app.bench.contender import Contender
from app.bench.records import ColdStart, TypedPicture, Work

LIBRARIES: tuple[ModuleType, ...] = (
    *(ours, ours_shared, ours_child, vtk_peer, opengl_peer, numba_peer, opencv_peer),
    *(pillow_peer, skimage_peer, matplotlib_peer, trimesh_peer, typed_text),
)
"""All of them, ours first. VTK ends every EGL context that was opened before its own: it must begin before OpenGL."""


def contender_of(library: ModuleType, work: Work) -> Contender | None:
    """Return a library drawing a workload, or ``None`` where it has no way to."""
    if isinstance(work, ColdStart):
        return cold_start.contender(library, work)
    if isinstance(work, TypedPicture) and library not in (ours, typed_text):
        return None
    found: Contender | None = library.contender(work)
    return found


def version_of(library: ModuleType) -> str:
    """Return name and version of the distribution that a library comes from; for ours, of what it is built on."""
    try:
        return f"{library.DISTRIBUTION} {version(library.DISTRIBUTION)}"
    except PackageNotFoundError:
        return f"{library.DISTRIBUTION} (not installed)"
