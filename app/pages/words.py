"""How the numbers of a study read: times with their unit, errors, and what was measured on."""

from collections.abc import Mapping
from math import floor, isnan, log10

from core.records.words import joined
from core.settings import Settings
from core.study.record import Study, best_values

TIME_UNITS = ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"))


def time_text(seconds: float) -> str:
    """Return a time with three digits and its unit."""
    for size, unit in TIME_UNITS:
        if seconds >= size:
            return f"{digits(seconds / size)} {unit}"
    return f"{digits(seconds / 1e-9)} ns"


def interval_text(interval: tuple[float, float]) -> str:
    """Return two times: ``1.2 ms to 1.4 ms``."""
    return " to ".join(map(time_text, interval))


def place_text(places: tuple[int, int]) -> str:
    """Return the places that a method may have by its time: ``3``, or ``3–5`` where it is not told apart."""
    first, last = places
    return str(first) if first == last else f"{first}–{last}"


def digits(number: float, count: int = 3) -> str:
    """Return a number with ``count`` digits, without an exponent where it stays short."""
    if number == 0:
        return "0"
    if isnan(number):
        return "–"
    power = floor(log10(abs(number)))
    if -4 <= power < 7:
        return f"{number:,.{max(count - 1 - power, 0)}f}"
    return f"{number:.{count - 1}e}"


def with_unit(number: str, unit: str) -> str:
    """Return a number with its unit; one such as 1/255 is a fraction: 0.5/255."""
    return f"{number}{unit[1:]}" if unit.startswith("1/") else f"{number} {unit}".rstrip()


def work_sentence(study: Study) -> str:
    """Return what was done, with the values of all dials."""
    parts = [f"{study.work.title}{f' ({study.scene})' if study.scene else ''}"]
    for dial in study.work.dials:
        parts.append(f"{dial.title.lower()} {with_unit(f'{study.dials[dial.name]:g}', dial.unit)}")
    return "; ".join(parts)


def best_sentences(study: Study) -> list[str]:
    """Return at which value of the setting that was turned each method was fastest, and on what that depends."""
    found = best_values(study)
    if not found:
        return []
    dial = next(dial for dial in study.work.dials if dial.is_cost)
    lines = []
    for best in found:
        others = joined([f"{value:g}" for value in sorted(best.others)])
        rest = f"; the difference at {others} is within the noise" if others else ""
        lines.append(
            f"{best.title}: fastest at {dial.title.lower()} {with_unit(f'{best.value:g}', dial.unit)}{rest}."
        )
    return [*lines, "This depends on the machine, and on the size of the triangles."]


def machine_sentence(study: Study) -> str:
    """Return what was measured on, with the versions and the day."""
    return machine_words(study.machine)


def machine_words(here: Mapping[str, str]) -> str:
    """Return a machine as `core.study.record.machine` describes it, in words."""
    if not here:
        return "The machine is unknown."
    return (
        f"{here.get('processor', '?')}, {here.get('system', '?')}; Python {here.get('python', '?')}, "
        f"NumPy {here.get('numpy', '?')}, Rasterscope {here.get('rasterscope', '?')}; {here.get('date', '?')}"
        + (f"; {here['load']}" if "load" in here else "")
    )


def settings_sentence(study: Study) -> str:
    """Return the settings that all points share, as far as they are not the defaults, and the seed."""
    default = vars(Settings())
    changed = [f"{name}={value}" for name, value in vars(study.settings).items() if value != default[name]]
    return f"Settings: {' '.join(changed) or 'defaults'}; seed {study.seed}"
