"""RWS operations: each once, with the spelling of every generation.

`METHOD /path[?action=name]`, or `?resource=name`; `{name}` is one segment, `{name*}` several. RWS
1.0 has verbs as `?action=`, 2.0 as a last segment, with few exceptions. "-" means that a generation
lacks the operation.
"""

import re
from dataclasses import dataclass
from functools import cache

from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.forms import path_of, segment


@dataclass(frozen=True, slots=True)
class Route:
    """Spelling of an operation in one generation."""

    method: str
    path: str
    selector: str = ""
    """`action=name` or `resource=name`: part of the path that is meant."""

    def fill(self, names: dict[str, str]) -> str:
        """Return the request target for these names."""
        target = self.path
        for name, value in names.items():
            target = target.replace(f"{{{name}}}", segment(value))
            target = target.replace(f"{{{name}*}}", path_of(value))
        return f"{target}?{self.selector}" if self.selector else target

    @property
    def pattern(self) -> re.Pattern[str]:
        """Return the pattern of decoded paths of this operation."""
        return re.compile(
            re.sub(
                r"\\\{(\w+)(\\\*)?\\\}",
                # Names of cfg instances contain files and routines.
                lambda m: f"(?P<{m[1]}>{'.+' if m[2] or m[1] == 'instance' else '[^/]+'})",
                re.escape(self.path),
            )
        )


@dataclass(frozen=True, slots=True)
class RwsOperation:
    """One operation; `eight` if RobotWare 8 differs from 7."""

    one: str
    two: str
    eight: str = ""

    def route(self, generation: Generation) -> Route | None:
        """Return the spelling of a generation; None: not available."""
        return _route(self, generation)


@cache
def _route(operation: RwsOperation, generation: Generation) -> Route | None:
    text = operation.one if generation is Generation.ONE else operation.two
    if generation is Generation.EIGHT and operation.eight:
        text = operation.eight
    if text == "-":
        return None
    method, _, target = text.partition(" ")
    path, _, selector = target.partition("?")
    return Route(method, path, selector)


def _same(text: str) -> RwsOperation:
    return RwsOperation(text, text)


def _verb(path: str, one: str, two: str = "") -> RwsOperation:
    """Return the operation by the rule of verbs.

    `two`: another word in RWS 2.0.
    """
    return RwsOperation(f"POST {path}?action={one}", f"POST {path}/{two or one}")


# -- session, users
LOGOUT = _same("GET /logout")
REGISTER_USER = RwsOperation("POST /users", "POST /users/register")
LOGIN_INFO = RwsOperation("-", "GET /users/login-info")
GRANTS = RwsOperation("GET /users/grants", "GET /uas/user/grants")
GRANT_EXISTS = RwsOperation("-", "GET /users/grant-exists")
RMMP = _same("GET /users/rmmp")
RMMP_POLL = _same("GET /users/rmmp/poll")
ASK_RMMP = _same("POST /users/rmmp")
CANCEL_RMMP = _verb("/users/rmmp", "cancel")
RETCODE = _same("GET /rw/retcode")
USERS = _same("GET /users")
IMPERSONATE = _verb("/users", "impersonate")
SET_LOCALE = RwsOperation("POST /users?action=set-locale", "-")
ALL_GRANTS = RwsOperation("-", "GET /uas/grants")
PASSWORD_CHANGE = RwsOperation("-", "GET /uas/user/password-change-allow")
GRANT_RMMP = RwsOperation("POST /users/rmmp?action=set", "-")

# -- mastership, write access
MASTERSHIPS = _same("GET /rw/mastership")
MASTERSHIP = _same("GET /rw/mastership/{domain}")
REQUEST_ALL = _verb("/rw/mastership", "request")
REQUEST_PLAIN = RwsOperation("POST /rw/mastership", "-")
RELEASE_ALL = _verb("/rw/mastership", "release")
REQUEST = _verb("/rw/mastership/{domain}", "request")
RELEASE = _verb("/rw/mastership/{domain}", "release")
STATION_REGISTER = RwsOperation("-", "-", "POST /rw/controlstation/register/remote")
WRITE_ACCESS = RwsOperation("-", "-", "GET /rw/controlstation/writeaccess/status")
WRITE_REQUEST = RwsOperation("-", "-", "POST /rw/controlstation/writeaccess/request")
WRITE_RELEASE = RwsOperation("-", "-", "POST /rw/controlstation/writeaccess/release")
MOTION_ALLOWED = RwsOperation("-", "-", "GET /rw/controlstation/allowmotioncontrol")
ALLOW_MOTION = RwsOperation("-", "-", "POST /rw/controlstation/allowmotioncontrol")
REQUEST_WITH_ID = RwsOperation("-", "POST /rw/mastership/{domain}/request-with-id")
RELEASE_WITH_ID = RwsOperation("-", "POST /rw/mastership/{domain}/release-with-id")
WATCHDOG = RwsOperation("-", "POST /rw/mastership/watchdog")
STATION_TYPE = RwsOperation("-", "-", "GET /rw/controlstation/type")
STATION_ID = RwsOperation("-", "-", "GET /rw/controlstation/id")
LOCAL_STATION = RwsOperation("-", "-", "GET /rw/controlstation/local/isconnected")

# -- panel
CTRL_STATE = RwsOperation("GET /rw/panel/ctrlstate", "GET /rw/panel/ctrl-state")
SET_CTRL_STATE = RwsOperation(
    "POST /rw/panel/ctrlstate?action=setctrlstate", "POST /rw/panel/ctrl-state"
)
OPMODE = _same("GET /rw/panel/opmode")
SET_OPMODE = RwsOperation("POST /rw/panel/opmode?action=setopmode", "POST /rw/panel/opmode")
SPEED = _same("GET /rw/panel/speedratio")
SET_SPEED = _same("POST /rw/panel/speedratio?action=setspeedratio")
SET_SPEED_PLAIN = RwsOperation("-", "POST /rw/panel/speedratio")
COLLISION = _same("GET /rw/panel/coldetstate")
PANEL = _same("GET /rw/panel")
ACKNOWLEDGE = _verb("/rw/panel/opmode", "acknowledge")
LOCK_STATE = RwsOperation("-", "GET /rw/panel/opmode/lock-state")
LOCK = _verb("/rw/panel/opmode", "lock")
UNLOCK = _verb("/rw/panel/opmode", "unlock")
LANGUAGE = _verb("/rw/panel", "setlang", "lang")
EMERGENCY_STOP = RwsOperation("-", "POST /rw/panel/emergency-stop")

# -- execution
EXECUTION = _same("GET /rw/rapid/execution")
START = _verb("/rw/rapid/execution", "start")
STOP = _verb("/rw/rapid/execution", "stop")
RESET_PP = _verb("/rw/rapid/execution", "resetpp")
SET_CYCLE = _verb("/rw/rapid/execution", "setcycle", "cycle")
START_ENTRY = _verb("/rw/rapid/execution", "startprodentry")

# -- tasks, modules, program
TASKS = _same("GET /rw/rapid/tasks")
TASK = _same("GET /rw/rapid/tasks/{task}")
ACTIVATE = RwsOperation(
    "POST /rw/rapid/tasks/{task}?action=activate", "POST /rw/rapid/tasks/activate"
)
DEACTIVATE = RwsOperation(
    "POST /rw/rapid/tasks/{task}?action=deactivate", "POST /rw/rapid/tasks/deactivate"
)
MODULES = RwsOperation("GET /rw/rapid/modules", "GET /rw/rapid/tasks/{task}/modules")
MODULE = RwsOperation(
    "GET /rw/rapid/modules/{module}", "GET /rw/rapid/tasks/{task}/modules/{module}"
)
MODULE_TEXT = RwsOperation(
    "GET /rw/rapid/modules/{module}?resource=module-text",
    "GET /rw/rapid/tasks/{task}/modules/{module}/text",
)
LOAD_MODULE = _verb("/rw/rapid/tasks/{task}", "loadmod")
UNLOAD_MODULE = _verb("/rw/rapid/tasks/{task}", "unloadmod")
SAVE_MODULE = RwsOperation(
    "POST /rw/rapid/modules/{module}?action=save",
    "POST /rw/rapid/tasks/{task}/modules/{module}/save",
)
PROGRAM = _same("GET /rw/rapid/tasks/{task}/program")
BUILD_ERRORS = _same("GET /rw/rapid/tasks/{task}/program/builderror")
POINTER = _same("GET /rw/rapid/tasks/{task}/pcp")
POINTER_TO_ROUTINE = _verb("/rw/rapid/tasks/{task}/pcp", "set-pp-routine", "routine")
TASK_MOTION = _same("GET /rw/rapid/tasks/{task}/motion")
ACTIVATE_ALL = RwsOperation("POST /rw/rapid/tasks?action=activate", "-")
DEACTIVATE_ALL = RwsOperation("POST /rw/rapid/tasks?action=deactivate", "-")
TASK_SELECTION = RwsOperation("-", "GET /rw/rapid/taskselection")
CHANGE_COUNT = RwsOperation("-", "GET /rw/rapid/tasks/{task}/structural-changecount")
ACTIVATION_RECORD = RwsOperation(
    "GET /rw/rapid/tasks/{task}?resource=activation-record",
    "GET /rw/rapid/tasks/{task}/activation-record",
)
ROUTINES = _same("GET /rw/rapid/tasks/{task}/serviceroutine")
MODULE_COUNT = RwsOperation("-", "GET /rw/rapid/tasks/{task}/modules/{module}/changecount")
TEXT_RANGE = RwsOperation("-", "GET /rw/rapid/tasks/{task}/modules/{module}/text/range")
TEXT_SEARCH = RwsOperation("-", "GET /rw/rapid/tasks/{task}/modules/{module}/text/search")
SET_TEXT = RwsOperation(
    "POST /rw/rapid/modules/{module}?action=set-module-text",
    "POST /rw/rapid/tasks/{task}/modules/{module}/text",
)
SET_TEXT_RANGE = RwsOperation(
    "POST /rw/rapid/modules/{module}?action=set-text-range",
    "POST /rw/rapid/tasks/{task}/modules/{module}/text/range",
)
LOAD_PROGRAM = _verb("/rw/rapid/tasks/{task}/program", "loadprog", "load")
UNLOAD_PROGRAM = _verb("/rw/rapid/tasks/{task}/program", "unloadprog", "unload")
SAVE_PROGRAM = _verb("/rw/rapid/tasks/{task}/program", "save")
COUNTER = RwsOperation("GET /rw/rapid/tasks/{task}/execution", "-")
POINTER_TO_CURSOR = _verb("/rw/rapid/tasks/{task}/pcp", "set-pp-cursor", "cursor")
POINTER_TO_MAIN = RwsOperation("-", "POST /rw/rapid/tasks/{task}/pcp/reset")

# -- dialogs of the pendant
DIALOG = _same("GET /rw/rapid/uiinstr/active")
DIALOG_PARAMETERS = _same("GET /rw/rapid/uiinstr/active/params/{stack*}")
DIALOG_PARAMETER = _same("GET /rw/rapid/uiinstr/active/param/{stack*}/{parameter}")
SET_DIALOG_PARAMETER = RwsOperation(
    "POST /rw/rapid/uiinstr/active/param/{stack*}/{parameter}?action=set",
    "POST /rw/rapid/uiinstr/active/param/{stack*}/{parameter}",
)

# -- message queues
QUEUES = _same("GET /rw/dipc")
CREATE_QUEUE = RwsOperation("POST /rw/dipc?action=dipc-create", "POST /rw/dipc")
SEND_MESSAGE = RwsOperation("POST /rw/dipc/{queue}?action=dipc-send", "POST /rw/dipc/{queue}")
READ_MESSAGE = RwsOperation("GET /rw/dipc/{queue}?action=dipc-read", "GET /rw/dipc/{queue}")
QUEUE = RwsOperation("GET /rw/dipc/{queue}", "GET /rw/dipc/{queue}/information")
DELETE_QUEUE = _same("DELETE /rw/dipc/{queue}")

# -- symbols
SYMBOL = RwsOperation(
    "GET /rw/rapid/symbol/data/RAPID/{symbol*}", "GET /rw/rapid/symbol/RAPID/{symbol*}/data"
)
SET_SYMBOL = RwsOperation(
    "POST /rw/rapid/symbol/data/RAPID/{symbol*}?action=set",
    "POST /rw/rapid/symbol/RAPID/{symbol*}/data",
)
SYMBOL_PROPERTIES = RwsOperation(
    "GET /rw/rapid/symbol/properties/RAPID/{symbol*}",
    "GET /rw/rapid/symbol/RAPID/{symbol*}/properties",
)
SEARCH_SYMBOLS = _verb("/rw/rapid/symbols", "search-symbols", "search")
SET_INITIAL = RwsOperation("POST /rw/rapid/symbol/data/RAPID/{symbol*}?action=setInitValue", "-")
VALIDATE_VALUE = RwsOperation(
    "POST /rw/rapid/symbol/data?action=validate",
    "POST /rw/rapid/symbol/RAPID/{task}/data?action=validate",
)

# -- signals
NETWORKS = _same("GET /rw/iosystem/networks")
DEVICES = _same("GET /rw/iosystem/devices")
SIGNALS = _same("GET /rw/iosystem/signals")
SIGNAL = _same("GET /rw/iosystem/signals/{signal*}")
SET_SIGNAL = _verb("/rw/iosystem/signals/{signal*}", "set", "set-value")
SEARCH_SIGNALS = _verb("/rw/iosystem/signals", "signal-search")
IO_SYSTEM = _same("GET /rw/iosystem")
NETWORK = _same("GET /rw/iosystem/networks/{network}")
DEVICE = _same("GET /rw/iosystem/devices/{device*}")
SEARCH_NETWORKS = RwsOperation("POST /rw/iosystem/networks?action=search", "-")
SEARCH_DEVICES = _same("POST /rw/iosystem/devices?action=search")
SEARCH_SIGNALS_TWICE = _verb("/rw/iosystem/signals", "signal-searchex", "signal-search-ex")
SIGNAL_CONFIG = RwsOperation("-", "GET /rw/iosystem/signals/{signal*}/config")

# -- motion
MECHUNITS = _same("GET /rw/motionsystem/mechunits")
MECHUNIT = _same("GET /rw/motionsystem/mechunits/{unit}")
JOINT_TARGET = _same("GET /rw/motionsystem/mechunits/{unit}/jointtarget")
ROB_TARGET = _same("GET /rw/motionsystem/mechunits/{unit}/robtarget")
CARTESIAN = _same("GET /rw/motionsystem/mechunits/{unit}/cartesian")
MOTION_SYSTEM = _same("GET /rw/motionsystem")
CHECK_COUNT = RwsOperation(
    "GET /rw/motionsystem/checkchangecount", "GET /rw/motionsystem/checkchangecount/{count}"
)
ERROR_STATE = _same("GET /rw/motionsystem/errorstate")
SET_MECHUNIT = RwsOperation(
    "POST /rw/motionsystem/mechunits/{unit}?action=set", "POST /rw/motionsystem/mechunits/{unit}"
)
BASE_FRAME = _same("GET /rw/motionsystem/mechunits/{unit}/baseframe")
AXES = _same("GET /rw/motionsystem/mechunits/{unit}/axes")
AXIS = _same("GET /rw/motionsystem/mechunits/{unit}/axes/{axis}")
LEAD_THROUGH = RwsOperation("-", "GET /rw/motionsystem/mechunits/{unit}/lead-through")
SET_LEAD_THROUGH = RwsOperation("-", "POST /rw/motionsystem/mechunits/{unit}/lead-through")
SET_POSITION = _verb("/rw/motionsystem/mechunits/{unit}", "mechunit-position", "position")
JOG = _verb("/rw/motionsystem", "jog")

# -- cfg
CFG = _same("GET /rw/cfg")
CFG_DOMAIN = _same("GET /rw/cfg/{domain}")
CFG_INSTANCES = _same("GET /rw/cfg/{domain}/{type}/instances")
CFG_INSTANCE = _same("GET /rw/cfg/{domain}/{type}/instances/{instance}")
CFG_SET = RwsOperation(
    "POST /rw/cfg/{domain}/{type}/instances/{instance}?action=set",
    "POST /rw/cfg/{domain}/{type}/instances/{instance}",
)
CFG_CREATE = _verb("/rw/cfg/{domain}/{type}/instances", "create-default")
CFG_DELETE = _same("DELETE /rw/cfg/{domain}/{type}/instances/{instance}")
CFG_LOAD = _verb("/rw/cfg", "load")
CFG_VALIDATE = _verb("/rw/cfg", "validate")
CFG_SAVE = _verb("/rw/cfg/{domain}", "saveas")
CFG_ATTRIBUTES = RwsOperation("-", "GET /rw/cfg/{domain}/{type}/attributes")

# -- files
VOLUMES = _same("GET /fileservice")
READ_FILE = _same("GET /fileservice/{path*}")
WRITE_FILE = _same("PUT /fileservice/{path*}")
DELETE_FILE = _same("DELETE /fileservice/{path*}")
# RWS 1.0 distinguishes create, copy and rename by the form's `fs-action`.
FILE_ACTION = RwsOperation("POST /fileservice/{path*}", "-")
CREATE_FOLDER = RwsOperation("-", "POST /fileservice/{path*}/create")
COPY_FILE = RwsOperation("-", "POST /fileservice/{path*}/copy")
RENAME_FILE = RwsOperation("-", "POST /fileservice/{path*}/rename")

# -- controller, system, log
CONTROLLER = _same("GET /ctrl")
VARIABLE = _same("GET /ctrl/{variable}")
IDENTITY = _same("GET /ctrl/identity")
CLOCK = _same("GET /ctrl/clock")
SERVICES = _same("GET /rw")
SYSTEM = _same("GET /rw/system")
OPTIONS = _same("GET /rw/system/options")
PRODUCTS = _same("GET /rw/system/products")
ROBOT_TYPE = _same("GET /rw/system/robottype")
RESTART = RwsOperation("POST /rw/panel?action=restart", "POST /ctrl/restart")
RESTART_AT_CTRL = RwsOperation("POST /ctrl", "-")
BACKUP = _verb("/ctrl/backup", "backup", "create")
BACKUP_STATE = _same("GET /ctrl/backup/state")
PROGRESS = _same("GET /progress/{id}")
ELOGS = _same("GET /rw/elog")
ELOG = _same("GET /rw/elog/{domain}")
ELOG_EVENT = _same("GET /rw/elog/{domain}/{number}")
CLEAR_ELOG = _verb("/rw/elog/{domain}", "clear")
SET_CLOCK = _same("PUT /ctrl/clock")
TIME_ZONE = _same("GET /ctrl/clock/timezone")
RESTART_COUNT = RwsOperation("-", "GET /ctrl/restart/restartcount")
LICENSE = _same("GET /rw/system/license")
ENERGY = _same("GET /rw/system/energy")
VIRTUAL_TIME = _same("GET /ctrl/virtualtime/vttime")
VIRTUAL_STATE = _same("GET /ctrl/virtualtime/vtstate")
VIRTUAL_SPEED = _same("GET /ctrl/virtualtime/vtspeed")
SAFETY_MODE = RwsOperation("-", "GET /ctrl/safety/mode")
BACKUPS = _same("GET /ctrl/backup")
RESTORE = _verb("/ctrl/backup", "restore")
CHECK_RESTORE = RwsOperation("-", "POST /ctrl/backup/check-restore")
VISION = _same("GET /rw/vision")
CLEAR_ELOGS = _verb("/rw/elog", "clearall")
ELOG_NUMBER = RwsOperation("-", "GET /rw/elog/seqnum/{number}")
SAVE_ELOG = _verb("/rw/elog", "saveraw")

# -- subscriptions
SUBSCRIBE = _same("POST /subscription")
ADD_SUBSCRIPTION = _same("PUT /subscription/{group}")
UNSUBSCRIBE = _same("DELETE /subscription/{group}")
UNSUBSCRIBE_ONE = _same("DELETE /subscription/{group}/{resource*}")
POLL = _same("GET /poll/{group}")
SUBSCRIPTIONS = _same("GET /subscription")
SUBSCRIPTION = _same("GET /subscription/{group}")
