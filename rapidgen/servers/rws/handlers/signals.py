"""The I/O system: networks, devices, signals."""

from urllib.parse import quote

from rapidgen.machine.io import Signal
from rapidgen.servers.rws.application import RwsApplication, serves
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, page, show
from rapidgen.servers.rws.subscriptions import EventSource, Topic, every_change, subscribable
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

_NETWORK = {"pstate": "running", "lstate": "started"}
_DEVICE = {"lstate": "enabled", "pstate": "running", "address": "-"}


@serves(ops.IO_SYSTEM)
def get_system(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the parts of the I/O system."""
    names = ("networks", "devices", "signals")
    return show(*(Item(f"ios-{n}-li", n, {}, {"self": f"iosystem/{n}"}) for n in names))


def networks(app: RwsApplication) -> list[str]:
    """Return networks, in order."""
    return list(dict.fromkeys(map(network_of, devices(app))))


def devices(app: RwsApplication) -> list[str]:
    """Return devices with a signal."""
    result = (s.spec.device for s in app.controller.io.signals.values())
    return [device for device in dict.fromkeys(result) if device]


def _network(name: str, kind: str) -> Item:
    links = {"self": f"networks/{name}", "devices": f"devices?network={name}"}
    return Item(kind, name, {"name": name, **_NETWORK}, links)


def _device(name: str, kind: str) -> Item:
    network = network_of(name)
    links = {"self": f"devices/{network}/{name}", "network": f"networks/{network}"}
    return Item(kind, f"{network}/{name}", {"name": name, **_DEVICE}, links)


@serves(ops.NETWORKS)
def get_networks(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the networks of signals."""
    return show(*(_network(n, "ios-network-li") for n in networks(app)), collection=True)


@serves(ops.NETWORK)
def get_network(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return one network."""
    for name in networks(app):
        if name.lower() == request.names["network"].lower():
            return show(_network(name, request.kind("ios-network", "ios-network-li")))
    raise RequestDenied(404, "E_UNRESOLVED_URL", f"no network {request.names['network']}")


@serves(ops.DEVICES)
def get_devices(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the devices of signals."""
    only = request.query.get("network")
    result = (d for d in devices(app) if only in (None, network_of(d)))
    return show(*(_device(d, "ios-device-li") for d in result), collection=True)


@serves(ops.DEVICE)
def get_device(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return one device, by its name or with its network."""
    requested = request.names["device"].lower()
    for name in devices(app):
        if requested in (name.lower(), f"{network_of(name)}/{name}".lower()):
            return show(_device(name, request.kind("ios-device", "ios-device-li")))
    raise RequestDenied(404, "E_UNRESOLVED_URL", f"no device {requested}")


@serves(ops.SEARCH_NETWORKS)
def search_networks(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return networks by name and state; one is required [RWS manual]."""
    name, state = (request.form.get(k, "").lower() for k in ("name", "state"))
    if not (name or state):
        raise RequestDenied(400, "E_INVALIDARG", "name or state")
    result = [n for n in networks(app) if name in n.lower() and state in ("", "running")]
    return show(*(_network(n, "ios-network-li") for n in result), collection=True)


@serves(ops.SEARCH_DEVICES)
def search_devices(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return devices by name, state and network.

    One of the first two is required.
    """
    name, state, network = (request.form.get(k, "").lower() for k in ("name", "lstate", "network"))
    if not (name or state):
        raise RequestDenied(400, "E_INVALIDARG", "name or lstate")
    result = [
        d
        for d in devices(app)
        if name in d.lower() and state in ("", "enabled") and network in ("", network_of(d).lower())
    ]
    return show(*(_device(d, "ios-device-li") for d in result), collection=True)


# -- signals ---------------------------------------------------------------------------------------

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


def find(app: RwsApplication, path: str) -> Signal:
    """Return the signal at the end of a path.

    RequestDenied: there is none, or it is not on that device.
    """
    parts = path.split("/")
    signal = app.controller.io.get(parts[-1])
    if signal is None or len(parts) not in (1, 3):
        raise RequestDenied(404, "E_UNRESOLVED_URL", f"no signal {path}")
    device = signal.spec.device
    if len(parts) == 3 and device and parts[1].lower() != device.lower():
        raise RequestDenied(404, "E_UNRESOLVED_URL", f"no signal {path}")
    return signal


def item_of(signal: Signal, kind: str, request: RwsRequest) -> Item:
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
def get_signals(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return all signals; a hundred at a time in RWS 2.0 [VC 7.21]."""
    result = app.controller.io.signals.values()
    return page(request, [item_of(s, "ios-signal-li", request) for s in result], 100, "signals")


@serves(ops.SIGNAL)
def get_signal(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return one signal."""
    signal = find(app, request.names["signal"])
    return show(item_of(signal, request.kind("ios-signal", "ios-signal-li"), request))


@serves(ops.SET_SIGNAL)
def set_signal(app: RwsApplication, request: RwsRequest) -> None:
    """Set a signal, or pulse or invert it."""
    signal = find(app, request.names["signal"])
    mode = request.form.get("mode", "value")
    if app.strict and not _is_writable(signal):
        raise RequestDenied(403, "E_REJECT", f"access level of {signal.name}", -2)
    io = app.controller.io
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
def search(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return signals by part of the name, type or device [VC 7.21]."""
    requested = {k: request.form.get(k, "").lower() for k in ("name", "type", "device")}
    result = [s for s in app.controller.io.signals.values() if _fits(s, requested)]
    return page(request, [item_of(s, "ios-signal-li", request) for s in result], 100, "signals")


@serves(ops.SEARCH_SIGNALS_TWICE)
def search_twice(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return signals that match one of two sets of criteria.

    [VC 6.16, VC 7.21]
    """
    result = list(app.controller.io.signals.values())
    for one in ("", "1", "2"):
        requested = {
            k: request.form.get(f"{k}{one}", "").lower() for k in ("name", "type", "device")
        }
        result = [s for s in result if _fits(s, requested)]
    return page(request, [item_of(s, "ios-signal-li", request) for s in result], 100, "signals")


def _fits(signal: Signal, requested: dict[str, str]) -> bool:
    return (
        requested["name"] in signal.name.lower()
        and requested["type"] in ("", signal.spec.type.lower())
        and requested["device"] in ("", signal.spec.device.lower())
    )


@serves(ops.SIGNAL_CONFIG)
def get_config(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the EIO.cfg entry of a signal."""
    spec = find(app, request.names["signal"]).spec
    notify = {"name": spec.name, "type": spec.type, "device": spec.device, "access": spec.access}
    return show(Item("ios-signal-config-general", spec.name, notify))


@subscribable("/rw/iosystem/signals/(?P<signal>.+)", "state")
def signal_events(app: RwsApplication, topic: Topic) -> EventSource:
    """Values of a signal."""
    signal = find(app, topic.names["signal"])

    def item() -> Item:
        fields = {"lvalue": value_of(signal), "lstate": "not simulated"}
        return Item("ios-signalstate-ev", signal.name, fields, {"self": topic.text})

    return every_change(signal.changed, item)
