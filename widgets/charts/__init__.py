"""Charts of speed against accuracy, with their legends, tables and controls."""
