"""Edited listings: a text that a user has typed in place of a listing draws instead of the method's rule.

The rule draws where nothing was typed; only what was typed runs in the lanes of `core.lanes`. An edit starts from the
method whose listing is edited, and keeps what this method needs.
"""
