"""Panel: motors, mode, speed."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from rapidgen.servers.rws.application import RwsApplication, serves
from rapidgen.servers.rws.messages import RequestDenied, RwsRequest, RwsResponse, show, whole
from rapidgen.servers.rws.subscriptions import EventSource, Topic, new_values, subscribable
from rapidgen.wire.rws import operations as ops
from rapidgen.wire.rws.bodies import Item

if TYPE_CHECKING:
    from rapidgen.controller.controller import VirtualController
    from rapidgen.controller.operation import OperatingMode

_MODES: dict[str, "OperatingMode"] = {
    "auto": "auto", "man": "manual_reduced", "manfs": "manual_full", "manf": "manual_full",
}  # fmt: skip
_WORDS = {"auto": "AUTO", "manual_reduced": "MANR", "manual_full": "MANF"}


def ctrl_state(controller: "VirtualController") -> str:
    """Return the controller's state in the words of Robot Web Services."""
    if controller.failed:
        return "sysfail"
    if controller.e_stop:
        return "emergencystop"
    return "motoron" if controller.motors_on else "motoroff"


def opmode(controller: "VirtualController") -> str:
    """Return the operating mode in the words of Robot Web Services."""
    return _WORDS[controller.mode]


def speed(controller: "VirtualController") -> int:
    """Return the override in percent; of several robots the lowest."""
    return round(100 * min((g.override for g in controller.motion.groups.values()), default=1.0))


@serves(ops.CTRL_STATE)
def get_ctrl_state(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return motors, emergency stop, system failure."""
    return show(Item("pnl-ctrlstate", "ctrlstate", {"ctrlstate": ctrl_state(app.controller)}))


@serves(ops.SET_CTRL_STATE)
def set_ctrl_state(app: RwsApplication, request: RwsRequest) -> None:
    """Switch motors on or off."""
    on = request.field("ctrl-state", ("motoron", "motoroff")) == "motoron"
    controller = app.controller
    if on and controller.mode != "auto":
        raise RequestDenied(403, "E_MODE_REJECT", "motors on only in automatic mode", -2)
    if on and controller.failed:
        raise RequestDenied(403, "E_SYSFAIL_REJECT", "system failure", -2)
    controller.set_motors(on)
    if controller.motors_on != on:
        raise RequestDenied(403, "E_REJECT", "motors on refused", -2)


@serves(ops.OPMODE)
def get_opmode(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the operating mode.

    In RWS 2.0 a link to its lock follows [code: rws2, GoFa].
    """
    mode = Item("pnl-opmode", "opmode", {"opmode": opmode(app.controller)})
    lock = Item("pnl-opmode-lockstate-li", "lock-state", {}, {"self": "lock-state"})
    return show(mode, *(() if request.is_one else (lock,)))


@serves(ops.SET_OPMODE)
def set_opmode(app: RwsApplication, request: RwsRequest) -> None:
    """Turn the key of a virtual controller.

    A real controller has no remote key.
    """
    text = ("auto", "man", "manfs" if request.is_one else "manf")
    if app.mode_lock:
        raise RequestDenied(403, "E_RESOURCE_HELD", "the mode is locked", -2)
    app.controller.set_mode(_MODES[request.field("opmode", text)])


@serves(ops.SPEED)
def get_speed(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the override."""
    return show(Item("pnl-speedratio", "speedratio", {"speedratio": str(speed(app.controller))}))


@serves(ops.SET_SPEED)
def set_speed(app: RwsApplication, request: RwsRequest) -> None:
    """Set the override in percent, in automatic mode."""
    percent = whole("speed-ratio", request.field("speed-ratio"), 0, 100)
    if app.controller.mode != "auto":
        raise RequestDenied(403, "E_MODE_REJECT", "only in automatic mode", -2)
    if not request.is_one:
        app.masterships.need(request, "rapid")
    for group in app.controller.motion.groups.values():
        group.override = percent / 100
    app.controller.operation.changed.notify()


@serves(ops.SET_SPEED_PLAIN)
def set_speed_plainly(app: RwsApplication, request: RwsRequest) -> None:
    """Refuse a speed without `?action=`: 400 in RWS 2.0 [VC 7.21]."""
    raise RequestDenied(400, "E_INVALIDARG", "action=setspeedratio is wanted")


@serves(ops.COLLISION)
def get_collision(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return collision detection.

    RobotWare 6 writes the class with a trailing blank.
    """
    name = request.kind("coldetstate ", "coldetstate")
    return show(Item("pnl-coldetstate", "coldetstate", {name: "INIT"}))


@serves(ops.PANEL)
def get_panel(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return the resources of the panel."""
    names = (request.kind("ctrlstate", "ctrl-state"), "opmode", "speedratio", "coldetstate")
    result = (Item(f"pnl-{name.replace('-', '')}-li", name, {}, {"self": name}) for name in names)
    return show(*result)


@serves(ops.ACKNOWLEDGE)
def acknowledge(app: RwsApplication, request: RwsRequest) -> None:
    """Confirm a change of mode, which takes effect at once here."""
    request.field("opmode", ("auto", "manf", "coldet"))


@serves(ops.LOCK_STATE)
def get_lock(app: RwsApplication, request: RwsRequest) -> RwsResponse:
    """Return whether the mode is locked by a pin."""
    notify = {"lockstate": app.mode_lock or "Unlocked"}
    return show(Item("pnl-opmode-lockstate-li", "lock-state", notify))


@serves(ops.LOCK)
def lock(app: RwsApplication, request: RwsRequest) -> None:
    """Lock the mode: it cannot be changed until it is unlocked."""
    pin = request.field("pin")
    if not (pin.isdecimal() and len(pin) == 4):
        raise RequestDenied(400, "E_INVALIDARG", "a pin has four digits")
    if app.mode_lock:
        raise RequestDenied(403, "E_RESOURCE_ALREADY_HELD", "the mode is locked")
    permanent = request.form.get("permanent", "0").lower() in ("1", "true")
    app.mode_lock = "Permanent" if permanent else "Temporary"


@serves(ops.UNLOCK)
def unlock(app: RwsApplication, request: RwsRequest) -> None:
    """Unlock the mode."""
    app.mode_lock = ""


@serves(ops.LANGUAGE)
def set_language(app: RwsApplication, request: RwsRequest) -> None:
    """Set the pendant's language: texts are English here."""
    if request.field("lang-code").lower() != "en":
        raise RequestDenied(400, "E_INVALIDARG", "only en is installed")


@serves(ops.EMERGENCY_STOP)
def emergency_stop(app: RwsApplication, request: RwsRequest) -> None:
    """Press (`off`) or release (`on`) the emergency stop.

    Only virtual controllers do this [VC 7.21].
    """
    app.controller.set_e_stop(request.field("state", ("on", "off")) == "off")


# -- events --------------------------------------------------------------------------------------


def _events(path: str, name: str, read: Callable[[RwsApplication], str]) -> None:
    """Register a source for a value of the panel."""

    def make(app: RwsApplication, topic: Topic) -> EventSource:
        href = topic.text.partition(";")[0]

        def item() -> Item:
            return Item(f"pnl-{name}-ev", name, {name: read(app)}, {"self": href})

        return new_values(app.controller.operation.changed, lambda: read(app), item)

    subscribable(f"/rw/panel/{path}", "", name)(make)


_events("ctrl-?state", "ctrlstate", lambda app: ctrl_state(app.controller))
_events("opmode", "opmode", lambda app: opmode(app.controller))
_events("speedratio", "speedratio", lambda app: str(speed(app.controller)))
_events("coldetstate", "coldetstate", lambda app: "INIT")
