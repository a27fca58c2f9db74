"""Entry of the program: ``python -m app`` and the command ``rasterscope``."""

import sys
from collections.abc import Sequence

from app.cli.commands import run_command_line


def main(argv: Sequence[str] | None = None) -> int:
    """Do what the command line asks; return the exit code.

    Parameters
    ----------
    argv : sequence of str, optional
        Arguments without the program's name; those of this process by default.
    """
    return run_command_line(sys.argv[1:] if argv is None else argv)


if __name__ == "__main__":
    sys.exit(main())
