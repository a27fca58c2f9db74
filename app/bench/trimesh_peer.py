"""trimesh: reads meshes; here without the merging of vertices that it offers behind that."""

from contextlib import ExitStack
from pathlib import Path
from typing import Any

from app.bench.records import Contender, Floats, Integers, MeshFile, Prepared, Work
from app.bench.workloads import prepare_reading

LIBRARY = "trimesh"
DISTRIBUTION = "trimesh"


def contender(work: Work) -> Contender | None:
    """Return trimesh reading a file, or ``None`` for anything else."""
    if not isinstance(work, MeshFile):
        return None
    return Contender(LIBRARY, "reader", lambda stack: prepare(work, stack), "no checks of what it reads")


def prepare(work: MeshFile, stack: ExitStack) -> Prepared:
    """Import the library."""
    import trimesh

    def read(path: Path) -> Any:
        return trimesh.load_scene(path, process=False)

    def arrays_of(scene: Any) -> tuple[Floats, Integers]:
        (mesh,) = scene.geometry.values()
        return mesh.vertices, mesh.faces

    return prepare_reading(work, stack, read, arrays_of)
