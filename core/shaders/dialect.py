"""GLSL's values for `core.lanes`: types that nothing converts, and what operators and functions do with them."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from core.lanes.dialect import Rule, Turn
from core.lanes.masks import Mask, Some
from core.lanes.problem import Place, Problem
from core.lanes.run import Run
from core.shaders.calls import call_function
from core.shaders.glsl_types import (
    CONVERTS_NOTHING,
    MATRICES,
    VECTORS,
    GlslValue,
    picked,
    split_type,
    vector_type,
    zero_of,
)
from core.shaders.operators import operate
from core.shaders.parser import Signature
from core.shaders.scopes import typed_name


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
