"""Which boxes hide others: chosen by their size on screen, drawn as a pass, and compared with those in the frustum."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from core.culling.culling import PLANES
from core.culling.object_culling import ObjectCulling
from core.culling.occlusion import BoxesOnScreen, Occlusion, rectangles
from core.methods import table
from core.records.arrays import Floats, Integers
from core.records.frame import StageCount
from core.records.passes import PlannedPass, without_passes
from core.resolved import resolve
from core.scene import Scene
from core.settings import Settings
from core.stages.chosen_triangles import with_triangles
from core.stages.declared import STAGES
from core.stages.fragments import nearest_stored, stored_at
from core.stages.geometry import Geometry, farthest_from_grid
from core.stages.object_tree import BEYOND
from core.stages.passes import drawn_depth
from core.stages.vertices import process_geometry

OF_BOXES = ("object_culling", "hierarchy")
"""Families whose functions may be replaced, and something is hidden still: fragments do not depend on them."""


@dataclass(frozen=True, eq=False)
class Chosen:
    """The occluders of a picture."""

    boxes: BoxesOnScreen
    """All boxes that the frustum keeps."""
    occluders: Integers
    """See `Occlusion`, as the next two."""
    why_none: str
    planned: PlannedPass | None
    """What draws them; ``None``: there are none."""


def why_nothing_hides(settings: Settings) -> str:
    """Return why an object behind others may be seen with some settings, as a sentence; empty: it is not."""
    resolved = resolve(settings)
    if any(family not in OF_BOXES for family in settings.replacements):
        return "A listing is edited, and what its fragments store is not known before they are drawn."
    if "depth_test_time" not in resolved.method("visibility").takes:
        return "The method of visibility tests no depth fragment by fragment, so what is behind may be seen."
    if resolved.is_outlined:
        return "Lines and points are drawn, which have no area to hide anything with."
    if resolved.is_mixed:
        return "Colours are blended, so what lies behind may show through."
    if not resolved.samples_centers:
        sampled = (
            "Pixels get their covered area" if resolved.sampling.is_area else "Samples lie beside the centres"
        )
        return f"{sampled}, and the pyramid knows the depth at centres only."
    if not resolved.numbers.suits_spans or "projected" in table.get("fill", resolved.fill_name).needs:
        return "These edge functions or this fill may cover pixels beside a triangle."
    return ""


@lru_cache(maxsize=4)
def choose_occluders(scene: Scene, settings: Settings) -> Chosen:
    """Choose the boxes that cover most pixels, and plan to draw their depth.

    Parameters
    ----------
    scene : Scene
        With its meshes deformed and cut.
    """
    in_frustum, whole = _without_occlusion(scene, settings)
    boxes, why_none = boxes_on_screen(in_frustum, whole), why_nothing_hides(settings)
    pixels = boxes.pixel_count
    order = np.argsort(-pixels, kind="stable")[: settings.occluders]
    order = order[pixels[order] > 0]
    if not why_none and not len(order):
        why_none = "No box that the frustum keeps lies wholly behind the near plane."
    if why_none:
        return Chosen(boxes, np.empty(0, np.int64), why_none, None)
    tree = in_frustum.tree
    drawn = np.unique(np.concatenate([tree.items_of(node) for node in boxes.node[order].tolist()]))
    own = without_passes(settings)
    plain = replace(own, object_culling="none", shading="unlit", antialiasing="none", presentation="none")
    shown = with_triangles(scene, drawn)
    return Chosen(boxes, order, "", PlannedPass("occluders", "The occluders", shown, plain))


def _without_occlusion(scene: Scene, settings: Settings) -> tuple[ObjectCulling, Geometry]:
    """Return what the frustum keeps, and all that would be drawn if no object were dropped."""
    found = []
    for name in ("frustum", "none"):
        counts = {stage: StageCount() for stage in STAGES}
        found.append(process_geometry(scene, replace(settings, object_culling=name), counts))
    assert found[0].culled.objects is not None
    return found[0].culled.objects, found[1]


def boxes_on_screen(objects: ObjectCulling, whole: Geometry) -> BoxesOnScreen:
    """Return where the boxes that the frustum keeps lie on screen.

    Parameters
    ----------
    whole : Geometry
        Of all that would be drawn if no object were dropped.
    """
    node, near = objects.kept_leaves, PLANES.index("near")
    is_before = objects.sides.near[node, near] <= objects.sides.slack[node, near]
    depth_format, (width, height) = resolve(whole.settings).depth_format, whole.vertices.size
    reach = BEYOND + farthest_from_grid(
        whole.window, whole.primitives.vertex_clip, whole.vertices.size, whole.shift
    )
    clip = _corners_in_clip(objects, node[~is_before], whole)
    w = clip[..., 3]
    places = np.stack(
        [
            (clip[..., 0] / w + 1) * (width / 2),
            (clip[..., 1] / w + 1) * (height / 2),
            stored_at(whole, clip.reshape(-1, 4), depth_format).astype(np.float64).reshape(w.shape),
        ],
        axis=-1,
    )
    corners, rectangle = np.zeros((len(node), 8, 3)), np.zeros((len(node), 4), np.int64)
    corners[~is_before] = places
    rectangle[~is_before] = rectangles(places[..., :2], reach, whole.vertices.size)
    nearer = np.maximum if depth_format.larger_is_nearer else np.minimum
    farthest = -np.inf if depth_format.larger_is_nearer else np.inf
    of_triangle = np.full(len(whole.vertices.corners), farthest)
    bound = nearest_stored(whole, depth_format, reach).astype(np.float64)
    nearer.at(of_triangle, whole.primitives.triangle, bound)
    of_corners = nearer.reduce(corners[..., 2], axis=1)
    nearest = of_corners.copy()
    for place in np.flatnonzero(~is_before).tolist():
        held = objects.tree.items_of(int(node[place]))
        nearest[place] = nearer(nearest[place], nearer.reduce(of_triangle[held]))
    size = whole.vertices.size
    return BoxesOnScreen(node, is_before, corners, reach, size, rectangle, of_corners - nearest, nearest)


def _corners_in_clip(objects: ObjectCulling, node: Integers, whole: Geometry) -> Floats:
    """Return the corners (B, 8, 4) of boxes in clip space; bit k of a corner's number is the upper end of axis k."""
    vertices, tree = whole.vertices, objects.tree
    assert vertices.projection is not None
    assert vertices.view is not None
    ends = np.stack([tree.lower[node], tree.upper[node]], axis=1)
    corner = np.arange(8)
    world = np.stack([ends[:, corner >> axis & 1, axis] for axis in range(3)], axis=-1)
    to_clip = vertices.projection @ vertices.view
    return np.asarray(sum(world[..., k, None] * to_clip[:, k] for k in range(3)) + to_clip[:, 3])


def occlusion_of(scene: Scene, settings: Settings) -> Occlusion:
    """Compare the boxes that the frustum keeps with the occluders of a picture."""
    chosen, depth_format = choose_occluders(scene, settings), resolve(settings).depth_format
    width, height = scene.size
    depth = np.full((height, width), float(depth_format.cleared))
    if chosen.planned is not None:
        depth = drawn_depth(chosen.planned)
    tests = (
        resolve(settings)
        .method("object_culling")
        .function(chosen.boxes, depth, depth_format.larger_is_nearer)
    )
    return Occlusion(chosen.boxes, chosen.occluders, chosen.why_none, depth_format.larger_is_nearer, tests)
