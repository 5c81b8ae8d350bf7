"""Long operations: jobs, backups, and restarts with their wait."""

from collections.abc import Mapping

from rapidgen.client.errors import ConnectionFailed, ConnectionLost, RobotTimeout
from rapidgen.client.rws.core import RwsCore
from rapidgen.client.rws.effects import Flow, Pause
from rapidgen.client.rws.errors import Busy, LoginFailed, NotConfirmed, RwsError
from rapidgen.client.rws.flows.connect import close, connect
from rapidgen.client.rws.flows.files import volume
from rapidgen.client.rws.flows.mastership import give, holder, take
from rapidgen.client.rws.flows.rapid import tasks
from rapidgen.client.rws.flows.request import ask
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Fault
from rapidgen.wire.rws.forms import Fields
from rapidgen.wire.rws.operations import RwsOperation

_LOOK = 1.0
"""s between two checks of a job or a restarting controller."""
_LONGEST = 600.0
"""s permitted to a backup or a load."""


def finish(
    core: RwsCore, operation: RwsOperation, names: Mapping[str, str], form: Fields
) -> Flow[None]:
    """Request a job and wait for its end.

    Raises RwsError (RG650), RobotTimeout (RG602).
    """
    _, response = yield from ask(core, operation, names, form)
    number = response.headers.get("location", "").rpartition("/progress/")[2]
    if response.status != 202 or not number.isalnum():
        return
    until = core.clock() + _LONGEST
    while core.clock() < until:
        body, _ = yield from ask(core, ops.PROGRESS, {"id": number})
        item = body.first("progress")
        if item is not None and item.text("state") == "ready":
            code = item.whole("code")
            if code < 0:
                raise RwsError(response.status, operation.two, Fault(code, "the job failed"))
            return
        yield Pause(_LOOK)
    raise RobotTimeout.because("RG602", f"{operation.two} did not end within {_LONGEST:g} s")


def backup(core: RwsCore, name: str, *, volume_name: str = "BACKUP") -> Flow[str]:
    """Make a backup in a new folder on the controller; return its path."""
    path = f"{volume_name}/{name}"
    form = {"backup": f"/fileservice/{volume(core, path)}"}
    yield from finish(core, ops.BACKUP, {}, form)
    return path


def restart(core: RwsCore, *, wait: float = 180.0) -> Flow[None]:
    """Warm-start the controller, and wait s until it serves again."""
    yield from _restarted(core, ops.RESTART, {"restart-mode": "restart"}, wait)


def restore(core: RwsCore, path: str, *, wait: float = 180.0) -> Flow[None]:
    """Restart with a backup on the controller (`BACKUP/name`)."""
    form = {"backup": f"/fileservice/{volume(core, path)}"}
    yield from _restarted(core, ops.RESTORE, form, wait)


def _restarted(core: RwsCore, operation: RwsOperation, form: Fields, wait: float) -> Flow[None]:
    """Request a restart, and wait s until the controller serves again."""
    yield from take(core, "cfg")
    try:
        yield from ask(core, operation, form=form)
    except ConnectionLost:
        pass  # it restarted before its answer; the next step checks this
    except RwsError:
        yield from give(core, "cfg")
        raise
    yield from _gone(core, wait)
    core.held.clear()
    # The check may have logged in after the restart already.
    yield from close(core)
    yield from wait_ready(core, wait=wait)


def _gone(core: RwsCore, wait: float) -> Flow[None]:
    """Wait until the restart has ended the mastership of this session.

    Raises NotConfirmed (RG655).
    """
    until = core.clock() + wait
    while core.clock() < until:
        try:
            who = yield from holder(core, "cfg")
        except (ConnectionLost, ConnectionFailed, Busy, RwsError):
            return
        if who is None or not who.mine:
            return
        yield Pause(_LOOK)
    yield from give(core, "cfg")
    raise NotConfirmed.because(
        "RG655", f"{core.where} agreed to restart, and did not in {wait:g} s"
    )


def wait_ready(core: RwsCore, *, wait: float = 180.0) -> Flow[None]:
    """Wait s until the controller answers, accepts a login and has tasks."""
    until = core.clock() + wait
    last: Exception | None = None
    while core.clock() < until:
        try:
            yield from connect(core)
            if (yield from tasks(core)):
                return
        except RwsError as error:
            last = error  # the controller boots: keep the session, so that none is abandoned
        except (ConnectionFailed, ConnectionLost, Busy) as error:
            if isinstance(error, LoginFailed) and error.diagnostics[0].code == "RG652":
                raise
            last = error
            core.connected = False
        yield Pause(_LOOK)
    raise RobotTimeout.because("RG602", f"{core.where} did not come back within {wait:g} s: {last}")
