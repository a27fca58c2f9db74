"""GLSL's values for `core.lanes`: types that nothing converts, and what operators and functions do with them."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from core.lanes.problem import Place, Problem
from core.lanes.run import Mask, Rule, Run, Some, Turn
from core.shaders.calls import call_function
from core.shaders.glsl_types import (
    CONVERTS_NOTHING,
    MATRICES,
    SCALARS,
    VECTORS,
    GlslValue,
    picked,
    split_type,
    typed_name,
    vector_type,
    zero_of,
)
from core.shaders.parser import Signature
from core.shaders.rules import matrix_times_vector, sum_of_products, whole_quotient, whole_remainder

# What operators of GLSL do with two values, and what is said where a pair of types has none.


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


class GlslDialect:
    """Typed values of float32, int32 and bool.

    Parameters
    ----------
    signatures : mapping of str to Signature
        Of the shader's own functions.
    returns : mapping of Place to str
        The function of each return.
    """

    nothing = GlslValue("void", ())
    is_typed = True

    def __init__(self, signatures: Mapping[str, Signature], returns: Mapping[Place, str]) -> None:
        self._signatures, self._returns = signatures, returns

    def names(self) -> Mapping[str, GlslValue]:
        """Return nothing: the variables of a shader are those of its run."""
        return {}

    def constant(self, value: Any, place: Place) -> GlslValue:
        """Return a number or flag that was typed."""
        if isinstance(value, bool):
            return GlslValue("bool", (np.bool_(value),))
        if isinstance(value, int):
            return GlslValue("int", (np.int32(value),))
        return GlslValue("float", (np.float32(value),))

    def unknown(self, name: str, known: Iterable[str]) -> str:
        """Say that a variable was read before its declaration ran, which the parser rules out."""
        return f"{typed_name(name)} has no value here"

    def truth(self, value: GlslValue, place: Place) -> Any:
        """Return a condition: one bool, or flags (L,)."""
        if value.of != "bool":
            raise Problem(place, f"a condition must be bool and not {value.of}{_compare_hint(value.of)}")
        return value.parts[0]

    def flag(self, truth: Any) -> GlslValue:
        """Return the value of a condition."""
        return GlslValue("bool", (truth,))

    def uniform(self, value: GlslValue, place: Place) -> bool:
        """Return a condition that must be the same in all lanes."""
        truth = self.truth(value, place)
        if np.ndim(truth):
            raise Problem(place, "this must be the same in all lanes")
        return bool(truth)

    def rule(self, operator: str, place: Place) -> Rule:
        """Return what an operator does with two values."""

        def run_rule(a: GlslValue, b: GlslValue, mask: Some, run: Run) -> GlslValue:
            return operate(operator, a, b, place)

        return run_rule

    def prefix(self, operator: str, place: Place) -> Callable[[GlslValue], GlslValue]:
        """Return what a sign does with one value."""

        def run_prefix(a: GlslValue) -> GlslValue:
            if operator == "!":
                if a.of != "bool":
                    more = ": write not(...) for a vector of bools" if a.of in VECTORS else ""
                    raise Problem(place, f"! needs bool and not {a.of}{more}")
                return GlslValue("bool", (np.logical_not(a.parts[0]),))
            if split_type(a.of)[0] in ("bool", "sampler2D", "void"):
                raise Problem(place, f"there is no {operator} of {a.of}")
            if operator == "+":
                return a
            if a.of in MATRICES:
                return GlslValue(a.of, tuple(tuple(-part for part in column) for column in a.parts))
            return GlslValue(a.of, tuple(np.negative(part) for part in a.parts))

        return run_prefix

    def check_stored(self, value: GlslValue, mask: Some, place: Place, run: Run) -> None:
        """Check what a return gives, in the lanes of a mask (L,), against its function's type."""
        function = self._returns.get(place)
        if function is not None:
            expect(self._signatures[function].of, value, place, f"{function} gives", "returned")
        elif value.of == "void":
            raise Problem(place, "this function gives no value")

    def check_kept(self, name: str, old: GlslValue, new: GlslValue, place: Place) -> None:
        """Check that a variable keeps its type."""
        expect(old.of, new, place, f"{typed_name(name)} is")

    def size(self, value: GlslValue) -> int:
        """Return 0: the parser limits the variables of a shader, and a loop declares them anew each round."""
        return 0

    def merged(
        self, flags: Any, new: GlslValue, old: GlslValue, place: Place, run: Run, returned: int = 0
    ) -> GlslValue:
        """Return ``new`` where ``flags`` hold, else ``old``."""
        if new.of != old.of:
            raise Problem(
                place,
                f"both values of ? : must have one type, these are {new.of} and {old.of}{_hint(new, old)}",
            )
        if new.of in MATRICES:
            columns = zip(new.parts, old.parts, strict=True)
            return GlslValue(new.of, tuple(_merge(flags, a, b) for a, b in columns))
        if new.of == "sampler2D":
            raise Problem(place, "a sampler2D cannot be chosen by a condition")
        return GlslValue(new.of, _merge(flags, new.parts, old.parts))

    def zero(self, of: Any) -> GlslValue:
        """Return what a variable begins with that is declared without a value: GLSL leaves it open, here it is 0."""
        return zero_of(str(of))

    def typed(self, of: Any, value: GlslValue, place: Place, name: str) -> GlslValue:
        """Check the value that a variable is declared with."""
        expect(str(of), value, place, f"{typed_name(name)} is")
        return value

    def part(self, whole: GlslValue, index: GlslValue, mask: Some, place: Place, run: Run) -> GlslValue:
        """Return a component of a vector, or a column of a matrix, in the lanes of a mask (L,)."""
        k = _index(whole, index, mask, place)
        if whole.of in MATRICES:
            return GlslValue(f"vec{MATRICES[whole.of]}", whole.parts[k])
        return GlslValue(split_type(whole.of)[0], (whole.parts[k],))

    def with_part(
        self, whole: GlslValue, index: Any, new: GlslValue, mask: Some, place: Place, run: Run
    ) -> GlslValue:
        """Return a value with other components; ``index`` is a swizzle or a number, ``mask`` (L,)."""
        parts = list(whole.parts)
        if isinstance(index, str):
            picks = picked(index, whole.of, place)
            if len(set(picks)) < len(picks):
                raise Problem(place, f".{index} names a component twice: nothing can be stored in it")
            expect(vector_type(split_type(whole.of)[0], len(picks)), new, place, f".{index} is")
            for k, part in zip(picks, new.parts, strict=True):
                parts[k] = part
            return GlslValue(whole.of, tuple(parts))
        k = _index(whole, index, mask, place)
        if whole.of in MATRICES:
            expect(f"vec{MATRICES[whole.of]}", new, place, "a column is")
            parts[k] = new.parts
        else:
            expect(split_type(whole.of)[0], new, place, "a component is")
            parts[k] = new.parts[0]
        return GlslValue(whole.of, tuple(parts))

    def field(self, whole: GlslValue, name: str, place: Place) -> GlslValue:
        """Return the components that a swizzle picks."""
        picks = picked(name, whole.of, place)
        return GlslValue(
            vector_type(split_type(whole.of)[0], len(picks)), tuple(whole.parts[k] for k in picks)
        )

    def call(self, name: str, values: Sequence[GlslValue], mask: Some, place: Place, run: Run) -> GlslValue:
        """Return what a constructor or a function of GLSL makes of values, in the lanes of a mask (L,)."""
        return call_function(name, values, mask, place, run)

    def arguments(
        self, name: str, parameters: Sequence[str], values: Sequence[GlslValue], place: Place
    ) -> Sequence[GlslValue]:
        """Check the values that one of the shader's functions is called with."""
        types, given = self._signatures[name].types, tuple(value.of for value in values)
        if types != given:
            hint = "".join(
                {_hint_of(want, got) for want, got in zip(types, given, strict=False) if _hint_of(want, got)}
            )
            raise Problem(
                place, f"{name} takes ({', '.join(types)}), here it gets ({', '.join(given)}){hint}"
            )
        return values

    # What GLSL does not have.

    def many(
        self, parts: Sequence[GlslValue], starred: Sequence[bool], mask: Some, place: Place, run: Run
    ) -> GlslValue:
        """Refuse a list, for any mask (L,)."""
        raise Problem(place, "GLSL has no lists")

    def elements(self, value: GlslValue, mask: Some, place: Place, run: Run) -> list[GlslValue]:
        """Refuse a list, for any mask (L,)."""
        raise Problem(place, "GLSL has no lists")

    def unpacked(
        self, value: GlslValue, starred: Sequence[bool], mask: Some, place: Place, run: Run
    ) -> list[GlslValue]:
        """Refuse several names on the left, for any mask (L,)."""
        raise Problem(place, "GLSL stores one value at a time")

    def turns(self, value: GlslValue, mask: Mask, place: Place, run: Run) -> Turn:
        """Refuse a loop over a list, for any mask (L,)."""
        raise Problem(place, "GLSL has no lists")

    def put(self, whole: GlslValue, value: GlslValue, mask: Some, place: Place, run: Run) -> None:
        """Refuse a list, for any mask (L,)."""
        raise Problem(place, "GLSL has no lists")


def expect(of: str, value: GlslValue, place: Place, subject: str, what: str = "the value") -> None:
    """Raise Problem where a value has another type than ``of``."""
    if value.of != of:
        shown = f"{what} is {value.of}" if what == "the value" else f"{value.of} is {what}"
        if value.of == "void":
            raise Problem(place, f"{subject} {of}, but this function gives no value")
        raise Problem(place, f"{subject} {of}, {shown}{_hint_of(of, value.of)}")


def _hint_of(want: str, got: str) -> str:
    first, second = split_type(want)[0], split_type(got)[0]
    if {first, second} == {"int", "float"}:
        return CONVERTS_NOTHING if first == "float" else " (GLSL converts nothing by itself: write int(...))"
    m, n = split_type(want)[1], split_type(got)[1]
    if first == second == "float":
        if m == 4 and n == 3:
            return " (write vec4(v, 1.0))"
        if n > m and got in VECTORS:
            return f" (write v.{'xyzw'[:m]})"
        if m > n == 1:
            return f" (write {want}(x))"
    return ""


def _hint(a: GlslValue, b: GlslValue) -> str:
    kinds = {split_type(a.of)[0], split_type(b.of)[0]}
    return CONVERTS_NOTHING if kinds == {"int", "float"} else ""


def _compare_hint(of: str) -> str:
    return {"int": ": compare it, as x != 0", "float": ": compare it, as x > 0.0"}.get(
        of, ": write any(...) or all(...)" if of.startswith("bvec") else ""
    )


def _merge(flags: Any, new: Sequence[Any], old: Sequence[Any]) -> tuple[Any, ...]:
    return tuple(a if a is b else np.where(flags, a, b) for a, b in zip(new, old, strict=True))


def _index(whole: GlslValue, index: GlslValue, mask: Some, place: Place) -> int:
    """Return a number of a component, which must be the same in all lanes of a mask."""
    if whole.of not in VECTORS and whole.of not in MATRICES:
        raise Problem(place, f"{whole.of} has no parts: [ ] is for vectors and matrices")
    if index.of != "int":
        raise Problem(place, f"an index must be int and not {index.of}")
    found = np.asarray(index.parts[0])
    if found.ndim and found.size and mask is not None:
        found = found[mask]
    if found.ndim and found.size and (found != found.flat[0]).any():
        raise Problem(place, "an index must be the same in all lanes here")
    k = int(found.flat[0]) if found.size else 0
    if not 0 <= k < len(whole.parts):
        raise Problem(place, f"index {k} of {whole.of} is outside of 0 to {len(whole.parts) - 1}")
    return k
