r"""The formulas of resolving: weighted means of samples, and sums over pieces of exact area.

Of many samples those of equal colour are one summand; of more than `MOST` colours the largest shares are written out.
"""

from collections.abc import Callable, Mapping

from core.explain.formulas.equation import Part, equation, number_latex
from core.explain.records import Formula
from core.explain.step_values import StepValues

CHANNELS = "rgba"
NAMES = "abcdefghijklmnopqrstuvwxyz"
"""What different samples are called: 0, 1 and 2 are corners."""
MOST = 4
"""Summands that are written out."""


def _channel(step: StepValues) -> int:
    """Return the channel in which the samples differ most."""
    rows = step.rows("samples")
    weights = step.vector("sample_weights")
    spans = []
    for channel in range(3):
        values = [row[channel] for row, weight in zip(rows, weights, strict=True) if weight > 0]
        finite = [value for value in values if abs(value) < float("inf")]
        spans.append(max(finite, default=0.0) - min(finite, default=0.0))
    return max(range(3), key=lambda channel: spans[channel])


def _shares(step: StepValues, channel: int) -> list[tuple[float, float]]:
    """Return the weights of the different values of a channel, the greatest first."""
    shares: dict[str, tuple[float, float]] = {}
    for row, weight in zip(step.rows("samples"), step.vector("sample_weights"), strict=True):
        if weight > 0:
            value = row[channel]
            known = shares.get(number_latex(value), (0.0, value))
            shares[number_latex(value)] = (known[0] + weight, known[1])
    return sorted(shares.values(), key=lambda share: -share[0])


def weights_together(step: StepValues) -> Formula:
    """What all samples weigh."""
    shares = _shares(step, _channel(step))
    return _sum(
        r"W",
        sum(weight for weight, _ in shares),
        [(rf"w_{{{NAMES[k % 26]}}}", w) for k, (w, _) in enumerate(shares)],
    )


def areas_together(step: StepValues) -> Formula:
    """What all pieces cover."""
    shares = _shares(step, _channel(step))
    return _sum(
        r"A",
        sum(area for area, _ in shares),
        [(rf"A_{{{NAMES[k % 26]}}}", area) for k, (area, _) in enumerate(shares)],
    )


def _sum(symbol: str, value: float, summands: list[tuple[str, float]]) -> Formula:
    parts: list[Part] = [(symbol, value), "="]
    for place, summand in enumerate(summands[:MOST]):
        parts += ["+"] if place else []
        parts.append(summand)
    parts += ["+", (r"\dots", r"\dots")] if len(summands) > MOST else []
    return equation(*parts)


def mean(step: StepValues) -> Formula:
    """The weighted mean, in the channel where the samples differ most."""
    channel = _channel(step)
    shares = _shares(step, channel)
    total = sum(weight for weight, _ in shares)
    result = (CHANNELS[channel], step.vector("linear")[channel])
    parts: list[Part] = [result, "="]
    for place, (weight, value) in enumerate(shares[:MOST]):
        parts += ["+"] if place else []
        share = rf"\frac{{{number_latex(weight)}}}{{{number_latex(total)}}}"
        parts += [
            (rf"\frac{{w_{NAMES[place]}}}{{W}}", share),
            r"\cdot",
            (rf"{CHANNELS[channel]}_{NAMES[place]}", value),
        ]
    parts += ["+", (r"\dots", r"\dots")] if len(shares) > MOST else []
    return equation(*parts)


def area_sum(step: StepValues) -> Formula:
    """The sum of areas times colours."""
    channel = _channel(step)
    parts: list[Part] = [(CHANNELS[channel], step.vector("linear")[channel]), "="]
    shares = _shares(step, channel)
    for place, (area, value) in enumerate(shares[:MOST]):
        parts += ["+"] if place else []
        parts += [(rf"A_{NAMES[place]}", area), r"\cdot", (rf"{CHANNELS[channel]}_{NAMES[place]}", value)]
    parts += ["+", (r"\dots", r"\dots")] if len(shares) > MOST else []
    return equation(*parts)


FORMULAS: Mapping[str, Callable[[StepValues], Formula | None]] = {
    "resolve.average.samples": weights_together,
    "resolve.average.divide": mean,
    "resolve.areas.samples": areas_together,
    "resolve.areas.divide": area_sum,
}
