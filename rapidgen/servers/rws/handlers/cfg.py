"""Configuration: read, single instances, whole files.

Changes take effect after a restart.
"""

from dataclasses import replace

from rapidgen._reading import read_foreign
from rapidgen.diagnostics import DiagnosticError
from rapidgen.servers.rws.application import RwsApplication, serves
from rapidgen.servers.rws.handlers.files import disk_path, write_file
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, page, show
from rapidgen.system.cfg import Attribute, CfgText, Instance, parse_cfg, scalar, write_cfg
from rapidgen.system.cfg_database import with_defaults
from rapidgen.system.cfg_loading import CfgFileLoad, LoadResult, add, identity_text
from rapidgen.system.paths import MAX_FILE
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item
from rapidgen.wire.rws.codes import OK


def _domain(app: RwsApplication, request: RwsRequest) -> CfgText:
    name = request.names["domain"].upper()
    if name in app.controller.cfg.domains:
        return app.runner.cfg.domain(name)
    raise RequestDenied(400 if request.is_one else 404, "E_CFG_DOMAIN_INVALID", name)


def _title(section: str, instance: Instance) -> str:
    return " ".join(part for part in identity_text(section, instance) if part)


@serves(ops.CFG)
def get_domains(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the domains."""
    return show(
        *(Item("cfg-domain-li", name) for name in app.controller.cfg.domains),
        collection=True,
    )


@serves(ops.CFG_DOMAIN)
def get_types(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the types of a domain."""
    text = _domain(app, request)
    names = app.controller.cfg.types(text.domain)
    return show(*(Item("cfg-dt-li", name) for name in names), collection=True)


@serves(ops.CFG_INSTANCES)
def get_instances(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return instances of a type with their attributes.

    RWS 2.0 returns seventy at a time [VC 7.21].
    """
    result = [_item(request, i) for i in _instances(app, request)]
    return page(request, result, 70, "instances", always=True)


@serves(ops.CFG_INSTANCE)
def get_instance(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return one instance."""
    return show(_item(request, _one(app, request)))


def _instances(app: RwsApplication, request: RwsRequest) -> tuple[Instance, ...]:
    """Return the instances of a type."""
    text = _domain(app, request)
    return app.controller.cfg.instances(text.domain, request.names["type"])


def _one(app: RwsApplication, request: RwsRequest) -> Instance:
    name, section = request.names["instance"], request.names["type"]
    for instance in _instances(app, request):
        if _title(section, instance).casefold() == name.casefold():
            return instance
    raise RequestDenied(400 if request.is_one else 404, "E_CFG_INSTANCE_INVALID", name)


def _item(request: RwsRequest, instance: Instance) -> Item:
    kind = request.kind("cfg-ia-t-li", "cfg-ia-t")
    section = request.names["type"]
    within = tuple(
        Item(kind, a.name, {"value": _value(a), "rdonly": "false"})
        for a in with_defaults(request.names["domain"], section, instance)
    )
    title = _title(section, instance)
    return Item("cfg-dt-instance-li", title, {"rdonly": "false"}, within=within)


def _value(attribute: Attribute) -> str:
    """Format a value: a flag is true; several values are concatenated."""
    return " ".join(map(str, attribute.values)) if attribute.values else "true"


@serves(ops.CFG_ATTRIBUTES)
def get_attributes(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the attributes of a type's instances."""
    domain, section = request.names["domain"], request.names["type"]
    names = dict.fromkeys(
        a.name for i in _instances(app, request) for a in with_defaults(domain, section, i)
    )
    result = (
        Item("cfg-dt-attribute", name, {"name": name, "mandatory": "false"}) for name in names
    )
    return show(*result, collection=True)


# -- single instances ----------------------------------------------------------------------------


def _with(app: RwsApplication, request: RwsRequest, instances: tuple[Instance, ...]) -> None:
    """Replace the instances of a type in the database."""
    text, name = _domain(app, request), request.names["type"]
    app.runner.cfg = app.runner.cfg.with_instances(text.domain, name, instances)


def _saved(app: RwsApplication, request: RwsRequest) -> tuple[Instance, ...]:
    """Return the instances of a type that can be changed."""
    return tuple(_domain(app, request).instances(request.names["type"]))


def _one_saved(app: RwsApplication, request: RwsRequest) -> Instance:
    """Return an instance that can be changed."""
    instance, text = _one(app, request), _domain(app, request)
    if app.controller.cfg.is_internal(text.domain, request.names["type"], instance):
        raise RequestDenied(403, "E_REJECT", f"{request.names['type']} is read only", -2)
    return instance


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
def set_instance(app: RwsApplication, request: RwsRequest) -> None:
    """Set attributes of an instance."""
    if not request.is_one:  # RobotWare 6 takes mastership by itself [VC 6.16]
        app.masterships.need(request, "cfg")
    old = _one_saved(app, request)
    attributes = {a.name.casefold(): a for a in old.attributes}
    for name, value in request.pairs:
        made = _attribute(name, value, is_one=request.is_one)
        attributes.pop(name.casefold(), None)
        if made is not None:
            attributes[name.casefold()] = made
    new = replace(old, attributes=tuple(attributes.values()))
    _with(app, request, tuple(new if i is old else i for i in _saved(app, request)))


@serves(ops.CFG_CREATE)
def create_instance(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Create an instance with a name and default attributes."""
    if not request.is_one:
        app.masterships.need(request, "cfg")
    name, section = request.field("name"), request.names["type"]
    if any(_title(section, i).casefold() == name.casefold() for i in _instances(app, request)):
        raise RequestDenied(400, "E_CFG_NAME_EXIST", name)
    _with(app, request, (*_saved(app, request), Instance((Attribute("Name", (name,)),))))
    return RwsResponse(201)


@serves(ops.CFG_DELETE)
def delete_instance(app: RwsApplication, request: RwsRequest) -> None:
    """Delete an instance."""
    if not request.is_one:
        app.masterships.need(request, "cfg")
    old = _one_saved(app, request)
    _with(app, request, tuple(i for i in _saved(app, request) if i is not old))


# -- whole files ---------------------------------------------------------------------------------


def _load(app: RwsApplication, request: RwsRequest) -> LoadResult:
    """Return the database with a file loaded.

    With `add` any conflict rejects the whole file. Raises RequestDenied.
    """
    mode = request.field("action-type", ("add", "replace", "add-with-reset"))
    words = request.field("filepath")
    if words.startswith("/fileservice"):
        raise RequestDenied(400, "E_INVALID_PATH", f"{words}: a bare path is wanted")
    path = disk_path(app, words, request)
    try:
        data = read_foreign(path, MAX_FILE)
        text = parse_cfg(data, path=words)
    except OSError as error:
        raise RequestDenied(400 if request.is_one else 404, "E_FILE_NOT_FOUND", words) from error
    except DiagnosticError as error:
        raise RequestDenied(400, "E_CFG_DATA_INCORRECT", str(error)) from error
    base = app.runner.cfg
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
def load(app: RwsApplication, request: RwsRequest) -> RwsResponse | None:
    """Load a file; RWS 2.0 returns the address of the job's result."""
    app.masterships.need(request, "cfg")
    loaded = _load(app, request)
    if loaded.faults:
        for fault in loaded.faults:
            app.controller.log.error(120_003, "Configuration file not loaded", fault.message)
        name, why = _why(loaded)
        if request.is_one:
            raise RequestDenied(400, name, why)
        return app.started(name)
    app.runner.cfg = loaded.cfg
    return None if request.is_one else app.started("")


@serves(ops.CFG_VALIDATE)
def validate(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the result of a load without changing the database."""
    loaded = _load(app, request)
    if loaded.faults:
        raise RequestDenied(400, *_why(loaded))
    return show(Item("cfg-validate", "validate", {"code": str(OK)}))


@serves(ops.CFG_SAVE)
def save(app: RwsApplication, request: RwsRequest) -> None:
    """Write a domain to a file, whose path begins with /fileservice."""
    text = request.field("filepath")
    if not text.startswith("/fileservice/"):
        raise RequestDenied(400, "E_INVALID_PATH", f"{text}: /fileservice/... is wanted")
    data = write_cfg(_domain(app, request)).encode()
    write_file(app, disk_path(app, text, request), data)
