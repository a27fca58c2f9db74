"""How much memory values hold: the arrays that can be reached from them, each counted once."""

from collections.abc import Mapping
from typing import Any

import numpy as np


def held_arrays(value: Any) -> Mapping[int, int]:
    """Return the bytes of all arrays that a record holds, by the identity of their memory.

    What it has computed and kept counts too. Views of one array count as that array.
    """
    found: dict[int, int] = {}
    seen: set[int] = set()
    waiting = [value]
    while waiting:
        each = waiting.pop()
        if isinstance(each, np.ndarray):
            while isinstance(each.base, np.ndarray):
                each = each.base
            found[id(each)] = each.nbytes
        elif id(each) not in seen:
            seen.add(id(each))
            if isinstance(each, tuple | list):
                waiting.extend(each)
            elif isinstance(each, dict):
                waiting.extend(each.values())
            elif hasattr(each, "__dataclass_fields__"):
                waiting.extend(getattr(each, "__dict__", {}).values())
    return found
