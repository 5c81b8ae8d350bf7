"""Networks and devices of signals; they always run here."""

from typing import TYPE_CHECKING

from rapidgen.servers.rws.handlers.signals import network_of
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext

_NETWORK = {"pstate": "running", "lstate": "started"}
_DEVICE = {"lstate": "enabled", "pstate": "running", "address": "-"}


@serves(ops.IO_SYSTEM)
def get_system(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the parts of the I/O system."""
    names = ("networks", "devices", "signals")
    return show(*(Item(f"ios-{n}-li", n, {}, {"self": f"iosystem/{n}"}) for n in names))


def networks(context: "RwsContext") -> list[str]:
    """Return networks, in order."""
    return list(dict.fromkeys(map(network_of, devices(context))))


def devices(context: "RwsContext") -> list[str]:
    """Return devices with a signal."""
    result = (s.spec.device for s in context.controller.io.signals.values())
    return [device for device in dict.fromkeys(result) if device]


def _network(name: str, kind: str) -> Item:
    links = {"self": f"networks/{name}", "devices": f"devices?network={name}"}
    return Item(kind, name, {"name": name, **_NETWORK}, links)


def _device(name: str, kind: str) -> Item:
    network = network_of(name)
    links = {"self": f"devices/{network}/{name}", "network": f"networks/{network}"}
    return Item(kind, f"{network}/{name}", {"name": name, **_DEVICE}, links)


@serves(ops.NETWORKS)
def get_networks(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the networks of signals."""
    return show(*(_network(n, "ios-network-li") for n in networks(context)), collection=True)


@serves(ops.NETWORK)
def get_network(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return one network."""
    for name in networks(context):
        if name.lower() == request.names["network"].lower():
            return show(_network(name, request.kind("ios-network", "ios-network-li")))
    raise RequestDenied(404, "E_UNRESOLVED_URL", f"no network {request.names['network']}")


@serves(ops.DEVICES)
def get_devices(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the devices of signals."""
    only = request.query.get("network")
    result = (d for d in devices(context) if only in (None, network_of(d)))
    return show(*(_device(d, "ios-device-li") for d in result), collection=True)


@serves(ops.DEVICE)
def get_device(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return one device, by its name or with its network."""
    requested = request.names["device"].lower()
    for name in devices(context):
        if requested in (name.lower(), f"{network_of(name)}/{name}".lower()):
            return show(_device(name, request.kind("ios-device", "ios-device-li")))
    raise RequestDenied(404, "E_UNRESOLVED_URL", f"no device {requested}")


@serves(ops.SEARCH_NETWORKS)
def search_networks(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return networks by name and state; one is required [RWS manual]."""
    name, state = (request.form.get(k, "").lower() for k in ("name", "state"))
    if not (name or state):
        raise RequestDenied(400, "E_INVALIDARG", "name or state")
    result = [n for n in networks(context) if name in n.lower() and state in ("", "running")]
    return show(*(_network(n, "ios-network-li") for n in result), collection=True)


@serves(ops.SEARCH_DEVICES)
def search_devices(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return devices by name, state and network.

    One of the first two is required.
    """
    name, state, network = (request.form.get(k, "").lower() for k in ("name", "lstate", "network"))
    if not (name or state):
        raise RequestDenied(400, "E_INVALIDARG", "name or lstate")
    result = [
        d
        for d in devices(context)
        if name in d.lower() and state in ("", "enabled") and network in ("", network_of(d).lower())
    ]
    return show(*(_device(d, "ios-device-li") for d in result), collection=True)
