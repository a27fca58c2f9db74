"""Waiting in tests: as long as a machine may need that does many things at a time, and saying for what."""

from collections.abc import Callable
from inspect import getsource, isfunction
from typing import Any

from pytestqt.exceptions import TimeoutError
from pytestqt.qtbot import QtBot

PATIENCE = 60_000
"""Milliseconds that a test waits at most."""


class PatientBot(QtBot):
    """Waits with patience, and says for what it has waited in vain."""

    def waitUntil(self, callback: Callable[[], object], *, timeout: int = PATIENCE) -> None:
        try:
            super().waitUntil(callback, timeout=timeout)
        except TimeoutError as problem:
            wanted = getsource(callback).strip() if isfunction(callback) else repr(callback)
            problem.add_note(f"This has not come: {wanted}")
            raise

    def waitSignal(self, signal: Any, *, timeout: int = PATIENCE, **more: Any) -> Any:
        return super().waitSignal(signal, timeout=timeout, **more)
