"""What deforms a mesh, as scenes hold it: other shapes to blend it with, or bones that its vertices hang on."""

from dataclasses import dataclass

import numpy as np

from core.records.arrays import Floats, Integers, checked

SUM_TOLERANCE = 1e-6
"""How far the weights of a vertex may be from 1 together; they are divided by their sum."""
MOST_JOINTS = 64


@dataclass(frozen=True, eq=False)
class Blend:
    """A mesh of N vertices, moved towards K other shapes: p + sum of w_k (target_k - p)."""

    targets: Floats
    """(K, N, 3) float64, object space."""
    weights: Floats
    """(K,) float64; any numbers: below 0 away from a shape, above 1 beyond it."""

    def __post_init__(self) -> None:
        targets = checked("targets", self.targets, ("K", "N", 3))
        weights = checked("weights", self.weights, ("K",))
        if len(weights) != len(targets) or not len(weights):
            raise ValueError(
                f"a blend must have as many weights as targets, got {len(weights)} and {len(targets)}"
            )
        object.__setattr__(self, "targets", targets)
        object.__setattr__(self, "weights", weights)

    @property
    def vertex_count(self) -> int:
        """N."""
        return len(self.targets[0])


@dataclass(frozen=True, eq=False)
class Skin:
    """A tree of J bones in a mesh of N vertices. Each joint turns about its head, and takes its children along.

    Raises
    ------
    ValueError
        Where weights are negative or do not sum to 1, or a joint has a parent that does not exist or comes after it.
    """

    weights: Floats
    """(N, J) float64, how much each vertex hangs on each bone; 0 or more, 1 together."""
    heads: Floats
    """(J, 3) float64, where each bone begins in the rest pose, object space: its joint."""
    tails: Floats
    """(J, 3) float64, where it ends; only drawn."""
    parents: Integers
    """(J,) int64, the bone that each hangs on, -1: none. A parent comes before its children."""
    axes: Floats
    """(J, 3) float64, object space, unit: what each joint turns about."""
    angles: Floats
    """(J,) float64, radians, how far each is turned from the rest pose."""

    def __post_init__(self) -> None:
        weights = checked("weights", self.weights, ("N", "J"))
        heads, tails = (checked(name, getattr(self, name), ("J", 3)) for name in ("heads", "tails"))
        axes, angles = checked("axes", self.axes, ("J", 3)), checked("angles", self.angles, ("J",))
        parents, count = checked("parents", self.parents, ("J",), np.int64), len(heads)
        if not 1 <= count <= MOST_JOINTS:
            raise ValueError(f"a skin must have 1 to {MOST_JOINTS} bones, got {count}")
        for name, values in (("tails", tails), ("axes", axes), ("angles", angles), ("parents", parents)):
            if len(values) != count:
                raise ValueError(f"{name} must be those of {count} bones, got {len(values)}")
        if weights.shape[1] != count:
            raise ValueError(f"weights name {weights.shape[1]} bones, there are {count}")
        for joint, parent in enumerate(parents.tolist()):
            if not -1 <= parent < count:
                raise ValueError(f"bone {joint} hangs on bone {parent}, there are {count}")
            if parent >= joint:
                raise ValueError(f"bone {joint} hangs on bone {parent}, which must come before it")
        _check_weights(weights)
        length = np.sqrt((axes * axes).sum(axis=1))
        if not length.all():
            raise ValueError(f"the axis of bone {int(np.argmin(length))} must not be (0, 0, 0)")
        total = weights.sum(axis=1)
        exact: Floats = weights if (total == 1).all() else weights / total[:, None]
        for name, values in (
            ("weights", checked("weights", exact, ("N", "J"))),
            ("heads", heads),
            ("tails", tails),
            ("parents", parents),
            ("axes", checked("axes", axes / length[:, None], ("J", 3))),
            ("angles", angles),
        ):
            object.__setattr__(self, name, values)

    @property
    def vertex_count(self) -> int:
        """N."""
        return len(self.weights)

    @property
    def joint_count(self) -> int:
        """J."""
        return len(self.heads)


def _check_weights(weights: Floats) -> None:
    """Refuse weights (N, J) of which one is negative, or that do not sum to 1."""
    if (weights < 0).any():
        vertex, joint = (int(part) for part in np.argwhere(weights < 0)[0])
        raise ValueError(
            f"weights must not be negative, vertex {vertex} has {weights[vertex, joint]:g} of bone {joint}"
        )
    total = weights.sum(axis=1)
    away = np.abs(total - 1)
    if (away > SUM_TOLERANCE).any():
        vertex = int(np.argmax(away > SUM_TOLERANCE))
        raise ValueError(
            f"the weights of a vertex must sum to 1, those of vertex {vertex} sum to {total[vertex]:g}"
        )


Deformation = Blend | Skin
