"""The driver in a user program: its main calls ROS_run, which returns."""

from dataclasses import replace

from rapidgen.controller.cell import in_its_cell
from rapidgen.generate import build, make_system
from rapidgen.system.model import ModuleFile, SignalSpec, System
from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import fails
from rapidgen.verification.messages import RawReason
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.position_checks import distance
from rapidgen.verification.raw_connection import RawLink
from rapidgen.verification.suite.control import done
from rapidgen.verification.suite.motion_task import halt_timeout
from rapidgen.verification.suite.supervisor import end_as_request
from rapidgen.verification.testbench import Bench

case = SuiteGroup("own program")

_OUTSIDE = "ROS: STOP is not for this program"
_MAIN = b"""MODULE cell
    PERS bool leave := FALSE;
    PERS num starts := 0;
    PERS num stage := 0;

    PROC main()
        VAR jointtarget home;
        VAR jointtarget away;

        starts := starts + 1;
        WHILE TRUE DO
            stage := 1;
            ROS_run \\Until:=leave;
            stage := 2;
            home := CJointT();
            away := home;
            away.robax.rax_1 := away.robax.rax_1 + 5;
            MoveAbsJ away \\NoEOffs, v100 \\T:=3, fine, tool0;
            MoveAbsJ home \\NoEOffs, v100 \\T:=1, fine, tool0;
            stage := 3;
            WaitUntil NOT leave;
        ENDWHILE
    ENDPROC
ENDMODULE
"""


_MAIN_SIGNAL = b"""MODULE cell
    PERS num stage := 0;

    PROC main()
        WHILE TRUE DO
            VelSet 50, 5000;
            stage := 1;
            ROS_run \\UntilDI:=diLeave;
            stage := 2;
            WaitUntil DInput(diLeave) = 0;
        ENDWHILE
    ENDPROC
ENDMODULE
"""


def _system(bench: Bench, main: bytes = _MAIN) -> System:
    """Return the driver of `main: own` with a main that also does other work."""
    config = replace(bench.config, call_main=False)
    system = make_system(config, build(config))
    cell = ModuleFile("cell", "cell.mod", main)
    tasks = tuple(
        replace(task, modules=(*task.modules, cell)) if task.name == bench.group.task else task
        for task in system.tasks
    )
    signals = (*system.signals, SignalSpec("diLeave", "DI"))
    return in_its_cell(replace(system, tasks=tasks, signals=signals), config)


def _served(bench: Bench, link: RawLink) -> RawLink:
    """Return a working client.

    While commissioning, a stopped server has closed its connection.
    """
    return bench.motion() if link.lost and bench.config.commissioning else link


def _refused(bench: Bench, link: RawLink, when: str) -> None:
    link.send(end_as_request(bench, 3, 0.5))
    reply = messages.decode(link.expect_reply(3, "the end frame is answered"))
    if reply != messages.RawRefused(RawReason.NOT_SERVING, -1, 0):
        raise CheckFailed(f"{when} a trajectory is answered by {reply}")


@case("own-main", "ROS_run returns to a program that moves by itself, and main starts once", "R7b")
def _own_main(bench: Bench) -> None:
    """Stop, fail and leave ROS_run: the user's main never restarts."""
    with bench.second_controller(_system(bench)) as other:
        view = other.controller.task(other.group.task)
        link, state = other.motion(), other.state()
        for _ in range(3):
            other.start_motion(link, other.wave(8), 0.4)
            link.stop()
            other.run(halt_timeout(other) + 0.3)
        other.start_motion(link, other.wave(8), 0.4)
        other.controller.perform("e-stop")
        other.wait_until_standing(3)
        other.start_again()
        other.assert_at_rest(halt_timeout(other), "it was stopped, and no client asked for motion")
        link = _served(other, link)
        for _ in range(2):
            points, since = other.wave(5), other.now
            other.start_motion(link, points, 0.4)
            view["cell:leave"] = True
            other.wait_until_at(points[-1][0], 10)
            other.executed(points, since)
            other.until(lambda: view["cell:stage"] == 2, 2, "ROS_run returns")
            other.wait_until_moving()
            _moves_by_itself(other, link, state)
            view["cell:leave"] = False
            other.run(halt_timeout(other) + 0.3)
            other.assert_moves_through(link, other.wave(3))
        if view["cell:starts"] != 1:
            raise CheckFailed(f"the customer's main was started {view['cell:starts']} times")
        _restarted(other, link)
        other.assert_healthy()


def _moves_by_itself(bench: Bench, link: RawLink, state: RawLink) -> None:
    """Let the program move: the driver does not interfere.

    No trajectory is executed meanwhile.
    """
    last = bench.last_event
    _refused(bench, link, "while the program moves by itself")
    ports = [link]
    if bench.group.ports.control:
        ports.append(bench.control())
    for port in ports:
        port.stop()
    if bench.standing or bench.motion_group.stop_reasons:
        raise CheckFailed(f"the program's own move is held: {bench.motion_group.stop_reasons}")
    log_entries = [e for e in bench.controller.log.since(last) if e.title == _OUTSIDE]
    if len(log_entries) != len(ports):
        raise CheckFailed(
            f"{len(ports)} STOPs for a program of its own: the event log says {log_entries}"
        )
    if bench.status(state).motion_possible:
        raise CheckFailed("the program moves by itself, STATUS says that a trajectory may come")
    for port in ports[1:]:
        port.close()
    stage = bench.controller.task(bench.group.task)
    bench.until(lambda: stage["cell:stage"] == 3, 6, "the program's own moves come to their end")


@case("own-main-signal", "ROS_run returns at a signal, and leaves speeds as it found them")
def _until_a_signal(bench: Bench) -> None:
    """Leave ROS_run at a signal: VelSet is the program's again.

    A signal may be out of reach.
    """
    with bench.second_controller(_system(bench, _MAIN_SIGNAL)) as other:
        view, group = other.controller.task(other.group.task), other.motion_group
        link = other.motion()
        control = other.control() if other.group.ports.control else None
        other.until(lambda: view["cell:stage"] == 1, 2, "the program serves")
        for _ in range(2):
            other.run(halt_timeout(other) + 0.3)
            ends = fails(other, "cell", "DInput", "ERR_NORUNUNIT", 1000)
            other.run(1.5)
            if view["cell:stage"] != 1:
                raise CheckFailed("ROS_run returns at a signal whose unit is not there")
            points, since = other.wave(6), other.now
            other.start_motion(link, points, 0.4)
            if control is not None:
                done(control.ask(messages.RawSpeed(50)), "SPEED")
            other.run(0.8)
            ends()
            other.controller.signals["diLeave"] = 1
            other.wait_until_at(points[-1][0], 30)
            other.executed(points, since)
            other.until(lambda: view["cell:stage"] == 2, 2, "ROS_run returns")
            _refused(other, link, "after ROS_run")
            if (group.modal.speed_override, group.refresh) != (0.5, 1.0):
                raise CheckFailed(
                    f"VelSet is {group.modal.speed_override}, SpeedRefresh {group.refresh}"
                )
            other.controller.signals["diLeave"] = 0
            other.until(lambda: view["cell:stage"] == 1, 2, "the program serves again")
        other.assert_healthy()


def _restarted(bench: Bench, link: RawLink) -> None:
    """Stop in a trajectory and restart without ROS_run: motion is free."""
    view = bench.controller.task(bench.group.task)
    bench.start_motion(link, bench.wave(8), 0.4)
    bench.controller.perform("stop")
    bench.wait_until_standing(3)
    bench.run(0.3)
    before = bench.position
    view["cell:leave"] = True
    bench.controller.perform("pp-to-main")
    bench.start_again()
    bench.until(lambda: view["cell:stage"] == 3, 12, "a restarted program moves")
    bench.run(0.2)
    if distance(before, bench.position) > 1e-3:
        raise CheckFailed("the program has come back to where it stood, the robot has not")
    if view["cell:starts"] != 2 or bench.motion_group.stop_reasons:
        raise CheckFailed(
            f"restarted {view['cell:starts']} times, {bench.motion_group.stop_reasons}"
        )
    view["cell:leave"] = False
    bench.run(halt_timeout(bench) + 0.3)
    bench.assert_moves_through(_served(bench, link), bench.wave(3))


_FOREIGN = b"""MODULE foreign
    PERS num turns := 0;

    PROC main()
        VAR jointtarget home;
        VAR jointtarget away;

        home := CJointT();
        away := home;
        away.robax.rax_1 := away.robax.rax_1 + 5;
        WHILE TRUE DO
            MoveAbsJ away \\NoEOffs, v100 \\T:=1, fine, tool0;
            MoveAbsJ home \\NoEOffs, v100 \\T:=1, fine, tool0;
            turns := turns + 1;
        ENDWHILE
    ENDPROC
ENDMODULE
"""


@case("another-program", "a program without the driver in the motion task", "R7a", background=True)
def _another_program(bench: Bench) -> None:
    """Replace ROS_motion by another program: event routines are present.

    No motion is blocked.
    """
    foreign = ModuleFile("foreign", "foreign.mod", _FOREIGN)

    tasks = tuple(
        replace(task, modules=(*(m for m in task.modules if not _goes(m)), foreign))
        if task.name == bench.group.task
        else task
        for task in bench.system.tasks
    )
    system = replace(bench.system, tasks=tasks)
    # Without signals, only the event routines report if the program runs.
    for own in (system, replace(system, signals=(), outputs=(), cross=())):
        with bench.second_controller(own) as other:
            for event in system.events:
                if event.task == other.group.task:
                    routines = other.rapid_task("ROS_common").program.modules["ros_common"].routines
                    if event.routine.casefold() not in routines:
                        raise CheckFailed(
                            f"the event routine {event.routine} went with the program"
                        )
            for actions in (("stop",), ("e-stop",), ("stop", "pp-to-main"), ("power-loss",)):
                _turns(other)
                link = other.motion()
                _logs_stop(other, link, 1)
                for action in actions:
                    other.controller.perform(action)
                    other.run(0.5)
                if actions == ("stop",):
                    _logs_stop(other, link, 0)
                link.close()
                other.start_again()
            _turns(other)
            if own.signals:
                _refused(other, other.motion(), "in another program")
            other.assert_healthy()


def _goes(module: ModuleFile) -> bool:
    """True if the module belongs to the driver's program.

    A main that calls ROS_run does.
    """
    return module.name == "ROS_motion" or b"PROC main()" in module.data


@case("program-replaced", "another program is loaded in a trajectory", "R7a", background=True)
def _replaced(bench: Bench) -> None:
    """Restart at another main while the driver's stops hold: no effect."""
    link, state = bench.motion(), bench.state()
    bench.assert_moves_through(link, bench.wave(3))
    bench.start_motion(link, bench.wave(8), 0.4)
    bench.controller.perform("stop")
    bench.wait_until_standing(3)
    bench.run(0.3)
    program = bench.rapid_task("ROS_motion").program
    (task,) = (t for t in bench.system.tasks if t.name == bench.group.task)
    for module in filter(_goes, task.modules):
        program.unload(module.name)
    foreign = ModuleFile("foreign", "foreign.mod", _FOREIGN)
    program.load([(bench.controller.parse_module(foreign), foreign)])
    bench.controller.perform("pp-to-main")
    bench.start_again()
    _turns(bench)
    if bench.motion_group.stop_reasons:
        raise CheckFailed(f"another program is held: {bench.motion_group.stop_reasons}")
    _logs_stop(bench, link, 1)
    _refused(bench, link, "in another program")
    if bench.status(state).motion_possible:
        raise CheckFailed("another program runs, STATUS says that a trajectory may come")
    _turns(bench)


def _logs_stop(bench: Bench, link: RawLink, times: int) -> None:
    """Send STOP to a foreign program: the event log reports it."""
    last = bench.last_event
    link.stop()
    log_entries = [e for e in bench.controller.log.since(last) if e.title == _OUTSIDE]
    if len(log_entries) != times:
        raise CheckFailed(f"STOP comes to another program, the event log says {log_entries}")


def _turns(bench: Bench) -> None:
    """Check that the other program continues."""
    view = bench.controller.task(bench.group.task)
    turns = view["foreign:turns"]
    bench.until(lambda: view["foreign:turns"] > turns + 1, 9, "the other program goes on")
