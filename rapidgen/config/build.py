"""The validated file becomes the frozen model: units, defaults, and what the schema cannot see."""

import math
from pathlib import Path

from rapidgen.config import model, schema
from rapidgen.config.draft import Findings, GroupDraft, JointDraft
from rapidgen.config.draft import Path as KeyPath
from rapidgen.config.registry import find_shipped
from rapidgen.diagnostics import Severity

GENERATIONS = {
    "irc5": (5, 6),
    "irc5_compact": (5, 6),
    "omnicore": (7, 8),
    "virtual": (5, 6, 7, 8),
}
MAX_JOINTS = 10
DEFAULT_PORTS = (11000, 11001, 11002)
PORT_STEP = 10
_PLAIN_PORTS_END = 4999


def build(
    configuration: schema.ConfigurationKeys,
    drafts: list[GroupDraft],
    path: Path,
    report: Findings,
) -> model.RobotConfig | None:
    """The model, or None when `report` holds errors; `path` is the file it is named after."""
    _check_controller(configuration, report)
    _check_network(configuration, report)
    if not configuration.groups and not report.is_faulty(("groups",)):
        report.error(
            "RG013",
            "no motion group",
            (),
            help="give `model:` (see `rapidgen robots`), or `urdf:` and `joints:`",
        )
    groups = [
        _group(index, configuration.groups[draft.name], draft, report)
        for index, draft in enumerate(drafts)
    ]
    _check_ports(configuration, groups, report)
    _check_tasks(groups, report)
    if report.failed:
        return None
    settings = configuration.trajectory
    return model.RobotConfig(
        name=configuration.name or _name_of(path),
        path=path,
        controller=configuration.controller.type,
        robotware=configuration.controller.robotware,
        groups=tuple(groups),
        trajectory=model.TrajectoryPolicy(
            capacity=settings.capacity,
            zone=settings.zone,
            start_tolerance=math.radians(settings.start_tolerance),
            start_tolerance_linear=settings.start_tolerance_linear / 1000,
            too_fast=settings.too_fast,
            min_segment=settings.min_segment,
            approach_speed=settings.approach_speed,
            ring=settings.ring,
            preload=settings.preload,
            corners=settings.corners,
        ),
        state_period=1 / configuration.state.rate,
        bind=configuration.network.bind,
        allowed_clients=tuple(configuration.network.allowed_clients),
        receive_timeout=configuration.network.receive_timeout,
        commissioning=configuration.commissioning,
        call_main=configuration.main == "driver",
        signals=tuple(
            model.ExposedSignal(name, signal.kind, signal.access)
            for name, signal in configuration.signals.items()
        ),
        generations=tuple(configuration.generations),
    )


def _name_of(path: Path) -> str:
    kept = "".join(c if c.isascii() and (c.isalnum() or c in "_-") else "_" for c in path.stem)
    return (kept if kept[:1].isalpha() else f"robot_{kept}")[:40]


def _check_controller(configuration: schema.ConfigurationKeys, report: Findings) -> None:
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


def _check_network(configuration: schema.ConfigurationKeys, report: Findings) -> None:
    addresses: list[tuple[KeyPath, str]] = [
        (("network", "allowed_clients", index), address)
        for index, address in enumerate(configuration.network.allowed_clients)
    ]
    if configuration.network.bind not in ("lan", "service"):
        addresses.append((("network", "bind"), configuration.network.bind))
    for path, address in addresses:
        parts = address.split(".")
        if len(parts) != 4 or not all(
            p.isascii() and p.isdigit() and len(p) <= 3 and int(p) <= 255 for p in parts
        ):
            report.error("RG006", f"'{address}' is not an IPv4 address", path)
    for name, signal in configuration.signals.items():
        if signal.access == "write" and signal.kind.endswith("I"):
            report.error(
                "RG006",
                f"signal '{name}' is an input and cannot be written",
                ("signals", name, "access"),
                "",
                "RAPID sets outputs only: DO, GO, AO",
            )


def _group(
    index: int, keys: schema.GroupKeys, draft: GroupDraft, report: Findings
) -> model.GroupConfig:
    path: KeyPath = ("groups", draft.name)
    joints = _joints(keys, draft, path, report)
    names = {joint.name for joint in draft.joints}
    _chain(draft.chain, (*path, "chain"), names, "`joints`", report)
    external = {joint.name for joint in joints if joint.axis.startswith("eax")}
    for unit, chain in list(draft.positioners.items()):
        where: KeyPath = (*path, "positioners", unit)
        moved = {step.joint for step in chain if step.joint}
        if _is_shipped(where, draft.model, report) and not (
            unit in keys.external_units and moved <= external
        ):
            del draft.positioners[unit]  # the model's, and this cell has none
            continue
        if unit not in keys.external_units:
            report.error("RG014", f"'{unit}' is not in `external_units`", where, key=True)
        if not moved:
            report.error("RG014", f"no joint moves '{unit}'", where)
        _chain(chain, where, external, "the external axes of `joints`", report)
    ports = keys.ports
    return model.GroupConfig(
        name=draft.name,
        task=keys.task or f"T_ROB{index + 1}",
        mechanical_unit=keys.mechanical_unit or f"ROB_{index + 1}",
        joints=joints,
        ports=model.Ports(
            *(
                given if given is not None else default + PORT_STEP * index
                for given, default in zip(
                    (ports.motion, ports.control, ports.state), DEFAULT_PORTS, strict=True
                )
            )
        ),
        model=draft.model,
        chain=tuple(draft.chain),
        coupling=draft.coupling or 0.0,
        tool=_tool(keys.tool, (*path, "tool"), report),
        work_object=_work_object(keys.work_object, (*path, "work_object"), report),
        tcp_speed_limit=keys.tcp_speed_limit / 1000,
        external_units=tuple(keys.external_units),
        positioners=tuple(
            model.Positioner(unit, tuple(chain)) for unit, chain in draft.positioners.items()
        ),
    )


def _is_shipped(path: KeyPath, name: str, report: Findings) -> bool:
    """Whether a part is as the shipped model has it."""
    if not name:
        return False
    return Path(report.span(path, key=True).path).resolve() == find_shipped(name).resolve()


def _chain(
    chain: list[model.ChainLink], path: KeyPath, names: set[str], among: str, report: Findings
) -> None:
    for number, step in enumerate(chain):
        if step.axis == (0.0, 0.0, 0.0):
            where = (*path, number, "axis")
            report.error("RG014", f"chain step {number + 1} has an axis of length 0", where)
        for name in (step.joint, *(joint for joint, _ in step.follows)):
            if name and name not in names:
                report.error(
                    "RG014",
                    f"chain step {number + 1} names the joint '{name}', which is not in {among}",
                    (*path, number, "joint"),
                )


def _joints(
    keys: schema.GroupKeys, draft: GroupDraft, path: KeyPath, report: Findings
) -> tuple[model.Joint, ...]:
    where: KeyPath = (*path, "joints")
    if not draft.joints:
        report.error(
            "RG013",
            f"group '{draft.name}' has no joints",
            where,
            help="give `model:` (see `rapidgen robots`), `urdf:` or `joints:`",
        )
    elif len(draft.joints) > MAX_JOINTS:
        report.error(
            "RG013",
            f"group '{draft.name}' has {len(draft.joints)} joints; the wire carries {MAX_JOINTS}",
            where,
            help="a message of simple_message holds 10 joint values: make two groups",
        )
    _check_radians(draft, where, report)
    seen: dict[str, str] = {}
    joints = []
    for joint in draft.joints:
        here: KeyPath = (*where, joint.name)
        if joint.axis in seen:
            report.error(
                "RG013",
                f"joints '{seen[joint.axis]}' and '{joint.name}' both drive {joint.axis}",
                (*here, "axis"),
                "second time",
            )
        if joint.axis:
            seen.setdefault(joint.axis, joint.name)
        made = _joint(joint, keys.acceleration_time, here, report)
        if made:
            joints.append(made)
    return tuple(joints)


def _check_radians(draft: GroupDraft, path: KeyPath, report: Findings) -> None:
    """Four and more turning axes that all stay within 7: radians, not degrees."""
    turning = [joint for joint in draft.joints if joint.unit != "mm"]
    ends = [end for joint in turning for end in (joint.lower, joint.upper) if end is not None]
    if len(turning) >= 4 and len(ends) == 2 * len(turning) and max(map(abs, ends)) <= 7:
        report.add(
            "RG037",
            Severity.WARNING,
            f"no axis of group '{draft.name}' turns more than {max(map(abs, ends)):g} degrees",
            path,
            "radians?",
            "a configuration has degrees, as ABB's data sheets",
            key=True,
        )


def _joint(draft: JointDraft, ramp: float, path: KeyPath, report: Findings) -> model.Joint | None:
    missing = [
        name
        for name in ("axis", "lower", "upper", "speed")
        if getattr(draft, name) in (None, "") and not report.is_faulty((*path, name))
    ]
    if missing:
        unit = "mm" if draft.unit == "mm" else "deg"
        hints = {
            "axis": "`axis:` is rax_1 to rax_6 or eax_a to eax_f",
            "lower": f"limits are in {unit}",
            "upper": f"limits are in {unit}",
            "speed": f"`speed:` is in {unit}/s",
        }
        report.error(
            "RG007",
            f"joint '{draft.name}' lacks {', '.join(missing)}",
            path,
            "here",
            "; ".join(dict.fromkeys(hints[name] for name in missing)),
            key=True,
        )
    if draft.lower is None or draft.upper is None or draft.speed is None:
        return None
    if draft.lower >= draft.upper:
        report.error(
            "RG014",
            f"joint '{draft.name}': lower limit {draft.lower:g} is not below the upper limit "
            f"{draft.upper:g}",
            (*path, "upper"),
        )
        return None
    lower, upper = inwards(draft.lower, draft.upper)
    factor = 0.001 if draft.unit == "mm" else math.pi / 180
    acceleration = draft.acceleration if draft.acceleration else draft.speed / ramp
    return model.Joint(
        name=draft.name,
        axis=draft.axis,
        kind="prismatic" if draft.unit == "mm" else "revolute",
        lower=_si(lower, draft.unit),
        upper=_si(upper, draft.unit),
        speed=_si(draft.speed, draft.unit),
        acceleration=acceleration * factor,
        sign=draft.sign,
        offset=_si(draft.offset, draft.unit),
        source=draft.source,
        unsure=bool(draft.unsure),
    )


def _si(value: float, unit: str) -> float:
    return value / 1000 if unit == "mm" else math.radians(value)


def inwards(lower: float, upper: float) -> tuple[float, float]:
    """Limits rounded inwards to 0.01 (deg or mm); noise below 1e-6 does not count."""
    return math.ceil(lower * 100 - 1e-4) / 100, math.floor(upper * 100 + 1e-4) / 100


def _unit_quaternion(
    values: list[float], path: KeyPath, report: Findings
) -> tuple[float, float, float, float]:
    norm = math.sqrt(sum(v * v for v in values))
    if abs(norm - 1) > 1e-3:
        report.error(
            "RG014",
            f"{values} is not a unit quaternion (its length is {norm:.4g})",
            path,
            help="q1 is the scalar; [1, 0, 0, 0] turns nothing",
        )
        return (1.0, 0.0, 0.0, 0.0)
    exact = abs(norm - 1) < 1e-12
    q1, q2, q3, q4 = (v if exact else v / norm for v in values)
    return (q1, q2, q3, q4)


def _metres(values: list[float]) -> tuple[float, float, float]:
    x, y, z = (v / 1000 for v in values)
    return (x, y, z)


def _frame(frame: schema.FrameKeys, path: KeyPath, report: Findings) -> model.Placement:
    return model.Placement(
        _metres(frame.position),
        _unit_quaternion(frame.orientation, (*path, "orientation"), report),
    )


def _tool(tool: schema.ToolKeys, path: KeyPath, report: Findings) -> model.Tool:
    load = tool.load
    if tool.name == "tool0" and tool != schema.ToolKeys():
        report.error(
            "RG014",
            "tool0 is the controller's own and cannot be described",
            path,
            help="give the tool another `name:`",
            key=True,
        )
    elif tool.name != "tool0" and load.mass <= 0:
        report.error(
            "RG014",
            f"tool '{tool.name}' weighs nothing",
            (*path, "load", "mass"),
            help="a controller refuses to move with a tool without mass: add `load: {mass: ...}`",
        )
    x, y, z = load.inertia
    return model.Tool(
        tool.name,
        tool.held,
        _frame(tool.frame, (*path, "frame"), report),
        model.Load(
            load.mass,
            _metres(load.centre),
            _unit_quaternion(load.axes, (*path, "load", "axes"), report),
            (x, y, z),
        ),
    )


def _work_object(given: schema.WorkObjectKeys, path: KeyPath, report: Findings) -> model.WorkObject:
    if given.name == "wobj0" and given != schema.WorkObjectKeys():
        report.error(
            "RG014",
            "wobj0 is the controller's own and cannot be described",
            path,
            help="give the work object another `name:`",
            key=True,
        )
    return model.WorkObject(
        given.name,
        given.held,
        _frame(given.user_frame, (*path, "user_frame"), report),
        _frame(given.object_frame, (*path, "object_frame"), report),
    )


def _check_ports(
    configuration: schema.ConfigurationKeys, groups: list[model.GroupConfig], report: Findings
) -> None:
    users: dict[int, str] = {}
    for group in groups:
        given = configuration.groups[group.name].ports
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
                )
            users.setdefault(port, f"{group.name}.{name}")
            if getattr(given, name) is not None and port > _PLAIN_PORTS_END:
                report.add(
                    "RG018",
                    Severity.INFO,
                    f"port {port} is above {_PLAIN_PORTS_END}",
                    path,
                    "",
                    "controllers in the field serve 11000 and 11002; only if SocketBind fails, "
                    "take one of 1025-4999, the range of an older manual",
                )


def _check_tasks(groups: list[model.GroupConfig], report: Findings) -> None:
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
