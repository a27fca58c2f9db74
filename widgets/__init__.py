"""Views of the core's records: each widget shows one idea and reports what the user wants by signals.

A widget has ``show_x(record)`` slots and ``noun_verbed`` signals. It never computes pipeline values, never
emits when it is set by code, and knows nothing of pages, lessons or sessions. Arrays have row 0 at the
bottom, as in :mod:`core`; only :mod:`widgets.basics.image` and :mod:`widgets.grid.view` flip them for the screen.
"""
