"""Disks of a controller: source of HOME, paths, remains."""

import os

import pytest

from rapidgen.diagnostics import DiagnosticError
from rapidgen.machine import files
from rapidgen.machine.files import (
    DiskFault,
    DiskReason,
    FileSystem,
    IODevice,
    remove_scratch_folders,
)


def test_home_is_the_users_over_the_systems(tmp_path):
    for name in ("user", "system"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "both").write_text(name)
        (tmp_path / name / name).write_text(name)
    disks = FileSystem(home=tmp_path / "user", home_below=tmp_path / "system")
    home = disks.path("HOME:")
    assert {path.name: path.read_text() for path in home.iterdir()} == {
        "both": "user", "user": "user", "system": "system",
    }  # fmt: skip
    disks.close()
    assert not home.exists()


def test_oversized_home_is_rejected(tmp_path, monkeypatch):
    monkeypatch.setattr(files, "LARGEST_COPY", 3)
    home = tmp_path / "home"
    home.mkdir()
    (home / "file").write_bytes(b"1234")
    with pytest.raises(DiagnosticError) as error:
        FileSystem(tmp_path / "disks", home=home)
    assert [result.code for result in error.value.diagnostics] == ["RG705"]
    assert str(home) in error.value.diagnostics[0].message


def test_scratch_folder_is_created_on_demand_and_removed(tmp_path, monkeypatch):
    monkeypatch.setattr(files.tempfile, "tempdir", str(tmp_path))
    disks = FileSystem()
    assert os.listdir(tmp_path) == []
    folder = disks.folder
    assert os.listdir(tmp_path) == [folder.name]
    assert disks.folder == folder
    disks.close()
    assert os.listdir(tmp_path) == []
    left = FileSystem()
    assert left.folder.is_dir()
    remove_scratch_folders()
    assert os.listdir(tmp_path) == []


def test_fork_keeps_inherited_scratch_folder(tmp_path, monkeypatch):
    monkeypatch.setattr(files.tempfile, "tempdir", str(tmp_path))
    disks = FileSystem()
    assert disks.folder.is_dir()
    with monkeypatch.context() as forked:
        forked.setattr(files.os, "getpid", lambda: 0)
        remove_scratch_folders()
    assert disks.folder.is_dir()
    disks.close()


def test_a_folder_of_the_user_stays(tmp_path):
    disks = FileSystem(tmp_path)
    device = IODevice()
    device.file = (tmp_path / "HOME" / "a").open("wb")
    disks.hold(device, "T_ROB1")
    disks.close()
    assert device.file is None
    assert (tmp_path / "HOME" / "a").is_file()


@pytest.mark.parametrize(
    ("path", "file", "result"),
    [
        ("a.txt", "", "HOME/a.txt"),
        ("HOME:", "a.txt", "HOME/a.txt"),
        ("HOME:/sub/", "a.txt", "HOME/sub/a.txt"),
        ("HOME:/sub", "a.txt", "HOME/sub/a.txt"),
        ("HOME:\\sub\\", "a.txt", "HOME/sub/a.txt"),
        ("HOME:/./sub//.././a.txt", "", "HOME/a.txt"),
        ("HOME:/SUB/A.TXT", "", "HOME/sub/a.txt"),
        ("HOME:/sub/..", "", "HOME"),
        ("home:sub/b:c", "", "HOME/sub/b:c"),
        ("sub/b:c", "", "HOME/sub/b:c"),
        ("HOME:/sub/../..", "", None),
        ("HOME:/" + "x" * 255, "", "HOME/" + "x" * 255),
        ("HOME:/" + "x" * 256, "", None),
        ("HOME:/loop/a", "", None),
        ("HOME:/loop", "", None),
        ("b:c", "", None),
    ],
)
def test_where_a_path_lies(tmp_path, path, file, result):
    disks = FileSystem(tmp_path)
    home = tmp_path / "HOME"
    (home / "sub").mkdir()
    (home / "sub" / "a.txt").touch()
    (home / "loop").symlink_to(home / "loop")
    if result is None:
        with pytest.raises(DiskFault) as fault:
            disks.path(path, file)
        assert fault.value.reason is DiskReason.NO_ACCESS
    else:
        assert disks.path(path, file) == tmp_path / result
