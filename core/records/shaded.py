"""What a vertex shader hands on to the fragment shader."""

from dataclasses import dataclass

from core.records.arrays import Floats


@dataclass(frozen=True, eq=False)
class ShadedVertices:
    """The out variables of N vertices; the fragment shader's in variables are interpolated from them."""

    rows: Floats
    """(N, K) float64, the numbers of float32."""
    layout: dict[str, slice]
    """Which of the K numbers are which variable: ``out`` and its name."""
    flat: tuple[slice, ...]
    """Those that are not interpolated."""
