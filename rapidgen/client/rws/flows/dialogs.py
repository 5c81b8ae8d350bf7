"""Dialogs of the pendant (UI instructions) and remote answers."""

from rapidgen.client.rws.core import RwsCore
from rapidgen.client.rws.effects import Flow, Pause
from rapidgen.client.rws.errors import NotConfirmed, RwsError
from rapidgen.client.rws.flows.request import ask
from rapidgen.client.rws.model import Dialog
from rapidgen.client.rws.values import RapidValue, write
from rapidgen.wire.rws import operations as ops

_LOOKS = 20
_LOOK = 0.1
"""s between two checks whether the dialog has closed."""


def dialog(core: RwsCore) -> Flow[Dialog | None]:
    """Return the open dialog with its parameters; None if there is none."""
    try:
        return (yield from _waiting(core))
    except RwsError as error:
        if error.status != 404:  # no dialog is open [VC 6.16]
            raise
        return None


def _waiting(core: RwsCore) -> Flow[Dialog]:
    body, _ = yield from ask(core, ops.DIALOG)
    dialogs = [item for item in body.all("rap-uiactive-li", "rap-uiactive") if item.text("stack")]
    if not dialogs:
        raise NotConfirmed.because("RG655", f"{core.where} returns no dialog")
    stack = dialogs[0].text("stack")
    # Some controllers cannot return parameters [VC 6.16, VC 7.21].
    names = {"stack": stack}
    result, _ = yield from ask(core, ops.DIALOG_PARAMETERS, names, accepted=(400, 404))
    values = {item.title: item.text("value") for item in result.all("rap-uiparams-li")}
    return Dialog(dialogs[0].text("instr"), stack, values)


def answer_dialog(core: RwsCore, value: RapidValue) -> Flow[None]:
    """Answer the open dialog: number of a key or button, a num, or a text."""
    waiting = yield from _waiting(core)
    if waiting.kind.lower().startswith("tp"):
        yield from _set(core, waiting, "TPAnswer", write(value))
        yield from _set(core, waiting, "TPCompleted", "TRUE")
    else:
        yield from _set(core, waiting, "Result", write(value))
    for _ in range(_LOOKS):
        now = yield from dialog(core)
        if now is None or now.stack != waiting.stack:
            return
        yield Pause(_LOOK)
    raise NotConfirmed.because(
        "RG655", f"{core.where} agreed to an answer, and {waiting.kind} waits still"
    )


def _set(core: RwsCore, waiting: Dialog, parameter: str, value: str) -> Flow[None]:
    names = {"stack": waiting.stack, "parameter": parameter}
    yield from ask(core, ops.SET_DIALOG_PARAMETER, names, {"value": value})
