"""The inspector: formula, listing, variables, prediction, and the history of a pixel."""
