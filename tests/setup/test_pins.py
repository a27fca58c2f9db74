"""What is pinned, what is declared and what is imported are the same."""

import importlib.metadata
import re
import sys
import tomllib
from functools import cache
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import bootstrap

ROOT = bootstrap.ROOT
PACKAGES = ("app", "core", "lessons", "widgets")
# Where the name that is imported is not the name of the distribution.
DISTRIBUTIONS = {
    "PIL": "pillow",
    "PySide6": "pyside6-essentials",
    "cv2": "opencv-python-headless",
    "mpl_toolkits": "matplotlib",
    "skimage": "scikit-image",
    "vtkmodules": "vtk",
}
EXTRAS = {"gpu": ("requirements/gpu.txt",), "bench": ("requirements/gpu.txt", "requirements/bench.txt")}


def read_pins(name: str) -> dict[str, str]:
    lines = (ROOT / name).read_text(encoding="utf-8").splitlines()
    pins = [line for line in lines if line and not line.startswith("#")]
    assert [line for line in pins if not re.fullmatch(r"[A-Za-z0-9._-]+==[0-9][0-9a-z.]*", line)] == []
    return {canonicalize_name(name): version for name, version in (line.split("==") for line in pins)}


def read_declared() -> tuple[list[Requirement], dict[str, list[Requirement]]]:
    """Return what is needed, and what each extra needs."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    declared = [Requirement(text) for text in project["dependencies"]]
    return declared, {name: [Requirement(text) for text in extras[name]] for name in extras}


IMPORT = re.compile(r"^[ ]*(?:from (\w[\w.]*) import\b|import (\w.*))", re.MULTILINE)
"""A statement as the formatter leaves it, on a line of its own: to parse every file takes twenty times as long."""


@cache
def imported_distributions(package: str) -> dict[str, set[Path]]:
    """Return the distributions that a package imports, and where."""
    found: dict[str, set[Path]] = {}
    for path in sorted((ROOT / package).rglob("*.py")):
        for module, names in IMPORT.findall(path.read_text(encoding="utf-8")):
            tops = {name.strip().partition(" ")[0].partition(".")[0] for name in (module or names).split(",")}
            for top in tops - sys.stdlib_module_names - set(PACKAGES):
                found.setdefault(canonicalize_name(DISTRIBUTIONS.get(top, top)), set()).add(path)
    return found


@pytest.mark.parametrize("name", bootstrap.TEST_PINS)
def test_pins_are_exact_and_installed(name: str) -> None:
    for distribution, version in read_pins(name).items():
        assert importlib.metadata.version(distribution) == version


def test_pins_lie_in_the_declared_ranges() -> None:
    declared, extras = read_declared()
    assert set(extras) == set(EXTRAS)
    wanted = [(declared, ("requirements/run.txt",)), *((extras[name], EXTRAS[name]) for name in EXTRAS)]
    for requirements, files in wanted:
        pins = {name: version for file in files for name, version in read_pins(file).items()}
        for requirement in requirements:
            assert pins[canonicalize_name(requirement.name)] in requirement.specifier


def test_pins_of_the_same_distribution_agree() -> None:
    """The benchmark is installed into the environment that the check uses too."""
    found: dict[str, set[str]] = {}
    for file in {*bootstrap.TEST_PINS, *bootstrap.BENCH_PINS}:
        for name, version in read_pins(file).items():
            found.setdefault(name, set()).add(version)
    assert {name: versions for name, versions in found.items() if len(versions) > 1} == {}


@pytest.mark.parametrize("names", [("requirements/run.txt",), ("requirements/gpu.txt",), bootstrap.TEST_PINS])
def test_pins_are_complete(names: tuple[str, ...]) -> None:
    """Whatever a pinned distribution needs on this system is pinned too."""
    pins = {name for each in names for name in read_pins(each)}
    missing = set()
    for name in pins:
        for text in importlib.metadata.requires(name) or []:
            requirement = Requirement(text)
            if requirement.marker is None or requirement.marker.evaluate({"extra": ""}):
                missing |= {canonicalize_name(requirement.name)} - pins
    assert missing == set()


@pytest.mark.parametrize("package", PACKAGES)
def test_imports_are_declared(package: str) -> None:
    declared, extras = read_declared()
    extra = [requirement for requirements in extras.values() for requirement in requirements]
    allowed = {canonicalize_name(each.name) for each in (*declared, *extra)}
    imported = imported_distributions(package)
    assert {name: places for name, places in imported.items() if name not in allowed} == {}


def test_core_imports_numpy_only() -> None:
    assert set(imported_distributions("core")) <= {"numpy"}
