"""The results as text: a table for each workload."""

from app.bench.goals import Goal, goal_of
from app.bench.harness import Entry, Result
from app.bench.machine import Machine
from app.bench.threads import THREADS

VERDICTS = {"goal": "reached", "prototype": "at least the prototype", "below": "below the prototype"}
HEADINGS = (
    *("contender", "median", "quartiles", "min", "x ours", "goal", "prototype", "", "pixels", "colours"),
    "does less than ours",
)
LEFT_ALIGNED = (0, 7, 10)


def head_text(machine: Machine) -> str:
    """Return what stands above the tables."""
    threads = ", ".join(f"{name}={count}" for name, count in THREADS.items())
    return (
        f"{machine.sentence()}\n{threads}\n"
        "Milliseconds, contenders in turn in one process; x ours: their median / ours; pixels: covered on one side "
        "only;\ncolours: off by more than 2 of 255."
    )


def result_text(result: Result) -> str:
    """Return the table of one workload."""
    title = f"{result.workload.name}  {result.workload.title}: {result.facts}"
    if result.size is not None:
        title += f", {result.counts.primitives:,} primitives, {result.counts.pixels:,} pixels"
    ours = result.ours
    rows = [HEADINGS, *(entry_row(result.workload.name, entry, ours) for entry in result.entries)]
    told = [
        f"  {entry.contender.library}: {entry.detail}"
        for entry in (ours, result.shared)
        if entry and entry.detail
    ]
    missing = [f"  {each.library} did not take part: {each.reason}" for each in result.missing]
    return "\n".join([title, *aligned(rows), *told, *shared_lines(result), *missing])


def shared_lines(result: Result) -> list[str]:
    """Return how far the core comes with more than one process, for each library that there is such a goal against."""
    shared, lines = result.shared, []
    for entry in result.entries:
        goal = goal_of(result.workload.name, entry.contender.library, entry.detail, is_shared=True)
        ratio = ratio_to(entry, shared)
        if shared is not None and goal is not None and ratio is not None:
            lines.append(
                f"  {shared.contender.library}: {entry.contender.library} takes {ratio:.2f} times as long, "
                f"goal {goal.wanted:g}, prototype {prototype_text(goal)}: {VERDICTS[goal.verdict(ratio)]}"
            )
    return lines


def entry_row(workload: str, entry: Entry, ours: Entry | None) -> tuple[str, ...]:
    """Return the cells of one contender."""
    times, goal = entry.times, goal_of(workload, entry.contender.library, entry.detail)
    ratio = ratio_to(entry, ours)
    return (
        entry.contender.library,
        f"{times.median:.2f}",
        f"{times.lower_quartile:.2f}–{times.upper_quartile:.2f}",
        f"{times.least:.2f}",
        "" if ratio is None or entry is ours else f"{ratio:.2f}",
        "" if goal is None or goal.wanted is None else f"{goal.wanted:g}",
        "" if goal is None else prototype_text(goal),
        "" if goal is None or ratio is None else VERDICTS[goal.verdict(ratio)],
        f"{entry.difference.covered:,}",
        f"{entry.difference.colored:,}",
        entry.contender.less,
    )


def ratio_to(entry: Entry, ours: Entry | None) -> float | None:
    """Return how many times as long a contender takes as ours."""
    return None if ours is None else entry.times.median / ours.times.median


def prototype_text(goal: Goal) -> str:
    """Return a figure or a range."""
    return "–".join(f"{figure:g}" for figure in goal.prototype)


def aligned(rows: list[tuple[str, ...]]) -> list[str]:
    """Return rows of cells as lines whose columns are aligned."""
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    lines = []
    for row in rows:
        cells = [
            cell.ljust(width) if k in LEFT_ALIGNED else cell.rjust(width)
            for k, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        lines.append(("  " + "  ".join(cells)).rstrip())
    return lines


def foot_text(results: list[Result]) -> str:
    """Return what drew: every library's version, and what it says that it draws with."""
    drew: dict[str, str] = {}
    for entry in (entry for result in results for entry in result.entries):
        if entry.contender.kind != "ours":
            account = ", ".join(filter(None, [entry.version, entry.detail]))
            drew[entry.contender.library] = max(drew.get(entry.contender.library, ""), account, key=len)
    return "\n".join(f"{library}: {account}" for library, account in drew.items())
