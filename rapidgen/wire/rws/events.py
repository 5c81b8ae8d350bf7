"""Subscriptions on the wire: requests, answers and events."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from html import escape

from rapidgen.wire.rws import xhtml
from rapidgen.wire.rws.bodies import Body, Generation, Item

PROTOCOLS = {
    Generation.ONE: "robapi2_subscription",
    Generation.TWO: "rws_subscription",
    Generation.EIGHT: "rws_subscription",
}
"""Names of the websocket's sub-protocol."""

_TWINS = {"rap-value-ev": ("rap-data",)}
"""An event of a persistent comes with the datum [code: abb_robot_client]."""


@dataclass(frozen=True, slots=True)
class WantedResource:
    """A resource and its priority.

    0 each 5 s, 1 each 200 ms, 2 immediately.
    """

    resource: str
    priority: int = 1


def write_wanted(expected: Sequence[WantedResource]) -> list[tuple[str, str]]:
    """Return the form that requests a subscription."""
    fields: list[tuple[str, str]] = []
    for i, one in enumerate(expected, 1):
        fields += [("resources", str(i)), (str(i), one.resource), (f"{i}-p", str(one.priority))]
    return fields


def read_wanted(pairs: Iterable[tuple[str, str]]) -> list[WantedResource]:
    """Return the resources of a subscription form.

    Indices may begin at 0, `resources` may come once for all.

    ValueError: no resource, or one without priority.
    """
    result = dict(pairs)
    numbers = sorted(int(key) for key in result if key.isdecimal())
    expected = []
    for number in numbers:
        priority = result.get(f"{number}-p", "1")
        if priority not in ("0", "1", "2"):
            raise ValueError(f"priority {priority}")
        expected.append(WantedResource(result[str(number)], int(priority)))
    if not expected:
        raise ValueError("no resources")
    return expected


def write_opened(number: int, poll: str, items: Iterable[Item]) -> bytes:
    """Return the body of 201: group, websocket address, current values.

    The address is in an open and a close tag, which a client's regular expression requires.
    """
    inside = "".join(_event(item) for item in items)
    return (
        '<?xml version="1.0" encoding="utf-8"?><html xmlns="http://www.w3.org/1999/xhtml"><head>'
        '<title>Event</title></head><body><div class="state">'
        f'<a href="subscription/{number}" rel="group"/><a href="{escape(poll)}" rel="self"></a>'
        f"<ul>{inside}</ul></div></body></html>"
    ).encode()


def write_events(items: Iterable[Item]) -> bytes:
    """Return an event as one line, for the websocket."""
    inside = "".join(_event(item) for item in items)
    return (
        '<?xml version="1.0" encoding="utf-8"?><html xmlns="http://www.w3.org/1999/xhtml"><head>'
        f'<title>Event</title></head><body><div class="state"><ul>{inside}</ul></div></body></html>'
    ).encode()


def _event(item: Item) -> str:
    kinds = (item.kind, *_TWINS.get(item.kind, ()))
    return "".join(xhtml.write_item(replace(item, kind=kind)) for kind in kinds)


def read_events(data: bytes) -> tuple[Item, ...]:
    """Return the events of a message.

    Unreadable: not an event message.
    """
    return xhtml.read(data).items


def read_opened(body: Body, location: str) -> tuple[str, str]:
    """Return (group, path of the websocket) of a 201.

    ValueError: one is missing. Only paths are taken: a controller's idea of its own address is not
    followed.
    """
    match = re.search(r"/poll/([\w-]{1,64})$", location or body.here)
    if match is None:
        raise ValueError("no subscription")
    return match[1], match[0]
