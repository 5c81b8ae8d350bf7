"""Mechanical units: axes, base frame, choices for jogging.

Their positions are in `motion`. Classes and fields: RWS manual 3HAC050973, and observations [VC
7.21].
"""

from math import isfinite
from typing import TYPE_CHECKING

from rapidgen.axes.mapping import ABSENT
from rapidgen.motion.group import MotionGroup
from rapidgen.servers.rws.handlers.execution import execution
from rapidgen.servers.rws.handlers.motion import find_group
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show, whole
from rapidgen.servers.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext

_CHOICES = ("tool", "wobj", "payload", "total-payload", "mode", "jog-mode", "coord-system")
_PARTS = ("checkchangecount", "mechunits", "errorstate", "nonmotionexecution")


@serves(ops.MOTION_SYSTEM)
def get_system(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the motion system: its count of changes, its first unit."""
    units = [g.config.mechanical_unit for g in context.controller.motion.groups.values()]
    notify = {
        "change-count": str(context.runner.restarts),
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
def check_count(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return whether the motion system has changed since a count."""
    count = request.names.get("count") or request.query.get("changecount", "")
    changed = "FALSE" if whole("changecount", count) == context.runner.restarts else "TRUE"
    name = request.kind("changestate", "change-state")
    kind = request.kind("checkchangecount", "check-changecount")
    return show(Item(kind, "changecount", {name: changed}))


@serves(ops.ERROR_STATE)
def error_state(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return errors of the motion system; there are no collisions here."""
    return show(Item("ms-errorstate", "errorstate", {"err-state": "HPJ_OK", "err-count": "0"}))


@serves(ops.BASE_FRAME)
def base_frame(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return a robot's base frame, which is the world's origin here."""
    find_group(context, request)
    names = ("x", "y", "z", "q1", "q2", "q3", "q4")
    notify = {name: "1" if name == "q1" else "0" for name in names}
    return show(Item("ms-mechunit-baseframe", "baseframe", notify))


@serves(ops.AXES)
def axes(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the number of axes of a unit."""
    count = len(find_group(context, request).config.joints)
    numbers = map(str, range(1, count + 1))
    links = (Item("ms-mechunit-axis-li", n, {}, {"self": f"axes/{n}"}) for n in numbers)
    return show(Item("ms-mechunit-axes", "axes", {"axes": str(count)}), *links)


@serves(ops.AXIS)
def axis(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return one axis, counted from 1; all are calibrated here."""
    number, count = request.names["axis"], len(find_group(context, request).config.joints)
    whole("axis", number, 1, count)
    return show(
        Item("ms-mechunit-axisstatus", "axisstatus", {"axis-status": "Synchronized"}),
        Item("ms-mechunit-logicalaxis", "logicalaxis", {"logical-axis": number}),
    )


@serves(ops.SET_MECHUNIT)
def choose(context: "RwsContext", request: RwsRequest) -> None:
    """Choose tool, work object, ... for jogging."""
    context.masters.need(request, "motion", by_itself=not request.is_one)
    group = find_group(context, request)
    notify = request.form
    if not notify or any(name not in _CHOICES for name in notify):
        raise RequestDenied(400, "E_INVALIDARG", f"one of {', '.join(_CHOICES)} is wanted")
    for name, kind in (("tool", "tooldata"), ("wobj", "wobjdata")):
        if name in notify:
            _must_be(context, group, notify[name], kind)
    context.chosen.setdefault(group.config.mechanical_unit, {}).update(notify)


def _must_be(context: "RwsContext", group: MotionGroup, name: str, kind: str) -> None:
    if name in ("tool0", "wobj0"):
        return
    try:
        if context.controller.tasks[group.config.task].type_of(name)[0].name == kind:
            return
    except KeyError:
        pass
    raise RequestDenied(400, "E_TOOL_ERROR" if kind == "tooldata" else "E_WOBJ_ERROR", name)


@serves(ops.LEAD_THROUGH)
def lead_through(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return whether a robot is in lead-through."""
    unit = find_group(context, request).config.mechanical_unit
    notify = {"status": "Active" if unit in context.led else "Inactive"}
    return show(Item("ms-mechunit-lead-through", "lead-through", notify))


@serves(ops.SET_LEAD_THROUGH)
def lead(context: "RwsContext", request: RwsRequest) -> None:
    """Switch lead-through on or off.

    With motors off or a running program it is accepted without effect [real 7.21].
    """
    unit = find_group(context, request).config.mechanical_unit
    requested = request.field("status", ("active", "inactive"))
    if requested == "inactive":
        context.led.discard(unit)
    elif context.controller.motors_on and execution(context.controller) == "stopped":
        context.led.add(unit)


@serves(ops.SET_POSITION)
def set_position(context: "RwsContext", request: RwsRequest) -> None:
    """Move the stopped robot to a position, degrees and mm.

    Only virtual controllers do this [VC 7.21].
    """
    group = find_group(context, request)
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
def jog(context: "RwsContext", request: RwsRequest) -> None:
    """Refuse jogging without an enabling device, as virtual controllers do.

    [VC 6.16, VC 7.21]
    """
    for name in ("jogmode", "mechunit", "ccount"):
        request.field(name)
    if context.controller.mode == "auto":
        raise RequestDenied(403, "E_MODE_REJECT", "jogging is for manual mode", -2)
    raise RequestDenied(403, "E_REJECT", "no enabling device is pressed", -2)
