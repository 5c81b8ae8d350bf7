"""Identity, panel and execution: read, switch, start and stop."""

from rapidgen.client.errors import NotReady
from rapidgen.client.rws.core import RwsCore
from rapidgen.client.rws.effects import Flow, Pause
from rapidgen.client.rws.errors import NotConfirmed
from rapidgen.client.rws.flows.mastership import held
from rapidgen.client.rws.flows.request import ask
from rapidgen.client.rws.model import Identity, Panel, ProgramState
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation, Item
from rapidgen.wire.rws.operations import RwsOperation

_LOOKS = 20
_LOOK = 0.1
"""s between two checks whether a command has taken effect."""


def one(core: RwsCore, operation: RwsOperation, *kinds: str, **names: str) -> Flow[Item]:
    """Return the only item of an operation.

    Raises NotConfirmed (RG655) if it is missing.
    """
    body, _ = yield from ask(core, operation, names)
    result = body.all(*kinds)
    if not result:
        raise NotConfirmed.because("RG655", f"{core.where} returns no {kinds[0]}")
    return result[0]


def identity(core: RwsCore) -> Flow[Identity]:
    """Return the identity of the controller; one request."""
    info = yield from one(core, ops.IDENTITY, "ctrl-identity-info")
    return Identity(
        info.text("ctrl-name"),
        info.text("ctrl-id"),
        info.text("ctrl-type"),
        core.system,
        core.robotware,
    )


def panel(core: RwsCore) -> Flow[Panel]:
    """Motors, mode and speed: three requests."""
    state = yield from _state(core)
    mode = yield from one(core, ops.OPMODE, "pnl-opmode")
    speed = yield from one(core, ops.SPEED, "pnl-speedratio")
    return Panel(state, mode.text("opmode"), speed.whole("speedratio"))


def _state(core: RwsCore) -> Flow[str]:
    item = yield from one(core, ops.CTRL_STATE, "pnl-ctrlstate")
    return item.text("ctrlstate")


def execution(core: RwsCore) -> Flow[ProgramState]:
    """Return the state of the program's execution."""
    info = yield from one(core, ops.EXECUTION, "rap-execution")
    return ProgramState(info.text("ctrlexecstate") == "running", info.text("cycle"))


def motors(core: RwsCore, on: bool) -> Flow[None]:
    """Switch motors on or off; return when they are."""
    requested = "motoron" if on else "motoroff"
    yield from ask(core, ops.SET_CTRL_STATE, form={"ctrl-state": requested})
    state = ""
    for _ in range(_LOOKS):
        state = yield from _state(core)
        if state == requested:
            return
        yield Pause(_LOOK)
    raise NotConfirmed.because(
        "RG655",
        f"{core.where} agreed to {requested}, and is in state {state}",
        "look at the emergency stop and the guard stop; `log()` shows the cause",
    )


def set_speed(core: RwsCore, percent: int) -> Flow[None]:
    """Speed of all robots in percent, 0 to 100, in automatic mode; read back."""
    if not 0 <= percent <= 100:
        raise ValueError(f"a speed is 0 to 100 percent, not {percent}")
    form = {"speed-ratio": str(percent)}
    if core.generation is Generation.ONE:
        yield from ask(core, ops.SET_SPEED, form=form)
    else:
        yield from held(core, "edit", ask(core, ops.SET_SPEED, form=form))
    info = yield from one(core, ops.SPEED, "pnl-speedratio")
    if info.text("speedratio") != str(percent):
        raise NotConfirmed.because(
            "RG655", f"{core.where} agreed to {percent} %, and is at {info.text('speedratio')} %"
        )


def pp_to_main(core: RwsCore) -> Flow[None]:
    """Set program pointers of all tasks to main; the program must be stopped."""
    yield from held(core, "rapid", ask(core, ops.RESET_PP))


def start(core: RwsCore, *, cycle: str = "asis") -> Flow[None]:
    """Start the program of all selected tasks; return when it runs."""
    if core.held.keys() - {"write"}:
        raise NotReady.because(
            "RG658",
            "this session holds mastership, which keeps a program from running",
            "leave the `with controller.mastership()` block first",
        )
    form = {
        "regain": "continue",
        "execmode": "continue",
        "cycle": cycle,
        "condition": "none",
        "stopatbp": "disabled",
        "alltaskbytsp": "false",
    }
    if core.generation is Generation.EIGHT:
        yield from held(core, "write", _start_8(core, form))
    else:
        yield from ask(core, ops.START, form=form)
    for _ in range(_LOOKS):
        now = yield from execution(core)
        if now.running:
            return
        yield Pause(_LOOK)
    raise NotConfirmed.because(
        "RG655",
        f"{core.where} agreed to start, and the program does not run",
        "are the motors on, is the program pointer set? `log()` shows the cause",
    )


def _start_8(core: RwsCore, form: dict[str, str]) -> Flow[None]:
    yield from ask(core, ops.ALLOW_MOTION, form={"allow-motion-control": "true"})
    yield from ask(core, ops.START, form=form)


def stop(core: RwsCore, *, everything: bool = False) -> Flow[None]:
    """Stop the program; return when it has stopped."""
    form = {"stopmode": "stop", "usetsp": "alltsk" if everything else "normal"}
    yield from ask(core, ops.STOP, form=form)
    for _ in range(_LOOKS):
        now = yield from execution(core)
        if not now.running:
            return
        yield Pause(_LOOK)
    raise NotConfirmed.because(
        "RG655", f"{core.where} agreed to stop, and the program runs", "use the emergency stop"
    )
