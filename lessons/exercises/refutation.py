"""What refutes a belief: a sentence, and the step of a run that shows it."""

from dataclasses import dataclass

from core import Settings, trace
from core.scene import AnyScene
from core.settings import DEFAULTS
from core.trace.conditions import parse_condition
from core.trace.run_to import next_event


@dataclass(frozen=True, eq=False)
class Refutation:
    """A sentence, and the first step of a stage that meets a condition."""

    sentence: str
    scene: AnyScene
    stage: str
    condition: str
    """Of the stage's variables, as breakpoints have them."""
    settings: Settings = DEFAULTS

    def position(self) -> int:
        """Return where the cursor stands when the step is done; ValueError where no step meets the condition."""
        stage = trace(self.scene, self.settings).stage(self.stage)
        position = next_event(stage, 0, parse_condition(self.condition).holds(stage))
        if position is None:
            raise ValueError(f"no step of {self.stage} meets {self.condition}")
        return position
