"""The controller's disks as programs see them: iodev, dir, and what a disk's faults are called."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rapidgen.machine.files import Directory, DiskFault, DiskReason, IODevice
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.values import register_type

_ERRORS = {
    DiskReason.NO_ACCESS: "ERR_FILEACC",
    DiskReason.TOO_MANY_OPEN: "ERR_FILEOPEN",
}

register_type("iodev", IODevice)
register_type("dir", Directory)


@contextmanager
def _in_rapid() -> Iterator[None]:
    try:
        yield
    except DiskFault as fault:
        raise RapidError(_ERRORS[fault.reason], str(fault)) from fault


def file_path(task: RapidTask, path: str, file: str = "") -> Path:
    """Where a path (with \\File behind it) lies. ERR_FILEACC: on no disk, or outside of it."""
    with _in_rapid():
        return task.controller.files.path(path, file)


def hold(task: RapidTask, device: IODevice | Directory) -> None:
    """A file or folder is open for the task; ERR_FILEOPEN when too many are."""
    with _in_rapid():
        task.controller.files.hold(device, task.name)


def spend(task: RapidTask, count: int) -> None:
    """Account for bytes that are written; ERR_FILEACC when the disk is full."""
    with _in_rapid():
        task.controller.files.spend(count)
