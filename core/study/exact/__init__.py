"""Exact references: what a picture would be without any rounding, from definitions alone.

Nothing here uses the rules of the stages: coverage and depth are decided in Python's integers, which never round or
overflow; areas and spheres have closed forms. Each is tested against a second derivation.
"""
