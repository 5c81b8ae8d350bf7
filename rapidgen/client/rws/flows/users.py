"""User rights: grants by UAS name, and remote writing in manual mode.

ABB calls the latter RMMP.
"""

from rapidgen.client.errors import NotReady
from rapidgen.client.rws.core import RwsCore
from rapidgen.client.rws.effects import Flow, Pause
from rapidgen.client.rws.flows.panel import one
from rapidgen.client.rws.flows.request import ask
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.operations import RwsOperation

_LOOK = 0.5
"""s between two polls; each keeps the pendant's prompt [abb_robot_client]."""


def grants(core: RwsCore) -> Flow[frozenset[str]]:
    """UAS names of this user's grants; empty if the controller reports none."""
    body, _ = yield from ask(core, ops.GRANTS, accepted=(400, 403, 404))
    kinds = ("user-grant", "uas-grant")
    return frozenset(i.text("grantname") or i.title for i in body.all(*kinds)) - {""}


def ask_rmmp(core: RwsCore, privilege: str = "modify", *, wait: float = 10.0) -> Flow[None]:
    """Request remote writing (`modify`) or running (`exec`) in manual mode."""
    if (yield from _mode(core)) == "AUTO":
        return
    if core.generation is Generation.EIGHT:
        core.route(_NO_RMMP)
    yield from ask(core, ops.ASK_RMMP, form={"privilege": privilege})
    until = core.clock() + wait
    while True:
        item = yield from one(core, ops.RMMP_POLL, "user-rmmp-poll")
        status = item.text("status").upper()
        if status == "GRANTED":
            return
        if status != "PENDING" or core.clock() >= until:
            break
        yield Pause(_LOOK)
    yield from ask(core, ops.CANCEL_RMMP, accepted=(400, 403, 404))
    why = (
        f"the pendant's user did not grant it within {wait:g} s"
        if status == "PENDING"
        else f"the controller reports {status}"
    )
    raise NotReady.because(
        "RG661",
        f"{core.where} is in manual mode, and remote {privilege} was not granted: {why}",
        "answer the question on the pendant with Grant, or switch to automatic mode there",
    )


_NO_RMMP = RwsOperation("-", "POST /users/rmmp", "-")
"""Every call of it is answered with status 500 [VC 8.1.1]."""


def cancel_rmmp(core: RwsCore) -> Flow[None]:
    """Release remote writing in manual mode; harmless if there is none."""
    if core.generation is not Generation.EIGHT:
        yield from ask(core, ops.CANCEL_RMMP, accepted=(400, 403, 404))


def _mode(core: RwsCore) -> Flow[str]:
    item = yield from one(core, ops.OPMODE, "pnl-opmode")
    return item.text("opmode")
