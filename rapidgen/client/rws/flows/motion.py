"""Mechanical units and their positions as RAPID has them (degrees, mm)."""

from rapidgen.client.rws.core import RwsCore
from rapidgen.client.rws.effects import Flow
from rapidgen.client.rws.errors import NotConfirmed
from rapidgen.client.rws.flows.panel import one
from rapidgen.client.rws.flows.request import ask
from rapidgen.client.rws.model import JointTarget, RobTarget
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item
from rapidgen.wire.rws.forms import write_form

_EXTERNAL = "abcdef"


def mechanical_units(core: RwsCore) -> Flow[tuple[str, ...]]:
    """Names of the mechanical units."""
    body, _ = yield from ask(core, ops.MECHUNITS)
    return tuple(item.title for item in body.all("ms-mechunit-li"))


def joint_target(core: RwsCore, unit: str = "ROB_1") -> Flow[JointTarget]:
    """Return the axis positions of a unit, deg and mm; one request.

    9E9: the unit has no such axis.
    """
    item = yield from one(core, ops.JOINT_TARGET, "ms-jointtarget", unit=unit)
    robot = _numbers(core, item, [f"rax_{n}" for n in range(1, 7)])
    return JointTarget(robot, _numbers(core, item, [f"eax_{x}" for x in _EXTERNAL]))


def rob_target(
    core: RwsCore, unit: str = "ROB_1", *, tool: str = "tool0", wobj: str = "wobj0"
) -> Flow[RobTarget]:
    """Return the TCP of a tool in a work object, mm and quaternion.

    One request.
    """
    query = write_form({"tool": tool, "wobj": wobj, "coordinate": "Wobj"}).decode()
    body, _ = yield from ask(core, ops.ROB_TARGET, {"unit": unit}, query=query)
    item = body.first("ms-robtargets")
    if item is None:
        raise NotConfirmed.because("RG655", f"{core.where} returns no robtarget of {unit}")
    # eaxa as rpi's client reads it, eax_a as RWS4YuMi did on a YuMi.
    external = "eax" if "eaxa" in item.fields else "eax_"
    return RobTarget(
        _numbers(core, item, ["x", "y", "z"]),
        _numbers(core, item, ["q1", "q2", "q3", "q4"]),
        _numbers(core, item, ["cf1", "cf4", "cf6", "cfx"]),
        _numbers(core, item, [external + x for x in _EXTERNAL]),
    )


def _numbers(core: RwsCore, item: Item, names: list[str]) -> tuple[float, ...]:
    try:
        return tuple(float(item.text(name, "9E9")) for name in names)
    except ValueError as error:
        raise NotConfirmed.because("RG655", f"{core.where}: {item.title}: {error}") from error
