"""Lessons in the window: their list, one that is walked, its steps, questions and answers."""
