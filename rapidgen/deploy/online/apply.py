"""Online steps of a deployment, safe against interruption.

An interruption leaves the old set, the new one, or neither. Files precede cfg: a new task without
its module is a system failure. Instances are deleted from cfg before their files. Program memory is
last, right before the restart. The next plan finds all of it again, as it reads the controller and
not notes.
"""

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from datetime import datetime, timezone
from typing import TYPE_CHECKING

from rapidgen.client.errors import NotReady, NotSupported, RobotError
from rapidgen.client.rws import RwsError
from rapidgen.client.rws.core import APPLICATION
from rapidgen.client.rws.model import MastershipHolder
from rapidgen.deploy.file_operations import FileOperations, check_not_interrupted
from rapidgen.deploy.online.plan import OnlinePlan
from rapidgen.deploy.online.program_memory import forget_saved, rearrange
from rapidgen.deploy.online.snapshot import Row
from rapidgen.deploy.online.verify import PostRestartCheck, verify, way_back
from rapidgen.deploy.plan import Plan
from rapidgen.deploy.transports.transport import TransportFault, refused
from rapidgen.diagnostics import DiagnosticError, error
from rapidgen.system import CfgText, write_cfg
from rapidgen.wire.rws.bodies import Generation

if TYPE_CHECKING:
    from rapidgen.client.rws import Controller

_LOOK = 1.0
"""s between two checks of a person's action."""
_PROMPT = 10.0
"""s for which the prompt of RMMP stays on the pendant [RWS manual]."""
_SESSION_ENDS = 310.0
"""s after which the session of a killed run ends: 300 s idle [RWS manual]."""
_MANUAL = ("MANR", "MANF")
_SCRATCH = "TEMP/rapidgen_{}.cfg"


@dataclass(frozen=True, slots=True)
class OnlineOptions:
    """Permitted actions over web services, and waits for people."""

    restart: bool = False
    """True if the controller may be restarted, warm."""
    wait: float = 0.0
    """s to wait for automatic mode, a stopped program, or mastership."""
    proof: PostRestartCheck = field(default_factory=PostRestartCheck)
    pause: Callable[[float], None] = time.sleep


@dataclass(frozen=True, slots=True)
class OnlineRun:
    """One run over web services."""

    services: "Controller"
    work: FileOperations
    live: OnlinePlan
    options: OnlineOptions

    @property
    def plan(self) -> Plan:
        return self.work.plan

    @property
    def rearranges(self) -> bool:
        """True if program memory is changed now.

        A restart starts the tasks that this stops, or they belong to the deleted driver.
        """
        live = self.live
        stops = set(live.started) - (set(live.owned) if self.plan.wanted is None else set())
        return live.touches_memory and (self.options.restart or not stops)


def check(run: OnlineRun) -> None:
    """Check identity and state.

    Raises DiagnosticError RG540 (another controller), RG542 (wrong state).
    """
    target, live = run.plan.target, run.live
    if run.services.identity().id != live.id:
        raise another(run.plan, live.id)
    if live.is_empty:
        return
    lacking = live.lacking(run.services.generation, restart=run.options.restart)
    if lacking:
        raise refused(
            "RG542",
            f"the user lacks {', '.join(lacking)} at {target}",
            "give it in RobotStudio, or log in as another; nothing was changed",
        )
    _await_earlier_run(run)
    _await(run)
    if run.plan.wanted is None and live.touches_memory and not run.rearranges:
        others = sorted(set(live.started) - set(live.owned))
        raise refused(
            "RG542",
            f"taking modules out stops {', '.join(others)} on {target}, which is not the driver's",
            "add --restart: a warm start does it",
        )


def _await_earlier_run(run: OnlineRun) -> None:
    """Wait for an earlier run's mastership, also of a killed one.

    Nothing has been stopped or written yet. `_await` refuses mastership held after that.
    """
    left, text = max(run.options.wait, _SESSION_ENDS), False
    while (who := _holder(run)) is not None and who.application == APPLICATION and left > 0:
        if not text:
            run.work.say(
                f"waiting for mastership of {who.domain}, which {who} has: another run of "
                "rapidgen. If that was killed, the controller ends its session after five idle "
                "minutes; nothing has been changed yet"
            )
            text = True
        check_not_interrupted(run.work)
        run.options.pause(_LOOK)
        left -= _LOOK


def _holder(run: OnlineRun) -> MastershipHolder | None:
    """Return another session with mastership of what is written."""
    for domain in ("cfg", "rapid"):
        who = run.services.holder(domain)
        if who is not None and not who.mine:
            return who
    return None


def _await(run: OnlineRun) -> None:
    """Wait for actions of people.

    Raises DiagnosticError RG542 after the time limit.
    """
    left, text, refusal = run.options.wait, "", ""
    granted = False
    while (missing := _missing(run, granted=granted)) is not None:
        what, help = missing
        if not (granted or refusal) and run.services.panel().mode in _MANUAL:
            granted, refusal = _ask_pendant(run)
            continue
        if left <= 0:
            raise refused(
                "RG542", f"{what}{refusal}", f"{help}, then run this again (--wait S waits)"
            )
        if what != text:
            run.work.say(f"waiting for a person: {what}; {help}")
            text = what
        check_not_interrupted(run.work)
        run.options.pause(_LOOK)
        left -= _LOOK


def _ask_pendant(run: OnlineRun) -> tuple[bool, str]:
    """Ask by RMMP; return whether it was granted, or why not."""
    wait = max(run.options.wait, _PROMPT)
    if run.services.generation is not Generation.EIGHT:
        run.work.say(
            f"{run.plan.target} is in manual mode: its pendant asks now whether rapidgen may "
            f"write. Press Grant there within {wait:g} s"
        )
    try:
        run.services.ask_rmmp("modify", wait=wait)
    except (NotReady, NotSupported, RwsError) as cause:
        return False, f" ({cause.diagnostics[0].message})"
    return True, ""


def _missing(run: OnlineRun, *, granted: bool) -> tuple[str, str] | None:
    """Return the blocker and the action that removes it."""
    target = run.plan.target
    mode = run.services.panel().mode
    if mode != "AUTO" and not (granted and mode in _MANUAL):
        what = f"{target} is in mode {mode or '?'}, which does not permit remote writing"
        return what, "switch it to automatic at the pendant and acknowledge"
    if (who := _holder(run)) is not None:
        what = f"mastership of {who.domain} at {target} is held by {who}"
        return what, "let them release it, or end their session"
    stops = (run.options.restart and run.live.restart) or run.rearranges
    if stops and run.services.execution().running:
        what = f"the program of {target} runs, and the plan stops it"
        return what, f"when the robot may stop: `rapidgen stop-program {target}`"
    return None


def another(plan: Plan, id: str) -> DiagnosticError:
    """Return RG540."""
    return refused(
        "RG540",
        f"the plan was made for controller {id}, and another one answers at {plan.target}",
        "look who answers at this address, then plan again",
    )


def before_files(run: OnlineRun) -> None:
    """Let the controller make a backup; delete cfg before its files.

    Raises DiagnosticError.
    """
    if run.live.is_empty:
        return
    with _steps(run):
        _back_up(run)
        if run.plan.wanted is None and run.rearranges:
            rearrange(run.services, run.work, run.live, run.options.wait)
            forget_saved(run.work, run.live)
        if not run.live.touches_cfg:
            return
        with run.services.mastership("cfg", wait=run.options.wait):
            _delete(run, run.live.delete)
            if run.plan.wanted is None:
                _set(run)


@contextmanager
def writing(run: OnlineRun) -> Iterator[None]:
    """Hold write access on RobotWare 8 [real 8.1.0], else nothing."""
    if run.services.generation is not Generation.EIGHT:
        yield
        return
    with run.services.mastership("cfg", wait=run.options.wait):
        yield


def after_files(run: OnlineRun) -> None:
    """Change cfg and program memory, restart, and read back.

    Raises DiagnosticError RG543, RG544.
    """
    if run.live.is_empty:
        return
    with _steps(run):
        if run.plan.wanted is not None:
            if run.live.touches_cfg:
                with run.services.mastership("cfg", wait=run.options.wait):
                    _set(run)
                    _delete(run, run.live.again)
                    _load(run)
            if run.rearranges:
                rearrange(run.services, run.work, run.live, run.options.wait)
    if not run.live.restart:
        if run.plan.wanted is not None and run.rearranges:
            # Stopped NORMAL tasks: their program is loaded, and waits for a start.
            verify(run.services, run.plan, run.live, None, PostRestartCheck(), run.work.say)
            with _steps(run):
                _point(run)
        return
    if not run.options.restart:
        run.work.say("restart pending: loaded cfg takes effect after a warm start (--restart)")
        return
    with _steps(run):
        last = max((event.number for event in run.services.log(count=1)), default=0)
        run.work.say("restarting (a warm start)")
        run.services.restart()
    verify(run.services, run.plan, run.live, last, run.options.proof, run.work.say)
    with _steps(run):
        _point(run)


def _point(run: OnlineRun) -> None:
    """Set program pointers of the driver's own motion tasks to main."""
    for task, module in run.live.mains:
        try:
            run.services.set_pointer(task, module, "main")
        except RwsError as cause:
            others = ", ".join(run.live.pointers) or "no other task"
            run.work.say(
                f"! the program pointer of {task} cannot be set alone ({cause.symbol}): "
                f"`rapidgen start-program --main` sets those of all tasks ({others})"
            )


def _back_up(run: OnlineRun) -> None:
    name = f"rapidgen_{datetime.now(timezone.utc):%Y%m%d_%H%M%S}"
    try:
        run.work.say(f"the controller's own backup: {run.services.backup(name)}")
    except RwsError as cause:
        if cause.symbol not in ("E_DIR_EXIST", "E_ALREADY_EXISTS"):
            raise


def _delete(run: OnlineRun, rows: Sequence[Row]) -> None:
    for row in rows:
        run.work.say(f"deleting {row.section} {row.title}")
        run.services.cfg_delete(row.domain, row.section, row.title)


def _set(run: OnlineRun) -> None:
    for change in run.live.change:
        run.work.say(f"setting {change.section} {change.title}")
        run.services.cfg_set(change.domain, change.section, change.title, change.new)


def _load(run: OnlineRun) -> None:
    optional = run.live.optional if run.live.touches_cfg else ()
    for text in run.live.load:
        run.work.say(f"loading {_count(text)} instances of {text.domain}")
        _load_one(run, text)
    for text in optional:
        try:
            _load_one(run, text)
        except RwsError as cause:
            run.work.say(f"left out, as the controller refuses it: {text.path} ({cause.symbol})")


def _load_one(run: OnlineRun, text: CfgText) -> None:
    path = _SCRATCH.format(text.domain.lower())
    run.services.write_file(path, write_cfg(text).encode("latin-1", "replace"))
    run.services.cfg_load(path, mode="add")
    run.services.delete_file(path)


def _count(text: CfgText) -> int:
    return sum(len(section.instances) for section in text.sections)


@contextmanager
def _steps(run: OnlineRun) -> Iterator[None]:
    """Turn an error of a step into a refusal with a help."""
    try:
        yield
    except (RobotError, TransportFault) as cause:
        plan = run.plan
        raise DiagnosticError(
            [
                *cause.diagnostics,
                error(
                    "RG543",
                    None,
                    f"{plan.verb} of {plan.target} ended before it was done",
                    f"run `rapidgen {plan.verb}` again to finish, or {way_back(plan)} to undo",
                ),
            ],
            exit_code=1,
        ) from cause
