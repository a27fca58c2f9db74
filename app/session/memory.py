"""How much memory there is, and how much the content of a file may take: asked before anything is allocated."""

import math
import os
from pathlib import Path

ALLOWANCE = 3 * 2**26
"""Bytes that a file may always take, however little it holds: with the program itself these are 256 MB."""
FACTOR = 10
"""Bytes that it may take beyond that for each byte of the arrays it holds."""
MEBI, GIBI = 2**20, 2**30


class MemoryBoundError(ValueError):
    """Something would take too much memory; the message is a sentence that begins with ``what``."""


class Need:
    """What the parts of one file take together, and what they hold."""

    def __init__(self, allowance: int = ALLOWANCE, factor: int = FACTOR) -> None:
        self._allowance, self._factor, self._taken, self._held = allowance, factor, 0, 0

    def ask(self, taken: int, held: int, what: str) -> None:
        """Count a part that takes ``taken`` bytes for ``held`` bytes of the file, or raise MemoryBoundError."""
        bound = self._allowance + self._factor * (self._held + held)
        if self._taken + taken > bound:
            text, least = amounts(self._taken + taken, bound)
            raise MemoryBoundError(
                f"{what} would take {text} of memory, and the limit for its content is {least}"
            )
        check_free(self._taken + taken, what)
        self._taken += taken
        self._held += held


def check_free(wanted: int, what: str) -> None:
    """Raise MemoryBoundError if ``what`` takes ``wanted`` bytes and that is more than is free."""
    free = free_memory()
    if wanted > free:
        text, there = amounts(wanted, int(free))
        raise MemoryBoundError(f"{what} may take {text} of memory, {there} are free")


def amounts(wanted: int, bound: int) -> tuple[str, str]:
    """Return two numbers of bytes as texts, the larger one rounded up and the smaller one down, so that they differ.

    Examples
    --------
    >>> amounts(3 * 2**29 + 1, 3 * 2**29), amounts(300 * 2**20, 2**20)
    (('1.6 GiB', '1.5 GiB'), ('300.0 MiB', '1.0 MiB'))
    """
    unit, name = (GIBI, "GiB") if wanted >= GIBI else (MEBI, "MiB")
    return (
        f"{math.ceil(10 * wanted / unit) / 10:.1f} {name}",
        f"{math.floor(10 * bound / unit) / 10:.1f} {name}",
    )


def free_memory(system: Path = Path("/")) -> float:
    """Return the bytes that this process may still take, infinity where that cannot be known.

    Parameters
    ----------
    system : Path
        Where ``proc`` and ``sys`` are.

    Notes
    -----
    The least of what is free on this machine and in every control group of Linux around this process, which is what a
    container is limited by.
    """
    found = [_free_of_machine(system)]
    for line in _lines(system / "proc/self/cgroup"):
        _, controllers, inner = line.split(":", 2)
        if not controllers:
            found += _free_of_groups(system / "sys/fs/cgroup", inner, "memory.max", "memory.current")
        elif "memory" in controllers.split(","):
            names = "memory.limit_in_bytes", "memory.usage_in_bytes"
            found += _free_of_groups(system / "sys/fs/cgroup/memory", inner, *names)
    return max(0.0, min(found))


def _free_of_machine(system: Path) -> float:
    """Return what is free on this machine: without what could be freed where only the whole is known."""
    for line in _lines(system / "proc/meminfo"):
        if line.startswith("MemAvailable:"):
            return float(line.split()[1]) * 1024
    if hasattr(os, "sysconf") and "SC_PHYS_PAGES" in os.sysconf_names:
        return float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    return math.inf


def _free_of_groups(root: Path, inner: str, limit_name: str, used_name: str) -> list[float]:
    """Return what is free in a control group and in those around it; pages of files that are unused count as free."""
    found = []
    group = root / inner.lstrip("/")
    for folder in [group, *group.parents]:
        limit, used = _lines(folder / limit_name), _lines(folder / used_name)
        if limit and used and limit[0].isdecimal() and used[0].isdecimal():
            words = (line.split() for line in _lines(folder / "memory.stat"))
            unused = sum(
                int(value) for name, value in words if name in ("inactive_file", "total_inactive_file")
            )
            found.append(float(int(limit[0]) - int(used[0]) + unused))
        if folder == root:
            break
    return found


def _lines(path: Path) -> list[str]:
    """Return the lines of a file of the system; none where it cannot be read."""
    try:
        return path.read_text(encoding="ascii").splitlines()
    except OSError:
        return []
