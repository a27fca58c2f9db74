"""The guide of five minutes: what to do, step by step, with links that do it."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

from lessons.glossary import FOLDER


@dataclass(frozen=True)
class GuideStep:
    """One step."""

    title: str
    text: str
    """``{name}`` stands for the key of an action."""
    links: Mapping[str, str]
    """What the step runs, as ``do:stage/raster``, by what the link says."""


@cache
def guide() -> tuple[GuideStep, ...]:
    """Return the steps in order."""
    import tomllib  # As the glossary.

    rows = tomllib.loads((FOLDER / "guide.toml").read_text(encoding="utf-8"))["step"]
    return tuple(GuideStep(row["title"], row["text"], row["links"]) for row in rows)
