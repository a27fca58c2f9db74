"""What a command line was wrong about."""

PROGRAM = "rasterscope"
"""Its name, as messages begin with it."""


class UsageError(ValueError):
    """The command line is wrong; the message is one line."""
