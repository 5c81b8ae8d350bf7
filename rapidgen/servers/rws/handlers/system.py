"""The controller: identity, system, clock, variables, restart, jobs."""

from typing import TYPE_CHECKING

from rapidgen.machine.scheduler import date_time
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show
from rapidgen.servers.rws.routing import serves, services
from rapidgen.system.base.mechanics_cfg import OPTIONS
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Generation, Item

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext

_VARIABLES = {"$HOME": "HOME", "$TEMP": "TEMP", "$RAMDISK": "RAMDISK", "$BACKUP": "BACKUP"}
_MODES = ("restart", "istart", "pstart", "bstart")


def version(context: "RwsContext") -> tuple[int, int]:
    """Return RobotWare's release for the generation."""
    major, minor = context.controller.system.robotware
    least = {Generation.ONE: 6, Generation.TWO: 7, Generation.EIGHT: 8}[context.generation]
    return (major, minor) if major == least else (least, 0)


@serves(ops.CONTROLLER, ops.IDENTITY)
def identity(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the identity of this controller, which is virtual."""
    notify = {
        "ctrl-name": context.controller.system.name,
        "ctrl-id": context.runner.id,
        "ctrl-type": "Virtual Controller",
        "ctrl-mac": "",
    }
    return show(Item("ctrl-identity-info", "identity", notify))


@serves(ops.SERVICES)
def get_services(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the services, which public clients use to test a connection.

    Class and links are those of RobotWare 6.05 [code: HslCommunication].
    """
    names = services(request.generation)
    items = (Item("rwservice-li", name, links={"self": f"rw/{name}"}) for name in names)
    return show(*items, collection=True)


@serves(ops.SYSTEM)
def get_system(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return name and RobotWare version."""
    (major, minor), name = version(context), context.controller.system.name
    if request.is_one:
        notify = {
            "name": name,
            "rwversion": f"{major}.{minor:02}.0.0",
            "sysid": context.runner.id,
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
        "sysid": context.runner.id,
    }
    return show(Item("sys-system", "system", notify))


def _options(kind: str) -> list[Item]:
    return [Item(kind, str(i), {"option": option}) for i, option in enumerate(OPTIONS, 1)]


@serves(ops.OPTIONS)
def get_options(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the installed options."""
    return show(*_options("sys-option"), collection=True)


@serves(ops.PRODUCTS)
def get_products(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the products: RobotWare alone."""
    major, minor = version(context)
    notify = {"version": f"{major}.{minor}", "version-name": f"{major}.{minor}.0"}
    return show(Item("sys-product-li", "RobotWare", notify), collection=True)


@serves(ops.ROBOT_TYPE)
def get_robot_type(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the robot's type if a backup gives it."""
    types = context.controller.system.robot_types
    return show(Item("sys-robottype", "robottype", {"robot-type": types[0][1] if types else ""}))


@serves(ops.CLOCK)
def get_clock(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return date and time."""
    now = date_time(context.controller.scheduler)
    notify = {"datetime": now.strftime("%Y-%m-%d T %H:%M:%S")}
    return show(Item("ctrl-clock-info", "clock", notify))


@serves(ops.VARIABLE)
def get_variable(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the value of a variable: the volume of that name here."""
    name = request.names["variable"]
    folder = _VARIABLES.get(name.upper())
    if folder is None:
        raise RequestDenied(404, "E_UNRESOLVED_URL", name)
    return show(Item("ctrl-env", name, {"_value": folder, "value": folder}))


@serves(ops.RESTART, ops.RESTART_AT_CTRL)
def restart(context: "RwsContext", request: RwsRequest) -> None:
    """Restart with a warm start, which ends all sessions.

    Other kinds are not offered here.
    """
    context.masters.need(request, "cfg")
    mode = request.field("restart-mode", (*_MODES, "xstart", "shutdown"))
    if mode != "restart":
        raise RequestDenied(403, "E_REJECT", f"{mode}: only warm starts here", -2)
    context.runner.ask_restart()


@serves(ops.PROGRESS)
def get_progress(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the progress of a job: all end at once here."""
    code = context.progress.get(request.names["id"])
    if code is None:
        raise RequestDenied(404, "E_UNRESOLVED_URL", request.path)
    return show(Item("progress", request.names["id"], {"state": "ready", "code": str(code)}))


@serves(ops.LICENSE)
def get_license(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the license, which a virtual controller does not have."""
    return show(Item("sys-license", "license", {"license": "virtual controller"}))


@serves(ops.ENERGY)
def get_energy(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return energy data: the state -1, no valid value [RWS manual].

    Energy is not modelled. Fields and axes are as in a body of a RobotWare 6 in the tests of an
    exporter of metrics.
    """
    now = date_time(context.controller.scheduler).strftime("%Y-%m-%d T %H:%M:%S")
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
        for group in context.controller.motion.groups.values()
    )
    kind = request.kind("sys-energy-state-li", "sys-energy-state")
    return show(Item(kind, "energy-state", notify, within=tuple(units)))


@serves(ops.VISION)
def get_vision(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return vision data: no camera is connected."""
    return show(Item("number-of-cameras-li", "cameras", {"number-of-cameras": "0"}))


@serves(ops.TIME_ZONE)
def get_time_zone(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the time zone of the controller's clock: UTC here."""
    return show(Item("ctrl-timezone", "timezone", {"timezone": "UTC"}))


@serves(ops.SET_CLOCK)
def set_clock(context: "RwsContext", request: RwsRequest) -> None:
    """Refuse to set the clock, which is the simulation's."""
    raise RequestDenied(403, "E_REJECT", "the clock of a virtual controller is its machine's", -2)


@serves(ops.RESTART_COUNT)
def restart_count(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the number of restarts."""
    notify = {"restart-count": str(context.runner.restarts)}
    return show(Item("ctrl-restart-count", "restartcount", notify))


@serves(ops.VIRTUAL_TIME)
def virtual_time(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the virtual time in ms."""
    notify = {"vtcounter": str(round(context.runner.now * 1000))}
    return show(Item("ctrl-vttime", "vttime", notify))


@serves(ops.VIRTUAL_STATE)
def virtual_state(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the state of virtual time, which runs."""
    return show(Item("ctrl-vtstate", "vtstate", {"vtcurrstate": "running"}))


@serves(ops.VIRTUAL_SPEED)
def virtual_speed(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the speed of virtual time, in percent of real time."""
    notify = {"vtcurrspeed": f"{100 * context.controller.scheduler.speed:g}"}
    return show(Item("ctrl-vtspeed", "vtspeed", notify))


@serves(ops.SAFETY_MODE)
def safety_mode(context: "RwsContext", request: RwsRequest) -> RwsResponse:
    """Return the safety mode: no safety controller is modelled."""
    return show(Item("safetymodestatus", "mode", {"safetymode": "DEACTIVATED"}))
