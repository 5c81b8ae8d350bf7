"""Volumes of the file service as the controller's disks.

No path leads out of them.
"""

from pathlib import Path
from typing import TYPE_CHECKING

from rapidgen.machine.files import DiskFault
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext

VOLUMES = ("HOME", "TEMP", "BACKUP", "RAMDISK")


def disk_path(context: "RwsContext", words: str, request: RwsRequest) -> Path:
    """Return the file of a path on a volume.

    The path is `$HOME/a`, `HOME/a`, `HOME:/a` or `/fileservice/...`. RequestDenied: it names no
    volume, or leads out of one.
    """
    text = words.removeprefix("/fileservice/").strip("/")
    first, _, remaining = text.partition("/")
    name = first.strip("$:").upper()
    if ":" in first.rstrip(":"):
        name, _, more = first.partition(":")
        name, remaining = name.strip("$").upper(), f"{more}/{remaining}".strip("/")
    if name not in VOLUMES:
        # RobotWare 6 and 7 differ here [VC 6.16, VC 7.21].
        if request.is_one:
            raise RequestDenied(404, "E_FAIL", f"no volume {first}")
        raise RequestDenied(400, "E_INVALID_PATH", f"no volume {first}")
    try:
        return context.controller.files.path(f"{name}:{remaining}")
    except DiskFault as fault:
        raise RequestDenied(400, "E_INVALID_PATH", str(fault)) from fault
