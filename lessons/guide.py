"""The guides of Help: what to do, step by step, with links that do it."""

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
    listing: str = ""
    """A file that the step shows; empty: none."""


@cache
def guide(name: str = "guide") -> tuple[GuideStep, ...]:
    """Return the steps of a guide in order: the one of five minutes, ``change_line`` or ``own_exercise``."""
    import tomllib  # As the glossary.

    def text(file: str) -> str:
        return (FOLDER / file).read_text(encoding="utf-8")

    return tuple(
        GuideStep(row["title"], row["text"], row["links"], text(row["file"]) if "file" in row else "")
        for row in tomllib.loads(text(f"{name}.toml"))["step"]
    )
