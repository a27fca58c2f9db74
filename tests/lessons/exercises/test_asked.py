"""Everything that there is to ask about is asked, or says why not; every name is one that exists."""

import tomllib
from pathlib import Path

import pytest

from app.cli.exercise import coverage_lines
from core import STAGES
from core.settings import families
from core.study.stability import experiments
from lessons.exercises import catalogue, templates
from lessons.exercises.asked import LECTURES, kinds_by_stage, mistake_topics, topics
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.question import WRITTEN, ask, template
from lessons.mistakes.shelf import MISTAKES

ORDER = Path(catalogue.__file__).with_name("order.toml")


def test_every_topic_has_templates_or_a_reason() -> None:
    for rows in topics().values():
        assert rows
        for topic in rows:
            assert bool(topic.templates) != topic.reason.endswith("."), topic
            assert set(topic.templates) <= set(TEMPLATES), topic


def test_families_experiments_and_lectures_are_all_listed() -> None:
    assert [topic.name for topic in topics()["families"]] == list(families())
    assert {topic.name for topic in topics()["experiments"]} == {one.info.name for one in experiments}
    assert {topic.name for topic in topics()["mistakes"]} <= set(MISTAKES)
    assert set(topics()) == {"families", "experiments", "mistakes", *LECTURES}


def test_every_slip_of_a_printed_listing_is_asked() -> None:
    text = (Path(__file__).parents[3] / "docs" / "lectures.md").read_text(encoding="utf-8")
    slips = text.split("## Where the slides slip")[1].count("\n| ") - 2
    asked = [topic for name in LECTURES for topic in topics()[name] if "(a slip)" in topic.name]
    assert len(asked) == slips - 1, (
        "the slip of LMU's scanline fill is asked as: What's wrong with this picture?"
    )


def test_every_template_of_the_folder_is_found_and_no_name_used_twice() -> None:
    files = [path.stem for folder in templates.__path__ for path in Path(folder).glob("*.toml")]
    assert sorted([*WRITTEN, *files]) == sorted(TEMPLATES)
    with pytest.raises(ValueError, match="two templates are called facing"):
        template("facing", 1, "Facing", "cull", 1)(TEMPLATES["facing"].make)


def test_the_order_stands_stage_by_stage_and_names_no_template_twice() -> None:
    order = tomllib.loads(ORDER.read_text(encoding="utf-8"))
    assert tuple(order) == STAGES
    assert [
        (name, stage) for stage, lists in order.items() for names in lists.values() for name in names
    ] == [(template.name, template.stage) for template in TEMPLATES.values()]


@pytest.mark.slow
def test_the_coverage_has_no_empty_row() -> None:
    questions = {name: ask(template, 0) for name, template in TEMPLATES.items()}
    kinds = kinds_by_stage(questions)
    assert list(kinds) == list(STAGES)
    assert all(counts.total() for counts in kinds.values())
    assert all(topic.templates or topic.reason for topic in mistake_topics(questions))
    lines = coverage_lines()
    assert lines[0].startswith("stage")
    assert any(line.startswith("questions of LMU: ") for line in lines)
