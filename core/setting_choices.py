"""The families of methods that settings choose from, in pipeline order: a field of each."""

from dataclasses import dataclass
from typing import Any

from core.families import choice

OF_HISTORY: Any = {"taken_by": "antialiasing", "otherwise": "Only temporal antialiasing keeps a history."}


@dataclass(frozen=True)
class Choices:
    """A method of every family, by its name in ``core.methods.table``; `core.settings.Settings` checks them."""

    skinning: str = choice(
        "linear", "Skinning", "transform", "core.deformation.skinning", asks=("listing",), is_look=True
    )
    tessellation: str = choice(
        "uniform", "Tessellation", "transform", "core.tessellation.segments", asks=("listing",)
    )
    cull: str = choice(
        "none",
        "Cull",
        "cull",
        "core.culling.culling",
        "core.culling.normal_view",
        is_look=True,
        classical=("none", "back"),
    )
    object_culling: str = choice("none", "Object culling", "cull", "core.culling.object_culling")
    hierarchy: str = choice(
        "bvh",
        "Hierarchy",
        "cull",
        "core.trees.bounding_volumes",
        "core.trees.octree",
        asks=("listing", "operations"),
        taken_by="object_culling visibility",
        otherwise="Only culling of objects and rays with a tree have boxes.",
    )
    clipping: str = choice(
        "homogeneous",
        "Clipping",
        "clip",
        "core.clipping.planes",
        classical=("homogeneous", "sutherland-hodgman"),
    )
    coverage: str = choice(
        "snapped", "Edge functions", "edges", "core.coverage.edge_formats", "core.coverage.edges"
    )
    fill_rule: str = choice(
        "shared-edge",
        "Fill rule",
        "raster",
        "core.coverage.fill_rule",
        classical=("shared-edge", "inclusive", "exclusive"),
        taken_by="polygon_mode",
        otherwise="Wireframes are not filled.",
    )
    fill: str = choice(
        "spans",
        "Fill",
        "raster",
        "core.coverage.fills",
        "core.coverage.scanline",
        "core.spans.fill",
        taken_by="polygon_mode",
        otherwise="Wireframes are not filled.",
        classical=("bounding-box", "blocks", "scanline"),
    )
    polygon_mode: str = choice(
        "fill",
        "Polygons",
        "raster",
        "core.coverage.polygon_mode",
        is_look=True,
        classical=("fill", "wireframe"),
    )
    line: str = choice(
        "bresenham",
        "Lines",
        "raster",
        "core.lines.bresenham",
        "core.lines.dda",
        "core.lines.diamond_exit",
        "core.lines.rectangle",
        "core.lines.smooth",
        taken_by="polygon_mode",
        otherwise="Only wireframes draw lines.",
        asks=("listing", "operations"),
        is_look=True,
        classical=("bresenham", "dda", "wu"),
    )
    line_clipping: str = choice(
        "none",
        "Line clipping",
        "raster",
        "core.lines.line_clipping",
        "core.lines.cohen_sutherland",
        "core.lines.parametric_clipping",
        taken_by="polygon_mode",
        otherwise="Only wireframes draw lines.",
        classical=("cohen-sutherland", "liang-barsky", "cyrus-beck"),
    )
    polygon_clipping: str = choice(
        "none",
        "Polygon clipping",
        "clip",
        "core.clipping.rings",
        "core.clipping.weiler_atherton",
        classical=("sutherland-hodgman", "weiler-atherton"),
    )
    polygon_fill: str = choice(
        "even-odd",
        "Polygon fill",
        "raster",
        "core.coverage.active_edges",
        asks=("listing", "operations"),
        is_look=True,
        classical=("even-odd", "non-zero"),
    )
    pixel_center: str = choice("half", "Pixel centres", "raster", "core.coverage.pixel_runs", is_look=True)
    interpolation: str = choice(
        "perspective",
        "Interpolation",
        "interpolate",
        "core.interpolation.interpolation",
        "core.interpolation.corrected_affine",
        asks=("listing", "operations", "traits"),
        classical=("perspective", "affine", "flat"),
    )
    provoking: str = choice(
        *("last", "Provoking vertex", "interpolate", "core.interpolation.interpolation"),
        taken_by="interpolation",
        otherwise="Only flat interpolation takes one corner's value.",
        is_look=True,
    )
    texture_filter: str = choice(
        "bilinear",
        "Texture filter",
        "shade",
        "core.textures.look_up",
        "core.textures.mipmaps",
        asks=("listing", "operations"),
        classical=("nearest", "bilinear", "trilinear"),
    )
    wrap: str = choice(
        "repeat", "Texture wrap", "shade", "core.textures.look_up", asks=("traits",), is_look=True
    )
    shading: str = choice(
        "phong",
        "Shading",
        "shade",
        "core.shading.shading",
        asks=("traits",),
        is_look=True,
        classical=("flat", "gouraud", "phong"),
    )
    shadow: str = choice(
        "none",
        "Shadows",
        "shade",
        "core.shading.shadows",
        "core.shading.shadow_rays",
        taken_by="shading",
        otherwise="Shadows fall where light is computed at every fragment: choose Phong shading.",
        is_look=True,
    )
    environment: str = choice(
        "none",
        "Reflections",
        "shade",
        "core.shading.environment",
        "core.shading.mirror_rays",
        taken_by="shading",
        otherwise="Mirrors show what is around them where light is computed at every fragment: choose Phong shading.",
        is_look=True,
    )
    visibility: str = choice(
        "z-buffer",
        "Visibility",
        "depth",
        "core.visibility.painters",
        "core.visibility.ray_casting",
        "core.visibility.rays_by_pixel",
        "core.visibility.rays_in_tree",
        "core.visibility.scan_line",
        "core.visibility.bsp",
        classical=("z-buffer", "painters", "ray-casting"),
    )
    depth_test_time: str = choice(
        "late",
        "Depth test",
        "depth",
        "core.depth.early_depth",
        asks=("listing",),
        taken_by="visibility",
        otherwise="Only methods that test the depth of each fragment can test it early.",
    )
    depth: str = choice(
        "z-float32",
        "Depth",
        "depth",
        "core.depth.depth",
        "core.depth.formats",
        "core.depth.fixed_depth",
        classical=("z-float32", "z-16", "inverse-w"),
    )
    blend: str = choice(
        "opaque",
        "Blending",
        "blend",
        "core.framebuffer.blending",
        asks=("operations", "traits"),
        is_look=True,
    )
    antialiasing: str = choice(
        "none",
        "Antialiasing",
        "resolve",
        "core.antialiasing.sampling",
        classical=("none", "ssaa-4", "msaa-4"),
    )
    resolve_filter: str = choice(
        "box",
        "Resolve filter",
        "resolve",
        "core.antialiasing.resolve",
        taken_by="antialiasing",
        otherwise="Only several samples per pixel are filtered.",
    )
    history: str = choice("reprojected", "History", "resolve", "core.antialiasing.history", **OF_HISTORY)
    presentation: str = choice(
        "none", "Presentation", "resolve", "core.framebuffer.presentation", is_look=True
    )
    flush: str = choice(
        "by-row",
        "Flushing",
        "resolve",
        "core.framebuffer.flushing",
        asks=("listing",),
        taken_by="presentation",
        otherwise="Only pictures that are presented on a screen are flushed.",
        is_look=True,
    )
