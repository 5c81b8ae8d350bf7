"""Program control, waiting, errors and tasks."""

from collections.abc import Callable

from rapidgen.runtime.compiler.support import Condition
from rapidgen.runtime.errors import FIRST_BOOKED_ERROR, ExitCycle, FatalError, RapidError
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.task.errors import RETRIES, Errors
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.text import value_text
from rapidgen.runtime.values import Ref, Value

# -- Program control -------------------------------------------------------------------------------
#
# Program control, errors, waiting [K §7, 11; S4 datasys].


POLL_RATE = 0.1
"""Seconds between two looks of WaitUntil [S4 datasys 2-WaitUntil-1]."""
LONGEST_WAIT = 9_999_999


@builtin("Stop")
def stop(task: Task, no_regain: bool | None, all_move_tasks: bool | None) -> None:
    """Stop: finish the current movement, then stop the program.

    Source: [S4 2-Stop-1].
    """
    wait_standing(task)
    task.stop_here()


@builtin("ExitCycle")
def exit_cycle(task: Task) -> None:
    """ExitCycle: return to the first statement of main.

    Data and interrupts keep their state.
    """
    raise ExitCycle


@builtin("SystemStopAction")
def system_stop_action(
    task: Task, stop: bool | None, stop_block: bool | None, halt: bool | None
) -> None:
    """SystemStopAction: stop all NORMAL tasks.

    \\Halt also switches the motors off.
    """
    if halt:
        task.controller.set_motors(False)
    else:
        task.controller.stop_program()
    if stop_block or halt:
        raise FatalError(194_800, "SystemStopAction", "move PP before a restart", restartable=False)
    task.process_pending()


@builtin("BookErrNo")
def book_err_no(task: Task, name: Ref) -> None:
    """BookErrNo: reserve an error number above the system's numbers."""
    booked = task.controller.booked
    number = FIRST_BOOKED_ERROR + len(booked)
    booked.add(number)
    name.set(number)


@builtin("SkipWarn")
def skip_warn(task: Task) -> None:
    """SkipWarn: suppress the warning of the handled error [K §7.5]."""
    task.errors.skip_warning = True


@builtin("ResetRetryCount")
def reset_retry_count(task: Task) -> None:
    """ResetRetryCount: reset the retry counter of the statement."""
    task.errors.retry_base = task.errors.retry_number


@builtin("RaiseToUser")
def raise_to_user(
    task: Task, go_on: bool | None, break_off: bool | None, number: float | None
) -> None:
    """RaiseToUser: raise the current error in the user's routine.

    The nearest handler outside NOSTEPIN receives it [K §7.3].
    """
    error = RapidError(int(number) if number is not None else task.errno)
    error.raised = True
    task.errors.raise_in_user_code(error, resume=bool(go_on))


@builtin("ErrRaise")
def err_raise(task: Task, name: str, number: float, *arguments: str) -> None:
    """ErrRaise: raise an error of the program, with texts for the log."""
    task.controller.log.error(
        80_000 + int(number) % 10_000, name, *[a for a in arguments if a], task=task.name
    )
    data = task.program.find_data(None, name.lower())
    value = data and (data.value if data.storage == "inline" else task.program.space[data.code])
    error = RapidError(int(value or number))
    error.raised = True
    raise error


@builtin("CallByVar")
def call_by_var(task: Task, name: str, number: float) -> None:
    """CallByVar: call procedure `name` + number [S4 2-CallByVar-1].

    The procedure has no arguments.
    """
    if number != int(number) or number < 0:
        raise RapidError("ERR_ARGVALERR")
    task.late(f"{name}{int(number)}", None, ())


# -- waiting -------------------------------------------------------------------------------------


def wait_standing(task: Task) -> None:
    """Wait for standstill of the task's robot.

    Returns at once for a task without a robot.
    """
    group = task.controller.motion.moved_by(task.name)
    if group is not None:
        group.wait_standing(task)


@builtin("WaitTime")
def wait_time(task: Task, in_pos: bool | None, seconds: float) -> None:
    """WaitTime: wait for a number of seconds.

    \\InPos counts from standstill. A time of 0 lets the other tasks run.
    """
    if in_pos:
        wait_standing(task)
    if not seconds >= 0:
        raise RapidError("ERR_ARGVALERR")
    if seconds > 0:
        task.sleep(min(seconds, LONGEST_WAIT))
    else:
        task.yield_cpu()


@builtin("WaitUntil")
def wait_until(
    task: Task,
    in_pos: bool | None,
    condition: Condition,
    max_time: float | None,
    time_flag: Ref | None,
    poll_rate: float | None,
    *_dialog: object,
) -> None:
    """WaitUntil: wait for a condition.

    The task evaluates it at once, then every 0.1 s or at every change (dialect). After \\MaxTime,
    \\TimeFlag becomes TRUE, or the task raises ERR_WAIT_MAXTIME [S4 2-WaitUntil-1].
    """
    if in_pos:
        wait_standing(task)
    end = None if max_time is None else task.scheduler.now + round(max_time * 1e9)
    rate = max(0.004, poll_rate if poll_rate is not None else POLL_RATE)
    message = task.waits_for
    if task.controller.io.on_awaited is not None:
        for awaited in condition.signals():
            task.controller.io.await_value(awaited)
    try:
        task.waits_for = lambda: _until(condition)
        in_time = _hold(task, condition, end, rate)
    finally:
        task.waits_for = message
    if not in_time and time_flag is None:
        raise RapidError("ERR_WAIT_MAXTIME")
    if time_flag is not None:
        time_flag.set(not in_time)


def _until(condition: Condition) -> str:
    now = ", ".join(f"{name} is {value_text(value)}" for name, value in condition.reads())
    return f"WaitUntil waits{'; ' if now else ' for good'}{now}"


def _hold(task: Task, condition: Condition, end: int | None, rate: float) -> bool:
    """Wait for a condition; return False after `end` (ns)."""
    scheduler = task.scheduler
    woken = task.controller.dialect.wait_until == "event" and bool(condition.watched)
    while not condition():
        left = None if end is None else (end - scheduler.now) / 1e9
        if left is not None and left <= 0:
            return False
        if woken:
            task.wait_for(condition, on=condition.watched, timeout=left)
        else:
            task.sleep(rate if left is None else min(rate, left))
        task.charge(condition.cost)
    return True


@builtin("TestAndSet")
def test_and_set(task: Task, flag: Ref) -> bool:
    """TestAndSet: set a flag and return TRUE if it was FALSE.

    The test and the write are one atomic step.
    """
    in_use: bool = flag.get()
    if in_use:
        return False
    flag.set(True)
    return True


@builtin("WaitTestAndSet")
def wait_test_and_set(task: Task, flag: Ref) -> None:
    """WaitTestAndSet: wait for FALSE, then set TRUE atomically."""
    watched = (flag.cell,) if flag.cell is not None else ()
    task.wait_for(
        lambda: not flag.get(), on=watched, why=lambda: "WaitTestAndSet waits for its flag"
    )
    flag.set(True)


_EVENTS = ("", "POWER_ON", "START", "STOP", "QSTOP", "RESTART", "RESET", "STEP")


def _event(task: Task) -> int:
    event = task.events.running
    return _EVENTS.index(event) if event in _EVENTS else 0


def _handler(errors: Errors) -> int:
    return 3 if errors.undo_level else 2 if errors.handler_level else 0


_VALUE_FUNCTIONS: dict[str, Callable[..., Value]] = {
    "Break": lambda task: task.stop_here(),  # not waiting for the movement [S4 2-Break-1]
    "DebugBreak": lambda task: task.stop_here(),
    "RemainingRetries": lambda task: RETRIES - (task.errors.retry_number - task.errors.retry_base),
    "EventType": _event,
    "ExecLevel": lambda task: 2 if task.events.running else int(task.in_trap),
    "ExecHandler": lambda task: _handler(task.errors),
    # The virtual controller reports a moved program pointer in RESET events only.
    "IsStopStateEvent": lambda task, _moved, _to_main: task.events.running == "RESET",
    # An alias is reported by its base type.
    "Type": lambda _task, data, _base_name: data.type.name,
}
builtins(_VALUE_FUNCTIONS)


# -- Tasks -----------------------------------------------------------------------------------------
#
# What a task may ask about itself, the others and the controller.


OP_MAN_TEST = 3
OP_MODES = {"auto": 1, "manual_reduced": 2}
RUN_CONT_CYCLE = 1


@builtin("GetTaskName")
def get_task_name(task: Task, number: Ref | None, mechanical: Ref | None) -> str:
    """GetTaskName: return the name of the task.

    \\TaskNo and \\MecTaskNo count from 1.
    """
    tasks = list(task.controller.rapid_tasks.values())
    if number is not None:
        number.set(tasks.index(task) + 1)
    if mechanical is not None:
        moving = [t for t in tasks if task.controller.motion.is_motion_task(t.name)]
        mechanical.set(moving.index(task) + 1 if task in moving else 0)
    return task.name


@builtin("RobName")
def rob_name(task: Task) -> str:
    """RobName: return the task's robot, or an empty string."""
    group = task.controller.motion.moved_by(task.name)
    return "" if group is None else group.config.mechanical_unit


@builtin("MotionPlannerNo")
def motion_planner_no(task: Task) -> int:
    """MotionPlannerNo: return the number of the group, from 1.

    Returns 0 for a task without a group.
    """
    motion = task.controller.motion
    group = motion.moved_by(task.name)
    return 0 if group is None else list(motion.groups.values()).index(group) + 1


def _task(task: Task, reference: Value, name: str | None) -> RapidTask:
    expected = name if name is not None else str(reference.value or "")
    for other in task.controller.rapid_tasks.values():
        if other.name.lower() == expected.lower():
            return other
    raise RapidError("ERR_TASKNAME", expected)


def _moves(task: Task) -> bool:
    return task.controller.motion.is_motion_task(task.name)


_CHECKED = {"NORMAL": 14, "STATIC": 15, "SEMISTATIC": 16}
"""TSP_NORMAL_CHECKED, TSP_STATIC_CHECKED, TSP_SEMISTATIC_CHECKED [mem]."""


# The virtual controller runs programs continuously and has all tasks on; \\Main has no effect.
_TASK_FUNCTIONS: dict[str, Callable[..., Value]] = {
    "OpMode": lambda task: OP_MODES.get(task.controller.mode, OP_MAN_TEST),
    "RunMode": lambda _task, _main: RUN_CONT_CYCLE,
    "NonMotionMode": lambda _task, _main: 0,
    "TaskRunRob": _moves,
    "TaskRunMec": _moves,
    "GetMecUnitName": lambda _task, unit: str(unit.value or ""),
    "GetTSPStatus": lambda task, *which: _CHECKED[_task(task, *which).spec.type],
    "TaskIsActive": lambda task, *which: _task(task, *which).state != "empty",
    "TaskIsExecuting": lambda task, *which: _task(task, *which).state == "running",
}
builtins(_TASK_FUNCTIONS)
