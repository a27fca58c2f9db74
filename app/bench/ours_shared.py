"""The core on two processes, as a contender of its own: large meshes only, others are not worth it."""

from contextlib import ExitStack

from app.bench.ours import DISTRIBUTION, prepare_mesh
from app.bench.records import Contender, Prepared, UnavailableError, ViewedMesh, Work
from core.fast_path.workers.band_workers import BandWorkers
from core.fast_path.workers.sharing import Sharing

__all__ = ["DISTRIBUTION", "LIBRARY", "contender"]

PROCESSES = 2
LIBRARY = f"Rasterscope, {PROCESSES} processes"
LARGE = 10_000
"""Triangles of a mesh that is drawn by several processes here."""
SETTLING = 8
"""Pictures until the bands take the same time."""


def contender(work: Work) -> Contender | None:
    """Return the core drawing ``work`` with a worker process, if it is a large mesh."""
    if isinstance(work, ViewedMesh) and len(work.triangles) >= LARGE:
        return Contender(LIBRARY, "ours", lambda stack: prepare(work, stack))
    return None


def prepare(work: ViewedMesh, stack: ExitStack) -> Prepared:
    """Start the worker, and draw until the bands have found their places."""
    workers = stack.enter_context(BandWorkers(PROCESSES, always=True))
    if not workers.start():
        raise UnavailableError(workers.failure)
    prepared = prepare_mesh(work, workers.draw)
    for _ in range(SETTLING):
        prepared.run()
    return Prepared(prepared.run, lambda: f"{prepared.tell()}; {sharing_text(workers.sharing)}")


def sharing_text(sharing: Sharing) -> str:
    """Return who drew which rows of the last picture, and how long that took."""
    if not sharing.bands:
        return f"one process, because {sharing.reason}"
    return ", ".join(
        f"rows {band.first}-{band.end - 1} {1000 * band.seconds:.1f} ms" for band in sharing.bands
    )
