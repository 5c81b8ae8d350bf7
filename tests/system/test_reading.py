"""The one function that reads files of others."""

import os
import socket

import pytest

from rapidgen import _reading
from rapidgen._reading import NotRegular, OutsideFolder, TooLarge, open_foreign, read_foreign

LIMIT = 1000


@pytest.fixture
def folder(tmp_path):
    inner = tmp_path / "inner"
    inner.mkdir()
    (inner / "file").write_bytes(b"content")
    (tmp_path / "secret").write_bytes(b"secret")
    return inner


def test_a_file_is_read(folder):
    assert read_foreign(folder / "file", LIMIT) == b"content"
    assert read_foreign(str(folder / "file"), 7) == b"content"
    with open_foreign(folder / "file") as file:
        assert file.read(3) == b"con"


def test_a_file_is_read_below_its_folder(folder):
    (folder / "deep" / "er").mkdir(parents=True)
    (folder / "deep" / "er" / "link").symlink_to("../../file")
    for name in ("file", "deep/../file", "deep/er/link"):
        assert read_foreign(folder / name, LIMIT, below=folder) == b"content"


def test_special_files_are_not_opened(folder, monkeypatch):
    os.mkfifo(folder / "pipe")
    (folder / "zero").symlink_to("/dev/zero")
    (folder / "terminal").symlink_to("/dev/tty")
    listener = socket.socket(socket.AF_UNIX)
    monkeypatch.chdir(folder)  # the path of a socket is short
    listener.bind("socket")
    with listener:
        for name in ("pipe", "zero", "terminal", "socket", "."):
            with pytest.raises(NotRegular):
                read_foreign(folder / name, LIMIT)
            with pytest.raises((NotRegular, OutsideFolder)):
                read_foreign(folder / name, LIMIT, below=folder)


def test_a_pipe_that_is_put_there_meanwhile_is_not_waited_for(folder, monkeypatch):
    """As if it were a regular file when it was looked at."""
    os.mkfifo(folder / "pipe")
    regular = os.stat(folder / "file")
    monkeypatch.setattr(_reading.os, "stat", lambda *_, **__: regular)
    for below in (None, folder):
        with pytest.raises(NotRegular):
            read_foreign(folder / "pipe", LIMIT, below=below)


def test_a_link_that_is_put_there_meanwhile_is_not_followed(folder, tmp_path, monkeypatch):
    """As if it were none when its path was resolved."""
    (folder / "link").symlink_to(tmp_path / "secret")
    (folder / "way").symlink_to(tmp_path)
    regular = os.stat(folder / "file")
    monkeypatch.setattr(_reading.os.path, "realpath", lambda path: str(path))
    monkeypatch.setattr(_reading.os, "stat", lambda *_, **__: regular)
    for name in ("link", "way/secret"):
        with pytest.raises(OSError, match=r"no regular file|symbolic link|[Nn]ot a directory"):
            read_foreign(folder / name, LIMIT, below=folder)


def test_more_than_the_limit_is_not_read(folder):
    (folder / "large").write_bytes(bytes(LIMIT + 1))
    with (folder / "sparse").open("wb") as file:
        file.truncate(1 << 36)
    for name in ("large", "sparse"):
        with pytest.raises(TooLarge, match="larger than 1,000 bytes"):
            read_foreign(folder / name, LIMIT)
    assert len(read_foreign(folder / "large", LIMIT + 1)) == LIMIT + 1


def test_files_without_a_size_have_a_limit(folder):
    """What /proc has says 0 bytes."""
    with pytest.raises(TooLarge):
        read_foreign("/proc/self/maps", 10)


@pytest.mark.parametrize("name", ["link", "way/secret", "../secret", "missing/../../secret"])
def test_nothing_outside_is_read(folder, tmp_path, name):
    (folder / "link").symlink_to(tmp_path / "secret")
    (folder / "way").symlink_to(tmp_path)
    with pytest.raises(OutsideFolder):
        read_foreign(folder / name, LIMIT, below=folder)


def test_a_folder_whose_name_goes_on_is_another(folder, tmp_path):
    (tmp_path / "inner2").mkdir()
    (tmp_path / "inner2" / "file").write_bytes(b"other")
    with pytest.raises(OutsideFolder):
        read_foreign(tmp_path / "inner2" / "file", LIMIT, below=folder)


def test_names_that_no_file_has(folder):
    (folder / "loop").symlink_to("loop")
    for name in ("missing", "file/x", "a\0b", "loop", "x" * 5000):
        for below in (None, folder):
            with pytest.raises(OSError, match=r"\[Errno \d+\] \S"):
                read_foreign(folder / name, LIMIT, below=below)
