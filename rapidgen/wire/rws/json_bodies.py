"""Bodies as JSON of RWS 1.0 and as HAL of RWS 2.0, both ways."""

import json
from collections.abc import Callable, Mapping

from rapidgen.wire.rws.bodies import Body, Fault, Item, Unreadable
from rapidgen.wire.rws.codes import OK
from rapidgen.wire.rws.xhtml import LARGEST

_WITHIN = {
    "elog-message": "argv",
    "elog-message-li": "argv",
    "sys-options": "sys-options-li",
    "sys-energy-state": "mechunits",
    "sys-energy-state-li": "mechunits",
    "sys-energy-mec-li": "axes",
}
"""Key of items within an item; else `attrib` [mem]."""
_Object = dict[str, object]


def write_json(body: Body) -> bytes:
    """Return a body as JSON of RWS 1.0: all items are in `_embedded._state`."""
    embedded: _Object = {"_state": [_item(item) for item in body.items]}
    if body.fault is not None:
        embedded["status"] = {"code": body.fault.code, "msg": body.fault.message}
    return json.dumps({"_links": _links(body), "_embedded": embedded}).encode()


def write_hal(body: Body) -> bytes:
    """Return a body as HAL.

    Single items are in `state`, collections embedded as `resources`.
    """
    links = _links(body)
    if body.fault is not None:
        status: _Object = {"code": body.fault.code, "msg": body.fault.message}
        return json.dumps({"_links": {"base": links.get("base", {})}, "status": status}).encode()
    complete: _Object = {"_links": links, "status": {"code": OK}}
    items = [_item(item) for item in body.items]
    if body.collection:
        complete["_embedded"] = {"resources": items}
    else:
        complete["state"] = items
    return json.dumps(complete).encode()


def _links(body: Body) -> dict[str, object]:
    links = {"base": body.base, "self": body.here, "next": body.next, **body.links}
    # These texts contain a literal `&amp;` [VC 7.21].
    return {rel: {"href": to.replace("&", "&amp;")} for rel, to in links.items() if to}


def _item(item: Item) -> _Object:
    report: _Object = {}
    if item.links:
        report["_links"] = {rel: {"href": to} for rel, to in item.links.items()}
    report |= {"_type": item.kind, "_title": item.title, **item.fields}
    if item.within:
        report[_WITHIN.get(item.kind, "attrib")] = [_item(one) for one in item.within]
    return report


def read(data: bytes) -> Body:
    """Return a body from JSON of either generation.

    Raises Unreadable.
    """
    if len(data) > LARGEST:
        raise Unreadable(f"{len(data)} bytes")
    try:
        complete = json.loads(data)
    except (ValueError, RecursionError) as error:
        raise Unreadable(f"no JSON: {error}") from error
    if not isinstance(complete, dict):
        raise Unreadable("no object")
    embedded = _object(complete.get("_embedded"))
    # Some resources of RWS 1.0 have their state at the top [VC 6.16].
    lists = (complete.get("state"), embedded.get("_state"), embedded.get("resources"))
    items = [_read_item(one, 0) for result in lists for one in _objects(result)]
    links = _hrefs(complete.get("_links"))
    base, current, following = (links.pop(rel, "") for rel in ("base", "self", "next"))
    return Body(
        tuple(items), "", base, current, following, links=links,
        collection="resources" in embedded,
        fault=_fault(complete.get("status") or embedded.get("status")),
    )  # fmt: skip


def _fault(status: object) -> Fault | None:
    report = _object(status)
    if not report:
        return None
    try:
        code = int(str(report.get("code", "")))
    except ValueError as error:
        raise Unreadable("a refusal without a code") from error
    return Fault(code, _text(report.get("msg", ""))) if code < 0 else None


def _object(data: object) -> Mapping[str, object]:
    return data if isinstance(data, dict) else {}


def _objects(data: object) -> list[Mapping[str, object]]:
    return [one for one in data if isinstance(one, dict)] if isinstance(data, list) else []


def _hrefs(data: object) -> dict[str, str]:
    return {
        rel: _text(_object(link).get("href", "")).replace("&amp;", "&")
        for rel, link in _object(data).items()
    }


def _read_item(data: Mapping[str, object], depth: int) -> Item:
    if depth > 8:
        raise Unreadable("items within items without end")
    fields: dict[str, str] = {}
    within: list[Item] = []
    for name, value in data.items():
        if isinstance(value, list):
            within += [_read_item(one, depth + 1) for one in _objects(value)]
        elif isinstance(value, str | int | float) and name not in ("_type", "_title"):
            fields[name.strip()] = _text(value)
    kind, title = _text(data.get("_type", "")), _text(data.get("_title", ""))
    return Item(kind, title, fields, _hrefs(data.get("_links")), tuple(within))


def _text(value: object) -> str:
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    return value if isinstance(value, str) else str(value)


WRITERS: dict[str, Callable[[Body], bytes]] = {"json": write_json, "hal": write_hal}
