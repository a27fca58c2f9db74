"""One pixel of any scene in every number format: how often each format covers it, and by which triangles.

A cell of a map tells of a whole picture, and a pixel may belong to one triangle, to both of a shared edge, or to none.
So the triangles that decide the pixel are looked for first: those that cover it in any format or in exact arithmetic,
those whose edge passes through its centre, and across the edge of a wrong decision the neighbour. Each format then
draws them: 0 times is a hole, once is right, twice is a double hit.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from core.coverage.edges import edge_value, set_up_edges
from core.coverage.measured_cover import Wanted, count_cover
from core.coverage.measured_pixel import DialReading, precision_dial, read_format
from core.coverage.measured_triangles import FORMATS
from core.coverage.pixel_runs import half, make_raster
from core.coverage.snapping import place_corners
from core.records.arrays import Flags, Integers
from core.records.frame import StageCount
from core.scene import ClipScene
from core.settings import Settings
from core.stages.bin_and_raster import covered
from core.stages.declared import STAGES
from core.stages.geometry import Geometry
from core.stages.vertices import process_geometry
from core.study.record import StudyCancelledError

MOST_SHOWN = 4
"""Triangles of a pixel that are read operation by operation; those that are decided wrongly come first."""
MOST_DRAWN = 4096
"""Triangles of a scene whose whole picture is drawn in every format too."""
Pixel = tuple[int, int]


@dataclass(frozen=True, eq=False)
class FormatAtPixel:
    """What one format makes of a pixel, and of the picture around it."""

    coverage: str
    """Name of the format, a method of the family ``coverage``."""
    count: int
    """How many triangles cover the pixel."""
    wanted: int
    """How many should."""
    wrong_count: int | None
    """Pixels of the whole picture that are covered too often or too seldom; ``None``: it was not drawn."""
    first_wrong: Pixel | None
    """The first of them, row by row from below."""
    readings: tuple[DialReading, ...]
    """Of every triangle of ``PixelInFormats.triangles``."""
    is_drawn: tuple[bool, ...]
    """Whether each of these triangles covers the pixel when it is drawn. Other than its reading only where it is
    culled, or the format needs corners in front of the eye, so that pieces are drawn which clipping made."""


@dataclass(frozen=True, eq=False)
class PixelInFormats:
    """One pixel of a run in every number format."""

    pixel: Pixel
    triangles: tuple[int, ...]
    """Those that decide the pixel and are shown."""
    is_culled: tuple[bool, ...]
    """Whether the run culls each of them."""
    is_touched: bool
    """Whether any triangle covers the pixel in any format; else the one shown is the nearest."""
    left_out: int
    """How many more decide it."""
    run_count: int | None
    """How often the run itself covers the pixel, by its own methods; ``None``: a method refuses the scene."""
    run_wanted: int
    fill_rule: str
    """That of the run, and of all formats."""
    formats: tuple[FormatAtPixel, ...]
    """In the order of ``FORMATS``: each by ``fill=bounding-box`` and without clipping."""


def pixel_in_formats(
    scene: ClipScene,
    settings: Settings,
    pixel: Pixel,
    wanted: Wanted,
    is_cancelled: Callable[[], bool] = lambda: False,
) -> PixelInFormats:
    """Draw a scene in every number format and look at one pixel.

    Parameters
    ----------
    settings : Settings
        Those of the run.
    pixel : (column, row)
    wanted : callable
        How often each pixel is to be covered, (H, W) int64, for a scene and settings.
    is_cancelled : callable
        Asked between formats.

    Raises
    ------
    StudyCancelledError
        When it was cancelled.
    ValueError
        If the scene has no such pixel, or no triangle.
    """
    if not (0 <= pixel[0] < scene.size[0] and 0 <= pixel[1] < scene.size[1]):
        raise ValueError(f"the pixel must be within {scene.size[0]} x {scene.size[1]}, got {pixel}")
    if not len(scene.clip):
        raise ValueError("expected a scene with triangles, got one without any")
    by_format = {method.partition("=")[2]: settings_in(settings, method) for method in FORMATS}
    covering: dict[str, Integers] = {}
    for name, chosen in by_format.items():
        _stop_if(is_cancelled)
        covering[name] = covering_triangles(scene, chosen, pixel)
    touching = covering_triangles(scene, replace(by_format["exact"], fill_rule="inclusive"), pixel)
    deciding = np.unique(np.concatenate([touching, *covering.values()]))
    first = deciding if len(deciding) else nearest_triangle(scene, pixel)
    shown = _worst_first(scene, pixel, first, settings.fill_rule)
    formats = []
    for name, chosen in by_format.items():
        _stop_if(is_cancelled)
        readings = tuple(read_format(name, scene, pixel, number, settings.fill_rule) for number in shown)
        is_drawn = tuple(bool((covering[name] == number).any()) for number in shown)
        right = wanted(scene, chosen)
        here = len(covering[name]), int(right[pixel[::-1]])
        formats.append(FormatAtPixel(name, *here, *_wrong_pixels(scene, chosen, right), readings, is_drawn))
    kept = _geometry_of(scene, by_format["exact"]).primitives.triangle
    return PixelInFormats(
        pixel,
        shown,
        tuple(number not in kept for number in shown),
        len(deciding) > 0,
        len(np.setdiff1d(deciding, shown)),
        _run_count(scene, settings, pixel),
        int(wanted(scene, settings)[pixel[::-1]]),
        settings.fill_rule,
        tuple(formats),
    )


def settings_in(settings: Settings, method: str) -> Settings:
    """Return the settings of a run in another format, ``coverage=name``: every pixel tested, nothing clipped."""
    return replace(settings, coverage=method.partition("=")[2], fill="bounding-box", clipping="homogeneous")


def covering_triangles(scene: ClipScene, settings: Settings, pixel: Pixel) -> Integers:
    """Return the triangles (N,) int64 that cover one pixel, a triangle as often as it does.

    Raises ValueError if a method does not take the scene.
    """
    geometry = _geometry_of(scene, settings)
    raster = make_raster(scene.size, settings.pixel_center, (*pixel, 1, 1))
    parts = [fragments.primitive for fragments in covered(geometry, raster, _counts())]
    primitive = np.concatenate([np.empty(0, np.int64), *parts])
    return geometry.primitives.triangle.take(primitive)


def _geometry_of(scene: ClipScene, settings: Settings) -> Geometry:
    return process_geometry(scene, settings, _counts())


def _counts() -> dict[str, StageCount]:
    return {stage: StageCount() for stage in STAGES}


def nearest_triangle(scene: ClipScene, pixel: Pixel) -> Integers:
    """Return, as (1,) int64, the triangle whose farthest edge leaves the least of the centre outside, in float64."""
    edges = set_up_edges(place_corners(scene.clip, scene.size, "float64"), "shared-edge")
    x, y = (np.array([[index + half()]]) for index in pixel)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        value = edge_value(edges.a, edges.b, edges.c, x, y)
        inside = (value / np.hypot(edges.a, edges.b)).min(axis=1)
    return np.array([np.argmax(np.where(np.isnan(inside), -np.inf, inside))])


def sharing_edge(scene: ClipScene, triangle: int, edge: int) -> Flags:
    """Return (T,) bool, which triangles have both ends of an edge of ``triangle``, itself among them."""
    first, second = scene.clip[triangle, edge - 2], scene.clip[triangle, edge - 1]
    has_first = (scene.clip == first).all(axis=2).any(axis=1)
    found: Flags = has_first & (scene.clip == second).all(axis=2).any(axis=1)
    return found


def _worst_first(scene: ClipScene, pixel: Pixel, deciding: Integers, fill_rule: str) -> tuple[int, ...]:
    """Return at most `MOST_SHOWN` triangles: wrong decisions and their neighbours, then the others."""
    wrong: list[int] = []
    for number in deciding[: 4 * MOST_SHOWN].tolist():
        readings = precision_dial(scene, pixel, number, fill_rule)
        edges = {reading.edge for reading in readings if not reading.is_right}
        for edge in sorted(edges):
            wrong += [number, *np.flatnonzero(sharing_edge(scene, number, edge)).tolist()]
    shown = list(dict.fromkeys([*wrong, *deciding.tolist()]))[:MOST_SHOWN]
    return tuple(sorted(shown))


def _wrong_pixels(scene: ClipScene, settings: Settings, wanted: Integers) -> tuple[int | None, Pixel | None]:
    """Draw a scene that is not large: how many pixels are not as ``wanted``, (H, W) int64, and the first of them."""
    if len(scene.clip) > MOST_DRAWN:
        return None, None
    cover, _ = count_cover(scene, settings)
    rows, columns = np.nonzero(cover != wanted)
    return len(rows), (int(columns[0]), int(rows[0])) if len(rows) else None


def _run_count(scene: ClipScene, settings: Settings, pixel: Pixel) -> int | None:
    """Return how often a run covers the pixel: all of it is drawn, since sums may drift from where a row begins."""
    try:
        cover, _ = count_cover(scene, settings)
    except ValueError:
        # A method that refuses the scene covers nothing; the verdict of the cell says why.
        return None
    return int(cover[pixel[::-1]])


def _stop_if(is_cancelled: Callable[[], bool]) -> None:
    if is_cancelled():
        raise StudyCancelledError("the reading was cancelled")
