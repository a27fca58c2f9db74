"""Explanations: for every step a sentence, a formula, variables and a question; for stages and methods their texts.

What a topic says of its steps stands in its ``told`` files; `core.explain.step_values` has the shape of a row.
Nothing here draws: the window, ``rasterscope trace``, lessons and exercises show the same texts.
"""

from typing import TYPE_CHECKING

from core.lazy_import import import_on_demand

if TYPE_CHECKING:
    from core.explain.stage_texts import (
        family_title,
        initial_sentence,
        method_text,
        stage_card,
        summary_sentence,
    )
    from core.explain.steps import (
        account,
        formula,
        question,
        remarks,
        row_sentence,
        sentence,
        variables,
    )
else:
    __getattr__ = import_on_demand(
        globals(),
        **dict.fromkeys(
            ("account", "formula", "question", "remarks", "row_sentence", "sentence", "variables"),
            "core.explain.steps",
        ),
        **dict.fromkeys(
            ("family_title", "initial_sentence", "method_text", "stage_card", "summary_sentence"),
            "core.explain.stage_texts",
        ),
    )

__all__ = [
    "account",
    "family_title",
    "formula",
    "initial_sentence",
    "method_text",
    "question",
    "remarks",
    "row_sentence",
    "sentence",
    "stage_card",
    "summary_sentence",
    "variables",
]
