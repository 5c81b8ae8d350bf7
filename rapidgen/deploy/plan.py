"""Plan of a deployment: files, cfg instances, restarts, manual steps.

planner.py makes one, apply.py executes it.
"""

import difflib
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from rapidgen._json import Json, Members
from rapidgen.deploy.cfg import CfgChange
from rapidgen.deploy.driver_set import DriverSet, digest
from rapidgen.deploy.manual_steps import ManualStep
from rapidgen.deploy.online.plan import OnlinePlan
from rapidgen.deploy.other_driver import OtherDriver
from rapidgen.deploy.state_folder import FileRecord, Manifest, StateFolder
from rapidgen.system import CfgText

DAMAGED = (
    "`rapidgen deploy ... --overwrite` writes a new one: the newest backup's, with the current "
    "files; a backup keeps all of them"
)
"""Help of RG531."""

Verb = Literal["deploy", "rollback", "uninstall"]
Action = Literal["add", "change", "same", "remove", "restore"]
Conflict = Literal["", "edited", "foreign", "kept"]
"""`kept`: the copy from before the first deployment is damaged or missing."""


@dataclass(frozen=True, slots=True)
class Layout:
    """Layout below the URL's folder.

    `home` is '' or 'HOME/', `syspar` is '' or a folder.
    """

    home: str
    syspar: str


@dataclass(frozen=True, slots=True)
class FileChange:
    """Change of one file.

    `path` is in HOME (or the SYSPAR file's own), `where` below the URL's folder.
    """

    path: str
    where: str
    action: Action
    kind: str
    tasks: tuple[str, ...] = ()
    before: bytes | None = field(default=None, repr=False)
    after: bytes | None = field(default=None, repr=False)
    conflict: Conflict = ""
    foreign: bool = False
    """True if a foreign file is there; it is kept for `uninstall`."""
    note: str = ""

    @property
    def doubt(self) -> str:
        """The conflict in words."""
        if self.conflict == "kept":
            return f"the copy of the state before the first deployment is {self.note}"
        if self.conflict == "edited":
            return f"changed locally since the last deployment{': ' * bool(self.note)}{self.note}"
        return "not created by rapidgen" if self.conflict else ""

    @property
    def shown(self) -> str:
        return self.path if self.kind == "syspar" else f"HOME:/{self.path}"

    def counts(self) -> tuple[int, int]:
        """Lines added and removed."""
        old, new = (lines_of(self.before), lines_of(self.after))
        matcher = difflib.SequenceMatcher(None, old, new, autojunk=False)
        added = removed = 0
        for tag, i, j, k, m in matcher.get_opcodes():
            if tag != "equal":
                removed, added = removed + j - i, added + m - k
        return added, removed


@dataclass(frozen=True, slots=True)
class Plan:
    """All changes, and the state of the controller for which they hold."""

    verb: Verb
    target: str
    name: str
    build_id: str
    robotware: tuple[int, int]
    changes: tuple[FileChange, ...]
    cfg: tuple[CfgChange, ...]
    cfg_seen: bool
    steps: tuple[ManualStep, ...]
    unseen: tuple[str, ...]
    rename: str
    interrupted: str
    fingerprint: str
    layout: Layout
    state: StateFolder = field(repr=False)
    had: Manifest | None = field(repr=False)
    """The last complete set: after an interruption, the one from before it."""
    wanted: DriverSet | None = field(repr=False)
    repair: bool = False
    """True if a run was interrupted while it switched files."""
    origin: Mapping[str, FileRecord] = field(default_factory=dict, repr=False)
    """Copies of foreign files, by path."""
    cfg_before: Mapping[str, Json] = field(default_factory=dict, repr=False)
    cfg_present: tuple[CfgText, ...] = field(default=(), repr=False)
    """Loaded cfg: SYSPAR, or that of a backup; empty if not visible."""
    cfg_ours: frozenset[str] = field(default=frozenset(), repr=False)
    """cfg instances that earlier deployments added."""
    neighbour: OtherDriver | None = None
    """Another driver that has to be removed first."""
    in_memory: tuple[str, ...] = ()
    """A backup's programs with names of ours.

    They would be restored instead of ours.
    """
    damaged: str = ""
    """Reason why the controller's manifest is unusable.

    Only `overwrite` replaces it.
    """
    copies: int = 0
    """Number of the next copy of a foreign file."""
    live: OnlinePlan | None = None
    """Changes besides files; None if only files are accessible."""

    @property
    def conflicts(self) -> tuple[FileChange, ...]:
        return tuple(c for c in self.changes if c.conflict)

    @property
    def is_empty(self) -> bool:
        """True if there is nothing to do.

        No file, no record of one, no interrupted run to repair.
        """
        return self.files_match and (self.live is None or self.live.is_empty)

    @property
    def files_match(self) -> bool:
        """True if the files and their records are as wanted."""
        same = all(c.action == "same" for c in self.changes)
        return same and not self.interrupted and not self.is_stale

    @property
    def is_pending(self) -> bool:
        """True if everything is in place, and a restart is pending."""
        live = self.live
        loaded = live is not None and live.restart and not live.touches_cfg
        return loaded and self.files_match

    @property
    def is_stale(self) -> bool:
        """True if the manifest on the controller is not as wanted."""
        if self.wanted is None or self.damaged:
            return self.had is not None
        recorded = {r.path: r.sha256 for r in self.had.files} if self.had else None
        return recorded != {f.path: f.sha256 for f in self.wanted.files}


def plan_json(plan: Plan) -> Members:
    """Return the plan for `--output`: hashes and words, no contents or secrets."""
    return {
        "format": 1,
        "verb": plan.verb,
        "target": plan.target,
        "name": plan.name,
        "build_id": plan.build_id,
        "robotware": list(plan.robotware),
        "fingerprint": plan.fingerprint,
        "interrupted": plan.interrupted,
        "files": [
            {
                "path": c.shown,
                "action": c.action,
                "kind": c.kind,
                "task": list(c.tasks),
                "before": digest(c.before) if c.before is not None else None,
                "after": digest(c.after) if c.after is not None else None,
                "added": c.counts()[0],
                "removed": c.counts()[1],
                "conflict": c.conflict or None,
            }
            for c in plan.changes
        ],
        "cfg": [{"domain": c.domain, "instance": c.key, "action": c.action} for c in plan.cfg],
        "cfg_seen": plan.cfg_seen,
        "another_driver": (
            {
                "instances": [n.shown for n in plan.neighbour.instances],
                "files": [f"HOME:/{path}" for path in plan.neighbour.files],
            }
            if plan.neighbour
            else None
        ),
        "steps": [
            {"who": s.who, "what": s.what, "stops_motion": s.stops_motion} for s in plan.steps
        ],
        "unseen": list(plan.unseen),
        "controller": plan.live.id if plan.live else None,
        "restart_pending": plan.is_pending,
    }


def lines_of(data: bytes | None) -> list[str]:
    """Return a file's lines; none for a missing file."""
    return data.decode("latin-1").splitlines() if data else []
