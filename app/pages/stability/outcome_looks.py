"""How the outcomes of stability experiments look and are called, in the window as in files and texts."""

from app.export.atlas_text import MARKS, WORDS
from core.study.stability import Outcome
from widgets.atlas.records import CellKind

COLORS = {
    Outcome.RIGHT: "#E8EEF2",
    Outcome.HOLE: "#0072B2",
    Outcome.DOUBLE_HIT: "#D55E00",
    Outcome.WRONG_ORDER: "#CC79A7",
    Outcome.NOT_A_NUMBER: "#000000",
    Outcome.OVERFLOW: "#8A7A00",
    Outcome.WRONG_PICTURE: "#882255",
    Outcome.REFUSED: "#BBBBBB",
}
"""Colours that colour-blind people tell apart (M. Okabe, K. Ito, 2008); wine (P. Tol, 2021) where they have green.

Nothing that fails is green: a map of green cells would be read as one where all is well.
"""
DARK = {Outcome.HOLE, Outcome.DOUBLE_HIT, Outcome.NOT_A_NUMBER, Outcome.OVERFLOW, Outcome.WRONG_PICTURE}
"""Outcomes whose character is white."""
ON_DARK = {
    Outcome.RIGHT: ("#2f3940", "#8d979f"),
    Outcome.HOLE: ("#2f94d1", "#000000"),
    Outcome.DOUBLE_HIT: ("#f07b23", "#000000"),
    Outcome.NOT_A_NUMBER: ("#ffffff", "#000000"),
    Outcome.OVERFLOW: ("#d8c400", "#000000"),
    Outcome.WRONG_PICTURE: ("#c4548c", "#000000"),
    Outcome.WRONG_ORDER: ("#d98cb8", "#000000"),
    Outcome.REFUSED: ("#5a6066", "#ffffff"),
}
"""Fill and ink on a dark background: what is right keeps back, what is wrong is seen."""


def cell_kinds() -> tuple[CellKind, ...]:
    """Return the look of every outcome, in the order of `Outcome`."""
    return tuple(
        CellKind(
            WORDS[outcome],
            "·" if outcome is Outcome.RIGHT else MARKS[outcome],
            (COLORS[outcome], ON_DARK[outcome][0]),
            ("#ffffff" if outcome in DARK else "#3a4148", ON_DARK[outcome][1]),
        )
        for outcome in Outcome
    )
