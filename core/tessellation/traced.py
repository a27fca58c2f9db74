"""Rows of tessellation, in front of the matrices: how a curve is cut, and the scheme of each point, level by level."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Floats, Integers
from core.records.listing import RETURN, Listing, Operation, listing
from core.resolved import resolve
from core.stages.before_matrices import tessellated
from core.tessellation import bezier
from core.tessellation.patches import is_lost
from core.tessellation.segments import is_flat
from core.tessellation.tessellate import Tessellated
from core.trace.source import TraceSource
from core.trace.stage_trace import InsertedRows

AXES = ("x", "y", "z", "w")
CUT_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "cut-equal": (Operation("count", "step", (), ("owner", "count")),),
    "cut-bound": (
        Operation("deviation", "deviation", ("deviation",), ("owner", "bend", "w_bend", "reach", "least_w")),
        Operation("count", "count", {"count": RETURN}, ("tolerance",)),
    ),
    "cut-halve": (
        Operation(
            "distance",
            "distance",
            {"distance": RETURN},
            ("owner", "first", "last", "last_step", "control_point", "chord_start", "chord_end"),
        ),
        Operation("verdict", "flat", {"is_flat": RETURN}, ("tolerance", "halvings")),
    ),
    "cut-split": (
        Operation("split", "split", (), ("owner", "halvings", "place", "micro_side", "piece_length")),
    ),
    "cut-dice": (
        Operation("length", "split", (), ("owner", "halvings", "place", "micro_side", "piece_length")),
        Operation("dice", "dice", ("parts",), ("part_length",)),
    ),
}
"""How it is decided where curves are cut."""


def _mixing(axes: tuple[str, ...]) -> tuple[Operation, ...]:
    return tuple(Operation(axis, "mix", {f"after_{axis}": "mixtures"}, ("level", "pair")) for axis in axes)


POINT_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "parameter": (Operation("parameter", "parameter", ("s", "t"), ("owner", "step", "steps")),),
    "parameter-v": (Operation("parameter", "parameter", ("s", "t"), ("owner", "step", "steps")),),
    "mix": _mixing(AXES),
    "mix-row": _mixing(AXES[:3]),
    "mix-column": _mixing(AXES[:3]),
    "normal": tuple(
        Operation(axis, f"normal_{axis}", {f"normal_{axis}": axis}, ("u_slope", "v_slope", "has_no_normal"))
        for axis in AXES[:3]
    ),
    "emit": (Operation("emit", "emit", {"after": RETURN}),),
}
"""What is done for one point: its parameter, the mixtures of every level, and the vertex."""


def tessellation_rows(source: TraceSource, vertex: Integers, triangle: Integers) -> tuple[InsertedRows, ...]:
    """Return the rows in front of corners (G,), see `core.transform.traced.in_front`: the points, and what cut them.

    Notes
    -----
    A point that several corners share has its rows at the first of them.
    """
    made = tessellated(source.scene, source.settings)
    key = np.column_stack([made.owner[vertex], made.step[vertex]])
    _, group = np.unique(key, axis=0, return_index=True)
    group = np.sort(group)
    group = group[made.owner[vertex[group]] >= 0]
    points = _point_rows(made, vertex[group], group, triangle[group])
    owners, at = np.unique(made.owner[vertex[group]], return_index=True)
    cuts = _cut_rows(source, made, owners, group[at], triangle[group[at]])
    return points, cuts


def _point_rows(made: Tessellated, vertex: Integers, group: Integers, triangle: Integers) -> InsertedRows:
    """Return the rows of the scheme of vertices (E,), one after the other."""
    slots = list(_curve_slots(made, vertex) if made.step.shape[1] == 1 else _patch_slots(made, vertex))
    kinds = tuple(dict.fromkeys(kind for kind, _ in slots))
    count, width = len(vertex), len(slots)
    columns: dict[str, NDArray[Any]] = {}
    for name in dict.fromkeys(name for _, values in slots for name in values):
        known = next(values[name] for _, values in slots if name in values)
        shape = np.shape(known)[1:] if np.ndim(known) else ()
        missing: Any = -1 if np.asarray(known).dtype.kind == "i" else np.nan
        columns[name] = np.full((count, width, *shape), missing)
        for place, (_, values) in enumerate(slots):
            if name in values:
                columns[name][:, place] = values[name]
    columns = {name: values.reshape(count * width, *values.shape[2:]) for name, values in columns.items()}
    columns["owner"] = np.repeat(made.owner[vertex], width)
    columns["vertex"] = np.repeat(vertex, width)
    if "after" in columns:
        columns |= {f"after_{axis}": columns["after"][:, k] for k, axis in enumerate(AXES)}
    if "normal" in columns:
        columns |= {f"normal_{axis}": columns["normal"][:, k] for k, axis in enumerate(AXES[:3])}
    listings: dict[str, Listing] = dict.fromkeys(kinds, listing(bezier.de_casteljau)) | {
        "normal": listing(bezier.normal_of)
    }
    return InsertedRows(
        before=np.repeat(group, width),
        group=np.repeat(group, width),
        triangle=np.repeat(triangle, width),
        kinds=kinds,
        kind=np.tile([kinds.index(kind) for kind, _ in slots], count),
        operations={kind: POINT_OPERATIONS[kind] for kind in kinds},
        columns=columns,
        listings={kind: listings[kind] for kind in kinds},
    )


Slot = tuple[str, dict[str, Any]]
"""A kind of row, and the columns (E, ...) of that row of all points, or one number for all."""


def _curve_slots(made: Tessellated, vertex: Integers) -> Iterator[Slot]:
    """Yield the rows of points of curves."""
    step, steps = made.step[vertex, 0], made.steps[vertex, 0]
    s, t = bezier.shares(step, steps)
    of_t = {"step": step, "steps": steps, "s": s, "t": t}
    yield "parameter", of_t
    scheme = bezier.levels(s, t, made.control[made.owner[vertex]])
    for mixture in _mixtures(scheme):
        yield "mix", of_t | mixture
    yield "emit", of_t | {"after": scheme[-1][:, 0]}


def _mixtures(scheme: list[Floats]) -> Iterator[dict[str, Any]]:
    """Yield the mixtures of a scheme, level by level: where they stand, and the points (E, D) they are made of."""
    for level, (before, after) in enumerate(pairwise(scheme), start=1):
        for pair in range(after.shape[1]):
            yield {
                "level": level,
                "pair": pair,
                "first_point": before[:, pair],
                "second_point": before[:, pair + 1],
                "after": after[:, pair],
            }


def _patch_slots(made: Tessellated, vertex: Integers) -> Iterator[Slot]:
    """Yield the rows of points of patches: v along every row to two points, u along both columns, v once more."""
    step, steps = made.step[vertex], made.steps[vertex]
    down, across = (bezier.shares(step[:, k], steps[:, k]) for k in (0, 1))
    of_u, of_v = (
        {"step": step[:, k], "steps": steps[:, k], "s": each[0], "t": each[1]}
        for k, each in ((0, down), (1, across))
    )
    yield "parameter", of_u
    yield "parameter-v", of_v
    control = made.control[made.owner[vertex]]
    rows = [bezier.levels(*across, control[:, row])[:3] for row in range(4)]
    for number, row in enumerate(rows):
        for mixture in _mixtures(row):
            yield "mix-row", of_v | {"line": number} | _in_space(mixture)
    columns = [bezier.levels(*down, np.stack([row[-1][:, side] for row in rows], axis=1)) for side in (0, 1)]
    for number, column in enumerate(columns):
        for mixture in _mixtures(column):
            yield "mix-column", of_u | {"line": number} | _in_space(mixture)
    last = bezier.levels(*across, np.stack([column[-1][:, 0] for column in columns], axis=1))
    for mixture in _mixtures(last):
        yield "mix-row", of_v | {"line": 0} | _in_space(mixture) | {"level": 3}
    u_slope, v_slope = bezier.patch_derivatives(bezier.patch_nets(control, down, across), down, across)
    normal = bezier.cross(u_slope, v_slope)
    lost = is_lost(normal, control).astype(np.int64)
    yield "normal", {"u_slope": u_slope, "v_slope": v_slope, "normal": normal, "has_no_normal": lost}
    yield "emit", of_v | _in_space({"after": last[-1][:, 0]})


def _in_space(columns: dict[str, Any]) -> dict[str, Any]:
    """Return columns of which the points (E, 3) of object space are (E, 4), with w = 1."""
    return {
        name: np.column_stack([values, np.ones(len(values))]) if np.ndim(values) == 2 else values
        for name, values in columns.items()
    }


def _cut_rows(
    source: TraceSource, made: Tessellated, owners: Integers, group: Integers, triangle: Integers
) -> InsertedRows:
    """Return the rows that decide where curves or patches (N,) are cut, each before its first point."""
    method, tolerance = resolve(source.settings).method("tessellation"), source.settings.curve_tolerance / 16
    width = made.step.shape[1]
    rows: list[dict[str, Any]] = []
    for owner, place, number in zip(owners.tolist(), group.tolist(), triangle.tolist(), strict=True):
        for along in range(width):
            cut = made.cuts[width * owner + along]
            count = len(cut.step) - 1
            for test in cut.tests or ({"count": count},):
                more = {"owner": owner, "along": along if width > 1 else -1, "tolerance": tolerance}
                more |= {"group": place, "number": number}
                rows.append({"count": -1, **more, **_of_test(test), "last_step": cut.steps})
    kinds = tuple(CUT_OPERATIONS)
    names = {
        name: value for row in rows for name, value in row.items() if name not in ("group", "number", "kind")
    }
    columns = {}
    for name, value in names.items():
        missing: Any = (
            np.full(np.shape(value), np.nan) if isinstance(value, tuple | float) else type(value)(-1)
        )
        columns[name] = np.array([row.get(name, missing) for row in rows])
    groups = np.array([row["group"] for row in rows], np.int64)
    return InsertedRows(
        before=groups,
        group=groups,
        triangle=np.array([row["number"] for row in rows], np.int64),
        kinds=kinds,
        kind=np.array([kinds.index(row["kind"]) for row in rows], np.int64),
        operations=CUT_OPERATIONS,
        columns=columns,
        listings={kind: listing(method.listing) for kind in kinds if method.listing}
        | {"cut-halve.verdict": listing(is_flat)},
    )


def _of_test(test: dict[str, Any]) -> dict[str, Any]:
    """Return the kind and the columns of a test of `core.tessellation.segments.CurveSteps`."""
    if "parts" in test:
        return {"kind": "cut-dice" if test["parts"] else "cut-split", **test}
    if "distance" in test:
        pairs = {"control_point": ("x", "y"), "chord_start": ("ax", "ay"), "chord_end": ("bx", "by")}
        points = {name: tuple(float(test[axis]) for axis in axes) for name, axes in pairs.items()}
        return {
            "kind": "cut-halve",
            **points,
            "distance": float(test["distance"]),
            "first": int(test["first"]),
            "last": int(test["last"]),
            "halvings": int(test["halvings"]),
            "is_flat": bool(test["is_flat"]),
        }
    if "bend" in test:
        numbers = {name: float(test[name]) for name in ("bend", "w_bend", "reach", "least_w")}
        deviation = (numbers["bend"] + numbers["reach"] * numbers["w_bend"]) / (8 * numbers["least_w"])
        return {"kind": "cut-bound", **numbers, "deviation": deviation, "count": int(test["count"])}
    return {"kind": "cut-equal", "count": int(test["count"])}
