"""Remote answers to pendant dialogs (UI instructions).

[RWS manual 3HAC050973] TPReadFK and TPReadNum are answered by `TPAnswer` and then `TPCompleted`,
the others by `Result`.
"""

from typing import TYPE_CHECKING

from rapidgen.machine.operator import Question
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext


def active(context: "RwsContext") -> Question | None:
    """Return the newest open dialog of a task; None if there is none."""
    result = [q for q in context.controller.operator.questions if q.task]
    return result[-1] if result else None


def stack_of(question: Question) -> str:
    """Return a dialog's name: its place on the stack of its task."""
    return f"RAPID/{question.task}/%${question.number}"


def dialog_fields(question: Question, event: str = "SEND") -> dict[str, str]:
    """Return the fields of a dialog."""
    return {
        "instr": question.dialog,
        "event": event,
        "stack": stack_of(question),
        "execlv": "NORMAL",
        "msg": "",
    }


@serves(ops.DIALOG)
def get_dialog(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the open dialog; 404 without one [VC 6.16]."""
    question = active(context)
    if question is None:
        raise RequestDenied(404, "E_NO_DATA", "no active UI instruction")
    links = {"params": f"active/params/{stack_of(question)}".replace("%", "%25")}
    return show(Item("rap-uiactive-li", question.dialog, dialog_fields(question), links))


def _asked_for(context: "RwsContext", request: RwsRequest) -> Question:
    stack = request.names["stack"].lower()
    for question in context.controller.operator.questions:
        if question.task and stack_of(question).lower() in (stack, stack.replace("/$", "/%$")):
            return question
    raise RequestDenied(404, "E_NO_DATA", f"no UI instruction {stack}")


def _quoted(text: str) -> str:
    return '"' + text.replace('"', '""') + '"'


def _parameters(context: "RwsContext", question: Question) -> dict[str, str]:
    """Return values by name, as RAPID literals."""
    chosen = context.dialogs.get(question.number, "")
    if question.dialog.startswith("TP"):
        keys = {f"TPFK{i}": _quoted(text) for i, text in enumerate(question.choices, 1)}
        first = {"TPAnswer": chosen or "0", "TPText": _quoted(question.text)}
        return {**first, **keys, "TPCompleted": "FALSE"}
    header, _, remaining = question.text.partition("\n")
    lines = ",".join(map(_quoted, remaining.split("\n"))) if remaining else ""
    result = {"Header": _quoted(header), "MsgArray": f"[{lines}]"}
    if question.choices:
        name = "ListItems" if question.dialog == "UIListView" else "BtnArray"
        result[name] = f"[{','.join(map(_quoted, question.choices))}]"
    if question.proposed:
        result["InitValue"] = question.proposed
    return {**result, "Result": chosen or "0"}


@serves(ops.DIALOG_PARAMETERS)
def get_parameters(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return all parameters of a dialog."""
    result = _parameters(context, _asked_for(context, request)).items()
    items = (Item("rap-uiparams-li", name, {"value": value}) for name, value in result)
    return show(*items, collection=True)


@serves(ops.DIALOG_PARAMETER)
def get_parameter(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return one parameter of a dialog."""
    question, name = _asked_for(context, request), request.names["parameter"]
    match = {k.lower(): v for k, v in _parameters(context, question).items()}.get(name.lower())
    if match is None:
        raise RequestDenied(404, "E_NO_DATA", f"no parameter {name}")
    return show(Item("rap-uiparam", f"{stack_of(question)}/{name}", {"value": match}))


@serves(ops.SET_DIALOG_PARAMETER)
def set_parameter(context: "RwsContext", request: RwsRequest) -> None:
    """Set a parameter; a complete answer closes the dialog.

    The program continues then.
    """
    context.masters.need_mode(request.session)
    question, name = _asked_for(context, request), request.names["parameter"].lower()
    value = request.field("value").strip()
    if name == "tpcompleted":
        if value.upper() == "TRUE":
            _answer(context, question, context.dialogs.get(question.number, ""))
    elif name in ("tpanswer", "result"):
        context.dialogs[question.number] = value
        if name == "result":
            _answer(context, question, value)
    elif name not in {k.lower() for k in _parameters(context, question)}:
        raise RequestDenied(404, "E_NO_DATA", f"no parameter {name}")
    else:
        raise RequestDenied(400, "E_INVALIDARG", f"{name} is no answer")


def _answer(context: "RwsContext", question: Question, value: str) -> None:
    text = value
    if len(value) > 1 and value[0] == value[-1] == '"':
        text = value[1:-1].replace('""', '"')
    try:
        context.controller.operator.answer(question.number, text)
    except ValueError as error:
        raise RequestDenied(400, "E_INVALIDARG", str(error)) from error
    context.dialogs.pop(question.number, None)
