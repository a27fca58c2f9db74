"""Which rows of a trace the tests execute the listings on, and when two numbers are the same."""

import numpy as np

from core.trace import StageTrace

ROW_LIMIT = 150
"""Rows of a stage that are executed: all of them, or these many of them spread over the trace."""


def rows_of_kind(found: StageTrace, kind: str) -> list[int]:
    rows = np.flatnonzero(found.steps.kind == found.steps.kinds.index(kind))
    return rows[:: max(len(rows) // ROW_LIMIT, 1)].tolist()


def equal(found: object, wanted: object) -> bool:
    return np.array_equal(np.asarray(found), np.asarray(wanted), equal_nan=True)
