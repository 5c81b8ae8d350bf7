"""A case of the trial with ROS nodes: what is tried, and what came of it."""

import time
from collections.abc import Callable
from dataclasses import dataclass

from rapidgen.wire.simple_message import spec
from tools.interop.ros import until
from tools.interop.ros_cell import TRUE, Cell

FIVE = ([0.0], [0.125], [0.25, 0.125], [0.5, 0.25, 0, 0, 0, 0.125], [0.5, 0.25, -0.5, 0, 0, 0.25])
ACTIVE, PREEMPTED, SUCCEEDED, ABORTED = 1, 2, 3, 4
"""actionlib_msgs/GoalStatus."""


@dataclass(frozen=True)
class Case:
    """What is tried, with which controllers."""

    title: str
    run: Callable[[Cell, "Findings"], None]
    robot: str = "irb120"
    options: tuple[str, ...] = ()
    coupled: bool = False
    faults: str = ""
    """A plan of faults, as `rapidgen sim --faults` reads it."""
    upstream: bool = True
    """Whether abb_driver's modules can do it at all."""


CASES: dict[str, Case] = {}


def case(title: str, **what: object):
    """Enter a function into CASES."""

    def enter(function):
        CASES[function.__name__] = Case(title, function, **what)
        return function

    return enter


class Findings:
    """What came out of a case: sentences, each with whether it is as it should be."""

    def __init__(self) -> None:
        self.lines: list[tuple[bool, str]] = []

    def tell(self, text: str) -> None:
        """What is only told."""
        self.lines.append((True, text))

    def must(self, holds: object, text: str) -> None:
        """What should hold."""
        self.lines.append((bool(holds), text))

    def succeeds(self, client, text: str) -> None:
        """The goal of an action has to end well."""
        self.must(Cell.ended(client, 25) and client.get_state() == SUCCEEDED, text)

    def stands(self, cell: Cell, begin: float) -> None:
        """The robot has to stand within 1 s from `begin`."""
        until(cell.sim.standing, 15, "it never stood")
        took = time.monotonic() - begin
        self.must(took < 1, f"the robot stands {took:.2f} s later")

    def five(self, cell: Cell, text: str, seconds: float = 25) -> None:
        """FIVE by topic has to be executed."""
        cell.publish(cell.trajectory(FIVE))
        self.must(cell.arrives(FIVE[-1], seconds), text)

    def ramped(self, cell: Cell, text: str, *, to: float = 0.0) -> None:
        """Joint 1 has to get there from where the robot is."""
        cell.publish(cell.ramp(1, to=to))
        self.must(cell.arrives([to], 25), text)

    def reports(self, cell: Cell, reason: spec.Reason, joint: int = 0, *, error=True) -> None:
        """error_code has to tell the reason; with `error` in_error has to be set, too."""
        now = cell.next_status()
        self.must(
            now.error_code == code(reason, joint) and (now.in_error.val == TRUE or not error),
            f"in_error {now.in_error.val}, error_code {now.error_code}",
        )

    def __str__(self) -> str:
        return "; ".join(text if good else f"NOT: {text}" for good, text in self.lines)


def code(reason: spec.Reason, joint: int = 0) -> int:
    """error_code of STATUS."""
    return spec.error_code(reason, joint)


def begin_moving(cell: Cell) -> None:
    """Joint 1 on its way to 1.2 rad in 6 s, one second of which is over."""
    cell.publish(cell.ramp(6, to=1.2))
    cell.wait_moving(15)
    time.sleep(1)
