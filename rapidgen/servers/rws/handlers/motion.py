"""Mechanical units: joints and poses as RAPID has them, degrees and mm."""

from typing import TYPE_CHECKING

from rapidgen.axes.mapping import ABSENT
from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.builtins.motion.positions import tool0
from rapidgen.runtime.builtins.motion.targets import carrier_of, joint_target, rob_target
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.motion_interface import NO_OFFSETS
from rapidgen.runtime.values import Value
from rapidgen.servers.rws.handlers.tasks import find_task
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext

_AXES = ("rax_1", "rax_2", "rax_3", "rax_4", "rax_5", "rax_6")
_EXTERNAL = "abcdef"


def find_group(context: "RwsContext", request: RwsRequest) -> MotionGroup:
    """Return the robot of a request.

    RequestDenied: there is none of that name.
    """
    name = request.names["unit"]
    for group in context.controller.motion.groups.values():
        if group.config.mechanical_unit.lower() == name.lower():
            return group
    raise RequestDenied(404, "E_NO_SUCH_MECHUNIT", name)


@serves(ops.MECHUNITS)
def get_units(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return robots; single units are not listed."""
    groups = context.controller.motion.groups.values()
    names = [group.config.mechanical_unit for group in groups]
    result = (Item("ms-mechunit-li", n, {"mode": "Activated"}) for n in names if n)
    return show(*result, collection=True)


_STATIC = ("type", "task-name", "axes", "axes-total", "is-integrated-unit", "has-integrated-unit")


@serves(ops.MECHUNIT)
def get_unit(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return one robot with its choices for jogging.

    `resource` selects parts of it.
    """
    group = find_group(context, request)
    count, chosen = (
        str(len(group.config.joints)),
        context.chosen.get(group.config.mechanical_unit, {}),
    )
    notify = {
        "tool-name": chosen.get("tool", "tool0"),
        "wobj-name": chosen.get("wobj", "wobj0"),
        "payload-name": chosen.get("payload", "load0"),
        "total-payload-name": chosen.get("total-payload", "load0"),
        "status": "Synchronized",
        "mode": chosen.get("mode", "Activated"),
        "jog-mode": chosen.get("jog-mode", "Cartesian"),
        "coord-system": chosen.get("coord-system", "World"),
        "type": "TCPRobot",
        "task-name": group.config.task,
        "axes": count,
        "axes-total": count,
        "is-integrated-unit": "NoIntegratedUnit",
        "has-integrated-unit": "NoIntegratedUnit",
    }
    parts = {
        p for p in (request.query.get("resource", ""), request.suffix) for p in p.split(";") if p
    }
    if parts:
        notify = {name: value for name, value in notify.items() if _is_asked(name, parts)}
    return show(Item("ms-mechunit", group.config.mechanical_unit, notify))


def _is_asked(name: str, parts: set[str]) -> bool:
    short = {name, name.removesuffix("-name"), name.removesuffix("-unit")}
    return bool(short & parts) or ("static" if name in _STATIC else "dynamic") in parts


@serves(ops.JOINT_TARGET)
def get_joints(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the joints."""
    group = find_group(context, request)
    value = joint_target(group.map, group.positions())
    notify = dict(zip(_AXES, map(str, value.robax.values()), strict=True))
    external = zip(_EXTERNAL, value.extax.values(), strict=True)
    notify |= {f"eax_{letter}": f"{v:g}" for letter, v in external}
    return show(Item("ms-jointtarget", "jointtarget", notify))


def _pose(context: "RwsContext", request: RwsRequest) -> Value:
    """Return the TCP of a tool in a work object.

    `Base` equals the world here: robots are at its origin unless their object says otherwise.
    """
    return _pose_of(context, request, find_group(context, request))


def _pose_of(
    context: "RwsContext", request: RwsRequest, group: MotionGroup, default: str = "base"
) -> Value:
    frame = request.query.get("coordinate", default).lower()
    if frame not in ("base", "world", "wobj"):
        raise RequestDenied(400, "E_INVALIDARG", f"coordinate {frame}")
    tool = _datum(context, group, request.query.get("tool", "tool0"), "tooldata") or tool0()
    name = request.query.get("wobj", "wobj0") if frame == "wobj" else "wobj0"
    work_object = _datum(context, group, name, "wobjdata")
    try:
        return rob_target(
            group, group.positions(), carrier_of(group, tool, work_object), NO_OFFSETS
        )
    except RapidError as error:
        raise RequestDenied(400, "E_INVALIDARG", error.name) from error


def _datum(context: "RwsContext", group: MotionGroup, name: str, kind: str) -> Value | None:
    """Return a tool or object of the robot's task.

    Without a name it is tool0 or wobj0. RequestDenied: there is none.
    """
    if name.lower() in ("tool0", "wobj0"):
        return None
    task = context.controller.tasks[group.config.task]
    try:
        if task.type_of(name)[0].name != kind:
            raise RequestDenied(400, "E_INVALIDARG", f"{name} is no {kind}")
        return task[name]
    except KeyError as error:
        raise RequestDenied(400, "E_NO_SUCH_SYMBOL", name) from error


@serves(ops.ROB_TARGET)
def get_target(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the TCP as a robtarget."""
    return show(Item("ms-robtargets", "robtarget", _rob_target(_pose(context, request))))


def _rob_target(value: Value, external: str = "") -> dict[str, str]:
    """Return a robtarget's fields.

    `external` is the spelling of external axes, by number from 1.
    """
    notify = dict(zip(("x", "y", "z"), map(str, value.trans.values()), strict=True))
    notify |= dict(zip(("q1", "q2", "q3", "q4"), map(str, value.rot.values()), strict=True))
    conf = ("cf1", "cf4", "cf6", "cfx")
    notify |= dict(zip(conf, (f"{v:g}" for v in value.robconf.values()), strict=True))
    names = [external.format(i) if external else f"eax{c}" for i, c in enumerate(_EXTERNAL, 1)]
    return notify | dict(zip(names, (f"{v:g}" for v in value.extax.values()), strict=True))


@serves(ops.CARTESIAN)
def get_cartesian(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the TCP; RWS 1.0 calls the configuration j1 to jx."""
    value = _pose(context, request)
    names = ("j1", "j4", "j6", "jx") if request.is_one else ("cf1", "cf4", "cf6", "cfx")
    notify = dict(zip(("x", "y", "z"), map(str, value.trans.values()), strict=True))
    notify |= dict(zip(("q1", "q2", "q3", "q4"), map(str, value.rot.values()), strict=True))
    notify |= dict(zip(names, (f"{v:g}" for v in value.robconf.values()), strict=True))
    return show(Item("ms-mechunit-cartesian", "cartesian", notify))


# -- by task -------------------------------------------------------------------------------------


@serves(ops.TASK_MOTION)
def get_motion(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return positions of a task's robot [RWS manual 3HAC050973].

    Without `resource` it is the list of resources.
    """
    task = find_task(context, request.names["task"], request)
    kind = request.query.get("resource", "")
    if not kind:
        names = ("jointtarget", "robtarget", "extjointstate")
        return show(
            *(Item(f"rapid-{n}-li", n, {}, {"self": f"motion?resource={n}"}) for n in names)
        )
    group = next(
        (g for g in context.controller.motion.groups.values() if g.config.task == task.name), None
    )
    if group is None:
        raise RequestDenied(400, "E_NO_SUCH_MECHUNIT", f"{task.name} has no robot")
    if kind == "robtarget":
        notify = _rob_target(_pose_of(context, request, group, "wobj"), "ej{}")
    elif kind in ("jointtarget", "extjointstate"):
        value = joint_target(group.map, group.positions())
        external = enumerate(value.extax.values(), 1)
        if kind == "extjointstate":
            notify = {f"j{i}": "not_active" if v > ABSENT / 2 else "rotating" for i, v in external}
        else:
            notify = {f"j{i}": str(v) for i, v in enumerate(value.robax.values(), 1)}
            notify |= {f"ej{i}": f"{v:g}" for i, v in external}
    else:
        raise RequestDenied(400, "E_INVALIDARG", f"resource {kind}")
    return show(Item(f"rapid-{kind}", kind, notify))
