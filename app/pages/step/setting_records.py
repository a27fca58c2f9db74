"""The settings as panels offer them: one record each, with what does not matter now and why."""

from functools import lru_cache

from app.session.document import Document
from core.families import WholeNumber
from core.methods import table
from core.scene import AnyScene
from core.settings import DEFAULTS, FAMILIES, FIELDS, WHOLE_NUMBERS, Settings, no_effect
from core.stages.declared import DECLARED, stage_of
from core.stages.needs import refusal
from widgets.basics.settings_panel import Setting, SettingChoice


def settings_records(document: Document) -> tuple[Setting, ...]:
    """Return one record per setting, with what does not matter now and why."""
    return _records(document.settings, document.scene)


@lru_cache(maxsize=4)  # What is shown, beside B what that does, and both of the step that is prepared.
def _records(settings: Settings, scene: AnyScene) -> tuple[Setting, ...]:
    records, last = [], ""
    order = [stage.name for stage in DECLARED]
    for family in sorted(FAMILIES, key=lambda family: order.index(FAMILIES[family].stage)):
        for name in (family, *(number for number in WHOLE_NUMBERS if FIELDS[number].taken_by == family)):
            heading = stage_of(FAMILIES[family].stage).heading
            records.append(_record(settings, scene, name, heading if heading != last else ""))
            last = heading
    return tuple(records)


def _record(settings: Settings, scene: AnyScene, name: str, heading: str) -> Setting:
    declared = FIELDS[name]
    current = str(getattr(settings, name))
    if isinstance(declared, WholeNumber):
        numbers = [str(number) for number in declared.offered]
        numbers += [] if current in numbers else [current]
        choices = tuple(SettingChoice(number, declared.label.format(number)) for number in numbers)
        is_more = False
    else:
        # Where another function runs in place of a method, its name stands there.
        runs = getattr(settings, name)
        choices = tuple(
            _choice(scene, name, runs if method == current else method) for method in table.names(name)
        )
        is_more = not FAMILIES[name].classical
    if name == "shading" and scene.program is not None:
        choices, current = (SettingChoice("", "Your shader"), *choices), ""
    reason = no_effect(settings, name, scene)
    is_used = current != str(getattr(DEFAULTS, name))
    is_more = not is_used and (is_more or (isinstance(declared, WholeNumber) and bool(reason)))
    return Setting(name, declared.title, choices, current, reason, heading, is_more)


def _choice(scene: AnyScene, family: str, name: str) -> SettingChoice:
    found = table.get(family, name)
    breaks = f"\nBreaks: {found.breaks_where}." if found.breaks_where else ""
    tooltip = f"{name}\nSource: {found.source}.\nExact for {found.exact_for}.{breaks}"
    reason = refusal(family, name, scene)
    return SettingChoice(
        str(name), found.title, tooltip, reason and f"It {reason}.", name not in FAMILIES[family].classical
    )
