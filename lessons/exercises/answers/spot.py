"""What is wrong with a picture: a pixel that a mistake changed, and the name of the mistake."""

import re
from dataclasses import dataclass
from typing import ClassVar

from core.records.cells import Form, Marks
from core.records.frame import Frame
from core.records.words import counted
from lessons.exercises.answers.answer import Answer, NotCheckedError, Verdict, read_names
from lessons.exercises.answers.choices import CHOICE_LIMIT
from lessons.exercises.answers.marked import Pixel, PixelAnswer, Pixels, all_pixels
from lessons.exercises.numbers import Draws


@dataclass(frozen=True)
class Spot:
    """Pixels that are pointed at, and the mistake that is said to have changed them; either may be missing."""

    pixels: Pixels
    option: int | None


@dataclass(frozen=True, eq=False)
class SpotAnswer(Answer):
    """The picture of a run with a mistake: where it shows, and which it is."""

    size: tuple[int, int]
    """Columns and rows."""
    picture: Frame
    """What is shown: the run with the mistake."""
    wrong: Pixels
    """Pixels that differ from the right picture."""
    options: tuple[str, ...] = ()
    """Mistakes to choose from; none: only the place is asked."""
    right: int = 0
    """The option that made the picture."""

    kind: ClassVar[str] = "spot"
    is_many: ClassVar[bool] = False
    slip: ClassVar[str] = "A slip: all but one of the pixels differ from the right picture."

    def __post_init__(self) -> None:
        PixelAnswer(self.size, self.wrong)
        count = len(self.options)
        if self.options and not (2 <= count <= CHOICE_LIMIT and 0 <= self.right < count):
            raise ValueError(f"expected 2 to {CHOICE_LIMIT} mistakes to choose from, got {count}")

    @property
    def reference(self) -> Spot:
        """All pixels that differ, and the mistake."""
        return Spot(self.wrong, self.right if self.options else None)

    @property
    def _share(self) -> float:
        """Share of the points that the place earns."""
        return 0.5 if self.options else 1.0

    @property
    def offered(self) -> str:
        """The mistakes to choose from."""
        return "\n".join(f"- {option}" for option in self.options)

    @property
    def credit(self) -> str:
        """How points are given."""
        place = "one or more pixels that differ from the right picture, and no other,"
        if not self.options:
            return f"To click {place} earns all points."
        return f"To click {place} earns half of the points, the mistake the other half."

    @property
    def chance(self) -> float:
        """Mean score of one pixel and one mistake."""
        columns, rows = self.size
        place = self._share * len(self.wrong) / (columns * rows)
        return place + (0.5 / len(self.options) if self.options else 0.0)

    @property
    def form(self) -> Form:
        """The raster and the options."""
        return Form(self.kind, items=self.options, size=self.size)

    def given(self, response: Spot) -> dict[str, object]:
        """Return the pixels and the option."""
        option = "" if response.option is None else self.options[response.option]
        return {"pixels": sorted(map(list, response.pixels)), "option": option}

    def read(self, given: object) -> Spot:
        """Read a table of pixels (as text art, or a list) and an option, or one of the two alone."""
        parts = given if isinstance(given, dict) else {"option" if given in self.options else "pixels": given}
        unknown = [str(key) for key in parts if key not in ("pixels", "option")]
        if unknown:
            raise NotCheckedError(f"expected pixels and option, got {unknown[0]!a:.40}")
        pixels, option = parts.get("pixels", []), parts.get("option", "")
        if pixels in ("", []) and option in ("", []):
            raise NotCheckedError("the answer is empty")
        marked = frozenset() if pixels in ("", []) else PixelAnswer(self.size, self.wrong).read(pixels)
        if option in ("", []):
            return Spot(marked, None)
        if not self.options:
            raise NotCheckedError("expected pixels alone: this question names no mistakes")
        chosen = read_names(option, self.options)
        if len(chosen) != 1:
            raise NotCheckedError(f"expected one mistake, got {len(chosen)}")
        return Spot(marked, chosen[0])

    def check(self, response: Spot) -> Verdict:
        """Score the place and the mistake."""
        right, extra = response.pixels & self.wrong, response.pixels - self.wrong
        is_named = bool(self.options) and response.option == self.right
        score = self._share * self._has_place(response) + (1 - self._share) * is_named
        words = [f"{counted(len(right), 'pixel')} of the mistake, {len(extra)} other"]
        if self.options:
            words.append(
                "no mistake named"
                if response.option is None
                else f"mistake {'right' if is_named else 'wrong'}"
            )
        options = [] if response.option is None else [response.option]
        named: Marks = {"right": [*right, *options]} if is_named else {"right": right, "wrong": options}
        marks = {**named, "extra": extra}
        return Verdict(score, "; ".join(words), marks)

    def is_same(self, one: Spot, other: Spot) -> bool:
        """Compare the mistakes, and whether the places are right."""
        return one.option == other.option and self._has_place(one) == self._has_place(other)

    def _has_place(self, spot: Spot) -> bool:
        return bool(spot.pixels) and spot.pixels <= self.wrong

    def is_slip(self, response: Spot) -> bool:
        """The mistake is right, and all but one of three or more pixels."""
        extra = response.pixels - self.wrong
        return len(extra) == 1 and len(response.pixels) >= 3 and response.option == self.reference.option

    def text(self, response: Spot) -> str:
        """Return the pixels as (column, row), and the mistake."""
        pixels = ", ".join(map(str, sorted(response.pixels))) or "no pixel"
        named = [] if response.option is None else [self.options[response.option]]
        return "; ".join([pixels, *named])

    def said(self, text: str) -> dict[str, object]:
        """Return the pixels and the option of a text."""
        pixels, _, option = text.partition("; ")
        found = re.findall(r"\((\d+), (\d+)\)", pixels)
        return {"pixels": [[int(i), int(j)] for i, j in found], "option": option}

    def left_out(self, response: Spot) -> str:
        """Say which half is missing."""
        if not response.pixels:
            return "No pixel is marked"
        return "No mistake is named" if self.options and response.option is None else ""

    def first_wrong(self, response: Spot) -> str:
        """Name the first pixel that does not differ."""
        extra: list[Pixel] = sorted(response.pixels - self.wrong)
        return f"Pixel {extra[0]} is the same in the right picture." if extra else ""

    def random(self, draws: Draws) -> Spot:
        """Guess a pixel and a mistake."""
        columns, rows = self.size
        pixel = draws.whole(0, columns - 1), draws.whole(0, rows - 1)
        return Spot(frozenset({pixel}), draws.whole(0, len(self.options) - 1) if self.options else None)

    def extremes(self) -> list[Spot]:
        """Click all pixels, none."""
        return [Spot(all_pixels(self.size), None), Spot(frozenset(), None)]
