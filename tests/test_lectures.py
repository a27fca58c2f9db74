"""docs/lectures.md has all topics of the lectures and names nothing that there is not."""

import re
from pathlib import Path

import pytest

from app.files.open_any import open_any
from core.methods import table
from core.setting_texts import settings_from_texts
from core.settings import families, no_effect
from core.stages.declared import STAGES
from lessons.course.catalogue import shipped
from lessons.lectures.catalogue import PRINTED
from lessons.lectures.scenes import ALL_SCENES

ROOT = Path(__file__).parents[1]
TEXT = (ROOT / "docs" / "lectures.md").read_text(encoding="utf-8")
COLUMNS = ("number", "topic", "lecture", "scene", "stage", "method", "lesson", "test", "missing")
NONE = "-"
ROWS = [
    dict(zip(COLUMNS, (cell.strip() for cell in line.strip("|").split("|")), strict=True))
    for line in TEXT.splitlines()
    if re.match(r"\| \d+ \|", line)
]


def names(row, column):
    """Return the names in a cell."""
    return [] if row[column] == NONE else row[column].split(", ")


def assert_steps(places):
    """Fail where a lesson has no such step."""
    for place in places:
        name, _, step = place.partition("/")
        assert 1 <= int(step) <= len(shipped().named(name).steps), place


def test_all_48_topics_are_there_and_every_gap_is_named():
    assert [int(row["number"]) for row in ROWS] == list(range(1, 49))
    for row in ROWS:
        has_test = row["test"] != NONE
        assert row["missing"], row
        assert (row["scene"] != NONE) == (row["stage"] != NONE) == has_test, row
        assert has_test or row["missing"] != "nothing", row


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["number"])
def test_every_name_of_a_row_exists(row):
    assert set(names(row, "scene")) <= set(ALL_SCENES)
    assert set(names(row, "stage")) <= set(STAGES)
    for method in names(row, "method"):
        family, _, name = method.partition("=")
        assert family in families()
        assert name in table.names(family)
    assert_steps(names(row, "lesson"))
    for test in names(row, "test"):
        file, _, function = test.partition("::")
        assert (
            f"def {function}(" in (ROOT / file).read_text(encoding="utf-8")
            if function
            else (ROOT / file).exists()
        )


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["number"])
def test_every_method_of_a_row_acts_in_a_scene_and_every_scene_has_one_that_acts(row):
    methods = [method.split("=") for method in names(row, "method")]
    documents = {name: open_any(name).document for name in names(row, "scene")}
    acting = set()
    for family, method in methods:
        others = {name: value for name, value in methods if name != family}
        for name, document in documents.items():
            settings = settings_from_texts({**others, family: method}, document.settings)
            if not no_effect(settings, family, document.scene):
                acting |= {(family, method), name}
    assert acting >= {*map(tuple, methods), *(documents if methods else ())}


def test_printed_listings_and_scenes_of_the_text_exist():
    shown = set(re.findall(r"`rasterscope slides ([a-z][\w-]*)", TEXT))
    assert shown <= {printed.name for printed in PRINTED}
    slips = [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in TEXT.split("## Where the slides slip")[1].splitlines()
        if line.startswith("| ") and not line.startswith(("| slide", "| ---"))
    ]
    assert len(slips) == 8
    for *_, seen, lesson in slips:
        assert seen.startswith("`rasterscope slides ") or seen in ALL_SCENES
        assert_steps([lesson])
