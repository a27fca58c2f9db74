"""The only mutable state of the program, its edits and its undo."""
