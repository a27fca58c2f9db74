"""Whether sharing is faster here and now: measured, because the other core may have work of its own."""

from collections import deque
from statistics import median

from core.fast_path.workers.cost_model import Load

EVIDENCE = 5
"""Pictures of a kind that tell how long they take."""
ALONE_FOR = 30
"""Pictures drawn in one process after sharing turned out slower, before it is tried again."""
ALONE_FOR_AT_MOST = 480
"""Each time it turns out slower again the pause doubles, up to this."""
SAME_KIND = 2.0
"""Pictures whose estimated work is within this factor can be compared."""


class Pace:
    """Compares pictures drawn alone with pictures drawn together.

    Notes
    -----
    A few pictures are drawn alone first. Then they are shared for as long as that is faster than those were; where it
    is not, one process draws for a while, and sharing is tried again: what keeps the other core busy may end. So while
    all is well no picture is drawn slowly only to compare.
    """

    def __init__(self) -> None:
        self._alone: deque[float] = deque(maxlen=EVIDENCE)
        self._shared: deque[float] = deque(maxlen=EVIDENCE)
        self._estimate = 0.0
        self._pause = 0
        self._next_pause = ALONE_FOR

    @property
    def may_share(self) -> bool:
        """Whether the next picture should be shared, as far as times tell."""
        return self._pause == 0 and len(self._alone) == EVIDENCE

    @property
    def reason(self) -> str:
        """Why the next picture should not be shared."""
        return "sharing was slower than one process" if self._pause else "one process is timed first"

    def alone(self, seconds: float, load: Load) -> None:
        """Take note of a picture that one process drew."""
        self._compare_with(load)
        self._alone.append(seconds)
        self._pause = max(self._pause - 1, 0)

    def shared(self, seconds: float, load: Load) -> None:
        """Take note of a picture that was shared."""
        if not self._compare_with(load):
            return
        self._shared.append(seconds)
        if len(self._shared) < EVIDENCE:
            return
        if median(self._shared) <= median(self._alone):
            self._next_pause = ALONE_FOR
            return
        self._pause = self._next_pause
        self._next_pause = min(2 * self._next_pause, ALONE_FOR_AT_MOST)
        self._shared.clear()

    def _compare_with(self, load: Load) -> bool:
        """Forget what was measured where the work is of another kind; return whether it is of the same."""
        if self._estimate / SAME_KIND <= load.seconds <= self._estimate * SAME_KIND:
            return True
        self._estimate = load.seconds
        self._alone.clear()
        self._shared.clear()
        self._pause, self._next_pause = 0, ALONE_FOR
        return False
