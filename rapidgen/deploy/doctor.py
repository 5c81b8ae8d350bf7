"""Checks between a driver and a controller, from outside and read-only."""

import socket
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from rapidgen._json import items, members, whole
from rapidgen._json import text as as_text
from rapidgen.client.core.motion import fix_of
from rapidgen.config.egm import OPTIONS
from rapidgen.deploy.cfg import is_unconfirmed, keyed, name_of
from rapidgen.deploy.driver_set import DriverSet
from rapidgen.deploy.online.plan import OnlinePlan
from rapidgen.deploy.other_driver import MODULE
from rapidgen.deploy.plan import Plan
from rapidgen.deploy.planner import make_plan
from rapidgen.deploy.secrets import Credentials, Secret
from rapidgen.deploy.syspar import loaded_cfg
from rapidgen.deploy.target import Access, connect, credentials
from rapidgen.deploy.tasks import MAIN, entry_steps
from rapidgen.deploy.transports.registry import Target
from rapidgen.deploy.transports.transport import FILE_LIMIT, Transport, TransportFault
from rapidgen.diagnostics import DiagnosticError
from rapidgen.system import CfgText
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.simple_message.spec import Reason

Verdict = Literal["ok", "warn", "fail", "unknown"]

Hello = Callable[[str, int], str | None]
"""Returns BUILD_ID of the driver at a state port, or None.

None: another program answers. Raises OSError: no answer.
"""

GetError = Callable[[str, int], Reason | None]
"""Returns the error that the driver at a state port reports, or None.

Raises OSError: no answer.
"""

_FEATURES = ("623-1 Multitasking", "616-1 PC Interface")


@dataclass(frozen=True, slots=True)
class Check:
    """One check, and the help if it is not ok."""

    area: str
    verdict: Verdict
    found: str
    help: str = ""


def run_checks(
    target: Target,
    access: Access,
    desired: DriverSet,
    *,
    hello: Hello,
    text: GetError = lambda _host, _port: None,
    robot_host: str = "",
    backup: Path | None = None,
    timeout: float = 2.0,
) -> tuple[Check, ...]:
    """Run all checks of one controller.

    `robot_host` is the host of its ports, if it is not the URL's. `backup` says what is loaded if
    that is not visible. Raises DiagnosticError RG536, RG701, RG702.
    """
    loaded = loaded_cfg(backup) if backup is not None else ()
    host = robot_host or target.host
    checks = [*_running(host, desired, hello, text, timeout), *_guidance(desired)]
    try:
        transport = connect(target, access)
    except DiagnosticError as error:
        result = error.diagnostics[0]
        return (Check("reach", "fail", result.message, result.help), *checks)
    try:
        checks.insert(0, Check("reach", "ok", f"{target.shown}: logged in"))
        checks += _default_login(target, access)
        checks += _contents(transport, desired, loaded)
    finally:
        transport.close()
    return tuple(checks)


def _running(
    host: str, desired: DriverSet, hello: Hello, text: GetError, timeout: float
) -> Iterator[Check]:
    groups = members(desired.generated.get("groups") or {})
    if not host:
        yield Check("ports", "unknown", "a folder has no ports", "name the robot with --host")
        return
    for name, group in groups.items():
        ports = {role: whole(n) for role, n in members(members(group).get("ports") or {}).items()}
        driver = None
        if "state" in ports:
            where = f"{name} state {host}:{ports['state']}"
            driver = _state_port(where, host, ports["state"], desired.build_id, hello)
            yield driver
            if driver.verdict != "unknown":
                yield from _driver_error(where, host, ports["state"], text)
        for role, port in ports.items():
            if role != "state":
                answers = driver is not None and driver.verdict != "unknown"
                yield _port(f"{name} {role} {host}:{port}", host, port, timeout, answers)


def _port(where: str, host: str, port: int, timeout: float, answers: bool) -> Check:
    """Check a motion or control port; not while a program answers on the state port.

    A driver serves the newest client there: a connection would end another client's motion.
    """
    if answers:
        help = "`rapidgen commission`, or any client that connects, shows whether it can be used"
        return Check("ports", "unknown", f"{where}: not opened, a client may use it", help)
    try:
        socket.create_connection((host, port), timeout).close()
    except OSError as error:
        return Check(
            "ports",
            "unknown",
            f"{where}: {error.strerror or 'no answer'}",
            "nothing listens before the driver runs; afterwards look at the firewall",
        )
    return Check("ports", "ok", f"{where}: something listens")


def _state_port(where: str, host: str, port: int, build: str, hello: Hello) -> Check:
    try:
        running = hello(host, port)
    except OSError as error:
        return Check(
            "driver",
            "unknown",
            f"{where}: {error.strerror or 'no answer'}",
            "nothing runs yet, or a firewall is between (option 616-1 PC Interface is needed)",
        )
    if running is None:
        return Check(
            "driver",
            "warn",
            f"{where}: something answers, but no driver of rapidgen",
            "another program or abb_driver has the port: change `ports` or take it off",
        )
    if running != build:
        return Check(
            "driver",
            "warn",
            f"{where}: build {running} runs, the configuration gives {build}",
            "`rapidgen plan` shows the difference; after `deploy` the controller restarts",
        )
    return Check("driver", "ok", f"{where}: build {running} runs")


def _driver_error(where: str, host: str, port: int, get_error: GetError) -> Iterator[Check]:
    """Yield an error of the driver that does not end by itself."""
    try:
        reason = get_error(host, port)
    except OSError:
        return  # it disconnected after sending its build
    fix = fix_of(reason, "")
    if reason is not None and fix:
        yield Check("driver", "fail", f"{where}: {reason.text}, no motion is possible", fix)


def _guidance(desired: DriverSet) -> Iterator[Check]:
    """Check what externally guided motion needs, as far as this computer can see it."""
    configuration = members(desired.generated.get("configuration") or {})
    for group in map(members, items(configuration.get("groups") or [])):
        if not group.get("egm"):
            continue
        egm = members(group["egm"])
        address, device = as_text(egm["address"]), as_text(egm["device"])
        where = f"{as_text(group['name'])}, device {device}, partner {address}:{whole(egm['port'])}"
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as trial:
            try:
                trial.bind((address, 0))
                yield Check("EGM", "ok", f"{where}: an address of this computer")
            except OSError:
                yield Check(
                    "EGM",
                    "warn",
                    f"{where}: not an address of this computer",
                    "the controller accepts datagrams from this address only: guide the robot "
                    "from that computer, or change `egm.address` and deploy",
                )
        yield Check(
            "EGM",
            "unknown",
            f"needed: {OPTIONS[desired.robotware[0]]} Externally Guided Motion",
            "pendant: ABB menu > System Info > Options; without it the motion task has errors",
        )


def _default_login(target: Target, access: Access) -> Iterator[Check]:
    if not target.way.port:
        return
    used = credentials(target, access)
    if used.is_default:
        yield _open_door(used)
        return
    known = replace(used, user="Default User", password=Secret("robotics"))
    attempt = replace(target, user=known.user)
    try:
        attempt.open(known, access.timeout).close()
    except DiagnosticError:
        yield Check("passwords", "ok", "the delivered password is not accepted")
        return
    yield _open_door(known)


def _open_door(login: Credentials) -> Check:
    return Check(
        "passwords",
        "warn",
        f"'{login.user}' logs in with the password that controllers are delivered with",
        "change it (RobotStudio: Controller > Authenticate > Edit user accounts)",
    )


def _contents(
    transport: Transport, desired: DriverSet, loaded: tuple[CfgText, ...]
) -> Iterator[Check]:
    try:
        plan = make_plan(transport, desired, loaded=loaded)
    except DiagnosticError as error:
        first = error.diagnostics[0]
        area = "RobotWare" if first.code == "RG525" else "HOME"
        yield Check(area, "fail", first.message, first.help)
        return
    yield Check("HOME", "ok", "its files can be read; whether it can be written is not tried")
    if plan.live is not None and transport.services is not None:
        yield from _live(plan, plan.live, transport.services.generation)
    if plan.interrupted:
        yield Check("deployment", "warn", plan.interrupted, "`rapidgen deploy` or `rollback`")
    elif plan.had is None:
        yield Check("deployment", "unknown", "none yet", "`rapidgen plan`, then `rapidgen deploy`")
    elif plan.is_empty:
        yield Check("deployment", "ok", f"build {plan.had.build_id}, as configured")
    else:
        yield Check(
            "deployment",
            "warn",
            f"build {plan.had.build_id} is installed, the configuration gives {desired.build_id}",
            "`rapidgen plan` shows the difference",
        )
    for change in plan.conflicts:
        what = {"edited": "changed locally", "foreign": "a foreign file"}.get(
            change.conflict, change.doubt
        )
        yield Check("files", "fail", f"{change.shown}: {what}", "`rapidgen plan` has details")
    yield from _clashes(transport, plan, desired)
    yield from _other_driver_check(plan)
    yield from _configuration(plan, desired)
    yield _space(transport, desired)


def _live(plan: Plan, live: OnlinePlan, generation: Generation) -> Iterator[Check]:
    """Return the checks that need web services."""
    yield Check("controller", "ok", f"{live.shown}, id {live.id}")
    if live.mode != "AUTO":
        help = "switch it to automatic at the pendant: remote writing needs it"
        yield Check("mode", "warn", f"it is {live.mode}", help)
    if live.running:
        help = f"it must be stopped for a restart: `rapidgen stop-program {plan.target}`"
        yield Check("program", "warn", "it runs", help)
    for module in live.clash:
        help = "unload it, or `rapidgen deploy --overwrite`, which saves it first"
        yield Check("memory", "fail", f"{module.shown} is loaded, and {module.why}", help)
    lacking = live.lacking(generation, restart=True)
    if lacking:
        help = "RobotStudio, User Authorization: give it to this user, or log in as another"
        yield Check("grants", "warn", f"the user lacks {', '.join(lacking)}", help)
    if live.silent:
        what = f"{', '.join(live.silent)} of the driver are stopped: its ports do not answer"
        yield Check("tasks", "fail", what, "`rapidgen deploy --restart`, or menu > Restart")
    if plan.is_pending:
        help = "`rapidgen deploy --restart`, or menu > Restart"
        yield Check("restart", "warn", "everything is loaded: a restart is pending", help)
    elif live.orphans:
        what = f"{', '.join(live.orphans)} was deleted from cfg: a restart is pending"
        help = "`rapidgen uninstall --restart`, or menu > Restart"
        yield Check("restart", "warn", what, help)


def _clashes(transport: Transport, plan: Plan, desired: DriverSet) -> Iterator[Check]:
    """Return foreign modules with a name of ours, or with a main routine."""
    home = plan.layout.home
    own_files = {c.where for c in plan.changes}
    names = {m[1].lower() for f in desired.files if (m := MODULE.search(f.data))}
    has_main = any(MAIN.search(f.data) for f in desired.files)
    result = False
    folders = {"", *(c.path.rpartition("/")[0] for c in plan.changes if c.kind == "module")}
    for folder in sorted(folders):
        try:
            entries = transport.entries((home + folder).rstrip("/"))
        except TransportFault as fault:
            if fault.kind != "missing":
                raise
            continue
        for entry in entries:
            where = f"{home}{folder}/{entry.name}" if folder else home + entry.name
            suffix = entry.name.rpartition(".")[2].lower()
            if (
                where in own_files
                or entry.folder
                or suffix not in ("mod", "sys", "modx", "sysx", "prg")
            ):
                continue
            try:
                if (entry.size or 0) > FILE_LIMIT:
                    raise TransportFault("denied", f"{where} is larger than 8 MB")
                data = transport.read(where)
            except TransportFault as fault:
                if fault.kind in ("lost", "garbled"):
                    raise
                result = True
                help = "look whether it holds a module with a name of the driver's"
                yield Check("names", "unknown", fault.diagnostics[0].message, help)
                continue
            module = MODULE.search(data)
            if module and module[1].lower() in names:
                result = True
                yield Check(
                    "names",
                    "fail",
                    f"{where} holds a module {module[1].decode()} too",
                    "two modules of one name do not load: rename it, or keep it out of the tasks",
                )
            elif has_main and MAIN.search(data):
                result = True
                yield Check(
                    "main",
                    "warn",
                    f"{where} has a main routine too",
                    "a task has one main: keep this module out of the driver's tasks, or set "
                    "`main: own` and call ROS_run from it",
                )
    if not result:
        yield Check("names", "ok", "no module in HOME has a name of the driver's")


def _configuration(plan: Plan, desired: DriverSet) -> Iterator[Check]:
    ware = f"{desired.robotware[0]}.{desired.robotware[1]:02d}"
    if not plan.cfg_present:
        yield Check(
            "RobotWare",
            "unknown",
            f"whether it is {ware} is not seen over {plan.target.partition(':')[0]}",
            "pendant: ABB menu > System Info",
        )
        yield Check(
            "configuration",
            "unknown",
            "loaded tasks and signals are not seen",
            "after loading the cfg files: Control Panel > Configuration",
        )
        yield Check(
            "options",
            "unknown",
            f"needed: {', '.join(_FEATURES)}",
            "pendant: ABB menu > System Info > Options",
        )
        return
    yield Check("RobotWare", "ok", f"main version {desired.robotware[0]}")
    for step in entry_steps(desired, plan.cfg_present, plan.target):
        yield Check("tasks", "warn", step.what, "the driver's main does not run before that")
    for change in plan.cfg:
        if change.action == "clash":
            help = "rename the signal on the controller"
            yield Check("signals", "fail", f"{change.key} is {change.note}", help)
    optional = {name_of(k) for t in desired.cfg if is_unconfirmed(t) for k in keyed([t])}
    away = [
        c
        for c in plan.cfg
        if c.action not in ("same", "use", "clash")
        and not (c.action == "add" and f"{c.domain} {c.key}".casefold() in optional)
    ]
    if not away:
        yield Check("configuration", "ok", f"{len(plan.cfg)} instances as the driver needs them")
        return
    counts = Counter(c.action for c in away)
    text = ", ".join(f"{count} to {action}" for action, count in sorted(counts.items()))
    yield Check(
        "configuration",
        "warn",
        f"loaded cfg differs from what the driver needs: {text}; the first is {away[0].key}",
        "`rapidgen plan` names each, and the steps",
    )


def _other_driver_check(plan: Plan) -> Iterator[Check]:
    if plan.neighbour is None:
        return
    names = [n.shown for n in plan.neighbour.instances]
    yield Check(
        "drivers",
        "fail" if names else "warn",
        f"another driver is there: {'; '.join(names or plan.neighbour.files)}",
        "`rapidgen plan` has the steps to remove it; both together do not load",
    )


def _space(transport: Transport, desired: DriverSet) -> Check:
    needed = 3 * sum(len(f.data) for f in desired.files)
    free = transport.free()
    if free is None:
        return Check("disk", "unknown", f"{needed // 1000} kB needed, the free space is unknown")
    if free < needed:
        return Check("disk", "fail", f"{free} bytes free, {needed} needed", "delete old backups")
    return Check("disk", "ok", f"{free // 1_000_000} MB free")
