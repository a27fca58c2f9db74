"""The pane of a lesson: its text, task, answer and dots beside the picture."""
