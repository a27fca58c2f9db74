"""Surfaces that let others shine through: how much, and what samples of several layers may show."""

import numpy as np

from core.records.arrays import Flags, Floats, Integers
from core.scene import AnyScene, Scene, Texture
from core.study.planner.bounds.color_ranges import ColorRanges, weights_below_zero
from core.study.planner.scene_analysis.conservative_coverage import Touched
from core.study.planner.scene_analysis.per_sample_check import sample_pairs
from core.study.planner.scene_analysis.sample_patterns import Pattern

Range = tuple[Floats, Floats]
"""The least and the largest of something."""
ROUNDING = 1e-9
"""Alphas closer than this are one."""
MOST_LAYERS = 64
"""A pixel touched by more triangles than this is not looked into."""


def is_translucent(touched: Touched, scene: AnyScene) -> bool:
    """Tell whether any alpha is not 1: of a vertex, or of a texel."""
    low, high = alphas(touched, scene)
    return bool((np.abs(low - 1) > ROUNDING).any() or (np.abs(high - 1) > ROUNDING).any())


def alphas(touched: Touched, scene: AnyScene) -> Range:
    """Return the least and the largest alpha (P,) of primitives, snapping allowed for."""
    primitives = touched.geometry.primitives
    alpha = primitives.varyings[..., primitives.layout.get("color", slice(0))][..., 3:4]
    low, high = np.ones((2, len(primitives)))
    if alpha.shape[2]:
        low, high = alpha.min(axis=1)[:, 0], alpha.max(axis=1)[:, 0]
        beyond = (high - low) * 2 * np.minimum(weights_below_zero(touched), 1.0)
        low, high = low - beyond, high + beyond
    for number, texture in enumerate(_textures(scene)):
        if texture is not None and texture.pixels.shape[2] == 4:
            of_mesh = primitives.mesh == number
            low = np.where(of_mesh, low * float(texture.pixels[..., 3].min()), low)
            high = np.where(of_mesh, high * float(texture.pixels[..., 3].max()), high)
    return np.clip(low, 0.0, 1.0), np.clip(high, 0.0, 1.0)


def _textures(scene: AnyScene) -> list[Texture | None]:
    return [mesh.texture for mesh in scene.meshes] if isinstance(scene, Scene) else [scene.texture]


def blended_mixture(
    touched: Touched,
    colors: ColorRanges,
    alpha: Range,
    background: Floats,
    pattern: Pattern,
    margin: float,
    pairs: Integers,
    starts: Integers,
) -> tuple[Range, Flags]:
    """Return the least and the largest mean light (N, 3) of the samples of N pixels, and where it is sure (N,).

    Parameters
    ----------
    touched : Touched
    colors : ColorRanges
    alpha : ((P,) float64, (P,) float64)
        As `alphas` returns them.
    background : (4,) float64 linear
    pattern : Pattern
        The samples.
    margin : float
        Window depths closer than this leave a doubt.
    pairs : (R,) int64
        Of these pixels, pixel by pixel and in drawing order.
    starts : (N,) int64
        Where those of each pixel begin.

    Notes
    -----
    Laying a colour s of alpha a over d gives a s + (1 - a) d, linear in each of the three: least and largest are those
    of their ends.
    """
    counts = np.diff(np.append(starts, len(pairs)))
    is_sure = counts <= MOST_LAYERS
    total = np.zeros((2, len(starts), 3))
    for covers, may_cover, depth in sample_pairs(touched, pairs, pattern):
        is_sure &= ~np.logical_or.reduceat(may_cover & ~covers, starts)
        layers = np.empty((2, len(starts), 3))
        layers[:] = background[:3]
        nearest = np.full(len(starts), np.inf)
        for step in range(min(int(counts.max(initial=0)), MOST_LAYERS)):
            there = np.flatnonzero(counts > step)
            index = starts[there] + step
            is_nearer = depth[index] < nearest[there] - margin
            is_hidden = ~covers[index] | (depth[index] > nearest[there] + margin)
            is_sure[there] &= is_nearer | is_hidden
            passes = covers[index] & is_nearer
            pixel, pair = there[passes], pairs[index[passes]]
            layers[:, pixel] = _laid_over(layers[:, pixel], colors, alpha, touched.primitive[pair], pair)
            nearest[pixel] = depth[index[passes]]
        total += layers
    least, most = total / len(pattern.positions)
    return (least, most), is_sure


def _laid_over(
    below: Floats, colors: ColorRanges, alpha: Range, primitive: Integers, pair: Integers
) -> Floats:
    """Return the least and the largest (2, N, 3) of pairs laid over ``below``."""
    ends = [each[primitive][:, None] for each in alpha]
    with np.errstate(invalid="ignore"):
        least = np.minimum(*(a * colors.low[pair] + (1 - a) * below[0] for a in ends))
        most = np.maximum(*(a * colors.high[pair] + (1 - a) * below[1] for a in ends))
    return np.stack([least, np.nan_to_num(most, nan=np.inf, posinf=np.inf)])
