"""The language of listings: it is Python where it runs at all, lane by lane, and masks divide the lanes."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.lanes.nodes import If
from core.lanes.problem import Problem
from core.lanes.program import compile_listing, steps_until_problem
from core.lanes.python_values import at_lane
from core.lanes.run import NOBODY, Nobody, joined, lanes_in, split
from core.lanes.terms import equalities, in_numbers, in_symbols, said, shown
from tests.core.listings import listings_of_the_program

LANES = 24
CONTROL_FLOW = """
def f(x, y, flag):
  if x > 12:
    x = -x
  elif flag:
    y += 1
  total = 0
  for k in range(x, y + 5):
    if k == 9:
      continue
    if total > 40:
      break
    total += k * k
  while y > 0:
    y -= 3
    if y == 4 and not flag:
      return total, y, None is None
  a, b, *rest = (min(x, y), max(x, y), 1, 2)
  c = [k * x for k in range(3) if k != 1]
  c[1] += total
  d = [[x, 0], [y, 1]]
  d[0][1] = d[1][0] // 3 + (x % 4 if x < 0 else y % 3)
  return total, abs(a) + b * 2 ** 3 + sum(c) + d[0][1] + len(rest) + rest[1], any((flag, x == y)) or x in (3, 5)
"""
"""Each statement of the language, with lanes that part and meet again."""


def python_function(text: str):
    """Return a text of this file as the Python function that it is: the test's own text, no user's."""
    space: dict = {}
    exec(text, space)
    return space["f"]


def lanes_of(seed: int) -> list[np.ndarray]:
    rng = np.random.default_rng(seed)
    return [rng.integers(-9, 22, LANES), rng.integers(-9, 22, LANES), rng.random(LANES) < 0.5]


@pytest.mark.parametrize("seed", range(6))
def test_lanes_run_as_python_does_alone_and_together(seed):
    program, function, values = compile_listing(CONTROL_FLOW), python_function(CONTROL_FLOW), lanes_of(seed)
    batch = program.run(values, LANES)
    for lane in range(LANES):
        plain = [value[lane].item() for value in values]
        wanted = list(function(*plain))
        assert at_lane(batch, lane) == wanted
        assert at_lane(program.run(plain, 1), 0) == wanted
        assert at_lane(program.run([value[lane : lane + 1] for value in values], 1), 0) == wanted


class Masks:
    """Checks that a branch is lived through by the lanes of its condition, and by no other."""

    def __init__(self):
        self.last, self.branches, self.checked = {}, {}, 0

    def begin(self, statement, mask, frame):
        tested, holds = self.branches.get(id(statement), (None, True))
        if tested is not None:
            outer, truth = self.last[id(tested)]
            inner = np.ones(LANES, bool) if mask is None else mask
            np.testing.assert_array_equal(inner, outer & (truth if holds else ~truth))
            self.checked += 1

    def end(self, statement, mask, frame, value):
        if isinstance(statement, If):
            outer = np.ones(LANES, bool) if mask is None else mask
            self.last[id(statement)] = outer, np.broadcast_to(value, (LANES,))
            for branch, holds in ((statement.yes, True), (statement.no, False)):
                if branch:
                    self.branches[id(branch[0])] = statement, holds


@pytest.mark.parametrize("seed", range(4))
def test_a_branch_is_lived_through_by_the_lanes_of_its_condition(seed):
    masks = Masks()
    compile_listing(CONTROL_FLOW).run(lanes_of(seed), LANES, watch=masks)
    assert masks.checked >= 3


@given(st.lists(st.booleans(), min_size=1, max_size=9), st.data())
def test_a_mask_is_divided_and_joined_again(flags, data):
    mask = data.draw(st.one_of(st.none(), st.lists(st.booleans(), min_size=len(flags), max_size=len(flags))))
    held = None if mask is None else np.array(mask)
    if held is not None and not held.any():
        return
    yes, no = split(held, np.array(flags), len(flags))

    def lanes(mask):
        if isinstance(mask, Nobody):
            return np.zeros(len(flags), bool)
        return np.ones(len(flags), bool) if mask is None else mask

    assert not (lanes(yes) & lanes(no)).any()
    np.testing.assert_array_equal(lanes(joined(yes, no)), lanes(held))
    np.testing.assert_array_equal(lanes(yes), lanes(held) & np.array(flags))
    assert lanes_in(yes, len(flags)) + lanes_in(no, len(flags)) == lanes(held).sum()
    assert joined(NOBODY, NOBODY) is NOBODY


def test_a_variable_that_only_some_lanes_have_is_told():
    text = "def f(x):\n  if x > 2:\n    up = 1\n  return up\n"
    assert compile_listing(text).run([5], 1) == 1
    with pytest.raises(
        Problem, match="line 4, column 10: up has no value here in 3 of 12 lanes: it is set in one"
    ):
        compile_listing(text).run([np.arange(12)], 12)


def test_a_lane_that_returns_nothing_is_told():
    text = "def f(x):\n  while x > 0:\n    if x == 3:\n      return 1\n    x -= 2\n"
    with pytest.raises(Problem, match="may end here without return"):
        compile_listing(text)


def test_both_branches_are_checked_on_no_lanes():
    for wrong in ("y = x + 'a'", "y = nobody", "y = f(x)", "y = [1][2]", "return 1, 2"):
        text = f"def f(x):\n  if x > 0:\n    y = 1\n  else:\n    {wrong}\n  return x\n"
        with pytest.raises(Problem, match=r"line [56]"):
            compile_listing(text).check([np.zeros(0)])


def test_most_listings_of_the_program_are_in_the_language():
    read, refused = [], {}
    for listed in listings_of_the_program():
        try:
            compile_listing(listed.source)
            read.append(listed.name)
        except Problem as problem:
            refused[listed.name] = problem.sentence
    assert len(read) >= 85
    known = ("language", "called by its name", "nothing can be stored here")
    assert all(any(words in reason for words in known) for reason in refused.values()), refused


STEPS = """
def f(x, owns):
  n = [2 * x + k for k in range(3)]
  total = n[0] - n[1] * -n[2] - (x - 1)
  a, b = x, -x
  if not total > 0 and (owns or x != 2):
    out = []
    out.append((a, b))
    return out, min(a, b)
  return x if owns else b, total
"""


def test_steps_are_told_in_symbols_numbers_and_result():
    steps = steps_until_problem(compile_listing(STEPS), [3.0, True])[0]
    assert [said(step) for step in steps] == [
        "n = [2 · x + k for k in range(3)] = [2 · 3 + 0, 2 · 3 + 1, 2 · 3 + 2] = [6, 7, 8]",
        "total = n[0] − n[1] · (−n[2]) − (x − 1) = 6 − 7 · (−8) − (3 − 1) = 60",
        "a = x = 3; b = −x = −3",
        "not total > 0 and (owns or x != 2): not 60 > 0 and (true or 3 != 2) is false",
        "return [x if owns else b, total] = [3 if true else −3, 60] = [3, 60]",
    ]
    assert [step.line for step in steps] == [3, 4, 5, 6, 10]
    assert [step.set for step in steps] == [("n",), ("total",), ("a", "b"), (), ()]
    assert steps[1].before["n"] == [6.0, 7.0, 8.0]
    assert "total" not in steps[1].before


def test_a_step_keeps_lists_as_they_were():
    text = "def f(x):\n  out = []\n  for k in range(3):\n    out.append(k * x)\n  return out\n"
    steps = steps_until_problem(compile_listing(text), [2])[0]
    puts = [step for step in steps if step.kind == "append"]
    assert [(step.before["out"], step.after["out"]) for step in puts] == [
        ([], [0]),
        ([0], [0, 2]),
        ([0, 2], [0, 2, 4]),
    ]
    assert said(puts[1]) == "out gets k · x = 1 · 2 = 2"
    assert steps[-1].value == [0, 2, 4]


def test_the_steps_of_a_run_that_ends_early_are_there():
    text = "def f(x):\n  while True:\n    x += 1\n  return x\n"
    steps, problem = steps_until_problem(compile_listing(text), [0])
    assert problem.line == 2
    assert steps[-2].after["x"] == 1000


def test_numbers_in_words():
    assert [shown(value) for value in (True, -3, 1 / 3, [1.5, -2], [0] * 5, None, float("nan"))] == [
        "true",
        "−3",
        "0.3333",
        "[1.5, −2]",
        "5 values",
        "nothing",
        "nan",
    ]


def test_a_term_in_numbers_is_worth_its_result():
    """Printed with its numbers, a sum of whole numbers is an arithmetic text with the result of the step."""
    rng = np.random.default_rng(4)
    program = compile_listing(
        "def f(a, b, c):\n  r = a - (b - c) * -a - -b * (a + c) + 3 * (c - -a)\n  return r\n"
    )
    for values in rng.integers(-9, 9, (40, 3)).tolist():
        (equality,) = equalities(steps_until_problem(program, values)[0][0])
        text = in_numbers(equality.right).replace("−", "-").replace("·", "*")
        again = compile_listing(f"def g(a):\n  return {text}\n").run([0], 1)
        assert again == equality.result
        assert in_symbols(equality.right).startswith("a − (b − c) · (−a)")


def test_an_element_has_its_value_whatever_sum_its_index_is():
    program = compile_listing("def f(xs, i):\n  r = xs[i - 1] + 10 * xs[i + 1] + 100 * xs[-i]\n  return r\n")
    for i in (1, 2):
        (equality,) = equalities(steps_until_problem(program, [[2, 3, 5, 7], i])[0][0])
        again = compile_listing(f"def g(a):\n  return {in_numbers(equality.right).replace('·', '*')}\n")
        assert again.run([0], 1) == equality.result
