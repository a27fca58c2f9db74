"""The bits of a number in its format, field by field, as they stand in memory from the highest to the lowest."""

import re

import numpy as np

FLOATS = {
    "float16": (np.float16, np.uint16, 5, 10),
    "float32": (np.float32, np.uint32, 8, 23),
    "float64": (np.float64, np.uint64, 11, 52),
}
"""Name of a floating-point format to its type, an integer of the same size, and the bits of exponent and fraction."""
FIXED = re.compile(r"fixed-(?P<whole>\d+)\.(?P<fraction>\d+)")


def bit_pattern(value: float, layout: str) -> str:
    """Return the bits of a number, its fields apart.

    Parameters
    ----------
    value : float
        It is rounded to the format first, as storing it would do.
    layout : str
        ``float16``, ``float32``, ``float64``: sign, exponent, fraction; or ``fixed-n.m``: two's complement, n bits
        before the point and m behind it, where what does not fit wraps around.

    Raises
    ------
    ValueError
        For another layout, or a number that is not finite in fixed point.

    Examples
    --------
    >>> bit_pattern(-1.5, "float16")
    '1 01111 1000000000'
    >>> bit_pattern(-0.5, "fixed-4.4")
    '1111.1000'
    """
    if layout in FLOATS:
        number, integer, exponent_bits, fraction_bits = FLOATS[layout]
        with np.errstate(over="ignore"):
            bits = int(np.array(value, number).view(integer))
        text = f"{bits:0{1 + exponent_bits + fraction_bits}b}"
        return f"{text[0]} {text[1 : 1 + exponent_bits]} {text[1 + exponent_bits :]}"
    found = FIXED.fullmatch(layout)
    if found is None:
        raise ValueError(f"layout must be one of {', '.join(FLOATS)} or fixed-n.m, got {layout}")
    if not np.isfinite(value):
        raise ValueError(f"a number in {layout} must be finite, got {value}")
    whole, fraction = int(found["whole"]), int(found["fraction"])
    numerator, denominator = float(value).as_integer_ratio()
    # Half to even, in whole numbers: a float may have more digits than the layout.
    units, rest = divmod(numerator << fraction, denominator)
    units += 2 * rest > denominator or (2 * rest == denominator and units % 2 == 1)
    text = f"{units % (1 << (whole + fraction)):0{whole + fraction}b}"
    return f"{text[:whole]}.{text[whole:]}"
