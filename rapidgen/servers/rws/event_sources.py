"""Sources of subscriptions: the current value and its changes."""

import re
from collections.abc import Callable
from typing import TYPE_CHECKING
from urllib.parse import unquote

from rapidgen.machine.event_log import Event
from rapidgen.machine.scheduler import WaitSet
from rapidgen.runtime.text import literal_text
from rapidgen.runtime.values import PersistentCell
from rapidgen.servers.rws.handlers import (
    dialogs,
    execution,
    panel,
    pointers,
    queues,
    signals,
    symbols,
    tasks,
)
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest
from rapidgen.servers.rws.subscriptions import EventSource, Notify
from rapidgen.wire.rws.bodies import Item
from rapidgen.wire.rws.events import WantedResource
from rapidgen.wire.rws.operations import SYMBOL

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext


def watched(context: "RwsContext", request: RwsRequest, requested: WantedResource) -> EventSource:
    """Return the event source of a path such as `/rw/panel/ctrlstate`.

    RequestDenied: there is none.
    """
    path, _, suffix = requested.resource.partition(";")
    path = unquote(path).rstrip("/")
    for pattern, make in _KINDS:
        match = re.fullmatch(pattern, path)
        if match is not None:
            return make(context, request, requested.resource, suffix, match)
    raise RequestDenied(400, "E_INVALIDARG", f"cannot be subscribed: {requested.resource}")


_Make = Callable[["RwsContext", RwsRequest, str, str, re.Match[str]], EventSource]


def _on(wait: WaitSet, now: Callable[[], object], item: Callable[[], Item]) -> EventSource:
    """Return a source over a WaitSet that reports only changed values."""

    def watch(notify: Notify) -> Callable[[], None]:
        last = now()

        def look() -> None:
            nonlocal last
            if (value := now()) != last:
                last = value
                notify(None)

        wait.add(look)
        return lambda: wait.remove(look)

    return EventSource(item, watch)


def _panel(kind: str, name: str, read: Callable[["RwsContext"], str]) -> _Make:
    def make(
        context: "RwsContext", _a: RwsRequest, text: str, suffix: str, _m: re.Match[str]
    ) -> EventSource:
        if suffix not in ("", name):
            raise RequestDenied(400, "E_INVALIDARG", f"cannot be subscribed: {text}")
        href = text.partition(";")[0]

        def item() -> Item:
            return Item(kind, name, {name: read(context)}, {"self": href})

        return _on(context.controller.operation.changed, lambda: read(context), item)

    return make


def _execution(
    context: "RwsContext", _asked: RwsRequest, text: str, suffix: str, _m: re.Match[str]
) -> EventSource:
    kinds = {"ctrlexecstate": "rap-ctrlexecstate-ev", "rapidexeccycle": "rap-execcycle-ev"}
    if suffix not in kinds:
        raise RequestDenied(400, "E_INVALIDARG", f"cannot be subscribed: {text}")

    def read() -> str:
        c = context.controller
        return execution.execution(c) if suffix == "ctrlexecstate" else c.cycle

    def item() -> Item:
        return Item(kinds[suffix], suffix, {suffix: read()}, {"self": text})

    return _on(context.controller.operation.changed, read, item)


def _task(
    context: "RwsContext", request: RwsRequest, text: str, suffix: str, m: re.Match[str]
) -> EventSource:
    task, programs = tasks.find_task(context, m["task"], request), context.runner.programs
    if suffix == "taskchange":

        def change() -> Item:
            notify = {"change-count": str(programs.changes[task.name]), "task-name": task.name}
            return Item(
                "rap-task-ev", "taskchange", {**notify, "changetype": "module"}, {"self": text}
            )

        return _on(programs.changed, lambda: programs.changes[task.name], change)
    if suffix != "excstate":
        raise RequestDenied(400, "E_INVALIDARG", f"cannot be subscribed: {text}")

    def item() -> Item:
        notify = {"task-name": task.name, "pgmtaskexec-state": tasks.execution_state(task, request)}
        return Item("rap-execstate-ev", "execstatechange", notify, {"self": text})

    return _on(context.controller.operation.changed, lambda: task.state, item)


def _tasks(
    context: "RwsContext", _asked: RwsRequest, text: str, suffix: str, _m: re.Match[str]
) -> EventSource:
    programs = context.runner.programs
    if suffix != "buildlogchange":
        raise RequestDenied(400, "E_INVALIDARG", f"cannot be subscribed: {text}")

    def item() -> Item:
        count = str(sum(programs.changes.values()))
        return Item("rap-buildlog-ev", "buildlogchange", {"change-count": count}, {"self": text})

    return _on(programs.changed, lambda: sum(programs.changes.values()), item)


_POINTERS = {
    "programpointerchange": ("rap-pp-ev", "pp"), "motionpointerchange": ("rap-mp-ev", "mp"),
}  # fmt: skip


def _pointer(
    context: "RwsContext", request: RwsRequest, text: str, suffix: str, m: re.Match[str]
) -> EventSource:
    task = tasks.find_task(context, m["task"], request)
    if suffix not in _POINTERS:
        raise RequestDenied(400, "E_INVALIDARG", f"cannot be subscribed: {text}")
    kind, title = _POINTERS[suffix]

    def item() -> Item:
        place = pointers.place_of(task)
        row, column = (place.span.line, place.span.column) if place else (0, 0)
        notify = {
            "module-name": place.module if place else "",
            "routine-name": place.routine if place else "",
            "BegPosLine": str(row),
            "BegPosCol": str(column),
            "EndPosLine": str(row),
            "EndPosCol": str(column),
        }
        return Item(kind, title, notify, {"self": text})

    return _on(context.controller.operation.changed, lambda: pointers.place_of(task), item)


def _dialog(
    context: "RwsContext", _asked: RwsRequest, text: str, suffix: str, _m: re.Match[str]
) -> EventSource:
    operator = context.controller.operator
    if suffix != "uievent":
        raise RequestDenied(400, "E_INVALIDARG", f"cannot be subscribed: {text}")

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
                    notify(
                        Item("rap-ui-ev", "uiinstruction", dialogs.dialog_fields(question, event))
                    )

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


def _queue(
    context: "RwsContext", _asked: RwsRequest, text: str, suffix: str, m: re.Match[str]
) -> EventSource:
    queue = queues.find(context, m["queue"])
    if suffix not in ("", "nomessage"):
        raise RequestDenied(400, "E_INVALIDARG", f"cannot be subscribed: {text}")

    def watch(notify: Notify) -> Callable[[], None]:
        def look() -> None:
            if suffix:
                notify(Item("dipc-msg-ev", "msg", {}, {"self": text}))
                return
            while (fields := queues.taken(queue)) is not None:  # those from before, too
                notify(Item("dipc-msg-ev", "msg", fields, {"self": text}))

        queue.queue.changed.add(look)
        return lambda: queue.queue.changed.remove(look)

    return EventSource(lambda: Item("dipc-msg-ev"), watch, has_state=False)


def _mastership(
    context: "RwsContext", _asked: RwsRequest, text: str, _suffix: str, m: re.Match[str]
) -> EventSource:
    masters, domain = context.masters, m["domain"]
    if domain not in masters.domains:
        raise RequestDenied(400, "E_INVALIDARG", f"cannot be subscribed: {text}")

    def item() -> Item:
        holder = masters.holders.get(domain)
        notify = {
            "holdmastership": "TRUE" if holder else "FALSE",
            "uid": str(holder.number if holder else 0),
            "location": holder.location if holder else "",
            "alias": (holder.alias or holder.user) if holder else "",
            "application": holder.application if holder else "",
            "mastership": "remote" if holder else "nomaster",
        }
        return Item("msh-resource-value", domain, notify, {"self": text})

    return _on(masters.changed, lambda: masters.holders.get(domain), item)


def _signal(
    context: "RwsContext", _a: RwsRequest, text: str, suffix: str, m: re.Match[str]
) -> EventSource:
    if suffix != "state":
        raise RequestDenied(400, "E_INVALIDARG", f"cannot be subscribed: {text}")
    signal = signals.find(context, m["signal"])

    def item() -> Item:
        notify = {"lvalue": signals.value_of(signal), "lstate": "not simulated"}
        return Item("ios-signalstate-ev", signal.name, notify, {"self": text})

    def watch(notify: Notify) -> Callable[[], None]:
        def look() -> None:
            notify(None)

        signal.changed.add(look)
        return lambda: signal.changed.remove(look)

    return EventSource(item, watch, fast=True)


def _symbol(
    context: "RwsContext", request: RwsRequest, text: str, suffix: str, m: re.Match[str]
) -> EventSource:
    route = SYMBOL.route(request.generation)
    assert route is not None
    if suffix != "value":
        raise RequestDenied(400, "E_INVALIDARG", f"cannot be subscribed: {text}")
    result = symbols.find(context, m["symbol"], request)
    cell = result.task.cell(result.name)
    if not isinstance(cell, PersistentCell) or cell.cell is None:
        raise RequestDenied(400, "E_INVALIDARG", f"no persistent: {text}")
    # RWS 2.0 gives the address without the part after the semicolon [code: App SDK].
    href = text if request.is_one else text.partition(";")[0]

    def item() -> Item:
        value = literal_text(result.value, result.type)
        return Item("rap-value-ev", result.name, {"value": value}, {"self": href})

    def watch(notify: Notify) -> Callable[[], None]:
        def look() -> None:
            notify(None)

        cell.add(look)
        return lambda: cell.remove(look)

    return EventSource(item, watch, fast=True)


def _elog(
    context: "RwsContext", _a: RwsRequest, text: str, _suffix: str, m: re.Match[str]
) -> EventSource:
    domain = int(m["domain"])

    def event_item(event: Event) -> Item:
        href = f"/rw/elog/{domain}/{event.sequence}"
        return Item("elog-message-ev", href, {"seqnum": str(event.sequence)}, {"self": href})

    def watch(notify: Notify) -> Callable[[], None]:
        def take(event: Event) -> None:
            if domain in (0, int(event.domain)):
                notify(event_item(event))

        return context.controller.log.subscribe(take)

    return EventSource(lambda: Item("elog-message-ev"), watch, has_state=False)


_KINDS: tuple[tuple[str, _Make], ...] = (
    (r"/rw/panel/ctrl-?state", _panel(
        "pnl-ctrlstate-ev", "ctrlstate", lambda d: panel.ctrl_state(d.controller))),
    (r"/rw/panel/opmode", _panel("pnl-opmode-ev", "opmode", lambda d: panel.opmode(d.controller))),
    (r"/rw/panel/speedratio", _panel(
        "pnl-speedratio-ev", "speedratio", lambda d: str(panel.speed(d.controller)))),
    (r"/rw/panel/coldetstate", _panel("pnl-coldetstate-ev", "coldetstate", lambda _: "INIT")),
    (r"/rw/rapid/execution", _execution),
    (r"/rw/rapid/tasks", _tasks),
    (r"/rw/rapid/tasks/(?P<task>[^/]+)", _task),
    (r"/rw/rapid/tasks/(?P<task>[^/]+)/pcp", _pointer),
    (r"/rw/rapid/uiinstr", _dialog),
    (r"/rw/dipc/(?P<queue>[^/]+)", _queue),
    (r"/rw/mastership/(?P<domain>[^/]+)", _mastership),
    (r"/rw/iosystem/signals/(?P<signal>.+)", _signal),
    (r"/rw/rapid/symbol/data/RAPID/(?P<symbol>.+)", _symbol),
    (r"/rw/rapid/symbol/RAPID/(?P<symbol>.+)/data", _symbol),
    (r"/rw/elog/(?P<domain>\d{1,2})", _elog),
)  # fmt: skip
