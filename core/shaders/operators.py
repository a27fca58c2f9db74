"""What operators of GLSL do with two values, and what is said where a pair of types has none."""

from collections.abc import Callable
from typing import Any

import numpy as np

from core.lanes.problem import Place, Problem
from core.shaders.glsl_types import CONVERTS_NOTHING, MATRICES, SCALARS, VECTORS, GlslValue, split_type
from core.shaders.rules import matrix_times_vector, sum_of_products, whole_quotient, whole_remainder

ARITHMETIC: dict[str, Callable[[Any, Any], Any]] = {
    "+": np.add,
    "-": np.subtract,
    "*": np.multiply,
    "/": np.divide,
}
ORDER: dict[str, Callable[[Any, Any], Any]] = {
    "<": np.less,
    ">": np.greater,
    "<=": np.less_equal,
    ">=": np.greater_equal,
}


def operate(operator: str, a: GlslValue, b: GlslValue, place: Place) -> GlslValue:
    """Return what an operator does with two values; ``++`` and ``--`` change one by 1 of its own type."""
    if operator in ("++", "--"):
        scalar = "float" if a.of in MATRICES else split_type(a.of)[0]
        if scalar not in ("int", "float"):
            raise Problem(place, f"{operator} changes a number by 1, this is {a.of}")
        operator, b = operator[0], GlslValue(scalar, (SCALARS[scalar](1),))
    (first, m), (second, n) = split_type(a.of), split_type(b.of)
    if operator in ARITHMETIC and first == second and first in ("float", "int") and (m == n or 1 in (m, n)):
        rule = whole_quotient if operator == "/" and first == "int" else ARITHMETIC[operator]
        return _each(rule, a, b, m, n)
    if operator == "%" and first == second == "int" and (m == n or 1 in (m, n)):
        return _each(whole_remainder, a, b, m, n)
    if operator in ORDER and a.of == b.of and a.of in ("float", "int"):
        return GlslValue("bool", (ORDER[operator](a.parts[0], b.parts[0]),))
    if operator in ("==", "!=") and a.of == b.of and a.of not in ("sampler2D", "void"):
        return GlslValue("bool", (_equal(a, b, operator == "=="),))
    if operator == "^^" and a.of == b.of == "bool":
        return GlslValue("bool", (np.logical_xor(a.parts[0], b.parts[0]),))
    made = _with_matrix(operator, a, b)
    if made is None:
        raise Problem(place, _no_operator(operator, a.of, b.of))
    return made


def _each(rule: Callable[[Any, Any], Any], a: GlslValue, b: GlslValue, m: int, n: int) -> GlslValue:
    if m == n:
        return GlslValue(a.of, tuple(map(rule, a.parts, b.parts)))
    if n == 1:
        one = b.parts[0]
        return GlslValue(a.of, tuple(rule(part, one) for part in a.parts))
    one = a.parts[0]
    return GlslValue(b.of, tuple(rule(one, part) for part in b.parts))


def _equal(a: GlslValue, b: GlslValue, is_equal: bool) -> Any:
    first, second = a.parts, b.parts
    if a.of in MATRICES:
        first, second = sum(a.parts, ()), sum(b.parts, ())
    same = np.equal(first[0], second[0])
    for x, y in zip(first[1:], second[1:], strict=True):
        same = same & np.equal(x, y)
    return same if is_equal else np.logical_not(same)


def _with_matrix(operator: str, a: GlslValue, b: GlslValue) -> GlslValue | None:
    """Return what an operator does where a matrix takes part; ``None``: nothing."""
    m, n = MATRICES.get(a.of), MATRICES.get(b.of)
    if operator == "*" and m and b.of == f"vec{m}":
        return GlslValue(b.of, matrix_times_vector(a.parts, b.parts))
    if operator == "*" and n and a.of == f"vec{n}":
        return GlslValue(a.of, tuple(sum_of_products(a.parts, column) for column in b.parts))
    if operator == "*" and m and m == n:
        return GlslValue(a.of, tuple(matrix_times_vector(a.parts, column) for column in b.parts))
    if operator not in ARITHMETIC:
        return None
    rule = ARITHMETIC[operator]
    if m and m == n:
        pairs = zip(a.parts, b.parts, strict=True)
        return GlslValue(a.of, tuple(tuple(map(rule, *pair)) for pair in pairs))
    if m and b.of == "float":
        return GlslValue(a.of, tuple(tuple(rule(part, b.parts[0]) for part in column) for column in a.parts))
    if n and a.of == "float":
        return GlslValue(b.of, tuple(tuple(rule(a.parts[0], part) for part in column) for column in b.parts))
    return None


def _no_operator(operator: str, a: str, b: str) -> str:
    kinds = {split_type(of)[0] if of not in MATRICES else "float" for of in (a, b)}
    if operator in ORDER and a == b and a in VECTORS:
        names = {"<": "lessThan", ">": "greaterThan", "<=": "lessThanEqual", ">=": "greaterThanEqual"}
        return f"{operator} compares single numbers: for vectors write any({names[operator]}(a, b)), or compare .x"
    if operator == "%" and "float" in kinds:
        return f"there is no {a} % {b}: % is for ints, for floats write mod(a, b)"
    more = ""
    if kinds == {"int", "float"}:
        more = CONVERTS_NOTHING
    elif "bool" in kinds and operator in ARITHMETIC:
        more = " (a bool is not a number: write c ? 1.0 : 0.0)"
    elif (
        kinds == {"float"} and a != b and (a in VECTORS or a in MATRICES) and (b in VECTORS or b in MATRICES)
    ):
        more = f" (the sizes differ{': write vec4(v, 1.0)' if {a, b} == {'mat4', 'vec3'} else ''})"
    elif "void" in (a, b):
        more = " (this function gives no value)"
    return f"there is no {a} {operator} {b}{more}"
