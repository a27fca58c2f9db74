"""What the measurements were made on."""

import os
import platform
from dataclasses import dataclass
from datetime import UTC, datetime

import numpy as np

from app import __version__
from core.study.accuracy.record import processor_name


@dataclass(frozen=True)
class Machine:
    """The machine, the versions and the day."""

    date: str
    processor: str
    cores: int
    system: str
    python: str
    numpy: str
    program: str

    def sentence(self) -> str:
        """Return all of it in one line."""
        return (
            f"{self.processor}, {self.cores} cores, {self.system}; Python {self.python}, NumPy {self.numpy}, "
            f"Rasterscope {self.program}; {self.date}"
        )


def this_machine() -> Machine:
    """Return what is measured on here and now."""
    return Machine(
        date=datetime.now(UTC).strftime("%Y-%m-%d"),
        processor=processor_name(),
        cores=usable_cores(),
        system=f"{platform.system()} {platform.machine()}",
        python=platform.python_version(),
        numpy=np.__version__,
        program=__version__,
    )


def usable_cores() -> int:
    """Return how many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
