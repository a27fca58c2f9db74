"""Operators and functions of GLSL on components, derivatives within quads, and look-ups of textures.

Lanes of a fragment shader that needs them come in whole quads: bottom left, bottom right, top left, top right. Those
outside of the triangle, and discarded ones, are helpers: they run, and nobody sees what they give.

Notes
-----
Sums of products go from the last component to the first, and ``normalize`` multiplies by the inverse square root; a
matrix times a vector adds columns from the first to the last. Mesa (llvmpipe)
does the same, so that all of these give the same bits.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from core.lanes.problem import Place, Problem
from core.lanes.run import Run
from core.records.arrays import Floats, Integers
from core.scene import Texture
from core.shaders.glsl_types import GlslValue

# Derivatives: differences between the lanes of a quad, 2 x 2 pixels.


def across(part: Any) -> Any:
    """Return how a component (L,) changes with a pixel to the right: one difference for each row of a quad."""
    if np.ndim(part) == 0:
        return np.zeros_like(part)
    quads = part.reshape(-1, 2, 2)
    return np.repeat(quads[:, :, 1] - quads[:, :, 0], 2, axis=1).reshape(-1)


def up(part: Any) -> Any:
    """Return how a component (L,) changes with a pixel up: one difference for each column of a quad."""
    if np.ndim(part) == 0:
        return np.zeros_like(part)
    quads = part.reshape(-1, 2, 2)
    return np.tile(quads[:, 1, :] - quads[:, 0, :], 2).reshape(-1)


def differences(name: str, value: GlslValue, run: Run) -> GlslValue:
    """Return dFdx, dFdy or fwidth of a value."""
    if run.lanes % 4:
        # One lane without its quad: nothing to compare with.
        return GlslValue(value.of, tuple(np.zeros_like(part) for part in value.parts))
    rule: Any = {"dFdx": across, "dFdy": up, "fwidth": lambda part: np.abs(across(part)) + np.abs(up(part))}[
        name
    ]
    return GlslValue(value.of, tuple(rule(part) for part in value.parts))


# Operators and functions of GLSL on components: float32 and int32, every operation rounded.


F = np.float32
ONE, TWO, THREE, ZERO = F(1), F(2), F(3), F(0)
Part = Any
Rule = Callable[..., Part]


def sum_of_products(a: Sequence[Part], b: Sequence[Part]) -> Part:
    """Return the dot product of the components, summed from the last to the first."""
    total = a[-1] * b[-1]
    for x, y in zip(reversed(a[:-1]), reversed(b[:-1]), strict=True):
        total = total + x * y
    return total


def matrix_times_vector(columns: Sequence[Sequence[Part]], vector: Sequence[Part]) -> tuple[Part, ...]:
    """Return the sum of the columns times the components, from the first to the last."""
    made = []
    for row in range(len(columns[0])):
        total = columns[0][row] * vector[0]
        for column, component in zip(columns[1:], vector[1:], strict=True):
            total = total + column[row] * component
        made.append(total)
    return tuple(made)


def whole_quotient(a: Part, b: Part) -> Part:
    """Divide whole numbers and drop the fraction; by 0 it gives 0, which GLSL leaves open."""
    wide, by = np.asarray(a, np.int64), np.asarray(b, np.int64)
    by = np.where(by == 0, 1, by)
    quotient = np.sign(wide) * np.sign(by) * (np.abs(wide) // np.abs(by))
    return np.where(np.asarray(b) == 0, 0, quotient).astype(np.int32)[()]


def whole_remainder(a: Part, b: Part) -> Part:
    """Return what is left of the division of whole numbers, with the sign of ``a``."""
    wide = np.asarray(a, np.int64)
    return (wide - np.asarray(b, np.int64) * whole_quotient(a, b)).astype(np.int32)[()]


def rounded_to_int(part: Part) -> Part:
    """Return floats as whole numbers, cut off; what no int32 holds becomes the nearest one, NaN 0."""
    whole = np.nan_to_num(
        np.trunc(np.asarray(part, np.float64)), nan=0.0, posinf=2.0**31 - 1, neginf=-(2.0**31)
    )
    return np.clip(whole, -(2.0**31), 2.0**31 - 1).astype(np.int32)[()]


def inverse_square_root(a: Part) -> Part:
    """Return 1 / sqrt(a)."""
    return ONE / np.sqrt(a)


def _smoothstep(low: Part, high: Part, a: Part) -> Part:
    t = np.minimum(np.maximum((a - low) / (high - low), ZERO), ONE)
    return t * t * (THREE - TWO * t)


def _atan(y: Part, x: Part | None = None) -> Part:
    return np.arctan(y) if x is None else np.arctan2(y, x)


EACH_RULES: dict[str, Rule] = {
    "radians": lambda a: a * F(np.pi / 180),
    "degrees": lambda a: a * F(180 / np.pi),
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": _atan,
    "exp": np.exp,
    "log": np.log,
    "exp2": np.exp2,
    "log2": np.log2,
    "sqrt": np.sqrt,
    "inversesqrt": inverse_square_root,
    "abs": np.abs,
    "sign": np.sign,
    "floor": np.floor,
    "ceil": np.ceil,
    "round": np.rint,
    "trunc": np.trunc,
    "fract": lambda a: a - np.floor(a),
    "pow": np.power,
    "mod": lambda a, b: a - b * np.floor(a / b),
    "min": np.minimum,
    "max": np.maximum,
    "clamp": lambda a, low, high: np.minimum(np.maximum(a, low), high),
    "mix": lambda a, b, t: a * (ONE - t) + b * t,
    "step": lambda edge, a: np.where(a < edge, ZERO, ONE),
    "smoothstep": _smoothstep,
}


def _length(a: Sequence[Part]) -> Part:
    return np.abs(a[0]) if len(a) == 1 else np.sqrt(sum_of_products(a, a))


def _normalize(a: Sequence[Part]) -> tuple[Part, ...]:
    if len(a) == 1:
        return (np.sign(a[0]),)
    scale = inverse_square_root(sum_of_products(a, a))
    return tuple(x * scale for x in a)


def _cross(a: Sequence[Part], b: Sequence[Part]) -> tuple[Part, ...]:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _reflect(i: Sequence[Part], n: Sequence[Part]) -> tuple[Part, ...]:
    twice = TWO * sum_of_products(n, i)
    return tuple(x - twice * y for x, y in zip(i, n, strict=True))


def _refract(i: Sequence[Part], n: Sequence[Part], eta: Sequence[Part]) -> tuple[Part, ...]:
    cosine, ratio = sum_of_products(n, i), eta[0]
    k = ONE - ratio * ratio * (ONE - cosine * cosine)
    along = ratio * cosine + np.sqrt(np.maximum(k, ZERO))
    return tuple(np.where(k < ZERO, ZERO, ratio * x - along * y) for x, y in zip(i, n, strict=True))


def _faceforward(n: Sequence[Part], i: Sequence[Part], reference: Sequence[Part]) -> tuple[Part, ...]:
    is_in_front = sum_of_products(reference, i) < ZERO
    return tuple(np.where(is_in_front, x, -x) for x in n)


WHOLE_RULES: dict[str, Rule] = {
    "dot": lambda a, b: (sum_of_products(a, b),),
    "length": lambda a: (_length(a),),
    "distance": lambda a, b: (_length([x - y for x, y in zip(a, b, strict=True)]),),
    "normalize": _normalize,
    "cross": _cross,
    "reflect": _reflect,
    "refract": _refract,
    "faceforward": _faceforward,
}
"""Of components to components; ``dot``, ``length`` and ``distance`` give one."""


def determinant(columns: Sequence[Sequence[Part]]) -> Part:
    """Return the determinant, by the first column."""
    if len(columns) == 1:
        return columns[0][0]
    total: Part = None
    for row in range(len(columns)):
        term = columns[0][row] * determinant(_without(columns, 0, row))
        signed = term if row % 2 == 0 else -term
        total = signed if total is None else total + signed
    return total


def inverse(columns: Sequence[Sequence[Part]]) -> tuple[tuple[Part, ...], ...]:
    """Return the inverse by cofactors; not finite where there is none."""
    count, whole = len(columns), determinant(columns)
    return tuple(
        tuple(
            (ONE if (row + column) % 2 == 0 else -ONE) * determinant(_without(columns, row, column)) / whole
            for row in range(count)
        )
        for column in range(count)
    )


def _without(columns: Sequence[Sequence[Part]], column: int, row: int) -> list[list[Part]]:
    return [[part for j, part in enumerate(of) if j != row] for k, of in enumerate(columns) if k != column]


# Textures in a shader: look-ups by the program's own filters.


Colors = Callable[[Texture, Floats, Floats | None], Floats]
"""Of a texture, texture coordinates (L, 2) and their slopes (4, L), if known: colours (L, 4)."""


@dataclass(frozen=True, eq=False)
class Sampler:
    """What a sampler2D reads from: the texture of each lane's mesh."""

    textures: tuple[Texture | None, ...]
    colors_of: Colors
    """The filter and wrap of the settings."""
    mesh: Integers | None = None
    """(L,) int64, which texture each lane reads; ``None``: all the first."""

    def at(self, lanes: slice) -> "Sampler":
        """Return the sampler of some lanes."""
        mesh = None if self.mesh is None else self.mesh[lanes]
        return Sampler(self.textures, self.colors_of, mesh)

    def only(self, place: Place) -> Texture:
        """Return the texture where all lanes read the same."""
        number = 0 if self.mesh is None or not len(self.mesh) else int(self.mesh[0])
        texture = self.textures[number]
        if texture is None or (self.mesh is not None and (self.mesh != number).any()):
            raise Problem(place, "texelFetch and textureSize need one mesh with a texture")
        return texture


def look_up(values: Sequence[GlslValue], place: Place, run: Run) -> GlslValue:
    """Return texture(sampler, uv)."""
    sampler: Sampler | None = values[0].parts[0]
    u, v = (np.broadcast_to(part, (run.lanes,)) for part in values[1].parts)
    if sampler is None or run.lanes == 0:
        return _colors(np.zeros((run.lanes, 4)))
    uv = np.stack([u, v], axis=1).astype(np.float64)
    slopes = None
    if run.lanes % 4 == 0:
        slopes = np.stack([across(u), across(v), up(u), up(v)]).astype(np.float64)
    color = np.ones((run.lanes, 4))
    for number, texture in enumerate(sampler.textures):
        if texture is None:
            continue
        chosen: Any = slice(None) if sampler.mesh is None else np.flatnonzero(sampler.mesh == number)
        of_mesh = None if slopes is None else slopes[:, chosen]
        color[chosen] = sampler.colors_of(texture, uv[chosen], of_mesh)
    return _colors(color)


def texel_at(values: Sequence[GlslValue], place: Place, run: Run) -> GlslValue:
    """Return texelFetch(sampler, texel, 0); outside of the texture it gives 0."""
    sampler: Sampler | None = values[0].parts[0]
    column, row = (np.broadcast_to(part, (run.lanes,)) for part in values[1].parts)
    if np.any(np.asarray(values[2].parts[0]) != 0):
        raise Problem(place, "texelFetch reads level 0 only here")
    if sampler is None or run.lanes == 0:
        return _colors(np.zeros((run.lanes, 4)))
    pixels = sampler.only(place).pixels
    height, width, channels = pixels.shape
    is_inside = (column >= 0) & (column < width) & (row >= 0) & (row < height)
    found = pixels[np.where(is_inside, row, 0), np.where(is_inside, column, 0)]
    color = np.zeros((run.lanes, 4), np.float32)
    color[:, 3] = 1
    color[:, :channels] = found if channels > 1 else found[:, :1]
    if channels == 1:
        color[:, 1:3] = found
    return _colors(np.where(is_inside[:, None], color, 0))


def texture_size(values: Sequence[GlslValue], place: Place, run: Run) -> GlslValue:
    """Return textureSize(sampler, 0)."""
    sampler: Sampler | None = values[0].parts[0]
    if sampler is None:
        return GlslValue("ivec2", (np.int32(1), np.int32(1)))
    height, width, _ = sampler.only(place).pixels.shape
    return GlslValue("ivec2", (np.int32(width), np.int32(height)))


def _colors(color: Any) -> GlslValue:
    return GlslValue("vec4", tuple(np.ascontiguousarray(color.T.astype(np.float32))))
