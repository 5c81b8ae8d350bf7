"""Mastership of RobotWare 6 and 7, write access of 8.

Flows take it, release it, and show its holder.
"""

from rapidgen.client.rws.core import APPLICATION, RwsCore
from rapidgen.client.rws.effects import Flow, Pause, T
from rapidgen.client.rws.errors import MastershipHeld, RwsError
from rapidgen.client.rws.flows.request import ask
from rapidgen.client.rws.model import MastershipHolder
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation

_LOOK = 1.0
"""s between two attempts while another client holds it."""
_TAKEN = ("E_RESOURCE_HELD", "E_WRITE_ACCESS_TAKEN")


def domain_of(core: RwsCore, domain: str) -> str:
    """Return this controller's name of a domain.

    RobotWare 7 has one `edit` for cfg, motion and rapid; 8 has one write access for all.
    """
    if core.generation is Generation.EIGHT:
        return "write"
    if core.generation is Generation.TWO:
        return "motion" if domain == "motion" else "edit"
    return domain if domain != "edit" else "rapid"


def held(core: RwsCore, domain: str, steps: Flow[T]) -> Flow[T]:
    """Run a flow with mastership; release it if it was not held before."""
    yield from take(core, domain)
    try:
        return (yield from steps)
    finally:
        yield from give(core, domain)


def take(core: RwsCore, domain: str = "rapid", *, wait: float = 0.0) -> Flow[None]:
    """Take mastership of `rapid`, `cfg` or `motion`."""
    name = domain_of(core, domain)
    if name in core.held:
        core.held[name] += 1
        return
    until = core.clock() + wait
    while True:
        try:
            yield from _request(core, name)
        except RwsError as error:
            if error.symbol not in _TAKEN:
                raise
            if core.clock() >= until:
                raise (yield from _held_by(core, name)) from error
        else:
            core.held[name] = 1
            return
        yield Pause(min(_LOOK, max(0.0, until - core.clock())))


def _request(core: RwsCore, name: str) -> Flow[None]:
    if core.generation is not Generation.EIGHT:
        yield from ask(core, ops.REQUEST, {"domain": name})
        return
    station = {
        "control-station-name": APPLICATION,
        "control-station-id": core.station,
        "pincode": "",
        "release-write-access-when-lost": "true",
    }
    yield from ask(core, ops.STATION_REGISTER, form=station)
    yield from ask(core, ops.WRITE_REQUEST)


def give(core: RwsCore, domain: str = "rapid") -> Flow[None]:
    """Release mastership; harmless if it is not held."""
    name = domain_of(core, domain)
    left = core.held.pop(name, 0) - 1
    if left > 0:
        core.held[name] = left
    if left != 0:
        return
    if core.generation is Generation.EIGHT:
        # A write may have cleared it already [VC 8.1.1].
        yield from ask(core, ops.WRITE_RELEASE, accepted=(403,))
    else:
        yield from ask(core, ops.RELEASE, {"domain": name})


def holder(core: RwsCore, domain: str = "rapid") -> Flow[MastershipHolder | None]:
    """Return the holder of a domain's mastership; None if there is none."""
    name = domain_of(core, domain)
    if core.generation is Generation.EIGHT:
        body, _ = yield from ask(core, ops.WRITE_ACCESS)
        held_item = body.items[0] if body.items else None
        if (
            held_item is None
            or held_item.text("control-station-write-access-held").lower() != "true"
        ):
            return None
        mine = held_item.text("held-by-control-station-Id").upper() == core.station.upper()
        return MastershipHolder(name, "", held_item.text("held-by-control-station-name"), "", mine)
    body, _ = yield from ask(core, ops.MASTERSHIP, {"domain": name})
    item = body.first("msh-resource")
    if item is None or item.text("mastership") == "nomaster":
        return None
    return MastershipHolder(
        name,
        item.text("alias"),
        item.text("application"),
        item.text("location"),
        item.text("mastershipheldbyme").upper() == "TRUE",
    )


def _held_by(core: RwsCore, name: str) -> Flow[MastershipHeld]:
    who = yield from holder(core, name)
    own = who is not None and who.application == APPLICATION
    help = "let them release it or end their session, then try again (`wait=` in Python waits)"
    if own:
        help = (
            "that is another run of rapidgen: if it was killed, the controller ends its session "
            "after five idle minutes; try again then (`deploy` and `wait=310` in Python wait)"
        )
    return MastershipHeld.because(
        "RG654", f"mastership of {name} at {core.where} is held by {who}", help
    )
