"""What is imported when: the first picture waits for nothing that it does not use, and nothing is missed later."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import core
from core.methods import table
from core.settings import Settings, families

ROOT = Path(__file__).resolve().parents[2]
DRAW = """
import numpy as np
from core import ClipScene, Settings, draw_picture
clip = np.array([[[-1, -1, 0, 1], [1, -1, 0, 1], [-1, 1, 0, 1]]], float)
scene = ClipScene(clip, np.ones((1, 3, 4)), (8, 8))
print(draw_picture(scene, Settings(cull="back", interpolation="flat", depth="fixed-38")).route.color)
"""
UNUSED = (
    *("core.antialiasing.resolve", "core.shading.lighting", "core.textures.look_up"),
    *("core.framebuffer.blending", "core.lines.line_clipping", "core.fast_path.blended"),
    *("core.fast_path.lit", "core.fast_path.sampled", "core.fast_path.corner_colors"),
    *("core.fast_path.sampled", "core.pipeline", "core.coverage.fills", "core.lines.drawing"),
    *("core.lines.wireframe", "core.records.steps", "core.study", "core.trace.source"),
    *("core.trace.tracers", "core.trees.bounding_volumes"),
    *("core.visibility.ray_casting", "core.pixel_history"),
)
"""Parts of the core that a picture of plain triangles has no use for."""
ON_DEMAND = (
    "ClippedLines",
    "Picture",
    "clip_lines",
    "draw_lines",
    "draw_picture",
    "draw_triangles",
    "render",
)


def run_fresh(code: str) -> list[str]:
    """Run Python code in an interpreter of its own, and return the lines that it prints."""
    done = subprocess.run(
        [sys.executable, "-P", "-c", code],
        cwd=ROOT,
        env=dict(os.environ, PYTHONPATH=str(ROOT)),
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def test_the_first_picture_imports_nothing_that_it_does_not_use() -> None:
    route, *imported = run_fresh(DRAW + "import sys\nprint(*sys.modules, sep='\\n')")
    assert route == "palette"
    assert "core.fast_path.opaque" in imported
    assert not set(UNUSED) & set(imported)


def test_a_first_picture_of_mixed_colours_waits_for_no_other_pipeline() -> None:
    code = "import sys\nfrom core import draw_picture\nfrom lessons.scenes import make_scene\n"
    code += "print(draw_picture(make_scene('single-triangle')).route.color)\nprint(*sys.modules, sep='\\n')"
    route, *imported = run_fresh(code)
    assert route == "corners"
    assert not {"core.pipeline", "core.framebuffer.blending", "numpy.ma"} & set(imported)


def test_a_trace_loads_the_method_of_visibility_that_it_uses() -> None:
    code = "import sys\nfrom core import STAGES, trace\nfrom lessons.scenes import make_scene\n"
    code += "run = trace(make_scene('cube'), region=(300, 200, 2, 2))\nfor name in STAGES: run.stage(name)\n"
    imported = run_fresh(code + "print(*sys.modules, sep='\\n')")
    found = {name for name in imported if name.startswith(("core.trees.", "core.visibility."))}
    assert found == {"core.visibility.exact_case", "core.visibility.painters"}


@pytest.mark.parametrize("name", UNUSED)
def test_what_is_not_imported_is_there(name: str) -> None:
    path = ROOT.joinpath(*name.split("."))
    assert path.with_suffix(".py").is_file() or (path / "__init__.py").is_file()


def test_every_method_in_a_file_is_found() -> None:
    found = {
        row
        for path in (ROOT / "core").rglob("*.py")
        for row in re.findall(r'^@method\(\s*"(\w+)",\s*"([\w.-]+)"', path.read_text(encoding="utf-8"), re.M)
    }
    assert found == {(row.family, row.name) for row in table}


def test_a_new_file_in_the_folder_of_a_family_is_found_after_the_first_ones() -> None:
    code = "import core.lines.wireframe as new; from core.methods import method, table\n"
    code += "def drawn(): ...\ndrawn.__module__ = new.__name__\n"
    code += "method('line', 'new', 'New', source='here', exact_for='nothing')(drawn)\n"
    (line,) = run_fresh(code + "print(*table.names('line'))")
    names = line.split()
    assert [name for name in names if name != "new"] == list(table.names("line"))
    assert names.index("new") > names.index("gupta-sproull")


def test_chosen_methods_are_imported_before_stages_are_timed() -> None:
    code = "import sys; import core.pipeline; from core.settings import Settings; "
    code += "from core.resolved import import_methods; "
    code += "old = set(sys.modules); import_methods(Settings(visibility='painters', shading='gouraud')); "
    imported = run_fresh(code + "print(*set(sys.modules) - old, sep='\\n')")
    assert {"core.shading.shading", "core.visibility.painters", "core.coverage.edge_formats"} <= set(imported)
    assert "core.coverage.edges" not in imported


def test_defaults_are_methods_of_the_table() -> None:
    settings = Settings()
    assert all(table.get(family, getattr(settings, family)).name for family in families())


def test_methods_keep_their_order_whatever_is_imported_first() -> None:
    code = "import core.spans.fill; from core.methods import table; print(*table.names('fill'))"
    assert run_fresh(code) == [" ".join(table.names("fill"))]
    assert table.names("fill")[-1] == "spans"


def test_a_name_that_is_not_there_is_told_with_those_of_files_not_imported_yet() -> None:
    code = "from core import Settings\ntry: Settings(visibility='guess')\nexcept ValueError as error: print(error)"
    assert run_fresh(code) == [f"visibility must be one of {', '.join(table.names('visibility'))}, got guess"]


ASK_FOR = """
for part in [part for part in sys.modules if part.partition(".")[0] == "core"]:
    del sys.modules[part]
import core
print('{name}' in dir(core), '{name}' in vars(core))
from core import {name}
print(core.{name} is {name})
"""
"""Import the core anew, and one name from it."""


def test_names_that_are_imported_on_demand_are_told_and_found() -> None:
    lines = run_fresh("import sys\n" + "".join(ASK_FOR.format(name=name) for name in ON_DEMAND))
    answers = {name: lines[2 * k : 2 * k + 2] for k, name in enumerate(ON_DEMAND)}
    assert answers == {name: ["True False", "True"] for name in ON_DEMAND}


def test_trace_is_the_function_whatever_was_imported_before() -> None:
    code = (
        "import core.trace.tracers; from core import trace; print(trace.__qualname__, type(trace).__name__)"
    )
    assert run_fresh(code) == ["trace function"]


def test_a_name_that_the_core_does_not_have() -> None:
    with pytest.raises(AttributeError, match="module 'core' has no attribute 'draw_circle'"):
        core.draw_circle  # noqa: B018
