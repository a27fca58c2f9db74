"""What a row of the stage ``shade`` knows of its texture: the numbers of the look-up, with mipmaps or without."""

from collections.abc import Callable
from typing import Any

import numpy as np

from core.fragments.color_rule import ColorRule
from core.fragments.edited_slopes import slopes_of_edit
from core.fragments.mipmap_samples import LevelSamples, sample_mipmaps
from core.fragments.textures import sample_texture
from core.fragments.uv_slopes import slope_numerators, slopes_at, slopes_of_one_value
from core.fragments.value_rule import ValueRule
from core.methods import table
from core.raster.lines.slopes import affine_line_slopes_at, line_slopes_at
from core.raster.lines.wireframe import LineFragments, line_parameter, values_at_ends
from core.records.arrays import Floats, Integers
from core.records.operation import Operation
from core.records.primitives import interpolation_form
from core.scene import Texture
from core.stages.fragments import edited_slopes_at
from core.trace.source import TraceSource

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
