"""What can be subscribed: what it is now, and who tells that it changed."""

import re
from collections.abc import Callable
from typing import TYPE_CHECKING
from urllib.parse import unquote

from rapidgen.faces.rws.asking import Denied, RwsRequest
from rapidgen.faces.rws.handlers import execution, panel, signals, symbols, tasks
from rapidgen.faces.rws.subscriptions import Told, Watched
from rapidgen.machine.log import Event
from rapidgen.machine.scheduler import WaitSet
from rapidgen.runtime.text import literal_text
from rapidgen.runtime.values import PersistentCell
from rapidgen.wire.rws.bodies import Item
from rapidgen.wire.rws.events import WantedResource
from rapidgen.wire.rws.operations import SYMBOL

if TYPE_CHECKING:
    from rapidgen.faces.rws.office import Office


def watched(office: "Office", asked: RwsRequest, wanted: WantedResource) -> Watched:
    """The resource of a text such as `/rw/panel/ctrlstate`. Denied: nothing of the kind."""
    path, _, suffix = wanted.resource.partition(";")
    path = unquote(path).rstrip("/")
    for pattern, make in _KINDS:
        match = re.fullmatch(pattern, path)
        if match is not None:
            return make(office, asked, wanted.resource, suffix, match)
    raise Denied(400, "E_INVALIDARG", f"cannot be subscribed: {wanted.resource}")


_Make = Callable[["Office", RwsRequest, str, str, re.Match[str]], Watched]


def _on(wait: WaitSet, now: Callable[[], object], item: Callable[[], Item]) -> Watched:
    """Watched through a WaitSet; told only when `now()` has another value."""

    def watch(told: Told) -> Callable[[], None]:
        last = now()

        def look() -> None:
            nonlocal last
            if (value := now()) != last:
                last = value
                told(None)

        wait.add(look)
        return lambda: wait.remove(look)

    return Watched(item, watch)


def _panel(kind: str, name: str, read: Callable[["Office"], str]) -> _Make:
    def make(
        office: "Office", _a: RwsRequest, text: str, suffix: str, _m: re.Match[str]
    ) -> Watched:
        if suffix not in ("", name):
            raise Denied(400, "E_INVALIDARG", f"cannot be subscribed: {text}")
        href = text.partition(";")[0]

        def item() -> Item:
            return Item(kind, name, {name: read(office)}, {"self": href})

        return _on(office.controller.operation.changed, lambda: read(office), item)

    return make


def _execution(
    office: "Office", _asked: RwsRequest, text: str, suffix: str, _m: re.Match[str]
) -> Watched:
    kinds = {"ctrlexecstate": "rap-ctrlexecstate-ev", "rapidexeccycle": "rap-execcycle-ev"}
    if suffix not in kinds:
        raise Denied(400, "E_INVALIDARG", f"cannot be subscribed: {text}")

    def read() -> str:
        c = office.controller
        return execution.execution(c) if suffix == "ctrlexecstate" else c.cycle

    def item() -> Item:
        return Item(kinds[suffix], suffix, {suffix: read()}, {"self": text})

    return _on(office.controller.operation.changed, read, item)


def _task(office: "Office", asked: RwsRequest, text: str, suffix: str, m: re.Match[str]) -> Watched:
    task = tasks.find_task(office, m["task"], asked)
    if suffix != "excstate":
        raise Denied(400, "E_INVALIDARG", f"cannot be subscribed: {text}")

    def item() -> Item:
        state = {"excstate": tasks.execution_state(task, asked)}
        return Item("rap-execstate-ev", task.name, state, {"self": text})

    return _on(office.controller.operation.changed, lambda: task.state, item)


def _signal(office: "Office", _a: RwsRequest, text: str, suffix: str, m: re.Match[str]) -> Watched:
    if suffix != "state":
        raise Denied(400, "E_INVALIDARG", f"cannot be subscribed: {text}")
    signal = signals.find(office, m["signal"])

    def item() -> Item:
        told = {"lvalue": signals.value_of(signal), "lstate": "not simulated"}
        return Item("ios-signalstate-ev", signal.name, told, {"self": text})

    def watch(told: Told) -> Callable[[], None]:
        def look() -> None:
            told(None)

        signal.changed.add(look)
        return lambda: signal.changed.remove(look)

    return Watched(item, watch, fast=True)


def _symbol(
    office: "Office", asked: RwsRequest, text: str, suffix: str, m: re.Match[str]
) -> Watched:
    route = SYMBOL.route(asked.generation)
    assert route is not None
    if suffix != "value":
        raise Denied(400, "E_INVALIDARG", f"cannot be subscribed: {text}")
    found = symbols.find(office, m["symbol"], asked)
    cell = found.task.cell(found.name)
    if not isinstance(cell, PersistentCell) or cell.cell is None:
        raise Denied(400, "E_INVALIDARG", f"no persistent: {text}")
    # RWS 2.0 gives the address without what follows the semicolon [code: App SDK].
    href = text if asked.is_one else text.partition(";")[0]

    def item() -> Item:
        value = literal_text(found.value, found.type)
        return Item("rap-value-ev", found.name, {"value": value}, {"self": href})

    def watch(told: Told) -> Callable[[], None]:
        def look() -> None:
            told(None)

        cell.add(look)
        return lambda: cell.remove(look)

    return Watched(item, watch, fast=True)


def _elog(office: "Office", _a: RwsRequest, text: str, _suffix: str, m: re.Match[str]) -> Watched:
    domain = int(m["domain"])

    def event_item(event: Event) -> Item:
        href = f"/rw/elog/{domain}/{event.sequence}"
        return Item("elog-message-ev", href, {"seqnum": str(event.sequence)}, {"self": href})

    def watch(told: Told) -> Callable[[], None]:
        def take(event: Event) -> None:
            if domain in (0, int(event.domain)):
                told(event_item(event))

        return office.controller.log.subscribe(take)

    return Watched(lambda: Item("elog-message-ev"), watch, has_state=False)


_KINDS: tuple[tuple[str, _Make], ...] = (
    (r"/rw/panel/ctrl-?state", _panel(
        "pnl-ctrlstate-ev", "ctrlstate", lambda d: panel.ctrl_state(d.controller))),
    (r"/rw/panel/opmode", _panel("pnl-opmode-ev", "opmode", lambda d: panel.opmode(d.controller))),
    (r"/rw/panel/speedratio", _panel(
        "pnl-speedratio-ev", "speedratio", lambda d: str(panel.speed(d.controller)))),
    (r"/rw/panel/coldetstate", _panel("pnl-coldetstate-ev", "coldetstate", lambda _: "INIT")),
    (r"/rw/rapid/execution", _execution),
    (r"/rw/rapid/tasks/(?P<task>[^/]+)", _task),
    (r"/rw/iosystem/signals/(?P<signal>.+)", _signal),
    (r"/rw/rapid/symbol/data/RAPID/(?P<symbol>.+)", _symbol),
    (r"/rw/rapid/symbol/RAPID/(?P<symbol>.+)/data", _symbol),
    (r"/rw/elog/(?P<domain>\d{1,2})", _elog),
)  # fmt: skip
