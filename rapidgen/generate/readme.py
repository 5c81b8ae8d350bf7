"""Contents of a generated folder's README: tasks, ports, joints, signals."""

import math

from rapidgen import __version__
from rapidgen.config.model import EgmSettings, GroupConfig, RobotConfig
from rapidgen.generate import layout
from rapidgen.generate.context import to_rapid
from rapidgen.generate.numbers import inward, literal
from rapidgen.generate.parameters import OPEN_FILES
from rapidgen.system import System

_TRUST = {"SysFail": "SysFail", "SysStop": "SysStop", "NoSafety": "None (no safety)"}


def readme_context(config: RobotConfig, system: System, build_id: str) -> dict[str, object]:
    """Return the context of README.md.j2."""
    major, minor = config.robotware
    opened = layout.open_signals(config)
    return {
        "name": config.name,
        "version": __version__,
        "build": build_id,
        "robotware": f"{major}.{minor:02d}",
        "major": major,
        "omnicore": major >= 7,
        "collision_parameter": config.robotware >= (6, 4),
        "address": _address(config.groups[0]),
        "yumi": all(group.model == "irb14000" for group in config.groups),
        "multi": len(config.groups) > 1,
        "guided": any(group.egm for group in config.groups),
        "world_zones": any(group.world_zones for group in config.groups),
        "commissioning": config.commissioning,
        "full": config.profile == "full",
        "call_main": config.call_main,
        "bind": config.bind,
        "allowed": config.allowed_clients,
        "capacity": config.trajectory.capacity,
        "period_ms": literal(config.state_period * 1000),
        "rate": literal(round(1 / config.state_period, 2)),
        "policy": config.trajectory.too_fast,
        "min_segment": literal(config.trajectory.min_segment),
        "zone": config.trajectory.zone,
        "corners": config.trajectory.corners,
        "ring": config.trajectory.ring,
        "preload": literal(config.trajectory.preload),
        "exposed": [{"name": s.name, "kind": s.kind, "access": s.access} for s in config.signals],
        "tasks": [
            {
                "name": task.name,
                "type": task.type,
                "trust": _TRUST[task.trust],
                "group": task.mechanical_unit_group,
                "modules": ", ".join(m.name for m in task.modules),
                "motion": task.motion,
            }
            for task in system.tasks
        ],
        "signals": [
            {
                "name": o.signal,
                "status": o.status,
                "argument": o.unit or o.task,
                "open": o.signal in opened,
            }
            for o in system.outputs
        ],
        "opened": OPEN_FILES if opened else (),
        "events": [{"event": e.event, "routine": e.routine, "task": e.task} for e in system.events],
        "groups": [_group(config, n) for n in range(len(config.groups))],
        "folder": layout.FOLDER,
        "folders": sorted(
            {m.target.rpartition("/")[0] for task in system.tasks for m in task.modules}
        ),
    }


def _address(group: GroupConfig) -> str:
    """Return a group's address for the command line."""
    return f"ROBOT:{group.ports.motion},{group.ports.state}"


def _egm(egm: EgmSettings) -> dict[str, object]:
    return {
        "device": egm.device,
        "address": egm.address,
        "port": egm.port,
        "max_deviation": literal(round(math.degrees(egm.max_deviation), 4)),
        "max_speed": literal(round(math.degrees(egm.max_speed), 4)),
    }


def _elsewhere(group: GroupConfig) -> list[dict[str, str]]:
    """Return the data that the user's motion task has to declare."""
    result = [(t.name, "PERS tooldata") for t in (group.tool, *group.tools) if t.elsewhere]
    result += [
        (w.name, "PERS wobjdata") for w in (group.work_object, *group.work_objects) if w.elsewhere
    ]
    if group.payload.name != "load0":
        result.append((group.payload.name, "PERS loaddata"))
    result += [(r.call, f"FUNC {r.returns}") for r in group.routines if r.returns]
    return [{"name": name, "what": what} for name, what in dict.fromkeys(result)]


def _group(config: RobotConfig, n: int) -> dict[str, object]:
    group = config.groups[n]
    return {
        "name": group.name,
        "model": group.model,
        "task": group.task,
        "unit": group.mechanical_unit,
        "ports": group.ports,
        "coupling": literal(group.coupling),
        "coupled": group.coupling != 0,
        "address": _address(group),
        "elsewhere": _elsewhere(group),
        "tool": group.tool.name,
        "light_tool": group.tool.load.mass <= 0.001 and not group.tool.elsewhere,
        "x": layout.suffix(config, group),
        "joints": [
            {
                "name": joint.name,
                "axis": joint.axis,
                "unit": "deg" if joint.kind == "revolute" else "mm",
                "low": literal(inward(to_rapid(joint, joint.lower), up=True)),
                "high": literal(inward(to_rapid(joint, joint.upper), up=False)),
                "speed": literal(round(to_rapid(joint, joint.speed), 4)),
                "sign": joint.sign,
                "offset": literal(round(to_rapid(joint, joint.offset), 6)),
                "source": joint.source,
                "unsure": joint.unsure,
            }
            for joint in group.joints
        ],
        "egm": None if group.egm is None else _egm(group.egm),
        "data": [{"name": d.name, "type": d.type, "access": d.access} for d in group.data],
        "kept": [
            {"n": axis.axis[-1], "at": literal(math.degrees(axis.value)) if axis.must_stand else ""}
            for axis in group.kept
        ],
    }
