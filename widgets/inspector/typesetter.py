"""Typesetting one cell of a formula as SVG, with a cache: a cell costs some 1 to 3 ms."""

import math
import re
from collections import OrderedDict
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from threading import Thread
from types import ModuleType

from PySide6.QtCore import QByteArray, QRectF
from PySide6.QtSvg import QSvgRenderer

from core.explain.latex import MATRIX_WITH_SCRIPT

KEPT_CELLS = 1024
"""Cells that are kept: a cell takes some 43 KB, these take 44 MB."""


@dataclass(frozen=True, eq=False)
class TypesetCell:
    """One cell ready to draw."""

    box: QRectF
    """Extent in logical pixels; y = 0 is the baseline and y grows downwards."""
    renderer: QSvgRenderer | None
    """Draws the cell; None where it could not be typeset."""
    problem: str
    """Why it could not be typeset; empty when it could."""


class Typesetter:
    """Typesets cells and keeps the last ones."""

    def __init__(self, capacity: int = KEPT_CELLS) -> None:
        self._capacity = capacity
        self._cells: OrderedDict[tuple[str, str, float], TypesetCell] = OrderedDict()
        self.made = 0
        """Cells typeset so far: as long as it stays, a formula is laid out as before."""

    def cached(self, latex: str, color: str, size: float) -> TypesetCell | None:
        """Return the cell if it is at hand; never does any work."""
        key = (latex, color, size)
        cell = self._cells.get(key)
        if cell is not None:
            self._cells.move_to_end(key)
        return cell

    def typeset(self, latex: str, color: str, size: float) -> TypesetCell:
        """Typeset one cell.

        Parameters
        ----------
        latex : str
            What to set, with its colours.
        color : str
            ``#rrggbb`` of everything that has no colour of its own.
        size : float
            Font size in logical pixels.
        """
        cell = self.cached(latex, color, size)
        if cell is None:
            cell = _typeset(latex, color, size)
            self.made += 1
            self._cells[latex, color, size] = cell
            if len(self._cells) > self._capacity:
                self._cells.popitem(last=False)
        return cell


@cache
def _typesetting() -> ModuleType:
    """Load the typesetter when the first formula needs it, so that the window opens sooner."""
    module = import_module("ziamath.zmath")
    import_module("widgets.inspector.quick_rows")
    # Qt draws plain paths only; the newer form defines each glyph once and refers to it.
    module.config.svg2 = False
    return module


def is_typesetter_loaded() -> bool:
    """Return whether typesetting can begin at once; loading takes a fifth of a second, once.

    Where loading has failed it can begin, too: then every cell says why it is plain text.
    """
    has_begun = load_typesetter.cache_info().currsize > 0
    return _typesetting.cache_info().currsize > 0 or (has_begun and not load_typesetter().is_alive())


@cache
def load_typesetter() -> Thread:
    """Begin to load the typesetter off the GUI thread, which it would hold up; only the first call does anything."""
    loading = Thread(target=_load, name="typesetter", daemon=True)
    loading.start()
    return loading


def _load() -> None:
    # Each cell that cannot be typeset for the same reason tells it.
    with suppress(Exception):
        _typesetting()


def typesetter_font() -> Path:
    """Return the file of the typesetter's font without loading the typesetter."""
    spec = find_spec("ziamath")
    if spec is None or not spec.submodule_search_locations:
        raise ModuleNotFoundError("the package ziamath is not installed")
    return Path(spec.submodule_search_locations[0]) / "fonts" / "STIXTwoMath-Regular.ttf"


def _typeset(latex: str, color: str, size: float) -> TypesetCell:
    # The typesetter spaces the sign of a number in brackets like a difference.
    guarded = MATRIX_WITH_SCRIPT.sub(r"{\1}", latex).replace("(-", "({-}")
    try:
        drawing = str(_typesetting().Latex(guarded, size=size, color=color, margin=0.5).svg())
    # The typesetter and its LaTeX reader raise anything, even AssertionError and KeyError, on odd text.
    except Exception as problem:
        return TypesetCell(QRectF(), None, _reason(problem))
    renderer = QSvgRenderer(QByteArray(drawing.encode()))
    box = renderer.viewBoxF()
    if not renderer.isValid() or not math.isfinite(box.width()) or box.isEmpty():
        return TypesetCell(QRectF(), None, "the typeset formula is empty")
    return TypesetCell(box, renderer, "")


def _reason(problem: Exception) -> str:
    name = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", type(problem).__name__.removesuffix("Error")).lower()
    detail = str(problem).strip()
    return f"{name}: {detail}" if detail else f"{name} error"
