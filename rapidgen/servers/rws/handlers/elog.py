"""The event log: domains, entries with their arguments."""

from dataclasses import replace
from datetime import timedelta
from typing import TYPE_CHECKING

from rapidgen.machine.event_log import Event
from rapidgen.machine.event_table import KINDS, Domain
from rapidgen.machine.scheduler import date_time
from rapidgen.servers.rws.context import disk_path
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, page, show, whole
from rapidgen.servers.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext

_ALL = "0"
"""Domain 0 has the entries of all."""


def _events(context: "RwsContext", domain: str) -> list[Event]:
    known = {str(int(d)) for d in Domain}
    if domain not in known:
        raise RequestDenied(404, "E_UNRESOLVED_URL", f"no domain {domain}")
    return [e for e in context.controller.log if domain in (_ALL, str(int(e.domain)))]


@serves(ops.ELOGS)
def get_domains(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the domains and their numbers of entries."""
    result = []
    for domain in Domain:
        number = str(int(domain))
        count = str(len(_events(context, number)))
        notify = {"domain-name": domain.name.title(), "numevts": count, "buffsize": "1000"}
        result.append(Item("elog-domain-li", number, notify))
    return show(*result, collection=True)


@serves(ops.ELOG)
def get_events(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return entries of a domain, newest first; fifty at a time in RWS 2.0."""
    domain = request.names["domain"]
    events = _events(context, domain)[::-1]
    if request.query.get("resource") in ("info", "count"):
        notify = {"numevts": str(len(events)), "buffsize": "1000"}
        return show(Item("elog-domain", domain, notify))
    after = request.query.get("elogseqnum", "")
    if after:
        newest = whole("elogseqnum", after)
        events = [e for e in events if e.sequence > newest]
    return page(request, [_item(context, domain, e) for e in events], 50, domain)


@serves(ops.ELOG_EVENT)
def get_event(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return one entry."""
    domain, number = request.names["domain"], request.names["number"]
    for event in _events(context, domain):
        if str(event.sequence) == number:
            item = _item(context, domain, event)
            return show(Item("elog-message", item.title, item.fields, within=item.within))
    raise RequestDenied(404, "E_UNRESOLVED_URL", f"no entry {number}")


def _item(context: "RwsContext", domain: str, event: Event) -> Item:
    scheduler = context.controller.scheduler
    ago = timedelta(seconds=scheduler.now * 1e-9 - event.time)
    texts = event.arguments or tuple(text for text in (event.task, *event.texts) if text)
    kind = KINDS.get(event.code)
    notify = {
        "msgtype": str(int(event.type)),
        "code": str(event.code),
        "src-name": context.controller.system.name,
        "tstamp": (date_time(scheduler) - ago).strftime("%Y-%m-%d T %H:%M:%S"),
        "title": event.title,
        "desc": " ".join(text for text in (event.title, event.task, *event.texts) if text),
        "conseqs": "",
        "causes": kind.causes if kind is not None else "",
        "actions": kind.remedy if kind is not None else "",
        "argc": str(len(texts)),
    }
    within = tuple(
        Item("elog-arg", f"arg{i}", {"type": "STRING", "value": text})
        for i, text in enumerate(texts, 1)
    )
    return Item("elog-message-li", f"/rw/elog/{domain}/{event.sequence}", notify, within=within)


@serves(ops.CLEAR_ELOG)
def clear(context: "RwsContext", request: RwsRequest) -> None:
    """Delete all entries; here of all domains."""
    _events(context, request.names["domain"])
    context.controller.log.clear()


@serves(ops.CLEAR_ELOGS)
def clear_all(context: "RwsContext", request: RwsRequest) -> None:
    """Delete all entries of all domains."""
    context.controller.log.clear()


@serves(ops.ELOG_NUMBER)
def get_by_number(context: "RwsContext", request: RwsRequest) -> RwsResponse | None:
    """Return one entry by its number, in any domain."""
    return get_event(context, replace(request, names={"domain": _ALL, **request.names}))


@serves(ops.SAVE_ELOG)
def save(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Write all entries to a file, whose path begins with /fileservice."""
    text = request.field("path")
    if not text.startswith("/fileservice/"):
        raise RequestDenied(400, "E_INVALID_PATH", f"{text}: /fileservice/... is wanted")
    rows = [
        "\t".join((i.title, *(i.fields[k] for k in ("tstamp", "msgtype", "code", "desc"))))
        for i in (_item(context, _ALL, e) for e in _events(context, _ALL))
    ]
    context.write_file(disk_path(context, text, request), "\n".join([*rows, ""]).encode())
    return context.started("")
