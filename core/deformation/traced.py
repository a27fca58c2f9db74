"""Rows of deformation, in front of the matrices: where each bone takes a vertex, and what its weights make of it."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.deformation import skinning
from core.deformation.deform import blend_shapes, blended_shape, rest_normals
from core.methods import is_registered
from core.records.arrays import Floats, Integers
from core.records.deformations import Blend, Skin
from core.records.listing import RETURN, Operation, listing
from core.scene import Mesh, Scene
from core.trace.source import TraceSource
from core.trace.stage_trace import InsertedRows, empty_like
from core.transform.matrices import transform_component

AXES = ("x", "y", "z")
OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "blend": tuple(
        Operation(axis, "blend", {f"after_{axis}": "place"}, ("target", "weight", f"before_{axis}"))
        for axis in AXES
    ),
    "bone": tuple(Operation(axis, "fourth", {f"after_{axis}": RETURN}, ("bone", "weight")) for axis in AXES),
    "skin": (
        *(Operation(axis, "add", {f"after_{axis}": "total"}, ("bones",)) for axis in AXES),
        Operation("normal", "normal", {"normal": RETURN}),
    ),
    "quaternion": (
        Operation("side", "side", ("side",), ("bone", "weight")),
        Operation("real", "real", ("sum_real",), ("rotation",)),
        Operation("dual", "dual", ("sum_dual",), ("dual",)),
    ),
    "move": (
        Operation("length", "length", ("length",), ("bones",)),
        Operation("unit", "unit", {"unit_real": "real", "unit_dual": "dual"}),
        Operation("turn", "turn", ("turned",)),
        Operation("move", "move", {"after": RETURN}),
    ),
}
"""Kind of row to what it does: one shape or bone, and what all bones make of a vertex."""
KINDS = tuple(OPERATIONS)
LISTINGS: dict[str, Callable[..., Any]] = {
    "blend": blended_shape,
    "bone": transform_component,
    "skin": skinning.blended_component,
    "skin.normal": skinning.turned_normal,
    "quaternion": skinning.added_quaternion,
    "move": skinning.moved_by_quaternion,
}
Slot = tuple[str, Integers, dict[str, NDArray[Any]]]
"""A kind of row, which of the vertices (E,) have it, and columns (E, ...) of these."""


def deformation_rows(source: TraceSource, vertex: Integers, triangle: Integers) -> tuple[InsertedRows, ...]:
    """Return the rows in front of corners (G,), see `core.transform.traced.in_front`, mesh by mesh.

    Notes
    -----
    A vertex that several corners share has its rows at the first of them.
    """
    scene = source.scene
    assert isinstance(scene, Scene)
    is_first = np.zeros(len(vertex), bool)
    is_first[np.unique(vertex, return_index=True)[1]] = True
    starts = np.cumsum([0, *(len(mesh.positions) for mesh in scene.meshes)])
    made = []
    for mesh, start, end in zip(scene.meshes, starts, starts[1:], strict=False):
        group = np.flatnonzero(is_first & (vertex >= start) & (vertex < end))
        if mesh.rest is not None and len(group):
            slots = list(_slots(source, mesh, vertex[group] - start))
            made.append(_rows(slots, group, vertex[group], triangle[group]))
    return tuple(made)


def _slots(source: TraceSource, mesh: Mesh, own: Integers) -> Iterator[Slot]:
    """Yield the rows of vertices ``own`` (E,) of a mesh, in turn."""
    assert mesh.rest is not None
    assert mesh.normals is not None
    of_mesh, rest = mesh.rest.deformation, mesh.rest.positions[own]
    every = np.arange(len(own))
    if isinstance(of_mesh, Blend):
        chosen = Blend(of_mesh.targets[:, own], of_mesh.weights)
        places = [rest, *blend_shapes(chosen, rest)]
        for k, weight in enumerate(of_mesh.weights.tolist()):
            columns = {"target": np.full(len(own), k), "weight": np.full(len(own), weight)}
            columns |= {"rest": rest, "shape": of_mesh.targets[k, own]}
            yield "blend", every, columns | {"before": _point(places[k]), "after": _point(places[k + 1])}
        return
    assert isinstance(of_mesh, Skin)
    weights, joints = of_mesh.weights[own], skinning.joints_of(of_mesh)
    bones = {"weights": weights, "bones": (weights > 0).sum(axis=1)}
    if is_registered(source.settings.skinning, "dual-quaternion"):
        yield from _quaternion_slots(weights, joints, rest, bones)
        return
    moved = np.stack(list(skinning.where_bones_take(rest, joints.matrices)), axis=1)
    for joint in range(of_mesh.joint_count):
        has = np.flatnonzero(weights[:, joint] > 0)
        columns = {
            "bone": np.full(len(has), joint),
            "weight": weights[has, joint],
            "before": _point(rest[has]),
        }
        columns["matrix"] = np.broadcast_to(joints.matrices[joint], (len(has), 4, 4))
        yield "bone", has, columns | {"after": _point(moved[has, joint])}
    normals = rest_normals(mesh.rest)[own]
    made = {"moved": moved, "after": _point(mesh.positions[own]), "rest_normal": normals}
    made |= {
        "before": _point(rest),
        "normal": mesh.normals[own],
        "blended": skinning.blended_matrices(weights, joints.matrices),
    }
    yield "skin", every, bones | made


def _quaternion_slots(weights: Floats, joints: Any, rest: Floats, bones: dict[str, Any]) -> Iterator[Slot]:
    """Yield the rows of dual quaternions."""
    every = np.arange(len(rest))
    real = dual = np.zeros((len(rest), 4))
    for joint, (side, sum_real, sum_dual) in enumerate(skinning.quaternion_sums(weights, joints)):
        has = np.flatnonzero(weights[:, joint] > 0)
        columns = {
            "bone": np.full(len(has), joint),
            "weight": weights[has, joint],
            "side": side[has],
            "rotation": np.broadcast_to(joints.rotations[joint], (len(has), 4)),
            "dual": np.broadcast_to(joints.duals[joint], (len(has), 4)),
            "real_before": real[has],
            "dual_before": dual[has],
        }
        real, dual = sum_real, sum_dual
        yield "quaternion", has, columns | {"sum_real": real[has], "sum_dual": dual[has]}
    length = np.sqrt(skinning.dot(real, real))
    unit_real, unit_dual = real / length[:, None], dual / length[:, None]
    w, v, e, u = unit_real[:, :1], unit_real[:, 1:], unit_dual[:, :1], unit_dual[:, 1:]
    turned = rest + 2 * skinning.cross(v, skinning.cross(v, rest) + w * rest)
    moved = turned + 2 * (w * u - e * v + skinning.cross(v, u))
    made = {
        "sum_real": real,
        "sum_dual": dual,
        "length": length,
        "unit_real": unit_real,
        "unit_dual": unit_dual,
    }
    yield "move", every, bones | made | {"before": _point(rest), "turned": turned, "after": _point(moved)}


def _point(places: Floats) -> Floats:
    """Return (E, 4): places (E, 3) with w = 1."""
    return np.column_stack([places, np.ones(len(places))])


def _rows(slots: Sequence[Slot], group: Integers, vertex: Integers, triangle: Integers) -> InsertedRows:
    """Join the rows of vertices (E,), each vertex's together and in turn."""
    at = np.concatenate([has for _, has, _ in slots])
    turn = np.concatenate([np.full(len(has), k) for k, (_, has, _) in enumerate(slots)])
    order = np.lexsort((turn, at))
    columns: dict[str, NDArray[Any]] = {}
    known = {name: values for _, _, own in slots for name, values in own.items()}
    for name, values in known.items():
        parts = [own.get(name, empty_like(values, len(has))) for _, has, own in slots]
        columns[name] = np.concatenate(parts)[order]
    for name in ("before", "after"):
        if name in columns:
            columns |= {f"{name}_{axis}": columns[name][:, k] for k, axis in enumerate(AXES)}
    at = at[order]
    kinds = tuple(dict.fromkeys(kind for kind, _, _ in slots))
    kind = np.concatenate([np.full(len(has), kinds.index(kind)) for kind, has, _ in slots])[order]
    return InsertedRows(
        before=group[at],
        group=group[at],
        triangle=triangle[at],
        kinds=kinds,
        kind=kind,
        operations={name: OPERATIONS[name] for name in kinds},
        columns=columns | {"vertex": vertex[at], "corner": group[at] % 3},
        listings={
            name: listing(function) for name, function in LISTINGS.items() if name.split(".")[0] in kinds
        },
    )
