"""Lines of an OBJ file that are read together: the same numbers and the same errors as one by one."""

from random import Random

import pytest

from app.files.mesh_formats import obj
from app.files.mesh_formats.obj import corner_rows, decimal_rows, read_lines, runs_of_lines
from app.files.mesh_formats.reading import MeshFileError
from tests.app.files.mesh_writing import write

CORNERS = ("{}", "{}/{}", "{}//{}", "{}/{}/{}")
DAMAGE = ("", "", " ", "\t", "/", "//", "-", "1", "x", "#", "\\\n", "\n", "nan", "\x85", "1e999", "_")


def block_of_lines(random: Random) -> list[str]:
    """Return many lines of one keyword."""
    keyword, width = random.choice([("v", 3), ("v", 4), ("v", 6), ("vt", 2), ("vt", 3), ("vn", 3), ("f", 3)])
    gap, end = random.choice([" ", "  ", "\t"]), random.choice(["", "", " "])
    form = random.choice(["{:.0f}", "{:.3f}", "{:e}"] if keyword != "f" else CORNERS)
    lines = []
    for _ in range(random.randint(14, 40)):
        sizes = width if keyword != "f" else random.choice([3, 4])
        low, numbers = (-9, random.uniform) if keyword != "f" else (1, random.randint)
        words = [form.format(*(numbers(low, 30) for _ in range(3))) for _ in range(sizes)]
        lines.append(keyword + gap + " ".join(words) + end)
    return lines


def outcome(path):
    try:
        found = read_lines(path, lambda fraction, doing: None)
    except MeshFileError as problem:
        return str(problem)
    # As text, where a number that is not one equals itself.
    return repr(found)


def test_lines_read_together_say_what_each_says(tmp_path, monkeypatch):
    refused = 0
    for seed in range(300):
        random = Random(seed)
        lines = [line for _ in range(random.randint(1, 4)) for line in block_of_lines(random)]
        if seed % 3:
            number = random.randrange(len(lines))
            place = random.randrange(len(lines[number]))
            lines[number] = lines[number][:place] + random.choice(DAMAGE) + lines[number][place + seed % 2 :]
        path = write(tmp_path / "a.obj", "\n".join(lines))
        together = outcome(path)
        with monkeypatch.context() as patch:
            patch.setattr(obj, "FEWEST_ALIKE", 10**9)
            assert outcome(path) == together, f"seed {seed}"
        refused += together.startswith("a.obj, line ")
    assert 30 < refused < 270


def test_lines_of_one_keyword_are_found():
    text = b"v 1\nv 2\nv 3\nf 1\nvt 1\nf 2\nf 3\nf 4\n"
    assert list(runs_of_lines(text, 3, 100)) == [
        (b"v 1\nv 2\nv 3\n", 3),
        (b"f 1\nvt 1\n", 2),
        (b"f 2\nf 3\nf 4\n", 3),
    ]
    assert [count for _, count in runs_of_lines(text, 3, 2)] == [2, 1, 1, 1, 1, 2]


def test_words_that_only_add_up_are_not_read_together():
    assert decimal_rows(b"v 1 2 3\nv 1 2\n", 2) is None
    assert decimal_rows(b"v 1 2 +\nv 1 2 3\n", 2) is None
    assert decimal_rows(b"v 1 2 nan\nv 1 2 nan\n", 2) is None
    assert corner_rows(b"f 1/2/3 1/2/3 1/2/3\nf 1//3 1//3 1//3\n") is None
    assert corner_rows(b"f 1//3 1//3 1//\nf 1/2/3 1//3 1//3\n") is None
    assert corner_rows(b"f 1 2 9223372036854775808\nf 1 2 3\n") is None


@pytest.mark.parametrize("end", ["\\", "\\\n"])
def test_a_last_line_that_goes_on_is_read(tmp_path, end):
    found = read_lines(write(tmp_path / "a.obj", "f 1 2 3 " + end), lambda fraction, doing: None)
    assert found.corners.tolist() == [1, 0, 0, 2, 0, 0, 3, 0, 0]
