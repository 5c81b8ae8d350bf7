"""The event log: domains, entries with their arguments."""

from dataclasses import replace
from datetime import timedelta
from typing import TYPE_CHECKING

from rapidgen.machine.calendar import date_time
from rapidgen.machine.event_log import Domain, Event
from rapidgen.servers.rws.disks import disk_path
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show, whole
from rapidgen.servers.rws.pagination import page
from rapidgen.servers.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext

_ALL = "0"
"""Domain 0 has the entries of all."""


def _events(office: "RwsContext", domain: str) -> list[Event]:
    known = {str(int(d)) for d in Domain}
    if domain not in known:
        raise RequestDenied(404, "E_UNRESOLVED_URL", f"no domain {domain}")
    return [e for e in office.controller.log if domain in (_ALL, str(int(e.domain)))]


@serves(ops.ELOGS)
def get_domains(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """The domains, and how many entries each has."""
    found = []
    for domain in Domain:
        number = str(int(domain))
        count = str(len(_events(office, number)))
        told = {"domain-name": domain.name.title(), "numevts": count, "buffsize": "1000"}
        found.append(Item("elog-domain-li", number, told))
    return show(*found, collection=True)


@serves(ops.ELOG)
def get_events(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Entries of a domain, newest first: by the fifty in RWS 2.0."""
    domain = asked.names["domain"]
    events = _events(office, domain)[::-1]
    if asked.query.get("resource") in ("info", "count"):
        told = {"numevts": str(len(events)), "buffsize": "1000"}
        return show(Item("elog-domain", domain, told))
    after = asked.query.get("elogseqnum", "")
    if after:
        newest = whole("elogseqnum", after)
        events = [e for e in events if e.sequence > newest]
    return page(asked, [_item(office, domain, e) for e in events], 50, domain)


@serves(ops.ELOG_EVENT)
def get_event(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """One entry."""
    domain, number = asked.names["domain"], asked.names["number"]
    for event in _events(office, domain):
        if str(event.sequence) == number:
            item = _item(office, domain, event)
            return show(Item("elog-message", item.title, item.fields, within=item.within))
    raise RequestDenied(404, "E_UNRESOLVED_URL", f"no entry {number}")


def _item(office: "RwsContext", domain: str, event: Event) -> Item:
    scheduler = office.controller.scheduler
    ago = timedelta(seconds=scheduler.now * 1e-9 - event.time)
    texts = [text for text in (event.task, *event.texts) if text]
    told = {
        "msgtype": str(int(event.type)),
        "code": str(event.code),
        "src-name": office.controller.system.name,
        "tstamp": (date_time(scheduler) - ago).strftime("%Y-%m-%d T %H:%M:%S"),
        "title": event.title,
        "desc": " ".join([event.title, *texts]),
        "conseqs": "",
        "causes": "",
        "actions": "",
        "argc": str(len(texts)),
    }
    within = tuple(
        Item("elog-arg", f"arg{i}", {"type": "STRING", "value": text})
        for i, text in enumerate(texts, 1)
    )
    return Item("elog-message-li", f"/rw/elog/{domain}/{event.sequence}", told, within=within)


@serves(ops.CLEAR_ELOG)
def clear(office: "RwsContext", asked: RwsRequest) -> None:
    """Forget all entries; here of all domains."""
    _events(office, asked.names["domain"])
    office.controller.log.clear()


@serves(ops.CLEAR_ELOGS)
def clear_all(office: "RwsContext", asked: RwsRequest) -> None:
    """Forget all entries of all domains."""
    office.controller.log.clear()


@serves(ops.ELOG_NUMBER)
def get_by_number(office: "RwsContext", asked: RwsRequest) -> RwsResponse | None:
    """One entry, whatever its domain."""
    return get_event(office, replace(asked, names={"domain": _ALL, **asked.names}))


@serves(ops.SAVE_ELOG)
def save(office: "RwsContext", asked: RwsRequest) -> RwsResponse:
    """Write all entries to a file, whose path begins with /fileservice."""
    words = asked.field("path")
    if not words.startswith("/fileservice/"):
        raise RequestDenied(400, "E_INVALID_PATH", f"{words}: /fileservice/... is wanted")
    rows = [
        "\t".join((i.title, *(i.fields[k] for k in ("tstamp", "msgtype", "code", "desc"))))
        for i in (_item(office, _ALL, e) for e in _events(office, _ALL))
    ]
    office.write_file(disk_path(office, words, asked), "\n".join([*rows, ""]).encode())
    return office.started("")
