"""``rasterscope exercise coverage``: what the templates ask, and what none asks, with the reason."""

from lessons.exercises.asked import LECTURES, Topic, kinds_by_stage, mistake_topics, topics
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.question import ask

WIDTH = 66
"""Characters of the names of topics."""


def coverage_lines() -> list[str]:
    """Return the tables as lines of text; one question of every template is drawn."""
    questions = {name: ask(template, 0) for name, template in TEMPLATES.items()}
    by_stage = kinds_by_stage(questions)
    kinds = sorted({kind for counts in by_stage.values() for kind in counts})
    lines = ["".join(["stage".ljust(13), *(kind.rjust(len(kind) + 2) for kind in kinds), "  templates"])]
    for stage, counts in by_stage.items():
        cells = (str(counts[kind] or ".").rjust(len(kind) + 2) for kind in kinds)
        lines.append("".join([stage.ljust(13), *cells, str(counts.total()).rjust(11)]))
    sections = {
        "families of methods": topics()["families"],
        "experiments of the atlas": topics()["experiments"],
        "mistakes": mistake_topics(questions),
        **{f"questions of {lecture}": topics()[lecture] for lecture in LECTURES},
    }
    for title, rows in sections.items():
        asked = sum(bool(row.templates) for row in rows)
        lines += ["", f"{title}: {asked} of {len(rows)} asked", *map(topic_line, rows)]
    return lines


def topic_line(topic: Topic) -> str:
    """Return a topic with its templates, or the reason why it has none."""
    said = ", ".join(topic.templates) if topic.templates else f"- {topic.reason}"
    return f"  {topic.name:<{WIDTH}} {said}"
