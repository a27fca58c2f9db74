"""Exercises that teachers write: what they may say, and one sentence with file and line for what they may not."""

import re
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from lessons.exercises.drafting import DrawnScene
from lessons.exercises.exercise_file import read_exercise
from lessons.exercises.numbers import number_text
from lessons.exercises.question import ask, judge
from tests.texts import cases_of

DRAWN = """
version = 1
title = "My triangle"
stage = "raster"
points = 4
question = \"\"\"
Which pixels does the triangle cover?
version = 7 is no key here: centres on an edge belong to left and level bottom edges.\"\"\"
hints = ["Look at the centres.", "Which edges are on the left?"]
mistakes = ["corner-for-center", "all-edges-inclusive"]

[scene]
size = [12, 9]
triangles = [
    [["0.5..3.5 step 1", 1.5], ["7..11 step 0.5", 1.5], [4, "6..8 step 1/2"]],
]

[settings]
fill = "bounding-box"

[answer]
type = "pixels"
"""
HEAD = """
version = 1
title = "Mine"
stage = "raster"
question = "What comes out?"
[answer]
"""
ART = "type = \"pixels\"\nart = '''\n..?\n.##\n'''\n"
TABLE = 'type = "table"\ncolumns = ["x", "y"]\nlabels = ["a", "b"]\ncells = [[1, 0.5], ["1/3", inf]]\n'
SCENE = """[scene]
size = [8, 6]
triangles = [[["1/2", "1/2"], ["13/2", "1/2"], [3, 5]]]
"""
STEPS = """type = "steps"
steps = [
    {ask = "D", number = -2},
    {ask = "the next pixel", pixel = [3, 1]},
    {ask = "the corner", place = ["1/2", 2]},
    {ask = "inside", options = ["yes", "no"], right = "no"},
]
"""
BREAK = """type = "break"
corner = [0, 2]
weak = {fill_rule = "inclusive"}
robust = {fill = "spans"}
"""
COSTS = """type = "cheapest"
tolerance = 20
[answer.costs.interpolation]
flat = 0
affine = 5
affine-n = 6
perspective = 11
[scene]
builtin = "near-plane"
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "mine.toml"
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


def test_a_drawn_exercise_is_the_same_for_a_seed_and_shows_its_mistakes(tmp_path: Path) -> None:
    template = read_exercise(written(tmp_path, DRAWN))
    one, same, other = (ask(template, seed).draft for seed in (1, 1, 3))
    assert one.given == same.given != other.given
    assert one.given.startswith("Window of 12 x 9 pixels, row 0 at the bottom.\nTriangle 0: (")
    question = ask(template, 1)
    assert judge(question, one.answer.reference).points == 4
    for name, wrong in one.mistakes.items():
        assert judge(question, wrong).mistakes == (name,)


def test_another_question_has_another_version(tmp_path: Path) -> None:
    """So a line, an attempt and an answer in progress are never taken for another question; a revision may be named."""

    def version(text: str) -> int:
        return read_exercise(written(tmp_path, text)).version

    same = (
        DRAWN.replace("points = 4", "points = 2")
        .replace("My triangle", "A triangle")
        .replace("\n\n", "\n# !\n")
    )
    assert version(DRAWN) == version(same)
    changed = [
        DRAWN.replace(*change)
        for change in (("0.5..", "1.5.."), ("level", "flat"), ("bounding-box", "spans"))
    ]
    assert len({version(text) for text in (DRAWN, *changed)}) == 4
    assert version(DRAWN.replace("points = 4", "revision = 12")) == 12


def test_a_choice_draws_its_case_and_some_of_its_options(tmp_path: Path) -> None:
    cased = HEAD.replace('question = "', 'hints = ["See {case}."]\nquestion = "{case}? ') + (
        'type = "choice"\noptions = ["a", "b", "c"]\n'
        '[[answer.cases]]\nask = "one"\nright = "a"\n[[answer.cases]]\nask = "two"\nright = "b"\nhint = "2."\n'
        '[answer.notes]\na = "A is one."\n'
    )
    drafts = [ask(read_exercise(written(tmp_path, cased)), seed).draft for seed in range(12)]
    found = {
        (draft.text.split("?")[0], draft.answer.text(draft.answer.reference), draft.reveal, *draft.hints)
        for draft in drafts
    }
    assert found == {("one", "a", "A is one.", "See one."), ("two", "b", "", "See two.", "2.")}
    assert len({draft.answer.offered for draft in drafts}) == 6
    wrong = next(draft for draft in drafts if draft.text.startswith("two")).answer
    assert wrong.reason(frozenset({wrong.options.index("a")})) == "A is one."
    several = HEAD + (
        'type = "choice"\noptions = ["a", "b", "c", "d", "e"]\nright = ["a", "b", "c"]\nseveral = true\ncount = 3\n'
    )
    answers = [ask(read_exercise(written(tmp_path, several)), seed).draft.answer for seed in range(20)]
    assert {len(answer.options) for answer in answers} == {3}
    assert {len(answer.reference) for answer in answers} == {1, 2}
    assert all({answer.options[k] for k in answer.reference} <= set("abc") for answer in answers)


@pytest.mark.parametrize(
    ("part", "right"),
    [
        (ART, [[1, 0], [2, 0], [2, 1]]),
        (ART, "...\n.##"),
        (TABLE, [["1", "1/2"], ["0.33333333333333333333", "inf"]]),
        ('type = "numbers"\nvalues = ["sqrt(2)"]\ntolerance = 0.01\n', "1.41"),
        ('type = "numbers"\nvalues = [1, 0, 0, 1]\nrows = 2\n', [[1, 0], ["0", 1]]),
        ('type = "order"\nitems = ["cull", "clip", "raster"]\n', ["cull", "clip", "raster"]),
        ('type = "choice"\noptions = ["yes", "no"]\nright = ["no"]\n', "no"),
        ('type = "choice"\noptions = ["a", "b", "c"]\nright = ["b", "c"]\nseveral = true\n', ["c", "b"]),
        ('type = "order"\ncount = 3\nitems = ["cull", "clip", "bin", "raster"]\n', ["cull", "clip", "bin"]),
        ('type = "places"\nnames = ["entry"]\nplaces = [["11/9", 0]]\ntolerance = 0.1\n', "1.2, 0"),
        ('type = "places"\ncorner = [0, 2]\n' + SCENE, "3, 5.1"),
        ('type = "line"\nlisting = """\nx = x0\ny = y0\nD = dx"""\nwrong = 3\n', 3),
        (
            'type = "spot"\nmistake = "y-down"\nothers = ["rows-and-columns"]\n' + SCENE,
            {"pixels": [[2, 0]], "option": "y down"},
        ),
        (STEPS, ["-2", [3, 1], "1/2, 2", "no"]),
        (BREAK + SCENE.replace('"1/2"', '"1/4"'), ["7/2", "7/2"]),
        (COSTS, {"interpolation": "affine-n"}),
    ],
)
def test_every_type_of_answer_can_be_written(part: str, right: object, tmp_path: Path) -> None:
    question = ask(read_exercise(written(tmp_path, HEAD + part.replace("1/3", "0.33333333333333333333"))), 0)
    assert judge(question, question.draft.answer.read(right)).verdict.score == 1


def changed(old: str, new: str) -> str:
    assert old in DRAWN
    return DRAWN.replace(old, new)


BASES = {"drawn": DRAWN, "head": HEAD}
REFUSED = cases_of(__file__, "refused.txt")
"""Which text is changed, what stands there (nothing: at the end), what is typed, and what is said of it."""


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        *(
            (BASES[base].replace(old, new) if old else BASES[base] + new, wanted)
            for base, old, new, wanted in REFUSED
        ),
        ("", "line 1: expected version here, which is missing"),
        (DRAWN[:100], "expected TOML"),
        (
            HEAD + f'type = "numbers"\nvalues = [{"9" * 5000}]\n',
            "line 8: expected TOML, got a number or a list too",
        ),
        (
            HEAD + f"type = {'[' * 5000}{']' * 5000}\n",
            "line 7: expected TOML, got a number or a list too long",
        ),
        (HEAD + "#" * 70000, "expected a file of up to 64 KiB"),
        (b"title = '\xff'\n", "line 1: expected text in UTF-8"),
    ],
)
def test_what_is_no_exercise_is_refused_with_its_line(text: str | bytes, wanted: str, tmp_path: Path) -> None:
    path = written(tmp_path, text)
    with pytest.raises(ValueError, match=wanted) as problem:
        read_exercise(path)
    sentence = str(problem.value)
    assert sentence.startswith(f"{path}: ")
    assert "\n" not in sentence
    assert len(sentence) - len(str(path)) < 1400


def test_hints_name_coordinates_that_the_scene_gives(tmp_path: Path) -> None:
    text = changed('"Look at the centres."', '"x = {x0} + (j + 1/2 - {y0}) ({x2} - {x0}) / ({y2} - {y0})"')
    draft = ask(read_exercise(written(tmp_path, text)), 3).draft
    (x0, y0), _, (x2, y2) = re.findall(r"\(([0-9.]+), ([0-9.]+)\)", draft.given)
    assert draft.hints[0] == f"x = {x0} + (j + 1/2 - {y0}) ({x2} - {x0}) / ({y2} - {y0})"
    place = (
        HEAD.replace("[answer]", 'hints = ["{x2}"]\n[answer]') + 'type = "places"\ncorner = [0, 2]\n' + SCENE
    )
    for wrong in (text.replace("x2", "x3"), place):
        with pytest.raises(ValueError, match=r"line [69]: hints: expected coordinates that the scene gives"):
            read_exercise(written(tmp_path, wrong))


def test_a_mistake_that_never_shows_is_refused(tmp_path: Path) -> None:
    hidden = changed("mistakes = [", 'mistakes = ["facing-exchanged", ')
    for drawn, fixed in (("0.5..3.5 step 1", "1"), ("7..11 step 0.5", "8"), ("6..8 step 1/2", "7")):
        hidden = hidden.replace(drawn, fixed)
    with pytest.raises(
        ValueError, match="line 10: mistakes: mine cannot draw its question: facing-exchanged gives"
    ):
        read_exercise(written(tmp_path, hidden))
    with pytest.raises(ValueError, match="expected a file"):
        read_exercise(tmp_path)


LINE = """
version = 1
title = "A line"
stage = "raster"
question = "Which pixels does Bresenham's line draw, with D > 0?"
mistakes = ["ties-step", "not-corrected"]
[scene]
size = [14, 9]
segments = [[[1.5, 1.5], ["7.5..11.5 step 1", "3.5..5.5 step 1"]]]
[settings]
line = "bresenham-lecture"
[answer]
type = "pixels"
"""
FAR = """
version = 1
title = "Often outside"
stage = "raster"
question = "Which pixels?"
[scene]
size = [8, 6]
triangles = [[["-40..40 step 8", 0], [6, "-40..40 step 8"], [1, 5]]]
[answer]
type = "pixels"
"""
CUBE = """
version = 1
title = "Cube"
stage = "depth"
question = "Where is triangle 5 seen?"
[scene]
builtin = "cube"
size = [24, 16]
[answer]
type = "pixels"
triangle = 5
"""


def test_lines_and_meshes_are_drawn_too(tmp_path: Path) -> None:
    question = ask(read_exercise(written(tmp_path, LINE)), 2)
    assert len(question.draft.answer.reference) in range(7, 12)
    assert set(question.draft.mistakes) == {"ties-step", "not-corrected"}
    assert "Segment 0: (1.5, 1.5), (" in question.draft.given
    cube = ask(read_exercise(written(tmp_path, CUBE)), 0)
    assert len(cube.draft.answer.reference) > 2
    named = CUBE.replace("[scene]", 'mistakes = ["y-down"]\n[scene]')
    with pytest.raises(
        ValueError, match="expected triangles or segments in the window where mistakes are named"
    ):
        read_exercise(written(tmp_path, named))


WHOLE = HEAD.replace(
    "[answer]",
    """
[scene]
size = [10, 8]
triangles = [[["1/2", "1/2", "1/4", 1], ["17/2", "1/2", "1/4", "2..4 step 2"], ["1/2", "13/2"]]]
values = [[[0, 1, 0], ["0..1 step 1/2", 1, 0], [0, 1, 0]]]
alpha = [[1, "1/2", 1]]
background = [0, 0, 1, 1]
[answer]
type = "numbers"
values = [1]
""",
)


def test_corners_have_depth_w_values_and_alpha_and_the_scene_a_background(tmp_path: Path) -> None:
    """They are drawn, may be ranges, stand in the question, and stay where a corner is moved."""
    template = read_exercise(written(tmp_path, WHOLE))
    drawn = set()
    for seed in range(24):
        draft = ask(template, seed).draft
        scene = draft.scene
        assert scene.clip[0, :, 3].tolist() in ([1, 2, 1], [1, 4, 1])
        assert (scene.clip[0, :, 2] / scene.clip[0, :, 3]).tolist() == [-0.5, -0.5, 0]
        assert scene.attributes[0, :, 1:].tolist() == [[1, 0, 1], [1, 0, 0.5], [1, 0, 1]]
        assert scene.background.tolist() == [0, 0, 1, 1]
        w, red = int(scene.clip[0, 1, 3]), Fraction(scene.attributes[0, 1, 0])
        assert draft.given.splitlines()[2:] == [
            f"Triangle 0, depth and w of its corners: (0.25, 1), (0.25, {w}), (0.5, 1)",
            f"Triangle 0, values of its corners: (0, 1, 0), ({number_text(red)}, 1, 0), (0, 1, 0)",
            "Triangle 0, alpha of its corners: (1), (0.5), (1)",
            "Background: 0, 0, 1, 1 (red, green, blue, alpha).",
        ]
        drawn.add((w, red))
    assert len(drawn) == 6
    moved = DrawnScene(scene).with_corner([0, 1], (Fraction(3), Fraction(5)))
    assert np.array_equal(moved.clip[0, ::2], scene.clip[0, ::2])
    assert moved.clip[0, 1].tolist() == pytest.approx([-0.4 * w, 0.25 * w, -0.5 * w, w])
    assert np.array_equal(moved.attributes, scene.attributes)
    assert np.array_equal(moved.background, scene.background)


def test_draws_with_nothing_to_mark_are_drawn_again(tmp_path: Path) -> None:
    template = read_exercise(written(tmp_path, FAR))
    assert all(ask(template, seed).draft.answer.reference for seed in range(20))


def test_a_method_that_never_breaks_is_refused_after_few_searches(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("lessons.exercises.file_answers.SEARCH_LIMIT", 5)
    never = BREAK.replace('fill_rule = "inclusive"', 'fill = "scanline"')
    text = DRAWN.replace('type = "pixels"\n', never).replace(
        'mistakes = ["corner-for-center", "all-edges-inclusive"]\n', ""
    )
    with pytest.raises(
        ValueError, match="no place of 5 makes the weak method alone fail, in each of 3 scenes"
    ):
        read_exercise(written(tmp_path, text))
