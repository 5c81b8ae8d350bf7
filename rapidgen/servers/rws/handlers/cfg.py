"""Configuration: read, single instances, whole files.

Changes take effect after a restart.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from rapidgen._reading import read_foreign
from rapidgen.diagnostics import DiagnosticError
from rapidgen.servers.rws.context import disk_path
from rapidgen.servers.rws.default_cfg import DOMAINS, built_in
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, page, show
from rapidgen.servers.rws.routing import serves
from rapidgen.system.cfg import Attribute, CfgText, Instance, Section, parse_cfg, scalar, write_cfg
from rapidgen.system.cfg_loading import CfgFileLoad, LoadResult, add, identity_text
from rapidgen.system.paths import MAX_FILE
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item
from rapidgen.wire.rws.codes import OK

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext


def _domain(context: "RwsContext", request: RwsRequest) -> CfgText:
    name = request.names["domain"].upper()
    for text in context.runner.cfg.domains:
        if text.domain == name:
            return text
    if name in DOMAINS:
        return CfgText(name, context.runner.cfg.domains[0].version, ())
    raise RequestDenied(400 if request.is_one else 404, "E_CFG_DOMAIN_INVALID", name)


def _title(section: str, instance: Instance) -> str:
    return " ".join(part for part in identity_text(section, instance) if part)


@serves(ops.CFG)
def get_domains(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the domains."""
    return show(
        *(Item("cfg-domain-li", name) for name in DOMAINS),
        collection=True,
    )


@serves(ops.CFG_DOMAIN)
def get_types(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the types of a domain."""
    text = _domain(context, request)
    names = dict.fromkeys(section.name for section in text.sections)
    names |= dict.fromkeys(kind for domain, kind in built_in(context) if domain == text.domain)
    return show(*(Item("cfg-dt-li", name) for name in names), collection=True)


@serves(ops.CFG_INSTANCES)
def get_instances(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return instances of a type with their attributes.

    RWS 2.0 returns seventy at a time [VC 7.21].
    """
    result = [_item(request, i) for i in _instances(context, request)]
    return page(request, result, 70, "instances", always=True)


@serves(ops.CFG_INSTANCE)
def get_instance(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return one instance."""
    return show(_item(request, _one(context, request)))


def _instances(context: "RwsContext", request: RwsRequest) -> Iterator[Instance]:
    """Return the database's instances of a type, else the default ones."""
    text, kind = _domain(context, request), request.names["type"]
    result = tuple(text.instances(kind))
    return iter(result or built_in(context).get((text.domain, kind.upper()), ()))


def _is_built_in(context: "RwsContext", text: CfgText, kind: str) -> bool:
    return (text.domain, kind.upper()) in built_in(context)


def _one(context: "RwsContext", request: RwsRequest) -> Instance:
    name, section = request.names["instance"], request.names["type"]
    for instance in _instances(context, request):
        if _title(section, instance).casefold() == name.casefold():
            return instance
    raise RequestDenied(400 if request.is_one else 404, "E_CFG_INSTANCE_INVALID", name)


def _item(request: RwsRequest, instance: Instance) -> Item:
    kind = request.kind("cfg-ia-t-li", "cfg-ia-t")
    within = tuple(
        Item(kind, a.name, {"value": _value(a), "rdonly": "false"}) for a in instance.attributes
    )
    title = _title(request.names["type"], instance)
    return Item("cfg-dt-instance-li", title, {"rdonly": "false"}, within=within)


def _value(attribute: Attribute) -> str:
    """Format a value: a flag is true; several values are concatenated."""
    return " ".join(map(str, attribute.values)) if attribute.values else "true"


@serves(ops.CFG_ATTRIBUTES)
def get_attributes(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the attributes of a type's instances."""
    names = dict.fromkeys(a.name for i in _instances(context, request) for a in i.attributes)
    result = (
        Item("cfg-dt-attribute", name, {"name": name, "mandatory": "false"}) for name in names
    )
    return show(*result, collection=True)


# -- single instances ----------------------------------------------------------------------------


def _with(context: "RwsContext", request: RwsRequest, instances: tuple[Instance, ...]) -> None:
    """Return the database with the instances of a type replaced."""
    text, name = _domain(context, request), request.names["type"]
    if not any(True for _ in text.instances(name)) and _is_built_in(context, text, name):
        raise RequestDenied(403, "E_REJECT", f"{name} is read only", -2)
    at = [i for i, s in enumerate(text.sections) if s.name.casefold() == name.casefold()]
    sections = [None if i in at else s for i, s in enumerate(text.sections)]
    if not at:
        sections.append(Section(name, instances))
    elif instances:
        sections[at[0]] = Section(text.sections[at[0]].name, instances)
    changed = replace(text, sections=tuple(s for s in sections if s is not None))
    cfg = context.runner.cfg
    domains = tuple(changed if d.domain == text.domain else d for d in cfg.domains)
    if changed not in domains:
        domains = (*domains, changed)
    context.runner.cfg = replace(cfg, domains=domains)


def _attribute(name: str, value: str, *, is_one: bool) -> Attribute | None:
    """Parse `Attr=v` of RWS 1.0 or `Attr=[v,1]` of 2.0.

    None: a flag that is false.
    """
    if not is_one:
        if not (value.startswith("[") and value.endswith("]") and "," in value):
            raise RequestDenied(400, "E_CFG_ATTRIBUTE_INVALID", f"{name}={value}: [value,1]")
        value = value[1:-1].rpartition(",")[0]
    if value.lower() in ("true", "false"):
        return Attribute(name) if value.lower() == "true" else None
    return Attribute(name, (scalar(value),))


@serves(ops.CFG_SET)
def set_instance(context: "RwsContext", request: RwsRequest) -> None:
    """Set attributes of an instance."""
    if not request.is_one:  # RobotWare 6 takes mastership by itself [VC 6.16]
        context.masters.need(request, "cfg")
    old = _one(context, request)
    attributes = {a.name.casefold(): a for a in old.attributes}
    for name, value in request.pairs:
        made = _attribute(name, value, is_one=request.is_one)
        attributes.pop(name.casefold(), None)
        if made is not None:
            attributes[name.casefold()] = made
    new = replace(old, attributes=tuple(attributes.values()))
    _with(context, request, tuple(new if i is old else i for i in _instances(context, request)))


@serves(ops.CFG_CREATE)
def create_instance(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Create an instance with a name and default attributes."""
    if not request.is_one:
        context.masters.need(request, "cfg")
    name, section = request.field("name"), request.names["type"]
    present = tuple(_instances(context, request))
    if any(_title(section, i).casefold() == name.casefold() for i in present):
        raise RequestDenied(400, "E_CFG_NAME_EXIST", name)
    _with(context, request, (*present, Instance((Attribute("Name", (name,)),))))
    return RwsResponse(201)


@serves(ops.CFG_DELETE)
def delete_instance(context: "RwsContext", request: RwsRequest) -> None:
    """Delete an instance."""
    if not request.is_one:
        context.masters.need(request, "cfg")
    old = _one(context, request)
    _with(context, request, tuple(i for i in _instances(context, request) if i is not old))


# -- whole files ---------------------------------------------------------------------------------


def _load(context: "RwsContext", request: RwsRequest) -> LoadResult:
    """Return the database with a file loaded.

    With `add` any conflict rejects the whole file. Raises RequestDenied.
    """
    mode = request.field("action-type", ("add", "replace", "add-with-reset"))
    words = request.field("filepath")
    if words.startswith("/fileservice"):
        raise RequestDenied(400, "E_INVALID_PATH", f"{words}: a bare path is wanted")
    path = disk_path(context, words, request)
    try:
        data = read_foreign(path, MAX_FILE)
        text = parse_cfg(data, path=words)
    except OSError as error:
        raise RequestDenied(400 if request.is_one else 404, "E_FILE_NOT_FOUND", words) from error
    except DiagnosticError as error:
        raise RequestDenied(400, "E_CFG_DATA_INCORRECT", str(error)) from error
    base = context.runner.cfg
    if mode == "add-with-reset":
        saved = tuple(d for d in base.domains if d.domain != text.domain)
        base = replace(base, domains=(*saved, CfgText(text.domain, text.version, ())))
    addition = CfgFileLoad(text, replace=mode == "replace", ascii=data.isascii())
    return add(base, [addition], open_words=True)


def _why(loaded: LoadResult) -> tuple[str, str]:
    first = loaded.faults[0]
    exists = first.code == "RG721"
    return ("E_CFG_NAME_EXIST" if exists else "E_CFG_DATA_INCORRECT"), first.message


@serves(ops.CFG_LOAD)
def load(context: "RwsContext", request: RwsRequest) -> RwsResponse | None:
    """Load a file; RWS 2.0 returns the address of the job's result."""
    context.masters.need(request, "cfg")
    loaded = _load(context, request)
    if loaded.faults:
        for fault in loaded.faults:
            context.controller.log.error(120_003, "Configuration file not loaded", fault.message)
        name, why = _why(loaded)
        if request.is_one:
            raise RequestDenied(400, name, why)
        return context.started(name)
    context.runner.cfg = loaded.cfg
    return None if request.is_one else context.started("")


@serves(ops.CFG_VALIDATE)
def validate(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the result of a load without changing the database."""
    loaded = _load(context, request)
    if loaded.faults:
        raise RequestDenied(400, *_why(loaded))
    return show(Item("cfg-validate", "validate", {"code": str(OK)}))


@serves(ops.CFG_SAVE)
def save(context: "RwsContext", request: RwsRequest) -> None:
    """Write a domain to a file, whose path begins with /fileservice."""
    text = request.field("filepath")
    if not text.startswith("/fileservice/"):
        raise RequestDenied(400, "E_INVALID_PATH", f"{text}: /fileservice/... is wanted")
    data = write_cfg(_domain(context, request)).encode()
    context.write_file(disk_path(context, text, request), data)
