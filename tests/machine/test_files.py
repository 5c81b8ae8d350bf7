"""Disks by themselves: what they refuse, and why."""

import pytest

from rapidgen.machine import files
from rapidgen.machine.files import (
    MAX_OPEN,
    Directory,
    DiskFault,
    DiskReason,
    FileSystem,
    IODevice,
)


@pytest.fixture
def disks(tmp_path):
    system = FileSystem(tmp_path)
    yield system
    system.close()


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("nowhere:x", "no disk for 'nowhere:x'"),
        ("/etc/passwd", "no disk"),
        ("HOME:/../x", "'HOME:/../x' leads out of HOME:"),
        ("HOME:/a\0b", "no disk"),
        ("HOME:/" + "x" * 256, "leads out of the controller"),
    ],
)
def test_path_outside_disks_is_no_access(disks, path, message):
    with pytest.raises(DiskFault, match=message) as fault:
        disks.path(path)
    assert fault.value.reason is DiskReason.NO_ACCESS


def test_link_to_outside_is_no_access(disks, tmp_path_factory):
    (disks.folder / "HOME" / "out").symlink_to(tmp_path_factory.mktemp("elsewhere"))
    with pytest.raises(DiskFault, match="leads out of the controller"):
        disks.path("HOME:/out/x")


def test_names_are_found_without_case(disks):
    (disks.folder / "HOME" / "Read.Me").write_text("x")
    assert disks.path("home:/READ.ME").name == "Read.Me"
    assert disks.path("new.txt") == disks.folder / "HOME" / "new.txt"


def test_number_of_open_files_is_limited(disks):
    devices = [IODevice() for _ in range(MAX_OPEN + 1)]
    for device in devices[:-1]:
        disks.hold(device, "T_ROB1")
    with pytest.raises(DiskFault) as fault:
        disks.hold(devices[-1], "T_ROB1")
    assert fault.value.reason is DiskReason.TOO_MANY_OPEN
    disks.close_task("T_ROB1")
    disks.hold(devices[-1], "T_ROB2")


def test_every_file_of_a_task_is_closed_and_none_of_another(disks):
    devices = [IODevice() for _ in range(3)]
    folder = Directory()
    for device, task in zip(devices, ("T_ROB1", "T_ROB1", "T_ROB2"), strict=True):
        device.file = (disks.folder / task).open("wb")
        disks.hold(device, task)
    folder.names = ["a"]
    disks.hold(folder, "T_ROB1")
    disks.close_task("T_ROB1")
    assert [device.file is None for device in devices] == [True, True, False]
    assert folder.names is None
    disks.close_task("T_ROB1")
    for device in devices:
        disks.release(device)
    assert devices[2].file is None


def test_a_full_disk_takes_nothing(disks, monkeypatch):
    monkeypatch.setattr(files, "CAPACITY", 100)
    small = FileSystem(disks.folder)
    small.spend(100)
    with pytest.raises(DiskFault, match="the disk is full"):
        small.spend(1)
    assert small.free_space == 0
