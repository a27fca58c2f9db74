"""Programs that a user has typed, run over lanes: a lane is a pixel, a line or a corner, and all of them run in step.

A text is read to nodes (`nodes`), and these are compiled once to closures (`program`). Nothing that was typed is ever
executed as Python: there is no ``eval``, no attribute, no import, and no call outside of a table of functions. Lanes
that a branch leaves out wait, by a mask; where all lanes agree there is no mask. Values belong to a dialect: those of
listings are in `python_values`.
"""
