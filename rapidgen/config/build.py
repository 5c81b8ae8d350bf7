"""Convert the validated file to the frozen model.

This sets units and defaults, and checks what the schema cannot see.
"""

import math
from pathlib import Path

from rapidgen.config import model, schema
from rapidgen.config.axis_sets import resolve_held_axes
from rapidgen.config.draft import DraftFindings, GroupDraft
from rapidgen.config.draft import Path as KeyPath
from rapidgen.config.egm import check_partners, egm_of
from rapidgen.config.joints import inertias_of, joints_of
from rapidgen.config.plausibility import Arm, is_host, is_radians, length_of, payload_doubt
from rapidgen.config.registry import find_shipped
from rapidgen.config.tools import data_of, routine_of, tool_of, work_object_of
from rapidgen.config.variant_model import label
from rapidgen.diagnostics import Severity, suggest

GENERATIONS = {
    "irc5": (5, 6),
    "irc5_compact": (5, 6),
    "omnicore": (7, 8),
    "virtual": (5, 6, 7, 8),
}
DEFAULT_PORTS = (11000, 11001, 11002)
PORT_STEP = 10
_PLAIN_PORTS_END = 4999
_SHORTEST_CHAIN = 20.0
"""mm, the sum of a chain's steps: shorter than any robot, it is in m."""

SLOWEST_TCP = 10
"""Minimum TCP speed limit, mm/s; our choice, v5 and v10 are ABB's slowest."""
_SMALL_ZONES = ("fine", "z0", "z1", "z5", "z10")


def build(
    configuration: schema.ConfigurationKeys,
    drafts: list[GroupDraft],
    path: Path,
    report: DraftFindings,
) -> model.RobotConfig | None:
    """Return the model, or None when `report` holds errors.

    The model is named after the file `path`.
    """
    _check_controller(configuration, report)
    _check_network(configuration, report)
    _check_signals(configuration, report)
    _check_profile(configuration, report)
    if not (configuration.groups or report.is_faulty(("groups",)) or report.is_faulty(("model",))):
        report.error(
            "RG013",
            "no motion group",
            (),
            help="give `model:` (see `rapidgen robots`), or `urdf:` and `joints:`",
        )
    basic = configuration.profile == "basic"
    groups = [
        _group(index, configuration, draft, report, basic=basic)
        for index, draft in enumerate(drafts)
    ]
    _check_ports(configuration, groups, report)
    _check_tasks(groups, report)
    check_partners(groups, report)
    if report.failed:
        return None
    settings = configuration.trajectory
    return model.RobotConfig(
        name=configuration.name or _name_of(path),
        path=path,
        controller=configuration.controller.type,
        robotware=configuration.controller.robotware,
        multimove=configuration.controller.multimove,
        cfg_header=tuple(
            (domain, int(text.partition(":")[0]), int(text.partition(":")[2]))
            for domain, text in configuration.controller.cfg_header.items()
        ),
        groups=tuple(groups),
        trajectory=model.TrajectoryPolicy(
            **{
                **vars(settings),
                "start_tolerance": math.radians(settings.start_tolerance),
                "start_tolerance_linear": settings.start_tolerance_linear / 1000,
                "pose_tolerance": settings.pose_tolerance / 1000,
                **(_one_size(settings.zone) if basic else {}),
            }
        ),
        state_period=1 / configuration.state.rate,
        bind=configuration.network.bind,
        allowed_clients=tuple(configuration.network.allowed_clients),
        receive_timeout=configuration.network.receive_timeout,
        commissioning=configuration.commissioning,
        profile=configuration.profile,
        call_main=configuration.main == "driver",
        signals=tuple(
            model.ExposedSignal(name, signal.kind, signal.access)
            for name, signal in configuration.signals.items()
        ),
        generations=tuple(configuration.generations),
    )


def _name_of(path: Path) -> str:
    saved = "".join(c if c.isascii() and (c.isalnum() or c in "_-") else "_" for c in path.stem)
    return (saved if saved[:1].isalpha() else f"robot_{saved}")[:40]


def _check_controller(configuration: schema.ConfigurationKeys, report: DraftFindings) -> None:
    controller = configuration.controller
    main = controller.robotware[0]
    path: KeyPath = ("controller", "robotware")
    if main not in GENERATIONS[controller.type]:
        fits = " and ".join(str(n) for n in GENERATIONS[controller.type])
        report.error(
            "RG011",
            f"controller '{controller.type}' does not run RobotWare {main}",
            path,
            f"'{controller.type}' runs RobotWare {fits}",
            "IRC5 runs RobotWare 5 and 6, OmniCore 7 and 8; set controller.type or "
            "controller.robotware",
        )
    elif configuration.generations and main not in configuration.generations:
        known = ", ".join(str(n) for n in configuration.generations)
        report.add(
            "RG017",
            Severity.WARNING,
            f"this robot is not known to exist with RobotWare {main}",
            path,
            f"known: RobotWare {known}",
            "check the version on the FlexPendant (Settings or System Info)",
        )


def _one_size(zone: str) -> dict[str, str]:
    """Return the corners of the basic profile.

    All have one size, z10 at most, as those of abb_driver.
    """
    return {"corners": "zone", "zone": zone if zone in _SMALL_ZONES else "z10"}


def _check_profile(configuration: schema.ConfigurationKeys, report: DraftFindings) -> None:
    """Check that the profile has what the file asks for.

    The basic profile has no control server.
    """
    if configuration.profile == "full":
        return
    requested: list[KeyPath] = [("signals",)] if configuration.signals else []
    requested += [
        ("groups", name, "ports", "control")
        for name, group in configuration.groups.items()
        if group.ports.control
    ]
    requested += [
        ("groups", name, "data") for name, group in configuration.groups.items() if group.data
    ]
    for path in requested:
        report.error(
            "RG014",
            f"`{path[-1]}` is of the full profile",
            path,
            help="leave out `profile: basic`, or this",
        )


def _check_network(configuration: schema.ConfigurationKeys, report: DraftFindings) -> None:
    addresses: list[tuple[KeyPath, str]] = [
        (("network", "allowed_clients", index), address)
        for index, address in enumerate(configuration.network.allowed_clients)
    ]
    if configuration.network.bind not in ("lan", "service"):
        addresses.append((("network", "bind"), configuration.network.bind))
    for path, address in addresses:
        if is_host(address):
            continue
        if path[-1] == "bind":
            help = (
                "the controller's own address, `lan` or `service`: an empty value means all of them"
            )
        else:
            help = "the address of one machine, such as 192.168.1.10, as the controller writes it"
        report.error("RG006", f"'{address}' is not the IPv4 address of a machine", path, help=help)


def _check_signals(configuration: schema.ConfigurationKeys, report: DraftFindings) -> None:
    seen: dict[str, str] = {}
    for name, signal in configuration.signals.items():
        if signal.access == "write" and signal.kind.endswith("I"):
            report.error(
                "RG006",
                f"signal '{name}' is an input and cannot be written",
                ("signals", name, "access"),
                "",
                "RAPID sets outputs only: DO, GO, AO",
            )
        first = seen.setdefault(name.casefold(), name)
        if first != name:
            report.error(
                "RG014",
                f"'{name}' and '{first}' are one name to RAPID",
                ("signals", name),
                help="keep one of the two",
                key=True,
            )


def _group(
    index: int,
    configuration: schema.ConfigurationKeys,
    draft: GroupDraft,
    report: DraftFindings,
    *,
    basic: bool,
) -> model.GroupConfig:
    path: KeyPath = ("groups", draft.name)
    keys = configuration.groups[draft.name]
    joints = joints_of(keys, draft, path, report)
    saved = resolve_held_axes(draft, dict(keys.held_axes.items()), path, report)
    names = {joint.name for joint in draft.joints}
    _check_ceiling(keys.tcp_speed_limit, (*path, "tcp_speed_limit"), report)
    if report.is_faulty((*path, "joints")):
        # The joints are not known: no chain can be checked against them.
        report.mute((*path, "chain"))
        report.mute((*path, "positioners"))
    _chain(draft.chain, (*path, "chain"), names, "`joints`", report)
    _check_angles(keys, path, report)
    _check_sizes(keys, path, report)
    external = {joint.name for joint in joints if joint.axis.startswith("eax")}
    for unit, chain in list(draft.positioners.items()):
        where: KeyPath = (*path, "positioners", unit)
        moved = {step.joint for step in chain if step.joint}
        if _is_shipped(where, draft.model, report) and not (
            unit in keys.external_units and moved <= external
        ):
            del draft.positioners[unit]  # a positioner of the model that this cell lacks
            continue
        if unit not in keys.external_units:
            report.error(
                "RG014",
                f"'{unit}' is not in `external_units`",
                where,
                help="name it there, or leave its chain out",
                key=True,
            )
        if not moved:
            report.error(
                "RG014",
                f"no joint moves '{unit}'",
                where,
                help="name the joint of an external axis in one of its steps: `joint: NAME`",
            )
        _chain(chain, where, external, "the external axes of `joints`", report)
    ports = keys.ports
    arm = _arm(draft)
    return model.GroupConfig(
        name=draft.name,
        task=keys.task or f"T_ROB{index + 1}",
        mechanical_unit=keys.mechanical_unit or f"ROB_{index + 1}",
        joints=joints,
        ports=model.Ports(
            *(
                value if value is not None else default + PORT_STEP * index
                for value, default in zip(
                    (ports.motion, 0 if basic else ports.control, ports.state),
                    DEFAULT_PORTS,
                    strict=True,
                )
            )
        ),
        model=draft.model,
        chain=tuple(draft.chain),
        coupling=draft.coupling or 0.0,
        tool=tool_of(keys.tool, (*path, "tool"), report, arm),
        payload=model.Payload(keys.payload.name, keys.payload.given_by == "TLoad"),
        work_object=work_object_of(keys.work_object, (*path, "work_object"), report, arm),
        tools=tuple(
            tool_of(tool, (*path, "tools", number), report, arm)
            for number, tool in enumerate(keys.tools)
        ),
        work_objects=tuple(
            work_object_of(wobj, (*path, "work_objects", number), report, arm)
            for number, wobj in enumerate(keys.work_objects)
        ),
        routines=tuple(
            routine_of(name, routine, (*path, "routines", name), report, bool(draft.chain))
            for name, routine in keys.routines.items()
        ),
        data=data_of(keys, path, report),
        tcp_speed_limit=keys.tcp_speed_limit / 1000,
        external_units=tuple(keys.external_units),
        positioners=tuple(
            model.Positioner(unit, tuple(chain)) for unit, chain in draft.positioners.items()
        ),
        kept=saved,
        max_payload=draft.max_payload,
        inertias=inertias_of(keys, draft, report),
        acceleration_source=keys.source.get("accelerations", ""),
        egm=egm_of(index, configuration, joints, path, report),
    )


def _arm(draft: GroupDraft) -> Arm:
    """Return the known figures of the arm."""
    linear = [j for j in draft.joints if j.unit == "mm"]
    ways = sum((j.upper or 0.0) - (j.lower or 0.0) for j in linear) / 1000
    reach = length_of(draft.chain)
    name = draft.model or draft.arm or draft.name
    return Arm(name, draft.max_payload, reach + ways if reach else 0.0)


def _check_angles(keys: schema.GroupKeys, path: KeyPath, report: DraftFindings) -> None:
    """Report rad where deg are meant (RG071)."""
    angles: list[tuple[KeyPath, float]] = [
        ((*path, "chain", number, "rpy", place), angle)
        for number, step in enumerate(keys.chain)
        for place, angle in enumerate(step.rpy)
    ]
    angles += [
        ((*path, "positioners", unit, number, "rpy", place), angle)
        for unit, chain in keys.positioners.items()
        for number, step in enumerate(chain)
        for place, angle in enumerate(step.rpy)
    ]
    angles += [((*path, "held_axes", axis), value or 0.0) for axis, value in keys.held_axes.items()]
    for where, angle in angles:
        if is_radians(angle):
            report.add(
                "RG071",
                Severity.WARNING,
                f"an angle of {angle:g} deg",
                where,
                "rad?",
                f"the unit is deg: {angle:g} rad are {math.degrees(angle):.4g}",
            )


def _check_sizes(keys: schema.GroupKeys, path: KeyPath, report: DraftFindings) -> None:
    """Report m where mm are meant (RG071), and g where kg are meant (RG070)."""
    length = sum(math.hypot(*step.xyz) for step in keys.chain)
    if 0 < length < _SHORTEST_CHAIN:
        report.add(
            "RG071",
            Severity.WARNING,
            f"a chain of {length:g} mm",
            (*path, "chain"),
            help=f"the unit is mm: {length:g} m are {length * 1000:g}",
        )
    if keys.max_payload and (doubt := payload_doubt(keys.max_payload)):
        message, help = doubt
        report.add("RG070", Severity.WARNING, message, (*path, "max_payload"), help=help)


def _check_ceiling(limit: float, path: KeyPath, report: DraftFindings) -> None:
    """Report m/s where mm/s are meant (RG006).

    A path of some cm would take minutes.
    """
    if limit < SLOWEST_TCP:
        report.error(
            "RG006",
            f"'tcp_speed_limit': {limit:g} mm/s is no speed to work with",
            path,
            f"less than {SLOWEST_TCP} mm/s",
            f"the unit is mm/s: {limit:g} m/s is {1000 * limit:g}",
        )


def _is_shipped(path: KeyPath, name: str, report: DraftFindings) -> bool:
    """True if a part is the same as in the shipped model."""
    if not name:
        return False
    place = report.span(path, key=True).path
    return place == label(name) or Path(place).resolve() == find_shipped(name).resolve()


def _chain(
    chain: list[model.ChainLink], path: KeyPath, names: set[str], among: str, report: DraftFindings
) -> None:
    for number, step in enumerate(chain):
        if step.axis == (0.0, 0.0, 0.0):
            where = (*path, number, "axis")
            report.error(
                "RG014",
                f"chain step {number + 1} has an axis of length 0",
                where,
                help="write the direction that it turns about or slides along, such as [0, 0, 1]",
            )
        for name in (step.joint, *(joint for joint, _ in step.follows)):
            if name and name not in names:
                report.error(
                    "RG014",
                    f"chain step {number + 1} names the joint '{name}', which is not in {among}",
                    (*path, number, "joint"),
                    help=suggest(name, sorted(names))
                    or f"there are: {', '.join(sorted(names)) or 'none'}",
                )


def _check_ports(
    configuration: schema.ConfigurationKeys, groups: list[model.GroupConfig], report: DraftFindings
) -> None:
    users: dict[int, str] = {}
    for group in groups:
        value = configuration.groups[group.name].ports
        for name in ("motion", "control", "state"):
            port = getattr(group.ports, name)
            if not port:
                continue
            path: KeyPath = ("groups", group.name, "ports", name)
            if port in users:
                report.error(
                    "RG012",
                    f"port {port} is used twice: {users[port]} and {group.name}.{name}",
                    path,
                    help="give one of the two another one under `ports:` of its group",
                )
            users.setdefault(port, f"{group.name}.{name}")
            if getattr(value, name) is not None and port > _PLAIN_PORTS_END:
                report.add(
                    "RG018",
                    Severity.INFO,
                    f"port {port} is above {_PLAIN_PORTS_END}",
                    path,
                    "",
                    "controllers in the field serve 11000 and 11002; only if SocketBind fails, "
                    "take one of 1025-4999, the range of an older manual",
                )


def _check_tasks(groups: list[model.GroupConfig], report: DraftFindings) -> None:
    for name in ("task", "mechanical_unit"):
        users: dict[str, str] = {}
        for group in groups:
            value = str(getattr(group, name)).upper()
            if value in users:
                report.error(
                    "RG012",
                    f"groups '{users[value]}' and '{group.name}' share the {name} {value}",
                    ("groups", group.name, name),
                    help=f"each group needs a `{name}:` of its own",
                )
            users.setdefault(value, group.name)
