"""A failing case as a Python test: triangles, settings and what is right."""

import re
from textwrap import wrap

from core.records.arrays import Floats, Integers
from core.settings import Settings

LINE_LENGTH = 100
NAMES = (
    "Camera",
    "ClipScene",
    "DirectionalLight",
    "Material",
    "Mesh",
    "Scene",
    "Settings",
    "Texture",
    "clip_lines",
    "draw_lines",
    "render",
)
"""Names of ``core`` that a test may call."""


def case_text(title: str, sentence: str, body: str) -> str:
    """Return a Python file with one test.

    Parameters
    ----------
    title : str
        What the test is called, after ``test_``.
    sentence : str
        What goes wrong.
    body : str
        Its statements; they may use ``np`` and the names of ``core``.
    """
    names = [name for name in NAMES if re.search(rf"\b{name}\(", body)]
    imports = ["import numpy as np", ""] if "np." in body else []
    name = "".join(character if character.isalnum() else "_" for character in title)
    remarks = [f"    # {line}" for line in wrap(sentence, LINE_LENGTH)]
    statements = [f"    {line}" for line in body.splitlines()]
    head = [*imports, f"from core import {', '.join(names)}", "", "", f"def test_{name}() -> None:"]
    return "\n".join([*head, *remarks, *statements, ""])


def clip_text(clip: Floats) -> str:
    """Return clip positions (T, 3, 4) as Python writes lists, a line for each corner."""
    lines = ["["]
    for triangle in clip.tolist():
        corners = [f"        [{', '.join(_number(value) for value in corner)}]," for corner in triangle]
        lines += ["    [", *corners, "    ],"]
    return "\n".join([*lines, "]"])


def _number(value: float) -> str:
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)


def cover_text(cover: Integers) -> list[str]:
    """Return how often pixels (H, W) are covered, row by row from the top: ``.`` for 0, ``1`` to ``9`` and more."""
    return ["".join(".123456789"[min(count, 9)] for count in row) for row in cover[::-1].tolist()]


def settings_text(settings: Settings) -> str:
    """Return settings as Python makes them, those that are not the defaults."""
    changed = {name: value for name, value in vars(settings).items() if value != getattr(Settings(), name)}
    return f"Settings({', '.join(f'{name}={_quoted(value)}' for name, value in changed.items())})"


def _quoted(value: str | int) -> str:
    return f'"{value}"' if isinstance(value, str) else str(value)
