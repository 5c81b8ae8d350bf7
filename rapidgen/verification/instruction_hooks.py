"""Watch RAPID instructions of the driver's tasks, or make them fail.

The driver must handle every error that a controller may report.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.task.task import Task
from rapidgen.verification.testbench import Bench

Instruction: TypeAlias = Callable[..., Any]
"""Same arguments and result as the wrapped instruction."""


@dataclass(frozen=True, slots=True)
class Order:
    """An instruction to the robot; `free`: no StopMove held the robot."""

    time: float
    instruction: str
    free: bool


def wrapped(task: Task, name: str, wrap: Callable[[Instruction], Instruction]) -> None:
    """Wrap an instruction for one task; `wrap` gets the previous function."""
    routine = task.program.find_routine(None, name.casefold())
    assert routine is not None
    space = task.program.space
    space[routine.code] = wrap(space[routine.code])


def fails(
    bench: Bench, module: str, name: str, error: str, times: int = 1, *, after: int = 0
) -> Callable[[], None]:
    """Make the next `times` calls of an instruction raise an error.

    `after`: number of calls that still succeed before. Returns a function that removes the hook.
    """
    left, before = times, after

    def wrap(as_before: Instruction) -> Instruction:
        def failing(*arguments: object) -> object:
            nonlocal left, before
            if left <= 0 or before > 0:
                before -= 1
                return as_before(*arguments)
            left -= 1
            raise RapidError(error)

        return failing

    def end() -> None:
        nonlocal left
        left = 0

    wrapped(bench.rapid_task(module), name, wrap)
    return end


def at_call(bench: Bench, module: str, name: str, number: int, act: Callable[[], None]) -> None:
    """Call `act` once, just before a module's task executes an instruction.

    `number`: counts from now, the next call is 1.
    """
    task, left = bench.rapid_task(module), number

    def wrap(as_before: Instruction) -> Instruction:
        def called(*arguments: object) -> object:
            nonlocal left
            left -= 1
            if left == 0:
                act()
                task.process_pending()
            return as_before(*arguments)

        return called

    wrapped(task, name, wrap)


def watched_orders(bench: Bench) -> list[Order]:
    """Record from now on when a task orders a move or a stop."""
    orders: list[Order] = []
    group = bench.motion_group

    def watched(instruction: str) -> Callable[[Instruction], Instruction]:
        def wrap(as_before: Instruction) -> Instruction:
            def call(*arguments: object) -> object:
                orders.append(Order(bench.now, instruction, not group.stop_reasons))
                return as_before(*arguments)

            return call

        return wrap

    for task in bench.controller.rapid_tasks.values():
        for instruction in ("StopMove", "MoveAbsJ", "MoveJ", "MoveL"):
            wrapped(task, instruction, watched(instruction))
    return orders
