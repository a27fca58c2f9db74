"""Widgets and drawing that every view uses: theme, marks, icons, controls, messages, key help."""
