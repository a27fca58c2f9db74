"""Explanations: for every step a sentence, a formula, variables and a question; for stages and methods their texts.

What a topic says of its steps stands in its ``told`` files; `core.explain.step_values` has the shape of a row.
Nothing here draws: the window, ``rasterscope trace``, lessons and exercises show the same texts.
"""
