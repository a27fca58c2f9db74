"""Scenes of curves and patches cut into segments and triangles, as the settings say."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from core.methods import table
from core.records.arrays import Floats, Integers
from core.records.curves import Curves
from core.records.words import counted
from core.scene import ClipScene, Mesh, Scene
from core.settings import Settings
from core.tessellation.bezier import levels, shares
from core.tessellation.patches import PatchGrid, cut_mesh, patch_grid
from core.tessellation.segments import TOLERANCE_PARTS, CurveSteps
from core.transform.matrices import projection, transform, world_to_camera

MOST_SEGMENTS, MOST_TRIANGLES = 20_000, 1_000_000
"""Segments that curves are cut into at most, and triangles that patches are."""
SEGMENT_BYTES, TRIANGLE_BYTES = 11_000, 1_200
"""Bytes that a segment takes once it is stepped, and a triangle once it is drawn (measured)."""

Cut = Callable[[Floats], CurveSteps]


@dataclass(frozen=True, eq=False)
class Tessellated:
    """A scene with its curves or patches cut, and where the V vertices of the cut ones lie on them."""

    scene: Scene | ClipScene
    cuts: tuple[CurveSteps, ...]
    """Of every curve; of every patch one for its first index and one for its second."""
    owner: Integers
    """(V,) int64, the curve or patch of each vertex of the scene, counted over all meshes; -1: of a mesh without."""
    step: Integers
    """(V, k) int64, t = step / steps: k = 1 of curves, 2 of patches."""
    steps: Integers
    """(V, k) int64."""
    control: Floats
    """(C, D + 1, 4) of curves in clip space, (P, 4, 4, 3) of patches in object space."""


def window_rows(clip: Floats, size: tuple[int, int]) -> Floats:
    """Return homogeneous window positions (..., 3), x w, y w and w in pixels, of clip positions (..., 4)."""
    x, y, w = clip[..., 0], clip[..., 1], clip[..., 3]
    return np.stack([(x + w) * (size[0] / 2), (y + w) * (size[1] / 2), w], axis=-1)


def cutter(settings: Settings) -> Cut:
    """Return how curves (R, D + 1, 3) in homogeneous window positions are cut together."""
    function = table.get("tessellation", settings.tessellation).function
    tolerance = settings.curve_tolerance / TOLERANCE_PARTS
    return lambda rows: function(rows, settings.segments, tolerance)


def cut_curves(scene: ClipScene, settings: Settings) -> Tessellated:
    """Return the scene with its curves as line strips; ValueError where these are too many segments."""
    curves, cut = scene.curves, cutter(settings)
    assert curves is not None
    check_uniform(settings, len(curves.control), is_patches=False)
    cuts = tuple(cut(window_rows(each, scene.size)[None]) for each in curves.control)
    counts = np.array([len(each.step) - 1 for each in cuts])
    check_count(int(counts.sum()), MOST_SEGMENTS, settings)
    made, owner, step, steps = curve_points(curves, cuts)
    # Every curve's ends, then every segment's: the next point of the same curve.
    last = np.cumsum(counts + 1) - 1
    start = np.delete(np.arange(len(made)), last)
    ends = np.stack([start, start + 1], axis=1)
    # Curves that meet in a point share it.
    _, names = np.unique(made, axis=0, return_inverse=True)
    vertex = ends.ravel()
    cut_scene = replace(
        scene,
        clip=made[ends],
        attributes=np.repeat(curves.colors[owner[start], None], 2, axis=1),
        shared=names.reshape(-1)[ends],
    )
    return Tessellated(
        cut_scene, cuts, owner[vertex], step[vertex, None], steps[vertex, None], curves.control
    )


def curve_points(curves: Curves, cuts: Sequence[CurveSteps]) -> tuple[Floats, Integers, Integers, Integers]:
    """Return the points (N, 4) of curves at their cuts; curve, step and steps (N,) of each."""
    owner = np.repeat(np.arange(len(cuts)), [len(each.step) for each in cuts])
    step = np.concatenate([each.step for each in cuts])
    steps = np.array([each.steps for each in cuts])[owner]
    return levels(*shares(step, steps), curves.control[owner])[-1][:, 0], owner, step, steps


def cut_patches(scene: Scene, settings: Settings) -> Tessellated:
    """Return the scene with its patches as triangles; ValueError where these are too many."""
    cut = cutter(settings)
    check_uniform(
        settings, sum(len(m.patches) for m in scene.meshes if m.patches is not None), is_patches=True
    )
    to_clip = projection(scene.camera, scene.size[0] / scene.size[1])
    cuts: list[CurveSteps] = []
    of_meshes: list[tuple[tuple[bytes, int], ...]] = []
    count = 0
    for mesh in scene.meshes:
        here: list[CurveSteps] = []
        if mesh.patches is not None:
            ones = np.ones((*mesh.patches.shape[:-1], 1))
            world = transform(mesh.transform, np.concatenate([mesh.patches, ones], axis=-1))
            clip = transform(to_clip, transform(world_to_camera(scene.camera), world))
            for net in window_rows(clip, scene.size):
                here += [cut(np.swapaxes(net, 0, 1)), cut(net)]
            count += sum(
                2 * (len(one.step) - 1) * (len(two.step) - 1)
                for one, two in zip(here[::2], here[1::2], strict=True)
            )
            check_count(count, MOST_TRIANGLES, settings)
        of_meshes.append(tuple((each.step.tobytes(), each.steps) for each in here))
        cuts += here
    meshes, grids = _cut_meshes(scene.meshes, tuple(of_meshes))
    places: list[tuple[Integers, Integers, Integers]] = []
    first = 0
    for mesh, grid in zip(meshes, grids, strict=True):
        if grid is None:
            none = np.full((len(mesh.positions), 2), -1)
            places.append((none[:, 0], none, none))
            continue
        places.append((grid.patch + first, grid.step, grid.steps))
        first += int(grid.patch[-1]) + 1
    control = np.concatenate([mesh.patches for mesh in meshes if mesh.patches is not None])
    owner, step, steps = (np.concatenate(parts) for parts in zip(*places, strict=True))
    return Tessellated(replace(scene, meshes=meshes), tuple(cuts), owner, step, steps, control)


@lru_cache(maxsize=4)
def _cut_meshes(
    meshes: tuple[Mesh, ...], cuts: tuple[tuple[tuple[bytes, int], ...], ...]
) -> tuple[tuple[Mesh, ...], tuple[PatchGrid | None, ...]]:
    """Return meshes with their patches cut: the same ones for the same cuts, whatever the camera."""
    made: list[Mesh] = []
    grids: list[PatchGrid | None] = []
    for mesh, of_mesh in zip(meshes, cuts, strict=True):
        pairs = [(np.frombuffer(step, np.int64), steps) for step, steps in of_mesh]
        grid = patch_grid(list(zip(pairs[::2], pairs[1::2], strict=True))) if pairs else None
        made.append(mesh if grid is None else cut_mesh(mesh, grid))
        grids.append(grid)
    return tuple(made), tuple(grids)


def check_uniform(settings: Settings, count: int, *, is_patches: bool) -> None:
    """Refuse a number of equal steps that makes too many primitives, before any is made."""
    if "curve_tolerance" in table.get("tessellation", settings.tessellation).takes:
        return
    segments = settings.segments
    made = 2 * count * segments**2 if is_patches else count * segments
    check_count(made, MOST_TRIANGLES if is_patches else MOST_SEGMENTS, settings)


def check_count(made: int, most: int, settings: Settings) -> None:
    """Refuse more primitives than are made, in a sentence with what they would take."""
    if made <= most:
        return
    noun, size = ("segment", SEGMENT_BYTES) if most == MOST_SEGMENTS else ("triangle", TRIANGLE_BYTES)
    by = f"{settings.segments:,} segments" if "curve_tolerance" not in _takes(settings) else "this tolerance"
    raise ValueError(
        f"{by} would make {counted(made, noun)}, about {made * size / 2**30:,.1f} GiB; "
        f"at most {most:,} are made: choose fewer segments or a larger tolerance"
    )


def _takes(settings: Settings) -> tuple[str, ...]:
    return table.get("tessellation", settings.tessellation).takes
