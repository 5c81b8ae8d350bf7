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
# Externally guided motion (options 689-1 and 3124-1) of a controller without a communication
# partner.
#
# Source, unless stated otherwise: manual 3HAC073318, chapters 2 and 5. Identities, states, modes
# and errors are those of a controller. The virtual controller neither sends nor reads datagrams. A
# robot under guidance stands still, and its task waits as for a socket. EGMSetupAI, EGMSetupAO,
# EGMSetupGI, EGMSetupLTAPP, EGMActMove, EGMMoveL and EGMMoveC stop the program, because they
# require a signal or a path to follow.


_MISMATCH: Final = 41_826
_NO_DATA: Final = 41_822
_AXES: Final = ("J1", "J2", "J3", "J4", "J5", "J6", "J7", "x", "y", "z", "rx", "ry", "rz")
_DISCONNECTED, _CONNECTED, _RUNNING = range(3)
"""Only their order is documented; a public program noted 0 and 1 [code: C-projectabout-...]."""


class EgmIdentity:
    """An egmident: the identity assigned by EGMGetId."""

    __slots__ = ("session",)

    def __init__(self) -> None:
        self.session: EgmSession | None = None


register_type("egmident", EgmIdentity)


def _refused(text: str, *, event: int = GUIDED, title: str = "EGM not possible") -> FatalError:
    return FatalError(event, title, text)


def _session(task: Task, identity: EgmIdentity) -> EgmSession:
    """Return the session of an identity.

    FatalError: not a motion task, or the identity is not assigned.
    """
    moving_group(task)
    if identity.session is None:
        raise _refused("EGMGetId comes first")
    return identity.session


def _set_up(task: Task, identity: EgmIdentity) -> EgmSession:
    """Return a session after its set-up, or raise FatalError."""
    session = _session(task, identity)
    if session.device is None:
        raise _refused("EGMSetupUC comes first")
    return session


@builtin("EGMGetId")
def egm_get_id(task: Task, identity: EgmIdentity) -> None:
    """Assign an identity; a variable keeps its identity.

    FatalError: all four identities are in use [GoFa 7.21].
    """
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
    """Release an identity; ignore one that is not assigned."""
    moving_group(task)
    if identity.session is not None:
        task.controller.egm.free(identity.session)
        identity.session = None


@builtin("EGMGetState")
def egm_get_state(_task: Task, identity: EgmIdentity) -> int:
    """Return the state of an identity.

    DISCONNECTED without EGMGetId, RUNNING while a controller would exchange positions.
    """
    if identity.session is None:
        return _DISCONNECTED
    return _RUNNING if identity.session.running else _CONNECTED


@by_name("EGMSetupUC")
def egm_setup_uc(task: Task, _name: str, arguments: Arguments) -> None:
    """Set up a session with a UdpUc device. FatalError: unknown device.

    Without a mode the session only streams positions, as a public program uses it [code:
    rparak/ABB_EGM_Motion_Mirroring]. The switch `egm_timeout` is the time limit without
    \\CommTimeout.
    """
    session = _session(task, arguments["EGMid"])
    modes = [mode for mode in get_args(Guidance) if arguments[mode]]
    device = task.controller.egm.device(arguments["UCDevice"])
    if device is None:
        raise _refused(f"there is no UDP device {arguments['UCDevice']} in the configuration (SIO)")
    session.end()
    session.guidance = cast(Guidance, modes[0]) if modes else None
    session.device, session.active = device, None
    timeout = task.controller.dialect.egm_timeout
    session.comm_timeout = arguments["CommTimeout"]
    if timeout == "never":
        session.comm_timeout = None
    elif session.comm_timeout is None and timeout == "second":
        session.comm_timeout = 1.0


@by_name("EGMActJoint", "EGMActPose")
def egm_act(task: Task, name: str, arguments: Arguments) -> None:
    """Activate a session; the last activation applies.

    FatalError: the set-up has another mode, or the load is undefined.
    """
    session = _set_up(task, arguments["EGMid"])
    expected: Guidance = "Joint" if name == "EGMActJoint" else "Pose"
    if session.guidance is None:
        raise _refused(f"EGMSetupUC \\{expected} comes first")
    if session.guidance != expected:
        raise _mismatch(f"{name} after EGMSetupUC \\{session.guidance}")
    _check_load(task, name, arguments)
    session.active = expected
    if arguments["StreamStart"]:
        session.streaming = True


def _check_load(task: Task, name: str, arguments: Arguments) -> None:
    """Reject a load of 0 kg (ros-industrial/abb_libegm, issue 73)."""
    group = moving_group(task)
    if arguments["TLoad"] is not None:
        require_defined(task, group, arguments["TLoad"].get(), f"\\TLoad of {name}", zero=False)
    elif arguments["Tool"] is not None:
        require_defined(task, group, arguments["Tool"].get().tload, f"the tool of {name}")


def _mismatch(text: str) -> FatalError:
    return _refused(text, event=_MISMATCH, title="EGM mode mismatch")


@builtin("EGMStreamStart")
def egm_stream_start(task: Task, identity: EgmIdentity, _rate: float | None) -> None:
    """Start the position stream, which has no reader here."""
    _set_up(task, identity).streaming = True


@builtin("EGMStreamStop")
def egm_stream_stop(task: Task, identity: EgmIdentity) -> None:
    """Stop the position stream."""
    _set_up(task, identity).streaming = False


@by_name("EGMRunJoint", "EGMRunPose")
def egm_run(task: Task, name: str, arguments: Arguments) -> None:
    """Run a session.

    Without an axis switch the session has no motion and the program continues. Otherwise the task
    waits for a partner that never sends. ERR_UDPUC_COMM: after \\CommTimeout. FatalError: another
    mode, a moving robot, or \\CommTimeout after \\NoWaitCond.
    """
    session = _set_up(task, arguments["EGMid"])
    expected: Guidance = "Joint" if name == "EGMRunJoint" else "Pose"
    if session.active is None:
        raise _refused(f"{name.replace('Run', 'Act')} comes first")
    if session.active != expected:
        raise _mismatch(f"{name} after EGMAct{session.active}")
    if not moving_group(task).is_standing:
        raise _refused(f"{name} begins in a fine point")
    if not any(arguments.get(axis) for axis in _AXES):
        session.end()
        return
    session.guided = True
    if not arguments["NoWaitCond"]:
        _await(task, session, name)
    elif session.comm_timeout is not None:
        session.limit = task.scheduler.after(
            round(session.comm_timeout * S), lambda: _silent(task, session)
        )


def _await(task: Task, session: EgmSession, name: str) -> None:
    """Wait for EGMStop in a trap, or raise ERR_UDPUC_COMM."""
    try:
        finished = task.wait_for(
            lambda: not session.guided,
            on=(session.changed,),
            timeout=session.comm_timeout,
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
    """Wait for the end of EGMRunJoint \\NoWaitCond.

    A communication timeout is fatal there.
    """
    session = _set_up(task, identity)
    if session.guided:
        task.wait_for(
            lambda: not session.guided,
            on=(session.changed,),
            why=lambda: f"EGMWaitCond waits for datagrams of EGM partner {session.partner}",
        )


@builtin("EGMStop")
def egm_stop(task: Task, identity: EgmIdentity, _mode: float, _ramp_out: float | None) -> None:
    """End guidance, and with it the interrupted EGMRunJoint.

    The robot never left its start, so both modes keep its position.
    """
    _session(task, identity).end()


# -- Force control ---------------------------------------------------------------------------------
#
# Force control (option 661-2), with readings from the description of a cell.
#
# Sources: names [manual 3HAC083267]; arguments [code]: public programs that polish and press with
# FCPress1LStart, FCPressL, FCPressEnd, read FCGetForce and calibrate by FCLoadID. A sensor without
# calibration stops the program (event 50323), also from these programs. FCPressC corresponds to
# FCPressL [mem]. No contact is simulated: the robot follows the programmed path, and the forces are
# those of the description. Search by force (FCRefStart) stops the program.


_UNCALIBRATED: Final = 50_323


def _sensor(task: Task) -> ForceSensor:
    """Return the sensor of a task.

    FatalError: the cell has no description of its readings.
    """
    result = task.controller.force.of(group_of(task).name)
    if result.measured.readings is None:
        raise FatalError(
            NOT_SIMULATED,
            "Nothing to measure",
            "describe what the force sensor measures under `force:` in the description of the cell",
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
    """Calibrate at standstill; later readings exclude the tool load."""
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
    """Return the load of the description.

    A real robot moves axes 5 and 6 for the measurement; this one stands still.
    """
    group_of(task).wait_standing(task)
    result = _sensor(task).measured
    if error is not None:
        error.set(0.0)
    load = LoadData()
    load.mass, load.cog = result.mass, Pos(*result.center)
    return load


@builtin("FCGetForce")
def fc_get_force(task: Task, tool: Ref | None, wobj: Ref | None, contact: bool | None) -> Value:
    """Return the next reading; the frame has no effect."""
    vector = find_type("fcforcevector")
    assert vector is not None
    assert vector.make is not None
    return vector.make(*_calibrated(task).read())


@builtin("FCAct")
def fc_act(
    task: Task, tool: Ref, wobj: Ref | None, reference: float | None, turn: Value | None
) -> None:
    """Activate force control; the robot waits for press or search."""
    group_of(task).wait_standing(task)
    _calibrated(task).controls = True


@builtin("FCDeact")
def fc_deact(task: Task) -> None:
    """Deactivate force control."""
    group_of(task).wait_standing(task)
    sensor = _sensor(task)
    sensor.controls = sensor.pressing = False


@builtin("FCIsForceMode")
def fc_is_force_mode(task: Task) -> bool:
    """Return True if force control is active."""
    return _sensor(task).controls


@by_name("FCPress1LStart", "FCPressL", "FCPressC", "FCPressEnd", cost="move")
@planned
def press(task: Task, name: str, arguments: Arguments) -> None:
    """Move on a line or circle with a process force.

    FatalError: FCPressL and related instructions without a start.
    """
    sensor = _calibrated(task)
    if name != "FCPress1LStart" and not sensor.pressing:
        raise FatalError(
            NOT_SIMULATED, "No process force", f"{name} requires FCPress1LStart before"
        )
    sensor.controls = sensor.pressing = True
    if not arguments.get("DeactOnly"):
        order(task, {**arguments, "T": None}, cartesian_move)
    if name == "FCPressEnd":
        group_of(task).wait_standing(task)
        sensor.controls = sensor.pressing = False
