"""Costs of settings: predicted from small pictures; what is slower than the reference settings is not chosen."""

from dataclasses import replace

import pytest

from core.settings import Settings, with_method
from core.study.planner.planning import STAGES, plan
from core.study.planner.records import Tolerance
from core.study.planner.reference_settings import reference_settings
from core.study.planner.trials import TIMED_PIXELS, Costs, TriedCosts
from core.study.workloads import sphere_scene
from tests.core.study.planner.needy_scenes import highlight
from tests.covering import every_nth


class Opposite(Costs):
    """A machine on which one family's cheaper methods take longer."""

    def __init__(self, family: str, dearest: str) -> None:
        self.family, self.dearest = family, dearest

    def is_slower(self, settings: Settings, others: Settings) -> bool:
        """Tell whether the second is the first with the dearest method."""
        return settings != others == with_method(settings, self.family, self.dearest)


@pytest.mark.slow
def test_sixteen_samples_take_longer_than_one() -> None:
    scene = sphere_scene(8, 300)
    assert scene.size[0] * scene.size[1] > TIMED_PIXELS
    costs, everything = TriedCosts(scene), reference_settings(scene)
    one = replace(everything, antialiasing="none")
    assert costs.is_slower(everything, one)
    assert not costs.is_slower(one, everything)
    sixteen, single = costs.seconds((everything, one))
    assert sixteen > single > 0


def test_a_larger_picture_is_predicted_to_take_longer() -> None:
    small, large = (sphere_scene(6, side) for side in (64, 640))
    times = [TriedCosts(scene).seconds((reference_settings(scene),))[0] for scene in (small, large)]
    assert times[1] > times[0]


@pytest.mark.parametrize("family", every_nth((name for name in STAGES if name != "antialiasing"), 4))
def test_what_is_slower_is_not_chosen_and_told(family: str) -> None:
    scene, tolerance = highlight(), Tolerance(250.0)
    usual = plan(scene, tolerance, costs=Costs())
    dearest = getattr(usual.everything, family)
    chosen = plan(scene, tolerance, costs=Opposite(family, dearest))
    decision = next(each for each in chosen.decisions if each.setting == family)
    has_effect = family not in ("clipping", "texture_filter", "depth")
    assert getattr(usual.settings, family) != dearest
    assert (decision.chosen == dearest) == has_effect
    assert ("longer here" in decision.reason) == has_effect
    assert not decision.is_needed


def test_choices_that_take_longer_together_are_not_made() -> None:
    scene = highlight()
    everything = reference_settings(scene)

    class SlowTogether(Costs):
        def is_slower(self, settings: Settings, others: Settings) -> bool:
            """Tell whether the second are the reference settings but the first several things less."""
            changed = sum(getattr(settings, name) != getattr(others, name) for name in STAGES)
            return others == everything and changed > 1

    chosen = plan(scene, Tolerance(2.0), costs=SlowTogether())
    assert chosen.settings == everything
    assert chosen.predicted_error == chosen.predicted_pixels == 0
    assert all(each.chosen == each.dearest and not each.is_needed for each in chosen.decisions)
    assert all("so none is made" in each.reason for each in chosen.decisions)


@pytest.mark.slow
def test_a_plan_predicts_its_time_if_anything_was_timed() -> None:
    scene = sphere_scene(4, 24)
    untimed = plan(scene, costs=Costs())
    assert untimed.predicted_seconds is untimed.predicted_everything is None
    timed = plan(scene, Tolerance(255.0))
    assert timed.predicted_seconds is not None
    assert timed.predicted_everything is not None
    assert timed.predicted_seconds < timed.predicted_everything
