"""Cache of checked shipped models, next to the code.

It follows Python's cache of compiled files. Checking a YAML file needs its schema, which takes
longer to create than a small program to run. The file in robots/ stays the only source: an entry is
valid for its exact bytes and for the code that read it. The cache is not written where Python
itself must not write (`PYTHONDONTWRITEBYTECODE`, a read-only installation).
"""

import json
import os
import sys
import zlib
from pathlib import Path

from rapidgen import __version__
from rapidgen.config.manifest import group_from_manifest, group_to_manifest
from rapidgen.config.model import GroupConfig
from rapidgen.config.registry import find_shipped

_FOLDER = Path(__file__).parent


def shipped_groups(name: str) -> tuple[GroupConfig, ...]:
    """Return the motion groups of a shipped model by name.

    DiagnosticError RG009: unknown name.
    """
    source = find_shipped(name)
    if source.stem != name:
        raise ValueError(f"{name} is no shipped model")
    saved = _FOLDER / "__pycache__" / f"{name}.{sys.implementation.cache_tag}.json"
    key = _key(source)
    try:
        result = json.loads(saved.read_text(encoding="utf-8"))
        if result["key"] == key:
            return tuple(group_from_manifest(group, source) for group in result["groups"])
    except (OSError, ValueError, KeyError, TypeError):
        pass  # Missing, outdated or damaged: it is created again.
    from rapidgen.config.load import load_config

    groups = load_config(name).groups
    if not sys.dont_write_bytecode:
        _keep(saved, {"key": key, "groups": [group_to_manifest(group) for group in groups]})
    return groups


def _key(source: Path) -> str:
    """Return a key of the file's bytes, and of the code's size and time.

    Python identifies its compiled code in the same way.
    """
    data = source.read_bytes()
    # No digest of hashlib: it loads OpenSSL, which a short run does not need.
    parts = [__version__, source.name, f"{len(data)} {zlib.crc32(data)}"]
    for entry in sorted(os.scandir(_FOLDER), key=lambda entry: entry.name):
        if entry.name.endswith(".py"):
            stat = entry.stat()
            parts.append(f"{entry.name} {stat.st_size} {stat.st_mtime_ns}")
    return "\n".join(parts)


def _keep(path: Path, result: object) -> None:
    """Write the file atomically."""
    half = path.with_name(f"{path.name}.{os.getpid()}")
    try:
        path.parent.mkdir(exist_ok=True)
        half.write_text(json.dumps(result), encoding="utf-8")
        half.replace(path)
    except OSError:
        half.unlink(missing_ok=True)
