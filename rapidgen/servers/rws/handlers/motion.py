"""Mechanical units: joints and poses as RAPID has them, degrees and mm."""

from math import isfinite

from rapidgen.axes.mapping import ABSENT
from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.builtins.motion.positions import tool0
from rapidgen.runtime.builtins.motion.targets import carrier_of, joint_target, rob_target
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.motion_interface import NO_OFFSETS
from rapidgen.runtime.values import Value
from rapidgen.servers.rws.application import RwsApplication, serves
from rapidgen.servers.rws.handlers.tasks import execution, task_of
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show, whole
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

_AXES = ("rax_1", "rax_2", "rax_3", "rax_4", "rax_5", "rax_6")
_EXTERNAL = "abcdef"


def find_group(app: RwsApplication, request: RwsRequest) -> MotionGroup:
    """Return the robot of a request.

    RequestDenied: there is none of that name.
    """
    name = request.names["unit"]
    for group in app.controller.motion.groups.values():
        if group.config.mechanical_unit.lower() == name.lower():
            return group
    raise RequestDenied(404, "E_NO_SUCH_MECHUNIT", name)


@serves(ops.MECHUNITS)
def get_units(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return robots; single units are not listed."""
    groups = app.controller.motion.groups.values()
    names = [group.config.mechanical_unit for group in groups]
    result = (Item("ms-mechunit-li", n, {"mode": "Activated"}) for n in names if n)
    return show(*result, collection=True)


_STATIC = ("type", "task-name", "axes", "axes-total", "is-integrated-unit", "has-integrated-unit")


@serves(ops.MECHUNIT)
def get_unit(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return one robot with its choices for jogging.

    `resource` selects parts of it.
    """
    group = find_group(app, request)
    count, chosen = (
        str(len(group.config.joints)),
        app.chosen.get(group.config.mechanical_unit, {}),
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
def get_joints(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the joints."""
    group = find_group(app, request)
    value = joint_target(group.map, group.positions())
    notify = dict(zip(_AXES, map(str, value.robax.values()), strict=True))
    external = zip(_EXTERNAL, value.extax.values(), strict=True)
    notify |= {f"eax_{letter}": f"{v:g}" for letter, v in external}
    return show(Item("ms-jointtarget", "jointtarget", notify))


def _pose(app: RwsApplication, request: RwsRequest) -> Value:
    """Return the TCP of a tool in a work object.

    `Base` equals the world here: robots are at its origin unless their object says otherwise.
    """
    return _pose_of(app, request, find_group(app, request))


def _pose_of(
    app: RwsApplication, request: RwsRequest, group: MotionGroup, default: str = "base"
) -> Value:
    frame = request.query.get("coordinate", default).lower()
    if frame not in ("base", "world", "wobj"):
        raise RequestDenied(400, "E_INVALIDARG", f"coordinate {frame}")
    tool = _datum(app, group, request.query.get("tool", "tool0"), "tooldata") or tool0()
    name = request.query.get("wobj", "wobj0") if frame == "wobj" else "wobj0"
    work_object = _datum(app, group, name, "wobjdata")
    try:
        return rob_target(
            group, group.positions(), carrier_of(group, tool, work_object), NO_OFFSETS
        )
    except RapidError as error:
        raise RequestDenied(400, "E_INVALIDARG", error.name) from error


def _datum(app: RwsApplication, group: MotionGroup, name: str, kind: str) -> Value | None:
    """Return a tool or object of the robot's task.

    Without a name it is tool0 or wobj0. RequestDenied: there is none.
    """
    if name.lower() in ("tool0", "wobj0"):
        return None
    task = app.controller.tasks[group.config.task]
    try:
        if task.type_of(name)[0].name != kind:
            raise RequestDenied(400, "E_INVALIDARG", f"{name} is no {kind}")
        return task[name]
    except KeyError as error:
        raise RequestDenied(400, "E_NO_SUCH_SYMBOL", name) from error


@serves(ops.ROB_TARGET)
def get_target(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the TCP as a robtarget."""
    return show(Item("ms-robtargets", "robtarget", _rob_target(_pose(app, request))))


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
def get_cartesian(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the TCP; RWS 1.0 calls the configuration j1 to jx."""
    value = _pose(app, request)
    names = ("j1", "j4", "j6", "jx") if request.is_one else ("cf1", "cf4", "cf6", "cfx")
    notify = dict(zip(("x", "y", "z"), map(str, value.trans.values()), strict=True))
    notify |= dict(zip(("q1", "q2", "q3", "q4"), map(str, value.rot.values()), strict=True))
    notify |= dict(zip(names, (f"{v:g}" for v in value.robconf.values()), strict=True))
    return show(Item("ms-mechunit-cartesian", "cartesian", notify))


# -- by task -------------------------------------------------------------------------------------


@serves(ops.TASK_MOTION)
def get_motion(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return positions of a task's robot [RWS manual 3HAC050973].

    Without `resource` it is the list of resources.
    """
    task = task_of(app, request)
    kind = request.query.get("resource", "")
    if not kind:
        names = ("jointtarget", "robtarget", "extjointstate")
        return show(
            *(Item(f"rapid-{n}-li", n, {}, {"self": f"motion?resource={n}"}) for n in names)
        )
    group = next(
        (g for g in app.controller.motion.groups.values() if g.config.task == task.name), None
    )
    if group is None:
        raise RequestDenied(400, "E_NO_SUCH_MECHUNIT", f"{task.name} has no robot")
    if kind == "robtarget":
        notify = _rob_target(_pose_of(app, request, group, "wobj"), "ej{}")
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


# -- the motion system, its units and axes ---------------------------------------------------------

_CHOICES = ("tool", "wobj", "payload", "total-payload", "mode", "jog-mode", "coord-system")
_PARTS = ("checkchangecount", "mechunits", "errorstate", "nonmotionexecution")


@serves(ops.MOTION_SYSTEM)
def get_system(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the motion system: its count of changes, its first unit."""
    units = [g.config.mechanical_unit for g in app.controller.motion.groups.values()]
    notify = {
        "change-count": str(app.runner.restarts),
        "mechunit-name": units[0] if units else "",
        "poll-rate": "60",
        "modal-payload-mode": "ON",
        "absacc-active": "OFF",
    }
    only = request.query.get("resource", "")
    if only:
        if only not in notify:
            raise RequestDenied(400, "E_INVALIDARG", f"resource {only}")
        notify = {only: notify[only]}
    links = [Item(f"ms-{p}-li", p, {}, {"self": f"motionsystem/{p}"}) for p in _PARTS]
    return show(Item("ms", "motionsystem", notify), *(links if not only else ()))


@serves(ops.CHECK_COUNT)
def check_count(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return whether the motion system has changed since a count."""
    count = request.names.get("count") or request.query.get("changecount", "")
    changed = "FALSE" if whole("changecount", count) == app.runner.restarts else "TRUE"
    name = request.kind("changestate", "change-state")
    kind = request.kind("checkchangecount", "check-changecount")
    return show(Item(kind, "changecount", {name: changed}))


@serves(ops.ERROR_STATE)
def error_state(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return errors of the motion system; there are no collisions here."""
    return show(Item("ms-errorstate", "errorstate", {"err-state": "HPJ_OK", "err-count": "0"}))


@serves(ops.BASE_FRAME)
def base_frame(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return a robot's base frame, which is the world's origin here."""
    find_group(app, request)
    names = ("x", "y", "z", "q1", "q2", "q3", "q4")
    notify = {name: "1" if name == "q1" else "0" for name in names}
    return show(Item("ms-mechunit-baseframe", "baseframe", notify))


@serves(ops.AXES)
def axes(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the number of axes of a unit."""
    count = len(find_group(app, request).config.joints)
    numbers = map(str, range(1, count + 1))
    links = (Item("ms-mechunit-axis-li", n, {}, {"self": f"axes/{n}"}) for n in numbers)
    return show(Item("ms-mechunit-axes", "axes", {"axes": str(count)}), *links)


@serves(ops.AXIS)
def axis(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return one axis, counted from 1; all are calibrated here."""
    number, count = request.names["axis"], len(find_group(app, request).config.joints)
    whole("axis", number, 1, count)
    return show(
        Item("ms-mechunit-axisstatus", "axisstatus", {"axis-status": "Synchronized"}),
        Item("ms-mechunit-logicalaxis", "logicalaxis", {"logical-axis": number}),
    )


@serves(ops.SET_MECHUNIT)
def choose(app: RwsApplication, request: RwsRequest) -> None:
    """Choose tool, work object, ... for jogging."""
    app.masterships.need(request, "motion", by_itself=not request.is_one)
    group = find_group(app, request)
    notify = request.form
    if not notify or any(name not in _CHOICES for name in notify):
        raise RequestDenied(400, "E_INVALIDARG", f"one of {', '.join(_CHOICES)} is wanted")
    for name, kind in (("tool", "tooldata"), ("wobj", "wobjdata")):
        if name in notify:
            _must_be(app, group, notify[name], kind)
    app.chosen.setdefault(group.config.mechanical_unit, {}).update(notify)


def _must_be(app: RwsApplication, group: MotionGroup, name: str, kind: str) -> None:
    if name in ("tool0", "wobj0"):
        return
    try:
        if app.controller.tasks[group.config.task].type_of(name)[0].name == kind:
            return
    except KeyError:
        pass
    raise RequestDenied(400, "E_TOOL_ERROR" if kind == "tooldata" else "E_WOBJ_ERROR", name)


@serves(ops.LEAD_THROUGH)
def lead_through(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return whether a robot is in lead-through."""
    unit = find_group(app, request).config.mechanical_unit
    notify = {"status": "Active" if unit in app.led else "Inactive"}
    return show(Item("ms-mechunit-lead-through", "lead-through", notify))


@serves(ops.SET_LEAD_THROUGH)
def lead(app: RwsApplication, request: RwsRequest) -> None:
    """Switch lead-through on or off.

    With motors off or a running program it is accepted without effect [real 7.21].
    """
    unit = find_group(app, request).config.mechanical_unit
    requested = request.field("status", ("active", "inactive"))
    if requested == "inactive":
        app.led.discard(unit)
    elif app.controller.motors_on and execution(app.controller) == "stopped":
        app.led.add(unit)


@serves(ops.SET_POSITION)
def set_position(app: RwsApplication, request: RwsRequest) -> None:
    """Move the stopped robot to a position, degrees and mm.

    Only virtual controllers do this [VC 7.21].
    """
    group = find_group(app, request)
    arm, external = _numbers(request, "rob_joint"), _numbers(request, "ext_joint")
    if len(arm) != 6:
        raise RequestDenied(400, "E_INVALIDARG", "rob_joint has six numbers")
    external += [ABSENT] * (6 - len(external))
    posture = group.map.from_rapid(arm, external, group.positions())
    for value, joint in zip(posture, group.config.joints, strict=True):
        if not joint.lower <= value <= joint.upper:
            raise RequestDenied(400, "E_MECHPOS_NOT_IN_LIMIT", f"{joint.name}: {value:g}")
    try:
        group.jog(posture)
    except ValueError as error:
        raise RequestDenied(403, "E_EXEC_STATE", str(error)) from error


def _numbers(request: RwsRequest, name: str) -> list[float]:
    text = request.field(name)
    try:
        result = [float(part) for part in text.strip("[] ").split(",")]
    except ValueError as error:
        raise RequestDenied(400, "E_INVALIDARG", f"{name}: {text}") from error
    if len(result) > 6 or not all(map(isfinite, result)):
        raise RequestDenied(400, "E_INVALIDARG", f"{name}: {text}")
    return result


@serves(ops.JOG)
def jog(app: RwsApplication, request: RwsRequest) -> None:
    """Refuse jogging without an enabling device, as virtual controllers do.

    [VC 6.16, VC 7.21]
    """
    for name in ("jogmode", "mechunit", "ccount"):
        request.field(name)
    if app.controller.mode == "auto":
        raise RequestDenied(403, "E_MODE_REJECT", "jogging is for manual mode", -2)
    raise RequestDenied(403, "E_REJECT", "no enabling device is pressed", -2)
