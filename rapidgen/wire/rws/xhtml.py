"""Bodies as XHTML: `li` are items, `span` their fields, `a` links."""

from collections.abc import Iterator
from html import escape
from xml.etree.ElementTree import Element, ParseError

from defusedxml.common import DefusedXmlException
from defusedxml.ElementTree import fromstring

from rapidgen.wire.rws.bodies import Body, Fault, Item, Unreadable

_HEAD = '<?xml version="1.0" encoding="UTF-8"?><html xmlns="http://www.w3.org/1999/xhtml"><head>'
LARGEST = 16_000_000
"""Maximum bytes of a body that is parsed."""
_DEEPEST = 8
"""Maximum depth of items within items."""
_CONTROLS = (*range(9), 11, 12, *range(14, 32))
_SURROGATES = range(0xD800, 0xE000)
_FORBIDDEN = dict.fromkeys((*_CONTROLS, *_SURROGATES, 0xFFFE, 0xFFFF), "\N{REPLACEMENT CHARACTER}")
"""Characters that XML cannot hold; texts of RAPID may contain them."""


def text(value: str) -> str:
    """Return a value as text of an element."""
    return escape(value.translate(_FORBIDDEN), quote=False)


def quoted(value: str) -> str:
    """Return a value as an attribute, with its quotes."""
    return f'"{escape(value.translate(_FORBIDDEN))}"'


def write(body: Body) -> bytes:
    """Return a body as XHTML, UTF-8."""
    if body.fault is not None:
        return write_fault(body.fault, body.title, body.base)
    links = {"self": body.here, **({"next": body.next} if body.next else {}), **body.links}
    items = "".join(write_item(item) for item in body.items)
    return (
        f"{_HEAD}<title>{text(body.title)}</title><base href={quoted(body.base)}/></head>"
        f'<body><div class="state">{_links(links)}<ul>{items}</ul></div></body></html>'
    ).encode()


def write_fault(fault: Fault, title: str, base: str) -> bytes:
    """Return an error body.

    Errors of RWS 2.0 have no title [VC 7.21]: leave it empty.
    """
    named = f"<title>{text(title)}</title>" if title else ""
    return (
        f'{_HEAD}{named}<base href={quoted(base)}/></head><body><div class="status">'
        f'<span class="code">{fault.code}</span><span class="msg">{text(fault.message)}</span>'
        "</div></body></html>"
    ).encode()


def _links(links: dict[str, str]) -> str:
    return "".join(f"<a href={quoted(to)} rel={quoted(rel)}/>" for rel, to in links.items())


def write_item(item: Item) -> str:
    """Return one item."""
    spans = "".join(
        f"<span class={quoted(name)}>{text(value)}</span>" for name, value in item.fields.items()
    )
    within = "".join(write_item(one) for one in item.within)
    return (
        f"<li class={quoted(item.kind)} title={quoted(item.title)}>{_links(dict(item.links))}"
        f"{spans}{f'<ul>{within}</ul>' if within else ''}</li>"
    )


def read(data: bytes) -> Body:
    """Parse a body from XHTML.

    Raises Unreadable, also if it is larger than LARGEST.
    """
    if len(data) > LARGEST:
        raise Unreadable(f"{len(data)} bytes")
    try:
        root = fromstring(data)
    except (ParseError, DefusedXmlException, ValueError, LookupError) as error:
        raise Unreadable(f"no XHTML: {error}") from error
    items: list[Item] = []
    links: dict[str, str] = {}
    base = title = ""
    fault: Fault | None = None
    for element, path in _walk(root):
        tag = _tag(element)
        if tag == "base":
            base = element.get("href", "")
        elif tag == "title" and not path:
            title = element.text or ""
        elif tag == "div" and element.get("class") == "status":
            fault = _fault(element)
        elif tag == "a":
            links.setdefault(element.get("rel", ""), element.get("href", ""))
        elif tag == "li":
            items.append(_read_item(element, 0))
    current, following = links.pop("self", ""), links.pop("next", "")
    return Body(tuple(items), title, base, current, following, links=links, fault=fault)


def _walk(root: Element) -> Iterator[tuple[Element, str]]:
    """Yield elements outside items, in order.

    An item itself, but not its contents.
    """
    stack = [root]
    while stack:
        element = stack.pop()
        yield element, ""
        if _tag(element) != "li":
            stack.extend(reversed(element))


def _tag(element: Element) -> str:
    tag = element.tag
    return tag.rpartition("}")[2] if isinstance(tag, str) else ""


def _fault(element: Element) -> Fault:
    fields = {e.get("class", ""): e.text or "" for e in element.iter() if _tag(e) == "span"}
    try:
        return Fault(int(fields.get("code", "")), fields.get("msg", ""))
    except ValueError as error:
        raise Unreadable("a refusal without a code") from error


def _read_item(element: Element, depth: int) -> Item:
    if depth > _DEEPEST:
        raise Unreadable("items within items without end")
    fields: dict[str, str] = {}
    links: dict[str, str] = {}
    within: list[Item] = []
    for child in element:
        tag = _tag(child)
        if tag == "span":
            # RobotWare 6 writes `coldetstate ` with a trailing blank.
            fields[child.get("class", "").strip()] = "".join(child.itertext())
        elif tag == "a":
            links.setdefault(child.get("rel", ""), child.get("href", ""))
        elif tag in ("ul", "li"):
            inner = child if tag == "ul" else (child,)
            within += [_read_item(one, depth + 1) for one in inner if _tag(one) == "li"]
    kind, title = element.get("class", ""), element.get("title", "")
    return Item(kind, title, fields, links, tuple(within))
