"""What was measured on: the processor, the system, the versions and the day; nothing about its user."""

import platform
from datetime import UTC, datetime
from pathlib import Path

import numpy as np


def machine(program_version: str) -> dict[str, str]:
    """Return processor, system, versions of Python, NumPy and Rasterscope, and the date (ISO)."""
    return {
        "processor": processor_name(),
        "system": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        "numpy": np.__version__,
        "rasterscope": program_version,
        "date": datetime.now(UTC).strftime("%Y-%m-%d"),
    }


def processor_name() -> str:
    """Return the processor's name, where the system tells it."""
    table = Path("/proc/cpuinfo")
    if table.is_file():
        for line in table.read_text(encoding="utf-8", errors="replace").splitlines():
            key, _, value = line.partition(":")
            if key.strip() == "model name":
                return " ".join(value.split())
    return platform.processor() or platform.machine()
