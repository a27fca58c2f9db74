"""Measure every family's chart twice, the second time beside a busy process, and compare the orders.

Run it by hand (``.venv/bin/python tests/benchmarks/study_order.py [FAMILY ...]``); nothing is asserted. Tau is that of
the pairs which both runs tell apart and whose medians differ by more than 1.3.
"""

import subprocess
import sys
from itertools import combinations
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from core.study.families import study_families
from core.study.record import CLOSE, Point, is_faster
from core.study.speed_accuracy import measure
from tests.core.study.accuracy.order_agreement import kendall_tau

BUSY = (
    "import numpy as np\na = np.ones(1 << 21)\nwhile True:\n    a = a * 1.0000001 + sum(range(20000)) * 0.0\n"
)


def undecided(points: tuple[Point, ...]) -> tuple[int, int]:
    """Return how many pairs differ by more than 1.3 in the median and are not told apart, and how many differ so."""
    pairs = [
        (first, second)
        for first, second in combinations([point for point in points if point.is_measured], 2)
        if CLOSE * min(first.median, second.median) < max(first.median, second.median)
    ]
    return sum(not (is_faster(*pair) or is_faster(*pair[::-1])) for pair in pairs), len(pairs)


for family in study_families():
    if len(sys.argv) > 1 and family.name not in sys.argv[1:]:
        continue
    quiet = measure(family.name, grow=False)
    with subprocess.Popen([sys.executable, "-c", BUSY]) as process:
        try:
            busy = measure(family.name, grow=False)
        finally:
            process.kill()
    rounds = [max(len(point.seconds) for point in study.points) for study in (quiet, busy)]
    marked = [undecided(study.points) for study in (quiet, busy)]
    print(
        f"{family.name:18}tau {kendall_tau(quiet.points, busy.points):5.2f}  "
        f"undecided of pairs apart: {marked[0]} quiet, {marked[1]} busy; rounds {rounds[0]} and {rounds[1]}; "
        f"{busy.machine['load']}",
        flush=True,
    )
