"""Signals: read, set and search.

Their access level decides which client may set them.
"""

from typing import TYPE_CHECKING
from urllib.parse import quote

from rapidgen.machine.io import Signal
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, page, show
from rapidgen.servers.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext

_WRITABLE = ("all",)
"""Access levels with remote writing.

`Default` is RAPID and local manual [VC 6.16].
"""


def value_of(signal: Signal) -> str:
    """Return a signal's value as text."""
    return f"{signal.value:g}" if signal.spec.type[0] == "A" else str(int(signal.value))


def title_of(signal: Signal) -> str:
    """Return network, device and name; only the name without a device."""
    device = signal.spec.device
    return f"{network_of(device)}/{device}/{signal.name}" if device else signal.name


def network_of(device: str) -> str:
    """Return the network of a signal.

    Networks are not modelled: DRV_1 and PANEL are Local, the others are on one of their own.
    """
    return "Local" if device.upper().startswith(("DRV_", "PANEL")) else "Virtual1"


def find(context: "RwsContext", path: str) -> Signal:
    """Return the signal at the end of a path.

    RequestDenied: there is none, or it is not on that device.
    """
    parts = path.split("/")
    signal = context.controller.io.get(parts[-1])
    if signal is None or len(parts) not in (1, 3):
        raise RequestDenied(404, "E_UNRESOLVED_URL", f"no signal {path}")
    device = signal.spec.device
    if len(parts) == 3 and device and parts[1].lower() != device.lower():
        raise RequestDenied(404, "E_UNRESOLVED_URL", f"no signal {path}")
    return signal


def item(signal: Signal, kind: str, request: RwsRequest) -> Item:
    """Return a signal as an item."""
    notify = {
        "name": signal.name,
        "type": signal.spec.type,
        "category": "",
        "lvalue": value_of(signal),
        "lstate": "not simulated",
    }
    if not request.is_one:
        notify["write-access"] = (
            "Rapid|LocalManual|LocalAuto|RemoteAuto"
            if _is_writable(signal)
            else "Rapid|LocalManual"
        )
    title = title_of(signal)
    # Relative to `/rw/iosystem/`, the parent of the collection [VC 6.16, VC 7.21].
    parent = "" if request.path.rstrip("/").endswith("/signals") else "/rw/iosystem/"
    query = "?json=1" if request.is_one and request.query.get("json") == "1" else ""
    links = {"self": f"{parent}signals/{quote(title)}{query}"} if kind.endswith("-li") else {}
    return Item(kind, title, notify, links)


def _is_writable(signal: Signal) -> bool:
    return signal.spec.access.lower() in _WRITABLE


@serves(ops.SIGNALS)
def get_signals(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return all signals; a hundred at a time in RWS 2.0 [VC 7.21]."""
    result = context.controller.io.signals.values()
    return page(request, [item(s, "ios-signal-li", request) for s in result], 100, "signals")


@serves(ops.SIGNAL)
def get_signal(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return one signal."""
    signal = find(context, request.names["signal"])
    return show(item(signal, request.kind("ios-signal", "ios-signal-li"), request))


@serves(ops.SET_SIGNAL)
def set_signal(context: "RwsContext", request: RwsRequest) -> None:
    """Set a signal, or pulse or invert it."""
    signal = find(context, request.names["signal"])
    mode = request.form.get("mode", "value")
    if context.strict and not _is_writable(signal):
        raise RequestDenied(403, "E_REJECT", f"access level of {signal.name}", -2)
    io = context.controller.io
    try:
        if mode in ("invert", "toggle"):
            io.set(signal, 1 - signal.value)
        elif mode == "pulse":
            io.pulse(signal, float(request.form.get("ActivePulse", "200")) / 1000)
        elif mode in ("value", "delay"):
            delay = float(request.form.get("Delay", "0")) / 1000 if mode == "delay" else 0.0
            io.set(signal, float(request.field("lvalue")), delay=delay)
        else:
            raise RequestDenied(400, "E_INVALIDARG", f"mode {mode}")
    except ValueError as error:
        raise RequestDenied(400, "E_INVALIDARG", str(error)) from error


@serves(ops.SEARCH_SIGNALS)
def search(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return signals by part of the name, type or device [VC 7.21]."""
    requested = {k: request.form.get(k, "").lower() for k in ("name", "type", "device")}
    result = [s for s in context.controller.io.signals.values() if _fits(s, requested)]
    return page(request, [item(s, "ios-signal-li", request) for s in result], 100, "signals")


@serves(ops.SEARCH_SIGNALS_TWICE)
def search_twice(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return signals that match one of two sets of criteria.

    [VC 6.16, VC 7.21]
    """
    result = list(context.controller.io.signals.values())
    for one in ("", "1", "2"):
        requested = {
            k: request.form.get(f"{k}{one}", "").lower() for k in ("name", "type", "device")
        }
        result = [s for s in result if _fits(s, requested)]
    return page(request, [item(s, "ios-signal-li", request) for s in result], 100, "signals")


def _fits(signal: Signal, requested: dict[str, str]) -> bool:
    return (
        requested["name"] in signal.name.lower()
        and requested["type"] in ("", signal.spec.type.lower())
        and requested["device"] in ("", signal.spec.device.lower())
    )


@serves(ops.SIGNAL_CONFIG)
def get_config(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the EIO.cfg entry of a signal."""
    spec = find(context, request.names["signal"]).spec
    notify = {"name": spec.name, "type": spec.type, "device": spec.device, "access": spec.access}
    return show(Item("ios-signal-config-general", spec.name, notify))
