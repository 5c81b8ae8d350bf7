"""Steps common to the commands: set, plans, confirmation, execution."""

import json
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from rapidgen._atomic_write import write_whole
from rapidgen._json import items, members
from rapidgen._reading import read_foreign
from rapidgen.config import from_manifest
from rapidgen.deploy.apply import apply, conflicts_of, moved_on
from rapidgen.deploy.driver_set import DriverSet, digest, from_files, from_folder
from rapidgen.deploy.fleet import Interruption, TargetOutcome, Word, connected, on_all
from rapidgen.deploy.online.apply import OnlineOptions, another
from rapidgen.deploy.online.verify import Hello, PostRestartCheck
from rapidgen.deploy.plan import Plan, Verb, plan_json
from rapidgen.deploy.planner import find_layout, make_plan
from rapidgen.deploy.retention import backup_set
from rapidgen.deploy.state_folder import StoredSet, read_state
from rapidgen.deploy.syspar import loaded_cfg
from rapidgen.deploy.target import Access
from rapidgen.deploy.transports.registry import Target
from rapidgen.deploy.transports.transport import Transport, refused
from rapidgen.diagnostics import DiagnosticError, refusal
from rapidgen.generate.cell_routines import check_routines
from rapidgen.generate.context import data_of_another
from rapidgen.generate.existing_controller import check_data
from rapidgen.system import CfgText, cfg_bytes, read_backup

Say = Callable[[str], None]
_LARGEST_PLAN = 100_000_000
"""Largest file of plans, which includes every file to write, bytes."""


@dataclass(frozen=True, slots=True)
class FleetJob:
    """One command on several controllers.

    `find` returns the set for a controller.
    """

    verb: Verb
    targets: tuple[Target, ...]
    access: Access
    find: Callable[[Transport], DriverSet | None]
    overwrite: bool = False
    parallel: int = 1
    backup: Path | None = None
    """Backup of the only controller, for data that its transport cannot read."""
    restart: bool = False
    """True if a controller may be restarted, warm."""
    wait: float = 0.0
    """s to wait for actions of people at a controller."""
    hello: Hello | None = None
    """Returns the build that serves a state port, after a restart."""
    giving_up: Interruption = field(default_factory=Interruption)
    """Ctrl-C during execution of plans."""

    def loaded(self) -> tuple[CfgText, ...]:
        """Return the loaded cfg of that backup.

        Raises DiagnosticError RG536, RG701, RG702.
        """
        if self.backup is None:
            return ()
        if len(self.targets) != 1:
            raise refusal(
                "RG536",
                None,
                f"--backup {self.backup} is of one controller, {len(self.targets)} are named",
                "run once for each controller, with its own backup",
            )
        return loaded_cfg(self.backup)


def desired_set(config: str, overrides: Sequence[str] = ()) -> DriverSet:
    """Return the driver of a configuration, shipped name or generated folder.

    The first two are built here.
    """
    if (Path(config) / "manifest.json").is_file():
        return from_folder(Path(config))
    from rapidgen.config import load_config
    from rapidgen.generate import build

    output = build(load_config(config, overrides=tuple(overrides)))
    return from_files({file.path: file.data for file in output.files}, source=config)


def config_name(config: str) -> str:
    """Return the name of a configuration's robot."""
    from rapidgen.config import load_config

    if (Path(config) / "manifest.json").is_file():
        return from_folder(Path(config)).name
    return load_config(config).name


def plan_all(job: FleetJob) -> list[Plan]:
    """Return plans of all targets.

    Raises the faults of those that could not be planned, or RG113.
    """

    loaded = job.loaded()

    def work(target: Target) -> Plan:
        with connected(target, job.access) as transport:
            desired = job.find(transport)
            if job.backup is not None and desired is not None:
                _check_data(desired, job.backup)
            return make_plan(transport, desired, verb=job.verb, loaded=loaded)

    results = on_all(job.targets, work, parallel=job.parallel)
    failures = [r for r in results if isinstance(r, DiagnosticError)]
    if failures:
        raise DiagnosticError(
            [d for failure in failures for d in failure.diagnostics],
            exit_code=max(f.exit_code for f in failures),
        )
    return [r for r in results if isinstance(r, Plan)]


def _check_data(desired: DriverSet, backup: Path) -> None:
    """Refuse a set that the user's program of the backup does not fit.

    It reads data (RG113) or calls routines (RG114) that are missing there.
    """
    given = desired.generated.get("configuration")
    config = from_manifest(given) if given is not None else None
    if config is not None and any(
        data_of_another(group) or group.routines or group.data for group in config.groups
    ):
        cell = read_backup(backup, notes=[])
        check_data(config, cell)
        check_routines(config, cell)


def apply_all(job: FleetJob, plans: Sequence[Plan], say: Say) -> list[TargetOutcome]:
    """Execute the plans; refuse a controller that has changed since (RG522).

    After an interruption no further target is started: see the outcomes. KeyboardInterrupt does the
    same and is raised without outcomes.
    """
    by_target = dict(zip(job.targets, plans, strict=True))
    giving_up = job.giving_up

    def work(target: Target) -> TargetOutcome:
        plan = by_target[target]
        if plan.is_empty:
            return TargetOutcome(target, "same", "nothing to do")
        prefix = f"{target.shown}: " if len(job.targets) > 1 else ""
        with connected(target, job.access) as transport:
            apply(
                transport,
                plan,
                overwrite=job.overwrite,
                live=OnlineOptions(job.restart, job.wait, PostRestartCheck(job.hello, target.host)),
                say=lambda line: say(prefix + line),
                given_up=lambda: bool(giving_up),
            )
        count = sum(1 for c in plan.changes if c.action != "same")
        pending = plan.live is not None and plan.live.restart and not job.restart
        later = ", restart pending" if pending else ""
        return TargetOutcome(target, "done", f"{count} files, build {plan.build_id or '-'}{later}")

    outcomes = []
    for target, result in zip(
        job.targets,
        on_all(job.targets, work, parallel=job.parallel, giving_up=giving_up),
        strict=True,
    ):
        if isinstance(result, DiagnosticError):
            first = result.diagnostics[0]
            word: Word = "given up" if first.code == "RG545" else "failed"
            outcomes.append(TargetOutcome(target, word, f"{first.code}: {first.message}", result))
        else:
            outcomes.append(result or TargetOutcome(target, "not begun"))
    return outcomes


def refuse_conflicts(job: FleetJob, plans: Sequence[Plan]) -> None:
    """Raise conflicts of all targets before any of them is changed.

    RG520, RG521, RG531, RG534 to RG537.
    """
    result = [d for plan in plans for d in conflicts_of(plan, overwrite=job.overwrite)]
    if result:
        raise DiagnosticError(result, exit_code=1)


def confirm(question: str, *, yes: bool, ask: Callable[[str], bool]) -> None:
    """Ask for confirmation.

    Raises DiagnosticError RG533 if the answer is no, or there is none.
    """
    if yes:
        return
    if not sys.stdin.isatty():
        raise refusal(
            "RG533",
            None,
            "there is no terminal to confirm on: nothing was changed",
            f"the question is: {question} To answer yes, add --yes",
        )
    if not ask(question):
        raise refused("RG533", "not confirmed: nothing was changed", "run it again to confirm")


def history(target: Target, access: Access, name: str) -> tuple[StoredSet, ...]:
    """Return backups on a controller, the oldest first.

    Raises DiagnosticError RG524, RG529, RG531.
    """
    with connected(target, access) as transport:
        plan = make_plan(transport, None, verb="rollback")
        _check_name(plan, name)
        return plan.had.history if plan.had else ()


def earlier_set(transport: Transport, name: str, number: int | None) -> DriverSet | None:
    """Return the earlier set.

    It is that of backup `number`, or the one before the last deployment. After an interruption it
    is the set from before it (None if there was none). Raises RG528.
    """
    home = find_layout(transport).home
    plan = make_plan(transport, None, verb="rollback")
    _check_name(plan, name)
    if number is not None:
        return backup_set(transport, home, number)
    if plan.repair:
        journal = read_state(transport, home).journal
        if plan.had is None or journal is None:
            return None
        return backup_set(transport, home, journal.id)
    past = plan.had.history if plan.had else ()
    if not past:
        raise refused(
            "RG528",
            f"{plan.target}: there is no earlier set",
            "`rapidgen uninstall` restores the state before the first deployment",
        )
    return backup_set(transport, home, past[-1].id)


def write_plans(path: Path, plans: Sequence[Plan]) -> None:
    """`--output`. Raises OSError."""
    text = json.dumps({"format": 1, "plans": [plan_json(p) for p in plans]}, indent=2) + "\n"
    write_whole(path, text.encode())


def check_plans(path: Path, plans: Sequence[Plan]) -> None:
    """Check that new plans equal those in the file, one by one.

    Raises DiagnosticError RG523 (not a plan, of another robot or build), RG522 (the controller
    changed), RG540 (another controller).
    """
    try:
        stored = json.loads(read_foreign(path, _LARGEST_PLAN).decode())["plans"]
        by_target = {str(p["target"]): p for p in map(members, items(stored))}
    except OSError as fault:
        raise _plan_file(path, fault.strerror or str(fault)) from fault
    except (ValueError, KeyError, TypeError, RecursionError) as fault:
        raise _plan_file(path, "it is not a plan that rapidgen wrote") from fault
    if set(by_target) != {p.target for p in plans}:
        raise _plan_file(path, f"it is for {', '.join(sorted(by_target)) or 'no controller'}")
    for plan in plans:
        old = by_target[plan.target]
        new = plan_json(plan)
        for key, what in (("verb", "verb"), ("name", "robot"), ("build_id", "build")):
            if old.get(key) != new[key]:
                raise _plan_file(path, f"it is for {what} {old.get(key)!r}, not {new[key]!r}")
        if old.get("controller") != new["controller"]:
            raise another(plan, str(old.get("controller")))
        if old.get("fingerprint") != plan.fingerprint:
            raise moved_on(plan.target)
        if digest(json.dumps(old["files"]).encode()) != digest(json.dumps(new["files"]).encode()):
            raise _plan_file(path, "the files that would be written are others")


def save_edits(plans: Sequence[Plan], folder: Path) -> list[Path]:
    """Copy local changes that `uninstall --overwrite` removes to this machine."""
    saved = []
    for plan in plans:
        for change in plan.conflicts:
            if change.before is not None:
                saved.append(_keep(folder / _host(plan) / change.path, change.before))
    return saved


def save_neighbours(plans: Sequence[Plan], folder: Path) -> list[Path]:
    """Copy other drivers to this machine, as cfg files that restore them."""
    saved = []
    for plan in plans:
        for text in plan.neighbour.texts(plan.cfg_present) if plan.neighbour else ():
            saved.append(_keep(folder / _host(plan) / f"{text.domain}.cfg", cfg_bytes(text)))
    return saved


def _keep(path: Path, data: bytes) -> Path:
    """Return the path of the copy.

    It gets its own name (`SYS-2.cfg`) if another copy exists.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    place, number = path, 1
    while place.exists() and not _is_same(place, data):
        number += 1
        place = path.with_name(f"{path.stem}-{number}{path.suffix}")
    place.write_bytes(data)
    return place


def _is_same(place: Path, data: bytes) -> bool:
    """True if a file has these bytes; an unreadable one counts as different."""
    try:
        return read_foreign(place, len(data)) == data
    except OSError:
        return False


def _host(plan: Plan) -> str:
    return "".join(c if c.isalnum() else "_" for c in plan.target)


def check_names(plans: Sequence[Plan], name: str) -> None:
    """Raise RG524 if a controller has the driver of another robot."""
    for plan in plans:
        _check_name(plan, name)


def _check_name(plan: Plan, name: str) -> None:
    carried = plan.state.carried(plan.had, repair=plan.repair)
    if carried and name and carried != name:
        raise refused(
            "RG524",
            f"{plan.target} carries the driver of {carried!r}, not of {name!r}",
            "check the URL",
        )


def _plan_file(path: Path, reason: str) -> DiagnosticError:
    return refused(
        "RG523",
        f"plan {path} cannot be carried out: {reason}",
        "make a new one with `rapidgen plan ... --output FILE`",
    )
