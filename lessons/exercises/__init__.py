"""Exercises: questions that are drawn from a seed, answered on paper or on the picture, and checked by the core."""
