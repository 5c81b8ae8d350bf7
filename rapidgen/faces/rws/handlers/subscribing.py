"""Subscriptions asked for over HTTP; what is told goes over a websocket."""

from typing import TYPE_CHECKING

from rapidgen.faces.rws.asking import Answer, Asked, Refused
from rapidgen.faces.rws.routing import serves
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.events import Wanted, read_wanted, write_opened

if TYPE_CHECKING:
    from rapidgen.faces.rws.desk import Desk
    from rapidgen.faces.rws.subscriptions import Group


def _wanted(asked: Asked) -> list[Wanted]:
    try:
        return read_wanted(asked.pairs)
    except ValueError as error:
        raise Refused(400, "E_INVALIDARG", str(error)) from error


def _opened(desk: "Desk", asked: Asked, group: "Group", status: int) -> Answer:
    poll = f"{'ws' if asked.is_one else 'wss'}://{asked.host}/poll/{group.number}"
    body = write_opened(group.number, poll, desk.groups.initial(group))
    kind = "application/xhtml+xml" if asked.is_one else "application/xhtml+xml;v=2.0"
    return Answer(status, data=body, headers=(("Location", poll), ("Content-Type", kind)))


@serves(ops.SUBSCRIBE)
def subscribe(desk: "Desk", asked: Asked) -> Answer:
    """A new group; the body is XHTML whatever was asked for."""
    return _opened(desk, asked, desk.groups.begin(asked, _wanted(asked)), 201)


@serves(ops.ADD_SUBSCRIPTION)
def add(desk: "Desk", asked: Asked) -> Answer:
    """More resources for a group."""
    group = desk.groups.find(asked.names["group"], asked.session)
    desk.groups.add(asked, group, _wanted(asked))
    return _opened(desk, asked, group, 200)


@serves(ops.UNSUBSCRIBE)
def unsubscribe(desk: "Desk", asked: Asked) -> Answer:
    """Watch no more."""
    desk.groups.end(desk.groups.find(asked.names["group"], asked.session))
    return Answer(200)


@serves(ops.UNSUBSCRIBE_ONE)
def unsubscribe_one(desk: "Desk", asked: Asked) -> Answer:
    """One resource less."""
    group = desk.groups.find(asked.names["group"], asked.session)
    suffix = f";{asked.suffix}" if asked.suffix else ""
    desk.groups.remove(group, f"/{asked.names['resource']}{suffix}")
    return Answer(200)
