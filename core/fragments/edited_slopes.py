"""How texture coordinates change from pixel to pixel where an edited listing interpolates.

Nothing is known of it but its values. So its slopes are those of the method that it stands for, plus what its values
differ from the method's half a pixel to each side. One that gives the method's values has its slopes, bit for bit.
"""

from dataclasses import dataclass

import numpy as np

from core.fragments.interpolation import Interpolator, Planes
from core.fragments.uv_slopes import uv_slopes
from core.fragments.value_rule import ValueRule
from core.methods import table
from core.records.arrays import Floats, Integers
from core.records.primitives import CornerValues

SIDES = ((0.5, 0.0), (-0.5, 0.0), (0.0, 0.5), (0.0, -0.5))
"""Half a pixel to the right, left, up and down."""


@dataclass(frozen=True, eq=False)
class EditedSlopes:
    """Slopes of u and v of F fragments, and what they are made from."""

    of_method: Floats
    """(4, F) float64, du/dx, dv/dx, du/dy and dv/dy of the method's own u and v."""
    apart: Floats
    """(4, 2, F) float64, u and v of the rule less those of the method, half a pixel to the right, left, up and down."""

    @property
    def slopes(self) -> Floats:
        """(4, F) float64, du/dx, dv/dx, du/dy, dv/dy."""
        right, left, up, down = self.apart
        with np.errstate(invalid="ignore"):
            found: Floats = self.of_method + np.concatenate([right - left, up - down])
        return found


def edited_slopes(
    rule: ValueRule,
    planes: Planes,
    values: CornerValues,
    primitive: Integers,
    x: Floats,
    y: Floats,
    interpolation: str,
    provoking: int,
    interval: int,
) -> EditedSlopes:
    """Return the slopes of fragments (F,) at window positions; see `core.fragments.uv_slopes.uv_slopes`.

    ``interpolation`` is the method that the rule stands for; the last two are those of an `Interpolator`.
    """
    uv = CornerValues(values.rows[:, values.layout["uv"]], {"uv": slice(0, 2)}, values.index)
    method = table.get("interpolation", interpolation).function
    ours, right = (Interpolator(planes, uv, of, provoking, interval) for of in (rule, method))
    with np.errstate(invalid="ignore"):
        apart = [
            (ours.values(primitive, x + dx, y + dy) - right.values(primitive, x + dx, y + dy)).T
            for dx, dy in SIDES
        ]
    own = right.values(primitive, x, y)
    return EditedSlopes(uv_slopes(planes, uv, primitive, x, y, own, interpolation), np.stack(apart))


def slopes_of_edit(of_method: Floats, right: Floats, left: Floats, up: Floats, down: Floats) -> list[float]:
    """Listing of the slopes of an edited listing: those of the method (4,), and how far u and v are apart (2,) each."""
    apart = [right[0] - left[0], right[1] - left[1], up[0] - down[0], up[1] - down[1]]
    slopes = [of_method[k] + apart[k] for k in range(4)]  #: slopes
    return slopes
