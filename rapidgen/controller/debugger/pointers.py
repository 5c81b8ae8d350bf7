"""Program pointer and motion pointer: what a task is about to execute, and what its robot does."""

from rapidgen.controller.controller import VirtualController
from rapidgen.controller.debugger.stack import frames_of
from rapidgen.runtime.errors import Location
from rapidgen.runtime.task.task import Task


def program_pointer(task: Task) -> Location | None:
    """Where a task is in its program, not in a trap or an event routine; None: nowhere."""
    frames = [frame for frame in frames_of(task) if frame.level == "program"]
    return frames[-1].place if frames else None


def motion_pointer(controller: VirtualController, task: str) -> Location | None:
    """The move instruction of a task that its robot is executing; None: there is none."""
    group = controller.motion.moved_by(task)
    move = None if group is None else group.motion.move(controller.scheduler.now)
    where = None if move is None or move.place is None else move.place()
    return where if isinstance(where, Location) else None
