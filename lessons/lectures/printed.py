"""What every listing as printed has, slips included, and its runs with a note for every labelled line.

Listings as printed stand in no table of methods and in no menu: `lessons.lectures.catalogue` lists them.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from math import floor, nan
from typing import Any

import numpy as np

from core import Settings
from core.edits.typed import Typed
from core.lanes.nodes import Statement
from core.lanes.problem import LISTING
from core.lanes.run import Frame, Some
from core.lines.line_method import (
    STEP_LIMIT,
    LineRun,
    LineTraits,
    Segments,
    limited_steps,
    line_rows,
    line_traits,
)
from core.methods import Method, table
from core.records.arrays import Floats
from core.records.listing import Columns, Operation, print_as, source_listing, without_labels

# Runs of a printed line listing: its pixels, and the sum that decided each as the lines before have left
# it.


_ADVANCED = ("first-sum", "advance", "advance-step", "evaluate")
_LIMITS = replace(LISTING, rounds=STEP_LIMIT + 1)


class _Pixels:
    """Looks on while a listing runs for L lines, and notes what its labelled lines store."""

    def __init__(self, labels: dict[int, str], lanes: int) -> None:
        self._labels = labels
        self._sums = np.full((4, lanes), np.nan)
        """The sum as it is; of the pixel that comes: before it, after it was corrected, and after it was advanced."""
        self.drawn = [np.empty((7, 0))]
        """Of every draw: the lines (P,) that draw, column, row and decision, and the three sums of the pixel."""

    def begin(self, statement: Statement, mask: Some, frame: Frame) -> None:
        """Note nothing."""

    def end(self, statement: Statement, mask: Some, frame: Frame, value: Any) -> None:
        """Note a pixel, or what a sum is now."""
        label = self._labels.get(statement.place.line)
        here = np.arange(self._sums.shape[1]) if mask is None else np.flatnonzero(mask)
        if label == "draw":
            pixel = [np.broadcast_to(number, self._sums.shape[1:])[here] for number in value]
            self.drawn.append(np.array([here, *pixel, *self._sums[1:, here]], float))
            self._sums[1, here], self._sums[2:, here] = self._sums[0, here], np.nan
        elif label == "correct" or label in _ADVANCED:
            new = np.broadcast_to(value, self._sums.shape[1:])[here]
            self._sums[0, here] = self._sums[2 if label == "correct" else 3, here] = new


def recorded(function: Callable[..., Any], ends: np.ndarray, last_pixel: bool) -> Floats:
    """Run a listing for lines with ends (L, 2, 2), in step.

    Returns
    -------
    pixels : (7, P) float64
        Line, column, row and decision of each pixel, line by line; and the sum that decides: before it, after it was
        corrected, and after it was advanced; NaN: it was not.
    """
    shown, columns = source_listing(function), ends.reshape(-1, 4).T
    watch = _Pixels({line: label for label, line in shown.lines.items()}, len(ends))
    program = Typed(function, shown.source).program
    program.run([*map(np.ascontiguousarray, columns), last_pixel], len(ends), limits=_LIMITS, watch=watch)
    pixels = np.concatenate(watch.drawn, axis=1)
    return np.asarray(pixels[:, np.argsort(pixels[0], kind="stable")])


# What every printed listing has, and how a printed line listing runs in the pipeline in place of a method.


Operations = tuple[Operation, ...]
Listed = list[tuple[int, int, float]]
"""Column, row and decision of each pixel; the decision is NaN where nothing had to be decided."""


@dataclass(frozen=True)
class ListedLines:
    """The rule of a line method that runs a listing for all segments.

    Two rules of one listing are equal, so settings that hold them are too.
    """

    listing: Callable[..., Listed]
    """From x0, y0, x1, y1 and ``last_pixel`` to its pixels."""
    tie: float | None
    """The decision at a tie; ``None``: the decision is a coordinate, and a tie is a fraction of 1/2."""
    takes_pixels: bool
    """Whether it is called with the pixels of the ends; else with positions where pixel centres are whole."""
    rises: bool = True
    """Whether it is printed for slopes from 0 to 1; else for slopes from -1 to 0."""

    def __call__(self, segments: Segments, last_pixel: bool) -> LineRun:
        """Run the listing for L segments.

        Raises ValueError if a segment does not run from left to right with a slope that the listing is printed for, or
        has too many steps.
        """
        ends: np.ndarray = segments.pixel_indices if self.takes_pixels else segments.centered_ends
        dx, dy = (ends[:, 1] - ends[:, 0]).T
        is_meant = (dx > 0) & (np.abs(dy) <= dx) & ((dy >= 0) if self.rises else (dy <= 0))
        if not is_meant.all():
            slopes = "from 0 to 1" if self.rises else "from -1 to 0"
            first = ends[int(np.argmin(is_meant))].tolist()
            raise ValueError(f"the slide prints this for x0 < x1 and slopes {slopes}, got {first}")
        limited_steps(self.listing.__name__, np.zeros(len(dx), np.int64), np.ceil(dx).astype(np.int64))
        pixels = recorded(self.listing, ends, last_pixel)
        (owner, column, row) = pixels[:3].astype(np.int64)
        (decision, before, corrected, advanced) = pixels[3:]
        index = np.arange(len(owner)) - np.searchsorted(owner, owner)
        has_stepped = (index > 0) & (row != np.roll(row, 1))
        is_tie = decision - np.floor(decision) == 0.5 if self.tie is None else decision == self.tie
        return LineRun(
            *(owner, index, column, row, decision, has_stepped, is_tie),
            sum_before=before,
            sum_corrected=corrected,
            sum_advanced=advanced,
        )


@dataclass(frozen=True)
class SlideNumber:
    """A number, and how it is computed again."""

    lecture: str
    """Zwicker, Pellacini, Jubair or LMU."""
    slide: str
    """Title of the slide."""
    what: str
    """What the number is of."""
    number: Any
    """As on the slide, or as counted before: numbers, texts, and tuples of them."""
    compute: Callable[[], Any]
    """Finds it again."""
    right: Any = None
    """What must come out where the slide slips; ``None``: the number itself."""
    is_counted: bool = False
    """The number does not stand on the slide: it was counted with what the slide prints."""

    @property
    def recorded_verdict(self) -> str:
        """``agrees``, ``slip``, or ``counted``."""
        if self.right is not None:
            return "slip"
        return "counted" if self.is_counted else "agrees"

    def verdict(self, ours: Any) -> str:
        """Judge what was computed: the recorded verdict, or ``CHANGED``."""
        wanted = self.number if self.right is None else self.right
        is_slip = self.right is None or not is_same(self.number, ours)
        return self.recorded_verdict if is_same(wanted, ours) and is_slip else "CHANGED"


def slide_number(
    lecture: str, slide: str, what: str, number: Any, compute: Callable[..., Any], *values: Any
) -> SlideNumber:
    """Return a number that stands on a slide, computed by ``compute(*values)``."""
    return SlideNumber(lecture, slide, what, number, partial(compute, *values))


def is_same(expected: Any, found: Any) -> bool:
    """Return whether two nested tuples are the same: floats up to rounding, all else exactly."""
    if isinstance(expected, tuple):
        return len(expected) == len(found) and all(map(is_same, expected, found))
    if isinstance(expected, float):
        return bool(abs(expected - found) <= 1e-12 * max(1.0, abs(expected)))
    return bool(expected == found)


def signed_lengths(columns: Columns) -> dict[str, np.ndarray]:
    """Return dx and dy (R,) as the slides have them, with their signs."""
    dx, dy = (columns["second_end"] - columns["first_end"]).T
    return {"dx": dx, "dy": dy}


@dataclass(frozen=True, eq=False)
class PrintedListing:
    """A listing as a slide prints it."""

    name: str
    title: str
    lecture: str
    slide: str
    text: str
    """The listing as the slide has come to us, its layout restored; of a line listing given with labels."""
    family: str
    """Family of the method that is right."""
    right: str
    """Name of the method that is right."""
    readings: Mapping[str, Callable[..., Any]]
    """What runs, by how a doubtful place of ``text`` is read; the first is what the author must have meant."""
    note: str = ""
    """Which characters may be a slip of the transcription, and how they are read."""
    numbers: tuple[SlideNumber, ...] = ()
    """What is known of it."""
    rule: ListedLines | None = None
    """Of a line listing: its first reading in the pipeline."""
    rows: tuple[Operations, ...] = ()
    """Of a line listing: what the first pixel of a line does, every other one, and one after a step."""
    read: tuple[str, str] = ("", "")
    """Of a line listing: what ``text`` prints, and how its first reading has it."""
    like: str = ""
    """Of a line listing: the method whose sentences its trace has."""
    beside: "PrintedListing | None" = None
    """Of a line listing: the listing that runs beside it; ``None``: the method ``right``."""
    registered: str = ""
    """Name of the method of the table that is this listing; empty: it is in no table."""
    method: Method | None = field(init=False, default=None)
    """Of a line listing: a row like that of ``like``, with its own function and listing."""

    def __post_init__(self) -> None:
        if self.rule is not None:
            print_as(self.rule.listing, self.text.replace(*self.read) if self.read[0] else self.text)
            object.__setattr__(self, "text", without_labels(self.text))
            made = replace(
                table.get(self.family, self.like),
                title=f"{self.title} ({self.lecture})",
                source=f"{self.lecture}, {self.slide}",
                exact_for="",
                breaks_where="",
                function=self.rule,
                listing=self.rule.listing,
                operations=line_rows(self.like, *self.rows),
                traits=LineTraits(
                    takes_pixels=self.rule.takes_pixels, columns=signed_lengths, right=self.right
                ),
            )
            object.__setattr__(self, "method", made)

    def settings(self, others: Settings) -> Settings:
        """Return ``others`` with this listing in place of a line method.

        Raises ValueError if it is not a line listing that runs in the pipeline.
        """
        if self.method is None:
            raise ValueError(f"{self.name} does not run in place of a line method")
        return replace(others, line=self.like).replaced(line=self.method)


@dataclass(frozen=True)
class Divergence:
    """The first step at which a printed listing and the right method differ."""

    step: int
    """Number of the pixel along the line, from 0."""
    printed: tuple[int, int, float] | None
    """Column, row and decision of the printed listing; ``None``: it has ended."""
    right: tuple[int, int, float] | None
    """The same of the right method."""


def first_divergence(
    listing: Callable[..., Listed], right: str, ends: tuple[float, float, float, float]
) -> Divergence | None:
    """Return where a printed line listing first draws another pixel than a method, ``None``: nowhere.

    Parameters
    ----------
    listing : callable
        A reading of a printed line listing.
    right : str
        Name of a method of the family ``line``.
    ends : tuple of float
        x0, y0, x1, y1, with pixel centres on whole numbers; both draw the last pixel if they ever do.
    """
    method = table.get("line", right).listing
    assert method is not None, f"{right} has no listing"
    mine, its = listing(*ends, True), method(*ends, True)
    if line_traits(right).takes_pixels:
        # It lists D with the pixel that was there before the decision.
        its = [(x, y, D) for (x, y, _), D in zip(its, [nan, *(pixel[2] for pixel in its)], strict=False)]
    for step in range(max(len(mine), len(its))):
        printed, wanted = (pixels[step] if step < len(pixels) else None for pixels in (mine, its))
        if printed is None or wanted is None or printed[:2] != wanted[:2]:
            return Divergence(step, printed, wanted)
    return None


def half_up(value: float) -> int:
    """Round to the nearest whole number, half up, as the slides' ``round``."""
    return floor(value) + (value - floor(value) >= 0.5)
