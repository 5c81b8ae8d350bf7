"""Externally guided motion (options 689-1 and 3124-1).

Source, unless stated otherwise: manual 3HAC073318, chapters 2 and 5. The law and the cycles are in
`rapidgen/motion/egm`. Without a partner a robot under guidance stands still, and its task waits as
for a socket. EGMSetupAI, EGMSetupAO, EGMSetupGI, EGMSetupLTAPP, EGMActMove, EGMMoveL and EGMMoveC
stop the program, because they require a signal or a path to follow.
"""

from math import radians
from typing import Final, cast, get_args

from rapidgen.axes import frames
from rapidgen.axes.frames import IDENTITY
from rapidgen.axes.frames import Pose as Frame
from rapidgen.machine.scheduler import S
from rapidgen.motion.egm.guide import JOINT_NAMES, POSE_NAMES, Activation, Mode, Run
from rapidgen.motion.egm.law import CYCLE
from rapidgen.motion.egm.sessions import MAX_IDENTITIES, EgmSession, Guidance
from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.builtins.motion.positions import require_defined
from rapidgen.runtime.builtins.motion.targets import carrier_of, frame, moving_group
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.motion_interface import GUIDED
from rapidgen.runtime.registry import Arguments, builtin, by_name
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Value, register_type
from rapidgen.wire.egm.values import MAX_NUMBERS, RapidData

_MISMATCH: Final = 41_826
_NO_DATA: Final = 41_822
_NOT_SENT: Final = 41_830
_BOUNDS: Final = 194_913
_NO_MOVE: Final = 194_915
_DATA_SINCE: Final = (7, 7)
_DISCONNECTED, _CONNECTED, _RUNNING = range(3)
"""Only their order is documented; a public program noted 0 and 1 [code: C-projectabout-...]."""
_HOLD: Final = 0
_BASE, _TOOL, _WOBJ, _WORLD = range(4)
_JOINT_LIMIT, _PLACE_LIMIT = radians(0.5), 0.001
"""Convergence without an argument: 0.5 degrees and 1 mm."""


class EgmIdentity:
    """An egmident: the identity assigned by EGMGetId."""

    __slots__ = ("session",)

    def __init__(self) -> None:
        self.session: EgmSession | None = None


register_type("egmident", EgmIdentity)


def _refused(text: str, *, event: int = GUIDED, title: str = "EGM not possible") -> FatalError:
    return FatalError(event, title, text)


def _mismatch(text: str) -> FatalError:
    return _refused(text, event=_MISMATCH, title="EGM mode mismatch")


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


# -- Identities ------------------------------------------------------------------------------------


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


# -- Set-up and activation -------------------------------------------------------------------------


@by_name("EGMSetupUC")
def egm_setup_uc(task: Task, _name: str, arguments: Arguments) -> None:
    """Set up a session with a UdpUc device. FatalError: unknown device, profile or unit.

    Without a mode the session only streams positions, as a public program uses it [code:
    rparak/ABB_EGM_Motion_Mirroring]. The switch `egm_timeout` is the time limit without
    \\CommTimeout.
    """
    session, egm = _session(task, arguments["EGMid"]), task.controller.egm
    modes = [mode for mode in get_args(Guidance) if arguments[mode]]
    device = egm.device(arguments["UCDevice"])
    if device is None:
        raise _refused(f"there is no UDP device {arguments['UCDevice']} in the configuration (SIO)")
    profile = egm.profile(arguments["ExtConfigName"])
    if profile is None:
        name = arguments["ExtConfigName"]
        raise _refused(f"there is no external motion data {name} in the configuration (MOC)")
    group = moving_group(task)
    unit = str(arguments["MecUnit"].value)
    if unit.lower() in (name.lower() for name in group.config.external_units):
        raise _refused(f"{unit} is not a robot with a TCP", event=_NOT_SENT)
    egm.end(session)
    session.guidance = cast(Guidance, modes[0]) if modes else None
    session.device, session.profile, session.group = device, profile, group
    session.active = session.activation = None
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
    expected: Mode = "Joint" if name == "EGMActJoint" else "Pose"
    if session.guidance is None:
        raise _refused(f"EGMSetupUC \\{expected} comes first")
    if session.guidance != expected:
        raise _mismatch(f"{name} after EGMSetupUC \\{session.guidance}")
    _check_load(task, name, arguments)
    _exchange_data(task, session, arguments)
    session.activation = _activation(moving_group(task), session, expected, arguments)
    session.active = expected
    if arguments["StreamStart"]:
        _stream(task, session)


def _exchange_data(task: Task, session: EgmSession, arguments: Arguments) -> None:
    """Connect signals and arrays of EGMAct with the messages of a session.

    They are read and written in each cycle. FatalError: an earlier release, or a longer array.
    """
    names = ("DOToSensor", "DataToSensor", "DIFromSensor", "DataFromSensor")
    output, numbers, digital, received = (arguments[name] for name in names)
    given = [name for name in names if arguments[name] is not None]
    session.outgoing = session.incoming = None
    if not given:
        return
    egm = task.controller.egm
    if egm.release < _DATA_SINCE:
        raise _refused(f"\\{given[0]} needs RobotWare 7.07 or later")
    for name, array in (("DataToSensor", numbers), ("DataFromSensor", received)):
        if array is not None and len(array.get()) > MAX_NUMBERS:
            raise _refused(f"\\{name} has {len(array.get())} elements: {MAX_NUMBERS} are possible")

    def outgoing() -> RapidData:
        level = None if output is None else bool(output.value)
        values = () if numbers is None else tuple(numbers.get().values())
        return RapidData(level, values)

    def incoming(data: RapidData) -> None:
        if digital is not None and data.digital is not None:
            task.controller.io.set(digital, int(data.digital))
        if received is not None and data.numbers:
            # A shorter message leaves the rest of the array as it is.
            numbers_of = received.get()
            received.set({**numbers_of, **dict(zip(numbers_of, data.numbers, strict=False))})

    if output is not None or numbers is not None:
        session.outgoing = outgoing
    if digital is not None or received is not None:
        session.incoming = incoming


def _activation(
    group: MotionGroup, session: EgmSession, mode: Mode, arguments: Arguments
) -> Activation:
    tool = arguments["Tool"].get() if arguments["Tool"] is not None else None
    work_object = arguments["WObj"].get() if arguments["WObj"] is not None else None
    carrier = None if tool is None else carrier_of(group, tool, work_object)
    tool_frame = IDENTITY if carrier is None else carrier.tool
    object_frame = IDENTITY if carrier is None else carrier.object
    bandwidth = arguments["LpFilter"]
    rate = arguments["SampleRate"]
    deviation, speed = arguments["MaxPosDeviation"], arguments["MaxSpeedDeviation"]
    correction = sensor = IDENTITY
    if mode == "Pose":
        correction, sensor = (
            _placed(group, tool_frame, object_frame, arguments[name], int(arguments[kind]))
            for name, kind in (("CorrFrame", "CorrFrType"), ("SensorFrame", "SensorFrType"))
        )
    return Activation(
        mode=mode,
        bandwidth=session.profile.bandwidth if bandwidth is None else max(0.0, bandwidth),
        sample_time=CYCLE if rate is None else max(1, round(rate / 4)) * CYCLE,
        max_deviation=radians(1000.0 if deviation is None else deviation),
        max_speed=radians(1.0 if speed is None else speed),
        convergence=_convergence(group, mode, arguments),
        tool=tool_frame,
        object=object_frame,
        correction=correction,
        sensor=sensor,
    )


def _convergence(
    group: MotionGroup, mode: Mode, arguments: Arguments
) -> tuple[tuple[float, float], ...]:
    """Return limits of egm_minmax by axis, or by x, y, z, rx, ry and rz."""
    if mode == "Joint":
        names = dict(zip((*(f"rax_{i}" for i in range(1, 7)), "eax_a"), JOINT_NAMES, strict=True))
        wanted = [arguments.get(names.get(joint.axis, "")) for joint in group.config.joints]
        default, size = [_JOINT_LIMIT] * len(wanted), [radians(1.0)] * len(wanted)
    else:
        wanted = [arguments.get(name) for name in POSE_NAMES]
        default = [_PLACE_LIMIT] * 3 + [_JOINT_LIMIT] * 3
        size = [0.001] * 3 + [radians(1.0)] * 3
    return tuple(
        (-limit, limit) if value is None else (value.min * unit, value.max * unit)
        for value, limit, unit in zip(wanted, default, size, strict=True)
    )


def _placed(group: MotionGroup, tool: Frame, object_frame: Frame, given: Value, kind: int) -> Frame:
    """Return a frame of EGMActPose in the robot's base; the world is the base."""
    if kind == _TOOL:
        reference = frames.compose(group.geometry().forward(group.commanded()), tool)
    elif kind == _WOBJ:
        reference = object_frame
    elif kind in (_BASE, _WORLD):
        reference = IDENTITY
    else:
        raise _refused("EGM_FRAME_JOINT is no frame of EGMActPose")
    return frames.compose(reference, frame(given))


def _check_load(task: Task, name: str, arguments: Arguments) -> None:
    """Reject a load of 0 kg (ros-industrial/abb_libegm, issue 73)."""
    group = moving_group(task)
    if arguments["TLoad"] is not None:
        require_defined(task, group, arguments["TLoad"].get(), f"\\TLoad of {name}", zero=False)
    elif arguments["Tool"] is not None:
        require_defined(task, group, arguments["Tool"].get().tload, f"the tool of {name}")


@builtin("EGMStreamStart")
def egm_stream_start(task: Task, identity: EgmIdentity, _rate: float | None) -> None:
    """Start the position stream."""
    _stream(task, _set_up(task, identity))


def _stream(task: Task, session: EgmSession) -> None:
    session.on_end = lambda: _ended(task, session)
    task.controller.egm.stream(session)


@builtin("EGMStreamStop")
def egm_stream_stop(task: Task, identity: EgmIdentity) -> None:
    """Stop the position stream."""
    task.controller.egm.stop_stream(_set_up(task, identity))


# -- Runs ------------------------------------------------------------------------------------------


@by_name("EGMRunJoint", "EGMRunPose")
def egm_run(task: Task, name: str, arguments: Arguments) -> None:
    """Run a session until it converges, until EGMStop, or without a partner for ever.

    Without an axis switch the session has no motion and the program continues. ERR_UDPUC_COMM:
    after \\CommTimeout. FatalError: another mode, a moving robot, an axis out of bounds, or
    \\CommTimeout after \\NoWaitCond.
    """
    session = _set_up(task, arguments["EGMid"])
    expected: Mode = "Joint" if name == "EGMRunJoint" else "Pose"
    if session.active is None:
        raise _refused(f"{name.replace('Run', 'Act')} comes first")
    if session.active != expected:
        raise _mismatch(f"{name} after EGMAct{session.active}")
    group = moving_group(task)
    if not group.is_standing:
        raise _refused(f"{name} begins in a fine point")
    if group.name not in task.controller.motion.moved:
        # What a controller does then is not published [manual 3HAC073318, 1.1].
        task.controller.log.record(_NO_MOVE, name, task=task.name)
    names = JOINT_NAMES if expected == "Joint" else POSE_NAMES
    axes = tuple(axis for axis in names if arguments.get(axis))
    if not axes:
        task.controller.egm.end(session)
        return
    waits = not arguments["NoWaitCond"]
    session.on_end = None if waits else lambda: _ended(task, session)
    task.controller.egm.start(session, _run(session, axes, arguments))
    if waits:
        _await(task, session, name)
        return
    if session.loop is None and session.comm_timeout is not None and session.guided:
        task.scheduler.after(
            round(session.comm_timeout * S), lambda: task.controller.egm.give_up(session)
        )


def _run(session: EgmSession, axes: tuple[str, ...], arguments: Arguments) -> Run:
    def given(name: str, default: float) -> float:
        value = arguments[name]
        return default if value is None else max(0.0, value)

    offset = arguments.get("Offset")
    return Run(
        axes=axes,
        gain=min(1.0, given("PosCorrGain", 1.0)) * session.profile.gain,
        hold=int(arguments["Mode"]) == _HOLD,
        condition_time=given("CondTime", 1.0),
        ramp_in=given("RampInTime", 0.0),
        ramp_out=given("RampOutTime", session.profile.ramp_time),
        offset=IDENTITY if offset is None else frame(offset),
    )


def _await(task: Task, session: EgmSession, name: str) -> None:
    """Wait for the end of a run; raise what ended it in error."""
    egm, goes_on = task.controller.egm, False
    try:
        finished = task.wait_for(
            lambda: not session.guided,
            on=(session.changed,),
            timeout=session.comm_timeout if session.loop is None else None,
            why=lambda: f"{name} waits for datagrams of EGM partner {session.partner}",
        )
        if not finished:
            egm.give_up(session)
        outcome = session.outcome
    except RapidError:
        # A trap has left the run by RAISE. Guidance goes on until EGMStop: the StateMachine add-in
        # executes that after its handler, if the state is RUNNING [code TRobEGM 1.1].
        goes_on = True
        session.on_end = lambda: _ended(task, session)
        raise
    finally:
        if not goes_on:
            egm.end(session)
    if outcome == "silent":
        raise RapidError("ERR_UDPUC_COMM", f"no datagram of {session.partner}")
    if (fault := _fault(session)) is not None:
        raise fault


def _ended(task: Task, session: EgmSession) -> None:
    """Stop the program after a run that failed while it was not waited for."""
    if session.outcome == "silent":
        title = "No data from the UdpUc device"
        task.order(_refused(session.partner, event=_NO_DATA, title=title))
    elif (fault := _fault(session)) is not None:
        task.order(fault)


def _fault(session: EgmSession) -> FatalError | None:
    """Return the error that ends the program after a run."""
    if session.outcome == "unreachable":
        return _refused(session.partner, event=_NOT_SENT, title="EGM: message not sent")
    if session.outcome == "bounds":
        return _refused(session.reason, event=_BOUNDS, title="EGM input out of bounds")
    return None


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
def egm_stop(task: Task, identity: EgmIdentity, mode: float, ramp_out: float | None) -> None:
    """End guidance, and with it the interrupted EGMRunJoint once the robot stands.

    Outside of a trap nothing else waits for that, so this does.
    """
    session = _session(task, identity)
    time = session.profile.ramp_time if ramp_out is None else max(0.0, ramp_out)
    egm = task.controller.egm
    egm.stop(session, hold=int(mode) == _HOLD, ramp_out=time)
    if session.guided and session.loop is not None and not task.in_trap:
        task.wait_for(
            lambda: not session.guided,
            on=(session.changed,),
            why=lambda: "EGMStop waits until the robot stands",
        )
        egm.end(session)
