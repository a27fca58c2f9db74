"""Formulas in words."""

import re

import pytest

import core
from core.explain.latex import spoken
from core.explain.records import Formula
from core.explain.steps import formula
from lessons.scenes import built_in_scene

SAID = {
    (r"\lambda_0 = \vertex{0}{\frac{n_0}{n}}", r"0.99 \approx \frac{5984}{6041}"): (
        "lambda 0 equals n 0 over n. 0.99 is about 5984 over 6041"
    ),
    (
        r"d & < & 0 \lor & w & > & 0 & \Rightarrow & \text{kept}",
        r"{-1.5 \cdot 10^{4}} & < & 0 \lor & 2 & > & 0 & \Rightarrow & \text{kept}",
    ): "d = minus 1.5 times 10 to the power 4 is less than 0 or w = 2 is greater than 0, so kept",
    (r"i & = & \lfloor x - \frac{1}{2} \rfloor", ""): "i equals floor of x minus 1 over 2",
    (r"s & = & N \cdot L & + & x^2", ""): "s equals N dot L plus x squared",
}


@pytest.mark.parametrize(("lines", "words"), list(SAID.items()))
def test_signs_become_words(lines: tuple[str, str], words: str) -> None:
    """Relations, products, powers, fractions and Greek letters are said; a decision is said once."""
    assert spoken(Formula(*lines)) == words


def test_every_formula_of_a_scene_is_words_and_numbers() -> None:
    """No sign is left that a screen reader leaves out."""
    scene = built_in_scene("textured-floor").make()
    trace = core.trace(scene, core.Settings(), triangle=0, region=(0, 0, 24, 16))
    for stage in core.STAGES:
        steps = trace.stage(stage).steps.count
        for position in {1, 2, 3, steps // 3, steps // 2, steps}:
            explanation = trace.stage(stage).explain(position) if position else None
            shown = formula(explanation) if explanation is not None else None
            if shown is not None:
                assert re.fullmatch(r"[\w ,.=]+", spoken(shown)), spoken(shown)
