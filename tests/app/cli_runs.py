"""Runs of the program as a user starts it: a process of its own."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def run_program(*arguments, cwd=None, stdin=None, **variables):
    """Run ``rasterscope`` with these arguments and return the finished process."""
    texts = {name: str(value) for name, value in variables.items()}
    environment = dict(os.environ, PYTHONPATH=str(ROOT), PYTHONWARNINGS="error", **texts)
    command = [sys.executable, "-P", "-m", "app", *map(str, arguments)]
    return subprocess.run(
        command, capture_output=True, encoding="utf-8", cwd=cwd, env=environment, input=stdin, timeout=120
    )


def refused(code, *arguments, **how):
    """Run the program where it must fail with ``code``; return its one line without the line's end."""
    run = run_program(*arguments, **how)
    assert run.returncode == code, run.stderr
    assert run.stdout == ""
    lines = run.stderr.splitlines()
    assert len(lines) == 1, run.stderr
    assert lines[0].startswith("rasterscope")
    return lines[0]
