"""Constructors and functions of GLSL, checked by type: what a call in a shader gives."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from core.lanes.problem import Place, Problem
from core.lanes.run import Run, Some
from core.shaders import rules
from core.shaders.glsl_types import (
    CONVERTS_NOTHING,
    MATRICES,
    SCALARS,
    VECTORS,
    GlslValue,
    component_count,
    split_type,
    vector_type,
)
from core.shaders.rules import differences, look_up, texel_at, texture_size
from core.shaders.words import (
    ALSO_WHOLE,
    COMPARISONS,
    DERIVATIVES,
    EACH,
    FLAGS,
    MATRIX,
    MAY_BE_ONE,
    TEXTURES,
    WHOLE,
)


def call_function(name: str, values: Sequence[GlslValue], mask: Some, place: Place, run: Run) -> GlslValue:
    """Return what a constructor or function makes of values, in the lanes of a mask (L,)."""
    types = [value.of for value in values]
    if "void" in types:
        raise Problem(place, f"a value of {name}(...) comes from a function that gives none")
    if name in VECTORS or name in SCALARS:
        return _construct(name, values, place)
    if name in MATRICES:
        return _construct_matrix(name, values, place)
    if name in COMPARISONS:
        return _compare(name, values, place)
    if name in FLAGS:
        return _flags(name, values, place)
    if name in TEXTURES:
        if ", ".join(types) != TEXTURES[name]:
            raise _wrong(name, types, place, f"{name}({TEXTURES[name]})")
        of_texture = {"texture": look_up, "texelFetch": texel_at, "textureSize": texture_size}
        return of_texture[name](values, place, run)
    if name in DERIVATIVES:
        if len(values) != 1 or split_type(types[0])[0] != "float" or types[0] in MATRICES:
            raise _wrong(name, types, place, f"{name}(float or vector)")
        return differences(name, values[0], run)
    if name in MATRIX:
        return _of_matrix(name, values, place)
    if name in WHOLE:
        return _of_whole(name, values, place)
    return _of_each(name, values, place)


def _wrong(name: str, types: Sequence[str], place: Place, right: str) -> Problem:
    kinds = {split_type(of)[0] for of in types}
    hint = CONVERTS_NOTHING if "int" in kinds else ""
    return Problem(place, f"there is no {name}({', '.join(types)}), only {right}{hint}")


def _construct(name: str, values: Sequence[GlslValue], place: Place) -> GlslValue:
    """Return a vector or scalar of the components of values, converted."""
    scalar, count = split_type(name)
    types = [value.of for value in values]
    if "sampler2D" in types:
        raise Problem(place, f"there is no {name}({', '.join(types)})")
    parts: list[Any] = []
    kinds: list[str] = []
    for value in values:
        of_value = sum(value.parts, ()) if value.of in MATRICES else value.parts
        parts += of_value
        kinds += ["float" if value.of in MATRICES else split_type(value.of)[0]] * len(of_value)
    if not parts:
        raise Problem(place, f"{name}() needs {_numbers(count)}")
    if len(values) == 1 and len(parts) == 1:
        converted = _convert(parts[0], kinds[0], scalar)
        return GlslValue(name, (converted,) * count)
    if len(parts) < count:
        raise Problem(place, f"{name} needs {_numbers(count)}, these are {len(parts)}")
    if sum(component_count(of) for of in types[:-1]) >= count and len(values) > 1:
        raise Problem(place, f"{name} needs {_numbers(count)}, these are {len(parts)}")
    return GlslValue(
        name,
        tuple(_convert(part, kind, scalar) for part, kind in zip(parts[:count], kinds[:count], strict=True)),
    )


def _numbers(count: int) -> str:
    return "1 number" if count == 1 else f"{count} numbers"


def _convert(part: Any, kind: str, scalar: str) -> Any:
    if kind == scalar:
        return part
    if scalar == "bool":
        return np.not_equal(part, 0)
    if scalar == "int" and kind == "float":
        return rules.rounded_to_int(part)
    return np.asarray(part).astype(SCALARS[scalar])[()]


def _construct_matrix(name: str, values: Sequence[GlslValue], place: Place) -> GlslValue:
    count, types = MATRICES[name], [value.of for value in values]
    one, zero = rules.ONE, rules.ZERO
    if types == ["float"]:
        scale = values[0].parts[0]
        return GlslValue(
            name, tuple(tuple(scale if r == c else zero for r in range(count)) for c in range(count))
        )
    if len(types) == 1 and types[0] in MATRICES:
        given, size = values[0].parts, MATRICES[types[0]]
        return GlslValue(
            name,
            tuple(
                tuple(
                    given[c][r] if r < size and c < size else (one if r == c else zero) for r in range(count)
                )
                for c in range(count)
            ),
        )
    if any(split_type(of)[0] != "float" or of in MATRICES for of in types):
        right = f"{name}(float), {name} of {count} vec{count}, or of {count * count} floats"
        raise _wrong(name, types, place, right)
    parts = [part for value in values for part in value.parts]
    if len(parts) != count * count:
        raise Problem(
            place, f"{name} needs {count * count} numbers, column by column, these are {len(parts)}"
        )
    return GlslValue(name, tuple(tuple(parts[c * count : (c + 1) * count]) for c in range(count)))


def _compare(name: str, values: Sequence[GlslValue], place: Place) -> GlslValue:
    types = [value.of for value in values]
    is_vector = len(types) == 2 and types[0] == types[1] and types[0] in VECTORS
    if not is_vector or (types[0].startswith("b") and name not in ("equal", "notEqual")):
        raise _wrong(
            name, types, place, f"{name}(vector, vector); single numbers are compared by {COMPARISONS[name]}"
        )
    compare: Any = {
        "<": np.less,
        "<=": np.less_equal,
        ">": np.greater,
        ">=": np.greater_equal,
        "==": np.equal,
        "!=": np.not_equal,
    }[COMPARISONS[name]]
    a, b = values
    return GlslValue(f"bvec{len(a.parts)}", tuple(map(compare, a.parts, b.parts)))


def _flags(name: str, values: Sequence[GlslValue], place: Place) -> GlslValue:
    types = [value.of for value in values]
    if len(types) != 1 or not types[0].startswith("bvec"):
        raise _wrong(name, types, place, f"{name}(bvec){'; of one bool write !' if name == 'not' else ''}")
    parts = values[0].parts
    if name == "not":
        return GlslValue(types[0], tuple(map(np.logical_not, parts)))
    found = parts[0]
    for part in parts[1:]:
        found = found | part if name == "any" else found & part
    return GlslValue("bool", (found,))


def _of_matrix(name: str, values: Sequence[GlslValue], place: Place) -> GlslValue:
    types = [value.of for value in values]
    if len(types) != MATRIX[name] or any(of not in MATRICES or of != types[0] for of in types):
        right = ", ".join(["matrix"] * MATRIX[name])
        raise _wrong(name, types, place, f"{name}({right})")
    columns = values[0].parts
    if name == "transpose":
        return GlslValue(types[0], tuple(zip(*columns, strict=True)))
    if name == "determinant":
        return GlslValue("float", (rules.determinant(columns),))
    if name == "inverse":
        return GlslValue(types[0], rules.inverse(columns))
    pairs = zip(columns, values[1].parts, strict=True)
    return GlslValue(types[0], tuple(tuple(map(np.multiply, *pair)) for pair in pairs))


def _of_whole(name: str, values: Sequence[GlslValue], place: Place) -> GlslValue:
    types = [value.of for value in values]
    wide = types[0] if types else "float"
    wanted = [wide, wide, "float"] if name == "refract" else [wide] * WHOLE[name]
    fits = types == wanted and split_type(wide)[0] == "float" and wide not in MATRICES
    if name == "cross":
        fits = types == ["vec3", "vec3"]
    if not fits:
        shown = {"cross": "vec3, vec3", "refract": "vector, vector, float"}.get(
            name, ", ".join(["vector"] * WHOLE[name])
        )
        same = " of one size" if WHOLE[name] > 1 and name != "cross" else ""
        raise _wrong(name, types, place, f"{name}({shown}){same}")
    parts = rules.WHOLE_RULES[name](*(value.parts for value in values))
    return GlslValue(vector_type("float", len(parts)), tuple(parts))


def _of_each(name: str, values: Sequence[GlslValue], place: Place) -> GlslValue:
    types = [value.of for value in values]
    count = EACH[name]
    wanted = (1, 2) if name == "atan" else (count,)
    if len(types) not in wanted:
        numbers = " or ".join(map(str, wanted))
        raise Problem(
            place, f"{name} takes {numbers} value{'s' * (wanted[-1] > 1)}, here it gets {len(types)}"
        )
    may_be_one = MAY_BE_ONE.get(name, ())
    wide = next((of for k, of in enumerate(types) if k not in may_be_one), types[0])
    scalar = split_type(wide)[0]
    is_number = wide not in MATRICES and (scalar == "float" or (scalar == "int" and name in ALSO_WHOLE))
    short = [k for k, of in enumerate(types) if of != wide]
    fits = all(types[k] == scalar and k in may_be_one for k in short)
    if len(may_be_one) == 2 and len(short) == 1:
        fits = False
    if not is_number or not fits:
        shown = ", ".join("float" if k in may_be_one else "float or vector" for k in range(len(types)))
        raise _wrong(name, types, place, f"{name}({shown})")
    rule, size = rules.EACH_RULES[name], split_type(wide)[1]
    made = []
    for k in range(size):
        part = rule(*(value.parts[k if len(value.parts) > 1 else 0] for value in values))
        made.append(part[()] if isinstance(part, np.ndarray) and part.ndim == 0 else part)
    return GlslValue(wide, tuple(made))
