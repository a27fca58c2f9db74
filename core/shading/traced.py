"""Trace of texturing and shading: texels, their mix, every light, and the colour of every fragment."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from core.depth.traced_early import without_hidden
from core.interpolation.interpolation import ValueRule
from core.lines.wireframe import LineFragments, line_parameter, values_at_ends
from core.lines.wireframe_fragments import affine_line_slopes_at, line_slopes_at
from core.methods import table
from core.records.arrays import Floats, Integers
from core.records.listing import RETURN, EditedListing, Labels, Listing, Operation, listing
from core.records.primitives import interpolation_form
from core.records.steps import Steps, ends_of
from core.scene import ClipScene, Scene, Texture
from core.shading.lighting import blinn_phong, plain_lights, plain_material, trace_lighting
from core.shading.shading import LightRule, shaded_color, textured_albedo, unlit_color
from core.shading.traced_environment import is_mirror, mirror_columns, mirror_listings, mirror_operations
from core.shading.traced_shadows import SHADOW_BUFFERS, shadow_columns, shadow_listings, shadow_operations
from core.stages.fragment_color import has_program
from core.stages.fragments import edited_slopes_at
from core.stages.vertex_light import arriving_colors, material_of, viewpoint
from core.textures.footprints import slope_numerators, slopes_at, slopes_of_edit, slopes_of_one_value
from core.textures.look_up import ColorRule, sample_texture, uses_mipmaps
from core.textures.mipmaps import LevelSamples, level_of_detail, sample_mipmaps
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace

# What a row of the stage ``shade`` knows of its texture: the numbers of the look-up, with mipmaps or
# without.


SLOPE_LISTINGS: dict[str, Callable[..., Any]] = {
    "area": slopes_at,
    "flat": slopes_of_one_value,
    "line": line_slopes_at,
    "affine-line": affine_line_slopes_at,
    "edited": slopes_of_edit,
}
"""How the slopes of texture coordinates come about, see `slope_kind`, to its listing."""


def slope_kind(source: TraceSource) -> str:
    """Return how the slopes of u and v come about: over areas, along lines, by an edit, or not at all."""
    if isinstance(table.get("interpolation", source.settings.interpolation).function, ValueRule):
        return "edited"
    form = interpolation_form(source.settings.interpolation)
    if form == "flat":
        return form
    if not isinstance(source.fragments, LineFragments):
        return "area"
    return "affine-line" if form == "affine" else "line"


def texture_operations(texture_filter: str) -> tuple[Operation, ...]:
    """Return what a row does to find the texture's colour."""
    return table.get("texture_filter", texture_filter).operations["texture"]


COMPUTED = frozenset({"texel_position", "uv_slopes", "lengths", "lod", "texture_color"})
"""What is known of a look-up by an edited listing, beside what its slopes are made from: it computes nothing else."""


def sample_columns(
    source: TraceSource, texture: Texture, uv: Floats, chosen: Integers
) -> dict[str, np.ndarray]:
    """Return every number of the look-up of fragments ``chosen`` (C,) at ``uv`` (C, 2): name to (C, ...) array."""
    found = _method_columns(source, texture, uv, chosen)
    if isinstance(table.get("texture_filter", source.settings.texture_filter).function, ColorRule):
        found = {name: values for name, values in found.items() if name in COMPUTED}
    return found | ({} if source.uv_slopes is None else _slope_columns(source, chosen))


def _method_columns(
    source: TraceSource, texture: Texture, uv: Floats, chosen: Integers
) -> dict[str, np.ndarray]:
    settings = source.settings
    if source.uv_slopes is not None:
        return _mipmap_columns(source, texture, uv, chosen)
    samples = sample_texture(texture, uv, settings.texture_filter, settings.wrap)
    return {
        "texel_position": samples.position,
        "texels": samples.texels,
        "texel_colors": samples.texel_colors,
        "mix": samples.weights,
        "shares": samples.shares,
        "texture_color": samples.color,
    }


def _mipmap_columns(
    source: TraceSource, texture: Texture, uv: Floats, chosen: Integers
) -> dict[str, np.ndarray]:
    assert source.uv_slopes is not None
    slopes, settings = source.uv_slopes[:, chosen], source.settings
    read = sample_mipmaps(texture, uv, slopes, settings.texture_filter, settings.wrap)
    choice = read.choice
    reads_far = any(operation.name == "far" for operation in texture_operations(settings.texture_filter))
    height, width, _ = texture.pixels.shape
    return {
        "texel_position": uv * np.array([width, height]),
        "uv_slopes": slopes.T,
        "lengths": choice.lengths.T,
        "lod": choice.lod,
        "level": choice.level,
        "levels": np.stack([choice.near, choice.far], axis=1),
        "level_sizes": np.concatenate([read.near.size, read.far.size], axis=1),
        "level_fraction": choice.fraction,
        **_level_columns("near", read.near),
        **(_level_columns("far", read.far) if reads_far else {}),
        "texture_color": read.color,
    }


def _level_columns(name: str, read: LevelSamples) -> dict[str, np.ndarray]:
    samples = read.samples
    return {
        f"{name}_position": samples.position,
        f"{name}_texels": samples.texels,
        f"{name}_colors": samples.texel_colors,
        f"{name}_shares": samples.shares,
        f"{name}_color": samples.color,
    }


def _slope_columns(source: TraceSource, chosen: Integers) -> dict[str, np.ndarray]:
    """Return the numbers that the slopes of fragments ``chosen`` (C,) are made from."""
    kind, geometry, fragments = slope_kind(source), source.geometry, source.fragments
    if kind == "flat":
        return {}
    uv = geometry.primitives.varyings[..., geometry.primitives.layout["uv"]]
    x, y = source.centers
    if kind == "edited":
        made = edited_slopes_at(geometry, fragments.primitive[chosen], x[chosen], y[chosen])
        sides = dict(zip(("right", "left", "up", "down"), made.apart, strict=True))
        return {"slope_rule": made.of_method.T, **{f"slope_{name}": off.T for name, off in sides.items()}}
    if kind == "area":
        primitive = fragments.primitive[chosen]
        across, up, n = slope_numerators(
            geometry.planes, primitive, x[chosen], y[chosen], source.settings.interpolation
        )
        names = {"slope_a": across, "slope_b": up, "slope_n": n}
        columns = {name: np.stack(values, axis=1) for name, values in names.items()}
        return {**columns, "corner_uv": uv[primitive]}
    outlines = geometry.outlines
    assert outlines is not None
    assert isinstance(fragments, LineFragments)
    segment = fragments.segment[chosen]
    way = outlines.window[segment, 1] - outlines.window[segment, 0]
    is_steep = np.abs(way[:, 1]) > np.abs(way[:, 0])
    columns = {
        "is_steep": is_steep,
        "length": np.where(is_steep, way[:, 1], way[:, 0]),
        "end_uv": values_at_ends(outlines, uv, source.settings.interpolation)[segment],
    }
    if kind == "line":
        t = line_parameter(outlines, fragments, source.raster.center)
        columns |= {"t": t[chosen], "end_w": outlines.w[segment]}
    return columns


KINDS = ("plain", "textured", "lit", "textured-lit", "mirror", "textured-mirror")
"""Kinds of rows: what has a texture stands at odd numbers."""


def trace_shade(source: TraceSource) -> StageTrace:
    """Return one row for every fragment: its texels where the mesh has a texture, its light where it is lit."""
    if has_program(source.scene):
        from core.shaders.traced_stages import trace_fragment_shader

        return trace_fragment_shader(source)
    fragments, surface = source.fragments, source.surface
    mesh, is_lit = source.geometry.primitives.mesh[fragments.primitive], surface.diffuse_light is not None
    columns = _columns(source, mesh)
    is_textured = np.array([texture is not None for texture in _textures(source)], bool)[mesh]
    has_normals = "normal" in source.geometry.primitives.layout
    triangle = source.triangle_of_fragment
    steps = Steps(
        kinds=KINDS,
        kind=is_textured + 2 * (int(is_lit) + is_mirror(source, mesh)),
        operations=_operations(source, has_normals),
        triangle_ends=ends_of(triangle),
        group_ends=ends_of(fragments.primitive, fragments.row),
    )
    found = StageTrace(
        stage="shade",
        method=f"shading={source.settings.shading}"
        if is_lit
        else f"texture_filter={source.settings.texture_filter}",
        steps=steps,
        columns=columns,
        triangle=triangle,
        pixel=np.stack([fragments.column, fragments.row], axis=1),
        listings=_listings(source, has_normals),
        marks={"covered": np.ones(len(fragments), bool), "nan": np.any(np.isnan(surface.color), axis=1)},
        buffers=_buffers(source, columns, is_textured),
        extra={"textures": _textures(source), "mesh": mesh},
    )
    return without_hidden(source, found)


def _columns(source: TraceSource, mesh: Integers) -> dict[str, np.ndarray]:
    """Return the numbers of every fragment, of these meshes (F,)."""
    fragments, surface = source.fragments, source.surface
    columns: dict[str, np.ndarray] = {
        "column": fragments.column,
        "row": fragments.row,
        "albedo": surface.albedo,
        "color": surface.color,
        "primitive": fragments.primitive,
    }
    if isinstance(table.get("texture_filter", source.settings.texture_filter).function, ColorRule):
        columns["mesh"] = mesh  # Its steps take the texture of their mesh.
    layout, values = source.geometry.primitives.layout, source.interpolated[1]
    if "color" in layout:
        columns["vertex_color"] = values[:, layout["color"]]
    for index, texture in enumerate(_textures(source)):
        if texture is not None:
            chosen = np.flatnonzero(mesh == index)
            uv = values[chosen, layout["uv"]]
            _add_columns(columns, chosen, sample_columns(source, texture, uv, chosen))
            height, width, _ = texture.pixels.shape
            columns.setdefault("texture_size", np.zeros((len(mesh), 2), np.int64))[chosen] = width, height
            columns["uv"] = values[:, layout["uv"]]
    if surface.diffuse_light is not None and surface.specular_light is not None:
        columns["diffuse_light"], columns["specular_light"] = surface.diffuse_light, surface.specular_light
    if "normal" in layout:
        columns |= _light_columns(source, mesh)
        ends = values[:, layout["position"]], values[:, layout["normal"]]
        if surface.lit_color is not None:
            columns["own_color"] = surface.lit_color
        for chosen, of_mirror in mirror_columns(source, mesh, *ends):
            _add_columns(columns, chosen, of_mirror)
    return columns


def _light_columns(source: TraceSource, mesh: Integers) -> dict[str, np.ndarray]:
    """Return every term of the light where fragments are lit; of an edited listing, what it is given."""
    assert isinstance(source.scene, Scene)
    layout, values = source.geometry.primitives.layout, source.interpolated[1]
    position, normal = values[:, layout["position"]], values[:, layout["normal"]]
    material, lights = material_of(source.scene, mesh), source.scene.lights
    eye, count = viewpoint(source.scene.camera, position), len(mesh)
    numbers = np.stack([np.broadcast_to(number, count) for number in plain_material(material)], axis=1)
    colors = np.array([light.color for light in lights]).reshape(-1, 3)
    found = {"light_colors": np.broadcast_to(colors, (count, len(lights), 3))}
    if isinstance(table.get("shading", source.settings.shading).function, LightRule):
        eyes = np.broadcast_to(eye, position.shape)
        return found | {
            "lit_position": position,
            "lit_normal": normal,
            "lit_eye": eyes,
            "lit_material": numbers,
        }
    shadow, arriving = shadow_columns(source, position), None
    if shadow:
        arriving = arriving_colors(source.scene, shadow["light_share"])
        rows = [np.broadcast_to(color.reshape(3, -1), (3, count)).T for color in arriving]
        found["light_colors"] = np.stack(rows, axis=1)
    lighting = trace_lighting(position, normal, eye, lights, material, False, arriving)
    return (
        found
        | shadow
        | {
            "normal": lighting.normal,
            "to_light": np.moveaxis(lighting.to_light, 0, 1),
            "half": np.moveaxis(lighting.half, 0, 1),
            **dict(zip(("ambient", "diffuse", "specular", "shininess"), numbers.T, strict=True)),
            "to_eye": lighting.to_eye,
            "n_dot_l": lighting.n_dot_l.T,
            "n_dot_h": lighting.n_dot_h.T,
            "power": lighting.power.T,
        }
    )


def _textures(source: TraceSource) -> list[Texture | None]:
    """Return the texture of every mesh."""
    if isinstance(source.scene, ClipScene):
        return [source.scene.texture]
    return [mesh.texture for mesh in source.scene.meshes]


def _add_columns(columns: dict[str, np.ndarray], chosen: Integers, found: dict[str, np.ndarray]) -> None:
    """Put what is known of fragments ``chosen`` (C,) into columns of all fragments."""
    count = len(columns["column"])
    for name, values in found.items():
        missing: Any = -1 if values.dtype.kind == "i" else np.nan
        columns.setdefault(name, np.full((count, *values.shape[1:]), missing, values.dtype))
        columns[name][chosen] = values


def _of_lights(label: str, otherwise: str) -> Labels:
    """Return a line of the loop over the lights, and the one without lights."""
    return lambda columns, rows: np.full(
        len(columns["light_colors"][rows]), label if columns["light_colors"].shape[1] else otherwise
    )


def _operations(source: TraceSource, has_normals: bool) -> dict[str, tuple[Operation, ...]]:
    """Return what a row of each kind does."""
    color = Operation("color", "color", {"color": RETURN}, ("albedo",))
    albedo = Operation("albedo", "albedo", {"albedo": RETURN})
    texture = (*texture_operations(source.settings.texture_filter), albedo)
    light: tuple[Operation, ...] = (Operation("interpolated", "", (), ("diffuse_light", "specular_light")),)
    if has_normals:
        light = (
            Operation("normal", "normal", {"normal": "n", "to_eye": "v"}),
            *shadow_operations(source),
            Operation("cosines", _of_lights("cosines", ""), ("n_dot_l", "n_dot_h")),
            Operation("power", _of_lights("power", ""), ("power",)),
            Operation("diffuse", _of_lights("diffuse", "ambient"), ("diffuse_light",)),
            Operation("specular", _of_lights("specular", "ambient"), ("specular_light",)),
        )
    product = (Operation("product", "color", {"color": "red green blue"}),)
    return {
        "plain": (color,),
        "textured": (*texture, color),
        "lit": (Operation("albedo", "", (), ("albedo",)), *light, *product),
        "textured-lit": (*texture, *light, *product),
        "mirror": (Operation("albedo", "", (), ("albedo",)), *light, *mirror_operations(source)),
        "textured-mirror": (*texture, *light, *mirror_operations(source)),
    }


def _listings(source: TraceSource, has_normals: bool) -> dict[str, Listing]:
    """Return the texture's listing, the light's and the product's, by kind of row and operation."""
    texture_filter = source.settings.texture_filter
    of_texture = table.get("texture_filter", texture_filter).listing
    assert of_texture is not None, f"{texture_filter} has no listing"
    texture, product = listing(of_texture), listing(shaded_color)
    if isinstance(texture, EditedListing):
        given = {"textures": _textures(source), "wrap": source.settings.wrap}
        texture = replace(texture, given=given)
    light = _light_listing(source) if has_normals else product
    of_light = ("normal", "cosines", "power", "diffuse", "specular", "interpolated")
    of_operation = {**dict.fromkeys(of_light, light), "product": product, **shadow_listings(source)}
    of_operation |= mirror_listings(source)
    unlit, albedo = listing(unlit_color), listing(textured_albedo)
    found = {"plain": unlit, "lit": product, "mirror": product, "textured.color": unlit}
    textured = ("textured", "textured-lit", "textured-mirror")
    found |= dict.fromkeys(textured, texture) | {f"{kind}.albedo": albedo for kind in textured}
    if uses_mipmaps(texture_filter):
        for kind in textured:
            found[f"{kind}.slopes"] = listing(SLOPE_LISTINGS[slope_kind(source)])
            found |= dict.fromkeys((f"{kind}.lengths", f"{kind}.lod"), listing(level_of_detail))
    for kind in ("lit", "textured-lit", "mirror", "textured-mirror"):
        found |= {f"{kind}.{name}": chosen for name, chosen in of_operation.items()}
    return found


def _light_listing(source: TraceSource) -> Listing:
    """Return the listing of the lighting rule: an edited one is given the lights."""
    typed = table.get("shading", source.settings.shading).listing
    light = listing(blinn_phong if typed is None else typed)
    if not isinstance(light, EditedListing):
        return light
    assert isinstance(source.scene, Scene)
    return replace(light, given={"lights": plain_lights(source.scene.lights), "two_sided": False})


def _buffers(
    source: TraceSource, columns: Mapping[str, np.ndarray], textured: np.ndarray
) -> tuple[BufferTrack, ...]:
    rows, place = np.arange(len(source.fragments)), source.place

    def track(name: str, values: np.ndarray, kind: str = "color") -> BufferTrack:
        color = values
        if kind == "color" and values.shape[1] == 3:
            color = np.column_stack([values, np.ones(len(values))])
        initial = np.full((*source.raster.shape, *color.shape[1:]), np.nan)
        return BufferTrack(name, initial, rows, place, color, kind)

    tracks = [track("fragment color", columns["color"]), track("albedo", columns["albedo"])]
    if textured.any():
        tracks.append(track("texel column", columns["texel_position"][:, 0], "scalar"))
        tracks.append(track("texel row", columns["texel_position"][:, 1], "scalar"))
    if "level" in columns:
        tracks.append(track("mipmap level", columns["level"], "scalar"))
    if "diffuse_light" in columns:
        tracks.append(track("diffuse light", columns["diffuse_light"]))
        tracks.append(track("specular light", columns["specular_light"]))
    if "seen" in columns:
        chosen = np.flatnonzero(columns["mirror"] >= 0)
        empty, seen = np.full((*source.raster.shape, 4), np.nan), np.ones((len(chosen), 4))
        seen[:, :3] = columns["seen"][chosen]
        tracks.append(BufferTrack("seen in the mirror", empty, chosen, place[chosen], seen, "color"))
    for name, title in SHADOW_BUFFERS.items():
        if name in columns and columns[name].size == len(rows):
            tracks.append(track(title, columns[name].reshape(-1), "scalar"))
    return tuple(tracks)
