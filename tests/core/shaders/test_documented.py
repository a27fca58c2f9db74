"""docs/shaders.md names all functions and limits of the language."""

import re
from pathlib import Path

from core.lanes.problem import SHADER
from core.shaders.expressions import OPERATOR_LIMIT
from core.shaders.shader import BLOCK, SECONDS
from core.shaders.statements import VARIABLE_LIMIT
from core.shaders.words import FUNCTIONS

TEXT = (Path(__file__).parents[3] / "docs" / "shaders.md").read_text(encoding="utf-8")


def test_all_functions_are_listed():
    listed = TEXT.partition("Functions: ")[2].partition(".\n")[0]
    assert set(re.findall(r"`(\w+)`", listed)) == FUNCTIONS


def test_the_limits_are_those_of_the_table():
    rows = dict(re.findall(r"\| ([a-z][^|]+) \| ([^|]+) \|", TEXT.partition("## Limits")[2]))
    numbers = (
        SHADER.characters,
        SHADER.brackets,
        OPERATOR_LIMIT,
        VARIABLE_LIMIT,
        SHADER.rounds,
        SHADER.calls,
    )
    assert list(rows.values())[1:7] == [f"{number:,}" for number in numbers]
    assert rows["lanes at once"].startswith(f"at most {BLOCK:,},")
    assert rows["seconds for a picture"] == f"{SECONDS:g}"
