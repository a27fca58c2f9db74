"""Public functions that take arrays name their shapes; a registered method may leave it to its family."""

import inspect
import pkgutil
import re
from importlib import import_module
from pathlib import Path

import core
from core.methods import table
from core.records.listing import listing

FOLDER = Path(core.__file__).parent
MODULES = sorted(module.name for module in pkgutil.walk_packages([str(FOLDER)], "core."))
ARRAY_WORDS = ("Floats", "Integers", "Flags", "Singles", "Bytes", "NDArray", "ndarray", "ArrayLike")
SHAPE = re.compile(r"\((?:\.\.\.|[A-Z]\w?|\d)(?:\s?[,*]\s?(?:[\w.+* ]+)?)*\)|scalar|any shape|one ")
METHODS = [row.function for row in table]


def public_functions(name: str) -> list:
    module = import_module(name)
    functions = [
        value for _, value in inspect.getmembers(module, inspect.isfunction) if value.__module__ == name
    ]
    classes = [value for _, value in inspect.getmembers(module, inspect.isclass) if value.__module__ == name]
    for owner in classes:
        if not owner.__name__.startswith("_"):
            functions += [value for value in vars(owner).values() if inspect.isfunction(value)]
    return [function for function in functions if not function.__name__.startswith("_")]


FUNCTIONS = [function for name in MODULES for function in public_functions(name) if function not in METHODS]


def takes_arrays(function) -> bool:
    annotations = [str(p.annotation) for p in inspect.signature(function).parameters.values()]
    return any(word in annotation for annotation in annotations for word in ARRAY_WORDS)


def is_listing(function) -> bool:
    return bool(listing(function).lines)


def test_functions_of_arrays_document_a_shape() -> None:
    # A shape is written as (T, 3) or the like; a method of a family may leave it to the first of the family.
    wanted = [function for function in FUNCTIONS if takes_arrays(function) and not is_listing(function)]
    found = [f"{f.__module__}.{f.__qualname__}" for f in wanted if not SHAPE.search(f.__doc__ or "")]
    assert found == []
