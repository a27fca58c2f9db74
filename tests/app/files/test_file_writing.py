"""Writing a file whole or not at all."""

import os
import stat
import sys

import pytest

from app.files.file_access import FileWriteError, check_writable, whole_file, write_file


def test_the_file_appears_when_it_is_whole(tmp_path):
    path = tmp_path / "a.txt"
    with whole_file(path) as file:
        file.write(b"one")
        assert not path.exists()
    assert path.read_bytes() == b"one"
    assert os.listdir(tmp_path) == ["a.txt"]


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt, MemoryError])
def test_what_stands_there_stays_when_something_goes_wrong(tmp_path, error):
    path = tmp_path / "a.txt"
    path.write_bytes(b"old")

    def write():
        with whole_file(path) as file:
            file.write(b"new")
            raise error

    with pytest.raises(error):
        write()
    assert path.read_bytes() == b"old"
    assert os.listdir(tmp_path) == ["a.txt"]


def test_an_error_of_the_system_names_the_file(tmp_path):
    def write():
        with whole_file(tmp_path / "a.txt"):
            raise OSError(28, "No space left on device")

    with pytest.raises(FileWriteError, match=r"a\.txt cannot be written: no space left on device"):
        write()


@pytest.mark.skipif(sys.platform == "win32", reason="POSIX permissions and links")
class TestPosix:
    def test_a_new_file_has_the_usual_permissions(self, tmp_path):
        (tmp_path / "usual").write_bytes(b"")
        with whole_file(tmp_path / "new"):
            pass
        modes = [stat.S_IMODE((tmp_path / name).stat().st_mode) for name in ("usual", "new")]
        assert modes[0] == modes[1]

    def test_permissions_of_the_old_file_stay(self, tmp_path):
        (tmp_path / "a").write_bytes(b"")
        (tmp_path / "a").chmod(0o640)
        with whole_file(tmp_path / "a") as file:
            file.write(b"new")
        assert stat.S_IMODE((tmp_path / "a").stat().st_mode) == 0o640

    def test_a_link_stays_a_link(self, tmp_path):
        (tmp_path / "there").mkdir()
        (tmp_path / "link").symlink_to(tmp_path / "there" / "a")
        with whole_file(tmp_path / "link") as file:
            file.write(b"new")
        assert (tmp_path / "link").is_symlink()
        assert (tmp_path / "there" / "a").read_bytes() == b"new"

    def test_a_pipe_is_written_to(self):
        reading, writing = os.pipe()
        with whole_file(f"/dev/fd/{writing}") as file:
            file.write(b"through")
        os.close(writing)
        assert os.read(reading, 100) == b"through"
        os.close(reading)


def test_unfinished_files_of_a_killed_program_are_removed_and_those_being_written_stay(tmp_path):
    target = tmp_path / "a.txt"
    abandoned, other = tmp_path / ".a.txt.killed.part", tmp_path / ".b.txt.killed.part"
    for path in (abandoned, other):
        path.write_text("half")
        os.utime(path, (0, 0))
    with whole_file(target) as first:
        first.write(b"first")
        (written,) = (path for path in tmp_path.glob(".a.txt.*.part"))
        os.utime(written, (0, 0))
        assert not abandoned.exists()
        write_file(target, b"second")
        assert written.exists(), "it is still being written"
    assert target.read_bytes() == b"first"
    assert sorted(path.name for path in tmp_path.iterdir()) == [".b.txt.killed.part", "a.txt"]


@pytest.mark.parametrize("name", ["gone/a.txt", "."])
def test_what_cannot_be_written_is_known_before(tmp_path, name):
    with pytest.raises(FileWriteError) as before:
        check_writable(tmp_path / name)
    with pytest.raises(FileWriteError) as after:
        write_file(tmp_path / name, b"")
    assert str(before.value) == str(after.value)
