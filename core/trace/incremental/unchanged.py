"""What an edit left alone: found by comparing everything that a primitive's pixels are made from, bit for bit."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.raster.pixel_runs import Runs, expand
from core.records.alike import is_alike
from core.records.arrays import Flags, Integers
from core.scene import AnyScene, ClipScene
from core.stages.fragment_depth import logarithm_range
from core.stages.vertex_program import has_program
from core.trace.incremental.row_pieces import same_rows
from core.trace.source import TraceSource


def unchanged_primitives(now: TraceSource, before: TraceSource) -> Integers:
    """Return (P,) int64: the number that each primitive had in ``before`` if its pixels are the same, else -1."""
    numbers = np.full(len(now.geometry.primitives), -1)
    if not _are_comparable(now, before):
        return numbers
    index, index_before = _pairs(now, before)
    same = np.ones(len(index), bool)
    for values, values_before in zip(_numbers_of(now), _numbers_of(before), strict=True):
        same &= same_rows(values[index], values_before[index_before])
    index, index_before = index[same], index_before[same]
    same = _same_runs(now.runs, before.runs, index, index_before)
    numbers[index[same]] = index_before[same]
    return numbers


def _are_comparable(now: TraceSource, before: TraceSource) -> bool:
    """Return whether everything is the same that the pixels of all primitives depend on."""
    return (
        now.settings == before.settings
        and not (has_program(now.scene) or has_program(before.scene))
        and now.raster == before.raster
        and is_alike(_surroundings(now.scene), _surroundings(before.scene))
        and now.geometry.outlines is None
        and now.geometry.edges.numbers == before.geometry.edges.numbers
        and now.geometry.primitives.layout == before.geometry.primitives.layout
        and logarithm_range(now.geometry) == logarithm_range(before.geometry)
    )


def _surroundings(scene: AnyScene) -> tuple[Any, ...]:
    """Return what colours depend on beside the values at the corners."""
    if isinstance(scene, ClipScene):
        return (scene.texture,)
    return (scene.camera, scene.lights, *((mesh.material, mesh.texture) for mesh in scene.meshes))


def _pairs(now: TraceSource, before: TraceSource) -> tuple[Integers, Integers]:
    """Return numbers (C,) of primitives now and before that are the same piece of the same triangle."""
    triangles = now.geometry.primitives.triangle, before.geometry.primitives.triangle
    pieces = [_place_in_triangle(triangle) for triangle in triangles]
    most = max(int(piece.max(initial=0)) for piece in pieces) + 1
    key, key_before = (triangle * most + piece for triangle, piece in zip(triangles, pieces, strict=True))
    _, index, index_before = np.intersect1d(key, key_before, assume_unique=True, return_indices=True)
    return index, index_before


def _place_in_triangle(triangle: Integers) -> Integers:
    """Return (P,) int64, the index of each piece within its triangle (P,); pieces of a triangle are neighbours."""
    index = np.arange(len(triangle))
    is_first = np.append(True, triangle[1:] != triangle[:-1])[: len(triangle)]
    place: Integers = index - np.maximum.accumulate(np.where(is_first, index, 0))
    return place


def _numbers_of(source: TraceSource) -> list[NDArray[Any]]:
    """Return everything (P, ...) that the pixels of a primitive are made from, beside the pixels that are looked at."""
    geometry, kept = source.geometry, source.depth_format
    edges, planes = geometry.edges, geometry.planes
    found = [
        edges.a,
        edges.b,
        edges.c,
        edges.owns_tie,
        geometry.primitives.mesh,
        geometry.primitives.varyings,
    ]
    found += [planes.a, planes.b, planes.c, planes.determinant, planes.w, geometry.is_in_range]
    found += [*geometry.depth_plane, *geometry.inverse_w_plane]
    if kept.quantity.plane == "reversed-z":
        found += geometry.reversed_plane
    if kept.is_planar:
        fixed = geometry.fixed_planes
        found += [fixed.planes.origin, fixed.planes.across, fixed.planes.up, fixed.is_linear]
    return found


def _same_runs(now: Runs, before: Runs, index: Integers, index_before: Integers) -> Flags:
    """Return (C,) bool: the fill looks at the same pixels, in the same way, of primitives that are paired (C,)."""
    first, stop = (np.searchsorted(now.triangle, index, side) for side in ("left", "right"))
    first_before, stop_before = (
        np.searchsorted(before.triangle, index_before, side) for side in ("left", "right")
    )
    same: Flags = stop - first == stop_before - first_before
    pair, place = expand(np.where(same, stop - first, 0))
    at, at_before = first[pair] + place, first_before[pair] + place
    same_run = np.ones(len(pair), bool)
    for values, values_before in zip(_numbers_of_runs(now), _numbers_of_runs(before), strict=True):
        same_run &= same_rows(values[at], values_before[at_before])
    # Groups are counted through all primitives.
    same_run &= (
        now.group[at] - now.group[first[pair]] == before.group[at_before] - before.group[first_before[pair]]
    )
    same[pair[~same_run]] = False
    return same


def _numbers_of_runs(runs: Runs) -> list[NDArray[Any]]:
    """Return everything (R, ...) that is known of runs but whose they are; of one fill, always as much."""
    found: list[NDArray[Any]] = [runs.row, runs.start, runs.stop, runs.accepted]
    if runs.crossings is not None:
        found.append(runs.crossings)
    if runs.stepping is not None:
        found += [runs.stepping.value, runs.stepping.before, runs.stepping.added]
    return found
