"""Two runs of one stage that are stepped together: each has a cursor of its own, and who has no more steps waits."""

from core.records.steps import Level, Steps


class LockStep:
    """Counts the steps of a level that two runs have done; the first one's cursor leads, the second one follows.

    The counts go on where a run has no more steps (or, backwards, none yet): it waits there, and takes part again when
    the other one comes back to the step at which it stopped. So any steps forward are undone by as many back.
    """

    def __init__(self, first: Steps, second: Steps, position: int, level: Level) -> None:
        """Start at a position of the first run, with the second one after as many steps."""
        self._runs = first, second
        self._level, self._position = level, 0
        self._counts = [0, 0]
        self._jump(position)

    @property
    def second_position(self) -> int:
        """Where the second run is."""
        return self._place(1, self._counts[1])

    def done(self, run: int) -> int:
        """Return how many steps of the level run 0 or 1 has done."""
        return min(max(self._counts[run], 0), self.steps(run))

    def steps(self, run: int) -> int:
        """Return how many steps of the level run 0 or 1 has."""
        return len(self._runs[run].boundaries(self._level)) - 1

    def waits(self, run: int) -> bool:
        """Return whether run 0 or 1 has no step to do while the other one does."""
        return self._counts[run] != self.done(run) and self._counts[1 - run] == self.done(1 - run)

    def follow(self, position: int, level: Level) -> None:
        """Take the second run along: the first one is at a position now, by one step or by a jump."""
        self._set_level(level)
        if position == self._position:
            return
        for direction in (1, -1):
            if position == self._place(0, self._counts[0] + direction):
                self._counts = [count + direction for count in self._counts]
                self._position = position
                return
        self._jump(position)

    def step_second(self, direction: int, level: Level) -> bool:
        """Step the second run where the first one has no step; return whether that is so."""
        self._set_level(level)
        counts = [count + direction for count in self._counts]
        is_alone = self._place(0, counts[0]) == self._position
        if not is_alone or self._place(1, counts[1]) == self.second_position:
            return False
        self._counts = counts
        return True

    def land(self, second_position: int) -> None:
        """Put the second run at a position of its own; from there on both go together."""
        self._counts[1] = self._count(1, second_position)

    def _set_level(self, level: Level) -> None:
        if level != self._level:
            second = self.second_position
            self._level = level
            self._counts = [self._count(0, self._position), self._count(1, second)]

    def _jump(self, position: int) -> None:
        count = self._count(0, position)
        is_at_end = position >= self._runs[0].count > 0
        self._counts = [count, self.steps(1) if is_at_end else min(count, self.steps(1))]
        self._position = position

    def _count(self, run: int, position: int) -> int:
        """Return how many whole steps a run has done at a position."""
        return int(self._runs[run].boundaries(self._level).searchsorted(position, "right")) - 1

    def _place(self, run: int, count: int) -> int:
        """Return the position of a run after so many steps, or where it waits."""
        boundaries = self._runs[run].boundaries(self._level)
        return int(boundaries[min(max(count, 0), len(boundaries) - 1)])
