"""A place in a run, named by what happens there, so that it stays right where a method gets other steps."""

from dataclasses import dataclass

from core import STAGES, Trace
from core.records.steps import Level
from core.stages.declared import stage_of
from core.trace.run_to import START, named_position


@dataclass(frozen=True)
class RunPlace:
    """Where a run is entered: its first stage's start, if nothing else is said."""

    stage: str = STAGES[0]
    at: str = START
    """What has just happened, as `core.trace.run_to.named_position` reads it."""
    operation: str = ""
    """The operation of that row that is done last, as ``test``; empty: the whole row is done."""
    pixel: tuple[int, int] | None = None
    """Column and row of the pixel that is pinned."""
    triangle: int | None = None
    """The triangle in focus, where a mesh is stepped one triangle at a time; ``None``: one in the middle."""

    @property
    def level(self) -> Level | None:
        """How large a step is from here on; ``None``: as large as before."""
        if self.at == START:
            return None
        return Level.OPERATION if self.operation else Level.PIXEL

    @property
    def sentence(self) -> str:
        """What a person reads of it."""
        pixel = f" at pixel {self.pixel}" if self.pixel else ""
        how = ", operation by operation" if self.operation else ""
        return f"Opens in {stage_of(self.stage).short_title}{pixel}{how}."

    def position(self, run: Trace) -> int:
        """Return the position of ``stage`` in a run; ValueError where nothing of this name happens there."""
        trace = run.stage(self.stage)
        position = named_position(trace, self.at)
        if not self.operation:
            return position
        row, _ = trace.steps.row_at(position)
        done = trace.steps.operations[trace.kind_of(row)] if row >= 0 else ()
        for number, operation in enumerate(done, 1):
            if operation.name == self.operation:
                return int(trace.steps.starts[row]) + number
        raise ValueError(f"{self.at} in {self.stage} has no operation {self.operation}")


FIRST_STEP = RunPlace()
"""Before the first step of all."""
