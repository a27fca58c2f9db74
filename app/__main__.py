"""Entry of the program: ``python -m app`` and the command ``rasterscope``."""

import io
import sys
from collections.abc import Sequence
from typing import Any

from app.cli.commands import run_command_line


def main(argv: Sequence[str] | None = None) -> int:
    """Do what the command line asks; return the exit code.

    Parameters
    ----------
    argv : sequence of str, optional
        Arguments without the program's name; those of this process by default.
    """
    if argv is None:
        sys.stdout = _written_whole(sys.stdout)
    return run_command_line(sys.argv[1:] if argv is None else argv)


def _written_whole(output: Any) -> Any:
    """Return a standard output that writes a whole text or fails: an unbuffered one drops what has no room."""
    if not isinstance(output, io.TextIOWrapper) or not isinstance(output.buffer, io.RawIOBase):
        return output
    encoding, errors = output.encoding, output.errors
    return io.TextIOWrapper(io.BufferedWriter(output.detach()), encoding, errors, line_buffering=True)


if __name__ == "__main__":
    sys.exit(main())
