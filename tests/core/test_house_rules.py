"""Rules of the house for the core itself: no window system, shapes in docstrings, files of readable size."""

import ast
import inspect
import pkgutil
from dataclasses import fields, is_dataclass
from importlib import import_module
from pathlib import Path

import core
from core.explain import steps
from core.methods import modules_in

FOLDER = Path(core.__file__).parent
MODULES = sorted(module.name for module in pkgutil.walk_packages([str(FOLDER)], "core."))
ARRAY_WORDS = ("Floats", "Integers", "Flags", "Singles", "Bytes", "NDArray", "ndarray", "ArrayLike")
LINE_LIMIT = 450
TOPICS = (
    *("clipping", "coverage", "culling", "depth", "framebuffer", "interpolation"),
    *("lines", "shading", "spans", "textures", "transform", "trees", "visibility"),
)
RUNS = ("stages", "trace", "study", "edits", "fast_path", "pixel_history", "pipeline")
KNOWS_NOT = {
    "rule": ("told", "traced", "measured", "explain", *RUNS),
    "traced": ("told", "measured", "explain", "study"),
    "told": ("measured", "study"),
    "measured": ("told", "explain"),
    "explain": ("told",),
}
"""What the files of a kind do not import; those of all other kinds know no sentences."""


def public_functions(name: str) -> list:
    module = import_module(name)
    functions = [
        value for _, value in inspect.getmembers(module, inspect.isfunction) if value.__module__ == name
    ]
    classes = [value for _, value in inspect.getmembers(module, inspect.isclass) if value.__module__ == name]
    for owner in classes:
        if owner.__name__.startswith("_"):
            continue
        functions += [value for value in vars(owner).values() if inspect.isfunction(value)]
    return [function for function in functions if not function.__name__.startswith("_")]


FUNCTIONS = [function for name in MODULES for function in public_functions(name)]


def test_files_are_of_readable_size() -> None:
    folders = [FOLDER, *(FOLDER.parent / name for name in ("app", "lessons", "widgets"))]
    files = [path for folder in folders for path in folder.rglob("*.py")]
    lengths = {
        path.relative_to(FOLDER.parent).as_posix(): len(path.read_bytes().splitlines()) for path in files
    }
    assert {file for file, length in lengths.items() if length > LINE_LIMIT} == set()


def test_modules_say_what_they_are() -> None:
    assert [name for name in ["core", *MODULES] if not import_module(name).__doc__] == []


def test_public_functions_are_documented() -> None:
    assert [f"{each.__module__}.{each.__qualname__}" for each in FUNCTIONS if not each.__doc__] == []


def test_a_topic_keeps_what_runs_apart_from_what_is_said_of_it() -> None:
    """Rules know no stages, traces, sentences or studies; traces and studies no sentences; and sentences no studies."""
    found = []
    for name in MODULES:
        source = ast.parse(inspect.getsource(import_module(name)))
        imported = {
            node.module for node in ast.walk(source) if isinstance(node, ast.ImportFrom) and node.module
        }
        unknown = KNOWS_NOT.get(kind_of(name), ("told", "explain"))
        found += [(name, other) for other in sorted(imported) if kind_of(other) in unknown]
    assert found == []


def test_every_told_file_is_found() -> None:
    """Those of a pixel's history say what became of the pixel, not what a step does."""
    told = {name for name in MODULES if kind_of(name) == "told" and "pixel_history" not in name}
    assert {name for topic in steps.TOPICS for name in modules_in(f"core.{topic}", "told")} == told


def kind_of(name: str) -> str:
    """Return what a module is: ``told``, ``traced``, ``measured``, a ``rule`` of a topic, or its mechanism."""
    parts = name.split(".")
    if parts[0] != "core" or len(parts) == 1:
        return ""
    of_file = next((kind for kind in ("told", "traced", "measured") if parts[-1].startswith(kind)), "")
    return of_file or ("rule" if parts[1] in TOPICS else parts[1])


def test_records_of_arrays_are_frozen_and_compared_by_identity() -> None:
    for name in MODULES:
        module = import_module(name)
        for _, record in inspect.getmembers(module, inspect.isclass):
            if record.__module__ != name or not is_dataclass(record):
                continue
            types = [str(field.type) for field in fields(record)]
            if any(word in text for text in types for word in ARRAY_WORDS if "Callable" not in text):
                parameters = record.__dataclass_params__
                assert parameters.frozen, record
                assert not parameters.eq, record
