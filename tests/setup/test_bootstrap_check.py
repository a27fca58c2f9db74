"""The whole check: its parts run one after the other, and the failing ones are named."""

import sys
from pathlib import Path

import pytest

import bootstrap


def test_check_has_all_parts() -> None:
    parts = dict(bootstrap.checks(Path("/x"), ["-k", "edge"]))
    assert list(parts) == ["format", "lint", "import contracts", "tests", "types"]
    assert {"core", "widgets", "lessons", "app", "--strict"} <= set(parts["types"])
    assert parts["tests"][-2:] == ["-k", "edge"]


@pytest.mark.parametrize("failing", [[], ["lint"], ["format", "tests"]])
def test_every_part_runs_and_failures_are_named(
    failing: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def parts(root: Path, arguments: list[str]) -> list[tuple[str, list[str]]]:
        code = "import sys; print('ran', sys.argv[1]); sys.exit(int(sys.argv[2]))"
        names = ["format", "lint", "tests"]
        return [(name, [sys.executable, "-c", code, name, str(int(name in failing))]) for name in names]

    prepared: list[tuple[str, ...]] = []
    monkeypatch.setattr(bootstrap, "prepare", lambda root, pins, needs_qt: prepared.append(pins))
    monkeypatch.setattr(bootstrap, "checks", parts)
    assert bootstrap.main(["test"], tmp_path) == (bootstrap.Exit.CHECK_FAILED if failing else 0)
    output = capfd.readouterr()
    ran = [line for line in output.out.splitlines() if line.startswith("ran")]
    assert ran == ["ran format", "ran lint", "ran tests"]
    assert output.err == (f"The check failed: {', '.join(failing)}\n" if failing else "")
    assert prepared == [bootstrap.TEST_PINS]


def test_running_installs_no_check_tools() -> None:
    assert set(bootstrap.RUN_PINS) < set(bootstrap.TEST_PINS)
    run_pins = "".join((bootstrap.ROOT / pins).read_text() for pins in bootstrap.RUN_PINS)
    assert "pytest" not in run_pins
    assert "moderngl" not in run_pins
