"""Blending: what a fragment that passed the depth test does to the colour that is there.

The rules are OpenGL's: opaque is drawing without blending, over is
``glBlendFuncSeparate(SRC_ALPHA, ONE_MINUS_SRC_ALPHA, ONE, ONE_MINUS_SRC_ALPHA)``, additive is
``glBlendFuncSeparate(SRC_ALPHA, ONE, ONE, ONE)`` on a buffer of floats.

So a *fragment* has straight alpha: its colour is not multiplied by its alpha. The *buffer* that "over"
leaves is premultiplied: on a transparent black background a half-transparent white fragment gives
(0.5, 0.5, 0.5, 0.5). The background is taken as it is, that is as premultiplied; if it is opaque, the frame
stays opaque and the two meanings are one. "opaque" stores the four numbers of the fragment, alpha among
them, and weighs none by it.

References
----------
T. Porter, T. Duff, Compositing digital images, 1984.
F. Pellacini, Computer Graphics, lecture "Graphics pipeline", "framebuffer processing".
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from core.depth.depth import PixelStacks
from core.methods import method, table
from core.records.arrays import Flags, Floats, Integers, Singles
from core.records.listing import RETURN, Operation

MIXED = (
    Operation("source", "", (), ("source", "before")),
    Operation("color", "color", {"after": "result"}),
    Operation("write", "store", {"after": RETURN}),
)
"""What a fragment that is mixed with what is there does."""


@dataclass(frozen=True, eq=False)
class BlendTraits:
    """What is known of a blend method without running it."""

    mixes: bool
    """Whether what is there has a part in the new colour."""
    hides: Callable[[Floats], Flags]
    """Of the alphas (F,) of fragments, which leave nothing of what is there."""


def blend_traits(blend: str) -> BlendTraits:
    """Return what is known of a method of the family ``blend``."""
    traits: BlendTraits = table.get("blend", blend).traits
    return traits


def opaque_pixel(source: Sequence[float]) -> list[np.float32]:
    """Return the colour of a pixel after one fragment (listing of `opaque`)."""
    return [np.float32(value) for value in source]  #: store


@method(
    "blend",
    "opaque",
    "Opaque",
    source="OpenGL 4.6 without GL_BLEND",
    exact_for="opaque surfaces",
    breaks_where="alpha below 1: it is stored, but the surface hides everything behind it",
    listing=opaque_pixel,
    operations={"opaque": (Operation("write", "store", {"after": RETURN}, ("source", "before")),)},
    traits=BlendTraits(False, lambda alpha: np.ones(alpha.shape, bool)),
)
def opaque(source: Floats, destination: Singles) -> Singles:
    """Return ``source`` as float32; what was there is gone. Arguments as in `over`."""
    del destination
    return source.astype(np.float32)


def over_pixel(source: Sequence[float], destination: Sequence[float]) -> list[np.float32]:
    """Return the colour of a pixel after one fragment (listing of `over`)."""
    *color, alpha = source
    result = [color[k] * alpha + destination[k] * (1 - alpha) for k in range(3)]  #: color
    result.append(alpha + destination[3] * (1 - alpha))
    return [np.float32(value) for value in result]  #: store


@method(
    "blend",
    "over",
    "Over",
    source="Porter and Duff 1984; Pellacini, framebuffer blending",
    exact_for="surfaces drawn from back to front",
    breaks_where="surfaces in another order, and intersecting surfaces",
    listing=over_pixel,
    operations={"over": MIXED},
    traits=BlendTraits(True, lambda alpha: alpha == 1),
)
def over(source: Floats, destination: Singles) -> Singles:
    """Lay fragments over the colours of their pixels.

    Parameters
    ----------
    source : (F, 4) float64 array
        Linear RGB and straight alpha of the fragments; not more than one fragment of a pixel.
    destination : (F, 4) float32 array
        What their pixels hold: premultiplied RGB and alpha.

    Returns
    -------
    (F, 4) float32 array
        ``source * a + destination * (1 - a)`` for RGB and ``a + destination * (1 - a)`` for alpha, computed
        in float64 and rounded once.

    Notes
    -----
    Alpha 1 gives the source and alpha 0 leaves the destination as it is, exactly, for finite colours.
    """
    result = np.empty_like(destination)
    alpha = source[:, 3]
    rest = 1 - alpha
    for channel in range(3):
        result[:, channel] = source[:, channel] * alpha + destination[:, channel] * rest
    result[:, 3] = alpha + destination[:, 3] * rest
    return result


def additive_pixel(source: Sequence[float], destination: Sequence[float]) -> list[np.float32]:
    """Return the colour of a pixel after one fragment (listing of `additive`)."""
    *color, alpha = source
    result = [color[k] * alpha + destination[k] for k in range(3)]  #: color
    result.append(alpha + destination[3])
    return [np.float32(value) for value in result]  #: store


@method(
    "blend",
    "additive",
    "Additive",
    source="Porter and Duff 1984, plus; OpenGL 4.6, glBlendFunc(SRC_ALPHA, ONE)",
    exact_for="light that adds up (fire, glow), in any order, to the rounding of float32",
    breaks_where="opaque surfaces: everything behind them shines through. The display clamps sums above 1",
    listing=additive_pixel,
    operations={"additive": MIXED},
    traits=BlendTraits(True, lambda alpha: np.zeros(alpha.shape, bool)),
)
def additive(source: Floats, destination: Singles) -> Singles:
    """Add fragments (F, 4) to the colours (F, 4) of their pixels, arguments as in `over`.

    Returns
    -------
    (F, 4) float32 array
        ``source * a + destination`` for RGB and ``a + destination`` for alpha, computed in float64 and rounded once.

    Notes
    -----
    Nothing is cut off here: the buffer may hold more than 1, and only the display limits it.
    """
    result = np.empty_like(destination)
    alpha = source[:, 3]
    for channel in range(3):
        result[:, channel] = source[:, channel] * alpha + destination[:, channel]
    result[:, 3] = alpha + destination[:, 3]
    return result


def blend_stacks(
    color: Singles,
    source: Floats,
    number: Integers,
    stacks: PixelStacks,
    passes: Flags | None,
    rule: Callable[..., Singles],
) -> None:
    """Blend fragments into a picture, one layer after another.

    Parameters
    ----------
    color : (H*W, 4) float32
        The picture.
    source : (V, 4) float64
        Colours; fastest as a view of (4, V) rows.
    number : (F,) int64
        Which of them a fragment has.
    stacks : PixelStacks
        Of all F fragments.
    passes : (F,) bool, optional
        The depth test; ``None``: all pass.
    rule : callable
        A method of the family ``blend``.
    """
    there = np.ascontiguousarray(color.take(stacks.pixel, axis=0).T)
    for count, fragment in stacks.layers():
        if passes is None:
            blended = there[:, :count]
            blended.T[:] = rule(source.T.take(number.take(fragment), axis=1).T, blended.T)
        else:
            hit = np.flatnonzero(passes.take(fragment))
            of_hit = source.T.take(number.take(fragment.take(hit)), axis=1)
            there[:, hit] = rule(of_hit.T, there.take(hit, axis=1).T).T
    color[stacks.pixel] = there.T


# A list that is sorted already is resolved from its front: what each fragment adds is what those in front of it let
# through.


def resolve_from_front(hits: Sequence[Sequence[float]], background: Sequence[float]) -> list[np.float32]:
    """Return the colour of a pixel (listing of `add_behind`); ``hits`` from front to back, with straight alpha."""
    color, rest = [0.0, 0.0, 0.0, 0.0], 1.0
    for *own, alpha in hits:
        if rest == 0:
            break  #: shut
        share = rest * alpha  #: share
        color = [color[k] + share * own[k] for k in range(3)] + [color[3] + share]  #: add
        rest = rest * (1 - alpha)  #: rest
    return [np.float32(color[k] + rest * background[k]) for k in range(4)]  #: store


def add_behind(color: Floats, rest: Floats, source: Floats) -> tuple[Floats, Floats]:
    """Add fragments behind what is there already, which lets ``rest`` through.

    Parameters
    ----------
    color : (F, 4) float64
        What the fragments in front have added up to: premultiplied RGB and alpha, linear.
    rest : (F,) float64
        1 before the first fragment.
    source : (F, 4) float64
        Linear RGB and straight alpha of the fragments.

    Returns
    -------
    color : (F, 4) float64
        ``color + rest * a * source`` for RGB and ``color + rest * a`` for alpha; unchanged where ``rest`` is 0.
    rest : (F,) float64
        ``rest * (1 - a)``.

    Notes
    -----
    From front to back with one rounding at the end: `over` from back to front rounds after each fragment, so that the
    two may differ by as many roundings of float32.

    References
    ----------
    T. Porter, T. Duff, Compositing digital images, 1984, "over" is associative.
    L. Carpenter, The A-buffer, an antialiased hidden surface method, 1984.
    """
    share = rest * source[:, 3]
    added = np.column_stack([share[:, None] * source[:, :3], share])
    is_open = rest != 0
    return np.where(is_open[:, None], color + added, color), np.where(
        is_open, rest * (1 - source[:, 3]), rest
    )


def resolve_stacks(color: Singles, source: Floats, number: Integers, stacks: PixelStacks) -> None:
    """Resolve stacks, which lie on their pixels from back to front, from the top down into a picture (H*W, 4).

    Arguments as in `blend_stacks`; all fragments pass.
    """
    pixels = len(stacks.pixel)
    height = len(stacks.higher) - np.searchsorted(stacks.higher[::-1], np.arange(pixels), "right")
    top = stacks.bottom + height - 1
    added, rest = np.zeros((pixels, 4)), np.ones(pixels)
    for layer, count in enumerate(stacks.higher):
        own = source.take(number.take(stacks.fragment.take(top[:count] - layer)), axis=0)
        added[:count], rest[:count] = add_behind(added[:count], rest[:count], own)
    color[stacks.pixel] = over_background(added, rest, color.take(stacks.pixel, axis=0))


def over_background(color: Floats, rest: Floats, background: Singles) -> Singles:
    """Return what resolved lists (F, 4) leave over what was there before (F, 4), of which ``rest`` (F,) shows."""
    return (color + rest[:, None] * background).astype(np.float32)
