"""The pane of Help."""
