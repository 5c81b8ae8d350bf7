"""SmartGripper of a YuMi: Hand_Initialize to g_GetPressure2.

Source: its driver HandDriver.sys [code kth-ros-pkg/yumi] for checks, waits, errors and times. A
task uses the hand of its robot: ROB_L the left one, ROB_R the right one. Otherwise the first task
uses the right hand and the second the left one.
"""

from collections.abc import Callable

from rapidgen.machine.smart_gripper import PHYSICAL_LIMIT, Command, HandState, SmartGripper
from rapidgen.rapid.numbers import single
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.motion_interface import NOT_ALLOWED
from rapidgen.runtime.registry import Arguments, builtins, by_name
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Value

_WAIT = 5.0
"""s for a state."""
_JOG_BEGINS, _JOG_TIME = 0.5, 2.5
_VACUUM_TIME = 1.0
_SPEEDS = (3.0, 25.0)
_FORCES = (0.0, 20.0)
_PRECISION = 1.0
"""mm by which a move may miss."""


def _hand(task: Task) -> SmartGripper:
    hands = task.controller.hands
    chosen = hands.chosen.get(task.name)
    if chosen is not None:
        return hands[chosen]
    group = task.controller.motion.of_task(task.name)
    unit = "" if group is None else group.config.mechanical_unit.upper()
    if unit in ("ROB_L", "ROB_R"):
        return hands[unit[-1]]
    place = list(task.controller.tasks).index(task.name)
    if place > 1:
        raise FatalError(NOT_ALLOWED, "No hand", f"{task.name} is neither the first nor the second")
    return hands["RL"[place]]


# -- settings ------------------------------------------------------------------------------------


def _limited(value: float, limits: tuple[float, float]) -> float:
    return min(max(round(value, 1), limits[0]), limits[1])


def _set_speed(task: Task, speed: float) -> None:
    _hand(task).set_register("max_speed", _limited(speed, _SPEEDS))


def _set_force(task: Task, force: float) -> None:
    _hand(task).set_register("hold_force", _limited(force, _FORCES))


def _initialise(
    task: Task,
    speed: float | None,
    force: float | None,
    limit: float | None,
    calibrate: bool | None,
) -> None:
    """Initialise with 25 mm/s, 20 N and 25 mm as defaults."""
    _set_speed(task, _SPEEDS[1] if speed is None else speed)
    _set_force(task, _FORCES[1] if force is None else force)
    hand = _hand(task)
    task.controller.hands.limits[hand.side] = PHYSICAL_LIMIT if limit is None else limit
    if calibrate:
        _calibrate(task, True)


def _calibrate(task: Task, jog: bool | None, grip: bool | None = None) -> None:
    """Make the finger position the new 0; \\Jog closes the fingers first."""
    if jog or grip:
        _jog(Command.JOG_CLOSE)(task)
        task.sleep(_JOG_BEGINS)
    _send(task, Command.READY)
    _send(task, Command.CALIBRATE)
    _wait_for(task, HandState.COMPLETED)
    _send(task, Command.READY)


def _cast(task: Task, side: str) -> None:
    """Assign a hand to this task. ERR_ARGVALERR: neither L nor R."""
    if side not in ("L", "R"):
        raise RapidError("ERR_ARGVALERR", side)
    task.controller.hands.chosen[task.name] = side


# -- fingers -------------------------------------------------------------------------------------


def _send(task: Task, code: float) -> None:
    _hand(task).order(int(code))


def _wait_for(task: Task, state: float, seconds: float | None = None) -> None:
    """Wait for a state.

    ERR_HAND_WRONGSTATE: an error, or not within 5 s.
    """
    hand = _hand(task)
    task.wait_for(
        lambda: hand.state in (state, HandState.ERROR),
        on=(hand.changed,),
        timeout=_WAIT if seconds is None else seconds,
    )
    if hand.state != state:
        raise RapidError("ERR_HAND_WRONGSTATE", hand.state.name)


def _jog(code: Command) -> Callable[[Task], None]:
    def jog(task: Task) -> None:
        """Move to the end or to contact, then stand still."""
        hand = _hand(task)
        hand.order(Command.READY)
        hand.order(code)
        task.sleep(_JOG_BEGINS)
        longest = _JOG_TIME * 20 / hand.max_speed
        task.wait_for(lambda: hand.speed < 1, on=(hand.changed,), timeout=longest)
        _stop(task)

    return jog


def _stop(task: Task) -> None:
    _send(task, Command.READY)


def _in_range(task: Task, place: float) -> float:
    """Raise ERR_HAND_AUGOUTOFRANGE below 0 or above the range."""
    if not 0 <= round(place, 1) <= task.controller.hands.limits[_hand(task).side]:
        raise RapidError("ERR_HAND_AUGOUTOFRANGE", f"{place:g} mm")
    return round(place, 1)


def _calibrated(task: Task) -> SmartGripper:
    hand = _hand(task)
    if not hand.calibrated:
        raise RapidError("ERR_HAND_NOTCALIBRATED", f"hand {hand.side}")
    return hand


def _move_to(task: Task, place: float, no_wait: bool | None) -> None:
    hand = _calibrated(task)
    inward = hand.position >= place
    register = "min_position" if inward else "max_position"
    hand.set_register(register, _in_range(task, place))
    hand.order(Command.READY)
    hand.order(Command.TO_MIN if inward else Command.TO_MAX)
    if not no_wait:
        _completed(task, None, place)


def _completed(task: Task, precise: bool | None, place: float | None = None) -> None:
    """Raise ERR_HAND_FAILEDMOVEPOS if the target is over 1 mm away."""
    hand = _hand(task)
    try:
        _wait_for(task, HandState.COMPLETED)
    except RapidError as error:
        near = place is not None and abs(hand.position - place) <= _PRECISION
        if hand.state is not HandState.ERROR or precise or not near:
            raise RapidError("ERR_HAND_FAILEDMOVEPOS", f"{hand.position:.1f} mm") from error


@by_name("Hand_GripInward", "Hand_GripOutward", "g_GripIn", "g_GripOut")
def grip(task: Task, name: str, arguments: Arguments) -> None:
    """Grip outwards or inwards until contact or the end of travel.

    Raises ERR_HAND_NOTCALIBRATED; ERR_HAND_FAILEDGRIPINWARD: \\targetPos is in the other direction;
    ERR_HAND_FAILEDGRIPPOS: not reached within \\posAlowance; ERR_HAND_WRONGSTATE: not within 5 s.
    """
    hand, inward = _calibrated(task), "in" in name.lower().split("grip")[1]
    _set_force(task, _FORCES[1] if arguments["holdForce"] is None else arguments["holdForce"])
    place, allowance = arguments["targetPos"], arguments["posAlowance"]
    if place is not None:
        if (hand.position < place) if inward else (hand.position > place):
            refused = "ERR_HAND_FAILEDGRIPINWARD" if inward else "ERR_HAND_FAILEDGRIPPOS"
            raise RapidError(refused, f"from {hand.position:.1f} to {place:g} mm")
        register = "min_position" if inward else "max_position"
        hand.set_register(register, _in_range(task, place))
    hand.order(Command.READY)
    hand.order(Command.AGILE_INWARD if inward else Command.AGILE_OUTWARD)
    if arguments["NoWait"]:
        return
    _wait_for(task, HandState.KEEP_OBJECT)
    if None not in (place, allowance) and abs(hand.position - place) > allowance:
        raise RapidError("ERR_HAND_FAILEDGRIPPOS", f"{hand.position:.1f} mm")


# -- vacuum and air ------------------------------------------------------------------------------


def _vacuum_on(cup: int) -> Callable[[Task, float | None], None]:
    def switch(task: Task, threshold: float | None) -> None:
        """Switch the blow-off air off and the vacuum on.

        ERR_HAND_FAILEDVACUUM: not below \\threshold kPa within 1 s.
        """
        hand = _hand(task)
        hand.switch("blow", cup, False)
        hand.switch("vacuum", cup, True)
        if threshold is not None and not task.wait_for(
            lambda: hand.pressure(cup) < threshold, on=(hand.changed,), timeout=_VACUUM_TIME
        ):
            raise RapidError("ERR_HAND_FAILEDVACUUM", f"{hand.pressure(cup):g} kPa")

    return switch


def _blow_on(cup: int) -> Callable[[Task], None]:
    def switch(task: Task) -> None:
        """Switch the vacuum off and the blow-off air on."""
        hand = _hand(task)
        hand.switch("vacuum", cup, False)
        hand.switch("blow", cup, True)

    return switch


def _off(valve: str, cup: int) -> Callable[[Task], None]:
    return lambda task: _hand(task).switch(valve, cup, False)


def _pressure(cup: int) -> Callable[[Task], float]:
    return lambda task: single(_hand(task).pressure(cup))


_CALLS: dict[tuple[str, ...], Callable[..., Value]] = {
    ("Hand_Initialize", "g_Init"): _initialise,
    ("Hand_DoCalibrate", "g_Calibrate"): _calibrate,
    ("Hand_SetMaxSpeed", "g_SetMaxSpd"): _set_speed,
    ("Hand_SetHoldForce", "g_SetForce"): _set_force,
    ("Hand_JogInward", "g_JogIn"): _jog(Command.JOG_CLOSE),
    ("Hand_JogOutward", "g_JogOut"): _jog(Command.JOG_OPEN),
    ("Hand_MoveTo", "g_MoveTo"): _move_to,
    ("Hand_Stop", "g_Stop"): _stop,
    ("Hand_WaitMovingCompleted",): _completed,
    ("Hand_WaitForExpectedState",): _wait_for,
    ("Hand_SendCommand",): _send,
    ("Hand_CastChirality",): _cast,
    ("Hand_IsCalibrated", "g_IsCalibrated"): lambda task: _hand(task).calibrated,
    ("Hand_IsCamConnected",): lambda _task: False,
    ("Hand_GetActualPos", "g_GetPos"): lambda task: single(round(_hand(task).position, 1)),
    ("Hand_GetActualSpd", "Hand_GetActualSpeed", "g_GetSpd"): (
        lambda task: single(round(_hand(task).speed, 1))
    ),
    ("Hand_GetFingerState",): lambda task: int(_hand(task).state),
    ("Hand_GetFingerErrID",): lambda _task: 0,
    ("Hand_TurnOnVacuum1", "g_VacuumOn1"): _vacuum_on(0),
    ("Hand_TurnOnVacuum2", "g_VacuumOn2"): _vacuum_on(1),
    ("Hand_TurnOffVacuum1", "g_VacuumOff1"): _off("vacuum", 0),
    ("Hand_TurnOffVacuum2", "g_VacuumOff2"): _off("vacuum", 1),
    ("Hand_TurnOnBlow1", "g_BlowOn1"): _blow_on(0),
    ("Hand_TurnOnBlow2", "g_BlowOn2"): _blow_on(1),
    ("Hand_TurnOffBlow1", "g_BlowOff1"): _off("blow", 0),
    ("Hand_TurnOffBlow2", "g_BlowOff2"): _off("blow", 1),
    ("Hand_GetVacuumPressure1", "g_GetPressure1"): _pressure(0),
    ("Hand_GetVacuumPressure2", "g_GetPressure2"): _pressure(1),
}
builtins({name: call for names, call in _CALLS.items() for name in names})
