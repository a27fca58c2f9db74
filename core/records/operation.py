"""What a row of a trace does: methods name the operations of their rows, and wait for nothing else that steps."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Operation:
    """One thing that a row does."""

    name: str
    """Key of its sentence and formula, within the kind of its row."""
    label: str
    """Label of its line in the listing."""
    sets: tuple[str, ...] = ()
    """Variables that it gives a value."""
