"""Settings from texts, as files and the command line have them, and as files keep them."""

from collections.abc import Mapping
from dataclasses import replace

from core.settings import FIELDS, WHOLE_NUMBERS, Settings


def settings_from_texts(pairs: Mapping[str, str], base: Settings | None = None) -> Settings:
    """Return ``base``, or the defaults, changed by texts such as ``{"fill": "blocks", "block_size": "4"}``.

    A wrong name raises ValueError.
    """
    for name in pairs:
        if name not in FIELDS:
            raise ValueError(f"setting must be one of {', '.join(sorted(FIELDS))}, got {name}")
    values: dict[str, str | int] = dict(pairs)
    for name in WHOLE_NUMBERS.keys() & pairs.keys():
        try:
            values[name] = int(pairs[name])
        except ValueError:
            raise ValueError(f"{name} must be a whole number, got {pairs[name]}") from None
    return replace(base or Settings(), **values)  # type: ignore[arg-type]


def settings_record(settings: Settings) -> dict[str, str | int]:
    """Return settings by name, as files keep them; ValueError where a function was replaced, which has no name."""
    for family, method in settings.replacements.items():
        raise ValueError(f"{family} {method.name} runs a replaced function, which cannot be saved")
    return dict(vars(settings))
