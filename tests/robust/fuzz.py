"""Damages files of every format at random and opens each: none may end in a traceback, hang, or take much memory.

    python tests/robust/fuzz.py [--cases N] [--seed N] [--keep FOLDER]

Many cases are opened one after the other in one warm child process, with a limit on the time and the memory of each.
A child that breaks a limit is ended and replaced. Whatever was found is printed with the seed of its case, and kept in
the folder; a case of one seed is the same again with ``--cases 1 --seed N``.
"""

import argparse
import json
import math
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from queue import Empty, SimpleQueue
from threading import Thread

ROOT = Path(__file__).resolve().parents[2]
SECONDS = 5.0
"""A case that takes more processor time hangs."""
PATIENCE = 60.0
"""Seconds after which a case hangs that takes no processor time, or too little to tell on a busy machine."""
MEGABYTES = 256
"""What a case may take at its peak, the program itself included; the arrays of the small files do not count."""
TOKENS = (
    *(
        b"0",
        b"-1",
        b"1",
        b"2147483648",
        b"99999999999999999999",
        b"1e999",
        b"nan",
        b"-",
        b"/",
        b"//",
        b"#",
        b"\\\n",
    ),
    *(
        b"\n",
        b" ",
        b"\0",
        b"\xff\xfe",
        b"null",
        b"[]",
        b"{}",
        b'"',
        b"true",
        b"1e-320",
        b"../outside.png",
        b"/dev/zero",
    ),
    *(
        b"//server/share/a.png",
        b"f ",
        b"v ",
        b"vt ",
        b"vn ",
        b"usemtl ",
        b"element ",
        b"property list uchar int ",
    ),
)
Files = dict[str, bytes]
"""Content by name; the first is opened, the others stand beside it."""


# Damage.


def damaged(content: bytes, chance: random.Random) -> bytes:
    """Return a file with a few places changed: bits, bytes, numbers, words, lines, pieces of itself."""
    changed = bytearray(content)
    for _ in range(chance.choice((1, 1, 1, 2, 3, 8))):
        chance.choice(DAMAGES)(changed, chance)
    return bytes(changed)


def flip(content: bytearray, chance: random.Random) -> None:
    """Flip one bit."""
    if content:
        content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)


def put_number(content: bytearray, chance: random.Random) -> None:
    """Put a binary number that is at some limit over others."""
    width = chance.choice((1, 2, 4, 8))
    value = chance.choice((0, 1, 2**7, 2**8 - 1, 2**15, 2**31 - 1, 2**31, 2**32 - 1, 2**62)) % 2 ** (
        8 * width
    )
    place = chance.randrange(len(content) + 1)
    content[place : place + width] = value.to_bytes(width, chance.choice(("little", "big")))


def put_token(content: bytearray, chance: random.Random) -> None:
    """Put a word that means something, in between or over others."""
    place = chance.randrange(len(content) + 1)
    content[place : place + chance.choice((0, 0, 1, 4))] = chance.choice(TOKENS)


def change_word(content: bytearray, chance: random.Random) -> None:
    """Replace a word, or a number of a text."""
    words = content.split(b" ")
    words[chance.randrange(len(words))] = chance.choice(TOKENS)
    content[:] = b" ".join(words)


def change_lines(content: bytearray, chance: random.Random) -> None:
    """Remove, repeat or move a line."""
    lines = content.split(b"\n")
    line = lines.pop(chance.randrange(len(lines)))
    for _ in range(chance.choice((0, 1, 2, 200))):
        lines.insert(chance.randrange(len(lines) + 1), line)
    content[:] = b"\n".join(lines)


def cut(content: bytearray, chance: random.Random) -> None:
    """Cut off the end, or take out a piece."""
    first = chance.randrange(len(content) + 1)
    del content[first : chance.choice((len(content), first + chance.randrange(1, 40)))]


def repeat(content: bytearray, chance: random.Random) -> None:
    """Put a copy of a piece somewhere else."""
    first = chance.randrange(len(content) + 1)
    piece = content[first : first + chance.randrange(1, 200)] * chance.choice((1, 1, 50))
    place = chance.randrange(len(content) + 1)
    content[place:place] = piece


DAMAGES: tuple[Callable[[bytearray, random.Random], None], ...] = (
    *(flip, put_number, put_token, change_word, change_lines, cut, repeat),
)


def changed_json(content: bytes, chance: random.Random) -> bytes:
    """Return a JSON file in which one value is another one, missing, or of another kind."""
    record = json.loads(content)
    places = list(places_of(record))
    for _ in range(chance.choice((1, 1, 2, 4))):
        holder, key = chance.choice(places)
        values = (0, -1, 2**31, 10**30, 1e308, 0.5, "", "x", "../outside.obj", [], {}, None, True, [[[]]])
        action = chance.randrange(4)
        if action == 0 and isinstance(holder, dict):
            holder.pop(key, None)
        elif action == 1 and isinstance(holder, list):
            holder.extend(holder[:1] * chance.choice((1, 100)))
        elif isinstance(holder, dict) or key < len(holder):
            holder[key] = chance.choice(values)
    return json.dumps(record).encode()


def places_of(value: object) -> Iterator[tuple[object, object]]:
    """Yield every object or list of a JSON value with each of its keys."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        yield value, key
        yield from places_of(inner)


def make_case(seeds: list[Files], number: int) -> Files:
    """Return the files of the case with a number: a seed file of which one part is damaged."""
    chance = random.Random(number)
    files = dict(chance.choice(seeds))
    name = chance.choice([*files, next(iter(files))])
    is_json = name.endswith((".rasterscope", ".json", ".gltf"))
    files[name] = (changed_json if is_json and chance.random() < 0.6 else damaged)(files[name], chance)
    return files


# The child.


@dataclass
class Child:
    """A process that opens one file after the other."""

    process: subprocess.Popen[bytes]
    answers: "SimpleQueue[dict[str, object] | None]"
    errors: Path

    @classmethod
    def started(cls, folder: Path, errors: Path) -> "Child":
        """Start a child that reports what it reads outside ``folder``."""
        with errors.open("wb") as output:
            process = subprocess.Popen(
                [sys.executable, "-P", str(ROOT / "tests/robust/fuzz_child.py"), str(ROOT), str(folder)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=output,
            )
        answers: SimpleQueue[dict[str, object] | None] = SimpleQueue()
        Thread(target=listen, args=(process, answers), daemon=True).start()
        child = cls(process, answers, errors)
        if child.answers.get(timeout=120) is None:
            raise RuntimeError(errors.read_text())
        return child

    def problem(self, path: Path) -> str:
        """Open a file; return what is wrong with how that went, or an empty text."""
        self.process.stdin.write(json.dumps(str(path)).encode() + b"\n")
        self.process.stdin.flush()
        begun, start = processor_seconds(self.process.pid), time.monotonic()
        while True:
            try:
                answer = self.answers.get(timeout=SECONDS)
                break
            except Empty:
                taken = processor_seconds(self.process.pid) - begun
                if not taken <= SECONDS or time.monotonic() - start > PATIENCE:
                    return f"hang: {taken:.0f} s of processor time"
        if answer is None:
            self.process.wait()
            return f"end: the child ended with code {self.process.returncode}"
        if answer["traceback"]:
            return f"traceback: {answer['traceback']}"
        if answer["outside"]:
            return f"outside: {answer['outside']}"
        if float(str(answer["peak"])) > MEGABYTES:
            return f"memory: {answer['peak']} MB"
        if text := self.errors.read_bytes():
            return f"stderr: {text[:500]!r}"
        return ""

    def end(self) -> None:
        """End the process."""
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()


def processor_seconds(pid: int) -> float:
    """Return the processor time of a process; infinity where it is not known, so that only the clock counts."""
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return math.inf
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def listen(process: "subprocess.Popen[bytes]", answers: "SimpleQueue[dict[str, object] | None]") -> None:
    """Put every answer of a child into a queue, and ``None`` at its end."""
    for line in process.stdout:
        answers.put(json.loads(line))
    answers.put(None)


# The run.


def fuzz(cases: int, seed: int, keep: Path) -> list[str]:
    """Open ``cases`` damaged files; return a line for each that went wrong, whose files are kept."""
    sys.path.insert(0, str(ROOT))
    from tests.robust.fuzz_seeds import seed_files

    found = []
    with tempfile.TemporaryDirectory(prefix="rasterscope-fuzz-") as name:
        folder = Path(name, "files")
        folder.mkdir()
        (folder.parent / "outside.png").write_bytes(b"not to be read")
        seeds = seed_files(Path(name, "seeds"))
        child = Child.started(folder, Path(name, "errors"))
        for number in range(seed, seed + cases):
            files = make_case(seeds, number)
            for file, content in files.items():
                (folder / file).write_bytes(content)
            problem = child.problem(folder / next(iter(files)))
            if problem:
                found.append(f"--cases 1 --seed {number}: {next(iter(files))}: {problem}")
                print(found[-1], flush=True)
                shutil.copytree(folder, keep / str(number), dirs_exist_ok=True)
                child.end()
                child = Child.started(folder, Path(name, "errors"))
            for file in list(folder.iterdir()):
                file.unlink()
        child.end()
    return found


def main() -> int:
    """Do what the command line asks; the exit code is 1 if something was found."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--cases", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=random.SystemRandom().getrandbits(31))
    parser.add_argument("--keep", type=Path, default=Path(tempfile.gettempdir(), "rasterscope-fuzz-found"))
    options = parser.parse_args()
    print(f"{options.cases} cases from --seed {options.seed}", flush=True)
    found = fuzz(options.cases, options.seed, options.keep)
    print(f"{len(found)} of {options.cases} went wrong" + (f"; they are in {options.keep}" if found else ""))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
