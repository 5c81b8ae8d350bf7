"""The event log, with arguments."""

from rapidgen.client.rws.core import RwsCore
from rapidgen.client.rws.effects import Flow
from rapidgen.client.rws.flows.request import ask
from rapidgen.client.rws.model import LogEvent
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item, whole

_TYPES = {"1": "info", "2": "warning", "3": "error"}


def log(
    core: RwsCore, *, domain: int = 0, after: int = 0, count: int = 50
) -> Flow[tuple[LogEvent, ...]]:
    """Return the last `count` entries of a domain (0: all), oldest first.

    Only those newer than number `after`; at most fifty on RobotWare 7. One request.
    """
    query = "lang=en" + (f"&elogseqnum={after}" if after else "")
    body, _ = yield from ask(core, ops.ELOG, {"domain": str(domain)}, query=query)
    result = sorted(
        (_event(item) for item in body.all("elog-message-li", "elog-message")),
        key=lambda event: event.number,
    )
    return tuple(event for event in result if event.number > after)[-count:]


def _event(item: Item) -> LogEvent:
    parts = item.title.rsplit("/", 2)
    domain, number = parts[-2:] if len(parts) > 1 else ("", "")
    arguments = [one.text("value") for one in item.within]
    arguments += [v for k, v in item.fields.items() if k.startswith("arg") and k[3:].isdecimal()]
    return LogEvent(
        whole(domain),
        whole(number),
        _TYPES.get(item.text("msgtype"), "info"),
        item.whole("code"),
        item.text("tstamp").replace(" T ", " "),
        item.text("title"),
        item.text("desc"),
        tuple(arguments),
    )
