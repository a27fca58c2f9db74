"""Tests of the application share the folder's helper modules."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
