"""Volumes of the file service as the controller's disks. There is no way out of them."""

from pathlib import Path
from typing import TYPE_CHECKING

from rapidgen.faces.rws.asking import Asked, Refused
from rapidgen.machine.files import DiskFault

if TYPE_CHECKING:
    from rapidgen.faces.rws.desk import Desk

VOLUMES = ("HOME", "TEMP", "BACKUP", "RAMDISK")


def disk_path(desk: "Desk", words: str, asked: Asked) -> Path:
    """Where `$HOME/a`, `HOME/a`, `HOME:/a` or `/fileservice/...` of these lies.

    Refused: it names no volume, or leads out of one.
    """
    text = words.removeprefix("/fileservice/").strip("/")
    first, _, rest = text.partition("/")
    name = first.strip("$:").upper()
    if ":" in first.rstrip(":"):
        name, _, more = first.partition(":")
        name, rest = name.strip("$").upper(), f"{more}/{rest}".strip("/")
    if name not in VOLUMES:
        # RobotWare 6 and 7 differ here [VC 6.16, VC 7.21].
        if asked.is_one:
            raise Refused(404, "E_FAIL", f"no volume {first}")
        raise Refused(400, "E_INVALID_PATH", f"no volume {first}")
    try:
        return desk.controller.files.path(f"{name}:{rest}")
    except DiskFault as fault:
        raise Refused(400, "E_INVALID_PATH", str(fault)) from fault
