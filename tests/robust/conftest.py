"""The window of the tests of ``app``, for what is done to a whole program."""

from tests.app.conftest import window

__all__ = ["window"]
