"""Configuration: instances, and files in mode `add` or `replace`.

`add-with-reset` is never used.
"""

from collections.abc import Mapping
from typing import Literal
from urllib.parse import parse_qs

from rapidgen.client.rws.core import RwsCore
from rapidgen.client.rws.effects import Flow
from rapidgen.client.rws.flows.files import volume
from rapidgen.client.rws.flows.jobs import finish
from rapidgen.client.rws.flows.mastership import held
from rapidgen.client.rws.flows.request import ask
from rapidgen.client.rws.model import CfgInstance
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation, Item

Mode = Literal["add", "replace"]
_PAGES = 200


def cfg_domains(core: RwsCore) -> Flow[tuple[str, ...]]:
    """Names of the domains."""
    body, _ = yield from ask(core, ops.CFG)
    return tuple(item.title for item in body.all("cfg-domain-li"))


def cfg_types(core: RwsCore, domain: str) -> Flow[tuple[str, ...]]:
    """Types of a domain."""
    body, _ = yield from ask(core, ops.CFG_DOMAIN, {"domain": domain})
    return tuple(item.title for item in body.all("cfg-dt-li"))


def cfg_instances(core: RwsCore, domain: str, type: str) -> Flow[tuple[CfgInstance, ...]]:
    """Instances of a type with their attributes: one request for seventy."""
    result: list[Item] = []
    query = ""
    for _ in range(_PAGES):
        body, _ = yield from ask(
            core, ops.CFG_INSTANCES, {"domain": domain, "type": type}, query=query
        )
        result += body.all("cfg-dt-instance-li", "cfg-dt-instance")
        start = parse_qs(body.next.partition("?")[2]).get("start", [""])[0]
        if not start.isdecimal():
            break
        query = f"start={start}&limit=70"
    return tuple(CfgInstance(i.title, {a.title: a.text("value") for a in i.within}) for i in result)


def cfg_set(
    core: RwsCore, domain: str, type: str, instance: str, attributes: Mapping[str, str]
) -> Flow[None]:
    """Set attributes of an instance, effective after a restart."""
    one = core.generation is Generation.ONE
    form = {k: v if one else f"[{v},1]" for k, v in attributes.items()}
    names = {"domain": domain, "type": type, "instance": instance}
    yield from held(core, "cfg", ask(core, ops.CFG_SET, names, form))


def cfg_create(core: RwsCore, domain: str, type: str, instance: str) -> Flow[None]:
    """Create an instance with a name and default attributes."""
    names = {"domain": domain, "type": type}
    yield from held(core, "cfg", ask(core, ops.CFG_CREATE, names, {"name": instance}))


def cfg_delete(core: RwsCore, domain: str, type: str, instance: str) -> Flow[None]:
    """Delete an instance."""
    names = {"domain": domain, "type": type, "instance": instance}
    yield from held(core, "cfg", ask(core, ops.CFG_DELETE, names))


def cfg_load(core: RwsCore, path: str, *, mode: Mode = "add") -> Flow[None]:
    """Load a cfg file of a volume (`HOME/a.cfg`), effective after a restart."""
    if mode not in ("add", "replace"):
        raise ValueError("a cfg file is loaded by add or replace")
    form = {"filepath": volume(core, path), "action-type": mode}
    yield from held(core, "cfg", finish(core, ops.CFG_LOAD, {}, form))


def cfg_save(core: RwsCore, domain: str, path: str) -> Flow[None]:
    """Write a domain to a file on a volume."""
    form = {"filepath": f"/fileservice/{volume(core, path)}"}
    yield from ask(core, ops.CFG_SAVE, {"domain": domain}, form)
