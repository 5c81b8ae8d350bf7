"""Signals: read, and set with a check of the result."""

from urllib.parse import parse_qs

from rapidgen.client.rws.core import RwsCore
from rapidgen.client.rws.effects import Flow
from rapidgen.client.rws.errors import NotConfirmed
from rapidgen.client.rws.flows.panel import one
from rapidgen.client.rws.flows.request import ask
from rapidgen.client.rws.model import SignalState
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

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
    """Set a signal and read it back; two requests.

    Raises NotConfirmed (RG655): it has another value.
    """
    yield from ask(core, ops.SET_SIGNAL, {"signal": name}, {"lvalue": f"{float(value):g}"})
    now = yield from signal(core, name)
    if abs(now.value - value) > 1e-4 * max(1.0, abs(value)):
        raise NotConfirmed.because(
            "RG655",
            f"{core.where} agreed to set {name} to {value:g}, and it is {now.value:g}",
            "is it blocked or simulated, or does a program set it, too?",
        )
    return now
