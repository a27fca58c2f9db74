"""What a look shows of a scene, to be read: signs of w, closedness, layers, texels, colours, light."""

from collections.abc import Callable

import numpy as np

from core.geometry.outcodes import PLANE_BITS, has_bits, joined_bits, outcodes
from core.records.arrays import Floats, Integers
from core.scene import AnyScene, Scene
from core.stages.closed_meshes import is_closed
from core.study.planner.bounds.color_ranges import ColorRanges, normal_cones, w_ratio
from core.study.planner.bounds.texture_ranges import step_text
from core.study.planner.records import Fact
from core.study.planner.scene_analysis.conservative_coverage import Touched
from core.study.planner.scene_analysis.convexity import is_convex
from core.study.planner.scene_analysis.surfaces import format_margin, surfaces


def facts_of(touched: Touched, colors: ColorRanges, scene: AnyScene) -> tuple[Fact, ...]:
    """Return the facts in pipeline order."""
    geometry = touched.geometry
    w = geometry.assembled.vertex_clip[3].take(geometry.assembled.corner)
    negative = int(np.count_nonzero((w <= 0).any(axis=0)))
    cut = joined_bits(outcodes(geometry.assembled.vertex_clip.T), geometry.assembled.corner)
    seen = surfaces(touched, colors, scene.background, format_margin("z-float32"))
    layers = np.bincount(touched.pixel[seen.is_candidate], minlength=touched.pixel_count)
    primitive = np.unique(touched.primitive[seen.is_candidate])
    facts = [
        Fact("triangles", "Triangles", f"{w.shape[1]:,}"),
        Fact("w-signs", "Triangles with a corner that is not in front of the eye", f"{negative:,}"),
        Fact(
            "cut",
            "Triangles that cross a plane of the view volume, or lie beyond one",
            _count(has_bits(cut, PLANE_BITS)),
        ),
        Fact(
            "w-ratio",
            "Largest ratio of w in a triangle",
            f"{w_ratio(touched)[primitive].max(initial=1.0):.4g}",
        ),
        Fact("closed", "Closed meshes", _those(scene, is_closed)),
        Fact("convex", "Closed and convex meshes", _those(scene, is_convex)),
        Fact("layers", "Triangles that may be seen in a pixel, at most", f"{int(layers.max(initial=0)):,}"),
        Fact("depth-range", "Window depth", _depth_range(touched)),
        Fact(
            "contrast", "Pixels in which what can be seen differs by more than 2/255", _count(seen.width > 2)
        ),
        Fact(
            "largest-contrast", "Largest difference within a pixel", f"{seen.width.max(initial=0.0):.3g}/255"
        ),
    ]
    lod = colors.lod[seen.is_candidate]
    if np.isfinite(lod).any():
        longest = float(lod[np.isfinite(lod)].max())
        facts.append(Fact("texels", "Longest step of a pixel in a texture", step_text(longest)))
    if "normal" in geometry.primitives.layout:
        radius = normal_cones(touched).radius[primitive]
        angle = f"{np.degrees(radius.max(initial=0.0)):.3g} degrees"
        facts.append(Fact("normals", "Largest angle of a normal from the middle of its triangle", angle))
    return tuple(facts)


def _count(flags: np.ndarray) -> str:
    return f"{int(np.count_nonzero(flags)):,} of {flags.size:,}"


def _depth_range(touched: Touched) -> str:
    depth = touched.geometry.depth
    depth = depth[np.isfinite(depth)]
    if not depth.size:
        return "nothing is in view"
    nearest, farthest = float(depth.min()), float(depth.max())
    return f"{nearest:.6g} to {farthest:.6g}, {(farthest - nearest) * (2**16 - 1):,.0f} steps of 16 bits"


def _those(scene: AnyScene, is_one: Callable[[Floats, Integers], bool]) -> str:
    """Return how many meshes are such."""
    if not isinstance(scene, Scene):
        return "not known: triangles given one by one"
    found = sum(is_one(mesh.positions, mesh.triangles) for mesh in scene.meshes)
    return f"{found:,} of {len(scene.meshes):,}"
