"""Explanations of every step and method: sentences, formulas, variables and questions. NumPy only."""
