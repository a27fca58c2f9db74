"""How many threads every library gets; nothing that starts threads may be imported before they are set."""

import os
import sys

THREADS = {
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "NUMBA_NUM_THREADS": "1",
    "LP_NUM_THREADS": "2",
}
"""Environment variables of the libraries that ask; LP is llvmpipe, which the goals give two."""


def set_threads() -> None:
    """Set the variables for this process and those that it starts.

    Raises RuntimeError if NumPy is imported already, which asks only once, and they are not so set.
    """
    if "numpy" in sys.modules and any(os.environ.get(name) != count for name, count in THREADS.items()):
        raise RuntimeError("the number of threads must be set before NumPy is imported")
    os.environ.update(THREADS)
