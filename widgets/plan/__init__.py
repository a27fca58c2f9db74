"""The views of a plan: controls, choices, summary."""
