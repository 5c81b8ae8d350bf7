"""SYSPAR next to HOME: the cfg of a backup or a virtual controller."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from rapidgen._json import Json
from rapidgen.deploy.cfg import keyed, merged, without_used
from rapidgen.deploy.transports.transport import Transport
from rapidgen.diagnostics import refusal
from rapidgen.system import CfgText, cfg_bytes, parse_cfg
from rapidgen.system.paths import read_limited


@dataclass(frozen=True, slots=True)
class SysparFile:
    """One cfg file of the folder."""

    text: CfgText
    data: bytes


@dataclass(frozen=True, slots=True)
class SysparChange:
    """A file with our instances merged in (`before` is None for a new one)."""

    path: str
    before: bytes | None
    after: bytes | None
    foreign: bool
    """True if no deployment has changed the file before."""


def read_syspar(transport: Transport, folder: str) -> tuple[SysparFile, ...]:
    """Read all cfg files of the folder ('SYSPAR/'; '' means there is none).

    Raises DiagnosticError RG701, RG702 for an unreadable one.
    """
    result = []
    for entry in transport.entries(folder.rstrip("/")) if folder else ():
        if entry.name.casefold().endswith(".cfg") and entry.folder is not True:
            data = transport.read(folder + entry.name)
            result.append(SysparFile(parse_cfg(data, path=folder + entry.name), data))
    return tuple(result)


def loaded_cfg(backup: Path) -> tuple[CfgText, ...]:
    """Return the loaded cfg of a backup: the cfg files of its SYSPAR.

    Raises DiagnosticError RG536 if there is none; RG701, RG702, RG704, RG705, RG706 for an
    unreadable one.
    """
    folder = next((f for f in _folders(backup) if f.name.casefold() == "syspar"), None)
    files = sorted(folder.iterdir()) if folder else []
    texts = tuple(
        parse_cfg(read_limited(f, below=backup), path=str(f))
        for f in files
        if f.name.casefold().endswith(".cfg")
    )
    if not texts:
        raise refusal(
            "RG536",
            None,
            f"--backup {backup}: no SYSPAR folder with cfg files is there",
            "name the folder that holds BACKINFO, HOME, RAPID and SYSPAR",
        )
    return texts


def _folders(place: Path) -> list[Path]:
    return [f for f in place.iterdir() if f.is_dir()] if place.is_dir() else []


def syspar_changes(
    folder: str,
    files: tuple[SysparFile, ...],
    desired: tuple[CfgText, ...],
    own_files: frozenset[str],
    before: Mapping[str, Json],
    originals: Mapping[str, bytes | None],
) -> list[SysparChange]:
    """Return the changed SYSPAR files. Foreign signals stay.

    `before` has the instances from before the first deployment, `originals` the files from then by
    SYSPAR path (None: the copy is lost): such a file is restored byte for byte if no other change
    was made since, and one that did not exist is deleted.
    """
    present = {f.text.domain: f for f in files}
    instances = without_used(keyed(desired), keyed(f.text for f in files), own_files, before)
    changes = []
    domains = [*(t.domain for t in desired), *(n.split(" ")[0].upper() for n in sorted(own_files))]
    for domain in dict.fromkeys(domains):
        file = present.get(domain)
        if file is not None:
            text = file.text
        else:
            versions = [t.version for t in desired if t.domain == domain]
            if not versions:
                continue
            text = CfgText(domain, versions[0], (), f"{folder}{domain}.cfg")
        new = merged(text, instances, own_files, before)
        if _plain(new) == _plain(text):
            continue
        after: bytes | None = cfg_bytes(new)
        if file is not None and b"\r\n" in file.data:
            after = (after or b"").replace(b"\n", b"\r\n")
        if text.path not in originals and not _plain(new):
            after = None
        original = originals.get(text.path)
        if original is not None and _plain(parse_cfg(original)) == _plain(new):
            after = original
        touched = any(name.startswith(f"{domain.casefold()} ") for name in before)
        data = file.data if file else None
        changes.append(SysparChange(text.path, data, after, data is not None and not touched))
    return changes


def _plain(text: CfgText) -> list[object]:
    return [(s.name, [i.attributes for i in s.instances]) for s in text.sections if s.instances]
