"""The README names the keys of the table and nothing else, and the commands that there are."""

import re
from pathlib import Path

from app.cli.commands import COMMANDS
from app.window.actions import ACTIONS
from app.window.keys import LOCAL_KEYS, KeyAction, key_text

README = (Path(__file__).resolve().parents[2] / "README.md").read_text(encoding="utf-8")
BY_MOUSE = {"click", "wheel", "right drag"}
RANGES = {"1 … 9": "123456789", "Ctrl+1 … Ctrl+0": [f"Ctrl+{k}" for k in range(10)]}
ARROWS = {"Alt+arrows": [f"Alt+{way}" for way in ("Left", "Right", "Up", "Down")]}


def keys_of_readme() -> set[str]:
    table = README.split("## Keys")[1].split("## ")[0]
    keys: set[str] = set()
    for line in table.splitlines():
        if line.startswith("| ") and not line.startswith(("| keys", "| ---")):
            for name in re.split(r"[;,()] *| or | and ", line.split("|")[1].strip()):
                keys.update(RANGES.get(name.strip()) or ARROWS.get(name.strip()) or [name.strip()])
    return keys - BY_MOUSE - {""}


def keys_of(actions: tuple[KeyAction, ...]) -> list[set[str]]:
    return [set(key_text(action).split(", ")) for action in actions if action.keys]


def test_every_key_of_the_readme_does_something() -> None:
    assert keys_of_readme() - set().union(*keys_of((*ACTIONS, *LOCAL_KEYS))) == set()


def test_every_action_with_a_key_is_in_the_readme() -> None:
    named = keys_of_readme()
    assert [keys for keys in keys_of(ACTIONS) if not keys & named] == []


def test_every_command_is_in_the_readme() -> None:
    commands = README.split("## Without a window")[1].split("## ")[0]
    assert [command.name for command in COMMANDS if f"rasterscope {command.name}" not in commands] == []
