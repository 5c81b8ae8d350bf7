"""The controller: identity, system, clock, restart, jobs, event log."""

from collections.abc import Callable
from dataclasses import replace
from datetime import timedelta

from rapidgen.machine.event_log import Event
from rapidgen.machine.event_table import KINDS, Domain
from rapidgen.machine.scheduler import date_time
from rapidgen.servers.rws.application import RwsApplication, serves, services
from rapidgen.servers.rws.handlers.files import disk_path, write_file
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, page, show, whole
from rapidgen.servers.rws.subscriptions import EventSource, Notify, Topic, subscribable
from rapidgen.system.base.mechanics_cfg import OPTIONS
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation, Item

_VARIABLES = {"$HOME": "HOME", "$TEMP": "TEMP", "$RAMDISK": "RAMDISK", "$BACKUP": "BACKUP"}
_MODES = ("restart", "istart", "pstart", "bstart")


def version(app: RwsApplication) -> tuple[int, int]:
    """Return RobotWare's release for the generation."""
    major, minor = app.controller.system.robotware
    least = {Generation.ONE: 6, Generation.TWO: 7, Generation.EIGHT: 8}[app.generation]
    return (major, minor) if major == least else (least, 0)


@serves(ops.CONTROLLER, ops.IDENTITY)
def identity(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the identity of this controller, which is virtual."""
    notify = {
        "ctrl-name": app.controller.system.name,
        "ctrl-id": app.runner.id,
        "ctrl-type": "Virtual Controller",
        "ctrl-mac": "",
    }
    return show(Item("ctrl-identity-info", "identity", notify))


@serves(ops.SERVICES)
def get_services(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the services, which public clients use to test a connection.

    Class and links are those of RobotWare 6.05 [code: HslCommunication].
    """
    names = services(request.generation)
    items = (Item("rwservice-li", name, links={"self": f"rw/{name}"}) for name in names)
    return show(*items, collection=True)


@serves(ops.SYSTEM)
def get_system(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return name and RobotWare version."""
    (major, minor), name = version(app), app.controller.system.name
    if request.is_one:
        notify = {
            "name": name,
            "rwversion": f"{major}.{minor:02}.0.0",
            "sysid": app.runner.id,
            "starttm": "",
            "rwversionname": f"{major}.{minor:02}.00.00",
        }
        return show(Item("sys-system-li", "system", notify), *_options("sys-option-li"))
    notify = {
        "major": str(major),
        "minor": str(minor),
        "build": "0",
        "name": name,
        "rwversion": f"{major}.{minor}.0+0",
        "rwversionname": f"{major}.{minor}.0",
        "sysid": app.runner.id,
    }
    return show(Item("sys-system", "system", notify))


def _options(kind: str) -> list[Item]:
    return [Item(kind, str(i), {"option": option}) for i, option in enumerate(OPTIONS, 1)]


@serves(ops.OPTIONS)
def get_options(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the installed options."""
    return show(*_options("sys-option"), collection=True)


@serves(ops.PRODUCTS)
def get_products(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the products: RobotWare alone."""
    major, minor = version(app)
    notify = {"version": f"{major}.{minor}", "version-name": f"{major}.{minor}.0"}
    return show(Item("sys-product-li", "RobotWare", notify), collection=True)


@serves(ops.ROBOT_TYPE)
def get_robot_type(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the robot's type if a backup gives it."""
    types = app.controller.system.robot_types
    return show(Item("sys-robottype", "robottype", {"robot-type": types[0][1] if types else ""}))


@serves(ops.CLOCK)
def get_clock(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return date and time."""
    now = date_time(app.controller.scheduler)
    notify = {"datetime": now.strftime("%Y-%m-%d T %H:%M:%S")}
    return show(Item("ctrl-clock-info", "clock", notify))


@serves(ops.VARIABLE)
def get_variable(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the value of a variable: the volume of that name here."""
    name = request.names["variable"]
    folder = _VARIABLES.get(name.upper())
    if folder is None:
        raise RequestDenied(404, "E_UNRESOLVED_URL", name)
    return show(Item("ctrl-env", name, {"_value": folder, "value": folder}))


@serves(ops.RESTART, ops.RESTART_AT_CTRL)
def restart(app: RwsApplication, request: RwsRequest) -> None:
    """Restart with a warm start, which ends all sessions.

    Other kinds are not offered here.
    """
    app.masterships.need(request, "cfg")
    mode = request.field("restart-mode", (*_MODES, "xstart", "shutdown"))
    if mode != "restart":
        raise RequestDenied(403, "E_REJECT", f"{mode}: only warm starts here", -2)
    app.runner.ask_restart()


@serves(ops.PROGRESS)
def get_progress(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the progress of a job: all end at once here."""
    code = app.progress.get(request.names["id"])
    if code is None:
        raise RequestDenied(404, "E_UNRESOLVED_URL", request.path)
    return show(Item("progress", request.names["id"], {"state": "ready", "code": str(code)}))


@serves(ops.LICENSE)
def get_license(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the license, which a virtual controller does not have."""
    return show(Item("sys-license", "license", {"license": "virtual controller"}))


@serves(ops.ENERGY)
def get_energy(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return energy data: the state -1, no valid value [RWS manual].

    Energy is not modelled. Fields and axes are as in a body of a RobotWare 6 in the tests of an
    exporter of metrics.
    """
    now = date_time(app.controller.scheduler).strftime("%Y-%m-%d T %H:%M:%S")
    notify = {"state": "-1", "energy-state": "blocked", "change-count": "0"}
    notify |= {"time-stamp": now, "reset-time": now, "interval-length": "3600"}
    notify |= {"interval-energy": "0", "accumulated-energy": "0"}
    none = {"interval-energy": "0"}
    units = (
        Item(
            "sys-energy-mec-li",
            group.config.mechanical_unit,
            within=tuple(
                Item("sys-energy-axis-li", str(i), none)
                for i, _ in enumerate(group.config.joints, 1)
            ),
        )
        for group in app.controller.motion.groups.values()
    )
    kind = request.kind("sys-energy-state-li", "sys-energy-state")
    return show(Item(kind, "energy-state", notify, within=tuple(units)))


@serves(ops.VISION)
def get_vision(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return vision data: no camera is connected."""
    return show(Item("number-of-cameras-li", "cameras", {"number-of-cameras": "0"}))


@serves(ops.TIME_ZONE)
def get_time_zone(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the time zone of the controller's clock: UTC here."""
    return show(Item("ctrl-timezone", "timezone", {"timezone": "UTC"}))


@serves(ops.SET_CLOCK)
def set_clock(app: RwsApplication, request: RwsRequest) -> None:
    """Refuse to set the clock, which is the simulation's."""
    raise RequestDenied(403, "E_REJECT", "the clock of a virtual controller is its machine's", -2)


@serves(ops.RESTART_COUNT)
def restart_count(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the number of restarts."""
    notify = {"restart-count": str(app.runner.restarts)}
    return show(Item("ctrl-restart-count", "restartcount", notify))


@serves(ops.VIRTUAL_TIME)
def virtual_time(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the virtual time in ms."""
    notify = {"vtcounter": str(round(app.runner.now * 1000))}
    return show(Item("ctrl-vttime", "vttime", notify))


@serves(ops.VIRTUAL_STATE)
def virtual_state(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the state of virtual time, which runs."""
    return show(Item("ctrl-vtstate", "vtstate", {"vtcurrstate": "running"}))


@serves(ops.VIRTUAL_SPEED)
def virtual_speed(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the speed of virtual time, in percent of real time."""
    notify = {"vtcurrspeed": f"{100 * app.controller.scheduler.speed:g}"}
    return show(Item("ctrl-vtspeed", "vtspeed", notify))


@serves(ops.SAFETY_MODE)
def safety_mode(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the safety mode: no safety controller is modelled."""
    return show(Item("safetymodestatus", "mode", {"safetymode": "DEACTIVATED"}))


# -- event log -------------------------------------------------------------------------------------

_ALL = "0"
"""Domain 0 has the entries of all."""


def _events(app: RwsApplication, domain: str) -> list[Event]:
    known = {str(int(d)) for d in Domain}
    if domain not in known:
        raise RequestDenied(404, "E_UNRESOLVED_URL", f"no domain {domain}")
    return [e for e in app.controller.log if domain in (_ALL, str(int(e.domain)))]


@serves(ops.ELOGS)
def get_domains(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the domains and their numbers of entries."""
    result = []
    for domain in Domain:
        number = str(int(domain))
        count = str(len(_events(app, number)))
        notify = {"domain-name": domain.name.title(), "numevts": count, "buffsize": "1000"}
        result.append(Item("elog-domain-li", number, notify))
    return show(*result, collection=True)


@serves(ops.ELOG)
def get_events(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return entries of a domain, newest first; fifty at a time in RWS 2.0."""
    domain = request.names["domain"]
    events = _events(app, domain)[::-1]
    if request.query.get("resource") in ("info", "count"):
        notify = {"numevts": str(len(events)), "buffsize": "1000"}
        return show(Item("elog-domain", domain, notify))
    after = request.query.get("elogseqnum", "")
    if after:
        newest = whole("elogseqnum", after)
        events = [e for e in events if e.sequence > newest]
    return page(request, [_item(app, domain, e) for e in events], 50, domain)


@serves(ops.ELOG_EVENT)
def get_event(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return one entry."""
    domain, number = request.names["domain"], request.names["number"]
    for event in _events(app, domain):
        if str(event.sequence) == number:
            item = _item(app, domain, event)
            return show(Item("elog-message", item.title, item.fields, within=item.within))
    raise RequestDenied(404, "E_UNRESOLVED_URL", f"no entry {number}")


def _item(app: RwsApplication, domain: str, event: Event) -> Item:
    scheduler = app.controller.scheduler
    ago = timedelta(seconds=scheduler.now * 1e-9 - event.time)
    texts = event.arguments or tuple(text for text in (event.task, *event.texts) if text)
    kind = KINDS.get(event.code)
    notify = {
        "msgtype": str(int(event.type)),
        "code": str(event.code),
        "src-name": app.controller.system.name,
        "tstamp": (date_time(scheduler) - ago).strftime("%Y-%m-%d T %H:%M:%S"),
        "title": event.title,
        "desc": " ".join(text for text in (event.title, event.task, *event.texts) if text),
        "conseqs": "",
        "causes": kind.causes if kind is not None else "",
        "actions": kind.remedy if kind is not None else "",
        "argc": str(len(texts)),
    }
    within = tuple(
        Item("elog-arg", f"arg{i}", {"type": "STRING", "value": text})
        for i, text in enumerate(texts, 1)
    )
    return Item("elog-message-li", f"/rw/elog/{domain}/{event.sequence}", notify, within=within)


@serves(ops.CLEAR_ELOG)
def clear(app: RwsApplication, request: RwsRequest) -> None:
    """Delete all entries; here of all domains."""
    _events(app, request.names["domain"])
    app.controller.log.clear()


@serves(ops.CLEAR_ELOGS)
def clear_all(app: RwsApplication, request: RwsRequest) -> None:
    """Delete all entries of all domains."""
    app.controller.log.clear()


@serves(ops.ELOG_NUMBER)
def get_by_number(app: RwsApplication, request: RwsRequest) -> RwsResponse | None:
    """Return one entry by its number, in any domain."""
    return get_event(app, replace(request, names={"domain": _ALL, **request.names}))


@serves(ops.SAVE_ELOG)
def save(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Write all entries to a file, whose path begins with /fileservice."""
    text = request.field("path")
    if not text.startswith("/fileservice/"):
        raise RequestDenied(400, "E_INVALID_PATH", f"{text}: /fileservice/... is wanted")
    rows = [
        "\t".join((i.title, *(i.fields[k] for k in ("tstamp", "msgtype", "code", "desc"))))
        for i in (_item(app, _ALL, e) for e in _events(app, _ALL))
    ]
    write_file(app, disk_path(app, text, request), "\n".join([*rows, ""]).encode())
    return app.started("")


@subscribable(r"/rw/elog/(?P<domain>\d{1,2})")
def log_events(app: RwsApplication, topic: Topic) -> EventSource:
    """Entries of a domain."""
    domain = int(topic.names["domain"])

    def watch(notify: Notify) -> Callable[[], None]:
        def take(event: Event) -> None:
            if domain in (0, int(event.domain)):
                href = f"/rw/elog/{domain}/{event.sequence}"
                fields = {"seqnum": str(event.sequence)}
                notify(Item("elog-message-ev", href, fields, {"self": href}))

        return app.controller.log.subscribe(take)

    return EventSource(lambda: Item("elog-message-ev"), watch, has_state=False)
