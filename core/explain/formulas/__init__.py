"""The formulas of a step: the law in symbols, and the same law with the numbers of the step."""
