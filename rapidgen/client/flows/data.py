"""PERS of the robot's own program that the configuration lists."""

from rapidgen.client.core.program_stationary import fits
from rapidgen.client.core.robot import Core
from rapidgen.client.errors import NotSupported, RequestRefused
from rapidgen.client.flows.control import ask
from rapidgen.client.flows.effects import Flow
from rapidgen.diagnostics import suggest
from rapidgen.wire.simple_message import messages

Datum = float | bool | str
"""A num, a bool or a string."""


def read(core: Core, name: str) -> Flow[Datum]:
    """Read a PERS of `data:` by its name there."""
    return (yield from _reach(core, name, None, writes=False))


def write(core: Core, name: str, value: Datum) -> Flow[Datum]:
    """Write a PERS of `data:`; return its value as read afterwards."""
    return (yield from _reach(core, name, value, writes=True))


def _reach(core: Core, name: str, value: Datum | None, *, writes: bool) -> Flow[Datum]:
    known = core.known_group.data
    names = [datum.name for datum in known]
    if name not in names:
        raise NotSupported.because(
            "RG624",
            f"the configuration lists no datum '{name}'",
            suggest(name, names) or f"`data:` lists: {', '.join(names) or 'none'}",
        )
    index = names.index(name)
    datum = known[index]
    if writes and datum.access == "read":
        raise NotSupported.because(
            "RG624",
            f"'{name}' is listed for reading only",
            "`access: write` in the configuration; build and deploy again",
        )
    if writes and (value is None or not fits(datum.type, value)):
        raise ValueError(f"{name} is a {datum.type}: it cannot be {value!r}")
    number = 0.0 if value is None or isinstance(value, str) else float(value)
    text = value if isinstance(value, str) else ""
    requested = messages.DataRequest(index, int(writes), number, text)
    reply = yield from ask(core, requested, f"{'write' if writes else 'read'} {name}")
    if not isinstance(reply, messages.DataReply) or reply.datum != index:
        raise RequestRefused.because(
            "RG625", f"{name} was answered with {reply}", **core.evidence()
        )
    if datum.type == "string":
        return reply.text
    return reply.value == 1 if datum.type == "bool" else reply.value
