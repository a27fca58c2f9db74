"""Every method and every stage has all that the program asks of it; what one lacks is named here, and only here."""

import re
from importlib import import_module

import numpy as np
import pytest

from core import ClipScene, Settings, Texture, render, trace
from core.explain.stage_texts import ACCOUNTS
from core.explain.steps import row_of
from core.methods import Method, table
from core.records.listing import listing
from core.settings import FAMILIES, FIELDS, no_effect
from core.stages.declared import DECLARED, STAGES, Stage
from core.stages.needs import NEEDS, refusal
from tests.core.trace.trace_cases import SCENES

TRIANGLE = np.array([[[-0.8, -0.7, 0.1, 1.0], [1.6, -0.9, 0.4, 2.0], [-0.2, 1.2, 0.2, 1.5]]])
PLAIN = ClipScene(TRIANGLE, np.ones((1, 3, 4)), (9, 7))
TEXTURED = ClipScene(
    TRIANGLE, TRIANGLE[..., :2] * 3, (9, 7), texture=Texture(np.eye(4, dtype=np.float32)[..., None])
)
POLYGON = ClipScene(
    [[[-0.9, -0.8, 0, 1], [0.9, -0.8, 0, 1], [0.7, 0.3, 0, 1], [0.1, 0.9, 0, 1], [-0.8, 0.6, 0, 1]]],
    size=(9, 7),
    kind="polygons",
    clip_region=[-0.5, -0.9, 0.5, 0.5],
)
SHOWN_BY = {
    "texture_filter": TEXTURED,
    "wrap": TEXTURED,
    "shading": SCENES["lit"],
    "object_culling": SCENES["lit"],
    "hierarchy": SCENES["lit"],
    "tessellation": SCENES["curve"],
    "skinning": SCENES["bent-bar"],
    "polygon_clipping": POLYGON,
    "polygon_fill": POLYGON,
}
"""Families to a scene in which their methods differ; `PLAIN` for the others."""
OUTLINED = {"line", "line_clipping"}
"""Families that show in wireframes."""


def lacking(method: Method) -> list[str]:
    """Return what a method lacks."""
    family = FAMILIES[method.family]
    found = [
        f"no {name.replace('_', ' ')}"
        for name in ("title", "source", "exact_for")
        if not getattr(method, name)
    ]
    found += [] if method.function.__doc__ else ["no docstring of its rule"]
    found += [f"no {name}" for name in family.asks if not getattr(method, name)]
    found += [f"an unknown need, {need}" for need in method.needs if need not in NEEDS]
    found += [f"takes {name}, which is no setting" for name in method.takes if name not in FIELDS]
    titles = [other.title for other in table if other.family == method.family]
    found += [] if titles.count(method.title) == 1 else ["a title that another method has"]
    if method.listing is not None and family.asks and "mipmaps" not in method.needs:
        # Slopes and level of detail have listings of their own.
        labels = listing(method.listing).lines
        done = [operation for row in method.operations.values() for operation in row]
        # Labels that an outcome decides about are followed line by line, in tests/core/trace.
        found += [
            f"no line #: {each.label} in its listing"
            for each in done
            if isinstance(each.label, str) and each.label and each.label not in labels
        ]
    return found


def test_what_a_menu_refuses_is_what_drawing_refuses_with_the_same_words() -> None:
    refused = {
        (name, method.family, method.name): reason
        for name, scene in SCENES.items()
        for method in table
        if not no_effect(Settings(), method.family, scene)
        and (reason := refusal(method.family, method.name, scene))
    }
    assert {
        ("pentagram", "polygon_clipping", "weiler-atherton"),
        ("weiler-atherton", "polygon_clipping", "sutherland-hodgman"),
        ("orthographic", "depth", "inverse-w"),
    } <= refused.keys()
    for (scene, family, name), reason in refused.items():
        assert name != getattr(Settings(), family), "a default that does not draw every scene"
        with pytest.raises(ValueError, match=re.escape(f"{family} {name} {reason}")):
            render(SCENES[scene], Settings(**{family: name}))


def unexplained(method: Method) -> list[str]:
    """Return the steps of a method that have no sentence: of the kinds of rows that a small scene has with it."""
    choices = {method.family: method.name}
    if method.family in OUTLINED:
        choices["polygon_mode"] = "wireframe"
    if method.family == "hierarchy":
        choices |= {"object_culling": "frustum", "leaf_size": 1}
    scene = SHOWN_BY.get(method.family, PLAIN)
    traced = trace(scene, Settings(**choices), region=(0, 0, 9, 7))
    keys = {
        f"{stage}.{kind}.{operation.name}"
        for stage in STAGES
        for steps in [traced.stage(stage).steps]
        for kind in {steps.kinds[number] for number in steps.kind.tolist()}
        for operation in steps.operations[kind]
    }
    return [f"no row in core.explain for {key}" for key in sorted(keys) if row_of(key) is None]


@pytest.mark.parametrize("family", FAMILIES)
def test_methods_are_complete(family: str) -> None:
    methods = [table.get(family, name) for name in table.names(family)]
    found = {f"{family}={method.name}": [*lacking(method), *unexplained(method)] for method in methods}
    assert {name: problems for name, problems in found.items() if problems} == {}


def test_a_first_course_has_two_or_three_methods_of_fourteen_families() -> None:
    first = {name: family.classical for name, family in FAMILIES.items() if family.classical}
    assert set(first) - {"polygon_mode"} == {
        *("cull", "clipping", "fill_rule", "fill", "line", "line_clipping", "polygon_clipping"),
        *("polygon_fill", "interpolation", "texture_filter", "shading", "depth"),
        *("visibility", "antialiasing"),
    }
    assert {len(names) for names in first.values()} == {2, 3}
    for family, names in first.items():
        assert set(names) <= set(table.names(family))


def stage_lacking(stage: Stage) -> list[str]:
    """Return what a stage lacks."""
    texts = ("short_title", "title", "purpose", "takes", "gives", "source", "heading", "initial", "group")
    found = [f"no {name.replace('_', ' ')}" for name in texts if not getattr(stage, name)]
    module, _, name = stage.tracer.rpartition(".")
    tracer = getattr(import_module(module), name, None)
    found += [] if tracer is not None and tracer.__doc__ else [f"no tracer {stage.tracer}"]
    found += [] if stage.name in ACCOUNTS else ["no account of its rows"]
    found += (
        [] if stage.title.startswith(stage.short_title) else ["a title that is not its name as a chapter"]
    )
    return found


def test_stages_are_complete() -> None:
    found = {stage.name: stage_lacking(stage) for stage in DECLARED}
    assert {name: problems for name, problems in found.items() if problems} == {}
    assert {family.stage for family in FAMILIES.values()} <= set(STAGES)
    assert len({stage.short_title for stage in DECLARED}) == len(STAGES)
