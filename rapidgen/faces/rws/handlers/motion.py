"""Mechanical units: joints and poses as RAPID has them, degrees and mm."""

from typing import TYPE_CHECKING

from rapidgen.faces.rws.asking import Denied, RwsRequest, Served, show
from rapidgen.faces.rws.routing import serves
from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.builtins.motion.arguments import joint_target
from rapidgen.runtime.builtins.motion.positions import tool0
from rapidgen.runtime.builtins.motion.targets import carrier_of, rob_target
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.robot_data import NO_OFFSETS
from rapidgen.runtime.values import Value
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

if TYPE_CHECKING:
    from rapidgen.faces.rws.office import Office

_AXES = ("rax_1", "rax_2", "rax_3", "rax_4", "rax_5", "rax_6")
_EXTERNAL = "abcdef"


def _group(office: "Office", name: str) -> MotionGroup:
    for group in office.controller.motion.groups.values():
        if group.config.mechanical_unit.lower() == name.lower():
            return group
    raise Denied(404, "E_NO_SUCH_MECHUNIT", name)


@serves(ops.MECHUNITS)
def get_units(office: "Office", asked: RwsRequest) -> Served:
    """Robots; units of their own are not listed."""
    groups = office.controller.motion.groups.values()
    names = [group.config.mechanical_unit for group in groups]
    found = (Item("ms-mechunit-li", n, {"mode": "Activated"}) for n in names if n)
    return show(*found, collection=True)


@serves(ops.MECHUNIT)
def get_unit(office: "Office", asked: RwsRequest) -> Served:
    """One robot, with the tool and the object of its last move."""
    group = _group(office, asked.names["unit"])
    told = {
        "tool-name": "tool0",
        "wobj-name": "wobj0",
        "payload-name": "load0",
        "total-payload-name": "load0",
        "status": "stopped" if group.is_standing else "running",
        "mode": "Activated",
        "jog-mode": "AxisGroup1",
        "coord-system": "World",
        "is-integrated-unit": "NoIntegratedUnit",
        "has-integrated-unit": "NoIntegratedUnit",
        "type": "TCPRobot",
        "task-name": group.config.task,
        "axes": str(len(group.config.joints)),
        "axes-total": str(len(group.config.joints)),
    }
    return show(Item("ms-mechunit", group.config.mechanical_unit, told))


@serves(ops.JOINT_TARGET)
def get_joints(office: "Office", asked: RwsRequest) -> Served:
    """Where the joints are."""
    group = _group(office, asked.names["unit"])
    value = joint_target(group.map, group.positions())
    told = dict(zip(_AXES, map(str, value.robax.values()), strict=True))
    external = zip(_EXTERNAL, value.extax.values(), strict=True)
    told |= {f"eax_{letter}": f"{v:g}" for letter, v in external}
    return show(Item("ms-jointtarget", "jointtarget", told))


def _pose(office: "Office", asked: RwsRequest) -> Value:
    """The TCP of a tool in a work object; `Base` is the world's here: robots stand at its origin
    unless their object says otherwise."""
    group = _group(office, asked.names["unit"])
    frame = asked.query.get("coordinate", "Base").lower()
    if frame not in ("base", "world", "wobj"):
        raise Denied(400, "E_INVALIDARG", f"coordinate {frame}")
    tool = _datum(office, group, asked.query.get("tool", "tool0"), "tooldata") or tool0()
    name = asked.query.get("wobj", "wobj0") if frame == "wobj" else "wobj0"
    work_object = _datum(office, group, name, "wobjdata")
    try:
        return rob_target(
            group, group.positions(), carrier_of(group, tool, work_object), NO_OFFSETS
        )
    except RapidError as error:
        raise Denied(400, "E_INVALIDARG", error.name) from error


def _datum(office: "Office", group: MotionGroup, name: str, kind: str) -> Value | None:
    """A tool or an object of the robot's task; None: tool0 or wobj0. Denied: there is none."""
    if name.lower() in ("tool0", "wobj0"):
        return None
    task = office.controller.tasks[group.config.task]
    try:
        if task.type_of(name)[0].name != kind:
            raise Denied(400, "E_INVALIDARG", f"{name} is no {kind}")
        return task[name]
    except KeyError as error:
        raise Denied(400, "E_NO_SUCH_SYMBOL", name) from error


@serves(ops.ROB_TARGET)
def get_target(office: "Office", asked: RwsRequest) -> Served:
    """Where the TCP is, as a robtarget."""
    value = _pose(office, asked)
    told = dict(zip(("x", "y", "z"), map(str, value.trans.values()), strict=True))
    told |= dict(zip(("q1", "q2", "q3", "q4"), map(str, value.rot.values()), strict=True))
    conf = ("cf1", "cf4", "cf6", "cfx")
    told |= dict(zip(conf, (f"{v:g}" for v in value.robconf.values()), strict=True))
    external = zip(_EXTERNAL, value.extax.values(), strict=True)
    told |= {f"eax{letter}": f"{v:g}" for letter, v in external}
    return show(Item("ms-robtargets", "robtarget", told))


@serves(ops.CARTESIAN)
def get_cartesian(office: "Office", asked: RwsRequest) -> Served:
    """Where the TCP is; RWS 1.0 calls the configuration j1 to jx."""
    value = _pose(office, asked)
    names = ("j1", "j4", "j6", "jx") if asked.is_one else ("cf1", "cf4", "cf6", "cfx")
    told = dict(zip(("x", "y", "z"), map(str, value.trans.values()), strict=True))
    told |= dict(zip(("q1", "q2", "q3", "q4"), map(str, value.rot.values()), strict=True))
    told |= dict(zip(names, (f"{v:g}" for v in value.robconf.values()), strict=True))
    return show(Item("ms-mechunit-cartesian", "cartesian", told))
