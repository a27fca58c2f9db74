"""Colours lit at the corners: each triangle has them in the cheapest way that it allows.

Between the corners of a triangle, albedo times light is quadratic, and dividing by w is nearly so: with
1/w_i = v (1 + e_i), the weight of a corner is that in the window times 1 + e_i - e, e being the mean of the e_i there,
but for what grows with the square of e. So with the weights m in the window, colours c, albedo a and light l,

    sum of m_i c_i + sum over edges of m_i m_j ((c_i - c_j) (e_i - e_j) - (a_i - a_j) (l_i - l_j))

is the colour, and a word of three such quadratics is walked with two additions a pixel. A table makes bytes of linear
light, so sRGB costs no error. What is left is bounded for each triangle (`is_certain`).

Where the corners are so much alike that it is near enough, their bytes are interpolated (``byte_colors``); else linear
light with its second differences (``light_words``); the few triangles that neither is certain for, as thin,
see-through and very large ones, have attributes and light per pixel. What a triangle allows follows from itself alone,
so a part of a picture has the bytes of the whole.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from core.depth.depth import READ_AT_ONCE, NearestFragments
from core.fast_path.byte_colors import TOLERANCE, ByteColors, byte_colors
from core.fast_path.draw_context import TOGETHER, Coloring, DrawContext, Words, blocks
from core.fast_path.fragment_colors import FragmentColors
from core.fast_path.lit import LitColors, lit_colors
from core.fast_path.lit_planes import CornerPlaces, corner_places, rounding
from core.fast_path.pixel_light import STEEPEST
from core.fast_path.unlit import TextureColors, texture_colors
from core.framebuffer.display import SRGB_EXPONENT, SRGB_SCALE, encode_linear, encode_srgb
from core.numeric.large_arrays import ScratchBuffers
from core.numeric.planes import OPAQUE, Quadratic, QuadraticPlanes, quadratic_planes
from core.records.arrays import Flags, Floats, Integers, read_only
from core.records.primitives import CornerValues
from core.spans.words import bent_spans, each_pass

# Linear light lit at the corners, as one word with second differences: for corners whose colours are far
# apart.


SHIFTS = (0, 21, 42)
"""Lowest bits of red, green and blue."""
UNIT = 2.0**20
"""What stands for light 1."""
DARKEST = -0.25
"""What stands as 0: light may leave the range from 0 to 1, as far as 1.75."""
EDGES = ((0, 1), (0, 2), (1, 2))
"""Corners of the three edges."""
TABLE_BITS, TABLE_SHIFT = 14, 7
"""Bits of a field that a byte is looked up by, and those below, which it does without."""
STEEPEST_SLOPE = 2.0**10
"""Light a pixel; steeper triangles are seen edge-on."""


@dataclass(frozen=True, eq=False)
class LightWords:
    """Colours of P triangles."""

    planes: QuadraticPlanes
    is_certain: Flags
    """(P,) bool, where every pixel is within the tolerance; the others are level."""

    def write(self, context: DrawContext, place: Integers, primitive: Integers) -> None:
        """Write the pixels at places (F,) of primitives (F,)."""
        word, _ = self.planes.at(primitive, *context.raster.position(place))
        context.pixels[place] = light_pixels(word, context.encoding, context.scratch)


@dataclass(frozen=True, eq=False)
class CornerLight:
    """What is interpolated: (3, M) float64 of vertices, by channel, or (3, 3, P) of the corners of triangles."""

    color: Floats
    """albedo * light + mirrored"""
    albedo: Floats
    light: Floats
    """One channel where all are equal."""
    is_opaque: Flags
    """(M,) bool, or (P,)."""

    def at(self, index: Integers) -> "CornerLight":
        """Return what corners (3, P) have, that are these vertices."""
        color, albedo, light = (
            np.stack([of.take(corner, axis=1) for corner in index])
            for of in (self.color, self.albedo, self.light)
        )
        return CornerLight(color, albedo, light, np.asarray(self.is_opaque.take(index).all(axis=0)))


def light_words(context: DrawContext) -> LightWords:
    """Return the colours of all primitives, which are lit at their corners or not at all."""
    values, places = context.geometry.primitives.values.trimmed(), corner_places(context.geometry)
    if context.settings.interpolation == "affine":
        places.w.fill(1.0)
    vertices, count = vertex_light(values), len(places.is_doubtful)
    parts = []
    for first in range(0, count, TOGETHER):
        at = np.arange(first, min(first + TOGETHER, count))
        parts.append(words_of(context, places.take(at), vertices.at(values.index[:, at])))
    planes = (np.concatenate(of) for of in zip(*(part.planes.words for part in parts), strict=True))
    return LightWords(QuadraticPlanes(*planes), np.concatenate([part.is_certain for part in parts]))


def words_of(context: DrawContext, places: CornerPlaces, corners: CornerLight) -> LightWords:
    """Return the colours of triangles from their ``corners``, at ``places`` (P,), which are used up."""
    inverse = 1 / places.w
    lean = inverse / (0.5 * (inverse.max(axis=0) + inverse.min(axis=0))) - 1
    edges = edge_terms(corners, lean)
    is_known = context.settings.interpolation in ("perspective", "affine")
    is_certain = certain(context, places, corners, edges, lean) if is_known else np.zeros(len(lean[0]), bool)
    level = np.flatnonzero(~is_certain)
    places.doubled_area[level] = 1.0
    for values in (places.x, places.y, corners.color, edges):
        values[..., level] = 0.0
    return LightWords(planes_of(places, context.raster.center, corners.color, edges), is_certain)


def vertex_light(values: CornerValues) -> CornerLight:
    """Return what is interpolated, of M vertices."""
    rows, layout = values.rows.T, values.layout
    given = rows[layout["color"]]
    # What is missing is 0, alpha is 1.
    albedo, alpha = np.zeros((3, rows.shape[1])), given[3] if len(given) == 4 else np.ones(rows.shape[1])
    albedo[: len(given)] = given[:3]
    light, mirrored = np.ones((1, rows.shape[1])), np.zeros((1, rows.shape[1]))
    if "diffuse_light" in layout:
        light, mirrored = (
            np.ascontiguousarray(rows[layout[f"{name}_light"]]) for name in ("diffuse", "specular")
        )
        light = light[:1] if (light[1:] == light[:1]).all() else light
    return CornerLight(albedo * light + mirrored, albedo, light, np.asarray(alpha == 1))


def edge_terms(corners: CornerLight, lean: Floats) -> Floats:
    """Return what m_i m_j is multiplied with, (3, 3, P) float64 by edge and channel; ``lean`` (3, P) are the e_i."""
    terms = np.empty_like(corners.color)
    for term, (i, j) in zip(terms, EDGES, strict=True):
        np.multiply(corners.color[i] - corners.color[j], lean[i] - lean[j], out=term)
        term -= (corners.albedo[i] - corners.albedo[j]) * (corners.light[i] - corners.light[j])
    return terms


def certain(
    context: DrawContext, places: CornerPlaces, corners: CornerLight, edges: Floats, lean: Floats
) -> Flags:
    """Return for which triangles (P,) the bytes of every pixel are within the tolerance.

    Notes
    -----
    With e the greatest e_i, weights are off by 2 e^2 / (1 - e) of themselves, so a colour by e^2 / (1 - e) of what the
    corners differ by; the products of two weights by (1 + 2 e / (1 - e))^2 - 1 of themselves, each of which is 1/4 at
    most. In n steps of a pixel the rounding of coefficients adds up to n^2 / 4 of the last bit.
    """
    least, most = corners.color.min(axis=(0, 1)), corners.color.max(axis=(0, 1))
    size = np.abs(edges).max(axis=1)
    uneven = np.abs(lean).max(axis=0)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        error = (most - least) * uneven * uneven / (1 - uneven)
        product = sum(
            np.abs((corners.albedo[i] - corners.albedo[j]) * (corners.light[i] - corners.light[j])).max(
                axis=0
            )
            for i, j in EDGES
        )
        error += 0.25 * product * ((1 + 2 * uneven / (1 - uneven)) ** 2 - 1)
        error += rounding(places, 8 * np.maximum(most, -least))
        steps = sum(np.abs(of[1:] - of[0]).max(axis=0) for of in (places.x, places.y))
        error += (0.25 * (steps + 4) ** 2 + (1 << TABLE_SHIFT - 1)) / UNIT
        margin = error + 0.25 * size.sum(axis=0)
        slope = steepest_slope(least - margin) if context.encoding == "srgb" else 255.0
        is_flat = (most - least + size.sum(axis=0)) * steps < STEEPEST_SLOPE * np.abs(places.doubled_area)
        is_inside = (least - margin > DARKEST) & (most + margin < DARKEST + 2)
        return np.asarray(
            corners.is_opaque & ~places.is_doubtful & is_flat & is_inside & (error * slope <= TOLERANCE)
        )


def steepest_slope(light: Floats) -> Floats:
    """Return the bytes (P,) that sRGB rises by per unit of linear light above ``light`` (P,), at most."""
    power = 255 * SRGB_SCALE / SRGB_EXPONENT * np.maximum(light, 1e-6) ** (1 / SRGB_EXPONENT - 1)
    return np.asarray(np.minimum(power, STEEPEST))


def planes_of(places: CornerPlaces, center: float, color: Floats, edges: Floats) -> QuadraticPlanes:
    """Return the quadratics through colours (3, 3, P) by corner and channel, with ``edges`` of `edge_terms`, as words.

    Notes
    -----
    The weights of corners 1 and 2 are linear: a i + b j + p at column i and row j from the pixel of corner 0.
    """
    x, y = places.x, places.y
    column, row = np.floor(x[0]), np.floor(y[0])
    right, above = column + center - x[0], row + center - y[0]
    share = 1 / places.doubled_area
    a1 = (y[2] - y[0]) * share
    b1 = (x[0] - x[2]) * share
    a2 = (y[0] - y[1]) * share
    b2 = (x[1] - x[0]) * share
    p1, p2 = right * a1 + above * b1, right * a2 + above * b2

    def field(channel: int) -> Quadratic:
        c0, c1, c2 = UNIT * color[:, channel]
        k01, k02, k12 = UNIT * edges[:, channel]
        mixed, first, second = k12 - k01 - k02, c1 - c0 + k01, c2 - c0 + k02
        slope1 = first + p2 * mixed - 2 * p1 * k01
        slope2 = second + p1 * mixed - 2 * p2 * k02
        bend = 2 * (a1 * a2 * mixed - a1 * a1 * k01 - a2 * a2 * k02)
        arch = 2 * (b1 * b2 * mixed - b1 * b1 * k01 - b2 * b2 * k02)
        twist = (a1 * b2 + a2 * b1) * mixed - 2 * (a1 * b1 * k01 + a2 * b2 * k02)
        value = c0 + p1 * (first + p2 * mixed - p1 * k01) + p2 * (second - p2 * k02)
        value += (1 << TABLE_SHIFT - 1) - DARKEST * UNIT
        across, up = a1 * slope1 + a2 * slope2 + bend / 2, b1 * slope1 + b2 * slope2 + arch / 2
        return Quadratic(value, across, up, bend, twist, arch)

    fields = ((field(channel), shift) for channel, shift in enumerate(SHIFTS))
    return quadratic_planes(column.astype(np.int64), row.astype(np.int64), fields)


def light_pixels(word: Integers, encoding: str, scratch: ScratchBuffers) -> Words:
    """Return words (F,) as opaque pixels (F,) uint32, in the scratch."""
    pixels, byte = (scratch(f"light_{name}", len(word), dtype=np.uint32) for name in ("pixels", "byte"))
    index = scratch("light_index", len(word), dtype=np.int64)
    for channel, (shift, table) in enumerate(zip(SHIFTS, light_bytes(encoding), strict=True)):
        np.right_shift(word, shift + TABLE_SHIFT, out=index)
        index &= (1 << TABLE_BITS) - 1
        table.take(index, out=byte if channel else pixels, mode="clip")
        if channel:
            pixels |= byte
    return pixels


@lru_cache(maxsize=2)
def light_bytes(encoding: str) -> tuple[Words, ...]:
    """Return for every value of `TABLE_BITS` its red, green and blue pixel, uint32 each; red has the alpha."""
    light = DARKEST + np.arange(1 << TABLE_BITS) * ((1 << TABLE_SHIFT) / UNIT)
    single = np.clip(light, 0, 1).astype(np.float32)
    byte = (encode_linear(single) if encoding == "linear" else encode_srgb(single)).astype(np.uint32)
    return tuple(read_only(of) for of in (byte | OPAQUE, byte << np.uint32(8), byte << np.uint32(16)))


# Colours lit at the corners: each triangle has them in the cheapest way that it allows, whatever else there
# is.


BYTES, LIGHT, PLAIN = 0, 1, 2
"""The ways that a triangle is coloured."""
MOST_PLAIN = 0.125
"""Part of the triangles that may be plain where there is no depth: their pixels are looked for once more."""

Write = Callable[[Integers, Integers], None]
"""Writes the pixels at places (F,) of primitives (F,)."""


@dataclass(frozen=True, eq=False)
class CornerColors:
    """Colours of P triangles."""

    bytes: ByteColors
    """Of all; those that have them in another way are level."""
    others: DrawContext
    """The triangles that are not near enough as bytes, in a picture of their own."""
    light: LightWords | None
    """Colours of these; ``None``: there are none."""
    number: Integers
    """(P,) int64, the number that each of them has there."""
    way: NDArray[np.uint8]
    """(P,) uint8, `BYTES`, `LIGHT` or `PLAIN`."""
    name: ClassVar[Coloring] = "corners"
    stage = "interpolate"

    @property
    def for_layer(self) -> "CornerColors | None":
        """These, for a picture that is one layer, if few triangles are plain; else ``None``."""
        return self if np.count_nonzero(self.way == PLAIN) <= MOST_PLAIN * len(self.way) else None

    @property
    def is_light(self) -> Flags:
        """(P,) bool, the triangles that have linear light."""
        return np.asarray(self.way == LIGHT)

    def write_light(self) -> int:
        """Write the triangles that have linear light along their spans; return how many pixels they have."""
        fragments, context = 0, self.others
        if self.light is None or not self.light.is_certain.any():
            return 0
        for first, end, lanes in context.walks(self.light.is_certain):
            with context.timed("raster"):
                planes = self.light.planes.part(first, end)
                spans = bent_spans(planes, lanes, context.raster, context.owners, context.scratch)
                fragments += spans.pixel_count
            with context.timed("shade"):
                for k, pixel, word in each_pass(spans):
                    context.pixels[k:][pixel] = light_pixels(word, context.encoding, context.scratch)
        return fragments

    def write_plain(self, context: DrawContext) -> None:
        """Write the pixels of the plain triangles of a picture that is one layer."""
        chosen = np.flatnonzero(self.way == PLAIN)
        if len(chosen):
            from core.stages.bin_and_raster import covered  # Few pictures have such triangles.

            part = context.part(chosen)
            colors = FragmentColors(part)
            for fragments in covered(part.geometry, context.raster, context.counts):
                place = context.raster.index(fragments.column, fragments.row)
                for at in blocks(len(place)):
                    colors.write(place[at], fragments.primitive[at])

    def look_up(self, context: DrawContext, nearest: NearestFragments) -> int:
        """Write the colour of what is seen at every pixel, and return how many there are; the others stay."""
        ways = {way: self._writer(context, way) for way in np.flatnonzero(np.bincount(self.way)).tolist()}
        seen_count = 0
        if len(ways) == 1:
            (write,) = ways.values()
            for place, primitive in nearest.seen():
                seen_count += len(place)
                write(place, primitive)
            return seen_count
        for first in range(0, len(nearest.keys), READ_AT_ONCE):
            place, primitive = nearest.seen_in(slice(first, first + READ_AT_ONCE))
            seen_count += len(place)
            shown = self.way.take(primitive)
            for way, write in ways.items():
                chosen = np.flatnonzero(shown == way)
                for at in blocks(len(chosen)):
                    write(place.take(chosen[at]), primitive.take(chosen[at]))
        return seen_count

    def _writer(self, context: DrawContext, way: int) -> Write:
        """Return what writes the pixels of the triangles that are coloured in a way."""
        if way == BYTES:
            return lambda place, primitive: self.bytes.write(context, place, primitive)
        if way == LIGHT and self.light is not None:
            light = self.light
            return lambda place, primitive: light.write(self.others, place, self.number.take(primitive))
        is_plain = self.way == PLAIN
        colors, number = FragmentColors(context.part(np.flatnonzero(is_plain))), np.cumsum(is_plain) - 1
        return lambda place, primitive: colors.write(place, number.take(primitive))


def corner_colors(context: DrawContext) -> CornerColors | None:
    """Return the colours of all primitives; ``None`` where they are not those of corners."""
    of_bytes = byte_colors(context)
    if of_bytes is None:
        return None
    is_other = ~of_bytes.is_near
    way = np.zeros(len(is_other), np.uint8)
    if not is_other.any():
        return CornerColors(of_bytes, context, None, np.cumsum(is_other), way)
    others = np.flatnonzero(is_other)
    part = context.part(others)
    light = light_words(part)
    way[others] = np.where(light.is_certain, LIGHT, PLAIN)
    return CornerColors(of_bytes, part, light, np.cumsum(is_other) - 1, way)


# Colours that differ within a triangle, in any of the ways that are cheaper than attributes and light per
# pixel.


SmoothColors = CornerColors | LitColors | TextureColors


def smooth_colors(context: DrawContext) -> SmoothColors | None:
    """Return the cheapest colours that give the right bytes; ``None``: only attributes and light per pixel do."""
    return corner_colors(context) or lit_colors(context) or texture_colors(context)
