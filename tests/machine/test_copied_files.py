"""Copies of foreign folders: regular files up to a limit."""

import os
from pathlib import Path

import pytest

from rapidgen._reading import OutsideFolder, TooLarge
from rapidgen.machine import files
from rapidgen.machine.files import copy_files


@pytest.fixture
def source(tmp_path):
    """5 bytes in two files, an empty folder, and what is no regular file."""
    folder = tmp_path / "source"
    for name in ("a/b", "empty"):
        (folder / name).mkdir(parents=True)
    (folder / "one").write_bytes(b"12")
    (folder / "a/b/two").write_bytes(b"345")
    (folder / "one").chmod(0o640)
    os.utime(folder / "one", (1_000_000, 2_000_000))
    outside = tmp_path / "outside"
    outside.mkdir()
    (outside / "file").write_bytes(b"secret")
    (folder / "link").symlink_to(outside / "file")
    (folder / "a/folder").symlink_to(outside)
    os.mkfifo(folder / "pipe")
    return folder


def paths(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


def test_folders_and_regular_files_are_copied_with_their_times(source, tmp_path):
    target = tmp_path / "not" / "there"
    for _ in range(2):  # also over what is there
        copy_files(source, target)
        assert paths(target) == ["a", "a/b", "a/b/two", "empty", "one"]
    assert (target / "one").read_bytes() == b"12"
    assert (target / "a/b/two").read_bytes() == b"345"
    copied = (target / "one").stat()
    assert (copied.st_mode & 0o777, copied.st_mtime) == (0o640, 2_000_000)


def test_a_folder_may_be_copied_into_itself_without_the_copy(source):
    copy_files(source, source / "copy", without=source / "copy")
    assert paths(source / "copy") == ["a", "a/b", "a/b/two", "empty", "one"]


@pytest.mark.parametrize(("largest", "fits"), [(5, True), (4, False)])
def test_all_files_together_are_limited(source, tmp_path, monkeypatch, largest, fits):
    monkeypatch.setattr(files, "LARGEST_COPY", largest)
    if fits:
        copy_files(source, tmp_path / "target")
    else:
        with pytest.raises(TooLarge, match="more than 4 bytes"):
            copy_files(source, tmp_path / "target")


def test_link_replacing_a_file_is_not_followed(source, tmp_path, monkeypatch):
    monkeypatch.setattr(Path, "is_symlink", lambda self: False)
    with pytest.raises(OutsideFolder):
        copy_files(source, tmp_path / "target")
    assert not (tmp_path / "target" / "link").exists()


def test_missing_folder_is_an_error(tmp_path):
    with pytest.raises(FileNotFoundError):
        copy_files(tmp_path / "nowhere", tmp_path / "target")
