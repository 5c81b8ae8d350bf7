"""Controller events: stops, modes, power, missing signals, mixed builds."""

from dataclasses import replace
from functools import partial

from rapidgen.generate.layout import open_signals, signal_name
from rapidgen.generate.status import STATUS_SIGNALS
from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawMode, RawReason, RawTrajectoryState, RawTriState
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.raw_connection import STOP, RawLink
from rapidgen.verification.testbench import Bench, with_module

case = SuiteGroup("controller")


def _back_to_work(bench: Bench) -> None:
    bench.start_again()
    bench.run(1)


def _interrupted(bench: Bench, action: str, *, pp_to_main: bool = False) -> None:
    """Check that after `action` the old path is gone and a new one works."""
    for delay in (0.05, 0.7):
        state, link = bench.state(), bench.motion()
        points = bench.wave(10)
        since = bench.now
        bench.start_motion(link, points, delay)
        bench.controller.perform(action)
        bench.wait_until_standing(10)
        bench.followed([p for p, _ in points], since=since)
        bench.assert_at_rest(2, f"{action}")
        if pp_to_main:
            bench.controller.perform("pp-to-main")
            bench.run(0.5)
        _back_to_work(bench)
        bench.assert_at_rest(
            5, f"the program was started again after {action}, no client asked for motion"
        )
        if action != "power-loss":
            status = bench.status(state)
            if status.motion_possible != 1:
                raise CheckFailed(
                    f"STATUS says that no motion is possible after {action}: {status}"
                )
        link.close()
        state.close(then=1.5)
        link = bench.motion()
        bench.assert_moves_through(link, bench.wave(3))
        link.close(then=1.5)


@case("not-executing", "what comes while nothing executes is refused", "R7a", background=True)
def _refused_while_not_executing(bench: Bench) -> None:
    for action, reasons in (
        ("stop", (RawReason.NOT_EXECUTING,)),
        ("motors-off", (RawReason.MOTORS_OFF, RawReason.NOT_EXECUTING)),
        ("e-stop", (RawReason.EMERGENCY_STOP, RawReason.MOTORS_OFF)),
    ):
        state, link = bench.watcher(), bench.motion()
        bench.controller.perform(action)
        bench.run(1)
        link.send(bench.download(bench.wave(4)))
        bench.assert_at_rest(5, f"the controller is in {action}")
        status, reply = bench.status(state), bench.progress(state)
        if (reply.state, reply.point, reply.joint) != (RawTrajectoryState.REFUSED, -1, 0):
            raise CheckFailed(
                f"after {action} a trajectory is refused for no point, PROGRESS: {reply}"
            )
        reason, _ = messages.split_error_code(status.error_code)
        if status.in_error != 1 or reason not in reasons:
            raise CheckFailed(f"after {action} a trajectory is answered by {status}")
        if status.motion_possible != 0:
            raise CheckFailed(f"after {action} STATUS says that motion is possible")
        _back_to_work(bench)
        bench.assert_at_rest(5, "what came while nothing was executing is not kept")
        bench.assert_moves_through(link, bench.wave(3))
        link.close()
        state.close(then=1.5)


@case("e-stop-status", "STATUS shows an emergency stop", "R15", background=True)
def _e_stop_shows(bench: Bench) -> None:
    state = bench.state()
    bench.controller.perform("e-stop")
    bench.run(0.5)
    status = bench.status(state)
    if (status.e_stopped, status.drives_powered, status.motion_possible) != (1, 0, 0):
        raise CheckFailed(f"during an emergency stop STATUS says {status}")
    _back_to_work(bench)
    status = bench.status(state)
    if (status.e_stopped, status.drives_powered, status.motion_possible) != (0, 1, 1):
        raise CheckFailed(f"after an emergency stop STATUS says {status}")


@case("manual-status", "STATUS shows manual mode", background=True)
def _manual_mode_shows(bench: Bench) -> None:
    state = bench.state()
    bench.controller.perform("manual")
    bench.run(0.5)
    if bench.status(state).mode != RawMode.MANUAL:
        raise CheckFailed("in manual mode STATUS does not say so")


@case("pp-to-main", "PP to main leaves nothing taken", "R7a")
def _pp_to_main_idle(bench: Bench) -> None:
    for _ in range(3):
        bench.controller.perform("stop")
        bench.run(0.3)
        bench.controller.perform("pp-to-main")
        bench.run(0.3)
        bench.controller.perform("start")
        bench.run(1)
        link = bench.motion()
        bench.assert_moves_through(link, bench.wave(3))
        link.close(then=1.5)


@case("without-signals", "missing signals are not fatal", "R15")
def _without_signals(bench: Bench) -> None:
    bare = replace(bench.system, signals=(), outputs=(), cross=())
    with bench.second_controller(bare) as other:
        state, link = other.state(), other.motion()
        status = other.status(state)
        if status.drives_powered != RawTriState.UNKNOWN:
            raise CheckFailed(f"without signals STATUS says {status}")
        other.assert_moves_through(link, other.wave(4))


@case("open-files", "signals that the controller refused, or that nothing drives")
def _open_files(bench: Bench) -> None:
    """Remove status signals of unconfirmed names, or their outputs."""
    opened = open_signals(bench.config) | {_name(bench, "standing")}
    # Signals that are unconfirmed on RobotWare 7 are optional for the driver on all versions.
    absent = opened | {_name(bench, function) for function in ("executing", "emergency_stop")}
    for without, undriven in ((absent, absent), (frozenset(), opened)):
        signals = tuple(s for s in bench.system.signals if s.name not in without)
        outputs = tuple(o for o in bench.system.outputs if o.signal not in undriven)
        with bench.second_controller(
            replace(bench.system, signals=signals, outputs=outputs)
        ) as other:
            _serves_and_stops(other)


def _serves_and_stops(bench: Bench) -> None:
    """Execute a trajectory, stop another one; STATUS reports both ends."""
    state, link, period = bench.state(), bench.motion(), bench.config.state_period
    bench.run(2 * period)
    bench.assert_moves_through(link, bench.wave(4))
    _is_over(bench, state, "a trajectory has arrived")
    points, since = bench.wave(10), bench.now
    bench.start_motion(link, points, 0.5)
    if bench.status(state, 2 + period).in_motion != 1:
        raise CheckFailed("a trajectory is under way, STATUS says that nothing moves")
    link.send(STOP)
    bench.wait_until_at_rest(5, 1, "STOP was sent")
    bench.followed([p for p, _ in points], since=since)
    _is_over(bench, state, "STOP has ended a trajectory")
    _stopped_meanwhile(bench, link)
    bench.start_motion(bench.motion(), bench.wave(10), 0.3)
    bench.controller.perform("e-stop")
    bench.wait_until_at_rest(10, 2, "an emergency stop")
    _back_to_work(bench)
    bench.assert_at_rest(5, "the program was started again, no client asked for motion")
    bench.assert_moves_through(bench.motion(), bench.wave(3))


def _stopped_meanwhile(bench: Bench, link: RawLink) -> None:
    """Send from two clients while the program is stopped: no effect later."""
    if bench.config.commissioning:
        return
    bench.controller.perform("stop")
    bench.run(0.5)
    data = bench.download(bench.wave(4))
    link.send(data)
    other = bench.motion()
    other.send(data)
    bench.assert_at_rest(2, "the program is stopped")
    bench.controller.perform("start")
    bench.assert_at_rest(4, "the program was started; what was sent before is nothing")
    other.close(then=1.5)


def _is_over(bench: Bench, state: RawLink, what: str) -> None:
    bench.run(bench.setting.motion.settle + 2.5 * bench.config.state_period)
    status = bench.status(state, 2 + bench.config.state_period)
    if status.in_motion != 0:
        raise CheckFailed(f"{what}, STATUS says {status}")


@case("standing-forgotten", "a signal that says for ever that the robot moves")
def _standing_forgotten(bench: Bench) -> None:
    """Hold the standstill signal: STATUS believes it for a limited time.

    The limit is ten seconds or five messages.
    """
    state, period = bench.state(), bench.config.state_period
    bench.run(2 * period)
    bench.controller.signals[_name(bench, "standing")] = 0
    bench.run(1.5 * period)
    if bench.status(state, 2 + period).in_motion != 1:
        raise CheckFailed("the controller says that the robot moves, STATUS does not")
    bench.run(max(10, 5 * period))
    _is_over(bench, state, "no axis has moved for ten seconds")
    bench.controller.signals[_name(bench, "standing")] = 1


def _name(bench: Bench, function: str) -> str:
    (result,) = (s for s in STATUS_SIGNALS if s.function == function)
    return signal_name(bench.config, bench.group, result)


@case("mixed-builds", "modules of different builds refuse to move", once=True)
def _mixed_builds(bench: Bench) -> None:
    build = bench.system.build_id.encode()
    files = {
        module.path: module.data
        for task in bench.system.tasks
        for module in task.modules
        if task.mechanical_unit_group == bench.mechanical_unit and build in module.data
    }
    for path, data in sorted(files.items()):
        mixed = with_module(bench.system, path, data.replace(build, b"0123456789ab"))
        with bench.second_controller(mixed) as other:
            state, link = other.watcher(), other.motion()
            other.run(0.5)
            frames = other.download(other.wave(4))
            link.send(frames[:68])
            other.run(0.5)
            reply = other.progress(state)
            if (reply.state, reply.reason, reply.point, reply.joint) != (
                RawTrajectoryState.REFUSED, RawReason.BUILD_MISMATCH, -1, 0
            ):  # fmt: skip
                raise CheckFailed(f"{path} is of another build, PROGRESS says {reply}")
            link.send(frames[68:])
            other.assert_at_rest(3, f"{path} is of another build")
            status = other.status(state)
            if status.motion_possible != 0:
                raise CheckFailed(
                    f"with {path} of another build STATUS says that motion is possible"
                )


@case("no-task-ends", "no task ends by itself", "R3")
def _no_task_ends(bench: Bench) -> None:
    state, link = bench.state(), bench.motion()
    bench.assert_moves_through(link, bench.wave(4))
    bench.status(state)
    bench.run(60)
    finished = [name for name, task in bench.controller.tasks.items() if task.state != "running"]
    if finished:
        raise CheckFailed(f"tasks that ended by themselves: {', '.join(finished)}")


case("e-stop", "nothing resumes after an emergency stop")(partial(_interrupted, action="e-stop"))
case("program-stop", "nothing resumes after a program stop", "R7a")(
    partial(_interrupted, action="stop")
)
case("stop-pp-to-main", "nothing resumes after a stop and PP to main", "R7a", background=True)(
    partial(_interrupted, action="stop", pp_to_main=True)
)
case("motors-off", "nothing resumes after motors off")(partial(_interrupted, action="motors-off"))
case("manual-mode", "nothing resumes after a change of mode")(
    partial(_interrupted, action="manual")
)
case("power-loss", "nothing resumes after a power failure")(
    partial(_interrupted, action="power-loss")
)


@case("power-loss-after-stop", "Start works after a power failure after another stop", "R7a")
def _power_loss_after_stop(bench: Bench) -> None:
    """Interrupt a halt by a power failure: it ends after Start.

    PP to main is not needed.
    """
    for action in ("stop", "manual", "e-stop", "power-loss"):
        bench.start_motion(bench.motion(), bench.wave(8), 0.6)
        bench.controller.perform(action)
        bench.run(0.1)
        bench.controller.perform("power-loss")
        bench.wait_until_standing(10)
        _back_to_work(bench)
        bench.assert_at_rest(3, f"{action}, a power failure and Start")
        bench.assert_moves_through(bench.motion(), bench.wave(3))
