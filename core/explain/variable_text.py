"""How a variable of a trace is shown in the table: its name, its meaning, and when it is known."""

from dataclasses import dataclass

GIVEN = ""
"""Marks variables that are there before the first operation."""


@dataclass(frozen=True)
class VariableText:
    """How one variable of a trace is shown."""

    label: str
    """What it is called; ``#`` stands for the number of an element or edge."""
    meaning: str
    after: str = "itself"
    """The variable that must be known before this one is shown; `GIVEN`: none."""
    spread: str = ""
    """Elements of an array with rows of their own: ``edges`` (0, 1, 2, coloured), ``parts``, or those of ``corners``
    that are numbers."""
    edge: int | None = None
    """0, 1 or 2 where the variable belongs to that edge."""
    previous: str = ""
    """The variable that holds its value before the step, where there was one."""
    is_key: bool = False
    """Whether it is a packed key, to be shown in hexadecimal."""
