"""Result of commissioning as data: steps with verdicts and figures, to and from JSON."""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any, Literal, get_args

from rapidgen._json import Json, Members, items, members, number
from rapidgen._json import text as as_text
from rapidgen._reading import read_foreign
from rapidgen.diagnostics import refusal

Verdict = Literal["ok", "assumed", "skipped", "fail"]
"""`assumed`: only a prepared answer says so, no person and no measurement."""
End = Literal["running", "complete", "failed", "interrupted"]
_FORMAT = "rapidgen commission 1"
_LARGEST = 4_000_000
"""Largest size of a checklist that is read, bytes."""


@dataclass(frozen=True, slots=True)
class Step:
    """One step of the procedure.

    `figures` have their unit at the end of the name: `stop_time_s`, `stop_angle_deg`.
    """

    name: str
    title: str
    verdict: Verdict
    found: str
    help: str = ""
    code: str = ""
    figures: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Checklist:
    """All steps of one run, with what was commissioned, when and by which version."""

    robot: str
    model: str
    group: str
    target: str
    date: str
    """ISO 8601, with the time zone."""
    version: str
    """Of rapidgen."""
    simulated: bool = False
    driver: str = ""
    build_id: str = ""
    robotware: str = ""
    end: End = "running"
    steps: tuple[Step, ...] = ()
    drawings: Mapping[str, str] = field(default_factory=dict)
    """SVG of the announced moves by joint; not part of the JSON."""

    @property
    def failures(self) -> tuple[Step, ...]:
        """The failed steps."""
        return tuple(step for step in self.steps if step.verdict == "fail")

    def with_step(self, step: Step) -> "Checklist":
        """Return a copy with one more step."""
        return replace(self, steps=(*self.steps, step))

    def to_json(self) -> str:
        """Return the JSON text."""
        data = {"format": _FORMAT, **asdict(self)}
        del data["drawings"]
        return json.dumps(data, indent=2, ensure_ascii=False) + "\n"


def read_checklist(path: Path) -> Checklist:
    """Read the JSON of a checklist. Raises DiagnosticError RG689."""
    try:
        data = members(json.loads(read_foreign(path, _LARGEST)))
        if data.get("format") != _FORMAT:
            raise _not_read(path, f"its format is not '{_FORMAT}'")
        keys = ("robot", "model", "group", "target", "date", "version", "driver", "build_id")
        texts: dict[str, Any] = {key: as_text(data[key]) for key in (*keys, "robotware")}
        steps = tuple(_step(members(entry)) for entry in items(data["steps"]))
        end = _one_of(End, data["end"])
    except (OSError, ValueError, TypeError, KeyError, RecursionError) as fault:
        raise _not_read(path, str(fault)) from fault
    return Checklist(**texts, simulated=data.get("simulated") is True, end=end, steps=steps)


def _step(entry: Members) -> Step:
    texts = {key: as_text(entry[key]) for key in ("name", "title", "found", "help", "code")}
    figures = {key: number(value) for key, value in members(entry["figures"]).items()}
    return Step(**texts, verdict=_one_of(Verdict, entry["verdict"]), figures=figures)


def _one_of(kind: Any, value: Json) -> Any:  # noqa: ANN401
    """Return a text that is one of a Literal's. Raises ValueError."""
    if value not in get_args(kind):
        raise ValueError(f"{value!r} is none of {', '.join(get_args(kind))}")
    return value


def _not_read(path: Path, reason: str) -> Exception:
    return refusal(
        "RG689",
        None,
        f"{path} is not a checklist of `rapidgen commission`: {reason}",
        "give the file checklist.json that `rapidgen commission --output FOLDER` wrote",
    )
