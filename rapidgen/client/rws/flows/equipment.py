"""Signals, mechanical units and the event log.

Signals are set with a check of the result. Positions are those of RAPID (degrees, mm).
"""

from urllib.parse import parse_qs

from rapidgen.client.rws.core import RwsCore
from rapidgen.client.rws.effects import Flow
from rapidgen.client.rws.errors import NotConfirmed
from rapidgen.client.rws.flows.panel import one
from rapidgen.client.rws.flows.request import ask
from rapidgen.client.rws.model import JointTarget, LogEvent, MechanicalUnit, RobTarget, SignalState
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item, whole
from rapidgen.wire.rws.forms import write_form

_PAGES = 200


def signals(core: RwsCore) -> Flow[tuple[SignalState, ...]]:
    """All signals: one request in RWS 1.0, one for a hundred in 2.0."""
    result: list[Item] = []
    query = ""
    for _ in range(_PAGES):
        body, _ = yield from ask(core, ops.SIGNALS, query=query)
        result += body.all("ios-signal-li")
        start = parse_qs(body.next.partition("?")[2]).get("start", [""])[0]
        if not start.isdecimal():
            break
        query = f"start={start}&limit=100"
    return tuple(_signal(item) for item in result)


def signal(core: RwsCore, name: str) -> Flow[SignalState]:
    """Return a signal by its name or as NETWORK/DEVICE/NAME; one request."""
    item = yield from one(core, ops.SIGNAL, "ios-signal", "ios-signal-li", signal=name)
    return _signal(item)


def _signal(item: Item) -> SignalState:
    text = item.text("lvalue", "0")
    try:
        value = float(text)
    except ValueError as error:
        raise NotConfirmed.because("RG655", f"a signal has the value {text!r}") from error
    name = item.text("name") or item.title.rpartition("/")[2]
    simulated = item.text("lstate") == "simulated"
    return SignalState(name, item.title or name, item.text("type"), value, simulated)


def set_signal(core: RwsCore, name: str, value: float) -> Flow[SignalState]:
    """Set a signal and read it back; two requests."""
    yield from ask(core, ops.SET_SIGNAL, {"signal": name}, {"lvalue": f"{float(value):g}"})
    now = yield from signal(core, name)
    if abs(now.value - value) > 1e-4 * max(1.0, abs(value)):
        raise NotConfirmed.because(
            "RG655",
            f"{core.where} agreed to set {name} to {value:g}, and it is {now.value:g}",
            "is it blocked or simulated, or does a program set it, too?",
        )
    return now


_EXTERNAL = "abcdef"


def mechanical_units(core: RwsCore) -> Flow[tuple[str, ...]]:
    """Names of the mechanical units."""
    body, _ = yield from ask(core, ops.MECHUNITS)
    return tuple(item.title for item in body.all("ms-mechunit-li"))


def mechanical_unit(core: RwsCore, unit: str = "ROB_1") -> Flow[MechanicalUnit]:
    """Return a robot's task, tool and load; one request."""
    item = yield from one(core, ops.MECHUNIT, "ms-mechunit", unit=unit)
    names = (item.text("task-name"), item.text("tool-name"), item.text("payload-name"))
    return MechanicalUnit(unit, *names)


def joint_target(core: RwsCore, unit: str = "ROB_1") -> Flow[JointTarget]:
    """Return the axis positions of a unit, deg and mm; one request."""
    item = yield from one(core, ops.JOINT_TARGET, "ms-jointtarget", unit=unit)
    robot = _numbers(core, item, [f"rax_{n}" for n in range(1, 7)])
    return JointTarget(robot, _numbers(core, item, [f"eax_{x}" for x in _EXTERNAL]))


def rob_target(
    core: RwsCore, unit: str = "ROB_1", *, tool: str = "tool0", wobj: str = "wobj0"
) -> Flow[RobTarget]:
    """Return the TCP of a tool in a work object, mm and quaternion."""
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


_TYPES = {"1": "info", "2": "warning", "3": "error"}


def log(
    core: RwsCore, *, domain: int = 0, after: int = 0, count: int = 50
) -> Flow[tuple[LogEvent, ...]]:
    """Return the last `count` entries of a domain (0: all), oldest first."""
    query = "lang=en" + (f"&elogseqnum={after}" if after else "")
    body, _ = yield from ask(core, ops.ELOG, {"domain": str(domain)}, query=query)
    result = sorted(
        (_event(item) for item in body.all("elog-message-li", "elog-message")),
        key=lambda event: event.number,
    )
    return tuple(event for event in result if event.number > after)[-count:]


def _event(item: Item) -> LogEvent:
    parts = item.title.rsplit("/", 2)
    domain, number = parts[-2:] if len(parts) > 1 else ("", "")
    arguments = [one.text("value") for one in item.within]
    arguments += [v for k, v in item.fields.items() if k.startswith("arg") and k[3:].isdecimal()]
    return LogEvent(
        whole(domain),
        whole(number),
        _TYPES.get(item.text("msgtype"), "info"),
        item.whole("code"),
        item.text("tstamp").replace(" T ", " "),
        item.text("title"),
        item.text("desc"),
        tuple(arguments),
    )
