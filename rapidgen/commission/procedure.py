"""The procedure of commissioning: each stage announces, asks, moves, measures and compares.

Rules that hold in every stage:

1. Nothing moves before `Operator.announce` has described it and a question was answered with yes.
2. Every motion starts where the stage before left the robot. If the robot stands elsewhere, it has
   moved by itself, and the procedure ends.
3. The first failed step ends the procedure. Nothing moves after it, so the robot is not brought
   back to where it stood at the beginning.
4. Interruption (Ctrl-C, cancellation) stops the robot, as in every call of the client.

A second connection that only reads observes the robot where the first one is the subject of the
measurement: STOP, a lost connection, the emergency stop.
"""

import asyncio
import math
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass, field, replace

from rapidgen.client import AsyncRobot, Result, RobotError, State, Timeouts, Trajectory
from rapidgen.commission.announcement import move_drawing, move_text
from rapidgen.commission.checklist import Checklist, End, Step, Verdict
from rapidgen.commission.controller_view import ControllerView
from rapidgen.commission.map_faults import (
    AXIS_TOLERANCE,
    PoseSample,
    alike,
    compare_axes,
    explain_poses,
    figure,
)
from rapidgen.commission.operator import AGAIN, YES, Operator, Question
from rapidgen.commission.stop_measurement import StopFigures, Watcher, watching
from rapidgen.config.model import GroupConfig, Joint
from rapidgen.diagnostics import DiagnosticError, refusal
from rapidgen.wire.simple_message.spec import Mode, TriState

_SETTLE = 0.6
"""s after a motion in which the driver's joint messages reach the last position."""
_REPEATS = 5
"""How often an operator may look at the move of one joint."""
_CABLE_SHARE = 0.5
"""Share of the speed at which a driver that waits for a heartbeat stops before the end."""
_EMERGENCY_SHARE = 0.25
"""Share of the speed that gives a person time to press the emergency stop during the move."""


@dataclass(frozen=True, slots=True)
class Settings:
    """Sizes and speeds of the moves: rad, rad/s, m, m/s, and times in s."""

    step: float = math.radians(2)
    step_linear: float = 0.005
    rate: float = math.radians(2)
    rate_linear: float = 0.005
    way: float = math.radians(8)
    """Of the motions that are stopped."""
    way_linear: float = 0.04
    fast: float = math.radians(4)
    """Speed of the motions that are stopped."""
    fast_linear: float = 0.02
    reaction: float = 0.3
    """s in which a controller has to react to STOP, beyond its braking."""
    heartbeat: float = Timeouts().heartbeat
    """s without a message of the client after which the driver has to stop."""
    operator_timeout: float = 300.0
    """s for which the operator's acts at the pendant are awaited."""
    watch: float = 3.0
    """s for which a robot that must not move is watched."""
    emergency: bool = True


@dataclass
class Commissioning:
    """One run: what is commissioned, by whom, and the checklist so far.

    `connect` makes a client; with True it only reads. `build_id` is that of the configuration,
    `view` the controller's own view of the robot, None without Robot Web Services. `changed` is
    called with every new state of the checklist.
    """

    config: GroupConfig
    connect: Callable[[bool], AsyncRobot]
    operator: Operator
    checklist: Checklist
    build_id: str
    view: ControllerView | None = None
    settings: Settings = field(default_factory=Settings)
    changed: Callable[[Checklist], None] = lambda _: None
    start: tuple[float, ...] = ()
    speed: int | None = None
    """Speed override at the beginning, percent; None: unknown."""
    samples: list[PoseSample] = field(default_factory=list)

    def add(self, step: Step) -> None:
        """Add a step to the checklist."""
        self.checklist = self.checklist.with_step(step)
        self.changed(self.checklist)

    def doubt(self, name: str, title: str, found: DiagnosticError) -> None:
        """Add a failed step."""
        first = found.diagnostics[0]
        self.add(Step(name, title, "fail", first.message, first.help, first.code))


Stage = Callable[[Commissioning, AsyncRobot], Awaitable[None]]


async def run(job: Commissioning) -> Checklist:
    """Run all stages and return the checklist; a failed step ends the run.

    Cancellation stops the robot, ends the checklist as interrupted and is raised again.
    """
    stages: list[tuple[str, str, Stage]] = [
        ("preconditions", "Preconditions", _preconditions),
        ("identity", "Identity", _identity),
        ("values", "Joint values and zero", _values),
        ("direction", "Direction of each joint", _directions),
        ("model", "Robot and URDF", _model),
        ("stop", "STOP during a slow move", _stop),
        ("cable", "Lost connection during a slow move", _cable),
        ("emergency", "Emergency stop during a slow move", _emergency),
        ("restored", "State before the procedure restored", _restored),
    ]
    end: End = "failed"
    name, title = stages[0][:2]
    robot: AsyncRobot | None = None
    try:
        for stage_name, stage_title, stage in stages:
            name, title = stage_name, stage_title
            if robot is None or not robot.is_connected:
                robot = await job.connect(False).connect()
            await stage(job, robot)
            if job.checklist.failures:
                break
        else:
            end = "complete"
    except DiagnosticError as found:
        job.doubt(name, title, found)
    except asyncio.CancelledError:
        end = "interrupted"
        job.add(Step(name, title, "fail", "interrupted by the user", "begin anew", "RG689"))
        raise
    finally:
        job.checklist = replace(job.checklist, end=end)
        if robot is not None and robot.is_connected:
            await robot.close()
        job.changed(job.checklist)
    return job.checklist


# -- what all stages use ------------------------------------------------------------------------


def _failed(code: str, message: str, help: str) -> DiagnosticError:
    return refusal(code, None, message, help, exit_code=1)


async def _agree(job: Commissioning, name: str, text: str, code: str, reason: str) -> None:
    """Ask a question. Raises DiagnosticError for every answer but yes."""
    answer = await job.operator.ask(Question(name, text))
    if answer != YES:
        raise _failed(code, reason, "nothing moves: change this, then begin anew")


def _amounts(job: Commissioning, joint: Joint) -> tuple[float, float, float, float]:
    """Return step and rate of a small move, way and speed of a longer one."""
    s = job.settings
    if joint.kind == "revolute":
        return s.step, s.rate, s.way, s.fast
    return s.step_linear, s.rate_linear, s.way_linear, s.fast_linear


def _shifted(job: Commissioning, robot: AsyncRobot, index: int, step: float) -> tuple[float, ...]:
    """Return the start with one joint moved by a step, towards the middle of its range.

    Raises DiagnosticError RG684 if the step leaves the range.
    """
    group = robot.group
    joint = group.joints[index]
    at = group.map.to_controller(job.start)[index]
    sign = 1 if at <= (joint.lower + joint.upper) / 2 else -1
    goal = list(job.start)
    # A step of the URDF joint: with a negative sign of the map the axis turns the other way.
    goal[index] += sign * joint.sign * step
    for axis, value in zip(group.joints, group.map.to_controller(goal), strict=True):
        if not axis.lower <= value <= axis.upper:
            raise _failed(
                "RG684",
                f"{joint.name} cannot move by {figure(joint, step)}: {axis.axis} would leave its "
                "range",
                "jog the robot to the middle of its range, then begin anew",
            )
    return tuple(goal)


def _require_start(job: Commissioning, robot: AsyncRobot) -> None:
    """Raise DiagnosticError RG689 if the robot is not where the stage before left it."""
    for joint, value, at in zip(robot.group.joints, robot.state.joints, job.start, strict=True):
        if abs(value - at) > 4 * AXIS_TOLERANCE[joint.kind]:
            raise _failed(
                "RG689",
                f"{joint.name} is at {figure(joint, value)}, the last motion ended at "
                f"{figure(joint, at)}: the robot was moved",
                "find out what moves the robot, then begin anew",
            )


async def _begin(robot: AsyncRobot, goal: Sequence[float], rate: float) -> Awaitable[Result]:
    """Start a move from the present position; return the wait for its end."""
    here = robot.state.joints
    longest = max(abs(b - a) for a, b in zip(here, goal, strict=True))
    seconds = max(longest / rate, 0.5)
    path = Trajectory.from_points([here, goal], seconds=seconds, names=robot.group.names)
    execution = await robot.execute(path)
    return execution.result()


async def _at_rest(robot: AsyncRobot) -> State:
    """Return the state when the robot has settled."""
    end = asyncio.get_running_loop().time() + _SETTLE
    state = robot.state
    while asyncio.get_running_loop().time() < end:
        state = await robot.next_state()
    return state


async def _return(job: Commissioning, robot: AsyncRobot, rate: float) -> None:
    """Move back to the start of the procedure."""
    await (await _begin(robot, job.start, rate))
    await _at_rest(robot)
    _require_start(job, robot)


def _ok(job: Commissioning) -> Verdict:
    """Return the verdict of a step that rests on the operator alone."""
    return "assumed" if job.operator.assumed else "ok"


async def _compare(job: Commissioning, robot: AsyncRobot) -> float:
    """Compare the driver's axes with the controller's own; return the largest difference, rad.

    Raises DiagnosticError RG686 and RG687.
    """
    assert job.view is not None
    driver = robot.group.map.to_controller((await _at_rest(robot)).joints)
    own = await job.view.axes()
    faults = compare_axes(robot.group.joints, driver, own)
    if faults:
        code = "RG687" if faults[0].kind == "zero" else "RG686"
        raise _failed(code, faults[0].text, faults[0].help)
    job.samples.append(PoseSample(tuple(own), await job.view.flange()))
    differences = zip(robot.group.joints, driver, own, strict=True)
    return max((abs(a - b) for j, a, b in differences if j.kind == "revolute"), default=0.0)


# -- stages without motion ----------------------------------------------------------------------


async def _preconditions(job: Commissioning, robot: AsyncRobot) -> None:
    status = robot.state.status
    mode = "unknown"
    if job.view is not None:
        panel = await job.view.panel()
        mode, job.speed = panel.mode, panel.speed
        job.checklist = replace(job.checklist, robotware=panel.robotware)
    manual = status.mode is Mode.MANUAL and mode in ("MANR", "unknown")
    if not (manual or job.checklist.simulated):
        shown = mode if mode != "unknown" else status.mode.name.lower()
        raise _failed(
            "RG684",
            f"the controller is not in manual mode with reduced speed: {shown}",
            "turn the mode switch to manual reduced speed, start the program from the pendant",
        )
    if status.e_stopped is TriState.TRUE or status.in_error is TriState.TRUE:
        raise _failed("RG684", f"the robot is not ready: {status}", "acknowledge it, begin anew")
    if status.motion_possible is not TriState.TRUE:
        raise _failed(
            "RG684",
            f"no motion is possible: {status}",
            "hold the enabling device, start the program from the pendant, begin anew",
        )
    if job.config.chain:
        same = alike(job.config, robot.group.map.to_controller(robot.state.joints))
        if same is not None:
            raise _failed(
                "RG684",
                f"{same[0]} and {same[1]} turn about the same line here: the operator cannot tell "
                "which of them moves",
                "jog the joint between them by 30 deg, then begin anew",
            )
    reason = "the operator has not confirmed the preconditions"
    text = (
        "Manual mode with reduced speed; an operator holds the enabling device at the pendant and "
        "can reach the emergency stop; no other person is near the robot; nothing is within "
        "0.2 m of it. Is all of this so?"
    )
    await _agree(job, "area", text, "RG684", reason)
    job.start = robot.state.joints
    shown = f"{status}; operator at the pendant, area clear"
    job.add(Step("preconditions", "Preconditions", _ok(job), shown))


async def _identity(job: Commissioning, robot: AsyncRobot) -> None:
    hello = robot.driver.hello
    if hello is None:
        raise _failed(
            "RG685", "the driver is not one of rapidgen", "`rapidgen deploy` installs the driver"
        )
    job.checklist = replace(job.checklist, driver=robot.driver.version, build_id=hello.build_id)
    if hello.build_id != job.build_id:
        raise _failed(
            "RG685",
            f"build {hello.build_id} runs, the configuration gives {job.build_id}",
            "`rapidgen deploy` with this configuration, or commission with the deployed one",
        )
    joints = ", ".join(f"{j.name}={j.axis}" for j in robot.group.joints)
    found = f"build {hello.build_id}, driver {robot.driver.version}, {joints}"
    if robot.driver.control_fault:
        raise _failed(
            "RG685",
            f"the control port cannot be used: {robot.driver.control_fault}",
            "STOP would wait behind points: free the port, or look at the firewall",
        )
    job.add(Step("identity", "Identity", "ok", found))


async def _values(job: Commissioning, robot: AsyncRobot) -> None:
    joints = robot.group.joints
    driver = robot.group.map.to_controller(job.start)
    listed = ", ".join(f"{j.axis} {figure(j, v)}" for j, v in zip(joints, driver, strict=True))
    if job.view is not None:
        most = await _compare(job, robot)
        found = f"the controller's own values agree with the driver's: {listed}"
        figures = {"largest_difference_deg": round(math.degrees(most), 4)}
        job.add(Step("values", "Joint values", "ok", found, figures=figures))
    else:
        text = f"Does the pendant's Jogging window show the same values? {listed}"
        await _agree(
            job, "pendant", text, "RG687", "the pendant shows other joint values than the driver"
        )
        job.add(Step("values", "Joint values", _ok(job), f"as on the pendant: {listed}"))
    text = (
        "Are the revolution counters up to date, so that at 0 on the pendant the calibration marks "
        "of every axis are aligned? (Jog each axis there before, if in doubt.)"
    )
    await _agree(
        job, "marks", text, "RG687", "the zero is in doubt: the calibration marks do not agree"
    )
    job.add(Step("marks", "Calibration marks", _ok(job), "the marks are aligned at 0"))


# -- single joints ------------------------------------------------------------------------------


async def _directions(job: Commissioning, robot: AsyncRobot) -> None:
    for index, joint in enumerate(robot.group.joints):
        await _direction(job, robot, index, joint)


async def _direction(job: Commissioning, robot: AsyncRobot, index: int, joint: Joint) -> None:
    step, rate, _, _ = _amounts(job, joint)
    goal = _shifted(job, robot, index, step)
    group = robot.group
    before, after = (tuple(group.map.to_controller(values)) for values in (job.start, goal))
    drawing = {joint.name: move_drawing(job.config, before, after)}
    job.checklist = replace(job.checklist, drawings={**job.checklist.drawings, **drawing})
    text = move_text(job.config, index, before, after)
    names = [name for name in group.names if name != joint.name]
    question = Question(
        f"direction.{joint.name}",
        f"Did {joint.name} move as announced? If another joint moved, answer with its name.",
        (YES, "opposite", "nothing", AGAIN, *names),
    )
    for _ in range(_REPEATS):
        job.operator.announce(text)
        await _agree(job, f"move.{joint.name}", "Move now?", "RG689", f"no move of {joint.name}")
        _require_start(job, robot)
        result = await (await _begin(robot, goal, rate))
        state = await _at_rest(robot)
        _check_only(robot, index, job.start, goal, state)
        if job.view is not None:
            await _compare(job, robot)
        await _return(job, robot, rate)
        answer = await job.operator.ask(question)
        if answer != AGAIN:
            break
    if answer != YES:
        raise _wrong_direction(joint, answer)
    figures = {
        f"moved_{_unit(joint)}": _shown(joint, state.joints[index] - job.start[index]),
        "planned_s": round(result.planned_seconds, 3),
        "took_s": round(result.seconds, 3),
    }
    title = f"Direction of {joint.name}"
    job.add(Step(f"direction.{joint.name}", title, _ok(job), text, figures=figures))


def _wrong_direction(joint: Joint, answer: str) -> DiagnosticError:
    if answer == AGAIN:
        return _failed(
            "RG689", f"the direction of {joint.name} was not decided", "look closer, begin anew"
        )
    if answer == "opposite":
        return _failed(
            "RG686",
            f"{joint.name} turns against the announced direction: its sign is wrong",
            f"set `joints: {{{joint.name}: {{sign: {-joint.sign}}}}}`, build, deploy, begin anew",
        )
    if answer == "nothing":
        return _failed(
            "RG686",
            f"{joint.name} was commanded and nothing moved, though {joint.axis} reports the move",
            "is this the robot of the configuration, and not a simulation?",
        )
    return _failed(
        "RG686",
        f"{answer} moved instead of {joint.name}: the axes of these joints are swapped",
        f"exchange the axes of {joint.name} and {answer} under `joints`, build, deploy, begin anew",
    )


def _check_only(
    robot: AsyncRobot, index: int, start: Sequence[float], goal: Sequence[float], state: State
) -> None:
    """Raise DiagnosticError RG686 if another joint has moved, or this one elsewhere."""
    for k, joint in enumerate(robot.group.joints):
        wanted = goal[k]
        if abs(state.joints[k] - wanted) > 4 * AXIS_TOLERANCE[joint.kind]:
            moved = figure(joint, state.joints[k] - start[k])
            expected = figure(joint, wanted - start[k])
            raise _failed(
                "RG686",
                f"{joint.name} moved by {moved}, commanded were {expected}, when "
                f"{robot.group.joints[index].name} was moved",
                "compare the joint map and `coupling` with the robot",
            )


def _unit(joint: Joint) -> str:
    return "deg" if joint.kind == "revolute" else "mm"


def _shown(joint: Joint, value: float) -> float:
    return round(math.degrees(value) if joint.kind == "revolute" else value * 1000, 4)


async def _model(job: Commissioning, robot: AsyncRobot) -> None:
    """Compare the controller's poses of its flange with those of the URDF."""
    title = "Robot and URDF"
    if job.view is None or not job.config.chain:
        lacking = "no Robot Web Services" if job.view is None else "no URDF"
        job.add(Step("model", title, "skipped", f"the poses cannot be compared: {lacking}"))
        return
    fault = explain_poses(job.config, job.samples)
    if fault is None:
        found = f"{len(job.samples)} poses of the flange are those of the URDF"
        job.add(Step("model", title, "ok", found))
        return
    code = "RG687" if fault.kind in ("zero", "base") else "RG686"
    raise _failed(code, fault.text, fault.help)


# -- stops --------------------------------------------------------------------------------------


def _longest(job: Commissioning, robot: AsyncRobot) -> int:
    """Return the joint for the stops: the first one with room for the way."""
    for index, joint in enumerate(robot.group.joints):
        at = robot.group.map.to_controller(job.start)[index]
        if max(at - joint.lower, joint.upper - at) > _amounts(job, joint)[2]:
            return index
    raise _failed("RG684", "no joint has room for the stops", "jog the robot to its middle")


async def _start_slow(
    job: Commissioning,
    robot: AsyncRobot,
    watcher: Watcher,
    what: str,
    kind: str,
    *,
    share: float = 1.0,
) -> tuple[int, "asyncio.Future[Result]"]:
    """Announce and start a slow move; return its joint and its end, after a quarter of the way.

    `share` is that of the speed of stopped motions.
    """
    index = _longest(job, robot)
    joint = robot.group.joints[index]
    _, _, way, fast = _amounts(job, joint)
    rate = share * fast
    goal = _shifted(job, robot, index, way)
    job.operator.announce(
        f"{joint.name} moves by up to {figure(joint, way)} at {figure(joint, rate)}/s; {what}"
    )
    await _agree(job, kind, "Move now?", "RG689", f"no move for '{kind}'")
    _require_start(job, robot)
    end = asyncio.ensure_future(await _begin(robot, goal, rate))
    while abs(watcher.joints[index] - job.start[index]) < way / 4 and not end.done():
        await watcher.robot.next_state()
    return index, end


async def _finished(end: "asyncio.Future[Result]") -> None:
    """Wait for a motion that was stopped; its error is the purpose."""
    try:
        await end
    except RobotError:
        return


async def _rest_after(job: Commissioning, watcher: Watcher) -> None:
    await asyncio.sleep(_SETTLE + 2 * job.settings.reaction)


def _judge(
    job: Commissioning, name: str, title: str, joint: Joint, stop: StopFigures, allowed: float
) -> None:
    """Add the figures of a stop. Raises DiagnosticError RG688 for a late one."""
    seconds, way = stop.limits(joint, allowed)
    predicted = stop.predicted(joint)
    unit = _unit(joint)
    figures = {
        f"speed_{unit}_s": _shown(joint, stop.speed),
        "stop_time_s": round(stop.seconds, 3),
        f"stop_way_{unit}": _shown(joint, stop.way),
        "predicted_braking_s": round(predicted[0], 3),
        f"predicted_braking_{unit}": _shown(joint, predicted[1]),
        "limit_s": round(seconds, 3),
        f"limit_{unit}": _shown(joint, way),
        "resolution_s": round(stop.period, 3),
    }
    found = (
        f"{joint.name} at {figure(joint, stop.speed)}/s stands after {stop.seconds:.2f} s and "
        f"{figure(joint, stop.way)}"
    )
    if stop.seconds > seconds or stop.way > way:
        help = "look at the network, the load of the controller and the time-out of `control`"
        limit = f"allowed are {seconds:.2f} s and {figure(joint, way)}"
        job.add(Step(name, title, "fail", f"{found}: late, {limit}", help, "RG688", figures))
        return
    job.add(Step(name, title, "ok", found, figures=figures))


async def _stop(job: Commissioning, robot: AsyncRobot) -> None:
    title = "STOP during a slow move"
    async with watching(job.connect(True)) as watcher:
        index, end = await _start_slow(job, robot, watcher, "rapidgen sends STOP", "stop")
        since = asyncio.get_running_loop().time()
        await robot.stop()
        await _finished(end)
        await _rest_after(job, watcher)
        joint = robot.group.joints[index]
        stop = watcher.measured(since, index, joint.kind)
    _judge(job, "stop", title, joint, stop, job.settings.reaction)
    if not job.checklist.failures:
        await _come_back(job, robot, index)


async def _come_back(job: Commissioning, robot: AsyncRobot, index: int) -> None:
    """Announce and make the way back after a stop."""
    joint = robot.group.joints[index]
    rate = _amounts(job, joint)[3]
    job.operator.announce(f"{joint.name} returns to {figure(joint, job.start[index])}")
    await _agree(job, "return", "Move now?", "RG689", "no way back")
    await _return(job, robot, rate)


async def _cable(job: Commissioning, robot: AsyncRobot) -> None:
    title = "Lost connection during a slow move"
    async with watching(job.connect(True)) as watcher:
        what = "rapidgen closes its connections, as if the cable were pulled"
        index, end = await _start_slow(job, robot, watcher, what, "cable", share=_CABLE_SHARE)
        since = asyncio.get_running_loop().time()
        await robot.drop_connections()
        await _finished(end)
        await asyncio.sleep(job.settings.heartbeat)
        await _rest_after(job, watcher)
        joint = robot.group.joints[index]
        stop = watcher.measured(since, index, joint.kind)
        again = await robot.connect()
        connected = asyncio.get_running_loop().time()
        await _watch_still(job, watcher, connected, "after the connection was opened again")
    allowed = job.settings.reaction + job.settings.heartbeat
    _judge(job, "cable", title, joint, stop, allowed)
    if not job.checklist.failures:
        await _come_back(job, again, index)


async def _watch_still(job: Commissioning, watcher: Watcher, since: float, when: str) -> None:
    """Watch a robot that has no order. Raises DiagnosticError RG688 if it moves."""
    await asyncio.sleep(job.settings.watch)
    moved = watcher.most_moved(since)
    if moved > 4 * AXIS_TOLERANCE["revolute"]:
        raise _failed(
            "RG688",
            f"the robot moved by itself {when}, by {math.degrees(moved):.2f} deg",
            "keep the emergency stop pressed; look for another program that moves the robot",
        )


async def _emergency(job: Commissioning, robot: AsyncRobot) -> None:
    title = "Emergency stop during a slow move"
    if not job.settings.emergency:
        job.add(Step("emergency", title, "skipped", "skipped on request"))
        return
    async with watching(job.connect(True)) as watcher:
        what = "PRESS THE EMERGENCY STOP while it moves"
        index, end = await _start_slow(
            job, robot, watcher, what, "emergency", share=_EMERGENCY_SHARE
        )
        await _finished(end)
        joint = robot.group.joints[index]
        pressed = [s for s in watcher.states if s.status.e_stopped is TriState.TRUE]
        if not pressed:
            await _at_rest(robot)
            pressed = [s for s in watcher.states if s.status.e_stopped is TriState.TRUE]
        if not pressed:
            raise _failed(
                "RG688",
                "the emergency stop was not seen while the robot moved",
                "begin anew and press it during the move; if it was pressed, look at its wiring",
            )
        await asyncio.sleep(_SETTLE)
        stop = watcher.measured(pressed[0].time, index, joint.kind)
        _judge(job, "emergency", title, joint, stop, job.settings.reaction)
        if job.checklist.failures:
            return
        await _reset(job, watcher)
    await _come_back(job, robot, index)


async def _reset(job: Commissioning, watcher: Watcher) -> None:
    """Wait until the operator has reset the emergency stop; nothing may move by itself."""
    limit, robot = job.settings.operator_timeout, watcher.robot
    begin = asyncio.get_running_loop().time()
    await _agree(
        job, "reset", "Release the emergency stop. Released?", "RG689", "it was not released"
    )
    await robot.wait_until(lambda s: s.status.e_stopped is not TriState.TRUE, limit)
    await _watch_still(job, watcher, begin, "after the emergency stop was released")
    text = "Switch the motors on and start the program from the pendant. Started?"
    await _agree(job, "restart", text, "RG689", "the program was not started")
    await robot.wait_until(lambda s: s.status.motion_possible is TriState.TRUE, limit)
    await _watch_still(job, watcher, begin, "after the program was started")
    found = "reset and started again; the robot did not move by itself"
    job.add(Step("reset", "Reset after the emergency stop", "ok", found))


# -- the end ------------------------------------------------------------------------------------


async def _restored(job: Commissioning, robot: AsyncRobot) -> None:
    await _at_rest(robot)
    _require_start(job, robot)
    joints = zip(robot.group.joints, robot.state.joints, job.start, strict=True)
    figures: dict[str, float] = {}
    for joint, value, at in joints:
        key = f"largest_difference_{_unit(joint)}"
        figures[key] = max(figures.get(key, 0.0), _shown(joint, abs(value - at)))
    found = "the robot stands where it stood"
    if job.view is not None:
        speed = (await job.view.panel()).speed
        if speed != job.speed:
            raise _failed(
                "RG689",
                f"the speed override is {speed} %, it was {job.speed} %",
                "set it again at the pendant",
            )
        found += f"; speed override {speed} %, as before"
    job.add(Step("restored", "State before the procedure", "ok", found, figures=figures))
