"""All listings of the program."""

import inspect
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import core
from core.records.listing import Listing, listing


def listings_of_the_program() -> Iterator[Listing]:
    """Return every function of core that is shown line by line."""
    for file in sorted(Path(core.__file__).parent.rglob("*.py")):
        if "#:" not in file.read_text(encoding="utf-8"):
            continue
        module = import_module(
            ".".join(["core", *file.relative_to(Path(core.__file__).parent).with_suffix("").parts])
        )
        for function in vars(module).values():
            if inspect.isfunction(function) and function.__module__ == module.__name__:
                yield from [found] if (found := listing(function)).lines else []
