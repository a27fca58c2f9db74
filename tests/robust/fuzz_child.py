"""The child of fuzz.py: opens the files whose names come in, and answers how each went.

What a user would see is an exception of the program's own kinds; every other one is a traceback. Each answer has the
traceback, the files opened outside the folder of the cases, and the peak of memory since the last answer.
"""

import json
import os
import re
import sys
import traceback
from contextlib import suppress

ROOT, FOLDER = sys.argv[1:3]
sys.path.insert(0, ROOT)

import numpy as np  # noqa: E402

from app.files.open_any import open_any  # noqa: E402
from app.pages.compare.study_files import load_study, study_csv  # noqa: E402
from app.pages.stability.atlas_files import load_atlas  # noqa: E402

TRACED = 50
"""Most triangles that are traced: a trace keeps every pixel of each, which is not what the bound on memory is about."""
FOREIGN = re.compile(
    "could not convert|invalid literal|to unpack|unable to parse|reshape|broadcast|Python int|NoneType|codec|"
    "out of range|out of bounds|unmatched data|input tag|has no attribute"
)
"""Words that Python and its libraries have for themselves: no message to a user has them."""
OUTSIDE: list[str] = []
ALLOWED = (
    ROOT,
    FOLDER,
    sys.prefix,
    sys.base_prefix,
    os.path.dirname(os.__file__),
    "/proc/",
    "/sys/",
    "/usr/",
    "/etc/",
)


def watch(event: str, arguments: tuple[object, ...]) -> None:
    """Note a file that is opened outside the folders of the cases, of the program and of Python."""
    if event == "open" and isinstance(arguments[0], str | bytes):
        path = os.fsdecode(arguments[0])
        if not os.path.abspath(path).startswith(ALLOWED) or "server" in path:
            OUTSIDE.append(path)


def peak() -> float:
    """Return the peak of memory in MB since this was asked last; 0 where it is not known."""
    try:
        with open("/proc/self/status", encoding="ascii") as status:
            found = next(line for line in status if line.startswith("VmHWM"))
        with open("/proc/self/clear_refs", "w", encoding="ascii") as clear:
            clear.write("5")
    except OSError:
        return 0.0
    return int(found.split()[1]) / 1024


def open_one(path: str) -> None:
    """Open a file as the window and the command line do, and trace what is in it."""
    if path.endswith("study.json"):
        study_csv(load_study(path))
    elif path.endswith(".json"):
        load_atlas(path)
    else:
        document = open_any(path).document
        if document.triangle_count <= TRACED:
            with np.errstate(all="ignore"), suppress(ValueError):
                document.make_trace().stage("raster")


def main() -> None:
    """Answer until there are no more names."""
    os.environ["RASTERSCOPE_CONFIG"] = os.path.join(FOLDER, "config")
    answer({"ready": True})
    for line in sys.stdin:
        OUTSIDE.clear()
        peak()
        text = ""
        try:
            open_one(json.loads(line))
        except (ValueError, OSError) as problem:
            message = str(problem)
            is_raw = type(problem).__module__ in ("builtins", "numpy") or "\n" in message or not message
            if is_raw or FOREIGN.search(message):
                text = traceback.format_exc()
        except BaseException:
            text = traceback.format_exc()
        answer({"traceback": text, "outside": list(OUTSIDE), "peak": peak()})


def answer(record: dict[str, object]) -> None:
    """Write one line."""
    sys.stdout.write(json.dumps(record) + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.addaudithook(watch)
    main()
