"""Bezier curves and patches as scenes hold them: control points, checked."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from core.records.arrays import Floats, checked

CURVE_POINTS = (2, 9)
"""Least and greatest number of control points of a curve."""


@dataclass(frozen=True, eq=False)
class Curves:
    """C Bezier curves of one degree, in clip space.

    Raises
    ------
    ValueError
        For a curve of one point: too few control points, or all of them at one place.
    """

    control: Floats
    """(C, D + 1, 4) float64, the control points: clip-space x, y, z, w."""
    colors: Floats
    """(C, 4) float64, linear, straight alpha: each curve has one colour."""

    def __post_init__(self) -> None:
        control = checked("curves", self.control, ("C", "D + 1", 4))
        least, most = CURVE_POINTS
        if not least <= control.shape[1] <= most:
            raise ValueError(f"a curve must have {least} to {most} control points, got {control.shape[1]}")
        if len(control) == 0:
            raise ValueError("curves must have at least one curve, got none")
        is_point = (control == control[:, :1]).all(axis=(1, 2))
        if is_point.any():
            place = ", ".join(f"{value:g}" for value in control[is_point][0, 0])
            raise ValueError(
                f"curve {int(is_point.argmax())} is one point: all its control points are ({place})"
            )
        colors = checked("colours of curves", self.colors, ("C", 4))
        if len(colors) != len(control):
            raise ValueError(f"colours of curves must be ({len(control)}, 4), got {colors.shape}")
        object.__setattr__(self, "control", control)
        object.__setattr__(self, "colors", colors)


def checked_patches(name: str, patches: ArrayLike, limit: float) -> Floats:
    """Return bicubic patches (P, 4, 4, 3) float64, read-only.

    Raises
    ------
    ValueError
        For another shape, and for a patch whose control points lie on one line: it has no area.
    """
    found = checked(f"patches of {name}", patches, ("P", 4, 4, 3), limit=limit)
    if len(found) == 0:
        raise ValueError(f"patches of {name} must have at least one patch, got none")
    away = (found - found[:, :1, :1]).reshape(-1, 16, 3)
    length = (away * away).sum(axis=2)
    farthest = away[np.arange(len(away)), length.argmax(axis=1)]
    aside = (np.cross(away, farthest[:, None]) ** 2).sum(axis=2).max(axis=1)
    is_flat = aside <= 1e-24 * length.max(axis=1) ** 2
    if is_flat.any():
        raise ValueError(
            f"patch {int(is_flat.argmax())} of {name} has no area: its control points lie on one line"
        )
    return found
