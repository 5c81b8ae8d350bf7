"""State of a deployment on the controller, read as untrusted data.

`manifest.json` describes the deployed set (written last), `journal.a`/`journal.b` the active run
(the unused one is written, then the other deleted, so that one is always complete), `switching`
that old files are being replaced, and `backup/<number>/` the files before a deployment.
"""

import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field

from rapidgen._json import Json, Members, items, members, whole
from rapidgen.deploy.cfg import instance_from
from rapidgen.deploy.driver_set import FENCE, NEW, STATE, digest
from rapidgen.deploy.transports.transport import Transport, TransportFault, read_or_none, safe
from rapidgen.diagnostics import DiagnosticError, refusal

FORMAT = 1
KEPT = 5
"""Number of backups that stay on the controller."""

DAMAGE = (
    ValueError,
    KeyError,
    TypeError,
    AttributeError,
    OverflowError,
    RecursionError,
    TransportFault,
)
"""Exceptions of reading a damaged or hostile state file."""


class LaterFormat(ValueError):
    """A file that a later rapidgen wrote."""


_SHA = re.compile(r"[0-9a-f]{64}")


@dataclass(frozen=True, slots=True)
class FileRecord:
    """One file: path in HOME, hash, and name of its copy in a backup."""

    path: str
    sha256: str
    size: int = 0
    kind: str = "module"
    tasks: tuple[str, ...] = ()
    stored: str = ""


@dataclass(frozen=True, slots=True)
class StoredSet:
    """A set of a backup: `id` is the deployment that replaced it."""

    id: int
    time: str
    name: str
    build_id: str


@dataclass(frozen=True, slots=True)
class Manifest:
    """Result of the last deployment, or content of a backup.

    A backup has `stored` in its records.
    """

    id: int
    time: str
    name: str
    build_id: str
    robotware: tuple[int, int]
    files: tuple[FileRecord, ...]
    origin: tuple[FileRecord, ...] = ()
    """Foreign files that were overwritten, kept for `uninstall`."""
    history: tuple[StoredSet, ...] = ()
    cfg_before: Mapping[str, Json] = field(default_factory=dict)
    """cfg instances of SYSPAR before the first deployment.

    Attributes by key, or null.
    """
    generated: Mapping[str, Json] = field(default_factory=dict)

    def record(self, path: str) -> FileRecord | None:
        """Return the record of a path in HOME."""
        return next((r for r in self.files if r.path == path), None)


@dataclass(frozen=True, slots=True)
class Journal:
    """An active deployment: enough data to finish or undo it.

    It does not need the manifest.
    """

    id: int
    attempt: int
    verb: str
    started: str
    old: Manifest | None
    new: Manifest | None
    known: Mapping[str, tuple[str, ...]]
    """Hashes by path that this or an earlier attempt found or wrote."""
    staged: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class StateFolder:
    """Contents of the state folder."""

    manifest: Manifest | None = None
    journal: Journal | None = None
    journal_file: str = ""
    switching: bool = False
    damaged: str = ""
    """Reason why manifest.json is unusable, if it is."""
    later: bool = False
    """True if it is of a later format instead of damaged."""
    digest: str = ""
    present: bool = False
    litter: bool = False
    """Files of a run that was interrupted while it tested rename."""

    def carried(self, had: Manifest | None, *, repair: bool) -> str:
        """Name of the robot whose driver is there, also partially; '' for none.

        See `repair`.
        """
        half = self.journal.new if repair and self.journal is not None else None
        return next((m.name for m in (had, half) if m is not None), "")


def read_state(transport: Transport, home: str) -> StateFolder:
    """Read the state folder of the HOME with this prefix ('' or 'HOME/')."""
    folder = home + STATE
    try:
        names = {e.name for e in transport.entries(folder)}
    except TransportFault as fault:
        if fault.kind != "missing":
            raise
        return StateFolder(digest=digest(b""))
    raw = read_or_none(transport, f"{folder}/manifest.json") if "manifest.json" in names else None
    manifest, damaged, later = None, "", False
    if raw is not None:
        try:
            manifest = manifest_from(json.loads(raw))
        except LaterFormat:
            later, damaged = (
                True,
                "a later rapidgen wrote the manifest on the controller: use that one",
            )
        except DAMAGE as cause:
            damaged = f"manifest.json on the controller is damaged ({type(cause).__name__})"
    journals: list[tuple[int, str, Journal, bytes]] = []
    for name in sorted(names & {"journal.a", "journal.b"}):
        text = read_or_none(transport, f"{folder}/{name}") or b""
        try:
            journal = journal_from(json.loads(text))
        except DAMAGE:
            # Interrupted while it was written: then its announced work was not done.
            continue
        journals.append((journal.attempt, name, journal, text))
    switching = "switching" in names
    latest = max(journals, key=lambda j: j[0]) if journals else None
    litter = bool(names & {"probe.one", "probe.two"})
    seen = (raw or b"") + (latest[3] if latest else b"") + (b"switching" if switching else b"")
    if latest is None:
        return StateFolder(
            manifest, None, "", switching, damaged, later, digest(seen), True, litter
        )
    return StateFolder(
        manifest, latest[2], latest[1], switching, damaged, later, digest(seen), True, litter
    )


def manifest_json(manifest: Manifest) -> Members:
    """Return manifest.json as on the controller."""
    return {
        "format": FORMAT,
        **asdict(manifest),
        "files": [_record_json(r) for r in manifest.files],
        "origin": [_record_json(r) for r in manifest.origin],
    }


def manifest_from(read: Json) -> Manifest:
    """Parse a manifest. Raises one of DAMAGE for anything unexpected."""
    data = members(read)
    if whole(data["format"]) != FORMAT:
        raise LaterFormat
    first, second = items(data["robotware"])
    return Manifest(
        whole(data["id"]),
        _text(data["time"]),
        _text(data["name"]),
        _text(data["build_id"]),
        (whole(first), whole(second)),
        tuple(_record(r) for r in items(data["files"])),
        tuple(_record(r) for r in items(data["origin"])),
        tuple(
            StoredSet(whole(p["id"]), _text(p["time"]), _text(p["name"]), _text(p["build_id"]))
            for p in map(members, items(data["history"]))
        ),
        _instances(data["cfg_before"]),
        members(data["generated"]),
    )


def _instances(read: Json) -> Members:
    """Parse original instances, or null for missing ones."""
    result = members(read)
    for old in result.values():
        if old is not None:
            instance_from(old)
    return result


def journal_json(journal: Journal) -> Members:
    """Return the journal as on the controller."""
    return {
        "format": FORMAT,
        **asdict(journal),
        "old": manifest_json(journal.old) if journal.old else None,
        "new": manifest_json(journal.new) if journal.new else None,
    }


def journal_from(read: Json) -> Journal:
    """Parse a journal. Raises one of DAMAGE for anything unexpected."""
    data = members(read)
    if data["format"] != FORMAT:
        raise ValueError("a later format")
    return Journal(
        whole(data["id"]),
        whole(data["attempt"]),
        _text(data["verb"]),
        _text(data["started"]),
        manifest_from(data["old"]) if data["old"] is not None else None,
        manifest_from(data["new"]) if data["new"] is not None else None,
        {
            safe(path): tuple(_sha(h) for h in items(hashes))
            for path, hashes in members(data["known"]).items()
        },
        tuple(_staged(path) for path in items(data["staged"])),
    )


def encode(data: Members) -> bytes:
    """JSON as it is stored: stable, readable, ASCII."""
    return (json.dumps(data, indent=1, sort_keys=False) + "\n").encode("ascii")


def read_backup(transport: Transport, home: str, number: int) -> tuple[Manifest, dict[str, bytes]]:
    """Read a backup: manifest, and files by path, with checked hashes.

    Raises DiagnosticError RG528 if it is missing or incomplete.
    """
    folder = f"{home}{STATE}/backup/{number}"
    raw = read_or_none(transport, f"{folder}/backup.json")
    if raw is None:
        raise _no_backup(f"there is no backup {number} on the controller")
    try:
        manifest = manifest_from(json.loads(raw))
    except DAMAGE as fault:
        raise _no_backup(f"backup {number} is damaged: {fault!r}") from None
    files = {}
    for record in manifest.files:
        data = read_or_none(transport, f"{folder}/{safe(record.stored)}")
        if data is None or digest(data) != record.sha256:
            raise _no_backup(f"backup {number} is damaged: {record.path}")
        files[record.path] = data
    return manifest, files


def read_kept(transport: Transport, home: str, record: FileRecord) -> bytes | None:
    """Return the copy of a foreign file, also a damaged one; None if missing."""
    return read_or_none(transport, f"{home}{STATE}/backup/{record.stored}")


def next_copy(retained: Iterable[FileRecord]) -> int:
    """Return the number of the next copy of a foreign file.

    It is above those that are kept.
    """
    stems = [r.stored.rpartition("/")[2].partition(".")[0] for r in retained]
    return 1 + max((int(stem) for stem in stems if stem.isdecimal()), default=-1)


def _no_backup(message: str) -> DiagnosticError:
    return refusal(
        "RG528", None, message, "`rapidgen rollback --list` shows which there are", exit_code=1
    )


def _record_json(record: FileRecord) -> Members:
    data: Members = {
        "path": record.path,
        "sha256": record.sha256,
        "size": record.size,
        "kind": record.kind,
        "task": list(record.tasks),
    }
    if record.stored:
        data["stored"] = record.stored
    return data


def _record(read: Json) -> FileRecord:
    data = members(read)
    return FileRecord(
        safe(_text(data["path"])),
        _sha(data["sha256"]),
        whole(data["size"]),
        _text(data["kind"]),
        tuple(_text(t) for t in items(data["task"])),
        safe(_text(data["stored"])) if "stored" in data else "",
    )


def _staged(value: object) -> str:
    """Check a staged name: only such names of a journal are ever deleted."""
    path = safe(_text(value))
    if not path.endswith((NEW, FENCE)):
        raise ValueError("not a staged file")
    return path


def _sha(value: object) -> str:
    if not isinstance(value, str) or not _SHA.fullmatch(value):
        raise ValueError("not a sha256")
    return value


def _text(value: object) -> str:
    if not isinstance(value, str) or len(value) > 500:
        raise ValueError("not a short text")
    return value
