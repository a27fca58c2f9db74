"""How fine a grid an experiment is run on: fewer values of every axis, its own, or some between them."""

from dataclasses import replace
from math import sqrt

from core.study.stability.record import Axis

RESOLUTIONS = ("coarse", "normal", "fine")
FEWEST = 4
"""Values below which an axis is not made coarser."""


def axes_at(axes: tuple[Axis, ...], resolution: str) -> tuple[Axis, ...]:
    """Return axes with other values.

    Parameters
    ----------
    axes : tuple of Axis
        As the experiment gives them.
    resolution : str
        One of `RESOLUTIONS`. ``coarse``: every other value, with both ends. ``fine``: one more in the middle between
        each two, the geometric middle on a logarithmic axis; between whole numbers a whole number, if there is one.

    Raises
    ------
    ValueError
        For a resolution that is not there.
    """
    if resolution not in RESOLUTIONS:
        raise ValueError(f"resolution must be one of {', '.join(RESOLUTIONS)}, got {resolution}")
    if resolution == "coarse":
        return tuple(replace(axis, values=_every_other(axis.values)) for axis in axes)
    if resolution == "fine":
        return tuple(replace(axis, values=_with_middles(axis)) for axis in axes)
    return axes


def _every_other(values: tuple[float, ...]) -> tuple[float, ...]:
    if len(values) < FEWEST:
        return values
    kept = values[::2]
    return kept if kept[-1] == values[-1] else (*kept, values[-1])


def _with_middles(axis: Axis) -> tuple[float, ...]:
    values: list[float] = []
    is_whole = all(float(value).is_integer() for value in axis.values)
    for low, high in zip(axis.values, axis.values[1:], strict=False):
        middle = sqrt(low * high) if axis.is_logarithmic else (low + high) / 2.0
        if is_whole:
            middle = float(round(middle))
        values += [low] if middle in (low, high) else [low, middle]
    return (*values, axis.values[-1])
