"""The program's reader in a process of its own, as the window opens a file: the start of the process is part of it."""

from app.bench.ours import DISTRIBUTION, arrays_of
from app.bench.records import Contender, MeshFile, Work
from app.bench.workloads import prepare_reading
from app.files.mesh_files import load_meshes

__all__ = ["DISTRIBUTION", "LIBRARY", "contender"]

LIBRARY = "Rasterscope, child"


def contender(work: Work) -> Contender | None:
    """Return the program reading a file as its window does."""
    if not isinstance(work, MeshFile):
        return None
    return Contender(
        LIBRARY,
        "ours",
        lambda stack: prepare_reading(
            work, stack, lambda path: load_meshes(path, is_cancelled=lambda: False), arrays_of
        ),
    )
