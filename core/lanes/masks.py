"""Masks of lanes: ``None`` is all lanes, `NOBODY` none, an array (L,) of bool at least one of them."""

from enum import Enum

import numpy as np

from core.records.arrays import Flags


class Nobody(Enum):
    """The mask of no lane."""

    NOBODY = "nobody"


NOBODY = Nobody.NOBODY
Some = Flags | None
"""A mask of at least one lane."""
Mask = Flags | Nobody | None


def joined(first: Mask, second: Mask) -> Mask:
    """Return the lanes (L,) of either mask."""
    if isinstance(first, Nobody) or second is None:
        return second
    if isinstance(second, Nobody) or first is None:
        return first
    return first | second


def lanes_in(mask: Mask, lanes: int) -> int:
    """Return how many of so many lanes a mask (L,) has."""
    if isinstance(mask, Nobody):
        return 0
    return lanes if mask is None else int(np.count_nonzero(mask))


def split(mask: Some, flags: Flags, lanes: int) -> tuple[Mask, Mask]:
    """Return the lanes of a mask where ``flags`` (L,) hold, and the others: disjoint, together the mask."""
    yes = flags if mask is None else mask & flags
    count = int(np.count_nonzero(yes))
    if count == 0:
        return NOBODY, mask
    if count == lanes_in(mask, lanes):
        return mask, NOBODY
    return yes, (~flags if mask is None else mask & ~flags)
