"""Recovery of a damaged manifest from backups and files."""

import json
from dataclasses import replace

from rapidgen.deploy.driver_set import STATE, DriverSet, digest
from rapidgen.deploy.state_folder import DAMAGE, FileRecord, Manifest, StoredSet, manifest_from
from rapidgen.deploy.transports.transport import Transport, TransportFault, read_or_none


def recovered_manifest(transport: Transport, home: str, desired: DriverSet) -> Manifest:
    """Return a manifest for the current files.

    It is that of the newest complete backup, with the files as they are now. Files at the paths of
    the wanted set count as ours: the next backup keeps all of them. Without a backup the state
    before the first deployment is unknown. Raises TransportFault.
    """
    backups = _backups(transport, home)
    numbers = sorted(backups)
    known = backups[numbers[-1]] if numbers else None
    kinds = {r.path: r for r in known.files} if known else {}
    kinds |= {f.path: FileRecord(f.path, "", 0, f.kind, f.tasks) for f in desired.files}
    records = []
    for path, record in kinds.items():
        data = read_or_none(transport, home + path)
        if data is not None:
            records.append(replace(record, sha256=digest(data), size=len(data), stored=""))
    history = tuple(
        StoredSet(n, backups[n].time, backups[n].name, backups[n].build_id) for n in numbers
    )
    if known is not None:
        return replace(known, id=numbers[-1], files=tuple(records), history=history)
    name, ware = desired.name, desired.robotware
    return Manifest(0, "", name, "unknown", ware, tuple(records))


def copies(transport: Transport, home: str) -> int:
    """Return the first free number for copies of foreign files.

    Raises TransportFault.
    """
    result = [int(n.partition(".")[0]) for n in _names(transport, f"{home}{STATE}/backup/origin")]
    return max(result, default=-1) + 1


def _backups(transport: Transport, home: str) -> dict[int, Manifest]:
    result = {}
    for name in _names(transport, f"{home}{STATE}/backup"):
        raw = read_or_none(transport, f"{home}{STATE}/backup/{name}/backup.json")
        try:
            result[int(name)] = manifest_from(json.loads(raw or b""))
        except DAMAGE:
            continue
    return result


def _names(transport: Transport, folder: str) -> list[str]:
    """Return names that begin with a number; none without a folder."""
    try:
        return [e.name for e in transport.entries(folder) if e.name.partition(".")[0].isdecimal()]
    except TransportFault as fault:
        if fault.kind != "missing":
            raise
        return []
