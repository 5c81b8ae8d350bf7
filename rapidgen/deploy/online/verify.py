"""Verification after a restart: identity, deployed set, service."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rapidgen._json import members, whole
from rapidgen.client.rws.model import LogEvent
from rapidgen.deploy.online.plan import OnlinePlan
from rapidgen.deploy.online.snapshot import build_in
from rapidgen.deploy.plan import Plan
from rapidgen.diagnostics import DiagnosticError, error

if TYPE_CHECKING:
    from rapidgen.client.rws import Controller

Hello = Callable[[str, int], str | None]
"""Returns BUILD_ID of the driver at a state port, or None.

None: another program answers. Raises OSError: no answer.
"""

_LOOK = 0.5
"""s between two checks of a port."""


@dataclass(frozen=True, slots=True)
class PostRestartCheck:
    """Settings of the check that the driver serves.

    `host` is the host of its ports.
    """

    hello: Hello | None = None
    host: str = ""
    timeout: float = 20.0
    """s within which a port has to answer."""


def verify(
    services: "Controller",
    plan: Plan,
    live: OnlinePlan,
    last: int | None,
    proof: PostRestartCheck,
    say: Callable[[str], None],
) -> None:
    """Verify everything and report all faults together.

    `last` is the number of the last event before the restart; None: there was none. Raises
    DiagnosticError RG540, RG544; RobotError.
    """
    result = services.identity()
    faults = []
    if result.id != live.id:
        faults.append(f"another controller answers: {result.name} ({result.id})")
    if services.panel().state == "sysfail":
        faults.append("it is in system failure")
    there = {task.name.casefold(): task.name for task in services.tasks()}
    faults += _driver(services, plan, live, there)
    events = _events(services, last) if last is not None else ()
    for event in events:
        say(f"event log: {event}")
    if not faults:
        faults += _ports(plan, proof)
    if not faults:
        say(f"read back: {result.name} has it" if plan.wanted else f"read back: {result.name}")
        return
    raise DiagnosticError(
        [
            error(
                "RG544",
                None,
                f"{plan.target} {'accepted it' if last is None else 'restarted'}, and {faults[0]}",
                f"go back: {way_back(plan)} with --restart; a backup was made before",
                notes=(*faults[1:], *map(str, events[:5])),
            )
        ],
        exit_code=1,
    )


def way_back(plan: Plan) -> str:
    """Return the command that undoes a deployment."""
    return "`rapidgen rollback`" if plan.had is not None else "`rapidgen uninstall`"


def _driver(
    services: "Controller", plan: Plan, live: OnlinePlan, there: dict[str, str]
) -> list[str]:
    """Return the faults of the tasks."""
    if plan.wanted is None:
        gone = [c.key.partition(" ")[2] for c in plan.cfg if c.action == "remove"]
        names = [n for n in gone if n.casefold() in there and n in live.owned]
        return [f"task {name} is still there" for name in names]
    faults = []
    for name in dict.fromkeys(t for f in plan.wanted.files for t in f.tasks):
        task = there.get(name.casefold())
        if task is None:
            faults.append(f"task {name} is not there")
            continue
        wrong = services.build_errors(task)
        faults += [f"{task}: {e.module} line {e.row}: {e.text}" for e in wrong]
        build = build_in(services, task, live.symbols.get(name, ()))
        if not wrong and build != plan.wanted.build_id:
            faults.append(f"{task} runs build {build or '(none)'}, not {plan.wanted.build_id}")
    return faults


def _events(services: "Controller", last: int) -> tuple[LogEvent, ...]:
    """Return errors since the restart; all if the numbers began anew."""
    newest = max((event.number for event in services.log(count=1)), default=0)
    events = services.log(after=last if newest >= last else 0)
    return tuple(event for event in events if event.type == "error")


def _ports(plan: Plan, proof: PostRestartCheck) -> list[str]:
    """Return state ports that do not report our BUILD_ID."""
    if proof.hello is None or plan.wanted is None:
        return []
    faults = []
    groups = members(plan.wanted.generated.get("groups") or {})
    end = time.monotonic() + proof.timeout
    for name, group in groups.items():
        port = members(members(group).get("ports") or {}).get("state")
        if port is None:
            continue
        where = f"{name} state {proof.host}:{whole(port)}"
        text = _running_build(proof, whole(port), end)
        if text is None:
            faults.append(
                f"there is no server at {where}: is a firewall between, or `sim --ports auto`?"
            )
        elif text != plan.wanted.build_id:
            faults.append(f"{where} serves {text or 'something else'}")
    return faults


def _running_build(proof: PostRestartCheck, port: int, end: float) -> str | None:
    """Return the BUILD_ID that answers, '' for another program, or None.

    None: no answer.
    """
    assert proof.hello is not None
    while True:
        try:
            return proof.hello(proof.host, port) or ""
        except OSError:
            if time.monotonic() >= end:
                return None
        time.sleep(_LOOK)
