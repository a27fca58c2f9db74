"""Runs of the program's command line: within this process, or in one of its own as a user starts it."""

import contextlib
import io
import os
import subprocess
import sys
from pathlib import Path

from app.cli.commands import run_command_line

ROOT = Path(__file__).resolve().parents[3]


def start_program(*arguments, cwd=None, **variables):
    """Start ``rasterscope`` with these arguments and environment variables; return the finished process."""
    texts = {name: str(value) for name, value in variables.items()}
    environment = dict(os.environ, PYTHONPATH=str(ROOT), PYTHONWARNINGS="error", **texts)
    command = [sys.executable, "-P", "-m", "app", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, encoding="utf-8", cwd=cwd, env=environment, input="")


def run_program(*arguments, cwd=None):
    """Run the command line with these arguments in this process: a start takes longer than most commands."""
    command = [str(argument) for argument in arguments]
    output, errors = io.StringIO(), io.StringIO()
    with (
        contextlib.redirect_stdout(output),
        contextlib.redirect_stderr(errors),
        contextlib.chdir(cwd or Path.cwd()),
    ):
        code = run_command_line(command)
    return subprocess.CompletedProcess(command, code, output.getvalue(), errors.getvalue())


def refused(code, *arguments, cwd=None, **variables):
    """Run the program where it must fail with ``code``; return its one line without the line's end.

    With environment variables it is started in a process of its own.
    """
    run = (start_program if variables else run_program)(*arguments, cwd=cwd, **variables)
    assert run.returncode == code, run.stderr
    assert run.stdout == ""
    lines = run.stderr.splitlines()
    assert len(lines) == 1, run.stderr
    assert lines[0].startswith("rasterscope")
    return lines[0]
