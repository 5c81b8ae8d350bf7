"""Remote answers to pendant dialogs (UI instructions).

[RWS manual 3HAC050973] TPReadFK and TPReadNum are answered by `TPAnswer` and then `TPCompleted`,
the others by `Result`.
"""

from collections.abc import Callable

from rapidgen.machine.operator import Question
from rapidgen.servers.rws.application import RwsApplication, serves
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.subscriptions import EventSource, Notify, Topic, subscribable
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item


def active(app: RwsApplication) -> Question | None:
    """Return the newest open dialog of a task; None if there is none."""
    result = [q for q in app.controller.operator.questions if q.task]
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
def get_dialog(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the open dialog; 404 without one [VC 6.16]."""
    question = active(app)
    if question is None:
        raise RequestDenied(404, "E_NO_DATA", "no active UI instruction")
    links = {"params": f"active/params/{stack_of(question)}".replace("%", "%25")}
    return show(Item("rap-uiactive-li", question.dialog, dialog_fields(question), links))


def _asked_for(app: RwsApplication, request: RwsRequest) -> Question:
    stack = request.names["stack"].lower()
    for question in app.controller.operator.questions:
        if question.task and stack_of(question).lower() in (stack, stack.replace("/$", "/%$")):
            return question
    raise RequestDenied(404, "E_NO_DATA", f"no UI instruction {stack}")


def _quoted(text: str) -> str:
    return '"' + text.replace('"', '""') + '"'


def _parameters(app: RwsApplication, question: Question) -> dict[str, str]:
    """Return values by name, as RAPID literals."""
    chosen = app.dialogs.get(question.number, "")
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
def get_parameters(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return all parameters of a dialog."""
    result = _parameters(app, _asked_for(app, request)).items()
    items = (Item("rap-uiparams-li", name, {"value": value}) for name, value in result)
    return show(*items, collection=True)


@serves(ops.DIALOG_PARAMETER)
def get_parameter(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return one parameter of a dialog."""
    question, name = _asked_for(app, request), request.names["parameter"]
    match = {k.lower(): v for k, v in _parameters(app, question).items()}.get(name.lower())
    if match is None:
        raise RequestDenied(404, "E_NO_DATA", f"no parameter {name}")
    return show(Item("rap-uiparam", f"{stack_of(question)}/{name}", {"value": match}))


@serves(ops.SET_DIALOG_PARAMETER)
def set_parameter(app: RwsApplication, request: RwsRequest) -> None:
    """Set a parameter; a complete answer closes the dialog.

    The program continues then.
    """
    app.masterships.need_mode(request.session)
    question, name = _asked_for(app, request), request.names["parameter"].lower()
    value = request.field("value").strip()
    if name == "tpcompleted":
        if value.upper() == "TRUE":
            _answer(app, question, app.dialogs.get(question.number, ""))
    elif name in ("tpanswer", "result"):
        app.dialogs[question.number] = value
        if name == "result":
            _answer(app, question, value)
    elif name not in {k.lower() for k in _parameters(app, question)}:
        raise RequestDenied(404, "E_NO_DATA", f"no parameter {name}")
    else:
        raise RequestDenied(400, "E_INVALIDARG", f"{name} is no answer")


def _answer(app: RwsApplication, question: Question, value: str) -> None:
    text = value
    if len(value) > 1 and value[0] == value[-1] == '"':
        text = value[1:-1].replace('""', '"')
    try:
        app.controller.operator.answer(question.number, text)
    except ValueError as error:
        raise RequestDenied(400, "E_INVALIDARG", str(error)) from error
    app.dialogs.pop(question.number, None)


@subscribable("/rw/rapid/uiinstr", "uievent")
def dialog_events(app: RwsApplication, topic: Topic) -> EventSource:
    """Dialogs that open or are withdrawn, and lines of TPWrite."""
    operator = app.controller.operator

    def watch(notify: Notify) -> Callable[[], None]:
        seen = {q.number: q for q in operator.questions if q.task}

        def look() -> None:
            now = {q.number: q for q in operator.questions if q.task}
            gone = [q for number, q in seen.items() if number not in now and not q.answered]
            new = [q for number, q in now.items() if number not in seen]
            seen.clear()
            seen.update(now)
            for event, questions in (("ABORT", gone), ("SEND", new)):
                for question in questions:
                    notify(Item("rap-ui-ev", "uiinstruction", dialog_fields(question, event)))

        def written(task: str, line: str) -> None:
            stack = {"stack": f"RAPID/{task}/", "execlv": "NORMAL", "msg": f'"{line}"'}
            fields = {"instr": "TPWrite", "event": "POST", **stack}
            notify(Item("rap-ui-ev", "uiinstruction", fields))

        def end() -> None:
            operator.asked.remove(look)
            no_more()

        operator.asked.add(look)
        no_more = operator.subscribe(written)
        return end

    return EventSource(lambda: Item("rap-ui-ev"), watch, has_state=False)
