"""``rasterscope study``: the methods of a family on the same work, their speed against their accuracy."""

import argparse

from app import __version__
from app.cli.arguments import FILE_HELP, add_settings, chosen_settings, outside_hinted, progress_line
from app.cli.commands import MOST_ROUNDS, MOST_SEED, add_allow_outside, load_qt, output_folder, whole_number
from app.cli.stress import show_atlas
from app.files.open_any import open_any
from app.pages.words import (
    best_sentences,
    digits,
    interval_text,
    machine_sentence,
    place_text,
    settings_sentence,
    time_text,
    work_sentence,
)
from app.usage import UsageError
from core import Settings
from core.study.families import study_families, study_family
from core.study.family import chosen_dials
from core.study.record import Study, machine, pareto_front, ranks
from core.study.speed_accuracy import ROUNDS, measure
from core.study.stability import stress, study_experiment

DESCRIPTION = """Measure every method of a family on the same work: time, work counts and errors against an exact
reference. If a method cannot do the work, the reason is printed."""
EXAMPLES = """FAMILY is a setting such as fill or depth, or pipeline: a whole scene with one setting changed at a time.

examples:
  rasterscope study --list
  rasterscope study fill --dial size=64
  rasterscope study fill --work block-size --dial size=128
  rasterscope study fill --work slivers --map angle -o results
  rasterscope study line --work pixel-ends -o results
  rasterscope study orientation --work pivot-q
  rasterscope study pipeline --scene teapot.obj --set cull=back -o results

--map runs every method at all values of a dial, prints a map for each, and -o writes stress-FAMILY-WORK.
-o writes study-FAMILY-WORK .csv, .json, .svg and .png into a folder, with the machine, versions, date and settings.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    parser.add_argument("family", metavar="FAMILY", nargs="?", help="family to compare; --list shows all")
    parser.add_argument(
        "--list", action="store_true", help="list the families with their works, dials and errors"
    )
    parser.add_argument("--work", metavar="NAME", help="kind of work; default: the first of the family")
    parser.add_argument(
        "--dial",
        metavar="NAME=VALUE",
        type=dial_from_text,
        nargs="+",
        action="extend",
        default=[],
        help="size of the work",
    )
    parser.add_argument(
        "--rounds",
        metavar="N",
        type=whole_number(1, MOST_ROUNDS),
        default=ROUNDS,
        help=f"rounds of measurement, more until the order is stable ({ROUNDS})",
    )
    parser.add_argument(
        "--seed", metavar="N", type=whole_number(0, MOST_SEED), default=0, help="seed of the random work (0)"
    )
    parser.add_argument(
        "--map",
        metavar="DIAL",
        nargs="+",
        default=[],
        help="map error and time over the values of one dial, or of two, instead of comparing at one",
    )
    parser.add_argument("--no-growth", action="store_true", help="leave out how time grows with the work")
    parser.add_argument(
        "--error", metavar="NAME", help="error on the chart; default: the first of the family"
    )
    parser.add_argument("--scene", metavar="FILE", help=f"for pipeline: {FILE_HELP}")
    add_allow_outside(parser)
    add_settings(parser, "for pipeline: base settings; one is changed at a time")
    parser.add_argument(
        "-o", "--output", metavar="DIR", help="folder for table, study and charts; default: none"
    )


def dial_from_text(text: str) -> tuple[str, float]:
    """Return name and value of a text such as ``size=64``."""
    name, sign, value = text.partition("=")
    try:
        if name and sign:
            return name, float(value)
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"must be NAME=NUMBER such as size=64, got {text}")


def run(options: argparse.Namespace) -> int:
    """Measure, print and write."""
    if options.list:
        print("\n".join(list_text()))
        return 0
    if options.family is None:
        raise UsageError("FAMILY is required; --list shows all")
    folder = output_folder(options)
    if folder is not None:
        load_qt()
    dials = dict(options.dial)
    try:
        family = study_family(options.family)
        chosen_dials(family.work(options.work), dials)
        if options.error not in (None, *(measure.name for measure in family.measures)):
            known = ", ".join(measure.name for measure in family.measures)
            raise ValueError(f"error of {family.name} must be one of {known}, got {options.error}")
    except ValueError as problem:
        raise UsageError(str(problem)) from problem
    if not family.takes_scene and (options.scene is not None or options.set):
        raise UsageError(f"--scene and --set are for pipeline: {family.name} makes its own scene")
    scene, settings, title = None, None, ""
    if family.takes_scene:
        settings = Settings()
        if options.scene is not None:
            with outside_hinted():
                opened = open_any(options.scene, allows_outside=options.allow_outside)
            scene, title = opened.document.scene, opened.document.title
            if opened.state is not None:
                settings = opened.document.settings
        settings = chosen_settings(settings, options.set)
    if options.map:
        try:
            experiment = study_experiment(
                family, options.map, options.work, dials, scene=scene, settings=settings
            )
        except ValueError as problem:
            raise UsageError(str(problem)) from problem
        with progress_line() as progress:
            atlas = stress(
                experiment,
                seed=options.seed,
                progress=progress,
                machine=machine(__version__),
                with_times=True,
            )
        show_atlas(atlas, folder)
        return 0
    with progress_line() as progress:
        study = measure(
            family.name,
            options.work,
            dials,
            scene=scene,
            settings=settings,
            scene_title=title,
            rounds=options.rounds,
            grow=not options.no_growth,
            seed=options.seed,
            machine=machine(__version__),
            progress=progress,
        )
    print("\n".join(table_text(study)))
    if folder is not None:
        from app.pages.compare.study_files import export_study  # Charts need Qt, numbers do not.

        for path in export_study(study, folder, options.error):
            print(f"wrote {path}")
    return 0


def list_text() -> list[str]:
    """Return all families with their works, dials and errors."""
    lines = []
    for family in study_families():
        lines.append(f"{family.name:<18}{family.title}")
        for work in family.works:
            lines.append(f"    --work {work.name:<14}{work.title}")
            for dial in work.dials:
                values = " ".join(f"{value:g}" for value in dial.values)
                unit = f" ({dial.unit})" if dial.unit else ""
                lines.append(f"        --dial {dial.name}={dial.default:g}  {dial.title}{unit}: {values}")
        names = ", ".join(f"{measure.name} ({measure.unit})" for measure in family.measures)
        lines.append(f"    errors: {names}")
    return lines


def table_text(study: Study) -> list[str]:
    """Return the table that is printed: a star before a method that is on the Pareto front of the first error."""
    front, places = pareto_front(study.points, study.measures[0].name), ranks(study.points)
    head = [
        "",
        "method",
        f"time/{study.work.unit}",
        "least",
        "interval",
        "place",
        *(measure.name for measure in study.measures),
    ]
    rows = [head]
    for point in study.points:
        if not point.is_measured:
            rows.append(["", point.method, "–", "", "", "", *[""] * len(study.measures)])
            continue
        times = [time_text(point.least), interval_text(point.interval), place_text(places[point.method])]
        errors = [digits(point.errors[measure.name]) for measure in study.measures]
        mark = "*" if point in front else ""
        rows.append([mark, point.method, time_text(point.median), *times, *errors])
    lines = [f"{study.title}: {work_sentence(study)}", *aligned(rows)]
    lines += [f"{point.method}: {point.refused}" for point in study.points if point.refused]
    reasons = dict.fromkeys(
        f"{name}: {reason}" for point in study.points for name, reason in point.reasons.items()
    )
    lines += [*reasons, *best_sentences(study), "", *count_lines(study)]
    units = ", ".join(f"{measure.name} in {measure.unit}" for measure in study.measures if measure.unit)
    lines += [f"* on the Pareto front of time and {study.measures[0].name}. Errors: {units}."]
    lines += ["Time: the median. The order of methods whose places overlap is undecided."]
    return [*lines, settings_sentence(study), machine_sentence(study)]


def count_lines(study: Study) -> list[str]:
    """Return the table of the work counts of one run."""
    names = list(dict.fromkeys(name for point in study.points for name in point.counts))
    rows = [["", "method", *names]]
    for point in study.points:
        if point.is_measured:
            rows.append(
                ["", point.method, *(f"{point.counts[n]:,}" if n in point.counts else "–" for n in names)]
            )
    return [*aligned(rows), ""]


def aligned(rows: list[list[str]]) -> list[str]:
    """Return rows of cells under each other: names to the left, numbers to the right."""
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    return [
        "  ".join(
            cell.ljust(width) if column < 2 else cell.rjust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]
