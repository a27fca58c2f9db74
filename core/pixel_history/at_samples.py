"""The candidates at one of several samples of a pixel: the moved scene's pixel, or that of the finer picture."""

from core.antialiasing.sample_rasters import at_sample, finer_scene, finer_settings, in_squares
from core.pixel_history.candidates import PixelCandidates, whole_geometry
from core.records.frame import StageCount
from core.resolved import resolve
from core.scene import AnyScene
from core.settings import Settings
from core.stages.declared import STAGES
from core.stages.vertices import Geometry, process_geometry
from core.trace.source import TraceSource

_finer: list[tuple[AnyScene, Settings, AnyScene, Geometry]] = []
"""The last scene and settings that were asked about, the scene at n times its size, and its geometry."""


def candidates_at(
    source: TraceSource, column: int, row: int, triangle: int | None, sample: int
) -> PixelCandidates:
    """Return the candidates at one sample of a pixel; ``sample`` counts as in `core.records.frame.Samples`."""
    scene, settings = source.scene, source.settings
    side = resolve(settings).sampling.side
    if not side:
        whole = whole_geometry(source)
        moved = at_sample(whole, sample)
        return PixelCandidates(scene, settings, moved, column, row, triangle, whole)
    finer, geometry = _finer_geometry(scene, settings, side)
    up, across = divmod(sample, side)
    at = side * column + across, side * row + up
    return PixelCandidates(finer, finer_settings(settings), geometry, *at, triangle)


def _finer_geometry(scene: AnyScene, settings: Settings, side: int) -> tuple[AnyScene, Geometry]:
    """Return the scene at ``side`` times its size and its geometry; those of the last scene are kept."""
    for of_scene, of_settings, finer, known in _finer:
        if of_scene is scene and of_settings == settings:
            return finer, known
    finer = finer_scene(scene, side)
    counts = {stage: StageCount() for stage in STAGES}
    geometry = in_squares(process_geometry(finer, finer_settings(settings), counts), settings, side)
    _finer[:] = [(scene, settings, finer, geometry)]
    return finer, geometry
