"""Motion under sensors: externally guided motion and force control."""

from typing import Final, cast, get_args

from rapidgen.machine.egm import MAX_IDENTITIES, EgmSession, Guidance
from rapidgen.machine.scheduler import S
from rapidgen.machine.sensors import ForceSensor
from rapidgen.runtime.builtins.motion.moves import cartesian_move, order
from rapidgen.runtime.builtins.motion.positions import require_defined
from rapidgen.runtime.builtins.motion.targets import group_of, moving_group
from rapidgen.runtime.compiler.link import find_type
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.motion_interface import GUIDED, NOT_SIMULATED, planned
from rapidgen.runtime.registry import Arguments, builtin, by_name
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import LoadData, Pos, Ref, Value, register_type

# -- Externally guided motion ----------------------------------------------------------------------
#
# Externally guided motion (options 689-1 and 3124-1) of a controller whose partner is silent.
#
# Source, unless another is named: manual 3HAC073318, chapters 2 and 5. Identities, states, modes
# and refusals are a controller's; a datagram is neither sent nor read, so a robot that is to be
# guided stands where it is, and its task waits as for a socket. EGMSetupAI, EGMSetupAO, EGMSetupGI,
# EGMSetupLTAPP, EGMActMove, EGMMoveL and EGMMoveC stop the program: a signal or a path would have
# to be followed.


_MISMATCH: Final = 41_826
_NO_DATA: Final = 41_822
_AXES: Final = ("J1", "J2", "J3", "J4", "J5", "J6", "J7", "x", "y", "z", "rx", "ry", "rz")
_DISCONNECTED, _CONNECTED, _RUNNING = range(3)
"""Only their order is documented; a public program noted 0 and 1 [code: C-projectabout-...]."""


class EgmIdentity:
    """An egmident: what EGMGetId has put into it."""

    __slots__ = ("session",)

    def __init__(self) -> None:
        self.session: EgmSession | None = None


register_type("egmident", EgmIdentity)


def _refused(text: str, *, event: int = GUIDED, title: str = "EGM not possible") -> FatalError:
    return FatalError(event, title, text)


def _session(task: Task, identity: EgmIdentity) -> EgmSession:
    """FatalError: it is no motion task, or the identity was not taken, or was given back."""
    moving_group(task)
    if identity.session is None:
        raise _refused("EGMGetId comes first")
    return identity.session


def _set_up(task: Task, identity: EgmIdentity) -> EgmSession:
    """FatalError: nothing was set up."""
    session = _session(task, identity)
    if session.device is None:
        raise _refused("EGMSetupUC comes first")
    return session


@builtin("EGMGetId")
def egm_get_id(task: Task, identity: EgmIdentity) -> None:
    """The same variable keeps its own. FatalError: all four are in use [GoFa 7.21]."""
    moving_group(task)
    if identity.session is not None:
        return
    identity.session = task.controller.egm.take(task.name)
    if identity.session is None:
        raise _refused(
            f"{MAX_IDENTITIES} identities are in use: EGMReset gives one back",
            title="Too many EGM instances",
        )


@builtin("EGMReset")
def egm_reset(task: Task, identity: EgmIdentity) -> None:
    """Give it back; one that was not taken is left alone."""
    moving_group(task)
    if identity.session is not None:
        task.controller.egm.free(identity.session)
        identity.session = None


@builtin("EGMGetState")
def egm_get_state(_task: Task, identity: EgmIdentity) -> int:
    """DISCONNECTED without EGMGetId, RUNNING while positions would go out or in."""
    if identity.session is None:
        return _DISCONNECTED
    return _RUNNING if identity.session.running else _CONNECTED


@by_name("EGMSetupUC")
def egm_setup_uc(task: Task, _name: str, arguments: Arguments) -> None:
    """FatalError: there is no such device. Without a mode positions are streamed only, as a public
    program for that alone has it [code: rparak/ABB_EGM_Motion_Mirroring]. How long a silent partner
    is waited for without \\CommTimeout is the switch `egm_patience`."""
    session = _session(task, arguments["EGMid"])
    modes = [mode for mode in get_args(Guidance) if arguments[mode]]
    device = task.controller.egm.device(arguments["UCDevice"])
    if device is None:
        raise _refused(f"there is no UDP device {arguments['UCDevice']} in the configuration (SIO)")
    session.end()
    session.guidance = cast(Guidance, modes[0]) if modes else None
    session.device, session.active = device, None
    timeout = task.controller.dialect.egm_patience
    session.patience = arguments["CommTimeout"]
    if timeout == "never":
        session.patience = None
    elif session.patience is None and timeout == "second":
        session.patience = 1.0


@by_name("EGMActJoint", "EGMActPose")
def egm_act(task: Task, name: str, arguments: Arguments) -> None:
    """The last one counts. FatalError: it was set up for something else, its load is undefined."""
    session = _set_up(task, arguments["EGMid"])
    expected: Guidance = "Joint" if name == "EGMActJoint" else "Pose"
    if session.guidance is None:
        raise _refused(f"EGMSetupUC \\{expected} comes first")
    if session.guidance != expected:
        raise _mismatch(f"{name} behind EGMSetupUC \\{session.guidance}")
    _check_load(task, name, arguments)
    session.active = expected
    if arguments["StreamStart"]:
        session.streaming = True


def _check_load(task: Task, name: str, arguments: Arguments) -> None:
    """A load of 0 kg is refused here (ros-industrial/abb_libegm, issue 73)."""
    group = moving_group(task)
    if arguments["TLoad"] is not None:
        require_defined(task, group, arguments["TLoad"].get(), f"\\TLoad of {name}", zero=False)
    elif arguments["Tool"] is not None:
        require_defined(task, group, arguments["Tool"].get().tload, f"the tool of {name}")


def _mismatch(text: str) -> FatalError:
    return _refused(text, event=_MISMATCH, title="EGM mode mismatch")


@builtin("EGMStreamStart")
def egm_stream_start(task: Task, identity: EgmIdentity, _rate: float | None) -> None:
    """Positions would go out; nobody has to read them."""
    _set_up(task, identity).streaming = True


@builtin("EGMStreamStop")
def egm_stream_stop(task: Task, identity: EgmIdentity) -> None:
    """They would no longer."""
    _set_up(task, identity).streaming = False


@by_name("EGMRunJoint", "EGMRunPose")
def egm_run(task: Task, name: str, arguments: Arguments) -> None:
    """Without the switch of an axis nothing is to move and the program goes on; else it waits for
    a partner who never comes.

    ERR_UDPUC_COMM: \\CommTimeout has passed. FatalError: the mode is another, the robot moves, or
    \\CommTimeout has passed behind \\NoWaitCond.
    """
    session = _set_up(task, arguments["EGMid"])
    expected: Guidance = "Joint" if name == "EGMRunJoint" else "Pose"
    if session.active is None:
        raise _refused(f"{name.replace('Run', 'Act')} comes first")
    if session.active != expected:
        raise _mismatch(f"{name} behind EGMAct{session.active}")
    if not moving_group(task).is_standing:
        raise _refused(f"{name} begins in a fine point")
    if not any(arguments.get(axis) for axis in _AXES):
        session.end()
        return
    session.guided = True
    if not arguments["NoWaitCond"]:
        _await(task, session, name)
    elif session.patience is not None:
        session.limit = task.scheduler.after(
            round(session.patience * S), lambda: _silent(task, session)
        )


def _await(task: Task, session: EgmSession, name: str) -> None:
    """Until EGMStop in a trap. ERR_UDPUC_COMM."""
    try:
        finished = task.wait_for(
            lambda: not session.guided,
            on=(session.changed,),
            timeout=session.patience,
            why=lambda: f"{name} waits for datagrams of EGM partner {session.partner}",
        )
    finally:
        session.end()
    if not finished:
        raise RapidError("ERR_UDPUC_COMM", f"no datagram of {session.partner}")


def _silent(task: Task, session: EgmSession) -> None:
    session.end()
    task.order(_refused(session.partner, event=_NO_DATA, title="No data from the UdpUc device"))


@builtin("EGMWaitCond")
def egm_wait_cond(task: Task, identity: EgmIdentity, _time: float | None) -> None:
    """Until what EGMRunJoint \\NoWaitCond began has come to its end. A silence is fatal there."""
    session = _set_up(task, identity)
    if session.guided:
        task.wait_for(
            lambda: not session.guided,
            on=(session.changed,),
            why=lambda: f"EGMWaitCond waits for datagrams of EGM partner {session.partner}",
        )


@builtin("EGMStop")
def egm_stop(task: Task, identity: EgmIdentity, _mode: float, _ramp_out: float | None) -> None:
    """Guiding ends, and with it EGMRunJoint, from whose trap this is called. The robot has stayed
    at its start, so neither mode moves it."""
    _session(task, identity).end()


# -- Force control ---------------------------------------------------------------------------------
#
# Force control (option 661-2), which answers by the description of a cell.
#
# Sources: names [manual 3HAC083267]; arguments [code]: public programs that polish and press with
# FCPress1LStart, FCPressL, FCPressEnd, read FCGetForce and calibrate by FCLoadID. That a sensor
# which is not calibrated stops the program is theirs, too (event 50323). FCPressC is as FCPressL
# [mem]. Nothing is touched: the robot goes where the program says, and a force is what the file
# says. Searching by force (FCRefStart) stops the program.


_UNCALIBRATED: Final = 50_323


def _sensor(task: Task) -> ForceSensor:
    """FatalError: nothing tells what the sensor measures."""
    result = task.controller.force.of(group_of(task).name)
    if result.measured.readings is None:
        raise FatalError(
            NOT_SIMULATED,
            "Nothing to measure",
            "say what the force sensor measures under `force:` in the description of the cell",
        )
    return result


def _calibrated(task: Task) -> ForceSensor:
    result = _sensor(task)
    if not result.calibrated:
        raise FatalError(
            _UNCALIBRATED, "Force sensor not calibrated", "FCCalib takes the load of the tool off"
        )
    return result


@builtin("FCCalib")
def fc_calib(task: Task, load: Value, _recovery: bool | None) -> None:
    """The robot stands, and the load of the tool is taken off from now on."""
    group_of(task).wait_standing(task)
    _sensor(task).calibrated = True


@builtin("FCLoadID")
def fc_load_id(
    task: Task,
    reading_time: float | None,
    axis_5: float | None,
    axis_6: float | None,
    points: float | None,
    quiet: bool | None,
    error: Ref | None,
) -> Value:
    """The load of the description; axes 5 and 6, which a robot would turn for it, stand."""
    group_of(task).wait_standing(task)
    result = _sensor(task).measured
    if error is not None:
        error.set(0.0)
    load = LoadData()
    load.mass, load.cog = result.mass, Pos(*result.center)
    return load


@builtin("FCGetForce")
def fc_get_force(task: Task, tool: Ref | None, wobj: Ref | None, contact: bool | None) -> Value:
    """The next reading, in whatever frame it is asked for."""
    vector = find_type("fcforcevector")
    assert vector is not None
    assert vector.make is not None
    return vector.make(*_calibrated(task).read())


@builtin("FCAct")
def fc_act(
    task: Task, tool: Ref, wobj: Ref | None, reference: float | None, turn: Value | None
) -> None:
    """Force control is active; the robot stands until it is told to press or to search."""
    group_of(task).wait_standing(task)
    _calibrated(task).controls = True


@builtin("FCDeact")
def fc_deact(task: Task) -> None:
    """The robot is held in its position again."""
    group_of(task).wait_standing(task)
    sensor = _sensor(task)
    sensor.controls = sensor.pressing = False


@builtin("FCIsForceMode")
def fc_is_force_mode(task: Task) -> bool:
    """Whether force control is active."""
    return _sensor(task).controls


@by_name("FCPress1LStart", "FCPressL", "FCPressC", "FCPressEnd", cost="move")
@planned
def press(task: Task, name: str, arguments: Arguments) -> None:
    """A line or a circle of a path with a process force, as programmed. FatalError: FCPressL and
    its kin without a start."""
    sensor = _calibrated(task)
    if name != "FCPress1LStart" and not sensor.pressing:
        raise FatalError(
            NOT_SIMULATED, "No process force", f"{name} goes on from FCPress1LStart, which was not"
        )
    sensor.controls = sensor.pressing = True
    if not arguments.get("DeactOnly"):
        order(task, {**arguments, "T": None}, cartesian_move)
    if name == "FCPressEnd":
        group_of(task).wait_standing(task)
        sensor.controls = sensor.pressing = False
