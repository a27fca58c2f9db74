"""Runs of the program as a user starts it: a process of its own, or its command line within this one."""

import contextlib
import io
import os
import subprocess
import sys
from pathlib import Path

from app.cli.commands import run_command_line

ROOT = Path(__file__).resolve().parents[3]


def run_program(*arguments, cwd=None, stdin=None, **variables):
    """Run ``rasterscope`` with these arguments and return the finished process."""
    texts = {name: str(value) for name, value in variables.items()}
    environment = dict(os.environ, PYTHONPATH=str(ROOT), PYTHONWARNINGS="error", **texts)
    command = [sys.executable, "-P", "-m", "app", *map(str, arguments)]
    return subprocess.run(
        command, capture_output=True, encoding="utf-8", cwd=cwd, env=environment, input=stdin, timeout=120
    )


def refused(code, *arguments, cwd=None, **how):
    """Run the program where it must fail with ``code``; return its one line without the line's end.

    It runs in this process, which takes a hundredth of the time, unless ``how`` asks for one of its own.
    """
    if how:
        run = run_program(*arguments, cwd=cwd, **how)
        found, output, errors = run.returncode, run.stdout, run.stderr
    else:
        written, told = io.StringIO(), io.StringIO()
        with (
            contextlib.redirect_stdout(written),
            contextlib.redirect_stderr(told),
            contextlib.chdir(cwd or Path.cwd()),
        ):
            found = run_command_line([str(argument) for argument in arguments])
        output, errors = written.getvalue(), told.getvalue()
    assert found == code, errors
    assert output == ""
    lines = errors.splitlines()
    assert len(lines) == 1, errors
    assert lines[0].startswith("rasterscope")
    return lines[0]
