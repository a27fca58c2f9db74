"""The window of the tests of ``app``, for what is done to a whole program."""

from tests.app.conftest import new_window, window

__all__ = ["new_window", "window"]
