"""An anonymised bundle of results: what is in it is listed here, everything else is left out.

Nothing is removed from a text, because a text can hold anything: each file of the bundle is made
anew from numbers, known words and hashes. Free texts (messages, titles of events, program lines)
never enter it. A last check searches the result for this computer's names.
"""

import getpass
import io
import json
import os
import platform
import re
import secrets
import socket
import sys
import zipfile
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from datetime import datetime
from hashlib import sha256
from pathlib import Path
from typing import get_args

import numpy as np

from rapidgen import __version__
from rapidgen._json import members, number
from rapidgen._reading import read_foreign
from rapidgen.commission.checklist import Checklist, End, Step, Verdict, read_checklist
from rapidgen.diagnostics import refusal
from rapidgen.machine.event_table import KINDS
from rapidgen.machine.saved_log import SavedLog, read_saved_log

Hash = Callable[[str], str]
_MODEL = re.compile(r"IRB ?\d{2,5}[A-Z]{0,3}(-[\d./]{1,9})?", re.ASCII)
_RELEASE = re.compile(r"\d{1,2}(\.\d{1,5}){1,3}", re.ASCII)
_CODE = re.compile(r"RG\d{3}", re.ASCII)
_FIGURES = frozenset({
    "largest_difference_deg", "largest_difference_mm", "moved_deg", "moved_mm", "planned_s",
    "took_s", "speed_deg_s", "speed_mm_s", "stop_time_s", "stop_way_deg", "stop_way_mm",
    "predicted_braking_s", "predicted_braking_deg", "predicted_braking_mm", "limit_s", "limit_deg",
    "limit_mm", "resolution_s",
})  # fmt: skip
"""Names of figures that may leave this computer; others could hold a joint's name."""
_STEPS = (
    "preconditions", "identity", "values", "marks", "direction", "model", "stop", "cable",
    "emergency", "reset", "restored",
)  # fmt: skip
_LARGEST = 1_000_000
"""Largest size of a result that is read, bytes."""
_SHORTEST = 3
"""Shortest name that the last check searches for: shorter ones are parts of other words."""


def bundle(
    checklists: Sequence[Path], logs: Sequence[Path], results: Sequence[Path]
) -> dict[str, str]:
    """Return the files of a bundle: name to JSON text.

    Raises DiagnosticError RG689 for a file that cannot be read, or if the bundle would hold a name
    of this computer, and as `read_saved_log`.
    """
    salt = secrets.token_bytes(16)

    def hashed(text: str) -> str:
        # Salted for each bundle: equal names stay equal in it, and a list of names finds none.
        return sha256(salt + text.encode("utf-8")).hexdigest()[:12]

    files = {"versions.json": _versions()}
    names: list[str] = []
    for count, path in enumerate(checklists, 1):
        checklist = read_checklist(path)
        names += [checklist.robot, checklist.target, *_hosts(checklist.target)]
        files[f"commission-{count}.json"] = _commission(checklist, hashed)
    for count, path in enumerate(logs, 1):
        files[f"events-{count}.json"] = _events(read_saved_log(path))
    for count, path in enumerate(results, 1):
        files[f"durations-{count}.json"] = _durations(path)
    texts = {name: json.dumps(data, indent=1) + "\n" for name, data in files.items()}
    _require_clean(texts, [*_own_names(), *names])
    return texts


def zipped(files: Mapping[str, str]) -> bytes:
    """Return a zip file; its members have no times and no user."""
    result = io.BytesIO()
    with zipfile.ZipFile(result, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in files.items():
            archive.writestr(zipfile.ZipInfo(name), text)
    return result.getvalue()


def _versions() -> dict[str, object]:
    return {
        "format": "rapidgen report 1",
        "rapidgen": __version__,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "system": platform.system(),
        "machine": platform.machine(),
        "byteorder": sys.byteorder,
    }


# -- results of commissioning -------------------------------------------------------------------


def _commission(checklist: Checklist, hashed: Hash) -> dict[str, object]:
    return {
        "robot": hashed(checklist.robot),
        "group": hashed(checklist.group),
        "model": _known(_MODEL, checklist.model, hashed),
        "month": checklist.date[:7] if re.match(r"\d{4}-\d{2}", checklist.date) else "",
        "rapidgen": _known(_RELEASE, checklist.version, hashed),
        "driver": _known(_RELEASE, checklist.driver, hashed),
        "build": hashed(checklist.build_id),
        "robotware": _known(_RELEASE, checklist.robotware, hashed),
        "simulated": checklist.simulated,
        "end": checklist.end,
        "steps": list(_steps(checklist.steps)),
    }


def _known(pattern: re.Pattern[str], text: str, hashed: Hash) -> str:
    """Return a text of a known form, else its hash."""
    return text if not text or pattern.fullmatch(text) else hashed(text)


def _steps(steps: Sequence[Step]) -> Iterator[dict[str, object]]:
    joints: dict[str, int] = {}
    for step in steps:
        kind, _, joint = step.name.partition(".")
        result: dict[str, object] = {
            "step": kind if kind in _STEPS else "other",
            "verdict": step.verdict,
            "code": step.code if _CODE.fullmatch(step.code) else "",
            "figures": {k: v for k, v in step.figures.items() if k in _FIGURES},
        }
        if joint:
            result["joint"] = joints.setdefault(joint, len(joints) + 1)
        yield result


# -- events and durations -----------------------------------------------------------------------


def _events(log: SavedLog) -> dict[str, object]:
    """Return numbers, types and distances in time of known events; no texts."""
    own = [event for event in log.events if event.code in KINDS]
    times = [_seconds(event.date) for event in own]
    first = next((time for time in times if time is not None), None)
    rows = [
        [None if time is None or first is None else round(time - first, 3), event.type, event.code]
        for time, event in zip(times, own, strict=True)
    ]
    counts = Counter(str(event.code) for event in own)
    return {
        "robotware": log.robotware if _RELEASE.fullmatch(log.robotware) else "",
        "events": rows,
        "counts": dict(counts.most_common()),
        "other_events": len(log.events) - len(own),
    }


def _seconds(date: str) -> float | None:
    try:
        return datetime.fromisoformat(date.strip()).timestamp()
    except ValueError:
        return None


def _durations(path: Path) -> dict[str, object]:
    """Return predicted and real duration of a motion, from the output of `move --json`."""
    try:
        data = members(json.loads(read_foreign(path, _LARGEST)))
        keys = ("points", "planned_seconds", "seconds", "deviation", "starved")
        return {key: number(data[key]) for key in keys}
    except (OSError, ValueError, TypeError, KeyError, RecursionError) as fault:
        raise refusal(
            "RG689",
            None,
            f"{path} is not the output of `rapidgen move --json`: {fault}",
            "give a file with that output and nothing else",
        ) from fault


# -- the last check -----------------------------------------------------------------------------


def _own_names() -> Iterator[str]:
    """Yield names of this computer and of its user."""
    yield socket.gethostname()
    yield str(Path.home())
    yield os.getcwd()
    try:
        yield getpass.getuser()
    except (KeyError, OSError):
        # No name is known for this user's number.
        return


def _hosts(target: str) -> Sequence[str]:
    return [target.rpartition(":")[0]]


def _require_clean(texts: Mapping[str, str], names: Sequence[str]) -> None:
    """Raise DiagnosticError RG689 if a name is in the bundle as a whole word."""
    known = {*_STEPS, *get_args(Verdict), *get_args(End), platform.system(), platform.machine()}
    for name in names:
        if len(name) < _SHORTEST:
            continue
        word = re.compile(rf"(?<![\w.]){re.escape(name)}(?![\w.])", re.IGNORECASE)
        for file, text in texts.items():
            values = " ".join(v for v in _values(json.loads(text)) if v not in known)
            if word.search(values):
                raise refusal(
                    "RG689",
                    None,
                    f"{file} would contain '{name}', a name of this computer or robot",
                    "nothing was written; report this with the file's name",
                    exit_code=1,
                )


def _values(data: object) -> Iterator[str]:
    """Yield all texts of JSON data that are values, not keys."""
    if isinstance(data, str):
        yield data
    elif isinstance(data, dict):
        for value in data.values():
            yield from _values(value)
    elif isinstance(data, list):
        for value in data:
            yield from _values(value)
