"""The results as a CSV file: one row for each contender on each workload."""

import csv
from dataclasses import asdict
from io import StringIO

from app.bench.goals import goal_of
from app.bench.harness import Result
from app.bench.machine import Machine
from app.bench.report import prototype_text, ratio_to
from app.bench.threads import THREADS

COLUMNS = (
    *("workload", "title", "width", "height", "primitives", "fragments", "pixels"),
    *("library", "version", "detail", "kind", "does_less", "missing"),
    *("median_ms", "min_ms", "lower_quartile_ms", "upper_quartile_ms", "timed_calls"),
    *("times_ours", "goal", "prototype", "verdict", "pixels_different", "colours_different"),
    *("date", "processor", "cores", "system", "python", "numpy", "program", "threads", "rounds"),
)


def results_text(results: list[Result], machine: Machine, rounds: int) -> str:
    """Return every result as CSV, with what it was measured on, in rows that stand alone."""
    text = StringIO()
    writer = csv.DictWriter(text, COLUMNS, restval="", lineterminator="\n")
    writer.writeheader()
    threads = " ".join(f"{name}={count}" for name, count in THREADS.items())
    here = asdict(machine) | {"threads": threads, "rounds": rounds}
    for result in results:
        for row in result_rows(result):
            writer.writerow(row | here)
    return text.getvalue()


def result_rows(result: Result) -> list[dict[str, object]]:
    """Return the rows of one workload."""
    common: dict[str, object] = {"workload": result.workload.name, "title": result.workload.title}
    if result.size is None:
        common["primitives"] = result.counts.primitives
    else:
        common |= dict(zip(("width", "height"), result.size, strict=True)) | asdict(result.counts)
    rows = []
    for entry in result.entries:
        times, ratio = entry.times, ratio_to(entry, result.ours)
        row = common | {
            "library": entry.contender.library,
            "version": entry.version,
            "detail": entry.detail,
            "kind": entry.contender.kind,
            "does_less": entry.contender.less,
            "median_ms": f"{times.median:.4f}",
            "min_ms": f"{times.least:.4f}",
            "lower_quartile_ms": f"{times.lower_quartile:.4f}",
            "upper_quartile_ms": f"{times.upper_quartile:.4f}",
            "timed_calls": times.count,
            "pixels_different": entry.difference.covered,
            "colours_different": entry.difference.colored,
        }
        if ratio is not None:
            row["times_ours"] = f"{ratio:.4f}"
            goal = goal_of(result.workload.name, entry.contender.library, entry.detail)
            if goal is not None:
                wanted = "" if goal.wanted is None else f"{goal.wanted:g}"
                row |= {"goal": wanted, "prototype": prototype_text(goal), "verdict": goal.verdict(ratio)}
        rows.append(row)
    return rows + [common | {"library": each.library, "missing": each.reason} for each in result.missing]
