"""A plan speaks of what the scene is made of: of segments and points no triangle, and nothing that faces away."""

import re

import pytest

from app.cli.plan import report_text
from app.pages.plan.plans import advice_html, findings_html, rows_of
from core.study.planner.measuring import plan_and_check
from core.study.planner.records import Tolerance
from lessons.scenes import make_scene
from tests.covering import every_nth


@pytest.mark.parametrize(("scene", "noun"), every_nth([("segment", "segment"), ("points", "point")], 2))
def test_segments_and_points_are_no_triangles(scene: str, noun: str) -> None:
    report = plan_and_check(make_scene(scene), Tolerance(), rounds=1)
    found = report.plan.findings
    said = [
        *report_text(report),
        *(row.reason for row in rows_of(report.plan, report)),
        findings_html(found),
        advice_html(report.plan.tessellations, found.corner_count),
    ]
    text = " ".join(said)
    assert not re.search(r"triangle|corner|faces? away\.|Closed", text.replace("nothing faces away.", ""))
    assert f"{noun}s: " in text.lower()
    assert report.plan.settings.cull == "none"
