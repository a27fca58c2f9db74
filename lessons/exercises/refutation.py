"""What refutes a belief: a sentence, and the step of a run that shows it."""

from dataclasses import dataclass

from core import Settings, trace
from core.scene import AnyScene
from core.settings import DEFAULTS
from core.trace.run_to import named_position


@dataclass(frozen=True, eq=False)
class Refutation:
    """A sentence, and the first step of a stage that meets a condition."""

    sentence: str
    scene: AnyScene
    stage: str
    condition: str
    """What happens there, as `named_position` reads it."""
    settings: Settings = DEFAULTS

    def position(self) -> int:
        """Return where the cursor stands when the step is done; ValueError where no step meets the condition."""
        return named_position(trace(self.scene, self.settings).stage(self.stage), self.condition)
