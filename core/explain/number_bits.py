"""How a decision value is shown in the table of variables: the name of its number format, and its bits."""

import math
from collections.abc import Mapping
from typing import Any

from core.raster.number_formats.bit_patterns import bit_pattern

DECISION_VALUES = tuple(f"value_{k}" for k in range(3))
"""Variables that are numbers of the coverage method's format."""


def in_its_numbers(name: str, label: str, meaning: str, values: Mapping[str, Any]) -> tuple[str, str]:
    """Return label and meaning of a variable; a decision value has its format in one, its bits in the other."""
    if name not in DECISION_VALUES or "number_format" not in values:
        return label, meaning
    layout, value = values["value_layout"], float(values[name])
    if layout and math.isfinite(value):
        meaning += f" Its bits in {layout}: {bit_pattern(value, layout)}."
    return label.replace("snapped", values["number_format"]), meaning
